//! The kinds of ends and picks of a drawdown, and its repeat. Ends of one kind are up at the same
//! picks. Picks of one kind have the same ends up.

use std::collections::HashMap;
use std::hash::Hash;

use texere_fabric::{Draft, Drawdown, Shedding};

use super::super::WriteError;

/// The most shafts and treadles of a draft with a tie-up. A draft that needs more of either has a
/// lift plan.
const TIED_MAX: usize = 100;

/// Threads by kind. Threads of one kind have equal keys.
pub(super) struct Kinds {
    /// The kind of each thread. Kinds are numbered from 0 in the order of their first threads.
    pub(super) of: Vec<u32>,
    /// The first thread of each kind.
    pub(super) firsts: Vec<usize>,
}

impl Kinds {
    pub(super) fn new<K: Hash + Eq>(count: usize, key: impl Fn(usize) -> K) -> Self {
        let mut known = HashMap::new();
        let mut firsts = Vec::new();
        let of = (0..count).map(|thread| {
            *known.entry(key(thread)).or_insert_with(|| {
                firsts.push(thread);
                firsts.len() as u32 - 1
            })
        });
        let of = of.collect();
        Self { of, firsts }
    }

    /// The kind of most threads.
    pub(super) fn commonest(&self) -> usize {
        let mut counts = vec![0_usize; self.firsts.len()];
        self.of.iter().for_each(|kind| counts[*kind as usize] += 1);
        (0..counts.len()).rev().max_by_key(|kind| counts[*kind]).unwrap_or(0)
    }
}

/// The kinds of ends and picks of a drawdown.
pub(super) struct Interlacing<'a> {
    drawdown: &'a Drawdown,
    ends: Kinds,
    picks: Kinds,
}

impl<'a> Interlacing<'a> {
    pub(super) fn new(drawdown: &'a Drawdown) -> Self {
        let picks =
            Kinds::new(drawdown.picks(), |pick| packed(drawdown.ends(), |end| drawdown.up(end, pick)));
        let ends = Kinds::new(drawdown.ends(), |end| {
            packed(picks.firsts.len(), |kind| drawdown.up(end, picks.firsts[kind]))
        });
        Self { drawdown, ends, picks }
    }

    /// The ends and the picks of the drawdown's repeat.
    pub(super) fn repeat(&self) -> [usize; 2] {
        [&self.ends, &self.picks].map(|kinds| period(&kinds.of))
    }

    /// A draft with a shaft for each kind of end. It has a treadle for each kind of pick if there
    /// are at most [`TIED_MAX`] of each, else a lift plan.
    ///
    /// **Errors**: [`WriteError::TextTooLarge`] if the lift plan alone is larger than `limit`.
    pub(super) fn draft(&self, format: &'static str, limit: u64) -> Result<Draft, WriteError> {
        let shafts = &self.ends.firsts;
        let lifted = |kind: usize| {
            let up = move |end: usize| self.drawdown.up(end, self.picks.firsts[kind]);
            (1..).zip(shafts).filter(move |(_, end)| up(**end)).map(|(shaft, _)| shaft)
        };
        let threading = self.ends.of.iter().map(|kind| vec![kind + 1]).collect();
        let kinds = 0..self.picks.firsts.len();
        let shedding = if shafts.len().max(kinds.len()) <= TIED_MAX {
            let treadling = self.picks.of.iter().map(|kind| vec![kind + 1]).collect();
            Shedding::TieUp { tie_up: kinds.map(|kind| lifted(kind).collect()).collect(), treadling }
        } else {
            let counts: Vec<_> = kinds.map(|kind| lifted(kind).count() as u64).collect();
            // Each number takes at least a digit and a separator.
            let bytes = self.picks.of.iter().map(|kind| 2 * counts[*kind as usize]).sum();
            if bytes > limit {
                return Err(WriteError::TextTooLarge { format, bytes, limit });
            }
            Shedding::LiftPlan(self.picks.of.iter().map(|kind| lifted(*kind as usize).collect()).collect())
        };
        Ok(Draft { threading, shedding, rising_shed: true })
    }
}

/// `count` bits, packed into words.
fn packed(count: usize, bit: impl Fn(usize) -> bool) -> Vec<u64> {
    let word = |from: usize| {
        (from..count.min(from + 64)).fold(0, |word, at| word | u64::from(bit(at)) << (at - from))
    };
    (0..count).step_by(64).map(word).collect()
}

/// The number of items after which `items` repeat. The last repeat may be incomplete.
///
/// **Source**: Knuth, Morris and Pratt, "Fast pattern matching in strings", SIAM Journal on
/// Computing 6, 1977.
pub(super) fn period<T: PartialEq>(items: &[T]) -> usize {
    // For each prefix of `items`, the length of its longest proper prefix that is also a suffix of
    // it.
    let mut borders = vec![0; items.len()];
    for at in 1..items.len() {
        let mut border = borders[at - 1];
        while border > 0 && items[at] != items[border] {
            border = borders[border - 1];
        }
        borders[at] = border + usize::from(items[at] == items[border]);
    }
    items.len() - borders.last().unwrap_or(&0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_period_is_the_shortest_that_gives_all_items_back() {
        for (items, expected) in [
            ("", 0),
            ("a", 1),
            ("aaaa", 1),
            ("abab", 2),
            ("ababa", 2),
            ("abba", 3),
            ("aabaaab", 4),
            ("abcd", 4),
        ] {
            let items = items.as_bytes();
            assert_eq!(period(items), expected);
            // A search through all periods gives the same result.
            let holds = |period: &usize| (*period..items.len()).all(|at| items[at] == items[at - period]);
            assert_eq!((1..items.len()).find(holds).unwrap_or(items.len()), expected);
        }
    }
}
