//! The neighbours of each interval: the intervals whose samples may touch its own. Each pair of
//! neighbours is listed once.

use std::f64::consts::PI;
use std::ops::ControlFlow;

use glam::{DVec2, DVec3};

use super::samples::Ball;
use super::{Elastic, RelaxationInterval, RelaxationPlan, RelaxationSamples, RelaxationState};
use crate::backend::{filled, room, room_for};
use crate::work_watch::WorkWatch;
use crate::{BackendError, Ends};

/// The margin of the lists, as a share of the least shell: intervals that are further than this
/// from touching are not listed. With 0.3, lists of rib are made twice as often. With 1.2, a list
/// of stockinette is a third longer. Both take more time. With half the value, and with twice, no
/// test is red.
const MARGIN: f64 = 0.6;

/// The number of neighbours that all intervals together may have in addition to
/// [`NEAR_AN_INTERVAL`] for each interval.
const NEAR_FREE: u64 = 1 << 16;

/// The most neighbours that intervals may have in the mean. Stockinette of a yarn with a thick
/// shell has 45 at most. The number of copies in a [`Grid`] has an equal limit.
const NEAR_AN_INTERVAL: u64 = 256;

/// The number of copies of intervals that are tried between two calls of `watch`. They take a slow
/// core a millisecond.
const CANDIDATES: usize = 1 << 16;

/// A neighbour of an interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RelaxationNear {
    /// The number of the neighbour.
    pub interval: u32,
    /// The image of the neighbour that lies near: the number of repeats along x and y.
    pub image: [i32; 2],
    /// The distance from the start of the interval to that of the neighbour, along the yarn at
    /// rest, mm. Infinite if they are not of one yarn.
    pub along: f64,
}

/// The neighbours of all intervals.
#[derive(Debug, Clone)]
pub struct RelaxationLists {
    starts: Vec<u32>,
    near: Vec<RelaxationNear>,
    /// The state for which the lists were made, and the growth.
    made: (RelaxationState, f64),
    /// The most repeats along x and y that lie between an interval's points and a neighbour's.
    images: DVec2,
}

/// A copy of an interval in an image of the repeat.
#[derive(Clone, Copy)]
struct Copied {
    interval: u32,
    image: [i32; 2],
    ball: Ball,
}

impl RelaxationLists {
    /// Whether the lists still hold every neighbour in `state`, for yarns with the share `growth`
    /// of their thickness. A sample moves by at most 1.25 times the longest move of a control
    /// point.
    #[must_use]
    pub fn hold(&self, plan: &RelaxationPlan, state: &RelaxationState, growth: f64) -> bool {
        let (made, grown) = &self.made;
        let moves = made.points.iter().zip(&state.points).map(|(from, to)| from.distance(*to));
        let images = (self.images * (made.repeat - state.repeat).abs()).element_sum();
        *grown == growth && 2.5 * moves.fold(0.0, f64::max) + images <= margin(plan)
    }

