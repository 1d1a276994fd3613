//! Device memory: the plan's tables, once a session, and what a chunk takes, two times.

use std::ops::Range;

use texere_core::{BackendError, Block, Chunk, ControlPoint, Params, Plan, Ring, Vertex, index_pattern};
use texere_shaders::Resource;
use wgpu::{BindingResource, BufferBinding, BufferSize, BufferUsages};

use crate::gpu::Gpu;

/// A buffer that grows with what it has to hold.
#[derive(Debug)]
pub(crate) struct Room {
    what: &'static str,
    usage: BufferUsages,
    buffer: wgpu::Buffer,
    /// Whether anything was ever kept here: a room has a buffer even before, since an empty one can't be bound.
    used: bool,
}

impl Room {
    pub(crate) fn new(gpu: &Gpu, what: &'static str, usage: BufferUsages) -> Result<Self, BackendError> {
        Ok(Self { what, usage, buffer: gpu.buffer(what, 0, usage)?, used: false })
    }

    /// Makes it at least `bytes` long; where that takes a new buffer, what it held is lost.
    pub(crate) fn reserve(&mut self, gpu: &Gpu, bytes: u64) -> Result<&wgpu::Buffer, BackendError> {
        self.used |= bytes > 0;
        if self.buffer.size() < bytes {
            if self.usage.contains(BufferUsages::STORAGE)
                && bytes > gpu.device.limits().max_storage_buffer_binding_size
            {
                return Err(BackendError::OutOfMemory { what: self.what, bytes });
            }
            self.buffer = gpu.buffer(self.what, bytes, self.usage)?;
        }
        Ok(&self.buffer)
    }

    fn write(&mut self, gpu: &Gpu, bytes: &[u8]) -> Result<(), BackendError> {
        gpu.write(self.reserve(gpu, bytes.len() as u64)?, 0, bytes)
    }

    pub(crate) const fn buffer(&self) -> &wgpu::Buffer {
        &self.buffer
    }

    fn bytes(&self) -> u64 {
        if self.used { self.buffer.size() } else { 0 }
    }
}

/// The plan's tables, which all chunks read, and the rolls.
#[derive(Debug)]
pub(crate) struct Tables {
    /// All control points, padded. A chunk binds its window.
    pub(crate) points: wgpu::Buffer,
    yarns: Room,
    rolls: Room,
    outlines: Room,
    pattern: Room,
    cap_pattern: Room,
}

impl Tables {
    /// Sends the plan's tables.
    ///
    /// **Errors**: [`BackendError::OutOfMemory`].
    pub(crate) fn new(gpu: &Gpu, plan: &Plan) -> Result<Self, BackendError> {
        let input = BufferUsages::STORAGE | BufferUsages::COPY_DST;
        let table = |what, bytes: &[u8]| {
            let mut room = Room::new(gpu, what, input)?;
            room.write(gpu, bytes)?;
            Ok::<_, BackendError>(room)
        };
        let cap_pattern = if plan.settings().caps { plan.cap_pattern() } else { Vec::new() };
        let mut rolls = Room::new(gpu, "rolls", BufferUsages::STORAGE)?;
        if plan.needs_scan() {
            rolls.reserve(gpu, 4 * (plan.layout().yarns().len() as u64 + plan.block_count()))?;
        }
        Ok(Self {
            points: gpu.buffer("control points", plan.resident_bytes(), input)?,
            yarns: table("yarns", bytemuck::cast_slice(&plan.yarn_rows()))?,
            rolls,
            outlines: table("outlines", bytemuck::cast_slice(plan.outlines()))?,
            pattern: table("the index pattern", bytemuck::cast_slice(&index_pattern(plan.settings().sides)))?,
            cap_pattern: table("the cap pattern", bytemuck::cast_slice(&cap_pattern))?,
        })
    }
}

impl Tables {
    /// Bytes of all of them.
    pub(crate) fn bytes(&self) -> u64 {
        let Self { points, yarns, rolls, outlines, pattern, cap_pattern } = self;
        points.size() + [yarns, rolls, outlines, pattern, cap_pattern].map(Room::bytes).iter().sum::<u64>()
    }
}

/// A chunk's place among all of its plan: enough to tell it from any other that the plan can cut.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Place {
    blocks: Range<u64>,
    window: Range<u64>,
    counts: [u32; 3],
}

impl Place {
    fn of(chunk: &Chunk) -> Self {
        Self {
            blocks: chunk.block_range.clone(),
            window: chunk.window.clone(),
            counts: [chunk.rings, chunk.vertices, chunk.indices],
        }
    }
}

