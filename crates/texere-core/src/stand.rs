//! The stand of a yarn: whether it is steep, and the up directions that its outline leans by.

use std::sync::Arc;

use glam::Vec3;

use crate::ControlPoint;
use crate::definitions::{Basis, Turn, VERTICAL};
use crate::interval::{intervals, neighbours, tangent};
use crate::lean::Leaning;
use crate::steep::{UPRIGHT_TURN, carried_steps, is_flat, runs_straight, upright_turns_beyond, wrings};

/// The largest turn of the upright frame of a flattened yarn within a control interval, turns: 15
/// degrees. A flattened yarn whose frame turns by more gets ups. The angle is also the largest turn
/// of the ups from control point to control point while they return to the upright frame.
///
/// With 20 degrees, rings of a flat jersey turn by up to 34 degrees, because its tangents bend
/// between two points (`every_design_is_drawn_without_wringing_when_its_yarns_are_flat`). With a
/// smaller angle, a quarter of a turn needs more points, and the sections of a flat yarn are out of
/// the plane of their cloth for longer.
const HANDED_OVER: f32 = 15.0 / 360.0;

/// The squared sine of 15 degrees. Where a flattened yarn runs nearer to z than this angle, its
/// upright frame does not count. In a binder that goes straight down through the cloth, tiny
/// sideways moves decide the direction of that frame's side. Without this limit a binder turns on
/// its way down, and is still turned where it lies level again
/// (`a_flat_yarn_stands_upright_where_it_lies_flat`). With half the value, and with twice, no test
/// is red.
const NEAR_POLE: f32 = 0.067;

/// The number of points before and after one lap of a closed yarn that the lap's ups depend on. In
/// this many steps of [`HANDED_OVER`] a frame makes a full turn.
const LAP_POINTS: usize = 24;

/// Whether a yarn is steep, and the up directions of its outline if it leans.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Stand {
    pub(crate) steep: bool,
    pub(crate) leaning: Option<Arc<Leaning>>,
}

impl Stand {
    /// The stand of the yarn through `points`, with given up directions or without.
    ///
    /// A flattened yarn without given ups gets ups if its upright frame turns too fast, or if the
    /// yarn is vertical at a control point.
    pub(crate) fn of(points: &[ControlPoint], closed: bool, ups: Option<&[Vec3]>) -> Self {
        let given = ups.is_some();
        let upright = Self { steep: false, leaning: None };
        let ups = match ups {
            Some(ups) => ups.to_vec(),
            None if runs_straight(points, closed) => return upright,
            None if !is_flat(points) => {
                return Self { steep: upright_turns_beyond(points, closed, UPRIGHT_TURN), ..upright };
            }
            None => {
                let tangents: Vec<_> =
                    (0..points.len()).map(|point| tangent(points, closed, point)).collect();
                // On a vertical yarn the upright frame's side is +y by convention, and does not
                // turn with the cloth.
                let stands_on_end = tangents.iter().any(|tangent| level(tangent) < VERTICAL);
                if !stands_on_end && !upright_turns_beyond(points, closed, HANDED_OVER) {
                    return upright;
                }
                handed_over(points, closed, &tangents)
            }
        };
        let steep = wrings(points, closed, &ups);
        Self { steep, leaning: Some(Arc::new(Leaning { ups, points: points.to_vec(), given })) }
    }
}

/// The ups of a flattened yarn. They are those of the upright frame where that frame turns slowly.
/// Elsewhere, and near the vertical, they are carried along the yarn, and turned by at most
/// [`HANDED_OVER`] from point to point towards the upright frame further on.
fn handed_over(points: &[ControlPoint], closed: bool, tangents: &[Vec3]) -> Vec<Vec3> {
    let count = points.len();
    // The turn of a carried frame against the upright one at each point.
    let mut rolls = vec![0.0];
    for interval in intervals(points, closed) {
        let window = neighbours(points, closed, interval);
        rolls.push(rolls[interval] + carried_steps(&window).map(|step| f64::from(step.turns())).sum::<f64>());
    }
    // For a closed yarn, several laps are computed, so that the middle lap has enough points before
    // and after it for a frame to return by half a turn.
    let laps = if closed { 2 * LAP_POINTS.div_ceil(count) + 1 } else { 1 };
    let whole = rolls[rolls.len() - 1];
    let mut before: Option<f64> = None;
    let asked: Vec<_> = (0..laps * count)
        .map(|place| {
            let (lap, point) = (place / count, place % count);
            let counts = level(&tangents[point]) > NEAR_POLE;
            let upright = counts.then(|| -rolls[point] - lap as f64 * whole)?;
            // An outline that is turned by half a turn is the same outline.
            let near = before.map_or(upright, |before| upright - ((upright - before) * 2.0).round() / 2.0);
            before = Some(near);
            before
        })
        .collect();
    let turns = if closed && asked.iter().all(Option::is_none) {
        // No point asks for a direction. The turn of a lap is spread over the lap's points, after
        // whole half turns are taken from it, because they leave an outline the same.
        let left = whole - (whole * 2.0).round() / 2.0;
        (0..laps * count)
            .map(|place| -whole * (place / count) as f64 - left * (place % count) as f64 / count as f64)
            .collect()
    } else {
        followed(&asked)
    };
    let lap = laps / 2;
    (0..count)
        .map(|point| {
            let lean = turns[lap * count + point] + lap as f64 * whole + rolls[point];
            Basis::upright(tangents[point]).rolled(Turn::from_turns(lean as f32)).up
        })
        .collect()
}

/// The squared sine of the angle between a tangent and z.
fn level(tangent: &Vec3) -> f32 {
    tangent.truncate().length_squared()
}

/// The turns nearest to those asked for, one per place, whose steps are at most [`HANDED_OVER`].
/// They lie half way between two bounds: the highest turns that nowhere exceed those asked for, and
/// the lowest turns that nowhere fall below them.
fn followed(asked: &[Option<f64>]) -> Vec<f64> {
    let step = f64::from(HANDED_OVER);
    let bound = |sign: f64| {
        let mut bound: Vec<_> =
            asked.iter().map(|turn| turn.map_or(f64::INFINITY, |turn| sign * turn)).collect();
        for place in 1..bound.len() {
            bound[place] = bound[place].min(bound[place - 1] + step);
        }
        for place in (1..bound.len()).rev() {
            bound[place - 1] = bound[place - 1].min(bound[place] + step);
        }
        bound
    };
    let halfway = |(above, below): (f64, f64)| if above.is_finite() { (above - below) / 2.0 } else { 0.0 };
    bound(1.0).into_iter().zip(bound(-1.0)).map(halfway).collect()
}
