//! Which threads of a set lie above others of it.

use super::{BySet, Drawdown};

/// A thread lies above the next one where at most one in so many of what they cross says otherwise:
/// the stitches of a double cloth.
const STITCHED: u64 = 4;

/// More threads side by side than that are no layer of a cloth that has several: a satin stripe
/// lies above the plain weave beside it, but not over it.
const SIDE_BY_SIDE: usize = 4;

/// Of a cloth of several layers at least so great a share of neighbours lie above one another:
/// where three threads of the face go to one of the back, a half.
const STACKED: f64 = 0.4;

/// No more levels than that are told apart.
const LEVELS_MAX: u32 = 8;

/// What two neighbours of a set are to one another.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Neighbours {
    SideBySide,
    FirstAbove,
    SecondAbove,
}

impl Drawdown {
    /// The level of each end, and of each pick, among its set: 0 for the lowest one. Threads of one
    /// level lie side by side, those of another one above or below: a double cloth has two levels
    /// of ends and of picks, a weft-backed cloth two of picks. Most cloths have one.
    ///
    /// A pick lies above the next one where ends that lie between both say so: below the first,
    /// above the second. Where as many say the opposite, as in plain weave, twills and satins, both
    /// lie side by side; stitches of two layers, one end in five at most, don't count. Of ends
    /// likewise. Where neighbours contradict one another round the cloth, or fewer than two in five
    /// lie above one another, all threads lie side by side.
    ///
    /// ```
    /// use texere_fabric::{Drawdown, Weave};
    /// assert_eq!(Weave::parse("satin 8(3)")?.drawdown(8, 8)?.levels().warp, [0; 8]);
    /// // Every other end and pick makes a plain cloth over another one of the rest.
    /// let double = Drawdown::from_fn(8, 8, |end, pick| match (end % 2, pick % 2) {
    ///     (0, 0) | (1, 1) => (end / 2 + pick / 2) % 2 == 0,
    ///     (face, _) => face == 0,
    /// })?;
    /// assert_eq!(double.levels().weft, [1, 0, 1, 0, 1, 0, 1, 0]);
    /// # Ok::<(), texere_fabric::FabricError>(())
    /// ```
    #[must_use]
    pub fn levels(&self) -> BySet<Vec<u32>> {
        let [ends, picks] = [self.ends(), self.picks()];
        let mut counts = BySet { warp: vec![[0_u64; 2]; ends], weft: vec![[0_u64; 2]; picks] };
        for (end, pick) in (0..picks).flat_map(|pick| (0..ends).map(move |end| (end, pick))) {
            let up = self.up(end, pick);
            match [up, self.up((end + 1) % ends, pick)] {
                [true, false] => counts.warp[end][0] += 1,
                [false, true] => counts.warp[end][1] += 1,
                _ => {}
            }
            match [up, self.up(end, (pick + 1) % picks)] {
                [false, true] => counts.weft[pick][0] += 1,
                [true, false] => counts.weft[pick][1] += 1,
                _ => {}
            }
        }
        counts.map(|counts| levels(&counts.into_iter().map(neighbours).collect::<Vec<_>>()))
    }
}

/// By how many threads say that the first one lies above, and how many the second one.
const fn neighbours([first, second]: [u64; 2]) -> Neighbours {
    if first > 0 && second * STITCHED <= first {
        Neighbours::FirstAbove
    } else if second > 0 && first * STITCHED <= second {
        Neighbours::SecondAbove
    } else {
        Neighbours::SideBySide
    }
}

/// The lowest levels that agree with all neighbours; 0 for all where none do. What the last thread
/// is to the first one counts where one of them lies above the other: a cloth need not repeat.
fn levels(neighbours: &[Neighbours]) -> Vec<u32> {
    let count = neighbours.len();
    // Threads side by side follow one another: the number of each one's run, and how long runs are.
    let (mut runs, mut lengths) = (vec![0], vec![1]);
    for what in &neighbours[..count - 1] {
        match lengths.last_mut() {
            Some(length) if *what == Neighbours::SideBySide => *length += 1,
            _ => lengths.push(1),
        }
        runs.push(lengths.len() - 1);
    }
    let over = |(thread, what): (usize, &Neighbours)| {
        let [one, two] = [runs[thread], runs[(thread + 1) % count]];
        let stacked = [one, two].iter().all(|&run| lengths[run] <= SIDE_BY_SIDE);
        match what {
            Neighbours::FirstAbove if stacked => Some([one, two]),
            Neighbours::SecondAbove if stacked => Some([two, one]),
            _ => None,
        }
    };
    let over: Vec<[usize; 2]> = neighbours.iter().enumerate().filter_map(over).collect();
    if (over.len() as f64) < STACKED * count as f64 {
        return vec![0; count];
    }
    let mut heights = vec![0_u32; lengths.len()];
    // Each pass lifts what must lie higher; that ends after as many as there are levels.
    for _ in 0..LEVELS_MAX {
        let mut lifted = false;
        for &[above, below] in &over {
            if heights[above] <= heights[below] {
                heights[above] = heights[below] + 1;
                lifted = true;
            }
        }
        if !lifted {
            return runs.into_iter().map(|run| heights[run]).collect();
        }
    }
    vec![0; count]
}
