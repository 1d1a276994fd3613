//! Work that lets go of Python, shows its progress, and ends when Python asks.

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

/// How often a call that works looks whether Python asks to stop. Work ends within one of its own
/// steps after that; `test_interrupt.py` measures both together against 0.2 s.
const LOOK: Duration = Duration::from_millis(50);

/// How far a call has come, and whether it is to end.
#[derive(Debug, Default)]
pub(crate) struct Run {
    stopped: AtomicBool,
    /// The bits of an `f64` from 0 to 1.
    share: AtomicU64,
}

impl Run {
    /// Notes the share of the work that is done. `Break` where the call is to end.
    pub(crate) fn tell(&self, share: f64) -> ControlFlow<()> {
        self.share.store(share.to_bits(), Ordering::Relaxed);
        if self.stopped.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    fn share(&self) -> f64 {
        f64::from_bits(self.share.load(Ordering::Relaxed))
    }
}

/// Does `work` in a thread of its own while Python goes on. Signals reach only Python's main
/// thread, and only when it looks: a `KeyboardInterrupt` is raised once `work` has ended. `shown`
/// gets the share that is done.
///
/// **Errors**: that of `work`, as an exception; what a signal's handler or `shown` raises; an
/// [`Error`] if `work` panics, or in a process that was forked from one that has worked.
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
                // Dropped at the end of the work, also by a panic, which ends the wait.
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

/// A process that was forked has none of the threads that texere works with, and would wait for
/// them forever.
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

/// The exception of a panic.
fn panicked(panic: &(dyn Any + Send)) -> PyErr {
    let text = panic.downcast_ref::<&str>().copied();
    let text = text.or(panic.downcast_ref::<String>().map(String::as_str)).unwrap_or("no message");
    Error::new_err(format!("a fault of texere: {text}"))
}
