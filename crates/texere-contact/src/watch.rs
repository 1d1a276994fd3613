//! Progress of a measurement, and the caller's request to stop.

use std::fmt;
use std::ops::ControlFlow;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use crate::ContactError;

/// The caller's progress function. It is behind a pointer, so that the code that calls it is
/// compiled once for all callers.
pub type Report<'a> = dyn FnMut(f64) -> ControlFlow<()> + Send + 'a;

/// Reports progress to a caller, from any working thread.
pub struct Watch<'a> {
    total: AtomicU64,
    done: AtomicU64,
    stopped: AtomicBool,
    report: Mutex<&'a mut Report<'a>>,
}

impl fmt::Debug for Watch<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Watch").field("total", &self.total).field("done", &self.done).finish_non_exhaustive()
    }
}

impl<'a> Watch<'a> {
    /// Starts at 0 of `total` units.
    pub fn new(total: u64, report: &'a mut Report<'a>) -> Self {
        Self {
            total: total.into(),
            done: AtomicU64::new(0),
            stopped: AtomicBool::new(false),
            report: Mutex::new(report),
        }
    }

    /// Adds units to the total. It must be called before any unit is done.
    pub fn expect(&self, units: u64) {
        self.total.fetch_add(units, Ordering::Relaxed);
    }

    /// Counts units as done, and calls the progress function with the share of the total.
    ///
    /// **Errors**: [`ContactError::Cancelled`] once the caller has asked to stop.
    pub fn advance(&self, units: u64) -> Result<(), ContactError> {
        self.done.fetch_add(units, Ordering::Relaxed);
        // If another thread is reporting, this one does not wait.
        if let Ok(mut report) = self.report.try_lock() {
            let total = self.total.load(Ordering::Relaxed);
            let done = self.done.load(Ordering::Relaxed).min(total);
            if report(done as f64 / total.max(1) as f64).is_break() {
                self.stopped.store(true, Ordering::Relaxed);
            }
        }
        if self.stopped.load(Ordering::Relaxed) { Err(ContactError::Cancelled) } else { Ok(()) }
    }
}
