//! How a yarn stands: whether it is steep, and which up directions its outline leans by.

use std::sync::Arc;

use glam::Vec3;

use crate::ControlPoint;
use crate::definitions::{Basis, Turn, VERTICAL};
use crate::interval::{intervals, tangent, window};
use crate::lean::Leaning;
use crate::steep::{UPRIGHT_TURN, carried_steps, is_flat, runs_straight, upright_turns_beyond, wrings};

/// By how much the upright frame of a flattened yarn may turn about it within a control interval,
/// and by how much its ups are turned from control point to control point where it is handed over,
/// turns: 15 degrees.
///
/// With 20 rings of a flat jersey turn by up to 34, since its tangents bend between two points
/// (`every_design_is_drawn_without_wringing_when_its_yarns_are_flat`). With less a quarter of a
/// turn takes longer, and the sections of a flat yarn stand off the plane of their cloth for as
/// far.
const HANDED_OVER: f32 = 15.0 / 360.0;

/// The squared sine of the angle to z within which the upright frame of a flattened yarn does not
/// count: 15 degrees. Which way the side of a binder points that goes straight down through the
/// cloth is a matter of how it trembles. Without it a binder is turned on its way down, and still
/// so where it lies level again (`a_flat_yarn_stands_upright_where_it_lies_flat`).
const NEAR_POLE: f32 = 0.067;

/// Points on either side of the lap of a closed yarn whose ups are looked for: in so many steps of
/// [`HANDED_OVER`] a frame turns by whole turns.
const LAP_POINTS: usize = 24;

/// Whether a yarn is steep, and how its outline leans if it does.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Stand {
    pub(crate) steep: bool,
    pub(crate) leaning: Option<Arc<Leaning>>,
}

impl Stand {
    /// How the yarn through `points` stands, which was given the up directions `ups` or none.
    ///
    /// A flattened yarn without ups gets some where the upright frame turns too fast for it.
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
                // On end the upright frame has no direction, but for a convention that does not
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

/// The ups of a flattened yarn: those of the upright frame where that turns slowly. Elsewhere, and
/// near its pole, they are carried along, and turned by [`HANDED_OVER`] at most from point to point
/// to where it stands further on.
fn handed_over(points: &[ControlPoint], closed: bool, tangents: &[Vec3]) -> Vec<Vec3> {
    let count = points.len();
    // How far a frame that is carried along is turned against the upright one at each point.
    let mut rolls = vec![0.0];
    for interval in intervals(points, closed) {
        let window = window(points, closed, interval);
        rolls.push(rolls[interval] + carried_steps(&window).map(|step| f64::from(step.turns())).sum::<f64>());
    }
    // Round a closed yarn so often that the middle lap has neighbours enough on either side for a
    // frame to be handed over by half a turn.
    let laps = if closed { 2 * LAP_POINTS.div_ceil(count) + 1 } else { 1 };
    let whole = rolls[rolls.len() - 1];
    let mut before: Option<f64> = None;
    let asked: Vec<_> = (0..laps * count)
        .map(|place| {
            let (lap, point) = (place / count, place % count);
            let counts = level(&tangents[point]) > NEAR_POLE;
            let upright = counts.then(|| -rolls[point] - lap as f64 * whole)?;
            // An outline turned by half a turn is the same.
            let near = before.map_or(upright, |before| upright - ((upright - before) * 2.0).round() / 2.0);
            before = Some(near);
            before
        })
        .collect();
    let turns = if closed && asked.iter().all(Option::is_none) {
        // Nothing says how it stands: what a lap turns is spread over its points, for an outline
        // turned by half a turn is the same.
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

/// Turns that follow those asked for, of one place each, as nearly as steps of [`HANDED_OVER`] at
/// most do: half way between the highest of those that are nowhere above what is asked, and the
/// lowest that are nowhere below.
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
