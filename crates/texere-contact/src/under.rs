//! The yarns that lie under a point of the cloth.

use texere_core::definitions::{Segment, neighbours, tangent_factor};
use texere_core::{ControlPoint, YarnPlace, Yarns};

/// Number of steps between the places at which each control interval is tried. From one place to
/// the next, a yarn that bends round another moves by less than half its radius.
const STEPS: u16 = 24;

/// Places of the yarns under the point (`x`, `y`), mm, the topmost first. A yarn lies under the
/// point if its outline, seen from the face, holds the point. A yarn that passes under the point
/// several times is listed once for each pass, at the place nearest to the point.
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
        // The distance and the place of the pass that goes on from the interval before.
        let mut passage: Option<(f64, YarnPlace)> = None;
        for interval in 0..intervals {
            let four = neighbours(points, yarn.closed, interval);
            let nearest = if may_hold(&four, point) { nearest(&four, point, s) } else { None };
            match nearest {
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

/// Distance and parameter of the centreline's nearest place to the point, in the plane of the
/// cloth. None if the point lies outside the yarn's half width there.
fn nearest(four: &[ControlPoint; 4], point: [f64; 2], s: f32) -> Option<(f64, f64)> {
    let segment = Segment::new(four, s);
    let samples = (0..=STEPS).map(|step| {
        let t = f32::from(step) / f32::from(STEPS);
        let sample = segment.sample(t);
        let centre = sample.centre.to_array().map(f64::from);
        let distance = (centre[0] - point[0]).hypot(centre[1] - point[1]);
        (distance, f64::from(t), f64::from(sample.half_width))
    });
    let (distance, t, half) = samples.min_by(|one, other| one.0.total_cmp(&other.0))?;
    (distance <= half).then_some((distance, t))
}
