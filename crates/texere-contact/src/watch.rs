//! How far the measuring has come, and whether it is to stop.

use std::fmt;
use std::ops::ControlFlow;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use crate::ContactError;

/// A caller's ear for the share of the work that is done. Behind a pointer, so that work is
/// compiled once for all callers.
pub(crate) type Report<'a> = dyn FnMut(f64) -> ControlFlow<()> + Send + 'a;

/// Reports to a caller, from any thread that works, how much is done.
pub(crate) struct Watch<'a> {
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
    /// For work of `total` units.
    pub(crate) fn new(total: u64, report: &'a mut Report<'a>) -> Self {
        Self {
            total: total.into(),
            done: AtomicU64::new(0),
            stopped: AtomicBool::new(false),
            report: Mutex::new(report),
        }
    }

    /// There are so many units more to do, before the first is done.
    pub(crate) fn expect(&self, units: u64) {
        self.total.fetch_add(units, Ordering::Relaxed);
    }

    /// So many units more are done.
    ///
    /// **Errors**: [`ContactError::Cancelled`] once the caller has asked to stop.
    pub(crate) fn advance(&self, units: u64) -> Result<(), ContactError> {
        self.done.fetch_add(units, Ordering::Relaxed);
        // A thread that finds another one reporting goes on with its work.
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
