//! The drawdown: which thread lies on top at each crossing.

use std::fmt;

use texere_core::backend::zeroed;

use crate::{FabricError, WovenError};

/// The most ends of a cloth, and the most picks.
///
/// The finest silk has 300 ends to the centimetre. A million of these ends are more than thirty
/// metres across.
pub const THREADS_MAX: usize = 1_000_000;

/// The most crossings of a drawdown. A `u32` numbers them, and their bits take half a gigabyte.
pub(super) const CROSSINGS_MAX: u64 = 1 << 32;

/// Bits in a word.
pub(super) const WORD: usize = u64::BITS as usize;

/// A bit for each crossing of an end and a pick, which says whether the warp is up, that is, on the
/// face of the cloth.
///
/// Ends are counted from 0 at the left. Picks are counted from 0 at the bottom, where weaving
/// starts.
///
/// ```
/// use texere_fabric::Drawdown;
/// let plain = Drawdown::from_fn(4, 6, |end, pick| (end + pick) % 2 == 0)?;
/// assert!(plain.up(0, 0) && !plain.up(1, 0) && plain.up(1, 1));
/// # Ok::<(), texere_fabric::FabricError>(())
/// ```
#[derive(Clone, PartialEq, Eq)]
pub struct Drawdown {
    ends: usize,
    picks: usize,
    /// Words in a pick's row.
    row: usize,
    /// The rows of all picks, one after another. End 0 is the lowest bit of a row. Bits past the
    /// last end are 0.
    words: Vec<u64>,
}

impl fmt::Debug for Drawdown {
    /// Shows the size alone, since the bits of a damask are too many to print.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Drawdown")
            .field("ends", &self.ends)
            .field("picks", &self.picks)
            .finish_non_exhaustive()
    }
}

impl Drawdown {
    /// A drawdown in which the warp is down at every crossing.
    ///
    /// **Errors**: [`WovenError::Size`] for no ends, no picks, or more than [`THREADS_MAX`] of
    /// either, [`WovenError::Crossings`] for more than 2³² crossings, and
    /// [`FabricError::OutOfMemory`].
    pub fn new(ends: usize, picks: usize) -> Result<Self, FabricError> {
        if !(1..=THREADS_MAX).contains(&ends) || !(1..=THREADS_MAX).contains(&picks) {
            return Err(WovenError::Size { ends, picks, limit: THREADS_MAX }.into());
        }
        let crossings = ends as u64 * picks as u64;
        if crossings > CROSSINGS_MAX {
            return Err(WovenError::Crossings { ends, picks, crossings, limit: CROSSINGS_MAX }.into());
        }
        let row = ends.div_ceil(WORD);
        Ok(Self { ends, picks, row, words: zeroed("a drawdown", row as u64 * picks as u64)? })
    }

    /// A drawdown whose warp is up where `up(end, pick)` is true.
    ///
    /// **Errors**: the errors of [`Drawdown::new`].
    pub fn from_fn(
        ends: usize,
        picks: usize,
        mut up: impl FnMut(usize, usize) -> bool,
    ) -> Result<Self, FabricError> {
        let mut drawdown = Self::new(ends, picks)?;
        for (pick, row) in drawdown.words.chunks_exact_mut(drawdown.row).enumerate() {
            for end in 0..ends {
                row[end / WORD] |= u64::from(up(end, pick)) << (end % WORD);
            }
        }
        Ok(drawdown)
    }

    /// A drawdown that repeats `repeat.0` ends and `repeat.1` picks. `up(end, pick)` says whether
    /// the warp is up at a crossing of the repeat. It is called once for each crossing of the
    /// repeat that the cloth has.
    ///
    /// **Errors**: the errors of [`Drawdown::new`].
    ///
    /// ```
    /// use texere_fabric::Drawdown;
    /// let stripes = Drawdown::repeating(5, 3, (2, 1), |end, _| end == 0)?;
    /// assert!(stripes.up(4, 2) && !stripes.up(3, 2));
    /// # Ok::<(), texere_fabric::FabricError>(())
    /// ```
    pub fn repeating(
        ends: usize,
        picks: usize,
        repeat: (usize, usize),
        mut up: impl FnMut(usize, usize) -> bool,
    ) -> Result<Self, FabricError> {
        let mut cloth = Self::new(ends, picks)?;
        let (width, height) = (repeat.0.max(1), repeat.1.max(1));
        for pick in 0..picks.min(height) {
            let row = cloth.row_mut(pick);
            for end in 0..ends {
                let raised = match end.checked_sub(width) {
                    None => u64::from(up(end, pick)),
                    Some(same) => row[same / WORD] >> (same % WORD) & 1,
                };
                row[end / WORD] |= raised << (end % WORD);
            }
        }
        for pick in height..picks {
            cloth.copy_pick(pick - height, pick);
        }
        Ok(cloth)
    }

    /// Number of ends.
    #[must_use]
    pub const fn ends(&self) -> usize {
        self.ends
    }

    /// Number of picks.
    #[must_use]
    pub const fn picks(&self) -> usize {
        self.picks
    }

    /// Whether the warp is up where `end` and `pick`, both counted from 0, cross; `false` outside
    /// the cloth.
    #[must_use]
    pub fn up(&self, end: usize, pick: usize) -> bool {
        end < self.ends
            && pick < self.picks
            && self.words[pick * self.row + end / WORD] >> (end % WORD) & 1 == 1
    }

