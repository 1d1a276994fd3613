//! Faults and measures of a cloth.
//!
//! | to | use |
//! |---|---|
//! | know what is wrong with a structure, and which single change would cure it | [`Diagnosis`], [`Faults`], [`Cure`] |
//! | know whether yarns pierce one another, and where | [`clearance()`], which gives a [`Clearance`]; [`ClothClearance`] names threads |
//! | know whether yarns that were moved passed through one another | [`linking()`], which gives a [`Linking`] |
//! | know whether a mesh's tubes are wrung (narrowed, because neighbouring rings are turned against one another), and how many subdivisions cure that | [`drawn()`], [`finer`] |
//! | know weight, thickness, yarn consumption, cover and crimp of woven cloth, loops of a knit | [`Measures`], [`KnitMeasures`] |
//! | make one report of all of that, for people or as JSON | `InspectReport`, `CheckReport` (feature `serde`) |
//! | report how a knit pulls when it is strained, as tables or as JSON | `StrainReport` (feature `serde`) |
//!
//! ```
//! use texere::check::clearance;
//! use texere::{ControlPoint, Settings, Yarn, Yarns};
//! // Two straight yarns of radius 0.125 mm cross at a distance of 0.1875 mm, so they pierce.
//! let mut yarns = Yarns::builder();
//! yarns.yarn(Yarn::default(), &[-1.0, 1.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.125)));
//! yarns.yarn(Yarn::default(), &[-1.0, 1.0].map(|y| ControlPoint::new(0.5, y, 0.1875, 0.125)));
//! let clearance = clearance(&yarns.build()?, &Settings::default())?;
//! assert!((clearance.min - 0.75).abs() < 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub use texere_contact::{
    CLEAR, CLEARANCE_ACCURACY, CLEARANCE_BESIDE, CLEARANCE_BIN, CLEARANCE_NEAR, CLEARANCE_PAIRS, Clearance,
    Contact, ContactError, Crowd, Drawn, LINKING_CHANGE, Linking, Passage, WRUNG, clearance,
    clearance_with_progress, drawn, finer, linking, linking_with_progress,
};
pub use texere_core::counted;
pub use texere_fabric::{
    ClothClearance, ClothFault, Cover, Crossing, Cure, Diagnosis, FabricWarning, Faults, Jams, KnitMeasures,
    Measures, Pieces, Remedy, StitchPlace, ThreadBend, ThreadContact, ThreadCrowd, ThreadDrawn, ThreadPlace,
};
#[cfg(feature = "serde")]
pub use texere_formats::{CheckReport, InspectReport, SettlingReport, StrainReport};
