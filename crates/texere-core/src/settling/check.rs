//! The checks of a settling, and sizes that are worked out from all its control points.

use glam::DVec3;

use super::{Length, Scale, Settling, SettlingError};
use crate::definitions::NO_LENGTH;
use crate::{ControlPoint, Ends};

/// Checks that there are no more than `limit` of `what`.
pub(super) fn limited(what: &'static str, count: u64, limit: u64) -> Result<(), SettlingError> {
    if count > limit { Err(SettlingError::TooMany { what, count, limit }) } else { Ok(()) }
}

/// Checks a settling, apart from the length of its repeat.
pub(super) fn check(settling: &Settling<'_>) -> Result<(), SettlingError> {
    let layout = settling.layout();
    let within = |setting, value: f32, low: f32, high: f32| {
        let sound = (low..=high).contains(&value);
        if sound { Ok(()) } else { Err(SettlingError::Setting { setting, value, low, high }) }
    };
    within("the spline's tension", layout.tension(), 0.0, 0.99)?;
    match settling.length {
        Length::Held => {}
        Length::Given(factor) => within("the length", factor, 0.5, 2.0)?,
        Length::Free { tension } => within("the tension", tension, 0.0, 0.1)?,
    }
    within("the number of passes", settling.passes as f32, 1.0, 1e6)?;
    if let Some(gap) = settling.plates {
        within("the gap between the plates", gap, 0.0, crate::COORDINATE_LIMIT)?;
    }
    settling.boundary.check(layout)?;
    for (yarn, &ends) in settling.boundary.ends().iter().enumerate() {
        let points = layout.offsets()[yarn + 1] - layout.offsets()[yarn];
        let least = if ends == Ends::Open { 2 } else { 3 };
        if points < least {
            return Err(SettlingError::TooFewPoints { yarn, points, least });
        }
    }
    let points = layout.point_count();
    match settling.pinned.iter().find(|&&point| point >= points) {
        Some(&point) => Err(SettlingError::Pinned { point, points }),
        None => Ok(()),
    }
}

/// A scale with room for all places that control points may move to.
pub(super) fn scale(settling: &Settling<'_>) -> Result<Scale, SettlingError> {
    let points = settling.points();
    let far = DVec3::splat(f64::INFINITY);
    let (low, high) = points.iter().fold((far, -far), |(low, high), point| {
        let at = point.position().as_dvec3();
        (low.min(at), high.max(at))
    });
    // The origin is at z = 0, because plates lie at equal distances above and below it.
    let origin = ((low + high) / 2.0).round().with_z(0.0);
    let thinnest = points.iter().map(|point| 2.0 * point.half_width().min(point.half_height()));
    let diameter = thinnest.fold(f32::INFINITY, f32::min);
    // A repeating yarn reaches beyond its first and last control points by as much as its next copy
    // is moved.
    let [x, y] = settling.boundary.repeat().map(f64::from);
    let onward = settling.boundary.ends().iter().map(|ends| match ends {
        Ends::Repeats([right, up]) => (f64::from(*right) * x).abs().max((f64::from(*up) * y).abs()),
        Ends::Open | Ends::Closed => 0.0,
    });
    let onward = onward.fold(x.max(y), f64::max);
    let extent = ((high - origin).max(origin - low).max_element() + onward) as f32;
    let room = 1.25 * extent + 64.0 * thickest(points);
    Scale::new(origin, room, diameter).ok_or(SettlingError::TooLarge { extent, diameter })
}

/// The largest half width or half height, mm.
pub(super) fn thickest(points: &[ControlPoint]) -> f32 {
    points.iter().map(|point| point.half_width().max(point.half_height())).fold(NO_LENGTH, f32::max)
}

/// The mean of all diameters, mm.
pub(super) fn mean_diameter(points: &[ControlPoint]) -> f32 {
    let sum: f64 = points.iter().map(|point| f64::from(point.half_width() + point.half_height())).sum();
    (sum / points.len().max(1) as f64) as f32
}
