//! Passages as they are found. All are counted, and the worst are kept.

use std::cmp::Ordering;

use super::passage::{LINKING_CHANGE, Linking, PASSAGES_LISTED, Passage};

/// The passages of one task.
#[derive(Default)]
pub(super) struct Found {
    largest: f64,
    passages: u64,
    worst: Vec<Passage>,
    compared: u64,
    pub(super) left_out: u64,
}

impl Found {
    /// Counts a pair of windows with its `change` of the linking integral, and keeps the pair if it
    /// is a passage.
    pub(super) fn add(&mut self, change: f64, passage: impl FnOnce() -> Passage) {
        self.compared += 1;
        self.largest = self.largest.max(change.abs());
        if change.abs() > LINKING_CHANGE {
            self.passages += 1;
            self.worst.push(passage());
        }
        if self.worst.len() > 2 * PASSAGES_LISTED {
            self.keep_worst();
        }
    }

    fn keep_worst(&mut self) {
        self.worst.sort_by(by_change);
        self.worst.truncate(PASSAGES_LISTED);
    }

    pub(super) fn joined(mut self, other: Self) -> Self {
        self.largest = self.largest.max(other.largest);
        self.passages += other.passages;
        self.compared += other.compared;
        self.left_out += other.left_out;
        self.worst.extend(other.worst);
        self.keep_worst();
        self
    }

    pub(super) fn linking(self) -> Linking {
        let Self { largest, passages, worst, compared, left_out } = self;
        Linking { largest, passages, worst, compared, left_out }
    }
}

/// Worst first. Equal changes are ordered along the yarns, so the order of the search does not
/// matter.
fn by_change(a: &Passage, b: &Passage) -> Ordering {
    let place = |passage: &Passage| passage.places.map(|place| (place.yarn, place.interval));
    b.change.abs().total_cmp(&a.change.abs()).then_with(|| place(a).cmp(&place(b)))
}
