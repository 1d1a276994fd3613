//! Diagnosis of a cloth: its faults, the places of the faults, and cures.

mod cures;
mod faults;
mod joined;
mod pieces;
mod places;
mod search;
mod trial;
mod verdict;

pub use cures::{Cure, Remedy};
pub use faults::{ClothFault, Diagnosis, Faults, Jams};
pub(crate) use joined::Joined;
pub use pieces::Pieces;
pub use places::{
    ClothClearance, Crossing, StitchPlace, ThreadBend, ThreadContact, ThreadCrowd, ThreadDrawn, ThreadPlace,
};
pub use verdict::Verdict;
pub(crate) use verdict::is_clear;
