//! Runs work that lets other Python threads go on, shows its progress, and ends when Python asks.

use std::any::Any;
use std::error::Error as StdError;
use std::ops::ControlFlow;
use std::process;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use pyo3::prelude::*;

use crate::error::{Error, Raise};

/// The time between two checks whether Python asks a call to stop. When Python asks, the work ends
/// after its present step. `test_calls.py` tests that it ends early.
const LOOK: Duration = Duration::from_millis(50);

/// How much of a call's work is done, and whether the call is to end.
#[derive(Debug, Default)]
pub(crate) struct Run {
    stopped: AtomicBool,
    /// The share of the work that is done: the bits of an `f64` from 0 to 1.
    share: AtomicU64,
}

impl Run {
    /// Stores the share of the work that is done. Returns `Break` if the call is to end.
    pub(crate) fn tell(&self, share: f64) -> ControlFlow<()> {
        self.share.store(share.to_bits(), Ordering::Relaxed);
        if self.stopped.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    fn share(&self) -> f64 {
        f64::from_bits(self.share.load(Ordering::Relaxed))
    }
}

/// Does `work` in a thread of its own. Other Python threads go on meanwhile. Python handles signals
/// only in its main thread, and only when that thread checks for them. The calling thread checks at
/// intervals of [`LOOK`]. After Ctrl-C it asks `work` to end, and raises `KeyboardInterrupt` once
/// `work` has ended. `shown` is called with the share of the work that is done.
///
/// **Errors**: the error of `work`, as an exception; what a signal's handler or `shown` raises; an
/// [`Error`] if `work` panics, or if this process was forked from one in which texere has worked.
pub(crate) fn work<T: Send, E: StdError + Send + 'static>(
    py: Python<'_>,
    mut shown: impl FnMut(Python<'_>, f64) -> PyResult<()> + Send,
    work: impl FnOnce(&Run) -> Result<T, E> + Send,
) -> PyResult<T> {
    check_process()?;
    let run = &Run::default();
    let (done, wait) = channel::<()>();
    let (ended, asked) = py.detach(move || {
        thread::scope(|scope| {
            let worker = scope.spawn(move || {
                // The sender is dropped when the work ends, even by a panic. That ends the wait
                // below.
                let _done = done;
                work(run)
            });
            let mut asked = Ok(());
            while let Err(RecvTimeoutError::Timeout) = wait.recv_timeout(LOOK) {
                if asked.is_ok() {
                    asked = Python::attach(|py| {
                        py.check_signals()?;
                        shown(py, run.share())
                    });
                    run.stopped.store(asked.is_err(), Ordering::Relaxed);
                }
            }
            (worker.join(), asked)
        })
    });
    asked?;
    py.check_signals()?;
    ended.map_err(|panic| panicked(&*panic))?.raise(py)
}

/// Does `work` as [`work`](fn@work) does, without a report of progress.
pub(crate) fn quietly<T: Send, E: StdError + Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce(&Run) -> Result<T, E> + Send,
) -> PyResult<T> {
    self::work(py, |_, _| Ok(()), work)
}

/// Refuses a process that was forked from one in which texere has worked. The forked process has
/// none of texere's threads, and would wait for them forever.
fn check_process() -> PyResult<()> {
    static FIRST: OnceLock<u32> = OnceLock::new();
    let here = process::id();
    if *FIRST.get_or_init(|| here) == here {
        return Ok(());
    }
    Err(Error::new_err(
        "this process was forked from one in which texere has worked: \
         start it with multiprocessing.get_context(\"spawn\")",
    ))
}

/// The exception that reports a panic.
fn panicked(panic: &(dyn Any + Send)) -> PyErr {
    let text = panic.downcast_ref::<&str>().copied();
    let text = text.or(panic.downcast_ref::<String>().map(String::as_str)).unwrap_or("no message");
    Error::new_err(format!("a fault of texere: {text}"))
}
