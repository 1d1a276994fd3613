//! Why an edit was refused.

use texere_core::YarnError;
use texere_core::backend::SessionError;
use texere_cpu::PickError;
use texere_fabric::{FabricError, WovenError};
use thiserror::Error;

/// Why an edit was refused.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum LiveError {
    /// A lift of a fabric that is not woven, or is known by its yarns alone.
    #[error(
        "there is no weave to lift in: the fabric is not woven, or is known by its yarns alone since they were set"
    )]
    NotWoven,
    /// A yarn that there is not.
    #[error("yarn {yarn}, but there are {yarns}, counted from 0")]
    NoYarn {
        /// The yarn.
        yarn: usize,
        /// How many there are.
        yarns: usize,
    },
    /// A material that there is not.
    #[error("material {material}, but there are {materials}, counted from 0")]
    NoMaterial {
        /// The material.
        material: usize,
        /// How many there are.
        materials: usize,
    },
    /// The structure does not take it.
    #[error(transparent)]
    Fabric(#[from] FabricError),
    /// Nothing can be picked.
    #[error(transparent)]
    Pick(#[from] PickError),
    /// Yarns can't be so.
    #[error(transparent)]
    Yarns(#[from] YarnError),
    /// Yarns at rest that are not those of the fabric.
    #[error("{given} yarns at rest of {sections} sections are not the fabric's {yarns} of {own}")]
    OtherYarns {
        /// Yarns given.
        given: usize,
        /// Their sections.
        sections: usize,
        /// Yarns of the fabric.
        yarns: usize,
        /// Its sections.
        own: usize,
    },
    /// The mesh can't be planned, or the device failed.
    #[error(transparent)]
    Session(#[from] SessionError),
}

impl From<WovenError> for LiveError {
    fn from(error: WovenError) -> Self {
        Self::Fabric(error.into())
    }
}
