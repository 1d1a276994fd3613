//! Cloth: the yarns of a design, as placed or at rest.

use std::ffi::{CString, c_char};
use std::sync::OnceLock;

use texere::check::Measures;
use texere::rest::{RestReport, stand_in};

use crate::argument::{lend, numbered};
use crate::design::texere_design;
use crate::device::texere_device;
use crate::error::guard;
use crate::handle::{Handle, clear, free, get, get_any, give};
use crate::lendable::lendable;
use crate::run::{reporter, texere_run};
use crate::sized::{check_sized, grows_after, write_sized};
use crate::status::texere_status;
use crate::yarns::texere_yarns;

/// The cloth of a design: its yarns, and whether they came to rest.
#[derive(Debug)]
pub struct texere_cloth;

#[derive(Debug)]
pub(crate) struct Cloth {
    pub(crate) cloth: texere::Cloth,
    /// The name of the device on which the yarns came to rest: the device that `texere_cloth_rest`
    /// was given, or the CPU if that stood in for it. Empty for a cloth of `texere_cloth_placed`.
    pub(crate) device: String,
    /// The measures. They are taken when they are first asked for.
    pub(crate) measures: OnceLock<Measures>,
    outcome: u32,
    words: CString,
    warnings: Vec<CString>,
}

impl Handle for texere_cloth {
    type Value = Cloth;
    const NAME: &str = "cloth";
}

/// The yarns are where the structure places them, because the design does not ask that they come to
/// rest, or because `texere_cloth_placed` made the cloth.
pub const TEXERE_PLACED: u32 = 0;
/// The yarns came to rest.
pub const TEXERE_AT_REST: u32 = 1;
/// The yarns settled without coming to rest. `words` of the report is "not at rest", or "jammed,
/// not at rest" if the yarns of a knit have no room.
pub const TEXERE_NOT_AT_REST: u32 = 2;
/// The yarns are where the structure places them, because they can't come to rest. `words` of the
/// report says why.
pub const TEXERE_REFUSED: u32 = 3;

/// Whether the yarns of a cloth came to rest.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_report {
    /// Size of this struct, bytes. The caller sets it.
    pub struct_size: u32,
    /// TEXERE_PLACED, TEXERE_AT_REST, TEXERE_NOT_AT_REST or TEXERE_REFUSED.
    pub outcome: u32,
    /// The outcome in words, UTF-8 that ends with a zero byte, valid until the cloth is freed.
    pub words: *const c_char,
    /// How many warnings the cloth has: `texere_cloth_warning` lends them.
    pub warnings: u64,
}

grows_after!(texere_report, warnings);

impl Cloth {
    fn new(cloth: texere::Cloth, device: &str) -> Self {
        let outcome = match cloth.report() {
            RestReport::Placed(_) => TEXERE_PLACED,
            RestReport::Finished(finished) if finished.is_at_rest() => TEXERE_AT_REST,
            RestReport::Finished(_) => TEXERE_NOT_AT_REST,
            _ => TEXERE_REFUSED,
        };
        let words = lendable(cloth.report().to_string());
        let warnings = cloth.warnings().into_iter().map(lendable).collect();
        let (device, measures) = (device.to_owned(), OnceLock::new());
        Self { cloth, device, measures, outcome, words, warnings }
    }
}

/// Makes the cloth of a design: places its yarns, and lets them come to rest on `device` if the
/// design asks for it. Rest by energy is worked out on the CPU if the device can't. `run` may be
/// null.
///
/// The call succeeds even if the yarns do not come to rest; `texere_cloth_report` says whether they
/// did. Threads of woven cloth that can't settle at all stay where the structure places them. The
/// call fails with TEXERE_DESIGN if the cloth can't be made or a knit can't settle, with
/// TEXERE_UNSUPPORTED if yarns can't settle on the device, and with TEXERE_CANCELLED if `run` was
/// cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_cloth_rest(
    design: *const texere_design,
    device: *const texere_device,
    run: *const texere_run,
    out: *mut *mut texere_cloth,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `out`.
        unsafe { clear(out) }?;
        let (design, device, run) = (get(design)?, get(device)?, get_any(run)?);
        let cpu = stand_in(design.finish.by, &*device.backend)?;
        let backend = cpu.as_deref().unwrap_or(&*device.backend);
        let cloth = (*design).clone().rest(backend).progress(reporter(run)).run()?;
        // SAFETY: as above.
        unsafe { give(out, Cloth::new(cloth, &backend.info().name)) }
    })
}

/// Makes the cloth of a design with its yarns where the structure places them, even if the design
/// asks that they come to rest.
///
/// Fails with TEXERE_DESIGN if the cloth can't be made.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_cloth_placed(
    design: *const texere_design,
    out: *mut *mut texere_cloth,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `out`.
        unsafe { clear(out) }?;
        let cloth = (*get(design)?).clone().placed(0.0)?;
        // SAFETY: as above.
        unsafe { give(out, Cloth::new(cloth, "")) }
    })
}

/// Writes whether the yarns of a cloth came to rest. The caller sets `report->struct_size` before
/// the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_cloth_report(
    cloth: *const texere_cloth,
    report: *mut texere_report,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `report`.
        unsafe { check_sized("report", report) }?;
        let cloth = get(cloth)?;
        let found = texere_report {
            struct_size: size_of::<texere_report>() as u32,
            outcome: cloth.outcome,
            words: cloth.words.as_ptr(),
            warnings: cloth.warnings.len() as u64,
        };
        // SAFETY: `check_sized` has accepted the size; the caller vouches for the memory.
        unsafe { write_sized(report, found) };
        Ok(())
    })
}

/// Lends warning `number` of a cloth, counted from 0: writes the address of the warning's text to
/// `words`. The text is UTF-8 that ends with a zero byte, valid until the cloth is freed.
///
/// Fails with TEXERE_ARGUMENT if the cloth has no warning of that number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_cloth_warning(
    cloth: *const texere_cloth,
    number: u64,
    words: *mut *const c_char,
) -> texere_status {
    guard(|| {
        let cloth = get(cloth)?;
        // SAFETY: the caller vouches for `words`.
        unsafe { lend("words", numbered("warning", &cloth.warnings, number)?, words) }
    })
}

/// Gives the yarns of a cloth, as a handle of their own. They stay valid when the cloth is freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_cloth_yarns(
    cloth: *const texere_cloth,
    out: *mut *mut texere_yarns,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `out`.
        unsafe {
            clear(out)?;
            give(out, get(cloth)?.cloth.yarns().clone())
        }
    })
}

/// Frees a cloth. A null handle is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_cloth_free(cloth: *mut texere_cloth) {
    free(cloth);
}
