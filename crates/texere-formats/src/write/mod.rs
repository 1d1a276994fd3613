//! Mesh files, written piece by piece and in bounded memory.
//!
//! | format | extension | holds |
//! |---|---|---|
//! | glTF 2.0 binary | `.glb` | a node for each yarn, named by its origin, coloured by its material; metres, +Y up, front +Z |
//! | binary PLY, little endian | `.ply` | one point set with normals and colours, and its triangles; millimetres |
//!
//! Beside meshes there are [drafts](fn@draft) and [pictures](fn@picture), in PNG.
//!
//! What a file holds does not depend on the mesh's [`Topology`]: a plan knows its triangles, so that no index has to
//! come from a device, and GLB keeps the index pattern that all yarns share once, which halves it.
//!
//! A file is written beside its target and renamed when it is complete. After an error, a cancellation or a panic nothing
//! new is left, and an older file of that name is as it was. A program that a signal ends calls [`abandon`] first; files
//! that a killed process left, the next write in that folder removes. An [`Output`] says which files must not be replaced.

mod draft;
mod error;
mod feed;
mod file;
mod format;
mod glb;
mod mesh_writer;
mod output;
mod picture;
mod ply;
mod target;
#[cfg(test)]
mod tests;
mod unfinished;

pub use draft::{NEEDLES_MAX, SHAFTS_MAX, Side, draft, knit_draft, knit_rows, warp_draft, warp_rows};
pub use error::WriteError;
pub use file::file;
pub use format::Format;
pub use output::Output;
pub use picture::picture;
pub use unfinished::abandon;

use std::ops::ControlFlow;

use feed::Feed;
use target::Target;
use texere_core::{Backend, Mesh, MeshPiece, Pipeline, PipelineError, Plan, Settings, Topology};

/// How much was written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Written {
    /// Bytes of the file.
    pub bytes: u64,
    /// Vertices in it; a ring that chunks repeat counts twice.
    pub vertices: u64,
    /// Triangles in it.
    pub triangles: u64,
}

/// Writes a mesh that lies in memory, in the format that the extension of `output` stands for.
///
/// Triangles are those of the mesh's plan; its `indices` are not read, so that any topology will do.
///
/// **Errors**: [`WriteError`] where the format can't hold the mesh, the mesh is not what its plan says or not finite, or
/// the file system refuses.
///
/// ```
/// use texere_core::{ControlPoint, NullBackend, Pipeline, Yarn, Yarns};
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("yarn.glb");
/// let mut yarns = Yarns::builder();
/// yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
/// // Any device does; this one leaves all vertices at the origin.
/// let mesh = Pipeline::new(&yarns.build()?).mesh(&NullBackend::default())?;
/// texere_formats::write::mesh(&mesh, &path)?;
/// assert_eq!(std::fs::read(&path)?[..4], *b"glTF");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn mesh(mesh: &Mesh, output: impl Into<Output>) -> Result<(), WriteError> {
    let output = output.into();
    let format = Format::from_path(output.path())?;
    let shared = Settings { topology: Topology::Shared, ..*mesh.plan.settings() };
    let plan = Plan::new(mesh.plan.layout().clone(), shared).map_err(PipelineError::from)?;
    let mut feed = Feed::open(format, Target::create(output)?, &plan, &mesh.chunks, &mesh.materials)?;
    let (given, planned) = (mesh.vertices.len() as u64, feed.planned());
    if given != planned {
        return Err(WriteError::VertexCount { given, planned });
    }
    let mut left = &mesh.vertices[..];
    for chunk in &mesh.chunks {
        let (vertices, others) = left.split_at(chunk.vertices() as usize);
        feed.vertices(chunk, 0, vertices)?;
        left = others;
    }
    feed.finish()?.commit()?;
    Ok(())
}

/// Runs a pipeline on `device` and writes its mesh piece by piece, in the format that the extension of `output`
/// stands for. At most two chunks of it are in memory.
///
/// The pipeline's topology is replaced by [`Topology::Shared`], so that the device writes no index.
///
/// **Errors**: those of [`mesh`], and [`WriteError::Pipeline`] where the pipeline fails or its progress asks to stop.
///
/// ```
/// # fn example(yarns: &texere_core::Yarns, device: &dyn texere_core::Backend) -> Result<(), texere_formats::WriteError> {
/// use texere_core::{Limits, Pipeline};
/// // Half a gigabyte for control points and two chunks, however large the fabric.
/// let limits = Limits { memory_bytes: 1 << 29, ..Limits::default() };
/// let written = texere_formats::write::stream(Pipeline::new(yarns).limits(limits), device, "damask.ply")?;
/// println!("{} triangles in {} bytes", written.triangles, written.bytes);
/// # Ok(())
/// # }
/// ```
pub fn stream(
    pipeline: Pipeline<'_>,
    device: &dyn Backend,
    output: impl Into<Output>,
) -> Result<Written, WriteError> {
    let output = output.into();
    let format = Format::from_path(output.path())?;
    let pipeline = pipeline.topology(Topology::Shared);
    let plan = pipeline.plan().map_err(PipelineError::from)?;
    let chunks = plan.chunks(&pipeline.limits_on(device)).map_err(PipelineError::from)?;
    let materials = pipeline.yarns().materials().clone();
    let mut feed = Feed::open(format, Target::create(output)?, &plan, chunks, &materials)?;
    let answer = pipeline.stream(device, |chunk, piece| {
        let fed = match piece {
            MeshPiece::Vertices { first, vertices } => feed.vertices(chunk, first, vertices),
            _ => Ok(()),
        };
        match fed {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => ControlFlow::Break(error),
        }
    })?;
    if let ControlFlow::Break(error) = answer {
        return Err(error);
    }
    let vertices = feed.planned();
    let bytes = feed.finish()?.commit()?;
    Ok(Written { bytes, vertices, triangles: plan.counts().triangles })
}