    /// Puts the warp up or down where `end` and `pick`, both counted from 0, cross.
    ///
    /// **Errors**: [`WovenError::NoCrossing`] for a crossing outside the cloth.
    pub fn set(&mut self, end: usize, pick: usize, up: bool) -> Result<(), WovenError> {
        if end >= self.ends || pick >= self.picks {
            return Err(WovenError::NoCrossing {
                end: end.saturating_add(1),
                pick: pick.saturating_add(1),
                ends: self.ends,
                picks: self.picks,
            });
        }
        let word = &mut self.words[pick * self.row + end / WORD];
        *word = *word & !(1 << (end % WORD)) | u64::from(up) << (end % WORD);
        Ok(())
    }

    /// For each end, the number of picks on top of which it lies.
    pub(super) fn ups_of_ends(&self) -> Vec<u64> {
        let mut ups = vec![0; self.ends];
        for (word, ups) in ups.chunks_mut(WORD).enumerate() {
            // Sixty-four ends are counted at a time. Each word of `digits` holds one binary digit
            // of all their counts.
            let mut digits: Vec<u64> = Vec::new();
            for row in self.words.chunks_exact(self.row) {
                let mut carry = row[word];
                for digit in &mut digits {
                    (*digit, carry) = (*digit ^ carry, *digit & carry);
                }
                if carry != 0 {
                    digits.push(carry);
                }
            }
            for (end, ups) in ups.iter_mut().enumerate() {
                *ups = digits.iter().rev().fold(0, |higher, digit| 2 * higher + (digit >> end & 1));
            }
        }
        ups
    }

    /// For each pick, the number of ends on top of which it lies.
    pub(super) fn downs_of_picks(&self) -> Vec<u64> {
        let ups = |row: &[u64]| row.iter().map(|word| u64::from(word.count_ones())).sum::<u64>();
        self.words.chunks_exact(self.row).map(|row| self.ends as u64 - ups(row)).collect()
    }

    /// The words of the row of `pick`, which must lie within the cloth. End 0 is the lowest bit of
    /// the first word.
    pub(super) fn row_mut(&mut self, pick: usize) -> &mut [u64] {
        &mut self.words[pick * self.row..][..self.row]
    }

    /// Makes pick `to` a copy of pick `from`.
    pub(super) fn copy_pick(&mut self, from: usize, to: usize) {
        self.words.copy_within(from * self.row..(from + 1) * self.row, to * self.row);
    }

    /// Inverts the drawdown: each crossing that was up is down, and the other way round. This is
    /// the cloth turned over, without being mirrored.
    pub(super) fn invert(&mut self) {
        let last = u64::MAX >> (self.row * WORD - self.ends);
        for row in self.words.chunks_exact_mut(self.row) {
            for word in row.iter_mut() {
                *word = !*word;
            }
            if let Some(word) = row.last_mut() {
                *word &= last;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn set_changes_one_crossing_alone() {
        let mut drawdown = Drawdown::new(130, 3).unwrap();
        for (end, pick) in [(0, 0), (63, 1), (64, 1), (129, 2)] {
            drawdown.set(end, pick, true).unwrap();
            let up: Vec<_> = (0..3)
                .flat_map(|j| (0..130).map(move |i| (i, j)))
                .filter(|&(i, j)| drawdown.up(i, j))
                .collect();
            assert_eq!(up, [(end, pick)]);
            drawdown.set(end, pick, false).unwrap();
        }
        assert_eq!(drawdown, Drawdown::new(130, 3).unwrap());
    }

    #[test]
    fn outside_the_cloth_nothing_is_up_and_nothing_can_be_set() {
        let mut drawdown = Drawdown::from_fn(65, 2, |_, _| true).unwrap();
        assert!(drawdown.up(64, 1));
        assert!(!drawdown.up(65, 0) && !drawdown.up(0, 2) && !drawdown.up(usize::MAX, usize::MAX));
        assert_eq!(
            drawdown.set(65, 0, true),
            Err(WovenError::NoCrossing { end: 66, pick: 1, ends: 65, picks: 2 })
        );
        assert!(drawdown.set(usize::MAX, usize::MAX, true).is_err());
    }

    #[test]
    fn threads_are_counted_where_they_lie_on_top() {
        for (ends, picks) in [(1, 1), (64, 70), (65, 3), (130, 200)] {
            let up = |end: usize, pick: usize| (end * end + 3 * pick + end * pick) % 7 < end % 9;
            let drawdown = Drawdown::from_fn(ends, picks, up).unwrap();
            let ups = |end| (0..picks).filter(|&pick| up(end, pick)).count() as u64;
            let downs = |pick| (0..ends).filter(|&end| !up(end, pick)).count() as u64;
            assert_eq!(drawdown.ups_of_ends(), (0..ends).map(ups).collect::<Vec<_>>());
            assert_eq!(drawdown.downs_of_picks(), (0..picks).map(downs).collect::<Vec<_>>());
        }
    }

    #[test]
    fn inverting_leaves_nothing_past_the_last_end() {
        for ends in [1, 63, 64, 65, 128] {
            let mut drawdown = Drawdown::new(ends, 2).unwrap();
            drawdown.invert();
            assert_eq!(drawdown, Drawdown::from_fn(ends, 2, |_, _| true).unwrap());
        }
    }

    #[test]
    fn sizes_are_checked_before_memory_is_taken() {
        assert!(matches!(Drawdown::new(0, 5), Err(FabricError::Woven(WovenError::Size { ends: 0, .. }))));
        assert!(matches!(
            Drawdown::new(5, usize::MAX),
            Err(FabricError::Woven(WovenError::Size { picks: usize::MAX, .. }))
        ));
        assert!(matches!(
            Drawdown::new(1_000_000, 1_000_000),
            Err(FabricError::Woven(WovenError::Crossings { crossings: 1_000_000_000_000, .. }))
        ));
    }
}
