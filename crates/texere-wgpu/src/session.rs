//! A session that lends its device buffers.

use std::ops::{Deref, DerefMut};

use texere_core::backend::{Chunk, Session, SessionError, Slot};
use texere_shaders::Resource;

use crate::engine::WgpuEngine;

/// A [`Session`] that lends its device buffers.
///
/// ```no_run
/// # use std::sync::Arc;
/// # use texere_core::backend::Plan;
/// # use texere_core::Yarns;
/// # fn draw(_: &wgpu::Buffer, _: &wgpu::Buffer) {}
/// # fn example(backend: &texere_wgpu::WgpuBackend, plan: Arc<Plan>, yarns: &Yarns) -> Result<(), Box<dyn std::error::Error>> {
/// use texere_core::Backend;
/// let mut session = backend.lending_session(plan.clone())?;
/// session.upload(0, yarns.points())?;
/// session.scan()?;
/// for chunk in plan.chunks(&backend.info().limits)? {
///     session.mesh(&chunk)?;
///     // On the device's queue, whatever comes after the mesh sees it: there is nothing to wait for.
///     draw(session.vertex_buffer(&chunk)?, session.index_buffer(&chunk)?);
/// }
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct WgpuSession(pub(crate) Session<WgpuEngine>);

impl WgpuSession {
    /// The vertices of `chunk`, after [`Session::mesh`]: position and normal, 24 bytes each, from
    /// the start of the buffer. There are [`Chunk::vertices`] of them. The buffer may be longer,
    /// and is used again for the second chunk after this one.
    ///
    /// Its usages are `VERTEX`, `STORAGE` and `COPY_SRC`.
    ///
    /// **Errors**: [`SessionError::ForeignChunk`], [`SessionError::NotInFlight`].
    pub fn vertex_buffer(&self, chunk: &Chunk) -> Result<&wgpu::Buffer, SessionError> {
        let slot = self.0.slot_of_mesh(chunk)?;
        Ok(self.0.engine().memory(slot).vertices.buffer())
    }

    /// The indices of `chunk`, after [`Session::mesh`]: four bytes each, from the start of the
    /// buffer. There are [`Chunk::indices`] of them. The buffer may be longer, and is used again
    /// for the second chunk after this one. A topology other than
    /// [`Indexed`](texere_core::Topology::Indexed) has no indices.
    ///
    /// Its usages are `INDEX`, `STORAGE` and `COPY_SRC`.
    ///
    /// **Errors**: the errors of [`WgpuSession::vertex_buffer`].
    pub fn index_buffer(&self, chunk: &Chunk) -> Result<&wgpu::Buffer, SessionError> {
        let slot = self.0.slot_of_mesh(chunk)?;
        Ok(self.0.engine().memory(slot).indices.buffer())
    }

    /// The attributes of `chunk`, after [`Session::attributes`]: an
    /// [`Attribute`](texere_core::Attribute) of 24 bytes for each vertex.
    ///
    /// Its usages are `VERTEX`, `STORAGE` and `COPY_SRC`.
    ///
    /// **Errors**: [`SessionError::ForeignChunk`], [`SessionError::NotInFlight`] before
    /// [`Session::attributes`].
    pub fn attribute_buffer(&self, chunk: &Chunk) -> Result<&wgpu::Buffer, SessionError> {
        let slot = self.0.slot_of_attributes(chunk)?;
        Ok(self.0.engine().memory(slot).attributes.buffer())
    }

    /// The packed vertices of `chunk`, after [`Session::packed`]: a
    /// [`PackedVertex`](texere_core::PackedVertex) of 12 bytes for each vertex, in the layout
    /// [`PACKED_LAYOUT`](crate::PACKED_LAYOUT).
    ///
    /// Its usages are `VERTEX`, `STORAGE` and `COPY_SRC`.
    ///
    /// **Errors**: [`SessionError::ForeignChunk`], [`SessionError::NotInFlight`] before
    /// [`Session::packed`].
    pub fn packed_buffer(&self, chunk: &Chunk) -> Result<&wgpu::Buffer, SessionError> {
        let slot = self.0.slot_of_packed(chunk)?;
        Ok(self.0.engine().memory(slot).packed.buffer())
    }

    /// The control points and tables of `chunk`, for a caller's own shaders. No stage is run, and
    /// no memory is allocated for results.
    ///
    /// **Errors**: the errors of [`Session::trajectory`].
    pub fn chunk_tables(&mut self, chunk: &Chunk) -> Result<ChunkTables<'_>, SessionError> {
        let slot = self.0.slot_of_tables(chunk)?;
        Ok(ChunkTables { engine: self.0.engine(), slot })
    }

    /// Bytes of device memory that the session holds. In the schedule per-ring they are the buffers
    /// of [`device_buffers`](texere_gpu::device_buffers), each rounded up to a multiple of 16
    /// bytes, and the results of [`Session::trajectory`], [`Session::packed`] and
    /// [`Session::attributes`], if these were called. Attributes bring the lengths along yarns. The
    /// memory that wgpu maps for transfers is not counted.
    #[must_use]
    pub fn device_bytes(&self) -> u64 {
        self.0.engine().device_bytes()
    }
}

/// The control points and tables of a chunk on the device.
#[derive(Debug, Clone, Copy)]
pub struct ChunkTables<'a> {
    engine: &'a WgpuEngine,
    slot: Slot,
}

impl<'a> ChunkTables<'a> {
    /// The binding of `resource`. None for a resource that meshes do not use.
    #[must_use]
    pub fn resource(&self, resource: Resource) -> Option<wgpu::BindingResource<'a>> {
        self.engine.resource(self.slot, resource)
    }

    /// Whether any yarn may be flattened: the value for the shaders' constant `FLATTENED`.
    #[must_use]
    pub fn are_flattened(&self) -> bool {
        self.engine.is_flattened()
    }
}

impl Deref for WgpuSession {
    type Target = Session<WgpuEngine>;

    fn deref(&self) -> &Self::Target {
        &self.0
    }
}

impl DerefMut for WgpuSession {
    fn deref_mut(&mut self) -> &mut Self::Target {
        &mut self.0
    }
}
