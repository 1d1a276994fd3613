//! A session that lends a chunk's mesh in device memory.

use std::ops::{Deref, DerefMut};
use std::ptr;

use texere_core::backend::{Chunk, Session, SessionError};

use crate::device_mesh::DeviceMesh;
use crate::engine::OpenClEngine;

/// A [`Session`] that lends a chunk's mesh in device memory.
///
/// All control points stay on the device. A chunk's results stay until a stage is run for the
/// second chunk after it.
///
/// ```no_run
/// use std::sync::Arc;
/// use texere_core::backend::Plan;
/// use texere_core::{ControlPoint, Limits, Settings, Yarn, Yarns};
/// use texere_opencl::{OpenClBackend, Schedule};
/// # let mut yarns = Yarns::builder();
/// # yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
/// # let yarns = yarns.build()?;
/// let plan = Arc::new(Plan::new(yarns.layout().clone(), Settings::default())?);
/// let mut session = OpenClBackend::open(0, Schedule::PerRing)?.lending_session(plan.clone())?;
/// session.upload(0, yarns.points())?;
/// for chunk in plan.chunks(&Limits::NONE)? {
///     session.mesh(&chunk)?;
///     let mesh = session.device_mesh(&chunk)?;
///     println!("{} vertices in {:?} after {:?}", chunk.vertices(), mesh.vertices, mesh.ready);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct OpenClSession(pub(crate) Session<OpenClEngine>);

impl OpenClSession {
    /// The mesh of `chunk` in device memory, for a caller that draws it or processes it further
    /// there.
    ///
    /// **Errors**: [`SessionError::ForeignChunk`], and [`SessionError::NotInFlight`] unless the
    /// session still holds the results of a [`Session::mesh`] of this chunk.
    pub fn device_mesh(&self, chunk: &Chunk) -> Result<DeviceMesh<'_>, SessionError> {
        let slot = self.0.slot_of_mesh(chunk)?;
        let mut mesh = DeviceMesh::new(self.0.engine().memory(slot));
        if chunk.indices() == 0 {
            // The memory may hold indices of an earlier chunk.
            mesh.indices = ptr::null_mut();
        }
        Ok(mesh)
    }

    /// The packed vertices of `chunk` in device memory. The other buffers of the result may be
    /// those of an earlier chunk.
    ///
    /// **Errors**: [`SessionError::ForeignChunk`], and [`SessionError::NotInFlight`] unless the
    /// session still holds the results of a [`Session::packed`] of this chunk.
    pub fn device_packed(&self, chunk: &Chunk) -> Result<DeviceMesh<'_>, SessionError> {
        Ok(DeviceMesh::new(self.0.engine().memory(self.0.slot_of_packed(chunk)?)))
    }

    /// Bytes of device memory that the session holds. In the schedule per-ring they are the buffers
    /// of [`device_buffers`](texere_gpu::device_buffers), and the rings, packed vertices and
    /// attributes if [`Session::trajectory`], [`Session::packed`] and [`Session::attributes`] were
    /// called. The pinned host memory that transfers go through is not counted.
    #[must_use]
    pub fn device_bytes(&self) -> u64 {
        self.0.engine().device_bytes()
    }
}

impl Deref for OpenClSession {
    type Target = Session<OpenClEngine>;

    fn deref(&self) -> &Self::Target {
        &self.0
    }
}

impl DerefMut for OpenClSession {
    fn deref_mut(&mut self) -> &mut Self::Target {
        &mut self.0
    }
}
