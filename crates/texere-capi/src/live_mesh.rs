//! The mesh of live cloth, in the caller's memory.

use std::ops::ControlFlow;
use std::sync::Arc;

use texere::PipelineError;
use texere::backend::MeshMut;
use texere::mesh::{MeshPiece, Topology};

use crate::argument::check;
use crate::error::guard;
use crate::failure::Failure;
use crate::handle::{alone, get_any};
use crate::live::{Editing, texere_change, texere_live};
use crate::mesh::{memory, texere_vertex};
use crate::run::{Run, reporter, texere_run};
use crate::status::texere_status;

impl Editing {
    /// Reads a range of the mesh into the caller's memory.
    ///
    /// # Safety
    ///
    /// The conditions of [`memory`] hold.
    unsafe fn read_into(
        &mut self,
        wanted: &texere_change,
        vertices: (*mut texere_vertex, u64),
        indices: (*mut u32, u64),
        run: Option<Arc<Run>>,
    ) -> Result<(), Failure> {
        // SAFETY: the caller vouches for both.
        let into = unsafe { memory(vertices, indices, [wanted.vertex_count, wanted.index_count]) }?;
        self.read(wanted, into, reporter(run))
    }

    /// Reads the range `wanted` of the mesh into slices whose lengths are those of the range.
    fn read(
        &mut self,
        wanted: &texere_change,
        MeshMut { vertices, indices }: MeshMut<'_>,
        mut progress: impl FnMut(f64) -> ControlFlow<()>,
    ) -> Result<(), Failure> {
        let plan = self.live.mesh().plan().clone();
        if plan.settings().topology == Topology::Shared && !indices.is_empty() {
            overlap(0, &plan.shared_indices(), wanted.first_index, indices);
        }
        let (mut had, total) = (0, (vertices.len() + indices.len()).max(1));
        for number in 0..self.live.mesh().chunks().len() {
            let chunk = &self.live.mesh().chunks()[number];
            let (first_vertex, first_index) = (chunk.first_vertex(), chunk.first_index());
            let meets = |from: u64, count: u32, first: u64, wanted: u64| {
                first < from + u64::from(count) && from < first + wanted
            };
            let [any_vertices, any_indices] = [
                meets(first_vertex, chunk.vertices(), wanted.first_vertex, wanted.vertex_count),
                meets(first_index, chunk.indices(), wanted.first_index, wanted.index_count),
            ];
            if !any_vertices && !any_indices {
                continue;
            }
            let mut asked = ControlFlow::Continue(());
            let _ = self.live.mesh_mut().read_mesh(number, &mut |piece| {
                // Vertices come before indices, and both in order.
                let enough = match piece {
                    MeshPiece::Vertices { first, vertices: lent } => {
                        let first = first_vertex + u64::from(first);
                        had += overlap(first, lent, wanted.first_vertex, vertices);
                        let end = wanted.first_vertex + wanted.vertex_count;
                        !any_indices && first + lent.len() as u64 >= end
                    }
                    MeshPiece::Indices { first, indices: lent } => {
                        let first = first_index + u64::from(first);
                        had += overlap(first, lent, wanted.first_index, indices);
                        !any_indices || first + lent.len() as u64 >= wanted.first_index + wanted.index_count
                    }
                    _ => false,
                };
                asked = progress(had as f64 / total as f64);
                if enough { ControlFlow::Break(()) } else { asked }
            })?;
            if asked.is_break() {
                return Err(PipelineError::Cancelled.into());
            }
        }
        Ok(())
    }
}

/// Copies from `from` to `into` the values whose numbers lie in both, and returns how many they
/// are. The first value of `from` has the number `first`. The first value of `into` is to be that
/// with the number `wanted`.
fn overlap<T: Copy>(first: u64, from: &[T], wanted: u64, into: &mut [T]) -> usize {
    let start = first.max(wanted);
    let end = (first + from.len() as u64).min(wanted + into.len() as u64);
    if start >= end {
        return 0;
    }
    let count = (end - start) as usize;
    into[(start - wanted) as usize..][..count].copy_from_slice(&from[(start - first) as usize..][..count]);
    count
}

/// Makes sure that a range lies within a mesh that has `all` vertices or indices. `name` is
/// "vertices" or "indices".
pub(crate) fn within(name: &str, first: u64, count: u64, all: u64) -> Result<(), Failure> {
    if first.checked_add(count).is_some_and(|end| end <= all) {
        return Ok(());
    }
    Err(Failure::argument(format!("{count} {name} from {first} on, but the mesh has {all}")))
}

/// Reads the whole mesh of a live cloth into the caller's memory. `run` may be null. The contents
/// of the room between yarns, into which yarns can grow, are undefined.
///
/// Fails with TEXERE_ARGUMENT if `vertex_count` or `index_count` is not what `texere_live_counts`
/// says, and if `texere_live_update` has to be called first, after an edit for example. Fails with
/// TEXERE_CANCELLED if `run` was cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_live_mesh(
    live: *const texere_live,
    run: *const texere_run,
    vertices: *mut texere_vertex,
    vertex_count: u64,
    indices: *mut u32,
    index_count: u64,
) -> texere_status {
    guard(|| {
        let run = get_any(run)?;
        alone(live, |editing| {
            let all = texere_change {
                first_vertex: 0,
                vertex_count: editing.counts.vertices,
                first_index: 0,
                index_count: editing.counts.indices,
            };
            // SAFETY: the caller vouches for vertices and indices.
            unsafe { editing.read_into(&all, (vertices, vertex_count), (indices, index_count), run) }
        })
    })
}

/// Reads a range of the mesh of a live cloth into the caller's memory, such as a change of the last
/// update. Indices count from the base vertex of their draw.
///
/// Fails with TEXERE_ARGUMENT if the range does not lie within the mesh, if `vertex_count` or
/// `index_count` is not what the range says, and if `texere_live_update` has to be called first,
/// after an edit for example.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_live_read(
    live: *const texere_live,
    change: *const texere_change,
    vertices: *mut texere_vertex,
    vertex_count: u64,
    indices: *mut u32,
    index_count: u64,
) -> texere_status {
    guard(|| {
        check("change", change)?;
        // SAFETY: the pointer is neither null nor misaligned; the caller vouches for the memory.
        let wanted = unsafe { change.read() };
        alone(live, |editing| {
            within("vertices", wanted.first_vertex, wanted.vertex_count, editing.counts.vertices)?;
            within("indices", wanted.first_index, wanted.index_count, editing.counts.indices)?;
            // SAFETY: the caller vouches for vertices and indices.
            unsafe { editing.read_into(&wanted, (vertices, vertex_count), (indices, index_count), None) }
        })
    })
}
