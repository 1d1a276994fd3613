//! What a backend can fail at.

use thiserror::Error;

use crate::{OutOfMemory, counted};

/// A failure of a backend. Whatever the core can check beforehand is not among these.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum BackendError {
    /// No device answers to the name.
    #[error("no device \"{wanted}\"; there are: {}", if .found.is_empty() { "none".into() } else { .found.join(", ") })]
    NoDevice {
        /// The name asked for.
        wanted: String,
        /// Names that would have worked.
        found: Vec<String>,
    },
    /// The name is that of a device which this build of texere can't open.
    #[error("no device \"{wanted}\" in this build; texere opens it with its feature \"{feature}\"")]
    NoFeature {
        /// The name asked for.
        wanted: String,
        /// The feature of the crate `texere`.
        feature: &'static str,
    },
    /// An environment variable names vector instructions that the processor does not have, or that
    /// texere does not know.
    #[error("{variable} is \"{wanted}\"; this processor has: {}", .found.join(", "))]
    NoInstructionSet {
        /// The variable.
        variable: &'static str,
        /// What it says.
        wanted: String,
        /// Names that would have worked.
        found: Vec<&'static str>,
    },
    /// The device, or its schedule, makes no attributes.
    #[error("no attributes are made on this device, or not in its schedule")]
    NoAttributes,
    /// The device, or its schedule, packs no vertices.
    #[error("no vertices are packed on this device, or not in its schedule")]
    NoPacking,
    /// The device, or its schedule, can't make a mesh that is edited.
    #[error("yarns can't be edited on this device, or not in its schedule")]
    NoEditing,
    /// The backend can't settle yarns.
    #[error("{name} can't settle yarns")]
    NoSettling {
        /// The backend's name.
        name: String,
    },
    /// The backend can't settle crossings.
    #[error("{name} can't settle crossings of woven cloth")]
    NoCrossings {
        /// The backend's name.
        name: String,
    },
    /// Memory could not be had.
    #[error(transparent)]
    OutOfMemory(#[from] OutOfMemory),
    /// Yarns that lie so thick over one another that a settling would have to look at too many
    /// pairs of them.
    #[error(
        "more than {limit} pairs of neighbours among {chords}: too many yarns lie in one place to settle", chords = counted(*.chords, "chord"))]
    Crowded {
        /// Chords of all yarns.
        chords: u64,
        /// Pairs that are listed at most for so many.
        limit: u64,
    },
    /// The device is lost, and the session with it. A new session on a healthy device works.
    #[error("device {device} is lost")]
    DeviceLost {
        /// Its name.
        device: String,
        /// What the driver said.
        source: Option<Box<dyn std::error::Error + Send + Sync>>,
    },
    /// The backend or its schedule does not do this.
    #[error("{schedule} does not do {what}")]
    Unsupported {
        /// Backend and schedule.
        schedule: String,
        /// What was asked for.
        what: String,
    },
    /// A kernel that the driver would not compile.
    #[error("kernel {kernel} does not compile:\n{log}")]
    Compile {
        /// The kernel.
        kernel: &'static str,
        /// The driver's whole log.
        log: String,
    },
    /// An engine was asked to work on a chunk that is not loaded, or belongs to another plan. A
    /// session never does this.
    #[error("chunk {chunk} is not loaded")]
    NotLoaded {
        /// The chunk's index.
        chunk: u64,
    },
    /// A driver call that failed.
    #[error("{call} failed")]
    Driver {
        /// The call.
        call: &'static str,
        /// What the driver said.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
}
