//! Cures for a cloth. Each cure is one change.

use super::faults::ClothFault;
use crate::{BySet, JamReport, Relief, Shape};

/// A change of the cloth that helps.
#[derive(Debug, Clone, PartialEq)]
pub struct Cure {
    /// The change.
    pub remedy: Remedy,
    /// The least clearance with the change, at the places that were the worst.
    pub clearance: f64,
    /// The tightest bend at these places: its radius over the distance by which the section reaches
    /// into the bend.
    pub curvature: f64,
    /// Faults that the change does not cure.
    pub leaves: Vec<ClothFault>,
}

/// A change of a cloth that may cure it.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Remedy {
    /// Another shape, see [`Woven::set_shape`](crate::Woven::set_shape).
    Shape(Shape),
    /// Another share of the crimp for the warp, see [`Crimp::WarpShare`](crate::Crimp::WarpShare).
    WarpShare {
        /// The warp's share before the change.
        before: f32,
        /// The warp's share with the change.
        after: f32,
    },
    /// Relief, see [`Woven::relieve`](crate::Woven::relieve).
    Relief {
        /// The kind of relief.
        relief: Relief,
        /// The changes that it makes.
        report: JamReport,
        /// Diameter of the thickest thread before and after, mm.
        thickest_mm: [f64; 2],
    },
    /// Circular sections for all threads, see [`Woven::set_section`](crate::Woven::set_section).
    Circle,
    /// One flatness, width over height, for all threads: see
    /// [`Woven::set_flatness`](crate::Woven::set_flatness).
    Flatness(f32),
    /// All threads further apart.
    Spacing {
        /// Mean spacing of ends and of picks with the change, mm.
        spacing_mm: BySet<f64>,
        /// Factor by which all spacings are wider.
        factor: f64,
    },
    /// All threads thinner.
    Diameter {
        /// Diameter of the thickest thread before and after, mm.
        thickest_mm: [f64; 2],
    },
}
