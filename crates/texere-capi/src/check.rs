//! The check of a cloth: its faults, their places and cures, and the reports as JSON.

use std::ffi::{CString, c_char};
use std::ops::ControlFlow;

use serde::Serialize;
use texere::backend::Plan;
use texere::check::{
    CheckReport, ClothClearance, Diagnosis, InspectReport, SettlingReport, ThreadDrawn, ThreadPlace,
};
use texere::{PipelineError, Settings};

use crate::argument::{lend, numbered};
use crate::cloth::{Cloth, texere_cloth};
use crate::error::guard;
use crate::failure::Failure;
use crate::handle::{Handle, clear, free, get, get_any, give};
use crate::lendable::lendable;
use crate::run::{reporter, texere_run};
use crate::settings::{chosen, texere_settings};
use crate::sized::{check_sized, grows_after, write_sized};
use crate::status::texere_status;

/// The check of a cloth: how near its yarns come to one another, its faults, and their cures.
#[derive(Debug)]
pub struct texere_check;

#[derive(Debug)]
pub(crate) struct Checked {
    verdict: CString,
    diagnosis: Diagnosis,
    faults: Vec<Fault>,
    warnings: Vec<CString>,
    /// What `texere inspect --json` prints, and in `checked` what `texere check --json` prints.
    inspected: CString,
    checked: CString,
}

impl Handle for texere_check {
    type Value = Checked;
    const NAME: &str = "check";
}

/// The usual `accuracy` of `texere_check_new`: the share by which yarns may come short of touching
/// and still count as touching.
pub const TEXERE_ACCURACY: f64 = 0.015;

/// At a place there is more yarn than room, or so many parts of yarns that they can't be measured
/// pair by pair. The value is the volume of the yarns over the room.
pub const TEXERE_FAULT_CROWDED: u32 = 0;
/// Two yarns pierce one another. The value is how near they come: 1 if they just touch, less if
/// they pierce.
pub const TEXERE_FAULT_PIERCES: u32 = 1;
/// A bend is so tight that the tube folds into itself. The value is the radius of the bend over how
/// far the yarn's section reaches into the bend; below 1 the tube folds.
pub const TEXERE_FAULT_FOLDS: u32 = 2;
/// A thread lies so close to the thread before it that crossing threads can't pass between the two.
/// The value is their distance over the distance that is needed. The fault has no single place.
pub const TEXERE_FAULT_JAMS: u32 = 3;
/// The cloth does not hang together. The value is the number of its pieces. The fault has no single
/// place.
pub const TEXERE_FAULT_APART: u32 = 4;
/// The mesh is wrung: narrowed because two neighbouring rings are turned against one another. The
/// value is the width half way between the two, as a share of the width on the rings.
pub const TEXERE_FAULT_WRUNG: u32 = 5;
/// Triangles of the mesh face inwards. The value is how many; the place is that of the first
/// triangle.
pub const TEXERE_FAULT_INSIDE_OUT: u32 = 6;
/// A knitting machine can't do a step of the program. There is neither a value nor a place.
pub const TEXERE_FAULT_MACHINE: u32 = 7;

/// A fault of a cloth.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_fault {
    /// Size of this struct, bytes. The caller sets it.
    pub struct_size: u32,
    /// A constant whose name begins with TEXERE_FAULT; it says what `value` is.
    pub kind: u32,
    /// How bad the fault is, as its kind says. NaN if the kind has no value.
    pub value: f64,
    /// Where the fault is, mm. NaN if it has no single place.
    pub position: [f64; 3],
    /// The fault in words, with the names of its threads: UTF-8 that ends with a zero byte, valid
    /// until the check is freed.
    pub words: *const c_char,
}

grows_after!(texere_fault, words);

/// The result of a check.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_diagnosis {
    /// Size of this struct, bytes. The caller sets it.
    pub struct_size: u32,
    /// 1 if there is no fault, else 0.
    pub clean: u32,
    /// "clean", or the faults in one phrase, such as "pierces itself, folds": UTF-8 that ends with
    /// a zero byte, valid until the check is freed.
    pub words: *const c_char,
    /// The clearance below which two yarns count as piercing one another.
    pub touching: f64,
    /// The least clearance, which says how near yarns come to one another: 1 if they just touch,
    /// less if they pierce. Infinite if no yarns come near one another; NaN if all places where
    /// they do are too crowded to be measured.
    pub clearance: f64,
    /// How many contacts there are: places where two yarns come near one another.
    pub contacts: u64,
    /// How many contacts have a clearance below 1 by more than 0.001.
    pub below_one: u64,
    /// The radius of the tightest bend over how far the yarn's section reaches into the bend. A
    /// round yarn reaches as far as its radius. Below 1 the tube folds. Infinite if all yarns are
    /// straight.
    pub bend: f64,
    /// The least width of a tube of the mesh half way between two rings, as a share of the width on
    /// the rings.
    pub width: f64,
    /// How many triangles of the mesh face inwards.
    pub inwards: u64,
    /// How many faults `texere_check_fault` writes. At most 100 of a kind are listed.
    pub faults: u64,
    /// How many warnings `texere_check_warning` lends.
    pub warnings: u64,
}

