//! Steep yarns: yarns whose tubes would be wrung in upright frames, that is, twisted so that they
//! get narrower between rings.

use std::f32::consts::TAU;
use std::iter::once;

use glam::{Vec2, Vec3};

use crate::definitions::{Segment, Turn};
use crate::interval::{intervals, neighbours};
use crate::lean::IntervalLean;
use crate::{ControlPoint, Frame};

/// The largest turn of an upright frame about a yarn within one control interval, turns: 4 degrees.
/// Yarns whose frame turns by more are steep.
///
/// The frames of woven threads that keep to their planes do not turn, and those of threads that are
/// pushed aside in a settled cloth turn by up to a degree. The frames of the loops of knits turn by
/// 10 degrees and more. Two rings are at most an interval apart, so the tube between them is never
/// narrower than cos 2° of its radius. With half the value,
/// `a_plied_yarn_meets_itself_from_either_end` is red; with twice, no test is.
pub(crate) const UPRIGHT_TURN: f32 = 4.0 / 360.0;

/// Number of steps within an interval whose turns are added up. With 4 steps a hairpin through the
/// vertical counted for half its turn.
const PLACES: u32 = 16;

/// The factor of the spline's tangents at tension 0. Tension changes the tangents within an
/// interval, but hardly the turn over the whole interval.
const S: f32 = 0.5;

/// Whether, within any interval, the upright frame of a yarn turns about the yarn by more than
/// `most` turns against a rotation minimising frame.
pub(crate) fn upright_turns_beyond(points: &[ControlPoint], closed: bool, most: f32) -> bool {
    intervals(points, closed).any(|interval| {
        let window = neighbours(points, closed, interval);
        turn_at_most(&window) > most && turn(&window, |_| 0.0) > most
    })
}

/// Whether a yarn's tube would be wrung in frames along the up directions `ups` of the yarn's
/// points.
///
/// The frame of a round yarn may turn by [`UPRIGHT_TURN`] within an interval. In a flattened yarn
/// the section turns together with the outline, so that the tube keeps its shape unless the ups
/// turn over.
pub(crate) fn wrings(points: &[ControlPoint], closed: bool, ups: &[Vec3]) -> bool {
    let flat = is_flat(points);
    intervals(points, closed).any(|interval| {
        let window = neighbours(points, closed, interval);
        let ends = [interval, (interval + 1) % ups.len()].map(|point| ups[point]);
        let lean = IntervalLean::new(&window, ends, S);
        if flat { lean.turns_over() } else { turn(&window, |t| lean.at(t).turns()) > UPRIGHT_TURN }
    })
}

/// Whether a yarn is flattened at any control point.
pub(crate) fn is_flat(points: &[ControlPoint]) -> bool {
    points.iter().any(|point| !point.is_round())
}

/// Whether the yarn's direction in plan changes so little that no interval can turn by more than
/// [`UPRIGHT_TURN`], however steep the interval is. For woven threads no other test is needed. This
/// one takes some thirty instructions per control point instead of 450.
///
/// The bound is that of [`turn_at_most`], with the tangent of the swing instead of its angle, and 1
/// instead of the sine of the slope. In plan, the middle one of an interval's three Bézier
/// velocities is three times the chord, less the two velocities at the ends. The middle one points
/// backwards, for example, if the next chord is much longer. In a yarn that keeps to a plane this
/// is accepted, as long as the velocity itself never points backwards.
pub(crate) fn runs_straight(points: &[ControlPoint], closed: bool) -> bool {
    let plan = |from: &ControlPoint, to: &ControlPoint| (to.position() - from.position()).truncate();
    let (first, last) = (&points[0], &points[points.len() - 1]);
    let back = closed.then(|| plan(last, first));
    let start = plan(first, &points[1]);
    // Virtual ends continue straight.
    let beyond = if closed { start } else { plan(&points[points.len() - 2], last) };
    let bend = |one: Vec2, other: Vec2| (one.perp_dot(other).abs(), one.dot(other));
    let mut here = start;
    let mut before = bend(back.unwrap_or(start), start);
    let further = points[1..].windows(2).map(|pair| plan(&pair[0], &pair[1]));
    further.chain(back).chain(once(beyond)).all(|next| {
        let (own, after) = (here.length_squared(), bend(here, next));
        let [first, middle, last] = [own + before.1, 4.0 * own - before.1 - after.1, own + after.1];
        let most = before.0 + after.0;
        (here, before) = (next, after);
        let goes_on = first > 0.0 && last > 0.0 && (middle > 0.0 || middle * middle < first * last);
        goes_on && most * (4.0 / TAU) <= UPRIGHT_TURN * first.min(middle).min(last).max(0.0)
    })
}

