//! Readers and writers of texere: design files in, mesh files and designs out.
//!
//! [`write`](mod@write) turns a mesh into a GLB or PLY file, whole or piece by piece as a device makes it, and a woven design into a
//! WIF draft or a design file.

pub mod read;
pub mod write;

pub use read::{Design, MachineFault, NamedPlace, Place, ReadError, Structure, Told, read};
pub use write::WriteError;
