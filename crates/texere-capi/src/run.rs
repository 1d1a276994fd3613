//! Progress and cancellation of calls that take long.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use crate::argument::check;
use crate::error::guard;
use crate::handle::{Handle, clear, free, get, give};
use crate::status::texere_status;

/// The progress of a call that takes long, and whether the call is to end. Other threads read the
/// progress, and cancel the run. A run may be given to one call after another; the progress begins
/// at 0 in each.
#[derive(Debug)]
pub struct texere_run;

#[derive(Debug, Default)]
pub(crate) struct Run {
    cancelled: AtomicBool,
    /// The share of the work that is done: the bits of an `f64` from 0 to 1.
    share: AtomicU64,
}

impl Handle for texere_run {
    type Value = Run;
    const NAME: &str = "run";
}

/// A closure that keeps the progress in `run`, and returns `Break` once `run` is cancelled.
pub(crate) fn reporter(run: Option<Arc<Run>>) -> impl FnMut(f64) -> ControlFlow<()> + Send {
    if let Some(run) = &run {
        run.share.store(0.0_f64.to_bits(), Ordering::Relaxed);
    }
    move |share| {
        let Some(run) = &run else { return ControlFlow::Continue(()) };
        run.share.store(share.to_bits(), Ordering::Relaxed);
        if run.cancelled.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

/// Makes a run, which is not cancelled.
///
/// Fails with TEXERE_ARGUMENT for a null `out`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_run_new(out: *mut *mut texere_run) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `out`.
        unsafe {
            clear(out)?;
            give(out, Run::default())
        }
    })
}

/// Asks the call that `run` was given to, and every later one, to end with TEXERE_CANCELLED. Any
/// thread may ask.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_run_cancel(run: *const texere_run) -> texere_status {
    guard(|| {
        get(run)?.cancelled.store(true, Ordering::Relaxed);
        Ok(())
    })
}

/// Writes the share of the call that is done, from 0 to 1. Any thread may ask.
///
/// Fails with TEXERE_ARGUMENT for a null `share`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_run_progress(run: *const texere_run, share: *mut f64) -> texere_status {
    guard(|| {
        check("share", share)?;
        let done = f64::from_bits(get(run)?.share.load(Ordering::Relaxed));
        // SAFETY: the pointer is neither null nor misaligned; the caller vouches for the memory.
        unsafe { share.write(done) };
        Ok(())
    })
}

/// Frees a run. A null handle is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_run_free(run: *mut texere_run) {
    free(run);
}
