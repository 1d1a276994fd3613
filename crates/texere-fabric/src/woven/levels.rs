//! Levels of threads: which threads of a set lie above other threads of the same set.

use texere_core::crossings::{Level, Set};

use super::{BySet, Drawdown};

/// The least ratio of crossing threads at which one of two threads counts as lying above the other.
/// Of the crossing threads that pass between the two, at least this many must pass below the upper
/// thread and above the lower one for each one that passes the other way. The others are then
/// stitches of a double cloth. With half the value, and with twice,
/// `stuffers_lie_on_levels_and_binders_pass_them` is red.
const STITCHED: u32 = 4;

/// The longest run of neighbouring threads of one level in a cloth of several layers. A longer run
/// is a stripe: a satin stripe lies higher than the plain weave beside it, but not over it. With
/// half the value, `layers_are_found_in_any_order` is red; with twice, no test is.
pub(super) const SIDE_BY_SIDE: usize = 4;

/// The least share of pairs of neighbours in which one thread lies above the other, in a cloth of
/// several layers. In a cloth with three threads of the face to one of the back this share is a
/// half. With twice the value, `layers_are_found_in_any_order` is red; with half, no test is.
pub(super) const STACKED: f64 = 0.4;

/// The most levels of a set. Without this limit, the search for levels would never end if
/// neighbours contradict one another: if each thread lies above the next one, and the last thread
/// above the first.
const LEVELS_MAX: u8 = 8;

/// A thread is a binder if, at more than this share of its crossings, it lies on the side that is
/// wrong for a thread that keeps its level. A binder that passes two levels, and lies on the face
/// at half of its crossings, is on the wrong side at a quarter of them. Wrong sides at up to one
/// crossing in five are stitches. With twice the value,
/// `stuffers_lie_on_levels_and_binders_pass_them` is red; with half, no test is.
const BINDS: f64 = 0.2;

/// How two threads of a set lie.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Lying {
    SideBySide,
    FirstAbove,
    SecondAbove,
}

impl Lying {
    /// How two threads lie, given the number of crossing threads that have the first one above, and
    /// the number that have the second one above.
    pub(super) const fn of([first, second]: [u32; 2]) -> Self {
        if first > 0 && second * STITCHED <= first {
            Self::FirstAbove
        } else if second > 0 && first * STITCHED <= second {
            Self::SecondAbove
        } else {
            Self::SideBySide
        }
    }
}

impl Drawdown {
    /// The level of the end and of the pick at each crossing, pick after pick, and end after end in
    /// each pick. Threads of one level lie side by side, threads of different levels above one
    /// another. A double cloth has two levels of ends and of picks, a weft-backed cloth two of
    /// picks. Most cloths have one.
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
    /// If only one set has levels, threads of the other set may be binders ([`Level::BINDER`]),
    /// which pass from the face to the back. The levels of the threads between them are then sought
    /// without the binders. The stuffers of an orthogonal weave have levels of their own.
    ///
    /// Where the layers of a figured double cloth change places, its threads change levels. If both
    /// sets have one level in the cloth as a whole, or both have two, neighbours are therefore
    /// compared once more at each crossing, by up to sixteen crossing threads on one side of it. In
    /// this way two layers can be found, but not three. Within three threads of a change of layers,
    /// all threads lie side by side.
    ///
    /// ```
    /// use texere_core::crossings::Level;
    /// use texere_fabric::{Drawdown, Weave};
    /// assert_eq!(Weave::parse("satin 8(3)")?.drawdown(8, 8)?.levels().warp, [Level::SINGLE; 64]);
    /// // Every other end and pick makes a plain cloth over another one of the rest.
    /// let double = Drawdown::from_fn(8, 8, |end, pick| match (end % 2, pick % 2) {
    ///     (0, 0) | (1, 1) => (end / 2 + pick / 2) % 2 == 0,
    ///     (face, _) => face == 0,
    /// })?;
    /// let [first, second] = [0, 8].map(|crossing| double.levels().weft[crossing]);
    /// assert_eq!((first, second), (Level { number: 1, of: 2 }, Level { number: 0, of: 2 }));
    /// # Ok::<(), texere_fabric::FabricError>(())
    /// ```
    #[must_use]
    pub fn levels(&self) -> BySet<Vec<Level>> {
        let all = Set::BOTH.map(|set| (0..self.threads(set)).collect::<Vec<usize>>());
        let mut whole = Set::BOTH.map(|set| self.levels_of(set, &all[set as usize]));
        for set in Set::BOTH {
            let [own, others] = [set, set.other()].map(|set| &whole[set as usize]);
            if own[0] == Level::SINGLE && others[0] != Level::SINGLE {
                whole[set as usize] = self.levels_between_binders(set, others);
            }
        }
        let all_have = |of: u8| whole.iter().flatten().all(|level| level.of == of);
        if (all_have(1) || all_have(2))
            && let Some(figured) = self.figured(&whole)
        {
            return figured;
        }
        let of_set = |set: Set| {
            let thread = |number: usize| match set {
                Set::Warp => number % self.ends(),
                Set::Weft => number / self.ends(),
            };
            (0..self.ends() * self.picks()).map(|number| whole[set as usize][thread(number)]).collect()
        };
        BySet { warp: of_set(Set::Warp), weft: of_set(Set::Weft) }
    }

