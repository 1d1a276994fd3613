//! Writes meshes to files: whole, or piece by piece as a device makes them.

use std::io::{Seek, Write};
use std::ops::ControlFlow;

use texere_core::backend::{Chunk, Run};
use texere_core::{Backend, Material, Mesh, MeshPiece, Pipeline, PipelineError, Topology};

use super::beside::Beside;
use super::bounds::Bounds;
use super::feed::{self, Feed};
use super::mesh_form::MeshForm;
use super::places::RingForm;
use super::target::Target;
use super::{Output, WriteError};

/// How much was written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Written {
    /// Bytes of the file.
    pub bytes: u64,
    /// Vertices of the mesh. A ring that chunks repeat counts once. If the file has texture
    /// coordinates, each ring counts one vertex more, except in OBJ. STL files and instanced files
    /// hold another number of vertices.
    pub vertices: u64,
    /// Triangles of the mesh, all of which the file draws.
    pub triangles: u64,
}

/// Writes a mesh in memory to a file, in the format that the extension of `output` stands for.
///
/// The triangles come from the mesh's plan. The mesh's `indices` are not read, so the mesh may have
/// any topology.
///
/// **Errors**: [`WriteError`] for an extension that stands for no format of this build, for a mesh
/// that the format can't hold, that has no triangles, that does not match its plan or its
/// materials, or that has numbers that are not finite, for a file that must not be replaced, and if
/// the file system refuses.
///
/// ```
/// use texere_core::backend::NullBackend;
/// use texere_core::{ControlPoint, Pipeline, Yarn, Yarns};
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
    let form = output.mesh_form()?;
    let beside = Beside::of(form.format, &output, &mesh.materials)?;
    let target = whole(mesh, form, || Target::create(output))?;
    beside.commit(target)?;
    Ok(())
}

/// Writes a mesh in memory to `out`, from its current position on: the bytes that [`mesh`](fn@mesh)
/// writes to a file. Afterwards the position of `out` is behind the last byte.
///
/// **Errors**: the errors of [`mesh`](fn@mesh), and [`WriteError::Writer`] if `out` refuses bytes.
/// The bytes that `out` has then are not a whole file.
///
/// ```
/// use std::io::Cursor;
/// use texere_core::{ControlPoint, Pipeline, Yarn, Yarns};
/// use texere_cpu::ParallelBackend;
/// use texere_formats::write::{self, Format};
/// let mut yarns = Yarns::builder();
/// yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
/// let mesh = Pipeline::new(&yarns.build()?).mesh(&ParallelBackend::open()?)?;
/// let mut glb = Cursor::new(Vec::new());
/// write::mesh_to(&mesh, Format::Glb, &mut glb)?;
/// assert!(glb.into_inner().starts_with(b"glTF"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn mesh_to(mesh: &Mesh, form: impl Into<MeshForm>, out: impl Write + Seek) -> Result<(), WriteError> {
    whole(mesh, form.into(), || Target::within(out))?.close()?;
    Ok(())
}

/// Writes a mesh to the target that `start` gives.
fn whole<W: Write + Seek>(
    mesh: &Mesh,
    form: MeshForm,
    start: impl FnOnce() -> Result<Target<W>, WriteError>,
) -> Result<Target<W>, WriteError> {
    form.format.check_holds(form.attributes)?;
    feed::check(&mesh.plan, &mesh.materials)?;
    let target = start()?;
    let bounds = if form.format.needs_bounds() { Some(bounds(mesh)?) } else { None };
    let mut feed = Feed::open(form, target, &mesh.plan, &mesh.chunks, &mesh.materials, bounds.as_ref())?;
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
    feed.finish()
}

/// Runs a pipeline on `device` and writes its mesh piece by piece, in the format that the extension
/// of `output` stands for. At most two chunks of the mesh are in memory.
///
/// The pipeline's topology is replaced by [`Topology::Shared`], so that the device writes no index.
///
/// **Errors**: the errors of [`mesh`](fn@mesh), and [`WriteError::Pipeline`] if the pipeline fails
/// or its progress asks to stop.
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
    output.mesh_form()?;
    output.check()?;
    let materials = pipeline.yarns().materials().clone();
    run(pipeline.topology(Topology::Shared).into_run(device)?, &materials, output)
}

/// Runs a pipeline on `device` and writes its mesh to `out` piece by piece, from the current
/// position on: the bytes that [`stream`] writes to a file. Afterwards the position of `out` is
/// behind the last byte.
///
/// **Errors**: the errors of [`stream`], and [`WriteError::Writer`] if `out` refuses bytes. The
/// bytes that `out` has then are not a whole file.
///
/// ```
/// use std::io::Cursor;
/// use texere_core::{ControlPoint, Pipeline, Yarn, Yarns};
/// use texere_cpu::ParallelBackend;
/// use texere_formats::write::{self, Format};
/// let mut yarns = Yarns::builder();
/// yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
/// let yarns = yarns.build()?;
/// let mut ply = Cursor::new(Vec::new());
/// let written = write::stream_to(Pipeline::new(&yarns), &ParallelBackend::open()?, Format::Ply, &mut ply)?;
/// assert_eq!(ply.into_inner().len() as u64, written.bytes);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn stream_to(
    pipeline: Pipeline<'_>,
    device: &dyn Backend,
    form: impl Into<MeshForm>,
    out: impl Write + Seek,
) -> Result<Written, WriteError> {
    let materials = pipeline.yarns().materials().clone();
    run_to(pipeline.topology(Topology::Shared).into_run(device)?, &materials, form, out)
}

