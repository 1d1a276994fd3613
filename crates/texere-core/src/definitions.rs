//! The definitions of the geometry. All CPU backends give the same results to the bit, and GPU
//! backends the same up to rounding.
//!
//! | of | definition |
//! |---|---|
//! | the centreline | [`Segment`], at a [`Sample`], with [`tangent_factor`]; [`Sampling`] places the rings on it |
//! | a ring's axes | [`Basis`], [`up_between`] |
//! | a ring's roll | [`Turn`] |
//! | a ring | [`Ring`], with its [`Stance`], which all its vertices share |
//! | a ring's corners | [`Section`](crate::Section), [`corner_angle`] |
//! | triangles | [`index_pattern`] |
//!
//! The constants belong to these definitions. Kernels and shaders use the same values.

pub use crate::attribute::corner_angle;
pub use crate::frame::{Basis, NO_MIRROR, VERTICAL};
pub use crate::interval::neighbours;
pub use crate::lean::up_between;
pub use crate::ring::{Ring, Stance};
pub use crate::sampling::{RingSample, Sampling};
pub use crate::section::SIDES_MAX;
pub use crate::spline::{
    ARC_EVEN, ARC_NODES, ARC_PANELS, ARC_WEIGHTS, NO_LENGTH, RADIUS_FLOOR, SLOPE_LIMIT, Sample, Segment,
    ZERO_VELOCITY, tangent_factor,
};
pub use crate::topology::index_pattern;
pub use crate::turn::{ARCTANGENT, COSINE, SINE, TAN_EIGHTH, Turn};