    /// Lists the neighbours of all intervals. `samples` are those of `state`.
    ///
    /// **Errors**: [`BackendError::Crowded`] for too many neighbours, and short memory.
    pub fn new(
        plan: &RelaxationPlan,
        state: &RelaxationState,
        growth: f64,
        samples: &RelaxationSamples,
        watch: WorkWatch<'_>,
    ) -> Result<ControlFlow<(), Self>, BackendError> {
        let intervals = plan.intervals();
        let balls = samples.balls();
        let shells = plan.elastic().iter().map(|elastic| elastic.shell).fold(0.0, f64::max);
        let radius = balls.iter().map(|ball| ball.radius).fold(0.0, f64::max);
        let margin = margin(plan);
        let reach = 2.0 * (radius + growth * shells) + margin;
        let limit = (NEAR_FREE + NEAR_AN_INTERVAL * intervals.len() as u64).min(u64::from(u32::MAX));
        let crowded = BackendError::Crowded { chords: intervals.len() as u64, limit };
        let Some(grid) = Grid::new(balls, state.repeat, reach, limit)? else { return Err(crowded) };
        let (mut starts, mut near) = (room("neighbours", intervals.len() + 1)?, Vec::new());
        starts.push(0);
        let mut unasked = CANDIDATES;
        for ((number, interval), ball) in (0..).zip(intervals).zip(balls) {
            if unasked >= CANDIDATES {
                if watch().is_break() {
                    return Ok(ControlFlow::Break(()));
                }
                unasked = 0;
            }
            let first = near.len();
            let beside = grid.beside(ball.middle).count();
            unasked += beside + 1;
            room_for(&mut near, beside, "neighbours of intervals")?;
            let elastic = &plan.elastic()[interval.yarn as usize];
            let window = following(elastic, growth);
            for copied in grid.beside(ball.middle) {
                // Each pair is listed once.
                if (copied.interval, copied.image) < (number, [0; 2]) {
                    continue;
                }
                let other = &intervals[copied.interval as usize];
                let shells = elastic.shell + plan.elastic()[other.yarn as usize].shell;
                if ball.touches(&copied.ball, growth * shells + margin) {
                    let along = plan.along([interval, other], copied.image);
                    let furthest = (along - interval.length).abs().max((along + other.length).abs());
                    if furthest < window {
                        continue;
                    }
                    near.push(RelaxationNear { interval: copied.interval, image: copied.image, along });
                }
            }
            if near.len() as u64 > limit {
                return Err(crowded);
            }
            near[first..].sort_unstable_by_key(|near| (near.interval, near.image));
            starts.push(near.len() as u32);
        }
        let shifts = (0..plan.yarns().len() as u32).map(|yarn| plan.shift(yarn).abs());
        // A window begins a round before its interval or ends a round after it, and a neighbour's
        // may do the reverse.
        let images = grid.images + 4.0 * shifts.fold(DVec2::ZERO, DVec2::max);
        Ok(ControlFlow::Continue(Self { starts, near, made: (state.clone(), growth), images }))
    }

    /// The neighbours of interval number `interval`.
    #[must_use]
    pub fn of(&self, interval: usize) -> &[RelaxationNear] {
        &self.near[self.starts[interval] as usize..self.starts[interval + 1] as usize]
    }
}

/// The distance along a yarn up to which its samples follow one another and don't touch, mm, if it
/// has the share `growth` of its thickness.
pub(super) fn following(yarn: &Elastic, growth: f64) -> f64 {
    PI * growth * yarn.shell
}

fn margin(plan: &RelaxationPlan) -> f64 {
    MARGIN * plan.elastic().iter().map(|elastic| elastic.shell).fold(f64::INFINITY, f64::min)
}

impl RelaxationPlan {
    /// The distance from the start of one interval to that of an image of another, along the yarn
    /// at rest, mm. Infinite if they are not of one yarn.
    fn along(&self, pair: [&RelaxationInterval; 2], image: [i32; 2]) -> f64 {
        let [one, other] = pair;
        let yarn = &self.yarns()[one.yarn as usize];
        if one.yarn != other.yarn {
            return f64::INFINITY;
        }
        let way = other.along - one.along;
        match yarn.ends {
            Ends::Open if image == [0, 0] => way,
            Ends::Closed if image == [0, 0] => way - yarn.length * (way / yarn.length).round(),
            Ends::Open | Ends::Closed => f64::INFINITY,
            Ends::Repeats(shift) => {
                let axis = usize::from(shift[0] == 0);
                let rounds = image[axis] / shift[axis];
                let goes_on = shift.map(|repeats| repeats.wrapping_mul(rounds)) == image;
                if goes_on { way + f64::from(rounds) * yarn.length } else { f64::INFINITY }
            }
        }
    }
}

