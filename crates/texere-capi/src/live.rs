//! Live cloth: a mesh that stays on its device while yarns are edited.

use std::ffi::CString;
use std::iter;
use std::ops::ControlFlow;
use std::sync::{Arc, Mutex};

use texere::backend::MeshMut;
use texere::mesh::{Change, MeshPiece, Topology};
use texere::{Design, Live, PipelineError, Structure};

use crate::argument::{check, check_sized};
use crate::cloth::{Cloth, texere_cloth};
use crate::device::texere_device;
use crate::error::guard;
use crate::failure::Failure;
use crate::handle::{Handle, alone, clear, free, get, get_any, give};
use crate::mesh::{memory, texere_vertex};
use crate::plan::{shape, texere_counts, texere_draw};
use crate::run::{Run, reporter, texere_run};
use crate::settings::{chosen, texere_settings};
use crate::status::texere_status;
use crate::yarns::texere_yarns;

/// A cloth that is being edited, with its whole mesh on a device. One thread at a time may use it:
/// a call fails with TEXERE_ARGUMENT while a call of another thread is using it.
///
/// `texere_live_yarns` and `texere_live_pick` see an edit at once. `texere_live_update` brings
/// edits to the mesh. To undo an edit, set the old value again.
#[derive(Debug)]
pub struct texere_live;

/// A live cloth, with the values that the library lends to the caller.
#[derive(Debug)]
pub(crate) struct Editing {
    pub(crate) live: Live,
    /// The design by which places are named, if there is one.
    pub(crate) known: Known,
    /// The name of the material that `texere_live_material` wrote last.
    pub(crate) name: CString,
    counts: texere_counts,
    draws: Vec<texere_draw>,
    changes: Vec<texere_change>,
}

/// The origin of a live cloth's yarns.
#[derive(Debug)]
pub(crate) enum Known {
    Cloth(Arc<Cloth>),
    Design(Arc<Design>),
    Yarns,
}

impl Handle for texere_live {
    type Value = Mutex<Editing>;
    const NAME: &str = "live cloth";
}

/// A range of vertices and a range of indices that an update has made again. Both are numbered in
/// the whole mesh.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct texere_change {
    /// The number of the first vertex.
    pub first_vertex: u64,
    /// How many vertices there are.
    pub vertex_count: u64,
    /// The number of the first index.
    pub first_index: u64,
    /// How many indices there are: 0 unless the topology is TEXERE_TOPOLOGY_INDEXED.
    pub index_count: u64,
}

/// The parts of the mesh that an update has made again.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_update {
    /// Size of this struct, bytes. The caller sets it.
    pub struct_size: u32,
    /// 1 if the whole mesh was begun anew, for example because a yarn outgrew its room: then its
    /// sizes and draws may have changed, and vertices may have other numbers. Else 0.
    pub anew: u32,
    /// The ranges that were made again. They are valid until the next update of this live cloth, or
    /// until it is freed.
    pub changes: *const texere_change,
    /// How many changes there are.
    pub change_count: u64,
}

impl Known {
    pub(crate) fn design(&self) -> Option<&Design> {
        match self {
            Self::Cloth(cloth) => Some(cloth.cloth.design()),
            Self::Design(design) => Some(design),
            Self::Yarns => None,
        }
    }
}

impl Editing {
    fn new(live: Live, known: Known) -> Self {
        let (counts, draws, _) = shape(live.mesh().plan(), live.mesh().chunks());
        Self { live, known, name: CString::default(), counts, draws, changes: Vec::new() }
    }

    fn update(&mut self) -> Result<texere_update, Failure> {
        let update = self.live.update()?;
        (self.counts, self.draws, _) = shape(self.live.mesh().plan(), self.live.mesh().chunks());
        self.changes = update.changes.iter().flat_map(|change| self.stretches(change)).collect();
        Ok(texere_update {
            struct_size: size_of::<texere_update>() as u32,
            anew: u32::from(update.anew),
            changes: self.changes.as_ptr(),
            change_count: self.changes.len() as u64,
        })
    }

    /// A change as ranges of the whole mesh: one for the tubes, and one for the caps behind them if
    /// there are any.
    fn stretches(&self, change: &Change) -> impl Iterator<Item = texere_change> + use<> {
        let mesh = self.live.mesh();
        let (chunk, settings) = (&mesh.chunks()[change.chunk], *mesh.plan().settings());
        let stretch = |first: u32, vertices: u32, first_index: u32, indices: u32| texere_change {
            first_vertex: chunk.first_vertex() + u64::from(first),
            vertex_count: vertices.into(),
            first_index: chunk.first_index() + u64::from(first_index),
            index_count: indices.into(),
        };
        let Change { vertices, indices, caps, .. } = change;
        let tubes = stretch(vertices.start, vertices.len() as u32, indices.start, indices.len() as u32);
        let count = caps.len() as u32;
        let each = if settings.topology == Topology::Indexed { (settings.sides - 2) * 3 } else { 0 };
        let caps = chunk.caps()[caps.clone()]
            .first()
            .map(|cap| stretch(cap.first_vertex, count * settings.sides, cap.first_index, count * each));
        iter::once(tubes).chain(caps)
    }

