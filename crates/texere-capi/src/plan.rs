//! Plans: the sizes of a mesh before it is made.

use std::sync::{Arc, LazyLock};
use std::thread::available_parallelism;

use texere::backend::{Chunk, Plan, Run};
use texere::mesh::Limits;
use texere::{Settings, Yarns};

use crate::argument::check;
use crate::device::{Device, texere_device};
use crate::error::guard;
use crate::failure::Failure;
use crate::handle::{Handle, clear, free, get, give};
use crate::run::reporter;
use crate::settings::{chosen, texere_settings};
use crate::sized::{check_sized, grows_after, write_sized};
use crate::status::texere_status;
use crate::yarns::texere_yarns;

/// The plan of a mesh: yarns, settings and a device. It has all sizes of the mesh before the mesh
/// is made.
///
/// A mesh is made in chunks, which are so small that a call ends within 50 ms after its run is
/// cancelled. How many there are depends on the device, and on the number of the machine's cores.
/// If a chunk ends inside a yarn, its last ring is also the first ring of the next chunk.
#[derive(Debug)]
pub struct texere_plan;

#[derive(Debug)]
pub(crate) struct Planned {
    pub(crate) yarns: Arc<Yarns>,
    pub(crate) device: Arc<Device>,
    pub(crate) plan: Arc<Plan>,
    pub(crate) chunks: Vec<Chunk>,
    draws: Vec<texere_draw>,
    /// For each chunk the number of its first draw, and at the end how many draws there are in all.
    draw_offsets: Vec<usize>,
    pub(crate) counts: texere_counts,
}

impl Handle for texere_plan {
    type Value = Planned;
    const NAME: &str = "plan";
}

/// Bytes of a chunk's largest buffer, for each core: with six sides some 700,000 vertices. A core
/// makes them in 2 to 7 ms, and two chunks may be on their way when a run is cancelled.
const CORE_BYTES: u64 = 16 << 20;

/// The least and the largest limit on the bytes of a chunk's largest buffer. At the end of each
/// chunk the cores wait for the last of them, the longer the more cores there are. Times were
/// compared with those of chunks of 64 MiB, the usual ones in Rust. On two cores a mesh took 3 to
/// 4 % longer in chunks of 8 MiB, 2 % longer in chunks of 16 MiB, and as long in chunks of 32 MiB.
/// On sixteen cores a mesh took 10 % longer in chunks of 16 MiB. No test breaks with other values:
/// `c-overhead` and `c-cancel` of texere-bench show the effect.
const CHUNK_BYTES: [u64; 2] = [32 << 20, 64 << 20];

/// The limits that chunks of plans are cut to.
pub(crate) static LIMITS: LazyLock<Limits> = LazyLock::new(|| {
    let cores = available_parallelism().map_or(1, |cores| cores.get() as u64);
    Limits { binding_bytes: (cores * CORE_BYTES).clamp(CHUNK_BYTES[0], CHUNK_BYTES[1]), ..Limits::NONE }
});

/// Sizes of a mesh.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_counts {
    /// Size of this struct, bytes. The caller sets it.
    pub struct_size: u32,
    /// Zero.
    pub reserved: u32,
    /// How many rings all yarns have together.
    pub rings: u64,
    /// How many vertices. The vertices of a ring at which two chunks meet count twice.
    pub vertices: u64,
    /// How many indices.
    pub indices: u64,
    /// How many triangles the draws draw.
    pub triangles: u64,
    /// How many draws.
    pub draws: u64,
    /// How many chunks the mesh is made in.
    pub chunks: u64,
}

grows_after!(texere_counts, chunks);

/// A range of indices that draws a yarn, or a part of one. Triangles are counter-clockwise as seen
/// from outside.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_draw {
    /// The number of its first index in the mesh.
    pub first_index: u64,
    /// How many indices it has, three for each triangle.
    pub index_count: u64,
    /// What to add to an index to get the number of a vertex.
    pub base_vertex: u64,
    /// How many vertices the indices of the draw may refer to, from `base_vertex` on.
    pub vertex_count: u64,
    /// The yarn, counted from 0.
    pub yarn: u32,
    /// Zero.
    pub reserved: u32,
}