grows_after!(texere_diagnosis, warnings);

/// A fault, with words that the library lends to the caller.
#[derive(Debug)]
struct Fault {
    kind: u32,
    value: f64,
    position: [f64; 3],
    words: CString,
}

impl Fault {
    fn new(kind: u32, value: f64, position: Option<[f64; 3]>, words: String) -> Self {
        let (position, words) = (position.unwrap_or([f64::NAN; 3]), lendable(words));
        Self { kind, value, position, words }
    }

    /// A fault at a place on a thread, if the place is known.
    fn at(kind: u32, value: f64, place: Option<&ThreadPlace>, words: String) -> Self {
        let words = place.map_or(words.clone(), |place| format!("{place}: {words}"));
        Self::new(kind, value, place.map(|place| place.position_mm), words)
    }
}

fn json(report: &impl Serialize) -> Result<CString, Failure> {
    Ok(lendable(serde_json::to_string_pretty(report)?))
}

/// The faults of a cloth, and the faults of the program that knits it.
fn faults(cloth: &Cloth, Diagnosis { faults, .. }: &Diagnosis) -> Vec<Fault> {
    let mut all = Vec::new();
    if let Some(crowd) = &faults.crowded {
        let words = if crowd.fill > 1.0 {
            format!("{:.1} times as much yarn as there is room for", crowd.fill)
        } else {
            format!("{} parts of yarns lie together", crowd.intervals)
        };
        all.push(Fault::at(TEXERE_FAULT_CROWDED, crowd.fill, Some(&crowd.place), words));
    }
    all.extend(faults.pierces.iter().map(|contact| {
        let [one, other] = &contact.places;
        let words = format!("{one} and {other}: {:.4} of touching", contact.ratio);
        Fault::new(TEXERE_FAULT_PIERCES, contact.ratio, Some(contact.middle_mm()), words)
    }));
    if let Some(bend) = &faults.folds {
        let words = format!("a bend of {:.3} yarn radii is tighter than the tube is thick", bend.radii);
        all.push(Fault::at(TEXERE_FAULT_FOLDS, bend.radii, bend.place.as_ref(), words));
    }
    all.extend(faults.jams.iter().flat_map(|jams| &jams.threads).map(|jam| {
        let (pitch, needed) = (jam.pitch_mm, jam.passing_mm);
        let words =
            format!("{}: {pitch:.4} mm from the one before, and {needed:.4} mm are needed", jam.thread);
        Fault::new(TEXERE_FAULT_JAMS, pitch / needed, None, words)
    }));
    if let Some(pieces) = &faults.apart {
        all.push(Fault::new(TEXERE_FAULT_APART, pieces.count as f64, None, pieces.to_string()));
    }
    if let Some(ThreadDrawn { width, width_at, .. }) = &faults.wrung {
        let words = format!("half way between two rings the tube has {width:.3} of its width on them");
        all.push(Fault::at(TEXERE_FAULT_WRUNG, *width, width_at.as_ref(), words));
    }
    if let Some(ThreadDrawn { inwards, inwards_at, .. }) = &faults.inside_out {
        let words = format!("triangles that face inwards: {inwards}, the first of them here");
        all.push(Fault::at(TEXERE_FAULT_INSIDE_OUT, *inwards as f64, inwards_at.as_ref(), words));
    }
    let steps = cloth.cloth.design().faults().iter().filter(|fault| fault.is_error);
    all.extend(steps.map(|fault| Fault::new(TEXERE_FAULT_MACHINE, f64::NAN, None, fault.message.clone())));
    all
}

/// The share of the progress that measuring takes. The search for cures takes the rest.
const MEASURED: f64 = 0.5;

impl Checked {
    fn new(
        cloth: &Cloth,
        settings: Settings,
        accuracy: f64,
        mut progress: impl FnMut(f64) -> ControlFlow<()> + Send,
    ) -> Result<Self, Failure> {
        let of = &cloth.cloth;
        let plan = Plan::new(of.yarns().layout().clone(), settings)?;
        let clearance = of.clearance(&settings, |share| progress(MEASURED * share))?;
        let settling = || SettlingReport::new(of, &cloth.device);
        let inspected = InspectReport::new(of, settling(), &plan, Some(&clearance))?;
        let mut checked = CheckReport::new(of, settling(), accuracy, &settings, clearance);
        let mut asked = progress(MEASURED);
        if checked.verdict().is_some() {
            // `find_cures` returns no error when the progress asks it to stop: it keeps the cures
            // found so far.
            checked.find_cures(of, &*texere::open("cpu")?, |share| {
                asked = progress(MEASURED + (1.0 - MEASURED) * share);
                asked
            })?;
        }
        if asked.is_break() {
            return Err(PipelineError::Cancelled.into());
        }
        Ok(Self {
            verdict: lendable(checked.verdict().unwrap_or("clean")),
            faults: faults(cloth, checked.diagnosis()),
            warnings: inspected.warnings().iter().cloned().map(lendable).collect(),
            inspected: json(&inspected)?,
            checked: json(&checked)?,
            diagnosis: checked.diagnosis().clone(),
        })
    }

