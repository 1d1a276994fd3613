//! Plans: how large a mesh is before it is made, and the mesh in the caller's memory.

use std::ffi::c_char;
use std::sync::Arc;

use texere::backend::{Chunk, MeshMut, Plan, Session};
use texere::mesh::{Limits, Topology};
use texere::{Pipeline, Settings, Vertex, Yarns};

use crate::argument::{check, check_sized, slice_mut, text};
use crate::device::{Device, texere_device};
use crate::error::guard;
use crate::failure::Failure;
use crate::handle::{Handle, clear, free, get, get_any, give};
use crate::run::{reporter, texere_run};
use crate::settings::{chosen, texere_settings};
use crate::status::texere_status;
use crate::yarns::{exactly, texere_yarns};

/// The plan of a mesh: yarns, settings and a device. It knows every size before anything runs.
#[derive(Debug)]
pub struct texere_plan;

#[derive(Debug)]
pub(crate) struct Planned {
    yarns: Arc<Yarns>,
    device: Arc<Device>,
    settings: Settings,
    plan: Arc<Plan>,
    chunks: Vec<Chunk>,
    draws: Vec<texere_draw>,
    counts: texere_counts,
}

impl Handle for texere_plan {
    type Value = Planned;
    const NAME: &str = "plan";
}

/// Sizes of a mesh.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_counts {
    /// Bytes of this struct, which the caller sets.
    pub struct_size: u32,
    /// Zero.
    pub reserved: u32,
    /// Rings of all yarns.
    pub rings: u64,
    /// Vertices. Where the mesh is made in parts, a ring at which two of them meet counts twice.
    pub vertices: u64,
    /// Indices.
    pub indices: u64,
    /// Triangles that the draws draw.
    pub triangles: u64,
    /// Draws.
    pub draws: u64,
}

/// A vertex of a tube.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_vertex {
    /// Position, mm.
    pub position: [f32; 3],
    /// Unit normal, out of the yarn.
    pub normal: [f32; 3],
}

const _: () = assert!(size_of::<texere_vertex>() == size_of::<Vertex>());

/// A range of indices that draws a yarn, or a part of one. Triangles are counter-clockwise seen
/// from outside.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_draw {
    /// The first of its indices.
    pub first_index: u64,
    /// How many indices it has, three a triangle.
    pub index_count: u64,
    /// What to add to an index to get the number of a vertex.
    pub base_vertex: u64,
    /// How many vertices from `base_vertex` on its indices may refer to.
    pub vertex_count: u64,
    /// The yarn, from 0.
    pub yarn: u32,
    /// Zero.
    pub reserved: u32,
}

impl Planned {
    fn new(yarns: Arc<Yarns>, device: Arc<Device>, settings: Settings) -> Result<Self, Failure> {
        let plan = Arc::new(Plan::new(yarns.layout().clone(), settings)?);
        let limits = Limits::default().min(&device.backend.info().limits);
        let chunks: Vec<Chunk> = plan.chunks(&limits)?.collect();
        let draws: Vec<_> = chunks
            .iter()
            .flat_map(|chunk| plan.draws(chunk))
            .map(|draw| texere_draw {
                first_index: draw.indices.start,
                index_count: draw.indices.end - draw.indices.start,
                base_vertex: draw.base_vertex,
                vertex_count: draw.vertices,
                yarn: draw.yarn,
                reserved: 0,
            })
            .collect();
        let indices = match settings.topology {
            Topology::Shared => plan.shared_indices().len() as u64,
            _ => chunks.iter().map(|chunk| u64::from(chunk.indices())).sum(),
        };
        let counts = texere_counts {
            struct_size: size_of::<texere_counts>() as u32,
            reserved: 0,
            rings: plan.counts().rings,
            vertices: chunks.iter().map(|chunk| u64::from(chunk.vertices())).sum(),
            indices,
            triangles: plan.counts().triangles,
            draws: draws.len() as u64,
        };
        Ok(Self { yarns, device, settings, plan, chunks, draws, counts })
    }

