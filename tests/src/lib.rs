//! The proof that every backend of texere gives matching output.
//!
//! Every [case](cases) runs on every device that a [registry](REGISTRY) opens, and is compared with an [f64
//! oracle](oracle) that shares no geometry with the core, and with the gold reference, the serial CPU backend. How near
//! is near enough stands in [`compare`]; that the comparison can fail is shown by the broken backends of [`Sabotage`].
//!
//! What a session promises besides its output (each stage's time, the bytes that an edit moves) is tried on each device too.
//! A backend from elsewhere runs the whole suite with one line: see [`run`].

pub mod cases;
mod check;
pub mod compare;
mod deferred;
pub mod drive;
pub mod limits;
pub mod oracle;
mod registry;
mod sabotage;
pub mod schedule;
mod sessions;
mod suite;
mod worst;

pub use check::{check, check_within};
pub use deferred::DeferredBackend;
pub use registry::{Entry, OpenAll, REGISTRY};
pub use sabotage::{Sabotage, SabotagedBackend};
pub use suite::run;
