//! Readers and writers of files. The readers read designs, saved yarns and curves. The writers
//! write meshes, saved yarns, curves, designs, drafts and pictures.
//!
//! [`write`](mod@write) turns a mesh into a GLB, PLY, STL, OBJ or USD file, whole or piece by piece
//! as a device makes it. It also turns designs into WIF drafts, knitout files or design files,
//! saves yarns and their centrelines, and draws drafts, charts and lapping diagrams.

// A build without some formats still compiles the code that all formats share, and does not use all
// of that code. A build with all formats has no unused code.
#![cfg_attr(
    not(all(feature = "glb", feature = "knitout", feature = "ply", feature = "texgen", feature = "toml")),
    allow(dead_code, unused_variables, reason = "formats are left out that it is for")
)]

mod bcc_file;
pub mod read;
#[cfg(feature = "serde")]
mod report;
mod rest;
pub mod write;
mod yarns_file;

pub use read::{
    Design, FilePlace, MachineFault, NamedPlace, ProgramPlace, ReadError, Refusal, SavedYarns, Structure,
    read, read_from,
};
#[cfg(feature = "serde")]
pub use report::{CheckReport, InspectReport, SettlingReport, StrainReport};
pub use rest::{Cloth, RestReport, Resting};
pub use write::WriteError;
