//! The attributes of live cloth, in the caller's memory.

use std::ops::ControlFlow;

use texere::PipelineError;
use texere::mesh::Attribute;

use crate::argument::check;
use crate::error::guard;
use crate::failure::Failure;
use crate::handle::{alone, get_any};
use crate::live::{Editing, texere_change, texere_live};
use crate::live_mesh::within;
use crate::run::{reporter, texere_run};
use crate::status::texere_status;
use crate::view::{Strided, texere_view};

impl Editing {
    /// Reads the attributes of the vertices of `wanted` into the caller's memory.
    ///
    /// # Safety
    ///
    /// `out` is valid for a read, and the memory that it describes for writes.
    unsafe fn attributes_into(
        &mut self,
        wanted: &texere_change,
        out: *const texere_view,
        progress: impl FnMut(f64) -> ControlFlow<()>,
    ) -> Result<(), Failure> {
        if !self.live.mesh().keeps_attributes() {
            return Err(Failure::argument(
                "texere_live_keep_attributes has to be called first, and texere_live_update after it",
            ));
        }
        check("attributes", out)?;
        // SAFETY: the pointer is neither null nor misaligned; the caller vouches for the memory.
        let places = unsafe { out.read().holds("attributes", wanted.vertex_count as usize) }?;
        self.read_attributes(wanted, places, progress)
    }

    fn read_attributes(
        &mut self,
        wanted: &texere_change,
        mut places: Strided<'_, Attribute>,
        mut progress: impl FnMut(f64) -> ControlFlow<()>,
    ) -> Result<(), Failure> {
        let end = wanted.first_vertex + wanted.vertex_count;
        let mut had = 0;
        for number in 0..self.live.mesh().chunks().len() {
            let chunk = &self.live.mesh().chunks()[number];
            let (chunk_first, count) = (chunk.first_vertex(), u64::from(chunk.vertices()));
            if chunk_first >= end || chunk_first + count <= wanted.first_vertex {
                continue;
            }
            let mut asked = ControlFlow::Continue(());
            let _ = self.live.mesh_mut().read_attributes(number, &mut |first, piece| {
                let first = chunk_first + u64::from(first);
                let (from, to) = (first.max(wanted.first_vertex), end.min(first + piece.len() as u64));
                if from < to {
                    let own = &piece[(from - first) as usize..(to - first) as usize];
                    places.write((from - wanted.first_vertex) as usize, own.iter().copied());
                    had += to - from;
                }
                asked = progress(had as f64 / wanted.vertex_count as f64);
                asked
            })?;
            if asked.is_break() {
                return Err(PipelineError::Cancelled.into());
            }
        }
        Ok(())
    }
}

/// Makes attributes as well as the mesh, from the next update on. That update makes the whole mesh
/// again. From then on an edit of a yarn changes the whole yarn, because the length along the yarn
/// changes everywhere behind the edit.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_live_keep_attributes(live: *const texere_live) -> texere_status {
    guard(|| {
        alone(live, |editing| {
            editing.live.keep_attributes();
            Ok(())
        })
    })
}

/// Reads the attributes of a live cloth's vertices into the caller's memory: a `texere_attribute`
/// for each vertex that `texere_live_counts` counts, in the order of the mesh's vertices. `run` may
/// be null. The attributes in the room between yarns, into which yarns can grow, are undefined.
///
/// Fails with TEXERE_ARGUMENT if `texere_live_keep_attributes` has not been called, if
/// `texere_live_update` has not been called since then and since the last edit, and for a view that
/// is too small, misaligned or null. Fails with TEXERE_CANCELLED if `run` was cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_live_attributes(
    live: *const texere_live,
    run: *const texere_run,
    attributes: *const texere_view,
) -> texere_status {
    guard(|| {
        let run = get_any(run)?;
        alone(live, |editing| {
            let vertex_count = editing.counts.vertices;
            let all = texere_change { first_vertex: 0, vertex_count, first_index: 0, index_count: 0 };
            // SAFETY: the caller vouches for the view.
            unsafe { editing.attributes_into(&all, attributes, reporter(run)) }
        })
    })
}

/// Reads the attributes of a range of vertices, for example a change of the last update, into the
/// caller's memory: a `texere_attribute` for each of the `change->vertex_count` vertices.
///
/// Fails as `texere_live_attributes` does, and with TEXERE_ARGUMENT if the range does not lie
/// within the mesh.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_live_read_attributes(
    live: *const texere_live,
    change: *const texere_change,
    attributes: *const texere_view,
) -> texere_status {
    guard(|| {
        check("change", change)?;
        // SAFETY: the pointer is neither null nor misaligned; the caller vouches for the memory.
        let wanted = unsafe { change.read() };
        alone(live, |editing| {
            within("vertices", wanted.first_vertex, wanted.vertex_count, editing.counts.vertices)?;
            // SAFETY: the caller vouches for the view.
            unsafe { editing.attributes_into(&wanted, attributes, |_| ControlFlow::Continue(())) }
        })
    })
}
