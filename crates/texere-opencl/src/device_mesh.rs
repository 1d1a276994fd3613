//! A mesh in device memory.

use std::ffi::c_void;
use std::marker::PhantomData;
use std::ptr;

use crate::chunk_memory::ChunkMemory;
use crate::handles::Handle;

/// A chunk's mesh in device memory. The handles are valid until the next call that changes the
/// session or the engine that lent this value.
#[derive(Debug)]
pub struct DeviceMesh<'a> {
    /// A `cl_mem` with the chunk's [`Vertex`](texere_core::Vertex)es from its start.
    pub vertices: *mut c_void,
    /// A `cl_mem` with the chunk's `u32` indices from its start, or null if the chunk has none.
    pub indices: *mut c_void,
    /// A `cl_mem` with the chunk's [`Attribute`](texere_core::Attribute)s from its start, if they
    /// were made. If none were made for this chunk, it holds those of an earlier chunk, or is null
    /// if this memory never had any.
    pub attributes: *mut c_void,
    /// A `cl_mem` with the chunk's [`PackedVertex`](texere_core::PackedVertex)es from its start, if
    /// they were made. If none were made for this chunk, it holds those of an earlier chunk, or is
    /// null if this memory never had any.
    pub packed: *mut c_void,
    /// The `cl_event` of the last command that writes these buffers. Wait for it, on the host or in
    /// a queue.
    pub ready: *mut c_void,
    memory: PhantomData<&'a ChunkMemory>,
}

impl<'a> DeviceMesh<'a> {
    pub(crate) fn new(memory: &'a ChunkMemory) -> Self {
        Self {
            vertices: memory.vertices.raw(),
            indices: memory.indices.raw(),
            attributes: memory.attributes.raw(),
            packed: memory.packed.raw(),
            ready: memory.ready.as_deref().map_or(ptr::null_mut(), Handle::raw),
            memory: PhantomData,
        }
    }
}
