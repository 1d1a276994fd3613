//! Contacts of yarns: where they are, how near they come, and how many are looked for.

use texere_core::YarnPlace;

use crate::grid;

/// Contacts further apart than this factor are not looked for.
pub const CLEARANCE_NEAR: f64 = 1.1;

/// Surfaces as clear as this share of touching do not pierce one another.
///
/// Splines through points at which round threads just touch come to 0.987 between them (poplin,
/// docs/SETTLING.md), and woven cloth at rest is brought to 0.986: at 0.99 both would be faults.
pub const CLEAR: f64 = 0.985;

/// How exact a ratio is: yarns at 0.999 of touching count as touching.
///
/// Of yarns with plies, corners or twisted flat sections a touch may stay unseen that is nearer by
/// up to 0.003; where such a yarn bends as sharply as it is thick and meets itself there, more than
/// that. Of their ratios below 0.25 no smaller one is looked for. Where a section reaches four
/// times as far as its control points lie apart it counts by its hull, untwisted.
///
/// Of two approaches side by side on one pair of sharply bent intervals of flattened yarns the
/// nearer may stay unseen.
pub const CLEARANCE_ACCURACY: f64 = 1e-3;

/// The most contacts that are listed one by one.
pub const CONTACTS_LISTED: usize = 100;

/// The most control intervals that one is compared with in a cell of the search, beside each other
/// on one plane through it.
///
/// Yarns that are clear of one another come that close where a radius has some 250 control points,
/// or where a thousand straight yarns of two points lie side by side.
pub const CLEARANCE_BESIDE: usize = 1024;

/// The most pairs of control intervals that are looked at for each control point: an interval lies
/// in 6 cells on average at most, and is compared with [`CLEARANCE_BESIDE`] in each. Of cloth it is
/// 20 to 60.
pub const CLEARANCE_PAIRS: u64 = grid::ENTRIES * CLEARANCE_BESIDE as u64;

/// Width of a bin of the histogram.
pub const CLEARANCE_BIN: f64 = 0.01;

/// Where two yarns, or two parts of one, are nearer to one another than anywhere close by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// The two places, the lower yarn first.
    pub places: [YarnPlace; 2],
    /// The factor by which both sections could grow until their surfaces touch: 1 where they just
    /// do, less where they pierce. Of round yarns it is the distance of the centrelines over the
    /// sum of the radii. A section counts with all that lies between its centre and its outline.
    pub ratio: f64,
}