/// Copies of intervals, sorted into square cells in x and y.
struct Grid {
    low: DVec2,
    cell: f64,
    cells: [usize; 2],
    starts: Vec<u32>,
    copies: Vec<Copied>,
    /// The furthest images along x and y.
    images: DVec2,
}

impl Grid {
    /// All copies of `balls` that lie within `reach` of the box that holds them. None if these are
    /// more than `limit`.
    fn new(balls: &[Ball], repeat: DVec2, reach: f64, limit: u64) -> Result<Option<Self>, BackendError> {
        let far = DVec2::splat(f64::INFINITY);
        let (low, high) = balls.iter().fold((far, -far), |(low, high), ball| {
            let at = ball.middle.truncate();
            (low.min(at), high.max(at))
        });
        let (low, high) = (low - reach, high + reach);
        let (mut copies, mut furthest) = (Vec::new(), DVec2::ZERO);
        for (interval, ball) in (0..).zip(balls) {
            let at = ball.middle.truncate();
            let images = [0, 1].map(|axis| {
                let length = repeat[axis];
                if length <= 0.0 {
                    return [0.0; 2];
                }
                [((low[axis] - at[axis]) / length).ceil(), ((high[axis] - at[axis]) / length).floor()]
            });
            let count: f64 = images.iter().map(|[first, last]| last - first + 1.0).product();
            // Not a number of copies at all, or too many.
            let fits = copies.len() as f64 + count <= limit as f64;
            if !fits {
                return Ok(None);
            }
            room_for(&mut copies, count as usize, "copies of intervals")?;
            furthest = furthest.max(DVec2::from(images.map(|[first, last]| last.max(-first))));
            let [across, along] = images.map(|[first, last]| first as i32..=last as i32);
            for x in across {
                for y in along.clone() {
                    let way = DVec3::new(f64::from(x) * repeat.x, f64::from(y) * repeat.y, 0.0);
                    let ball = Ball { middle: ball.middle + way, ..*ball };
                    copies.push(Copied { interval, image: [x, y], ball });
                }
            }
        }
        // Cells are made so large that there are at most three times as many of them as copies. If
        // a cell is larger than the reach, neighbours still lie in the cells beside it.
        let size = (high - low).max(DVec2::splat(reach));
        let count = copies.len().max(1) as f64;
        let cell = reach.max((size.x * size.y / count).sqrt()).max(size.max_element() / count);
        let cells = [0, 1].map(|axis| (size[axis] / cell) as usize + 1);
        let mut grid = Self {
            low,
            cell,
            cells,
            starts: filled("cells", cells[0] * cells[1] + 1, 0)?,
            copies,
            images: furthest,
        };
        grid.copies.sort_by_cached_key(|copied| index(low, cell, cells, copied.ball.middle));
        for copied in &grid.copies {
            grid.starts[index(low, cell, cells, copied.ball.middle) + 1] += 1;
        }
        for at in 1..grid.starts.len() {
            grid.starts[at] += grid.starts[at - 1];
        }
        Ok(Some(grid))
    }

    /// The copies in the cell of `at` and in the eight cells round it.
    fn beside(&self, at: DVec3) -> impl Iterator<Item = &Copied> {
        let own = index(self.low, self.cell, self.cells, at);
        let [column, row] = [own % self.cells[0], own / self.cells[0]];
        let columns = column.saturating_sub(1)..(column + 2).min(self.cells[0]);
        (row.saturating_sub(1)..(row + 2).min(self.cells[1])).flat_map(move |row| {
            let first = row * self.cells[0];
            let range = self.starts[first + columns.start]..self.starts[first + columns.end];
            &self.copies[range.start as usize..range.end as usize]
        })
    }
}

/// The number of the cell of a place. Places outside lie in the nearest cell.
fn index(low: DVec2, cell: f64, cells: [usize; 2], at: DVec3) -> usize {
    let [column, row] = [0, 1].map(|axis| (((at[axis] - low[axis]) / cell) as usize).min(cells[axis] - 1));
    row * cells[0] + column
}
