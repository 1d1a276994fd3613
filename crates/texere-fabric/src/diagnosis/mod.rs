//! What is wrong with a cloth, where, and what would cure it.

mod cures;
mod faults;
mod places;

pub use cures::{Cure, Remedy};
pub use faults::{Diagnosis, FaultKind, Faults, JAMS_LISTED, Jams};
pub use places::{
    ClothClearance, Crossing, StitchPlace, ThreadBend, ThreadContact, ThreadCrowd, ThreadDrawn, ThreadPlace,
};
