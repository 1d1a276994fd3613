//! Levels by place: the layers of a figured double cloth change places.

use rayon::prelude::*;
use texere_core::crossings::{Level, Set};

use super::levels::{Lying, SIDE_BY_SIDE, STACKED};
use super::{BySet, Drawdown};

/// The numbers of crossing threads, on one side of a crossing, by which two neighbours are compared
/// there. Sixteen hold a repeat of 8-end satin in each of two layers, and four that of plain weave.
/// Fewer are needed inside small figures. With twice the values, `small_figures_are_found` is red;
/// with half, no test is.
const NEAR: [usize; 3] = [4, 8, 16];

/// The fewest crossing threads that pass between two neighbours, one of which lies above the other.
/// A single one passes between neighbours of 3/3 twill, and others further on pass the other way.
/// With half the value, and with twice, `layers_that_change_places_are_found_by_place` is red.
const PASSING: u32 = 2;

/// The least share of crossings at which both threads lie in one of two layers, in a figured double
/// cloth. The rest may be single cloth. With half the value,
/// `threads_without_any_order_lie_side_by_side` is red; with twice, `small_figures_are_found`.
const DOUBLE: f64 = 0.5;

/// The least share of crossings at which a thread lies in another layer than in the cloth as a
/// whole, if that is a double cloth. Stitches also look like a change, but take less of a cloth.
/// With half the value, and with twice, no test is red.
const CHANGED: f64 = 0.05;

/// The largest distance, in threads along a thread, at which crossings near a change of layers
/// count as single cloth. There, threads pass from layer to layer between one another, and the
/// cloth is drawn like single cloth. 0 to 6 were tried. Of double plain weave whose layers have
/// threads every 2.6 diameters, the clearance is 0.82 with 0, 0.90 with 1, 0.98 with 3 and 0.96
/// with 4 (`layers_change_places`).
const OUTLINE: usize = 3;

impl Drawdown {
    /// The levels of a double cloth at each crossing, if this is one whose layers change places.
    /// Where the cloth is single, and where layers change places, there is one level. `whole` is
    /// the level of each thread in the cloth as a whole.
    pub(super) fn figured(&self, whole: &[Vec<Level>; 2]) -> Option<BySet<Vec<Level>>> {
        let are_double = |levels: &[Level]| {
            let double = levels.iter().filter(|level| level.of == 2).count();
            double as f64 >= DOUBLE * levels.len() as f64
        };
        let mut warp = self.levels_by_place(Set::Warp);
        if !are_double(&warp) {
            return None;
        }
        let mut weft = self.levels_by_place(Set::Weft);
        for (end, pick) in warp.iter_mut().zip(&mut weft) {
            if end.of != pick.of {
                [*end, *pick] = [Level::SINGLE; 2];
            }
        }
        if !are_double(&warp) {
            return None;
        }
        let [ends, picks] = [self.ends(), self.picks()];
        let has_changed = |number: &usize| {
            let whole = [whole[0][number % ends], whole[1][number / ends]];
            warp[*number].of == 2 && [warp[*number], weft[*number]] != whole
        };
        let changed = (0..ends * picks).filter(has_changed).count();
        if (changed as f64) < CHANGED * warp.len() as f64 {
            return None;
        }
        let changes = |number: usize| {
            let [end, pick] = [number % ends, number / ends];
            (1..=OUTLINE).any(|steps| {
                let [across, along] = [ends, picks].map(|count| [steps % count, count - steps % count]);
                along.iter().any(|by| warp[(pick + by) % picks * ends + end] != warp[number])
                    || across.iter().any(|by| weft[pick * ends + (end + by) % ends] != weft[number])
            })
        };
        let outline: Vec<usize> = (0..ends * picks).filter(|&number| changes(number)).collect();
        for number in outline {
            [warp[number], weft[number]] = [Level::SINGLE; 2];
        }
        Some(BySet { warp, weft })
    }

