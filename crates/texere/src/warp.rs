//! Warp knits in code: guide bars and their lappings.
//!
//! | to | use |
//! |---|---|
//! | write a bar's movement in the usual notation, by name or lap by lap | [`Chain`], [`LAPPINGS`], [`Lap`] |
//! | say which guides hold which yarn, and how much each runs in | [`Bar`], [`Threading`], [`RunIn`] |
//! | displace single guides of a Jacquard bar | [`Displacements`] |
//! | make a cloth | [`WarpKnitted`], with a [`Gauge`](crate::weft::Gauge) and [yarns](crate::weft::KnitYarn) |
//!
//! ```
//! use texere::warp::{Bar, Chain, WarpKnitted};
//! use texere::weft::{Gauge, KnitYarn};
//! use texere::yarn::{Material, Section};
//! let locknit = vec![Bar::new(Chain::parse("1-0/2-3//", 1)?), Bar::new(Chain::parse("1-2/1-0//", 1)?)];
//! let (yarns, materials) = (vec![KnitYarn::new(0.05)], vec![Material::default()]);
//! let sections = vec![Section::Circle];
//! let cloth = WarpKnitted::new(locknit, Gauge::new(1.0, 0.75), 4, 2, yarns, materials, sections, [3, 5])?;
//! assert_eq!(cloth.size(), [12, 10]); // wales and courses
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub use texere_fabric::warp::{
    Bar, CHAIN_COURSES, Chain, ChainError, Displacements, LAPPINGS, Lap, LapKind, NEEDLES_MOST, PlacedLap,
    RunIn, SPACE_MAX, Threading, WarpError, WarpKnitted,
};
