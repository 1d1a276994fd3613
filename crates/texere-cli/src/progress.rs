//! A progress bar for work that takes over a second, on a terminal only.

use std::io::IsTerminal;
use std::ops::ControlFlow;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use texere::mesh::Progress;

/// How long work must take before it shows a bar. For shorter work the bar would only flicker.
const QUIET_FOR: Duration = Duration::from_secs(1);

/// Number of steps of a bar that [`share`] moves.
const STEPS: u64 = 1000;

/// A bar that is hidden until it is moved or ticked. It is never shown if `terminal` is false.
pub(crate) fn bar(terminal: bool) -> ProgressBar {
    let bar = ProgressBar::hidden();
    if let Ok(style) = ProgressStyle::with_template("{wide_bar} {percent} %, {eta} left") {
        bar.set_style(style);
    }
    if terminal {
        bar.set_draw_target(ProgressDrawTarget::stderr());
    }
    bar
}

/// Does `work`, and shows its progress on a terminal if it takes over a second. `work` moves the
/// bar, see [`share`].
pub(crate) fn during<T>(what: &'static str, work: impl FnOnce(&ProgressBar) -> T) -> T {
    let bar = bar(std::io::stderr().is_terminal());
    if let Ok(style) = ProgressStyle::with_template("{msg}: {percent} %, {elapsed}") {
        bar.set_style(style);
    }
    bar.set_message(what);
    bar.set_length(STEPS);
    let (end, ended) = mpsc::channel::<()>();
    let ticking = bar.clone();
    // The bar's own ticker would panic if no thread could be started. If this thread can't be
    // started, the bar only changes when `work` moves it.
    let ticker = thread::Builder::new().spawn(move || {
        while ended.recv_timeout(QUIET_FOR) == Err(RecvTimeoutError::Timeout) {
            ticking.tick();
        }
    });
    let done = work(&bar);
    drop(end);
    let _ = ticker.map(JoinHandle::join);
    bar.finish_and_clear();
    done
}

/// A function that moves `bar` on to a share of the work that is done, from 0 to 1.
pub(crate) fn share(bar: &ProgressBar) -> impl FnMut(f64) -> ControlFlow<()> + Send {
    let (bar, start) = (bar.clone(), Instant::now());
    move |done| {
        if start.elapsed() >= QUIET_FOR {
            bar.set_position((done * STEPS as f64) as u64);
        }
        ControlFlow::Continue(())
    }
}

/// A function that moves `bar` on as the pipeline reports its progress.
pub(crate) fn reporter(bar: &ProgressBar) -> impl FnMut(Progress) -> ControlFlow<()> + Send {
    let (bar, start) = (bar.clone(), Instant::now());
    move |progress| {
        if start.elapsed() >= QUIET_FOR {
            bar.set_length(progress.total);
            bar.set_position(progress.rings);
        }
        ControlFlow::Continue(())
    }
}