    /// The level of a set's thread at each crossing.
    fn levels_by_place(&self, set: Set) -> Vec<Level> {
        let (count, others) = (self.threads(set), self.threads(set.other()));
        let lying: Vec<Vec<Lying>> =
            (0..count).into_par_iter().map(|thread| self.lying_along(set, thread)).collect();
        let across: Vec<Vec<Level>> = (0..others)
            .into_par_iter()
            .map(|other| levels(&lying.iter().map(|along| along[other]).collect::<Vec<_>>()))
            .collect();
        let [ends, picks] = [self.ends(), self.picks()];
        let level = |number: usize| match set {
            Set::Warp => across[number / ends][number % ends],
            Set::Weft => across[number % ends][number / ends],
        };
        (0..ends * picks).map(level).collect()
    }

    /// How a thread and the next one lie at each thread that crosses them. Where layers change
    /// places, the crossing threads before the place and those after it disagree. Therefore only
    /// crossing threads on one side count. The side and their number, one of [`NEAR`], are those
    /// with the clearest verdict.
    fn lying_along(&self, set: Set, thread: usize) -> Vec<Lying> {
        let (count, others) = (self.threads(set), self.threads(set.other()));
        // Running sums over the crossing threads, twice round the cloth: how many before a place
        // have the first thread above, and how many the second.
        let mut before = vec![[0_u32; 2]];
        before.extend((0..2 * others + NEAR[NEAR.len() - 1]).scan([0; 2], |[first, second], other| {
            let [one, two] = self.passing(set, [thread, (thread + 1) % count], other % others);
            (*first, *second) = (*first + one, *second + two);
            Some([*first, *second])
        }));
        let sum = |from: usize, near: usize| [0, 1].map(|of| before[from + near][of] - before[from][of]);
        (0..others)
            .map(|other| {
                let sides = NEAR.into_iter().flat_map(|near| {
                    let near = near.min(others);
                    [sum(other + others + 1 - near, near), sum(other, near)]
                });
                sides
                    .filter(|[first, second]| *first.max(second) >= PASSING)
                    .filter(|passing| Lying::of(*passing) != Lying::SideBySide)
                    .max_by_key(|[first, second]| first.abs_diff(*second))
                    .map_or(Lying::SideBySide, Lying::of)
            })
            .collect()
    }
}

/// The levels of all threads at a thread that crosses them. Runs of threads side by side lie on the
/// upper of two levels if they lie above a run beside them and below none, and on the lower one the
/// other way round. All lie side by side if there are fewer than two runs for each five threads on
/// the two levels.
fn levels(lying: &[Lying]) -> Vec<Level> {
    let count = lying.len();
    let mut levels = vec![Level::SINGLE; count];
    // The last thread of each run.
    let lasts: Vec<usize> = (0..count).filter(|&thread| lying[thread] != Lying::SideBySide).collect();
    let length = |run: usize| {
        let before = lasts[(run + lasts.len() - 1) % lasts.len()];
        (lasts[run] + count - before - 1) % count + 1
    };
    for run in 0..lasts.len() {
        let [before, after] = [lasts.len() - 1, 1].map(|steps| (run + steps) % lasts.len());
        let is_stacked = |beside: usize| [run, beside].iter().all(|&run| length(run) <= SIDE_BY_SIDE);
        let [below, above] = [(before, lying[lasts[before]]), (after, lying[lasts[run]])]
            .map(|(beside, lying)| is_stacked(beside).then_some(lying));
        let is_above = below == Some(Lying::SecondAbove) || above == Some(Lying::FirstAbove);
        let is_below = below == Some(Lying::FirstAbove) || above == Some(Lying::SecondAbove);
        if is_above != is_below {
            let level = Level { number: is_above.into(), of: 2 };
            let first = lasts[run] + count + 1 - length(run);
            (first..=lasts[run] + count).for_each(|thread| levels[thread % count] = level);
        }
    }
    let double = levels.iter().filter(|level| level.of == 2).count();
    if (lasts.len() as f64) < STACKED * double as f64 {
        return vec![Level::SINGLE; count];
    }
    levels
}
