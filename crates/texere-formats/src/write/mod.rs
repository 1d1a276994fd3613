//! Writers of mesh files, piece by piece and in bounded memory, and of designs, drafts, pictures
//! and saved yarns.
//!
//! | format | extension | feature | holds |
//! |---|---|---|---|
//! | glTF 2.0 binary | `.glb` | `glb` | a node for each yarn, named by its origin, coloured by its material; metres, +Y up, front +Z; [packed](Output::packed) it has half the bytes for a vertex, [compressed](Output::compressed) a third |
//! | binary PLY, little endian | `.ply` | `ply` | one point set with normals and colours, and its triangles; millimetres |
//! | binary STL | `.stl` | `stl` | the triangles alone, each with its corners; millimetres |
//! | USD, the text form | `.usda` | none | a prim for each yarn, named by its origin, with normals and its colour; millimetres |
//! | OBJ | `.obj` | `obj` | a group for each yarn with normals and texture coordinates, and the yarns' materials in an `.mtl` file beside it; millimetres |
//!
//! Vertices of a GLB, a PLY and a USD mesh may have [attributes](Output::attributes): texture
//! coordinates, tangents, numbers of yarns.
//!
//! There are also writers of [drafts](fn@draft), [stitch charts](knit_draft), [lapping
//! diagrams](warp_draft) and [pictures](fn@picture) as PNG, and of designs: woven ones as
//! [WIF](fn@wif), weft knits that came from knitout as [knitout](fn@knitout), and woven cloth,
//! charts and warp knits as texere's own [design file](fn@toml). texere reads all three kinds of
//! file again, and gets the same structure.
//!
//! Centrelines are written as [curves](fn@curves): BCC (`.bcc`) and USD's text form (`.usda`), for
//! simulators and renderers.
//!
//! [Yarns](fn@yarns) are saved in `.yarns` files. They are read again to the bit, so that cloth at
//! rest need not settle again.
//!
//! A file does not depend on the mesh's [`Topology`](texere_core::Topology), nor on where its
//! chunks are cut. The triangles follow from the plan, so no index has to come from a device. A
//! ring that chunks repeat is written once. The triangles of a yarn therefore share vertices from
//! its first ring to its last, except in STL, which has no shared vertices. Even a reader that does
//! not join equal vertices gets each yarn as one piece. Only caps have vertices of their own,
//! because their normals differ from those of the rings that they close. The positions of a cap are
//! equal to those of its ring to the bit. All yarns share an index pattern, which GLB holds only
//! once. This halves the file.
//!
//! An [instanced](Output::instanced) GLB is another matter. It has a node for each part of a yarn
//! that differs from the others, and parts share no vertices. Where two parts meet, or a part and a
//! cap, they may be some millionths of the cloth's largest coordinate apart.
//!
//! A file is written beside its target and renamed when it is complete. An error, a cancellation or
//! a panic leaves no new file, and an older file of that name stays as it was. A program that
//! handles a signal calls [`abandon`] before it ends. The next write in a folder removes files that
//! a killed process left there. An [`Output`] says which files must not be replaced.
//!
//! [`folder`](fn@folder) makes a folder of files in the same way, but never replaces a folder that
//! has files in it. If the process is killed, the unfinished folder stays.
//!
//! Each function that writes a file, except [`file`](fn@file), has a twin whose name ends in `_to`.
//! The twin writes the same bytes to any writer of the caller's: memory, an archive, a connection.
//! Twins for meshes need a writer that seeks, because they go back to fill in values that are known
//! last.

mod beside;
mod bounds;
mod corners;
mod curve_format;
mod curves;
#[cfg(any(feature = "knitout", feature = "wif"))]
mod design;
#[cfg(feature = "pictures")]
mod draft;
mod error;
mod feed;
mod file;
mod folder;
mod format;
#[cfg(feature = "glb")]
mod glb;
mod mesh;
mod mesh_form;
mod mesh_writer;
#[cfg(feature = "obj")]
mod obj;
mod output;
#[cfg(feature = "pictures")]
mod picture;
mod places;
#[cfg(feature = "ply")]
mod ply;
#[cfg(feature = "glb")]
mod spool;
#[cfg(feature = "stl")]
mod stl;
mod target;
#[cfg(test)]
mod tests;
mod unfinished;
mod usd_mesh;
mod usda;
mod yarn_name;
mod yarns;

pub use curve_format::CurveFormat;
pub use curves::{curves, curves_to};
#[cfg(feature = "knitout")]
pub use design::{knitout, knitout_to};
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
pub use folder::{folder, vacant};
pub use format::Format;
pub use mesh::{Written, mesh, mesh_to, run, run_to, stream, stream_to};
pub use mesh_form::{MeshForm, VertexAttribute};
pub use output::Output;
#[cfg(feature = "pictures")]
pub use picture::{picture, picture_to};
pub use unfinished::abandon;
pub use yarns::{repeat, repeat_to, yarns, yarns_to};
