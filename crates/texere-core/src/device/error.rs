//! Errors of backends.

use thiserror::Error;

use crate::{OutOfMemory, counted};

/// A failure of a backend. What the core refuses before it calls a backend has error types of its
/// own.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum BackendError {
    /// No device has the name.
    #[error("no device \"{wanted}\"; there are: {}", if .found.is_empty() { "none".into() } else { .found.join(", ") })]
    NoDevice {
        /// The name asked for.
        wanted: String,
        /// Names that would have worked.
        found: Vec<String>,
    },
    /// The name is of a device that this build of texere can't open.
    #[error("no device \"{wanted}\" in this build; texere opens it with its feature \"{feature}\"")]
    NoFeature {
        /// The name asked for.
        wanted: String,
        /// The feature of the crate `texere` that adds the device.
        feature: &'static str,
    },
    /// An environment variable names vector instructions that the processor lacks or that texere
    /// does not know.
    #[error("{variable} is \"{wanted}\"; this processor has: {}", .found.join(", "))]
    NoInstructionSet {
        /// The variable's name.
        variable: &'static str,
        /// The variable's value.
        wanted: String,
        /// Names that would have worked.
        found: Vec<&'static str>,
    },
    /// The device, or its schedule, makes no attributes of vertices.
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
    /// The backend can't relax yarns.
    #[error("{name} can't relax yarns by their energy")]
    NoRelaxation {
        /// The backend's name.
        name: String,
    },
    /// An allocation failed.
    #[error(transparent)]
    OutOfMemory(#[from] OutOfMemory),
    /// Too many yarns lie in one place, so that a settling would have to compare too many pairs of
    /// chords.
    #[error(
        "more than {limit} pairs of neighbours among {chords}: too many yarns lie in one place to settle", chords = counted(*.chords, "chord"))]
    Crowded {
        /// Number of chords of all yarns.
        chords: u64,
        /// The most pairs that are listed for this number of chords.
        limit: u64,
    },
    /// The device is lost, and with it the session. A new session on a healthy device works.
    #[error("device {device} is lost")]
    DeviceLost {
        /// The device's name.
        device: String,
        /// The driver's message.
        source: Option<Box<dyn std::error::Error + Send + Sync>>,
    },
    /// The backend, or its schedule, can't do what was asked for.
    #[error("{schedule} does not do {what}")]
    Unsupported {
        /// The backend and its schedule.
        schedule: String,
        /// What was asked for.
        what: String,
    },
    /// The driver refused to compile a kernel.
    #[error("kernel {kernel} does not compile:\n{log}")]
    Compile {
        /// The kernel's name.
        kernel: &'static str,
        /// The driver's whole log.
        log: String,
    },
    /// An engine was asked to work on a chunk that is not loaded, or that belongs to another plan.
    /// A session never does this.
    #[error("chunk {chunk} is not loaded")]
    NotLoaded {
        /// The chunk's index.
        chunk: u64,
    },
    /// A call of the driver failed.
    #[error("{call} failed")]
    Driver {
        /// The name of the call.
        call: &'static str,
        /// The driver's message.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
}
