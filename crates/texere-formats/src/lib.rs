//! Readers and writers of texere: design files in, mesh files and designs out.
//!
//! [`write`](mod@write) turns a mesh into a GLB or PLY file, whole or piece by piece as a device
//! makes it, and a woven design into a WIF draft or a design file.

// What formats share is there in builds without some of them, too. A build with all of them has
// nothing that is not used.
#![cfg_attr(
    not(all(feature = "glb", feature = "knitout", feature = "ply", feature = "toml")),
    allow(dead_code, unused_variables, reason = "formats are left out that it is for")
)]

pub mod read;
mod rest;
pub mod write;
mod yarns_file;

pub use read::{
    Design, FilePlace, MachineFault, NamedPlace, ProgramPlace, ReadError, Refusal, SavedYarns, Structure,
    read, read_from,
};
pub use rest::{Cloth, RestReport, Resting};
pub use write::WriteError;
