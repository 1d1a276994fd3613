//! What can go wrong while yarns settle.

use texere_contact::ContactError;
use texere_core::{BackendError, CrossingsError, Origin, OutOfMemory, RelaxationError, SettlingError};
use thiserror::Error;

use crate::FabricError;

/// Yarns that could not be settled.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FinishError {
    /// The structure's yarns can't be made, or the settled yarns can't be measured. The variant
    /// holds [`FabricError::Cancelled`] if the progress callback asked to stop.
    #[error(transparent)]
    Fabric(#[from] FabricError),
    /// Yarns that can't be settled as asked.
    #[error(transparent)]
    Settling(#[from] SettlingError),
    /// A thread that can't be settled as asked.
    #[error("{thread} can't settle")]
    Thread {
        /// The thread.
        thread: Origin,
        /// The reason.
        source: SettlingError,
    },
    /// Yarns that can't be relaxed as asked.
    #[error(transparent)]
    Relaxation(#[from] RelaxationError),
    /// A cloth that can't come to rest by its energy.
    #[error("rest by energy is for knits that repeat: {cloth}")]
    NoEnergy {
        /// What the cloth is instead.
        cloth: &'static str,
    },
    /// Strains that can't be measured.
    #[error("strains lie between {low} and {high}, and each is greater than the one before")]
    Strains {
        /// The least strain allowed.
        low: f64,
        /// The greatest strain allowed.
        high: f64,
    },
    /// Yarns that have passed through one another, or could not be compared.
    #[error("yarns have passed through one another at a strain of {strain:.3}, or could not be compared")]
    Passed {
        /// The strain. It is 0 at rest.
        strain: f64,
    },
    /// A request for woven cloth that only knits can meet.
    #[error("woven cloth comes to rest by its crossings: {asked} is for knits")]
    Woven {
        /// `a length`, `a press` or `a course`.
        asked: &'static str,
    },
    /// Woven cloth that can't be made as long as was asked for while its threads keep their
    /// lengths: threads are straight, or the cloth jams, before it is that long.
    #[error(
        "cloth can't be {by} times as long along its {along} while its threads keep their lengths: these are straight at {most:.4}, and jam where it draws in too far"
    )]
    Stretch {
        /// `warp` or `weft`.
        along: &'static str,
        /// The factor that was asked for.
        by: f64,
        /// The factor at which the cloth's threads are straight.
        most: f64,
    },
    /// Crossings of woven cloth that can't be settled.
    #[error(transparent)]
    Crossings(#[from] CrossingsError),
    /// A device that failed, a backend that can't settle, or too many yarns in one place.
    #[error(transparent)]
    Backend(#[from] BackendError),
}

impl From<ContactError> for FinishError {
    fn from(error: ContactError) -> Self {
        Self::Fabric(error.into())
    }
}

impl From<OutOfMemory> for FinishError {
    fn from(error: OutOfMemory) -> Self {
        Self::Fabric(error.into())
    }
}
