//! The watchdog: if a call does not end, or fails a check, it prints the seed and the calls that
//! led to it.

use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use crate::caller::Random;

/// The longest that a call may take. It is far more than any call takes, under valgrind too.
const LIMIT: Duration = Duration::from_secs(300);

/// How often the watchdog looks.
const LOOKS: Duration = Duration::from_secs(1);

/// The sequence of calls that a thread makes.
#[derive(Debug)]
pub(crate) struct Watched {
    seed: u64,
    sequence: Mutex<Sequence>,
}

#[derive(Debug)]
struct Sequence {
    random: String,
    calls: Vec<&'static str>,
    /// When the call began that is under way, if there is one.
    since: Option<Instant>,
}

impl Watched {
    /// Starts a watchdog for the calls of a thread.
    pub(crate) fn new(seed: u64) -> Arc<Self> {
        let sequence = Sequence { random: String::new(), calls: Vec::new(), since: None };
        let watched = Arc::new(Self { seed, sequence: Mutex::new(sequence) });
        let weak = Arc::downgrade(&watched);
        thread::spawn(move || {
            while let Some(watched) = weak.upgrade() {
                let late =
                    watched.with(|sequence| sequence.since.is_some_and(|since| since.elapsed() > LIMIT));
                if late {
                    eprintln!("a call does not end: {}", watched.told());
                    std::process::abort();
                }
                drop(watched);
                thread::sleep(LOOKS);
            }
        });
        watched
    }

    fn with<T>(&self, work: impl FnOnce(&mut Sequence) -> T) -> T {
        work(&mut self.sequence.lock().unwrap_or_else(PoisonError::into_inner))
    }

    pub(crate) fn begin(&self, random: &Random) {
        self.with(|sequence| {
            sequence.random = format!("{random:?}");
            sequence.calls.clear();
        });
    }

    pub(crate) fn call(&self, name: &'static str) {
        self.with(|sequence| {
            sequence.calls.push(name);
            sequence.since = Some(Instant::now());
        });
    }

    pub(crate) fn end(&self) {
        self.with(|sequence| sequence.since = None);
    }

    fn told(&self) -> String {
        let seed = self.seed;
        self.with(|Sequence { random, calls, .. }| format!("TEXERE_SEED={seed}, {random}: {calls:?}"))
    }
}

impl Drop for Watched {
    fn drop(&mut self) {
        if thread::panicking() {
            eprintln!("a check failed: {}", self.told());
        }
    }
}
