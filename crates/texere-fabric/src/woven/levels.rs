//! Levels of threads: which threads of a set lie above other threads of the same set.

use super::{BySet, Drawdown};

/// The least ratio of crossing threads at which one of two neighbouring threads counts as lying
/// above the other. Of the crossing threads that pass between the two, at least this many must pass
/// below the upper thread and above the lower one for each one that passes the other way. The
/// others are then stitches of a double cloth.
const STITCHED: u64 = 4;

/// The longest run of neighbouring threads of one level in a cloth of several layers. A longer run
/// is a stripe: a satin stripe lies higher than the plain weave beside it, but not over it.
const SIDE_BY_SIDE: usize = 4;

/// The least share of pairs of neighbours in which one thread lies above the other, in a cloth of
/// several layers. In a cloth with three threads of the face to one of the back this share is a
/// half.
const STACKED: f64 = 0.4;

/// The most passes in the search for levels. A cloth with this number of levels needs no more. If
/// neighbours contradict one another, the search would never end without this limit.
const LEVELS_MAX: u32 = 8;

/// How two neighbouring threads of a set lie.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Neighbours {
    SideBySide,
    FirstAbove,
    SecondAbove,
}

impl Drawdown {
    /// The level of each end and of each pick among its set, 0 for the lowest. Threads of one level
    /// lie side by side, threads of different levels above one another. A double cloth has two
    /// levels of ends and of picks, a weft-backed cloth two of picks. Most cloths have one.
    ///
    /// A pick lies above the next one if ends pass between the two, below the first pick and above
    /// the second. If about as many ends pass the other way, as in plain weave, twills and satins,
    /// both picks lie side by side. If at most one in five of the ends between the two pass the
    /// other way, they are stitches between two layers and do not count. Ends are compared in the
    /// same way. More than four threads side by side are a stripe, which lies neither above its
    /// neighbours nor below them. All threads lie side by side if neighbours contradict one another
    /// round the cloth, or if in fewer than two of five pairs of neighbours one thread lies above
    /// the other.
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

/// How two neighbours lie, given the number of crossing threads that have the first one above, and
/// the number that have the second one above.
const fn neighbours([first, second]: [u64; 2]) -> Neighbours {
    if first > 0 && second * STITCHED <= first {
        Neighbours::FirstAbove
    } else if second > 0 && first * STITCHED <= second {
        Neighbours::SecondAbove
    } else {
        Neighbours::SideBySide
    }
}

/// The lowest levels that agree with all neighbours; 0 for all threads if no levels agree with all,
/// or if in too few pairs of neighbours one lies above the other. The last thread and the first one
/// count as neighbours only if one of them lies above the other, because a cloth need not repeat.
fn levels(neighbours: &[Neighbours]) -> Vec<u32> {
    let count = neighbours.len();
    // Threads side by side form runs: the number of each thread's run, and the length of each run.
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
    // Each pass lifts threads that must lie higher. A pass that lifts none is the last one. There
    // are at most as many passes as levels.
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
