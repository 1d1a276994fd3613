//! A progress bar for work that takes over a second, on a terminal only.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use texere::Progress;

/// Shorter work shows no bar: it would only flicker.
const QUIET_FOR: Duration = Duration::from_secs(1);

/// A bar that is hidden until [`teller`] shows it, and for good where `terminal` is false.
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

/// Moves `bar` on as the pipeline tells how far it has come.
pub(crate) fn teller(bar: &ProgressBar) -> impl FnMut(Progress) -> ControlFlow<()> + Send {
    let (bar, start) = (bar.clone(), Instant::now());
    move |progress| {
        if start.elapsed() >= QUIET_FOR {
            bar.set_length(progress.total);
            bar.set_position(progress.rings);
        }
        ControlFlow::Continue(())
    }
}
