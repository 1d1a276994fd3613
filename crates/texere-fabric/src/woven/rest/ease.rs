//! Easing of bends that would be tighter than a thread is thick.

use glam::DVec2;

use super::stop::{CHANGE_POINTS, Stop};

/// The most rounds in which points are moved to ease bends. With twice the value,
/// `cloths_of_the_mills_come_to_rest` of `at_rest` is red.
const EASINGS: usize = 40;

/// The step of a point in a round, as a share of its second difference in height. With half the
/// value, and with twice, no test is red.
const MOVED: f64 = 0.1;

/// A bend needs no easing if its radius is at least this multiple of the distance by which the
/// thread reaches into it. With half its difference to 1, `cloths_of_the_mills_come_to_rest` is
/// red; with twice, no test is.
const WIDE: f64 = 1.02;

/// Moves the stops between two crossings up or down where the spline through them would bend more
/// tightly than the thread is thick. `turns` says whether the thread also changes sides before the
/// first crossing, and after the second one. If so, the path beyond that crossing is taken as the
/// mirror image of the path on this side.
pub(super) fn ease(stops: &mut [Stop], turns: [bool; 2]) {
    let last = stops.len() - 1;
    let mut at = [DVec2::ZERO; CHANGE_POINTS + 2];
    for _ in 0..EASINGS {
        at.iter_mut().zip(&*stops).for_each(|(at, stop)| *at = DVec2::new(stop.along, stop.z));
        // The second differences of the stops.
        let mut second = [DVec2::ZERO; CHANGE_POINTS + 2];
        for stop in 1..last {
            second[stop] = at[stop - 1] - 2.0 * at[stop] + at[stop + 1];
        }
        let mut eased = false;
        let mut is_tight = |stop: usize, sharpest: f64, speed: f64| {
            let tight = sharpest * stops[stop].halves[1] * WIDE > speed.powi(3);
            eased |= tight;
            tight
        };
        let mut moves = [0.0; CHANGE_POINTS + 2];
        for stop in 1..last {
            let tangent = (at[stop + 1] - at[stop - 1]) / 2.0;
            // The cross product of the spline's first and second derivatives, on both sides of the
            // stop.
            let turning = [stop - 1, stop + 1]
                .map(|beside| tangent.perp_dot(2.0 * second[stop] - second[beside]).abs());
            if is_tight(stop, turning[0].max(turning[1]), tangent.length()) {
                moves[stop] += MOVED * second[stop].y;
            }
        }
        for (crossing, beside) in [(0, 1), (last, last - 1)] {
            let away = at[beside] - at[crossing];
            let turning = (away.x * (4.0 * away.y - second[beside].y)).abs();
            if turns[usize::from(crossing > 0)] && is_tight(crossing, turning, away.x.abs()) {
                moves[beside] -= MOVED * away.y;
            }
        }
        if !eased {
            return;
        }
        stops.iter_mut().zip(moves).for_each(|(stop, by)| stop.z += by);
    }
}
