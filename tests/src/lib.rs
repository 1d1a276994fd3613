//! The conformance suite: it proves that all backends of texere give matching output.
//!
//! Every [case](cases) runs on every device that a [registry](REGISTRY) opens, and is compared with
//! an [f64 oracle](oracle) that shares no geometry with the core, and with the gold reference, the
//! serial CPU backend. [`compare`] has the tolerances. The broken backends of [`Sabotage`] show
//! that the comparison can fail.
//!
//! [`rest`] has starts for settling, and checks of the cloth at rest.
//!
//! The suite also checks a session's times and the bytes that an edit moves, on each device. A
//! backend from elsewhere runs the whole suite with one line: see [`run`].

mod broken_crossings;
mod broken_settler;
pub mod cases;
mod check;
mod claims;
pub mod compare;
mod deferred;
pub mod drive;
pub mod limits;
pub mod oracle;
mod packed;
mod poison;
mod registry;
pub mod rest;
mod sabotage;
pub mod schedule;
mod sessions;
mod suite;
mod worst;

pub use broken_crossings::{CrossingsSabotage, SabotagedCrossings};
pub use broken_settler::{SabotagedSettler, SettlingSabotage};
pub use check::{check, check_within};
pub use deferred::DeferredBackend;
pub use packed::{PackedError, check_packed};
pub use registry::{Entry, OpenAll, REGISTRY, editing_devices, near_devices};
pub use sabotage::{Sabotage, SabotagedBackend};
pub use suite::run;