    fn diagnosis(&self) -> texere_diagnosis {
        let ClothClearance { contacts, below_one, bend, drawn, .. } = &self.diagnosis.clearance;
        texere_diagnosis {
            struct_size: size_of::<texere_diagnosis>() as u32,
            clean: u32::from(self.faults.is_empty()),
            words: self.verdict.as_ptr(),
            touching: self.diagnosis.touching,
            clearance: self.diagnosis.clearance.least(),
            contacts: *contacts,
            below_one: *below_one,
            bend: bend.radii,
            width: drawn.width,
            inwards: drawn.inwards,
            faults: self.faults.len() as u64,
            warnings: self.warnings.len() as u64,
        }
    }
}

/// Checks a cloth: measures how near its yarns come to one another and how tightly they bend, and
/// looks for faults and for single changes of the design that cure them. It also looks for faults
/// of a mesh with `settings`, which may be null: then those of `texere_settings_default` apply. Two
/// yarns pierce one another if they come short of touching by more than the share `accuracy`.
/// TEXERE_ACCURACY is usual. `run` may be null.
///
/// The call succeeds for a cloth with faults. It fails with TEXERE_ARGUMENT for settings out of
/// range and for an accuracy that is not from 0 to below 1, and with TEXERE_CANCELLED if `run` was
/// cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_check_new(
    cloth: *const texere_cloth,
    settings: *const texere_settings,
    accuracy: f64,
    run: *const texere_run,
    out: *mut *mut texere_check,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `out`.
        unsafe { clear(out) }?;
        let (cloth, run) = (get(cloth)?, get_any(run)?);
        // SAFETY: the caller vouches for `settings`.
        let settings = unsafe { chosen(settings, cloth.cloth.yarns()) }?;
        if !(0.0..1.0).contains(&accuracy) {
            return Err(Failure::argument(format!("accuracy is {accuracy}, expected 0 to below 1")));
        }
        // SAFETY: as above.
        unsafe { give(out, Checked::new(&cloth, settings, accuracy, reporter(run))?) }
    })
}

/// Writes the result of a check. The caller sets `diagnosis->struct_size` before the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_check_diagnosis(
    check: *const texere_check,
    diagnosis: *mut texere_diagnosis,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `diagnosis`.
        unsafe { check_sized("diagnosis", diagnosis) }?;
        let found = get(check)?.diagnosis();
        // SAFETY: `check_sized` has accepted the size; the caller vouches for the memory.
        unsafe { write_sized(diagnosis, found) };
        Ok(())
    })
}

/// Writes fault `number`, counted from 0. The caller sets `fault->struct_size` before the call.
///
/// Fails with TEXERE_ARGUMENT for a number that is too high.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_check_fault(
    check: *const texere_check,
    number: u64,
    fault: *mut texere_fault,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `fault`.
        unsafe { check_sized("fault", fault) }?;
        let check = get(check)?;
        let Fault { kind, value, position, words } = numbered("fault", &check.faults, number)?;
        let struct_size = size_of::<texere_fault>() as u32;
        let (kind, value, position, words) = (*kind, *value, *position, words.as_ptr());
        // SAFETY: `check_sized` has accepted the size; the caller vouches for the memory.
        unsafe { write_sized(fault, texere_fault { struct_size, kind, value, position, words }) };
        Ok(())
    })
}

/// Lends warning `number`, counted from 0: writes its address to `words`. It is UTF-8 that ends
/// with a zero byte, valid until the check is freed. Warnings do not count as faults.
///
/// Fails with TEXERE_ARGUMENT for a number that is too high.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_check_warning(
    check: *const texere_check,
    number: u64,
    words: *mut *const c_char,
) -> texere_status {
    guard(|| {
        let check = get(check)?;
        // SAFETY: the caller vouches for `words`.
        unsafe { lend("words", numbered("warning", &check.warnings, number)?, words) }
    })
}

/// Lends the faults and their cures as JSON, as `texere check --json` prints them: UTF-8 that ends
/// with a zero byte, valid until the check is freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_check_json(
    check: *const texere_check,
    json: *mut *const c_char,
) -> texere_status {
    // SAFETY: the caller vouches for `json`.
    guard(|| unsafe { lend("json", &get(check)?.checked, json) })
}

/// Lends the counts and measures of the cloth as JSON, as `texere inspect --json` prints them:
/// UTF-8 that ends with a zero byte, valid until the check is freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_check_measures_json(
    check: *const texere_check,
    json: *mut *const c_char,
) -> texere_status {
    // SAFETY: the caller vouches for `json`.
    guard(|| unsafe { lend("json", &get(check)?.inspected, json) })
}

/// Frees a check. A null handle is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_check_free(check: *mut texere_check) {
    free(check);
}
