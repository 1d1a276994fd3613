//! Readers and writers of texere: design files in, mesh files out.
//!
//! [`write`](mod@write) turns a mesh into a GLB or PLY file, whole or piece by piece as a device makes it.

pub mod read;
pub mod write;

pub use read::{Design, MachineFault, Place, ReadError, Structure, Told, read};
pub use write::WriteError;
