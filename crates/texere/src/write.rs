//! Files: meshes in pieces, saved yarns, pictures, drafts and designs.
//!
//! [`texere::write`](fn@crate::write) writes a whole mesh. Each function that writes a file, except
//! [`file()`] and [`folder()`], has a twin whose name ends in `_to`. The twin writes the same bytes
//! to a writer of the caller's.
//!
//! | to | use |
//! |---|---|
//! | write a mesh larger than memory | [`stream`], [`stream_to`]; for a plan that exists already [`run`], [`run_to`] |
//! | write a mesh to memory, or to another writer that can seek | [`mesh_to`] |
//! | write a smaller `.glb` file | [`Output::packed`], [`Output::compressed`]; of cloth that repeats [`Output::instanced`] |
//! | give vertices texture coordinates, tangents or numbers of yarns | [`Output::attributes`], [`Format::with`] |
//! | write curves for a simulator that reads straight lines alone | [`Output::linear`] |
//! | save yarns, such as cloth at rest, or a repeat of them | [`yarns`], [`repeat`] |
//! | write centrelines for a simulator or a renderer | [`curves`], [`curves_to`] |
//! | write a design that is read again | `toml`; of woven cloth `wif`, of programs of knitting machines `knitout` (features of these names) |
//! | write a draft as a picture | `draft`, `knit_draft`, `warp_draft` (feature `pictures`) |
//! | write a picture | `picture` (feature `pictures`) |
//! | write any file, or a folder of files, so that it appears whole or not at all | [`file()`], [`folder()`], [`vacant`] |
//! | make sure that no file is replaced that was read | [`Output`] |
//!
//! ```
//! use std::io::Cursor;
//! use texere::write::{Format, mesh_to};
//! use texere::{ControlPoint, Pipeline, Yarn, Yarns};
//! let mut yarns = Yarns::builder();
//! yarns.yarn(Yarn::default(), &[0.0, 1.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
//! let mesh = Pipeline::new(&yarns.build()?).mesh(&*texere::open("cpu")?)?;
//! let mut glb = Cursor::new(Vec::new());
//! mesh_to(&mesh, Format::Glb, &mut glb)?;
//! assert!(glb.into_inner().starts_with(b"glTF"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub use texere_formats::write::{
    CurveFormat, Format, MeshForm, Output, VertexAttribute, Written, abandon, curves, curves_to, file,
    folder, mesh_to, repeat, repeat_to, run, run_to, stream, stream_to, vacant, yarns, yarns_to,
};
#[cfg(feature = "pictures")]
pub use texere_formats::write::{
    Side, draft, draft_to, knit_draft, knit_draft_to, knit_rows, picture, picture_to, warp_draft,
    warp_draft_to, warp_rows,
};
#[cfg(feature = "knitout")]
pub use texere_formats::write::{knitout, knitout_to};
#[cfg(feature = "toml")]
pub use texere_formats::write::{toml, toml_to};
#[cfg(feature = "wif")]
pub use texere_formats::write::{wif, wif_to};