    /// Makes the mesh. The slices have the lengths that the counts say.
    fn mesh(
        &self,
        vertices: &mut [Vertex],
        indices: &mut [u32],
        mut progress: impl FnMut(f64) -> std::ops::ControlFlow<()>,
    ) -> Result<(), Failure> {
        let mut session = Session::new(&*self.device.backend, self.plan.clone())?;
        let mut tell = |done: u64| match progress(done as f64 / self.chunks.len().max(1) as f64) {
            std::ops::ControlFlow::Continue(()) => Ok(()),
            std::ops::ControlFlow::Break(()) => Err(texere::PipelineError::Cancelled),
        };
        let mut first = 0;
        for points in self.yarns.points().chunks(UPLOAD_POINTS) {
            session.upload(first, points)?;
            first += points.len() as u64;
            tell(0)?;
        }
        session.scan()?;
        let shared = self.settings.topology == Topology::Shared;
        if shared {
            indices.copy_from_slice(&self.plan.shared_indices());
        }
        let (mut vertices_left, mut indices_left) = (vertices, if shared { &mut [][..] } else { indices });
        for (number, chunk) in self.chunks.iter().enumerate() {
            let (vertices, others) = vertices_left.split_at_mut(chunk.vertices() as usize);
            let (indices, other_indices) = indices_left.split_at_mut(chunk.indices() as usize);
            (vertices_left, indices_left) = (others, other_indices);
            session.mesh_into(chunk, MeshMut { vertices, indices })?;
            tell(number as u64 + 1)?;
        }
        Ok(())
    }
}

/// Control points of an upload: 16 MB, so that a cancelled run is noticed in between.
const UPLOAD_POINTS: usize = 1 << 20;

/// Plans the mesh of yarns on a device. `settings` may be null: `texere_settings_default` says what
/// holds then.
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

/// Writes the sizes of a plan's mesh. The caller has set `counts->struct_size`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_plan_counts(
    plan: *const texere_plan,
    counts: *mut texere_counts,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `counts`.
        unsafe { check_sized("counts", counts) }?;
        let found = get(plan)?.counts;
        // SAFETY: `check_sized` has seen that it is neither null nor misaligned nor too short.
        unsafe { counts.write(found) };
        Ok(())
    })
}

/// Lends the draws of a plan's mesh: `texere_plan_counts` says how many there are. They are valid
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
        // SAFETY: neither null nor misaligned; the caller vouches for the rest.
        unsafe { draws.write(plan.draws.as_ptr()) };
        Ok(())
    })
}

/// Makes the mesh of a plan in the caller's memory. `run` may be null.
///
/// Fails with TEXERE_ARGUMENT where `vertex_count` or `index_count` is not what
/// `texere_plan_counts` says, and with TEXERE_CANCELLED where `run` was cancelled. What the memory
/// holds then is not said.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_plan_mesh(
    plan: *const texere_plan,
    run: *const texere_run,
    vertices: *mut texere_vertex,
    vertex_count: u64,
    indices: *mut u32,
    index_count: u64,
) -> texere_status {
    guard(|| {
        let (plan, run) = (get(plan)?, get_any(run)?);
        let [vertex_length, index_length] = [plan.counts.vertices as usize, plan.counts.indices as usize];
        exactly("vertex_count", vertex_count, vertex_length)?;
        exactly("index_count", index_count, index_length)?;
        // SAFETY: the caller vouches for both; their lengths are those that were asked for. A
        // `texere_vertex` and a `Vertex` are six `f32` each.
        let (vertices, indices) = unsafe {
            (
                slice_mut("vertices", vertices.cast::<Vertex>(), vertex_length)?,
                slice_mut("indices", indices, index_length)?,
            )
        };
        plan.mesh(vertices, indices, reporter(run))
    })
}

/// Makes the mesh of a plan and writes it to a file, `.glb` or `.ply`, in bounded memory. `run` may
/// be null. A file of that name is replaced once the new one is whole.
///
/// Fails with TEXERE_IO where the file can't be written, and with TEXERE_CANCELLED where `run` was
/// cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_plan_write(
    plan: *const texere_plan,
    run: *const texere_run,
    path: *const c_char,
    path_length: usize,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `path`.
        let path = unsafe { text("path", path, path_length) }?;
        let (plan, run) = (get(plan)?, get_any(run)?);
        let mut report = reporter(run);
        let pipeline = Pipeline::new(&plan.yarns)
            .settings(plan.settings)
            .progress(move |done| report(done.rings as f64 / done.total.max(1) as f64));
        texere::write::stream(pipeline, &*plan.device.backend, path)?;
        Ok(())
    })
}

/// Frees a plan, or nothing where it is null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_plan_free(plan: *mut texere_plan) {
    free(plan);
}
