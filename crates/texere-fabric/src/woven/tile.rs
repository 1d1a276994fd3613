//! One repeat of woven cloth amid copies of its threads.

use super::{Drawdown, Woven};
use crate::FabricError;

/// Number of threads beyond the longest float that lie round a repeat. A thread's bend depends on
/// the crossings at both ends of its float, and on the next ones. With 1 a tile of plain weave is
/// off by .05 mm at its edges, with 2 by nothing (`tiles_go_on_at_their_edges`); this is twice
/// that.
const BEYOND: usize = 4;

impl Woven {
    /// One repeat of the cloth with copies of its threads on all sides, and the numbers of threads
    /// before the repeat and in it: ends first, then picks. After a repeat threads lie, cross and
    /// look as before. A cloth in which nothing repeats is its own repeat. The weft does not turn
    /// at selvedges.
    ///
    /// **Errors**: the errors of [`Woven::new`]; the cloth may have too many threads with its
    /// copies.
    pub(crate) fn amid_copies(&self) -> Result<(Self, [[usize; 2]; 2]), FabricError> {
        let repeat = self.repeat_by_look();
        let counts = [self.warp().len(), self.weft().len()];
        let before = self.longest_floats(repeat).map(|float| float + BEYOND);
        // A repeat of two threads may be that of a cloth of one thread.
        let place = |set: usize, thread: usize| {
            (thread + repeat[set] - before[set] % repeat[set]) % repeat[set] % counts[set]
        };
        let size = [0, 1].map(|set| repeat[set] + 2 * before[set]);
        let up = |end, pick| self.drawdown().up(place(0, end), place(1, pick));
        let drawdown = Drawdown::from_fn(size[0], size[1], up)?;
        let warp = (0..size[0]).map(|end| self.warp()[place(0, end)]).collect();
        let weft = (0..size[1]).map(|pick| self.weft()[place(1, pick)]).collect();
        let mut amid = self.like(drawdown, warp, weft)?;
        amid.set_selvedge(false);
        Ok((amid, [before, repeat]))
    }

    /// The most ends that a pick passes on one side in a row, and the most picks that an end does,
    /// in cloth that goes on after `repeat`. A thread that never changes sides counts as far as one
    /// repeat.
    fn longest_floats(&self, repeat: [usize; 2]) -> [usize; 2] {
        let counts = [self.warp().len(), self.weft().len()];
        let up = |end: usize, pick: usize| self.drawdown().up(end % counts[0], pick % counts[1]);
        let longest = |along: usize, lines: usize, up: &dyn Fn(usize, usize) -> bool| {
            let of_line = |line: usize| {
                let (mut longest, mut length) = (1, 1);
                for at in 1..2 * along {
                    let goes_on = up(at % along, line) == up((at - 1) % along, line);
                    length = if goes_on { length + 1 } else { 1 };
                    longest = longest.max(length);
                }
                longest.min(along)
            };
            (0..lines).map(of_line).max().unwrap_or(1)
        };
        [longest(repeat[0], repeat[1], &up), longest(repeat[1], repeat[0], &|pick, end| up(end, pick))]
    }
}