    /// The number of threads of a set.
    pub(super) const fn threads(&self, set: Set) -> usize {
        match set {
            Set::Warp => self.ends(),
            Set::Weft => self.picks(),
        }
    }

    /// Whether a thread of `set` lies on top of a thread of the other set.
    fn over(&self, set: Set, thread: usize, other: usize) -> bool {
        match set {
            Set::Warp => self.up(thread, other),
            Set::Weft => !self.up(other, thread),
        }
    }

    /// How often the crossing thread `other` passes between two threads of a set: 1 or 0 with the
    /// first of them above it and the second below, then the other way round.
    pub(super) fn passing(&self, set: Set, threads: [usize; 2], other: usize) -> [u32; 2] {
        match threads.map(|thread| self.over(set, thread, other)) {
            [true, false] => [1, 0],
            [false, true] => [0, 1],
            _ => [0, 0],
        }
    }

    /// The levels of some threads of a set, by all threads that cross them. All are
    /// [`Level::SINGLE`], or none is.
    fn levels_of(&self, set: Set, threads: &[usize]) -> Vec<Level> {
        let lying = |(at, &thread): (usize, &usize)| {
            let next = threads[(at + 1) % threads.len()];
            let passing =
                (0..self.threads(set.other())).map(|other| self.passing(set, [thread, next], other));
            Lying::of(passing.fold([0; 2], |[first, second], [one, two]| [first + one, second + two]))
        };
        let heights = heights(&threads.iter().enumerate().map(lying).collect::<Vec<_>>());
        let of = 1 + heights.iter().max().copied().unwrap_or(0);
        heights.into_iter().map(|number| Level { number, of }).collect()
    }

    /// The levels of a set some of whose threads are binders. `levels` are those of the threads of
    /// the other set.
    fn levels_between_binders(&self, set: Set, levels: &[Level]) -> Vec<Level> {
        let count = self.threads(set);
        // A thread that keeps its level lies above all threads of the other set on lower levels,
        // and below all on higher levels. Among the threads of its own level it may weave.
        let is_binder = |thread: usize| {
            let wrong_at = |home: u8| {
                let is_wrong = |(other, level): &(usize, &Level)| {
                    level.number != home && self.over(set, thread, *other) == (level.number > home)
                };
                levels.iter().enumerate().filter(is_wrong).count()
            };
            let wrong = (0..levels[0].of).map(wrong_at).min().unwrap_or(0);
            wrong as f64 > BINDS * levels.len() as f64
        };
        let (binders, rest): (Vec<usize>, Vec<usize>) = (0..count).partition(|&thread| is_binder(thread));
        let mut found = vec![Level::SINGLE; count];
        if !binders.is_empty() && binders.len() <= rest.len() {
            let of_rest = self.levels_of(set, &rest);
            if of_rest[0] != Level::SINGLE {
                binders.into_iter().for_each(|thread| found[thread] = Level::BINDER);
                rest.into_iter().zip(of_rest).for_each(|(thread, level)| found[thread] = level);
            }
        }
        found
    }
}

/// The lowest levels that agree with all neighbours; 0 for all threads if no levels agree with all,
/// or if in too few pairs of neighbours one lies above the other. The last thread and the first one
/// count as neighbours only if one of them lies above the other, because a cloth need not repeat.
fn heights(lying: &[Lying]) -> Vec<u8> {
    let count = lying.len();
    // Threads side by side form runs: the number of each thread's run, and the length of each run.
    let (mut runs, mut lengths) = (vec![0], vec![1]);
    for what in &lying[..count - 1] {
        match lengths.last_mut() {
            Some(length) if *what == Lying::SideBySide => *length += 1,
            _ => lengths.push(1),
        }
        runs.push(lengths.len() - 1);
    }
    let over = |(thread, what): (usize, &Lying)| {
        let [one, two] = [runs[thread], runs[(thread + 1) % count]];
        let stacked = [one, two].iter().all(|&run| lengths[run] <= SIDE_BY_SIDE);
        match what {
            Lying::FirstAbove if stacked => Some([one, two]),
            Lying::SecondAbove if stacked => Some([two, one]),
            _ => None,
        }
    };
    let over: Vec<[usize; 2]> = lying.iter().enumerate().filter_map(over).collect();
    if (over.len() as f64) < STACKED * count as f64 {
        return vec![0; count];
    }
    let mut heights = vec![0_u8; lengths.len()];
    // Each pass lifts threads that must lie higher. A pass that lifts none is the last one.
    loop {
        let mut lifted = false;
        for &[above, below] in &over {
            if heights[above] <= heights[below] {
                heights[above] = heights[below] + 1;
                lifted = true;
            }
            if heights[above] == LEVELS_MAX {
                return vec![0; count];
            }
        }
        if !lifted {
            return runs.into_iter().map(|run| heights[run]).collect();
        }
    }
}
