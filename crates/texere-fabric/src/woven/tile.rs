//! One repeat of woven cloth amid copies of its threads.

use super::{Drawdown, Woven};
use crate::FabricError;

/// How many threads more than the longest float are copied on each side of a repeat. A thread's
/// bend depends on the crossings at both ends of its float, and on the next crossings. With 1, a
/// tile of plain weave is off by .05 mm at its edges. With 2, it is exact
/// (`tiles_go_on_at_their_edges`). The number here is twice as large.
const BEYOND: usize = 4;

impl Woven {
    /// One repeat of the cloth with copies of its threads on all sides. Threads of the next repeat
    /// lie, cross and look like those of this one. A cloth in which nothing repeats is its own
    /// repeat. The weft of the result does not turn at selvedges. The two pairs of numbers are the
    /// threads before the repeat, and the threads in it, ends first and picks second.
    ///
    /// **Errors**: the errors of [`Woven::new`]; with its copies, the cloth may have too many
    /// threads.
    pub(crate) fn amid_copies(&self) -> Result<(Self, [[usize; 2]; 2]), FabricError> {
        let repeat = self.repeat_by_look();
        let counts = [self.warp().len(), self.weft().len()];
        let before = self.longest_floats(repeat).map(|float| float + BEYOND);
        // A repeat has two threads at least, even if the cloth has only one thread.
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

    /// The longest floats of cloth that repeats after `repeat` ends and picks: the most ends in a
    /// row that a pick passes on one side, and the most picks in a row that an end passes on one
    /// side. A thread that never changes sides counts with the length of one repeat.
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
