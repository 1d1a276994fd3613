//! How near is near enough: docs/TOLERANCES.md has the reasons.

/// How far a centre or a vertex may lie off its place, in radii of the yarn.
pub const POSITION: f64 = 1e-4;

/// What is allowed on top of that, in units in the last place of the largest coordinate of the
/// control points that it comes from: far from the origin f32 has no more digits.
pub const COORDINATE_ULPS: f64 = 4.0;

/// How far a unit vector may be off its direction, rad, and a radius off its length, relative to
/// it.
pub const DIRECTION: f64 = 1e-4;

/// How far roll may drift with each ring, and with each radian of twist, from the yarn's start,
/// rad.
pub const ROLL_DRIFT: f64 = 1e-7;

/// How far roll may be off at the yarn's start, rad: the rounding of one step.
pub const ROLL_FLOOR: f64 = 1e-6;

/// How far roll may be off within a control interval, as a share of the interval's twist: a ring's
/// place between its two control points takes eight roundings in f32. It does not add up, since at
/// control points the place is exact again.
pub const INTERVAL_TWIST: f64 = 5e-7;

/// The angle to z, rad, under which the upright frame depends on the tangent's last bits, and is
/// not compared.
pub const NEAR_VERTICAL: f64 = 1e-3;

/// The angle to z, rad, under which every backend takes the tangent for vertical, and the frame is
/// defined again.
pub const SURELY_VERTICAL: f64 = 1e-7;