/// The sizes and the draws of a mesh that is made in `chunks` of a plan. The third value has for
/// each chunk the number of its first draw, and at the end how many draws there are in all.
pub(crate) fn shape(plan: &Plan, chunks: &[Chunk]) -> (texere_counts, Vec<texere_draw>, Vec<usize>) {
    let (mut draws, mut draw_offsets) = (Vec::new(), vec![0]);
    for chunk in chunks {
        draws.extend(plan.draws(chunk).map(|draw| texere_draw {
            first_index: draw.indices.start,
            index_count: draw.indices.end - draw.indices.start,
            base_vertex: draw.base_vertex,
            vertex_count: draw.vertices,
            yarn: draw.yarn,
            reserved: 0,
        }));
        draw_offsets.push(draws.len());
    }
    let [vertices, indices] = plan.mesh_lengths(chunks);
    let counts = texere_counts {
        struct_size: size_of::<texere_counts>() as u32,
        reserved: 0,
        rings: plan.counts().rings,
        vertices,
        indices,
        triangles: plan.counts().triangles,
        draws: draws.len() as u64,
        chunks: chunks.len() as u64,
    };
    (counts, draws, draw_offsets)
}

impl Planned {
    fn new(yarns: Arc<Yarns>, device: Arc<Device>, settings: Settings) -> Result<Self, Failure> {
        let plan = Arc::new(Plan::new(yarns.layout().clone(), settings)?);
        let chunks: Vec<Chunk> = plan.chunks(&LIMITS.min(&device.backend.info().limits))?.collect();
        let (counts, draws, draw_offsets) = shape(&plan, &chunks);
        Ok(Self { yarns, device, plan, chunks, draws, draw_offsets, counts })
    }

    /// Starts to run the plan on its device. `run` gets the progress.
    pub(crate) fn start(&self, run: Option<Arc<crate::run::Run>>) -> Result<Run<'_>, Failure> {
        self.run_of(self.plan.clone(), *LIMITS, run)
    }

    /// Starts to run `plan`, a plan of these yarns, on the device, in chunks that fit `limits`.
    pub(crate) fn run_of(
        &self,
        plan: Arc<Plan>,
        limits: Limits,
        run: Option<Arc<crate::run::Run>>,
    ) -> Result<Run<'_>, Failure> {
        let (device, mut report) = (&*self.device.backend, reporter(run));
        Ok(Run::start(device, plan, self.yarns.points(), limits, move |done| {
            report(done.rings as f64 / done.total.max(1) as f64)
        })?)
    }

    /// Chunk `number`, counted from 0.
    pub(crate) fn chunk(&self, number: u64) -> Result<&Chunk, Failure> {
        let chunk = usize::try_from(number).ok().and_then(|number| self.chunks.get(number));
        chunk.ok_or_else(|| {
            Failure::argument(format!("chunk is {number}, and there are {}, from 0", self.chunks.len()))
        })
    }

    /// The draws of a chunk.
    pub(crate) fn draws_of(&self, chunk: &Chunk) -> &[texere_draw] {
        let number = chunk.index() as usize;
        &self.draws[self.draw_offsets[number]..self.draw_offsets[number + 1]]
    }
}

/// Plans the mesh of yarns on a device. `settings` may be null, and then those of
/// `texere_settings_default` apply.
///
/// Fails with TEXERE_ARGUMENT for settings out of range.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_plan_new(
    yarns: *const texere_yarns,
    device: *const texere_device,
    settings: *const texere_settings,
    out: *mut *mut texere_plan,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `out`.
        unsafe { clear(out) }?;
        let (yarns, device) = (get(yarns)?, get(device)?);
        // SAFETY: the caller vouches for `settings`.
        let settings = unsafe { chosen(settings, &yarns) }?;
        // SAFETY: as above.
        unsafe { give(out, Planned::new(yarns, device, settings)?) }
    })
}

