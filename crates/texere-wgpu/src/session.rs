//! A session that lends its buffers on the device.

use std::ops::{Deref, DerefMut};

use texere_core::backend::{Chunk, Session, SessionError, Slot};
use texere_shaders::Resource;

use crate::engine::WgpuEngine;

/// A [`Session`] that lends its buffers.
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
    /// The vertices of `chunk`, which [`Session::mesh`] has been called for: [`Chunk::vertices`] of
    /// 24 bytes, position and normal, at the start of the buffer. It may be longer, and is used
    /// again for the next chunk but one.
    ///
    /// Its usages are `VERTEX`, `STORAGE` and `COPY_SRC`.
    ///
    /// **Errors**: [`SessionError::ForeignChunk`], [`SessionError::NotInFlight`].
    pub fn vertex_buffer(&self, chunk: &Chunk) -> Result<&wgpu::Buffer, SessionError> {
        let slot = self.0.slot_of_mesh(chunk)?;
        Ok(self.0.engine().memory(slot).vertices.buffer())
    }

    /// The indices of `chunk`, likewise: [`Chunk::indices`] of four bytes. With another topology
    /// than [`Indexed`](texere_core::Topology::Indexed) there are none in it.
    ///
    /// Its usages are `INDEX`, `STORAGE` and `COPY_SRC`.
    ///
    /// **Errors**: those of [`WgpuSession::vertex_buffer`].
    pub fn index_buffer(&self, chunk: &Chunk) -> Result<&wgpu::Buffer, SessionError> {
        let slot = self.0.slot_of_mesh(chunk)?;
        Ok(self.0.engine().memory(slot).indices.buffer())
    }

    /// The attributes of `chunk`, which [`Session::attributes`] has been called for, likewise: an
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

    /// The packed vertices of `chunk`, which [`Session::packed`] has been called for, likewise: a
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

    /// The control points and tables that shaders make `chunk` from, for shaders of the caller's.
    /// No stage is run, and no memory is taken for its results.
    ///
    /// **Errors**: those of [`Session::trajectory`].
    pub fn chunk_tables(&mut self, chunk: &Chunk) -> Result<ChunkTables<'_>, SessionError> {
        let slot = self.0.slot_of_tables(chunk)?;
        Ok(ChunkTables { engine: self.0.engine(), slot })
    }

    /// Bytes of device memory that it holds: in the schedule per-ring the buffers of
    /// [`device_buffers`](texere_gpu::device_buffers), each a multiple of 16 bytes, and the rings
    /// where [`Session::trajectory`] was called. Not what wgpu maps to send and read through.
    #[must_use]
    pub fn device_bytes(&self) -> u64 {
        self.0.engine().device_bytes()
    }
}

/// What shaders make a chunk from, on the device.
#[derive(Debug, Clone, Copy)]
pub struct ChunkTables<'a> {
    engine: &'a WgpuEngine,
    slot: Slot,
}

impl<'a> ChunkTables<'a> {
    /// The binding of `resource`; none for what is not of a mesh.
    #[must_use]
    pub fn resource(&self, resource: Resource) -> Option<wgpu::BindingResource<'a>> {
        self.engine.resource(self.slot, resource)
    }

    /// Whether yarns may be wider than high somewhere, which is what the constant FLATTENED of
    /// shaders says.
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
