//! The lean of outlines. Yarns of bent or turned cloth, and flat yarns that run up or down, have an
//! up direction at each control point.

use glam::{DVec3, Vec3};

use crate::ControlPoint;
use crate::definitions::{Basis, Segment, Turn};
use crate::turn::atan2_turns;

/// The up directions of a yarn's control points, with the points that they belong to.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Leaning {
    /// The up directions, unit vectors.
    pub(crate) ups: Vec<Vec3>,
    pub(crate) points: Vec<ControlPoint>,
    /// Whether the ups were given. Given ups stay when the points move.
    pub(crate) given: bool,
}

/// The largest cosine of two ups that count as at right angles. It allows for rounding.
const RIGHT_ANGLE: f64 = 1e-9;

/// The direction of a yarn's height at `t`, from 0 to 1, of a control interval. `ups` are the up
/// directions of the interval's two control points, `tangents` the yarn's tangents there, `tangent`
/// the tangent at `t`. All are unit vectors. Returns a unit vector at right angles to `tangent`, or
/// zero if there is none.
///
/// Each up is carried to the tangent by the smallest rotation, and the two are mixed linearly. An
/// outline turned over is the same outline, so the second up may be replaced by its opposite. The
/// one nearer to the first up counts. If both are at right angles to it, up to rounding, the second
/// up itself counts.
///
/// ```
/// use glam::DVec3;
/// use texere_core::definitions::up_between;
/// // A yarn makes a quarter of a turn to the right. Half way along, an up at right angles to the
/// // plane of the turn is unchanged. An up in this plane has turned with the yarn.
/// let (tangents, tangent) = ([DVec3::X, -DVec3::Y], DVec3::new(0.5, -0.5, 0.0).normalize());
/// assert!((up_between([DVec3::Z; 2], tangents, tangent, 0.5) - DVec3::Z).length() < 1e-12);
/// let along = up_between([DVec3::Y, DVec3::X], tangents, tangent, 0.5);
/// assert!((along - DVec3::new(0.5, 0.5, 0.0).normalize()).length() < 1e-12);
/// ```
#[must_use]
pub fn up_between(ups: [DVec3; 2], tangents: [DVec3; 2], tangent: DVec3, t: f64) -> DVec3 {
    let [one, other] = [0, 1].map(|end| across(carried(ups[end], tangents[end], tangent), tangent));
    let other = if one.dot(other) < -RIGHT_ANGLE { -other } else { other };
    match across(one * (1.0 - t) + other * t, tangent) {
        // An up that points along the yarn has no direction across the yarn.
        DVec3::ZERO if one == DVec3::ZERO => other,
        DVec3::ZERO => one,
        mixed => mixed,
    }
}

/// `v` turned by the smallest rotation from one unit vector to another.
fn carried(v: DVec3, from: DVec3, to: DVec3) -> DVec3 {
    let (middle, along) = (from + to, 1.0 + from.dot(to));
    // For opposite vectors there is no smallest rotation.
    if along < 1e-9 { v } else { v - middle * (middle.dot(v) / along) + to * (2.0 * from.dot(v)) }
}

/// The part of `v` at right angles to `tangent`, normalised, or zero if there is none.
fn across(v: DVec3, tangent: DVec3) -> DVec3 {
    let part = v - tangent * v.dot(tangent);
    if part.length_squared() > 1e-12 { part.normalize() } else { DVec3::ZERO }
}

/// The lean of outlines along one control interval.
pub(crate) struct IntervalLean {
    segment: Segment,
    ups: [DVec3; 2],
    tangents: [DVec3; 2],
}

impl IntervalLean {
    pub(crate) fn new(window: &[ControlPoint; 4], ups: [Vec3; 2], s: f32) -> Self {
        let segment = Segment::new(window, s);
        let tangents = [0.0, 1.0].map(|t| segment.sample(t).tangent.as_dvec3());
        Self { segment, ups: ups.map(|up| up.as_dvec3()), tangents }
    }

    /// Whether the second up points away from the first, so that its opposite counts instead.
    pub(crate) fn turns_over(&self) -> bool {
        let end = self.tangents[1];
        up_between(self.ups, self.tangents, end, 1.0).dot(across(self.ups[1], end)) < 0.0
    }

    /// The turn about the tangent at `t` from the upright frame's up to the yarn's own up.
    pub(crate) fn at(&self, t: f32) -> Turn {
        let tangent = self.segment.sample(t).tangent;
        let up = up_between(self.ups, self.tangents, tangent.as_dvec3(), f64::from(t)).as_vec3();
        let upright = Basis::upright(tangent);
        Turn::from_turns(atan2_turns(-up.dot(upright.side), up.dot(upright.up)))
    }
}