/// Writes the sizes of a plan's mesh. The caller sets `counts->struct_size` before the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_plan_counts(
    plan: *const texere_plan,
    counts: *mut texere_counts,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `counts`.
        unsafe { check_sized("counts", counts) }?;
        let found = get(plan)?.counts;
        // SAFETY: `check_sized` has accepted the size; the caller vouches for the memory.
        unsafe { write_sized(counts, found) };
        Ok(())
    })
}

/// Lends the draws of a plan's mesh. `texere_plan_counts` says how many there are. They are valid
/// until the plan is freed.
///
/// Fails with TEXERE_ARGUMENT for a null `draws`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_plan_draws(
    plan: *const texere_plan,
    draws: *mut *const texere_draw,
) -> texere_status {
    guard(|| {
        check("draws", draws)?;
        let plan = get(plan)?;
        // SAFETY: the pointer is neither null nor misaligned; the caller vouches for the memory.
        unsafe { draws.write(plan.draws.as_ptr()) };
        Ok(())
    })
}

/// Lends for each yarn the number of its first ring, and at the end how many rings there are in
/// all. That is one number more than the plan has yarns. The numbers are valid until the plan is
/// freed. `*count` becomes how many numbers there are.
///
/// Fails with TEXERE_ARGUMENT for a null `offsets` or `count`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_plan_ring_offsets(
    plan: *const texere_plan,
    offsets: *mut *const u64,
    count: *mut u64,
) -> texere_status {
    guard(|| {
        check("offsets", offsets)?;
        check("count", count)?;
        let plan = get(plan)?;
        let own = plan.plan.ring_offsets();
        // SAFETY: the pointer is neither null nor misaligned; the caller vouches for the memory.
        unsafe {
            offsets.write(own.as_ptr());
            count.write(own.len() as u64);
        }
        Ok(())
    })
}

/// A chunk of a plan, and where it lies in the mesh.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_chunk {
    /// Size of this struct, bytes. The caller sets it.
    pub struct_size: u32,
    /// Zero.
    pub reserved: u32,
    /// The number of its first vertex in the mesh.
    pub first_vertex: u64,
    /// How many vertices it has.
    pub vertex_count: u64,
    /// The number of its first index in the mesh.
    pub first_index: u64,
    /// How many indices it has. The indices count from its first vertex.
    pub index_count: u64,
    /// Its draws. Their indices and vertices are numbered in the whole mesh. They are valid until
    /// the plan is freed.
    pub draws: *const texere_draw,
    /// How many draws it has.
    pub draw_count: u64,
}

grows_after!(texere_chunk, draw_count);

/// Writes where a chunk of a plan lies in the mesh. Chunks count from 0; `texere_plan_counts` says
/// how many there are. The caller sets `chunk->struct_size` before the call.
///
/// Fails with TEXERE_ARGUMENT if there is no chunk of that number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_plan_chunk(
    plan: *const texere_plan,
    number: u64,
    chunk: *mut texere_chunk,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `chunk`.
        unsafe { check_sized("chunk", chunk) }?;
        let plan = get(plan)?;
        let own = plan.chunk(number)?;
        let draws = plan.draws_of(own);
        let found = texere_chunk {
            struct_size: size_of::<texere_chunk>() as u32,
            reserved: 0,
            first_vertex: own.first_vertex(),
            vertex_count: own.vertices().into(),
            first_index: own.first_index(),
            index_count: own.indices().into(),
            draws: draws.as_ptr(),
            draw_count: draws.len() as u64,
        };
        // SAFETY: `check_sized` has accepted the size; the caller vouches for the memory.
        unsafe { write_sized(chunk, found) };
        Ok(())
    })
}

/// Frees a plan. A null handle is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_plan_free(plan: *mut texere_plan) {
    free(plan);
}
