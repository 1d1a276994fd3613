//! Making the mesh of a plan in the caller's memory.

use std::ops::ControlFlow;
use std::sync::Arc;

use texere::Vertex;
use texere::backend::MeshMut;
use texere::mesh::{MeshPiece, Topology};

use crate::argument::slice_mut;
use crate::error::guard;
use crate::failure::Failure;
use crate::handle::{get, get_any};
use crate::plan::{Planned, texere_plan};
use crate::run::{Run, texere_run};
use crate::sized::{grows_after, sized};
use crate::status::texere_status;
use crate::view::{Strided, texere_view};
use crate::yarns::exactly;

/// A vertex of a tube.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_vertex {
    /// Position, mm.
    pub position: [f32; 3],
    /// Unit normal. It points out of the yarn.
    pub normal: [f32; 3],
}

const _: () = assert!(size_of::<texere_vertex>() == size_of::<Vertex>());

/// Where in the caller's memory a mesh is written: arrays of its own, or members of the caller's
/// structs. No two values may overlap.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_mesh_arrays {
    /// Size of this struct, bytes. The caller sets it.
    pub struct_size: u32,
    /// Zero.
    pub reserved: u32,
    /// Positions, mm: three `float` for each vertex.
    pub positions: texere_view,
    /// Unit normals, which point out of the yarn: three `float` for each vertex. With null `data`
    /// they are left out.
    pub normals: texere_view,
    /// Indices, a `uint32_t` each. With null `data` they are left out.
    pub indices: texere_view,
}

grows_after!(texere_mesh_arrays, indices);

/// The views of `texere_mesh_arrays` after their checks.
struct Places<'a> {
    positions: Strided<'a, [f32; 3]>,
    normals: Option<Strided<'a, [f32; 3]>>,
    indices: Option<Strided<'a, u32>>,
}

impl Places<'_> {
    /// Writes positions and normals of vertices, from vertex `first` on.
    fn write_vertices(&mut self, first: usize, vertices: &[Vertex]) {
        self.positions.write(first, vertices.iter().map(|vertex| vertex.position));
        if let Some(normals) = &mut self.normals {
            normals.write(first, vertices.iter().map(|vertex| vertex.normal));
        }
    }

    fn write_indices(&mut self, first: usize, own: &[u32]) {
        if let Some(indices) = &mut self.indices {
            indices.write(first, own.iter().copied());
        }
    }
}

impl Planned {
    /// Makes the mesh. The slices of `out` have the lengths that `self.counts` says.
    fn mesh(&self, run: Option<Arc<Run>>, out: MeshMut<'_>) -> Result<(), Failure> {
        Ok(self.start(run)?.mesh_into(&self.chunks, out)?)
    }

    /// Makes the mesh piece by piece, and copies each piece to its places.
    fn scatter(&self, run: Option<Arc<Run>>, mut places: Places<'_>) -> Result<(), Failure> {
        if self.plan.settings().topology == Topology::Shared {
            places.write_indices(0, &self.plan.shared_indices());
        }
        let _ = self.start(run)?.stream(&self.chunks, |chunk, piece| {
            match piece {
                MeshPiece::Vertices { first, vertices } => {
                    places.write_vertices(chunk.first_vertex() as usize + first as usize, vertices);
                }
                MeshPiece::Indices { first, indices } => {
                    places.write_indices(chunk.first_index() as usize + first as usize, indices);
                }
                _ => {}
            }
            ControlFlow::<()>::Continue(())
        })?;
        Ok(())
    }
}

/// The caller's memory for vertices and indices. Fails unless it has room for exactly as many as
/// are needed.
///
/// # Safety
///
/// Both pointers are valid for writes of as many values as their counts say. Nothing else uses the
/// values as long as the result lives.
pub(crate) unsafe fn memory<'a>(
    (vertices, vertex_count): (*mut texere_vertex, u64),
    (indices, index_count): (*mut u32, u64),
    [vertices_needed, indices_needed]: [u64; 2],
) -> Result<MeshMut<'a>, Failure> {
    let [vertex_length, index_length] = [vertices_needed as usize, indices_needed as usize];
    exactly("vertex_count", vertex_count, vertex_length)?;
    exactly("index_count", index_count, index_length)?;
    // SAFETY: the caller vouches for both pointers, and `exactly` has compared the counts. A
    // `texere_vertex` and a `Vertex` are six `f32` each.
    unsafe {
        Ok(MeshMut {
            vertices: slice_mut("vertices", vertices.cast::<Vertex>(), vertex_length)?,
            indices: slice_mut("indices", indices, index_length)?,
        })
    }
}

/// Makes the mesh of a plan in the caller's memory, as an array of `texere_vertex` and one of
/// indices. `run` may be null.
///
/// Fails with TEXERE_ARGUMENT if `vertex_count` or `index_count` is not what `texere_plan_counts`
/// says, and with TEXERE_CANCELLED if `run` was cancelled. After a failure the contents of the
/// memory are undefined.
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
        // SAFETY: the caller vouches for both.
        let out = unsafe {
            memory(
                (vertices, vertex_count),
                (indices, index_count),
                [plan.counts.vertices, plan.counts.indices],
            )
        }?;
        plan.mesh(run, out)
    })
}

/// Makes the mesh of a plan in arrays that the caller chooses. Positions and normals go to arrays
/// of their own, to members of the caller's structs, or one behind the other as in `texere_vertex`.
/// `run` may be null. `texere_plan_counts` says how many vertices and indices there are. Memory
/// between values stays as it is.
///
/// The call is fastest with each normal right behind its position, 24 bytes from vertex to vertex,
/// and with indices that lie side by side: the mesh is then not copied value by value.
///
/// Fails with TEXERE_ARGUMENT for a view that is too small or misaligned and for null positions,
/// and with TEXERE_CANCELLED if `run` was cancelled. After a failure the contents of the memory are
/// undefined.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_plan_mesh_arrays(
    plan: *const texere_plan,
    run: *const texere_run,
    arrays: *const texere_mesh_arrays,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `arrays`.
        let given = unsafe { sized("arrays", arrays) }?;
        let (plan, run) = (get(plan)?, get_any(run)?);
        let [vertices, indices] = [plan.counts.vertices as usize, plan.counts.indices as usize];
        // SAFETY: the caller vouches for the views.
        let mut places = unsafe {
            Places {
                positions: given.positions.holds("arrays.positions", vertices)?,
                normals: given.normals.holds_any("arrays.normals", vertices)?,
                indices: given.indices.holds_any("arrays.indices", indices)?,
            }
        };
        let behind = given.positions.data.wrapping_byte_add(size_of::<[f32; 3]>());
        let strides = [given.positions.stride, given.normals.stride];
        let vertex = size_of::<Vertex>() as u64;
        if given.normals.data == behind
            && strides == [vertex; 2]
            && let Some(indices) = places.indices.as_mut().and_then(Strided::dense)
        {
            // SAFETY: both views have been checked. Their values lie as those of an array of as
            // many vertices, which begins at the first position.
            let vertices =
                unsafe { slice_mut("arrays.positions", given.positions.data.cast::<Vertex>(), vertices) }?;
            return plan.mesh(run, MeshMut { vertices, indices });
        }
        plan.scatter(run, places)
    })
}
