//! The device memory of a chunk: its tables and its results.

use std::ops::Range;

use texere_core::backend::{Block, Chunk, Plan};
use texere_core::definitions::Ring;
use texere_core::{Attribute, BackendError, ControlPoint, PackedVertex, Vertex};
use texere_gpu::{CapRow, LoadedChunk, Params};
use texere_shaders::Resource;
use wgpu::{BindingResource, BufferBinding, BufferSize, BufferUsages};

use crate::buffer::Buffer;
use crate::gpu::Gpu;
use crate::parameters::PARAMETERS;
use crate::tables::Tables;

/// The memory of one chunk at a time. A session has two of them, which its chunks use alternately.
/// A live mesh has one for each of its chunks.
#[derive(Debug)]
pub(crate) struct ChunkMemory {
    pub(crate) loaded: LoadedChunk,
    window: Range<u64>,
    /// The number of rows of the block table. A row is the work of a workgroup or, in the schedule
    /// per-yarn, of a lane.
    pub(crate) rows: u32,
    /// The number of vertices of all caps.
    pub(crate) cap_vertices: u32,
    params: Buffer,
    blocks: Buffer,
    cap_rows: Buffer,
    pub(crate) rings: Buffer,
    pub(crate) vertices: Buffer,
    pub(crate) indices: Buffer,
    /// The attributes of the chunk's vertices. Empty until attributes are asked for.
    pub(crate) attributes: Buffer,
    /// The packed vertices of the chunk. Empty until packed vertices are asked for.
    pub(crate) packed: Buffer,
}

impl ChunkMemory {
    pub(crate) fn new(gpu: &Gpu) -> Result<Self, BackendError> {
        let buffer = |what, usage| Buffer::new(gpu, what, usage);
        let (input, output) =
            (BufferUsages::STORAGE | BufferUsages::COPY_DST, BufferUsages::STORAGE | BufferUsages::COPY_SRC);
        Ok(Self {
            loaded: LoadedChunk::default(),
            window: 0..0,
            rows: 0,
            cap_vertices: 0,
            params: buffer("parameters", PARAMETERS | BufferUsages::COPY_DST)?,
            blocks: buffer("the block table", input)?,
            cap_rows: buffer("the cap table", input)?,
            rings: buffer("rings", output)?,
            vertices: buffer("vertices", output | BufferUsages::VERTEX)?,
            indices: buffer("indices", output | BufferUsages::INDEX)?,
            attributes: buffer("attributes", output | BufferUsages::VERTEX)?,
            packed: buffer("packed vertices", output | BufferUsages::VERTEX)?,
        })
    }

    /// The bytes of the chunk's tables and results.
    pub(crate) fn bytes(&self) -> u64 {
        let Self { blocks, cap_rows, rings, vertices, indices, attributes, packed, .. } = self;
        [blocks, cap_rows, rings, vertices, indices, attributes, packed].map(Buffer::bytes).iter().sum()
    }

    /// Sends the parameters and the tables of `chunk`, whose block table is `rows`.
    pub(crate) fn load(
        &mut self,
        gpu: &Gpu,
        plan: &Plan,
        chunk: &Chunk,
        rows: &[Block],
    ) -> Result<(), BackendError> {
        let Self { loaded, params, blocks, cap_rows, .. } = self;
        let sent = loaded.load(plan, chunk, || {
            let sent = Params { blocks: rows.len() as u32, ..Params::new(plan, chunk) };
            params.write(gpu, bytemuck::bytes_of(&sent))?;
            blocks.write(gpu, bytemuck::cast_slice(rows))?;
            cap_rows.write(gpu, bytemuck::cast_slice(&CapRow::all(plan, chunk)))?;
            Ok(sent)
        })?;
        (self.rows, self.cap_vertices) = (sent.blocks, sent.caps * sent.sides);
        self.window = chunk.window();
        Ok(())
    }

    /// Makes room for the rings of the chunk.
    pub(crate) fn reserve_rings(&mut self, gpu: &Gpu, chunk: &Chunk) -> Result<(), BackendError> {
        self.rings.reserve(gpu, u64::from(chunk.rings()) * size_of::<Ring>() as u64)?;
        Ok(())
    }

    /// Makes room for the vertices and indices of the chunk.
    pub(crate) fn reserve_mesh(&mut self, gpu: &Gpu, chunk: &Chunk) -> Result<(), BackendError> {
        self.vertices.reserve(gpu, u64::from(chunk.vertices()) * size_of::<Vertex>() as u64)?;
        self.indices.reserve(gpu, u64::from(chunk.indices()) * size_of::<u32>() as u64)?;
        Ok(())
    }

    /// Makes room for the attributes of the chunk.
    pub(crate) fn reserve_attributes(&mut self, gpu: &Gpu, chunk: &Chunk) -> Result<(), BackendError> {
        self.attributes.reserve(gpu, u64::from(chunk.vertices()) * size_of::<Attribute>() as u64)?;
        Ok(())
    }

    /// Makes room for the packed vertices of the chunk.
    pub(crate) fn reserve_packed(&mut self, gpu: &Gpu, chunk: &Chunk) -> Result<(), BackendError> {
        self.packed.reserve(gpu, u64::from(chunk.vertices()) * size_of::<PackedVertex>() as u64)?;
        Ok(())
    }

    /// The binding of `resource` for this chunk. None for a resource that meshes do not use.
    pub(crate) fn resource<'a>(
        &'a self,
        tables: &'a Tables,
        resource: Resource,
    ) -> Option<BindingResource<'a>> {
        let buffer = match resource {
            Resource::Points => {
                let point = size_of::<ControlPoint>() as u64;
                return Some(BindingResource::Buffer(BufferBinding {
                    buffer: &tables.points,
                    offset: self.window.start * point,
                    size: BufferSize::new((self.window.end - self.window.start) * point),
                }));
            }
            Resource::Yarns => &tables.yarns,
            Resource::Rolls => &tables.rolls,
            Resource::Outlines => &tables.outlines,
            Resource::Pattern => &tables.pattern,
            Resource::CapPattern => &tables.cap_pattern,
            Resource::Params => &self.params,
            Resource::Blocks => &self.blocks,
            Resource::CapRows => &self.cap_rows,
            Resource::Rings => &self.rings,
            Resource::Vertices => &self.vertices,
            Resource::Indices => &self.indices,
            Resource::ArcLengths => &tables.lengths,
            Resource::Attributes => &self.attributes,
            Resource::Packed => &self.packed,
            _ => return None,
        };
        Some(buffer.buffer().as_entire_binding())
    }
}
