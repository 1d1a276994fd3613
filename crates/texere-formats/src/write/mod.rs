//! Mesh files, written piece by piece and in bounded memory; designs, drafts and pictures.
//!
//! | format | extension | feature | holds |
//! |---|---|---|---|
//! | glTF 2.0 binary | `.glb` | `glb` | a node for each yarn, named by its origin, coloured by its material; metres, +Y up, front +Z |
//! | binary PLY, little endian | `.ply` | `ply` | one point set with normals and colours, and its triangles; millimetres |
//!
//! Beside meshes there are [drafts](fn@draft) and [pictures](fn@picture), in PNG, and designs that
//! are read again, as [WIF](fn@wif) or as texere's own [design file](fn@toml).
//!
//! [Yarns](fn@yarns) are saved in files of their own (`.yarns`), which are read again to the bit,
//! so that cloth at rest need not settle again.
//!
//! What a file holds does not depend on the mesh's [`Topology`](texere_core::Topology), nor on
//! where its chunks are cut: a plan knows its triangles, so that no index has to come from a
//! device, and a ring that chunks repeat is written once. So the triangles of a yarn share vertices
//! from its first ring to its last: it is one piece for a reader that joins nothing of itself. Only
//! caps have vertices of their own, since their normals differ from those of the rings that they
//! close; their places are equal to the bit. GLB keeps the index pattern that all yarns share once,
//! which halves it.
//!
//! A file is written beside its target and renamed when it is complete. After an error, a
//! cancellation or a panic nothing new is left, and an older file of that name is as it was. A
//! program that a signal ends calls [`abandon`] first; files that a killed process left, the next
//! write in that folder removes. An [`Output`] says which files must not be replaced.
//!
//! Each function but [`file`](fn@file) has a twin whose name ends in `_to`. It writes the same
//! bytes to any writer of the caller's: memory, an archive, a connection. Meshes go back to fill in
//! what is known last, so theirs also seeks.

#[cfg(feature = "wif")]
mod design;
#[cfg(feature = "pictures")]
mod draft;
mod error;
mod feed;
mod file;
mod format;
#[cfg(feature = "glb")]
mod glb;
mod mesh;
mod mesh_writer;
mod output;
#[cfg(feature = "pictures")]
mod picture;
mod places;
#[cfg(feature = "ply")]
mod ply;
mod target;
#[cfg(test)]
mod tests;
mod unfinished;
mod yarns;

#[cfg(feature = "toml")]
pub use design::{toml, toml_to};
#[cfg(feature = "wif")]
pub use design::{wif, wif_to};
#[cfg(feature = "pictures")]
pub use draft::{
    Side, draft, draft_to, knit_draft, knit_draft_to, knit_rows, warp_draft, warp_draft_to, warp_rows,
};
pub use error::WriteError;
pub use file::file;
pub use format::Format;
pub use mesh::{Written, mesh, mesh_to, stream, stream_to};
pub use output::Output;
#[cfg(feature = "pictures")]
pub use picture::{picture, picture_to};
pub use unfinished::abandon;
pub use yarns::{repeat, repeat_to, yarns, yarns_to};
