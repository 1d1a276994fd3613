//! The boundary to what does the work: object-safe, blocking where it must wait, free of any GPU type.

use std::fmt;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::Duration;

use crate::{BackendError, Chunk, ControlPoint, Limits, MeshMut, MeshPiece, Plan, Ring};

/// What kind of machine a device is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum DeviceKind {
    /// A graphics processor with memory of its own.
    DiscreteGpu,
    /// A graphics processor that shares the host's memory.
    IntegratedGpu,
    /// A processor, also behind a GPU programming interface.
    Cpu,
    /// Anything else, or nothing at all.
    Other,
}

impl fmt::Display for DeviceKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::DiscreteGpu => "discrete GPU",
            Self::IntegratedGpu => "integrated GPU",
            Self::Cpu => "CPU",
            Self::Other => "other",
        })
    }
}

/// Who does the work, and within which limits.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DeviceInfo {
    /// The name that opens it, such as `cpu`.
    pub name: String,
    /// The device as its maker calls it.
    pub device: String,
    /// Driver or implementation, with its version.
    pub driver: String,
    /// How the work is mapped onto the device, fixed when the backend was opened.
    pub schedule: String,
    /// What kind of machine it is.
    pub kind: DeviceKind,
    /// Bytes of memory that the device has, where it tells.
    pub memory_bytes: Option<u64>,
    /// What chunks are cut to.
    pub limits: Limits,
    /// Whether [`Session::timings`] of scan, trajectory and mesh are by a clock of the device's own, from the start of the
    /// work to its end. Otherwise they are by the host's clock.
    pub timed_by_device: bool,
}

/// Time spent in each stage of a session, so far.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct StageTimings {
    /// Control points to the device.
    pub upload: Duration,
    /// Rolls.
    pub scan: Duration,
    /// Rings; part of `mesh` where the two are fused.
    pub trajectory: Duration,
    /// Vertices and indices.
    pub mesh: Duration,
    /// Results to the host.
    pub readback: Duration,
}

/// Bytes that a session has moved between host and device, so far. A backend that works in the host's own memory lends
/// its results where they lie, so it reads none back.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Traffic {
    /// Control points, their virtual ends included, sent by [`Session::upload`]. Tables are not counted: they are sent
    /// once.
    pub uploaded: u64,
    /// Rings, vertices and indices that came back.
    pub read: u64,
}

/// A device that is open and can start sessions.
pub trait Backend: fmt::Debug + Send + Sync {
    /// Backend, device, driver, schedule and limits.
    fn info(&self) -> &DeviceInfo;

    /// Starts work on a plan. The session owns all the device memory that it needs.
    ///
    /// **Errors**: [`BackendError`] where memory, the device or the schedule does not allow it.
    fn session(&self, plan: Arc<Plan>) -> Result<Box<dyn Session>, BackendError>;
}

