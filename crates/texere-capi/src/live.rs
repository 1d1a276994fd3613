//! Live cloth: a mesh that stays on its device while yarns are edited.

use std::ffi::CString;
use std::iter;
use std::ops::ControlFlow;
use std::sync::{Arc, Mutex};

use texere::mesh::{Change, Topology};
use texere::{Design, Live, PipelineError, Structure};

use crate::argument::check;
use crate::cloth::{Cloth, texere_cloth};
use crate::device::texere_device;
use crate::error::guard;
use crate::failure::Failure;
use crate::handle::{Handle, alone, clear, free, get, get_any, give};
use crate::plan::{shape, texere_counts, texere_draw};
use crate::run::{Run, reporter, texere_run};
use crate::settings::{chosen, texere_settings};
use crate::sized::{check_sized, grows_after, write_sized};
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
    pub(crate) counts: texere_counts,
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
    /// 1 if a new mesh was made, else 0. A new mesh is made in the first update, and for example
    /// after an edit by which a yarn outgrew its room. Sizes and draws may then have changed, and
    /// vertices may have other numbers.
    pub anew: u32,
    /// The ranges that were made again. They are valid until the next update of this live cloth, or
    /// until it is freed.
    pub changes: *const texere_change,
    /// How many changes there are.
    pub change_count: u64,
}

grows_after!(texere_update, change_count);

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

    fn update(&mut self, run: Option<Arc<Run>>) -> Result<texere_update, Failure> {
        let mut report = reporter(run);
        let ControlFlow::Continue(update) = self.live.update_watched(&mut || report(0.0))? else {
            return Err(PipelineError::Cancelled.into());
        };
        let _ = report(1.0);
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
/// first update makes the whole mesh. `run` may be null. The caller sets `update->struct_size`
/// before the call.
///
/// Fails with TEXERE_DEVICE or TEXERE_MEMORY if the device fails, and with TEXERE_CANCELLED if
/// `run` was cancelled. The next update then makes the same parts.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_live_update(
    live: *const texere_live,
    run: *const texere_run,
    update: *mut texere_update,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `update`.
        unsafe { check_sized("update", update) }?;
        let run = get_any(run)?;
        let made = alone(live, |editing| editing.update(run))?;
        // SAFETY: `check_sized` has accepted the size; the caller vouches for the memory.
        unsafe { write_sized(update, made) };
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
        // SAFETY: `check_sized` has accepted the size; the caller vouches for the memory.
        unsafe { write_sized(counts, found) };
        Ok(())
    })
}

/// Lends the draws of a live cloth's mesh as of its last update. `texere_live_counts` says how many
/// there are. Indices between two draws belong to the room into which yarns can grow, and are not
/// drawn. The draws are valid until the next update, or until the live cloth is freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_live_draws(
    live: *const texere_live,
    draws: *mut *const texere_draw,
) -> texere_status {
    guard(|| {
        check("draws", draws)?;
        let lent = alone(live, |editing| Ok(editing.draws.as_ptr()))?;
        // SAFETY: the pointer is neither null nor misaligned; the caller vouches for the memory.
        unsafe { draws.write(lent) };
        Ok(())
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