/// A chunk in flight. Its memory serves the next chunk but one again.
#[derive(Debug)]
pub(crate) struct Slot {
    place: Option<Place>,
    pub(crate) has_rings: bool,
    pub(crate) has_mesh: bool,
    window: Range<u64>,
    /// Rows of the block table, one a workgroup or, per yarn, a lane.
    pub(crate) rows: u32,
    /// Vertices of all caps.
    pub(crate) cap_vertices: u32,
    params: Room,
    blocks: Room,
    cap_rows: Room,
    pub(crate) rings: Room,
    slopes: Room,
    pub(crate) vertices: Room,
    pub(crate) indices: Room,
}

impl Slot {
    pub(crate) fn new(gpu: &Gpu) -> Result<Self, BackendError> {
        let room = |what, usage| Room::new(gpu, what, usage);
        let (input, output) =
            (BufferUsages::STORAGE | BufferUsages::COPY_DST, BufferUsages::STORAGE | BufferUsages::COPY_SRC);
        Ok(Self {
            place: None,
            has_rings: false,
            has_mesh: false,
            window: 0..0,
            rows: 0,
            cap_vertices: 0,
            params: room("parameters", BufferUsages::UNIFORM | BufferUsages::COPY_DST)?,
            blocks: room("the block table", input)?,
            cap_rows: room("the cap table", input)?,
            rings: room("rings", output)?,
            slopes: room("slopes", BufferUsages::STORAGE)?,
            vertices: room("vertices", output | BufferUsages::VERTEX)?,
            indices: room("indices", output | BufferUsages::INDEX)?,
        })
    }

    /// Bytes of its tables and results.
    pub(crate) fn bytes(&self) -> u64 {
        let Self { blocks, cap_rows, rings, slopes, vertices, indices, .. } = self;
        [blocks, cap_rows, rings, slopes, vertices, indices].map(Room::bytes).iter().sum()
    }

    /// Whether it has `chunk`'s tables.
    pub(crate) fn holds(&self, chunk: &Chunk) -> bool {
        self.place.as_ref() == Some(&Place::of(chunk))
    }

    /// Forgets results, which belong to control points that have changed; the tables stay.
    pub(crate) fn forget_results(&mut self) {
        (self.has_rings, self.has_mesh) = (false, false);
    }

    /// Sends the tables of another chunk.
    pub(crate) fn take_tables(
        &mut self,
        gpu: &Gpu,
        plan: &Plan,
        chunk: &Chunk,
        rows: &[Block],
    ) -> Result<(), BackendError> {
        self.place = None;
        self.forget_results();
        let params = Params { blocks: rows.len() as u32, ..plan.params(chunk) };
        (self.rows, self.cap_vertices) = (params.blocks, params.caps * params.sides);
        self.params.write(gpu, bytemuck::bytes_of(&params))?;
        self.blocks.write(gpu, bytemuck::cast_slice(rows))?;
        self.cap_rows.write(gpu, bytemuck::cast_slice(&plan.cap_rows(chunk)))?;
        self.window = chunk.window.clone();
        self.place = Some(Place::of(chunk));
        Ok(())
    }

    /// Makes room for the rings of the chunk, and for their slopes where `slopes`.
    pub(crate) fn reserve_rings(
        &mut self,
        gpu: &Gpu,
        chunk: &Chunk,
        slopes: bool,
    ) -> Result<(), BackendError> {
        self.rings.reserve(gpu, u64::from(chunk.rings) * size_of::<Ring>() as u64)?;
        if slopes {
            self.slopes.reserve(gpu, u64::from(chunk.rings) * size_of::<f32>() as u64)?;
        }
        Ok(())
    }

    /// Makes room for the vertices and indices of the chunk.
    pub(crate) fn reserve_mesh(&mut self, gpu: &Gpu, chunk: &Chunk) -> Result<(), BackendError> {
        self.vertices.reserve(gpu, u64::from(chunk.vertices) * size_of::<Vertex>() as u64)?;
        self.indices.reserve(gpu, u64::from(chunk.indices) * size_of::<u32>() as u64)?;
        Ok(())
    }

    /// What a shader that works on this chunk sees as `resource`.
    pub(crate) fn resource<'a>(&'a self, tables: &'a Tables, resource: Resource) -> BindingResource<'a> {
        let room = match resource {
            Resource::Points => {
                let point = size_of::<ControlPoint>() as u64;
                return BindingResource::Buffer(BufferBinding {
                    buffer: &tables.points,
                    offset: self.window.start * point,
                    size: BufferSize::new((self.window.end - self.window.start) * point),
                });
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
            Resource::Slopes => &self.slopes,
            Resource::Vertices => &self.vertices,
            Resource::Indices => &self.indices,
        };
        room.buffer().as_entire_binding()
    }
}
