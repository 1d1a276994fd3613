//! The triangles of a chunk that a picture may show: the table of a chunk's runs, and the list that is drawn.

use bytemuck::{Pod, Zeroable};
use texere_core::{BackendError, Chunk, Plan};
use texere_shaders::grid;
use wgpu::{BindingResource, BufferBinding, BufferUsages};

use crate::Renderer;

/// `Run` of `chunk.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct Run {
    yarn: u32,
    first_ring: u32,
    gaps: u32,
    first_vertex: u32,
    ring_length: f32,
}

const _: () = assert!(size_of::<Run>() == 20);

/// `CAP` of `chunk.wgsl`.
const CAP: u32 = 1 << 31;

/// A triangle of the list: three vertices and the run.
type Triangle = [u32; 4];

/// The arguments of an indirect draw: corners, instances, and the first of each.
const DRAW_BYTES: u64 = 16;

/// The buffers of one chunk at a time, as large as the largest so far.
#[derive(Debug)]
pub(crate) struct Sieve {
    runs: wgpu::Buffer,
    /// Bytes of `runs` that are this chunk's.
    run_bytes: u64,
    triangles: wgpu::Buffer,
    pub(crate) draw: wgpu::Buffer,
}

impl Sieve {
    pub(crate) fn new(renderer: &Renderer) -> Result<Self, BackendError> {
        Ok(Self {
            runs: renderer.buffer("runs", 0, BufferUsages::STORAGE)?,
            run_bytes: 0,
            triangles: renderer.buffer("triangles", 0, BufferUsages::STORAGE)?,
            draw: renderer.buffer("draw", DRAW_BYTES, BufferUsages::STORAGE | BufferUsages::INDIRECT)?,
        })
    }

    /// Bytes that the list of a chunk of so many bytes of vertices may take, each a corner of two triangles.
    pub(crate) const fn list_bytes(vertex_bytes: u64) -> u64 {
        vertex_bytes / size_of::<texere_core::Vertex>() as u64 * 2 * size_of::<Triangle>() as u64
    }

    /// Writes the tables of `chunk`: its runs, and the list of triangles, which starts with those of caps. The sieve appends
    /// the rest.
    pub(crate) fn fill(
        &mut self,
        renderer: &Renderer,
        plan: &Plan,
        chunk: &Chunk,
        ring_lengths: &[f32],
    ) -> Result<(), BackendError> {
        let mut runs: Vec<Run> = chunk
            .blocks()
            .iter()
            .filter(|block| block.quads > 0)
            .map(|block| Run {
                yarn: block.yarn,
                first_ring: block.first_ring,
                gaps: block.quads,
                first_vertex: block.first_vertex,
                ring_length: ring_lengths[block.yarn as usize],
            })
            .collect();
        let gaps: u64 = runs.iter().map(|run| u64::from(run.gaps)).sum();
        let mut caps: Vec<Triangle> = Vec::new();
        for cap in chunk.caps() {
            let (run, vertex) = (runs.len() as u32 | CAP, cap.first_vertex);
            runs.push(Run { yarn: cap.yarn, first_ring: 0, gaps: 0, first_vertex: vertex, ring_length: 0.0 });
            let section = plan.layout().yarns()[cap.yarn as usize].section as usize;
            let indices: Vec<u32> = plan.cap_indices(section, cap.end).map(|index| vertex + index).collect();
            caps.extend(indices.chunks_exact(3).map(|corners| [corners[0], corners[1], corners[2], run]));
        }
        let most = gaps * u64::from(plan.settings().sides) * 2 + caps.len() as u64;
        self.run_bytes = size_of_val(&*runs) as u64;
        renderer.refill(&mut self.runs, self.run_bytes, bytemuck::cast_slice(&runs))?;
        let list = most * size_of::<Triangle>() as u64;
        renderer.refill(&mut self.triangles, list, bytemuck::cast_slice(&caps))?;
        let draw = [3 * caps.len() as u32, 1, 0, 0];
        renderer.write(&self.draw, bytemuck::cast_slice(&draw))
    }

    /// The bindings of both the sieve and the draw, after the view and the chunk's vertices.
    pub(crate) fn bindings(&self) -> [BindingResource<'_>; 2] {
        let runs =
            BufferBinding { buffer: &self.runs, offset: 0, size: wgpu::BufferSize::new(self.run_bytes) };
        [BindingResource::Buffer(runs), self.triangles.as_entire_binding()]
    }

    /// Workgroups, one a run: columns, rows.
    pub(crate) fn groups(&self) -> (u32, u32) {
        grid((self.run_bytes / size_of::<Run>() as u64) as u32)
    }
}

impl Renderer {
    /// Writes `bytes` to the start of `buffer`, which is made anew where it is shorter than `room`.
    fn refill(&self, buffer: &mut wgpu::Buffer, room: u64, bytes: &[u8]) -> Result<(), BackendError> {
        if buffer.size() < room {
            *buffer = self.buffer("sieve", room, buffer.usage())?;
        }
        self.write(buffer, bytes)
    }
}
