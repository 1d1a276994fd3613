//! Tolerances of the comparison. docs/TOLERANCES.md has the reasons for them.

/// Distance by which a centre or a vertex may be off its place, as a share of the smaller of the
/// ring's half width and half height.
pub const POSITION: f64 = 1e-4;

/// Further distance that is allowed, in units in the last place of the largest coordinate of the
/// control points. Far from the origin, f32 has no finer digits.
pub const COORDINATE_ULPS: f64 = 4.0;

/// Angle by which a unit vector may be off its direction, rad. A half width or half height may be
/// off by this share of itself, and a growth by this share of 1 plus the growth.
pub const DIRECTION: f64 = 1e-4;

/// Drift of the roll that is allowed for each ring, and for each radian of twist, from the yarn's
/// start, rad.
pub const ROLL_DRIFT: f64 = 1e-7;

/// Error of the roll that is allowed at the yarn's start, rad: the rounding of one step.
pub const ROLL_FLOOR: f64 = 1e-6;

/// Error of the roll that is allowed within a control interval, as a share of the interval's twist.
/// A ring's place between its two control points takes eight roundings in f32. The error does not
/// add up, because the place is exact again at control points.
pub const INTERVAL_TWIST: f64 = 5e-7;

/// Angle to z, rad, below which the upright frame depends on the last bits of the tangent, and is
/// not compared.
pub const NEAR_VERTICAL: f64 = 1e-3;

/// Angle to z, rad, below which every backend treats the tangent as vertical. There the frame is
/// defined by the rule for the vertical.
pub const SURELY_VERTICAL: f64 = 1e-7;
