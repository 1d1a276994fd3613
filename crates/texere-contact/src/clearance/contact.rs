//! Contacts of yarns, and the limits within which they are looked for.

use texere_core::YarnPlace;

use crate::grid;

/// The greatest ratio of a contact that is looked for.
pub const CLEARANCE_NEAR: f64 = 1.1;

/// The least ratio at which surfaces do not pierce one another.
///
/// Splines through points at which threads just touch come as near as 0.987 between the points
/// (denim, docs/BENCHMARKS.md). Woven cloth at rest is brought to 0.986. With a limit of 0.99 both
/// would be faults.
pub const CLEAR: f64 = 0.985;

/// The accuracy of a ratio. Yarns at a ratio of 0.999 count as touching.
///
/// For yarns with plies, corners or twisted flat sections, the contact that is found may not be the
/// nearest, and its ratio may be too large by up to 0.003. The error may be larger if such a yarn
/// bends as sharply as it is thick and meets itself. Once a ratio of two intervals is below 0.25,
/// no smaller one is looked for. A section that reaches 64 times as far as its control interval is
/// long counts by its hull, untwisted.
///
/// Flattened yarns that bend sharply may approach twice on one pair of intervals. The nearer
/// approach may then not be found.
pub const CLEARANCE_ACCURACY: f64 = 1e-3;

/// The most contacts that are listed one by one.
pub const CONTACTS_LISTED: usize = 100;

/// The most intervals that one interval is compared with in a cell of the search. In a cell of more
/// than 256 intervals, a plane sweeps through the cell, and only intervals that the plane meets at
/// the same time are compared.
///
/// Yarns that are clear of one another reach this number only if some 250 control points lie on a
/// length of one radius, or if a thousand straight yarns of two points lie side by side.
pub const CLEARANCE_BESIDE: usize = 1024;

/// The most pairs of control intervals that are compared for each control point. An interval lies
/// in 6 cells on average at most, and is compared with [`CLEARANCE_BESIDE`] in each. Cloth takes 20
/// to 60.
pub const CLEARANCE_PAIRS: u64 = grid::ENTRIES * CLEARANCE_BESIDE as u64;

/// Width of a bin of the histogram.
pub const CLEARANCE_BIN: f64 = 0.01;

/// A place where two yarns, or two parts of one, are nearer to one another than anywhere close by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// The two places, the lower yarn first.
    pub places: [YarnPlace; 2],
    /// The factor by which both sections could grow until their surfaces touch. It is 1 if the
    /// surfaces just touch, and less if they pierce. For round yarns it is the distance of the
    /// centrelines over the sum of the radii. A section counts with all that lies between its
    /// centre and its outline.
    pub ratio: f64,
}
