//! The table that `--worst` prints: the largest errors beside their tolerances.

use std::sync::{Arc, Mutex};

use crate::compare::{Quantity, Report, Worst};

/// One trial's worst values, in the order of [`Quantity::ALL`].
type Row = (String, [Worst; Quantity::ALL.len()]);

/// The worst values of each trial, collected from all threads.
#[derive(Debug, Clone, Default)]
pub(crate) struct Table(Arc<Mutex<Vec<Row>>>);

impl Table {
    pub(crate) fn note(&self, trial: String, report: &Report) {
        self.0.lock().unwrap().push((trial, Quantity::ALL.map(|quantity| report.worst(quantity))));
    }

    /// Prints one line for each trial, and the worst values of all trials at the end: the error of
    /// each quantity, and its share of the tolerance.
    pub(crate) fn print(&self) {
        let mut rows = self.0.lock().unwrap();
        rows.sort_by(|(a, _), (b, _)| a.cmp(b));
        let titles = [
            "centre, radii",
            "half, relative",
            "growth",
            "tangent, rad",
            "roll, rad",
            "lean, rad",
            "vertex, radii",
            "normal, rad",
        ];
        let line = |name: &str, cells: [String; Quantity::ALL.len()]| {
            println!("{name:<100} {}", cells.map(|cell| format!("{cell:>18}")).join(""));
        };
        line("worst error (share of allowed)", titles.map(Into::into));
        let mut most = [Worst::default(); Quantity::ALL.len()];
        for (name, worst) in rows.iter() {
            line(name, worst.map(cell));
            for (most, worst) in most.iter_mut().zip(worst) {
                *most = Worst { error: most.error.max(worst.error), share: most.share.max(worst.share) };
            }
        }
        line("all", most.map(cell));
    }
}

fn cell(worst: Worst) -> String {
    format!("{:.1e} ({:.3})", worst.error, worst.share)
}
