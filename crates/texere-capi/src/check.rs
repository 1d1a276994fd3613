//! What is wrong with a cloth, where, and what would cure it; and the reports of it as JSON.

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
    /// What `texere inspect --json` and `texere check --json` print.
    inspected: CString,
    checked: CString,
}

impl Handle for texere_check {
    type Value = Checked;
    const NAME: &str = "check";
}

/// The share by which yarns may come short of touching and still count as touching, as a rule.
pub const TEXERE_ACCURACY: f64 = 0.015;

/// More yarn lies in a place than there is room for, or too many parts of yarns to measure them
/// pair by pair. The value is the yarns' volume over the room.
pub const TEXERE_FAULT_CROWDED: u32 = 0;
/// Two yarns pierce one another. The value is how near they come: 1 where they just touch.
pub const TEXERE_FAULT_PIERCES: u32 = 1;
/// A bend is tighter than the tube is thick. The value is its radius in radii of the yarn.
pub const TEXERE_FAULT_FOLDS: u32 = 2;
/// A thread lies too close to the one before for crossing threads to pass. The value is their
/// distance over the one that is needed. There is no one place.
pub const TEXERE_FAULT_JAMS: u32 = 3;
/// The cloth does not hang together. The value is the number of its pieces. There is no one place.
pub const TEXERE_FAULT_APART: u32 = 4;
/// The mesh is wrung between two rings. The value is its width there in radii of the yarn.
pub const TEXERE_FAULT_WRUNG: u32 = 5;
/// Triangles of the mesh face inwards. The value is how many; the place is that of the first.
pub const TEXERE_FAULT_INSIDE_OUT: u32 = 6;
/// A knitting machine can't do a step of the program. There is neither a value nor a place.
pub const TEXERE_FAULT_MACHINE: u32 = 7;

/// A fault of a cloth.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_fault {
    /// Bytes of this struct, which the caller sets.
    pub struct_size: u32,
    /// A number that begins with TEXERE_FAULT; it says what `value` is.
    pub kind: u32,
    /// How bad it is. NaN where the kind has no value.
    pub value: f64,
    /// Where it is, mm. NaN where it has no one place.
    pub position: [f64; 3],
    /// The fault in words, with the threads that it is of: UTF-8 that ends with a zero byte, valid
    /// until the check is freed.
    pub words: *const c_char,
}

grows_after!(texere_fault, words);

/// What a check has found.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_diagnosis {
    /// Bytes of this struct, which the caller sets.
    pub struct_size: u32,
    /// 1 if there is no fault, else 0.
    pub clean: u32,
    /// "clean", or the faults in one phrase, such as "pierces itself, folds": UTF-8 that ends with
    /// a zero byte, valid until the check is freed.
    pub words: *const c_char,
    /// Contacts that are nearer than this pierce.
    pub touching: f64,
    /// How near yarns come to one another at the least: 1 where they just touch. Infinite where
    /// none come near; NaN where all places are crowded.
    pub clearance: f64,
    /// How many places there are where two yarns come near one another.
    pub contacts: u64,
    /// How many of the contacts are nearer than 1 by more than 0.001.
    pub below_one: u64,
    /// The radius of the tightest bend in radii of the yarn. Infinite where all yarns are straight.
    pub bend: f64,
    /// The least width of a tube of the mesh half way between two rings, in radii of the yarn.
    pub width: f64,
    /// How many triangles of the mesh face inwards.
    pub inwards: u64,
    /// How many faults `texere_check_fault` gives: 100 of each kind at most.
    pub faults: u64,
    /// How many warnings `texere_check_warning` gives.
    pub warnings: u64,
}

grows_after!(texere_diagnosis, warnings);

/// A fault, with words that can be lent.
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

    /// A fault at a place on a thread, if it has one.
    fn at(kind: u32, value: f64, place: Option<&ThreadPlace>, words: String) -> Self {
        let words = place.map_or(words.clone(), |place| format!("{place}: {words}"));
        Self::new(kind, value, place.map(|place| place.position_mm), words)
    }
}

fn json(report: &impl Serialize) -> Result<CString, Failure> {
    Ok(lendable(serde_json::to_string_pretty(report)?))
}

/// The faults of a cloth, and of the program that knits it.
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
        let words = format!("{width:.3} yarn radii half way between two rings");
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

/// The share of the progress that measuring takes. The rest of it is for finding cures.
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
            // Cures that were found before a stop are given without an error.
            checked.find_cures(of, |share| {
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

/// Checks a cloth: measures how near its yarns come to one another and how tightly they bend, looks
/// for faults, and for single changes of the design that cure them. A mesh with `settings` is
/// looked at, too; they may be null: `texere_settings_default` says what holds then. Yarns that
/// come short of touching by more than the share `accuracy` pierce: TEXERE_ACCURACY is usual. `run`
/// may be null.
///
/// A cloth with faults is no failure of the call. It fails with TEXERE_ARGUMENT for settings out of
/// range and for an accuracy that is not from 0 to below 1, and with TEXERE_CANCELLED where `run`
/// was cancelled.
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

/// Writes what a check has found. The caller has set `diagnosis->struct_size`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_check_diagnosis(
    check: *const texere_check,
    diagnosis: *mut texere_diagnosis,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `diagnosis`.
        unsafe { check_sized("diagnosis", diagnosis) }?;
        let found = get(check)?.diagnosis();
        // SAFETY: `check_sized` has taken it; the caller vouches for the rest.
        unsafe { write_sized(diagnosis, found) };
        Ok(())
    })
}

/// Writes the fault of a number, from 0. The caller has set `fault->struct_size`.
///
/// Fails with TEXERE_ARGUMENT where there are fewer.
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
        // SAFETY: `check_sized` has taken it; the caller vouches for the rest.
        unsafe { write_sized(fault, texere_fault { struct_size, kind, value, position, words }) };
        Ok(())
    })
}

/// Writes the warning of a number, from 0, to `words`: UTF-8 that ends with a zero byte, valid
/// until the check is freed. A warning is no fault.
///
/// Fails with TEXERE_ARGUMENT where there are fewer.
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

/// Frees a check, or nothing where it is null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_check_free(check: *mut texere_check) {
    free(check);
}
