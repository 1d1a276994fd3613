//! The threads that share the work.

use std::num::NonZero;
use std::sync::mpsc;
use std::{env, io, thread};

use rayon::{ThreadBuilder, ThreadPoolBuilder};

/// Starts a thread for each core, or as many as the variable `RAYON_NUM_THREADS` says. If fewer can
/// be started, those do the work. If none can, the main thread does all the work.
///
/// Rayon would start its threads at first use, and panic if one can't be started. Here the threads
/// are started first, and rayon is given those that could be started.
pub(crate) fn start() {
    let (mut workers, wanted) = (Vec::new(), wanted());
    while workers.len() < wanted {
        let (hand_over, wait) = mpsc::channel::<ThreadBuilder>();
        let started = thread::Builder::new().spawn(move || {
            if let Ok(worker) = wait.recv() {
                worker.run();
            }
        });
        if started.is_err() {
            break;
        }
        workers.push(hand_over);
    }
    let pool = ThreadPoolBuilder::new().num_threads(workers.len().max(1));
    // `build_global` fails only if there is a pool already, or if a thread can't take its worker.
    // There is no pool yet, and all threads wait for their workers.
    let _ = if workers.is_empty() {
        pool.use_current_thread().build_global()
    } else {
        let mut waiting = workers.into_iter();
        pool.spawn_handler(move |worker| {
            let handed = waiting.next().and_then(|hand_over| hand_over.send(worker).ok());
            handed.ok_or_else(|| io::ErrorKind::BrokenPipe.into())
        })
        .build_global()
    };
}

/// The number of threads that rayon would start.
fn wanted() -> usize {
    let set = env::var("RAYON_NUM_THREADS").ok().and_then(|number| number.parse().ok());
    set.filter(|number| *number > 0)
        .unwrap_or_else(|| thread::available_parallelism().map_or(1, NonZero::get))
}