/// One fabric on one device: upload, scan, then the stages chunk by chunk.
///
/// Chunks come from [`Plan::chunks`] with the device's limits or stricter ones. Two may be in flight; running a stage
/// for a third may use the memory of the oldest again. [`Pipeline`](crate::Pipeline) does all this; by hand it reads
///
/// ```
/// use std::{ops::ControlFlow, sync::Arc};
/// use texere_core::{Backend, ControlPoint, MeshPiece, NullBackend, Plan, Settings, Yarn, Yarns};
/// # let mut yarns = Yarns::builder();
/// # yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
/// # let yarns = yarns.build()?;
/// let device = NullBackend::default(); // any backend
/// let plan = Arc::new(Plan::new(yarns.layout().clone(), Settings::default())?);
/// let mut session = device.session(plan.clone())?;
/// session.upload(0, yarns.points())?;
/// session.scan()?;
/// let mut triangles = 0;
/// for chunk in plan.chunks(&device.info().limits)? {
///     session.mesh(&chunk)?;
///     let _ = session.read_mesh(&chunk, &mut |piece| {
///         if let MeshPiece::Indices { indices, .. } = piece {
///             triangles += indices.len() / 3;
///         }
///         ControlFlow::Continue(())
///     })?;
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Session: fmt::Debug + Send {
    /// Takes control points, the first of which is number `first` of the fabric: any range, so that a generator can feed
    /// block by block and an edit send one yarn.
    ///
    /// **Errors**: [`BackendError::UploadRange`] past the last control point, and what the device says.
    fn upload(&mut self, first: u64, points: &[ControlPoint]) -> Result<(), BackendError>;

    /// Works out the roll at each block's start, and the whole turn of each closed yarn: once after uploads. There is
    /// nothing to do where [`Plan::needs_scan`] is false.
    ///
    /// **Errors**: what the device says.
    fn scan(&mut self) -> Result<(), BackendError>;

    /// Stage 1, rings from control points. May return before it is done.
    ///
    /// **Errors**: [`BackendError::OutOfOrder`] before a scan that is needed; [`BackendError::ForeignChunk`] from a backend
    /// whose kernels check no bounds; and what the device says.
    fn trajectory(&mut self, chunk: &Chunk) -> Result<(), BackendError>;

    /// Stage 2, vertices and indices, with stage 1 in it where that has not run for this chunk. May return before it
    /// is done.
    ///
    /// **Errors**: those of [`Session::trajectory`].
    fn mesh(&mut self, chunk: &Chunk) -> Result<(), BackendError>;

    /// Waits for this chunk's rings and lends them piece by piece, in order. Runs stage 1 where only a fused
    /// [`Session::mesh`] has run. A sink that answers `Break` ends the reading, and the answer comes back.
    ///
    /// **Errors**: [`BackendError::NotInFlight`], and what the device says.
    fn read_trajectory(
        &mut self,
        chunk: &Chunk,
        sink: &mut dyn FnMut(&[Ring]) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, BackendError>;

    /// Waits for this chunk's mesh and lends it piece by piece: all vertices in order, then all indices in order. The
    /// pieces lie in the session's own or in mapped memory. A sink that answers `Break` ends the reading, and the answer
    /// comes back.
    ///
    /// **Errors**: [`BackendError::NotInFlight`], and what the device says.
    fn read_mesh(
        &mut self,
        chunk: &Chunk,
        sink: &mut dyn FnMut(MeshPiece<'_>) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, BackendError>;

    /// Runs stage 2 into the caller's slices, which must be exactly as long as planned.
    ///
    /// Provided: mesh, read, copy. A backend that can write there directly does.
    ///
    /// **Errors**: [`BackendError::OutputLength`] for slices of another length, and what the device says.
    fn mesh_into(&mut self, chunk: &Chunk, out: MeshMut<'_>) -> Result<(), BackendError> {
        check_output(chunk, &out)?;
        self.mesh(chunk)?;
        let mut sink = |piece: MeshPiece<'_>| {
            match piece {
                MeshPiece::Vertices { first, vertices } => {
                    out.vertices[first as usize..][..vertices.len()].copy_from_slice(vertices);
                }
                MeshPiece::Indices { first, indices } => {
                    out.indices[first as usize..][..indices.len()].copy_from_slice(indices);
                }
            }
            ControlFlow::Continue(())
        };
        self.read_mesh(chunk, &mut sink).map(|_| ())
    }

    /// Time spent so far, by all that has been launched: waits for it.
    fn timings(&self) -> StageTimings;

    /// Bytes moved so far.
    fn traffic(&self) -> Traffic;
}

/// Whether `out` is exactly as long as `chunk` needs: for backends that bring their own [`Session::mesh_into`].
///
/// **Errors**: [`BackendError::OutputLength`].
pub fn check_output(chunk: &Chunk, out: &MeshMut<'_>) -> Result<(), BackendError> {
    let lengths = [
        ("vertices", out.vertices.len() as u64, u64::from(chunk.vertices)),
        ("indices", out.indices.len() as u64, u64::from(chunk.indices)),
    ];
    for (what, given, planned) in lengths {
        if given != planned {
            return Err(BackendError::OutputLength { what, given, planned });
        }
    }
    Ok(())
}

const _: () = {
    const fn sends<T: Send + ?Sized>() {}
    sends::<dyn Backend>();
    sends::<dyn Session>();
    sends::<Box<dyn Session>>();
};
