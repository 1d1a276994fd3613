//! Calls about devices, designs, cloth and runs with one wrong argument each.

use std::ptr::{null, null_mut};

use texere_c::*;

use crate::common::sized;
use crate::handles::{DESIGN, Handles, text};
use crate::tools::{Case, case, handles, no_handle, sizes, strange};

pub(crate) fn cases(own: &'static Handles) -> Vec<Case> {
    let mut cases: Vec<Case> = Vec::new();
    let ((cpu, length), (toml, toml_length)) = (text(c"cpu"), text(c"plain.toml"));
    let (bytes, size) = (DESIGN.as_ptr(), DESIGN.len());
    // A null pointer for the result.
    case!(cases, texere_error_place(null_mut()));
    case!(cases, texere_device_open(cpu, length, null_mut()));
    case!(cases, texere_device_describe(own.device, null_mut()));
    case!(cases, texere_design_read(toml, toml_length, null_mut()));
    case!(cases, texere_design_read_memory(toml, toml_length, bytes, size, None, null_mut(), null_mut()));
    case!(cases, texere_run_new(null_mut()));
    case!(cases, texere_run_progress(own.run, null_mut()));
    case!(cases, texere_cloth_rest(own.design, own.device, null(), null_mut()));
    case!(cases, texere_cloth_placed(own.design, null_mut()));
    case!(cases, texere_cloth_report(own.cloth, null_mut()));
    case!(cases, texere_cloth_warning(own.cloth, 0, null_mut()));
    case!(cases, texere_cloth_yarns(own.cloth, null_mut()));
    // A null text with a length, and a text that is not UTF-8.
    for (text, length) in [(null(), 4), (b"\xff\xfe".as_ptr().cast(), 2)] {
        case!(cases, texere_device_open(text, length, &mut null_mut()));
        case!(cases, texere_design_read(text, length, &mut null_mut()));
        case!(cases, texere_design_read_memory(text, length, bytes, 4, None, null_mut(), &mut null_mut()));
    }
    case!(cases, texere_design_read_memory(toml, toml_length, null(), 9, None, null_mut(), &mut null_mut()));
    handles!(cases, own, texere_run, |run| texere_run_cancel(run));
    handles!(cases, own, texere_run, |run| texere_run_progress(run, &mut 0.0));
    handles!(cases, own, texere_device, |device| texere_device_describe(device, &mut sized()));
    handles!(cases, own, texere_design, |design| texere_cloth_rest(
        design,
        own.device,
        null(),
        &mut null_mut()
    ));
    handles!(cases, own, texere_device, |device| texere_cloth_rest(
        own.design,
        device,
        null(),
        &mut null_mut()
    ));
    handles!(cases, own, texere_design, |design| texere_cloth_placed(design, &mut null_mut()));
    handles!(cases, own, texere_cloth, |cloth| texere_cloth_report(cloth, &mut sized()));
    handles!(cases, own, texere_cloth, |cloth| texere_cloth_warning(cloth, 0, &mut null()));
    handles!(cases, own, texere_cloth, |cloth| texere_cloth_yarns(cloth, &mut null_mut()));
    for run in strange() {
        no_handle!(cases, texere_cloth_rest(own.design, own.device, run, &mut null_mut()));
    }
    sizes!(cases, texere_device_info, |info| texere_device_describe(own.device, &mut info));
    sizes!(cases, texere_report, |report| texere_cloth_report(own.cloth, &mut report));
    case!(cases, texere_cloth_warning(own.cloth, u64::MAX, &mut null()));
    cases
}