    /// Reads a range of the mesh into the caller's memory.
    ///
    /// # Safety
    ///
    /// As for [`memory`].
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

/// Copies values from `from`, whose first value has the number `first`, to `into`, whose first
/// value is to be the one with the number `wanted`. Copies the numbers that both have, and returns
/// how many they are.
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

/// Makes a live cloth of a cloth, with its mesh on a device. If the cloth is woven, its lifts can
/// be set. `settings` may be null, and then those of `texere_settings_default` apply.
///
/// Fails with TEXERE_ARGUMENT for settings out of range, with TEXERE_MEMORY if the mesh has no room
/// on the device, and with TEXERE_UNSUPPORTED if the device can't keep a mesh.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_live_of_cloth(
    cloth: *const texere_cloth,
    device: *const texere_device,
    settings: *const texere_settings,
    out: *mut *mut texere_live,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `out`.
        unsafe { clear(out) }?;
        let (cloth, device) = (get(cloth)?, get(device)?.backend.clone());
        let (structure, yarns) = (&cloth.cloth.design().structure, cloth.cloth.yarns());
        // SAFETY: the caller vouches for `settings`.
        let settings = unsafe { chosen(settings, yarns) }?;
        let live = if matches!(structure, Structure::Woven(_)) {
            let mut live = Live::new(device, structure, settings)?;
            live.set_rest(yarns)?;
            live
        } else {
            Live::given(device, yarns.clone(), settings)?
        };
        // SAFETY: as above.
        unsafe { give(out, Mutex::new(Editing::new(live, Known::Cloth(cloth)))) }
    })
}

/// Makes a live cloth of yarns, with its mesh on a device. Yarns have no weave, so lifts can't be
/// set. `settings` may be null, and then those of `texere_settings_default` apply.
///
/// Fails as `texere_live_of_cloth` does.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_live_of_yarns(
    yarns: *const texere_yarns,
    device: *const texere_device,
    settings: *const texere_settings,
    out: *mut *mut texere_live,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `out`.
        unsafe { clear(out) }?;
        let (yarns, device) = (get(yarns)?, get(device)?.backend.clone());
        // SAFETY: the caller vouches for `settings`.
        let settings = unsafe { chosen(settings, &yarns) }?;
        let live = Live::given(device, (*yarns).clone(), settings)?;
        // SAFETY: as above.
        unsafe { give(out, Mutex::new(Editing::new(live, Known::Yarns))) }
    })
}

/// Makes again the parts of the mesh that edits have changed, and writes which parts they are. The
/// first update makes the whole mesh. The caller sets `update->struct_size` before the call.
///
/// Fails with TEXERE_DEVICE or TEXERE_MEMORY if the device fails. The next update then makes the
/// same parts.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_live_update(
    live: *const texere_live,
    update: *mut texere_update,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `update`.
        unsafe { check_sized("update", update) }?;
        let made = alone(live, Editing::update)?;
        // SAFETY: `check_sized` has made sure that the pointer is neither null nor misaligned, and
        // that the struct is long enough.
        unsafe { update.write(made) };
        Ok(())
    })
}

/// Writes the sizes of a live cloth's mesh as of its last update. The numbers of vertices and
/// indices include the room between yarns, into which yarns can grow. The caller sets
/// `counts->struct_size` before the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_live_counts(
    live: *const texere_live,
    counts: *mut texere_counts,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `counts`.
        unsafe { check_sized("counts", counts) }?;
        let found = alone(live, |editing| Ok(editing.counts))?;
        // SAFETY: `check_sized` has made sure that the pointer is neither null nor misaligned, and
        // that the struct is long enough.
        unsafe { counts.write(found) };
        Ok(())
    })
}

/// Lends the draws of a live cloth's mesh as of its last update. `texere_live_counts` says how many
/// there are. Indices between two draws are room, and are not drawn. The draws are valid until the
/// next update, or until the live cloth is freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_live_draws(
    live: *const texere_live,
    draws: *mut *const texere_draw,
) -> texere_status {
    guard(|| {
        check("draws", draws)?;
        let lent = alone(live, |editing| Ok(editing.draws.as_ptr()))?;
        // SAFETY: the pointer is neither null nor misaligned; the caller vouches for the rest.
        unsafe { draws.write(lent) };
        Ok(())
    })
}

/// Reads the whole mesh of a live cloth into the caller's memory. `run` may be null. The contents
/// of the room between yarns are undefined.
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
        // SAFETY: the pointer is neither null nor misaligned; the caller vouches for the rest.
        let wanted = unsafe { change.read() };
        alone(live, |editing| {
            let within = |name: &str, first: u64, count: u64, all: u64| {
                let end = first.checked_add(count).filter(|end| *end <= all);
                end.map(|_| ()).ok_or_else(|| {
                    Failure::argument(format!("{count} {name} from {first} on, but the mesh has {all}"))
                })
            };
            within("vertices", wanted.first_vertex, wanted.vertex_count, editing.counts.vertices)?;
            within("indices", wanted.first_index, wanted.index_count, editing.counts.indices)?;
            // SAFETY: the caller vouches for vertices and indices.
            unsafe { editing.read_into(&wanted, (vertices, vertex_count), (indices, index_count), None) }
        })
    })
}

/// Gives the yarns of a live cloth as they are now, as a handle of their own. They stay as they are
/// when the live cloth is edited or freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_live_yarns(
    live: *const texere_live,
    out: *mut *mut texere_yarns,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `out`.
        unsafe { clear(out) }?;
        let yarns = alone(live, |editing| Ok(editing.live.yarns()?))?;
        // SAFETY: as above.
        unsafe { give(out, yarns) }
    })
}

/// Frees a live cloth. A null handle is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_live_free(live: *mut texere_live) {
    free(live);
}
