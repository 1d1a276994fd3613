//! What the geometry is: the arithmetic that every backend must agree on, to the bit between CPU
//! backends.
//!
//! | of | definition |
//! |---|---|
//! | the centreline | [`Segment`], at a [`Sample`], with [`tangent_factor`]; [`Sampling`] says where its rings lie |
//! | a ring's axes | [`Basis`], [`up_between`] |
//! | its roll | [`Turn`] |
//! | the ring | [`Ring`], with a [`Stance`] for the slope of its vertices |
//! | its corners | [`Section`](crate::Section), [`corner_angle`] |
//! | triangles | [`index_pattern`] |
//!
//! Constants are parts of these definitions: kernels and shaders have the same values.

pub use crate::attribute::corner_angle;
pub use crate::frame::{Basis, NO_MIRROR, VERTICAL};
pub use crate::lean::up_between;
pub use crate::padded::neighbours;
pub use crate::ring::{Ring, Stance};
pub use crate::sampling::{RingSample, Sampling};
pub use crate::section::SIDES_MAX;
pub use crate::spline::{
    ARC_EVEN, ARC_NODES, ARC_PANELS, ARC_WEIGHTS, NO_LENGTH, RADIUS_FLOOR, SLOPE_LIMIT, Sample, Segment,
    ZERO_VELOCITY, tangent_factor,
};
pub use crate::topology::index_pattern;
pub use crate::turn::{ARCTANGENT, COSINE, SINE, TAN_EIGHTH, Turn};
