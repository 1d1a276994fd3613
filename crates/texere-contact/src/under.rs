//! The yarns that lie under a point of the cloth.

use texere_core::definitions::{Segment, neighbours, tangent_factor};
use texere_core::{ControlPoint, YarnPlace, Yarns};

/// Number of straight pieces that stand for each control interval. A yarn that bends round another
/// leaves such a piece by less than a hundredth of its radius.
const PIECES: u16 = 24;

/// Places of the yarns under `point` (x and y, mm), the topmost first. A yarn lies under the point
/// if its outline, seen from the face, holds the point. A yarn that passes under the point several
/// times is listed once for each pass, at the place nearest to the point. A pass ends with an
/// interval between control points that is not under the point.
///
/// ```
/// use texere_core::{ControlPoint, Yarn, Yarns};
/// let mut yarns = Yarns::builder();
/// yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
/// yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|y| ControlPoint::new(1.0, y, 0.3, 0.1)));
/// let yarns = yarns.build()?;
/// let under = |point| texere_contact::yarns_under(&yarns, point).iter().map(|place| place.yarn).collect::<Vec<_>>();
/// assert_eq!(under([1.05, 0.02]), [1, 0]);
/// assert_eq!(under([0.5, 0.02]), [0]);
/// # Ok::<(), texere_core::YarnError>(())
/// ```
#[must_use]
pub fn yarns_under(yarns: &Yarns, point: [f64; 2]) -> Vec<YarnPlace> {
    let s = tangent_factor(yarns.tension());
    let layout = yarns.layout();
    let mut found = Vec::new();
    for (number, yarn) in layout.yarns().iter().enumerate() {
        let points = yarns.yarn_points(number).unwrap_or(&[]);
        let intervals = if yarn.closed { points.len() } else { points.len().saturating_sub(1) };
        let nearest = |interval: usize| {
            let four = neighbours(points, yarn.closed, interval);
            if may_hold(&four, point) { nearest(&four, point, s) } else { None }
        };
        // A pass over the seam of a closed yarn is one pass, so the search begins at an interval
        // that is not under the point.
        let is_clear = |interval: &usize| nearest(*interval).is_none();
        let first = if yarn.closed { (0..intervals).find(is_clear).unwrap_or(0) } else { 0 };
        // The distance and the place of the pass that goes on from the interval before.
        let mut passage: Option<(f64, YarnPlace)> = None;
        for interval in (first..intervals).chain(0..first) {
            match nearest(interval) {
                Some((distance, t)) => {
                    if passage.is_none_or(|(least, _)| distance < least) {
                        passage = YarnPlace::at(yarns, number, interval, t).map(|place| (distance, place));
                    }
                }
                None => found.extend(passage.take().map(|(_, place)| place)),
            }
        }
        found.extend(passage.map(|(_, place)| place));
    }
    found.sort_by(|one, other| other.position[2].total_cmp(&one.position[2]));
    found
}

/// Whether the interval between the middle two of the four control points can reach the point. A
/// spline leaves the box of its control points by less than the size of the box.
fn may_hold(four: &[ControlPoint; 4], point: [f64; 2]) -> bool {
    (0..2).all(|axis| {
        let along = four.map(|point| f64::from(point.position()[axis]));
        let low = along.iter().copied().fold(f64::INFINITY, f64::min);
        let high = along.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let thick = four.iter().map(|point| f64::from(point.half_width())).fold(0.0, f64::max);
        let reach = (high - low) + 2.0 * thick;
        (low - reach..=high + reach).contains(&point[axis])
    })
}

/// Distance and parameter of the place nearest to the point, in the plane of the cloth, on the
/// straight pieces of an interval. None if the point lies outside the yarn's half width there.
fn nearest(four: &[ControlPoint; 4], point: [f64; 2], s: f32) -> Option<(f64, f64)> {
    let segment = Segment::new(four, s);
    let sample = |step: u16| {
        let sample = segment.sample(f32::from(step) / f32::from(PIECES));
        let [x, y, _] = sample.centre.to_array().map(f64::from);
        ([x - point[0], y - point[1]], f64::from(sample.half_width))
    };
    let mut ahead = sample(0);
    let pieces = (0..PIECES).map(|step| {
        let ([x, y], from) = std::mem::replace(&mut ahead, sample(step + 1));
        let ([to_x, to_y], to) = ahead;
        let [run, rise] = [to_x - x, to_y - y];
        let squared = (run * run + rise * rise).max(f64::MIN_POSITIVE);
        let share = (-(x * run + y * rise) / squared).clamp(0.0, 1.0);
        let distance = (x + share * run).hypot(y + share * rise);
        (distance, (f64::from(step) + share) / f64::from(PIECES), from + share * (to - from))
    });
    let (distance, t, half) = pieces.min_by(|one, other| one.0.total_cmp(&other.0))?;
    (distance <= half).then_some((distance, t))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may panic")]
mod tests {
    use texere_core::Yarn;

    use super::*;

    /// The yarn through points given by x and y, of radius 0.1.
    fn yarn(closed: bool, points: &[[f32; 2]]) -> Yarns {
        let mut yarns = Yarns::builder();
        let points: Vec<_> = points.iter().map(|[x, y]| ControlPoint::new(*x, *y, 0.0, 0.1)).collect();
        yarns.yarn(Yarn { closed, ..Yarn::default() }, &points);
        yarns.build().unwrap()
    }

    #[test]
    fn a_long_straight_yarn_lies_under_each_point_of_its_outline() {
        let long = yarn(false, &[[0.0, 0.0], [10.0, 0.0]]);
        for step in 0..=1000 {
            let x = f64::from(step) / 100.0;
            let under = yarns_under(&long, [x, 0.09]);
            assert_eq!(under.len(), 1, "{x}");
            assert!((under[0].position[0] - x).abs() < 0.01, "{x}: {:?}", under[0].position);
            assert!(yarns_under(&long, [x, 0.11]).is_empty(), "{x}");
        }
    }

    #[test]
    fn a_pass_over_the_seam_of_a_closed_yarn_is_one_pass() {
        let square = yarn(true, &[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        for corner in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
            assert_eq!(yarns_under(&square, corner).len(), 1, "{corner:?}");
        }
    }
}
