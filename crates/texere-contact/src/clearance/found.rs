//! Contacts as they are found. All are counted, and the worst are kept.

use std::cmp::Ordering;

use super::contact::{CLEAR, CLEARANCE_ACCURACY, CLEARANCE_BIN, CONTACTS_LISTED, Contact};
use super::crowd::Crowd;

/// Bins from 0 to [`CLEARANCE_NEAR`](crate::CLEARANCE_NEAR).
const BINS: usize = 110;

/// The contacts of one task.
pub(super) struct Found {
    /// The least ratio of all contacts, listed or not.
    pub(super) least: f64,
    pub(super) below_one: u64,
    pub(super) piercing: u64,
    pub(super) histogram: Vec<u64>,
    pub(super) worst: Vec<Contact>,
    pub(super) crowd: Option<Crowd>,
    /// Pairs of intervals that were looked at.
    pub(super) pairs: u64,
    /// Contacts above this ratio are counted, but not kept.
    bar: f64,
    /// The number of worst contacts that are kept.
    most: usize,
}

impl Found {
    /// The worst contacts, [`CONTACTS_LISTED`] at most.
    pub(super) fn worst() -> Self {
        Self::new(f64::INFINITY, CONTACTS_LISTED)
    }

    /// All contacts up to a ratio.
    pub(super) fn up_to(ratio: f64) -> Self {
        Self::new(ratio, usize::MAX)
    }

    fn new(bar: f64, most: usize) -> Self {
        Self {
            least: f64::INFINITY,
            below_one: 0,
            piercing: 0,
            histogram: vec![0; BINS],
            worst: Vec::new(),
            crowd: None,
            pairs: 0,
            bar,
            most,
        }
    }

    pub(super) fn add(&mut self, ratio: f64, contact: impl FnOnce() -> Contact) {
        self.least = self.least.min(ratio);
        self.below_one += u64::from(ratio < 1.0 - CLEARANCE_ACCURACY);
        self.piercing += u64::from(ratio < CLEAR);
        if let Some(bin) = self.histogram.get_mut((ratio / CLEARANCE_BIN) as usize) {
            *bin += 1;
        }
        if ratio <= self.bar {
            self.worst.push(contact());
        }
        if self.worst.len() / 2 > self.most {
            self.keep_worst();
        }
    }

    pub(super) fn keep_worst(&mut self) {
        self.worst.sort_by(by_ratio);
        if self.worst.len() >= self.most {
            self.worst.truncate(self.most);
            self.bar = self.worst.last().map_or(f64::INFINITY, |contact| contact.ratio);
        }
    }

    pub(super) fn add_crowd(&mut self, crowd: Option<Crowd>) {
        self.crowd = [self.crowd, crowd].into_iter().flatten().reduce(Crowd::worse);
    }

    pub(super) fn joined(mut self, other: Self) -> Self {
        self.add_crowd(other.crowd);
        self.pairs += other.pairs;
        self.least = self.least.min(other.least);
        self.below_one += other.below_one;
        self.piercing += other.piercing;
        for (bin, more) in self.histogram.iter_mut().zip(&other.histogram) {
            *bin += more;
        }
        self.worst.extend(other.worst);
        self.keep_worst();
        self
    }
}

/// Worst first. Equal ratios are ordered along the yarns, so the order of the search does not
/// matter.
fn by_ratio(a: &Contact, b: &Contact) -> Ordering {
    let place = |contact: &Contact| contact.places.map(|place| (place.yarn, place.interval));
    a.ratio.total_cmp(&b.ratio).then_with(|| place(a).cmp(&place(b)))
}