/// An upper bound on the turn of an interval's upright frame, from the three Bézier points of the
/// velocity. It is infinite if they give no bound.
///
/// An upright frame turns by the sine of the yarn's slope times the turn of the yarn's direction in
/// plan, that is, seen along z. The swing is the largest angle, in plan, between one of the three
/// points and the chord.
fn turn_at_most(window: &[ControlPoint; 4]) -> f32 {
    let [before, start, end, after] = window.map(|point| point.position());
    let (span, first, last) = (end - start, (end - before) * S, (after - start) * S);
    let velocities = [first, span * 3.0 - first - last, last];
    let plan = velocities.map(Vec3::truncate);
    let along = span.truncate().normalize_or_zero();
    let least = plan.iter().map(|velocity| velocity.dot(along)).fold(f32::INFINITY, f32::min);
    if least <= 0.0 {
        return f32::INFINITY;
    }
    let highest = velocities.iter().map(|velocity| velocity.z.abs()).fold(0.0, f32::max);
    let swing = plan.map(|velocity| along.perp_dot(velocity).atan2(along.dot(velocity)));
    let swing = swing.iter().fold(0.0, |swing, angle| angle.abs().max(swing));
    // The factor is 4 because a cubic's direction may swing out and back, to both sides.
    4.0 * swing / TAU * highest / (highest * highest + least * least).sqrt()
}

/// The sum of the absolute turns, from place to place along the interval, of a frame that is turned
/// by `lean` from the upright one.
fn turn(window: &[ControlPoint; 4], lean: impl Fn(f32) -> f32) -> f32 {
    let mut here = lean(0.0);
    let steps = carried_steps(window).enumerate().map(|(place, step)| {
        let next = lean((place + 1) as f32 / PLACES as f32);
        let turned = Turn::from_turns(step.turns() + here - next);
        here = next;
        turned.turns().abs()
    });
    steps.sum()
}

/// The turns of a rotation minimising frame against the upright one, from place to place along the
/// interval.
pub(crate) fn carried_steps(window: &[ControlPoint; 4]) -> impl Iterator<Item = Turn> {
    let segment = Segment::new(window, S);
    let mut here = segment.sample(0.0);
    (1..=PLACES).map(move |place| {
        let next = segment.sample(place as f32 / PLACES as f32);
        let chord = next.offset - here.offset;
        let step = Frame::RotationMinimizing.step(here.tangent, next.tangent, chord, 0.0);
        here = next;
        step
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A yarn that runs straight by its chords never turns by more than the limit.
    #[test]
    fn no_yarn_that_runs_straight_is_steep() {
        let mut seed = 1_u32;
        let mut random = || {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (seed >> 8) as f32 / (1 << 24) as f32 - 0.5
        };
        let [mut straight, mut not] = [0; 2];
        for yarn in 0..2_000 {
            let swing = 0.001 * (yarn % 40) as f32;
            let closed = yarn % 7 == 0;
            let points: Vec<_> = (0..6)
                .map(|point| {
                    let (x, y, z) = (point as f32 + 0.3 * random(), swing * random(), 3.0 * random());
                    ControlPoint::new(x, y, z, 0.1)
                })
                .collect();
            let intervals = if closed { 6 } else { 5 };
            let most = (0..intervals).map(|interval| turn(&neighbours(&points, closed, interval), |_| 0.0));
            let most = most.fold(0.0, f32::max);
            if runs_straight(&points, closed) {
                straight += 1;
                assert!(most <= UPRIGHT_TURN + 1e-6, "yarn {yarn}: {most}");
            } else {
                not += 1;
            }
        }
        assert!(straight > 300 && not > 300, "{straight} {not}");
    }
}