/// Writes the mesh of a [run](Run) piece by piece, in the format that the extension of `output`
/// stands for. The function is meant for a program that has a plan already. [`stream`] makes a plan
/// itself. `materials` are those of the plan's yarns.
///
/// The plan may have any topology, because no index is read. With [`Topology::None`] or
/// [`Topology::Shared`] the device does not write indices in vain.
/// [`Plan::with_topology`](texere_core::backend::Plan::with_topology) gives such a plan.
///
/// **Errors**: the errors of [`stream`].
///
/// ```
/// use std::ops::ControlFlow;
/// use std::sync::Arc;
/// use texere_core::backend::{Plan, Run};
/// use texere_core::{ControlPoint, Limits, Settings, Topology, Yarn, Yarns};
/// use texere_cpu::ParallelBackend;
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("yarn.ply");
/// # let mut yarns = Yarns::builder();
/// # yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
/// # let (yarns, device) = (yarns.build()?, ParallelBackend::open()?);
/// let plan = Plan::new(yarns.layout().clone(), Settings::default())?;
/// let plan = Arc::new(plan.with_topology(Topology::Shared));
/// let run = Run::start(&device, plan, yarns.points(), Limits::default(), |_| ControlFlow::Continue(()))?;
/// let written = texere_formats::write::run(run, yarns.materials(), &path)?;
/// assert_eq!(written.vertices, 30);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn run(run: Run<'_>, materials: &[Material], output: impl Into<Output>) -> Result<Written, WriteError> {
    let output = output.into();
    let form = output.mesh_form()?;
    let beside = Beside::of(form.format, &output, materials)?;
    let (target, written) = streamed(run, materials, form, || Target::create(output))?;
    Ok(Written { bytes: beside.commit(target)?, ..written })
}

/// Writes the mesh of a [run](Run) to `out` piece by piece, from the current position on: the bytes
/// that [`run`] writes to a file. Afterwards the position of `out` is behind the last byte.
///
/// **Errors**: the errors of [`stream_to`].
pub fn run_to(
    run: Run<'_>,
    materials: &[Material],
    form: impl Into<MeshForm>,
    out: impl Write + Seek,
) -> Result<Written, WriteError> {
    let (target, written) = streamed(run, materials, form.into(), || Target::within(out))?;
    Ok(Written { bytes: target.close()?, ..written })
}

/// Writes the mesh of a run to the target that `start` gives. Returns the target, which the caller
/// completes, and how much was written, with 0 for the bytes.
fn streamed<W: Write + Seek>(
    mut run: Run<'_>,
    materials: &[Material],
    form: MeshForm,
    start: impl FnOnce() -> Result<Target<W>, WriteError>,
) -> Result<(Target<W>, Written), WriteError> {
    let (plan, limits) = (run.plan().clone(), run.limits());
    let chunks = || plan.chunks(&limits).map_err(PipelineError::from);
    form.format.check_holds(form.attributes)?;
    feed::check(&plan, materials)?;
    let target = start()?;
    let bounds = if form.format.needs_bounds() { Some(survey(&mut run, chunks()?)?) } else { None };
    let mut feed = Feed::open(form, target, &plan, chunks()?, materials, bounds.as_ref())?;
    let answer = run.stream(chunks()?, |chunk, piece| {
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
    let vertices = RingForm::new(&plan, form.has_seam()).vertices(&plan);
    let written = Written { bytes: 0, vertices, triangles: plan.counts().triangles };
    Ok((feed.finish()?, written))
}

/// The boxes of the yarns of a mesh in memory.
fn bounds(mesh: &Mesh) -> Result<Bounds, WriteError> {
    let mut bounds = Bounds::new(&mesh.plan)?;
    let mut left = &mesh.vertices[..];
    for chunk in &mesh.chunks {
        // A mesh of too few vertices is refused later.
        let (vertices, others) = left.split_at((chunk.vertices() as usize).min(left.len()));
        bounds.include(chunk, 0, vertices);
        left = others;
    }
    Ok(bounds)
}

/// The boxes of the yarns of a run. The run makes its whole mesh once for the boxes alone.
fn survey(run: &mut Run<'_>, chunks: impl IntoIterator<Item = Chunk>) -> Result<Bounds, WriteError> {
    let mut bounds = Bounds::new(run.plan())?;
    let _ = run.survey(chunks, |chunk, piece| {
        if let MeshPiece::Vertices { first, vertices } = piece {
            bounds.include(chunk, first, vertices);
        }
        ControlFlow::<()>::Continue(())
    })?;
    Ok(bounds)
}
