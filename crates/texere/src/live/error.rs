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
    /// A lift was set in a fabric without a weave: a knit, or a fabric whose yarns were
    /// [given](crate::Live::given) or all [replaced](crate::Live::set_yarns).
    #[error(
        "there is no weave to lift in: the fabric is not woven, or is known by its yarns alone since they were set"
    )]
    NotWoven,
    /// No yarn has this number.
    #[error("there is no yarn {yarn}: there are {yarns}, numbered from 0")]
    NoYarn {
        /// The number, counted from 0.
        yarn: usize,
        /// Number of yarns of the fabric.
        yarns: usize,
    },
    /// No material has this number.
    #[error("there is no material {material}: there are {materials}, numbered from 0")]
    NoMaterial {
        /// The number, counted from 0.
        material: usize,
        /// Number of materials of the fabric.
        materials: usize,
    },
    /// The structure refuses the edit.
    #[error(transparent)]
    Fabric(#[from] FabricError),
    /// A picker can't be made.
    #[error(transparent)]
    Pick(#[from] PickError),
    /// The yarns break a rule of all yarns.
    #[error(transparent)]
    Yarns(#[from] YarnError),
    /// The yarns at rest, or their sections, are not as many as the fabric's.
    #[error("{given} yarns at rest of {sections} sections are not the fabric's {yarns} of {own}")]
    OtherYarns {
        /// Number of yarns at rest.
        given: usize,
        /// Number of sections of the yarns at rest.
        sections: usize,
        /// Number of yarns of the fabric.
        yarns: usize,
        /// Number of sections of the fabric.
        own: usize,
    },
    /// The mesh can't be planned, a yarn has a value that no yarn may have, or the device failed.
    #[error(transparent)]
    Session(#[from] SessionError),
}

impl From<WovenError> for LiveError {
    fn from(error: WovenError) -> Self {
        Self::Fabric(error.into())
    }
}
