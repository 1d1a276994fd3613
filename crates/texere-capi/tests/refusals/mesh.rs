//! Calls about yarns, settings and plans with wrong arguments.

use std::ptr::{null, null_mut};

use texere_c::*;

use crate::calls::done;
use crate::common::sized;
use crate::handles::{Handles, text};
use crate::outputs::take_bytes;
use crate::tools::{Case, case, handles, no_handle, sizes, strange};

static POINTS: [texere_point; 2] = [
    texere_point { x: 0.0, y: 0.0, z: 0.0, half_width: 0.1, half_height: 0.1 },
    texere_point { x: f32::NAN, y: 0.0, z: 0.0, half_width: 0.1, half_height: 0.1 },
];

/// Valid settings.
pub(crate) fn settings() -> texere_settings {
    texere_settings { subdivisions: 1, sides: 6, quantum_mm: 1.0, ..sized() }
}

/// Invalid settings.
pub(crate) fn wrong_settings() -> [texere_settings; 5] {
    let right = settings();
    [
        texere_settings { sides: 2, ..right },
        texere_settings { frame: 9, ..right },
        texere_settings { topology: 3, ..right },
        texere_settings { caps: 2, ..right },
        texere_settings { subdivisions: u32::MAX, ..right },
    ]
}

pub(crate) fn cases(own: &'static Handles) -> Vec<Case> {
    let mut cases: Vec<Case> = Vec::new();
    let (toml, toml_length) = text(c"plain.toml");
    // A null pointer for the result.
    case!(cases, texere_settings_default(own.yarns, null_mut()));
    case!(cases, texere_yarns_counts(own.yarns, null_mut()));
    case!(cases, texere_yarns_new(null(), &mut null_mut()));
    case!(cases, texere_plan_new(own.yarns, own.device, null(), null_mut()));
    case!(cases, texere_plan_counts(own.plan, null_mut()));
    case!(cases, texere_plan_draws(own.plan, null_mut()));
    // A null text with a length, and a text that is not UTF-8.
    for (text, length) in [(null(), 4), (b"\xff\xfe".as_ptr().cast(), 2)] {
        case!(cases, texere_yarns_read(text, length, &mut null_mut()));
        case!(cases, texere_yarns_read_curves(text, length, 1.0, 1.0, &mut null_mut()));
        case!(cases, texere_yarns_write(own.yarns, text, length));
        case!(cases, texere_yarns_read_memory(text, length, null(), 0, &mut null_mut()));
        case!(cases, texere_plan_write(own.plan, null(), text, length));
    }
    handles!(cases, own, texere_yarns, |yarns| texere_settings_default(yarns, &mut sized()));
    handles!(cases, own, texere_yarns, |yarns| texere_yarns_write(yarns, toml, toml_length));
    case!(cases, texere_yarns_write(own.yarns, toml, toml_length));
    case!(cases, texere_yarns_read_memory(toml, toml_length, null(), 1, &mut null_mut()));
    case!(cases, texere_yarns_read_memory(toml, toml_length, null(), 0, null_mut()));
    case!(cases, texere_yarns_read_curves(toml, toml_length, 1.0, 1.0, null_mut()));
    handles!(cases, own, texere_yarns, |it| texere_yarns_write_to(it, 0, Some(take_bytes), null_mut()));
    case!(cases, texere_yarns_write_to(own.yarns, 4, Some(take_bytes), null_mut()));
    case!(cases, texere_yarns_write_to(own.yarns, 0, None, null_mut()));
    handles!(cases, own, texere_yarns, |yarns| texere_yarns_counts(yarns, &mut sized()));
    handles!(cases, own, texere_yarns, |yarns| texere_yarns_points(yarns, null_mut(), 0, null_mut(), 0));
    handles!(cases, own, texere_yarns, |yarns| texere_plan_new(yarns, own.device, null(), &mut null_mut()));
    handles!(cases, own, texere_device, |device| texere_plan_new(own.yarns, device, null(), &mut null_mut()));
    handles!(cases, own, texere_plan, |plan| texere_plan_counts(plan, &mut sized()));
    handles!(cases, own, texere_plan, |plan| texere_plan_draws(plan, &mut null()));
    handles!(cases, own, texere_plan, |plan| texere_plan_mesh(plan, null(), null_mut(), 0, null_mut(), 0));
    handles!(cases, own, texere_plan, |plan| texere_plan_write(plan, null(), toml, toml_length));
    for run in strange() {
        no_handle!(cases, texere_plan_mesh(own.plan, run, null_mut(), 0, null_mut(), 0));
        no_handle!(cases, texere_plan_write(own.plan, run, toml, toml_length));
    }
    sizes!(cases, texere_settings, |settings| texere_settings_default(own.yarns, &mut settings));
    sizes!(cases, texere_settings, |settings| texere_plan_new(
        own.yarns,
        own.device,
        &settings,
        &mut null_mut()
    ));
    sizes!(cases, texere_yarn_counts, |counts| texere_yarns_counts(own.yarns, &mut counts));
    sizes!(cases, texere_yarn_arrays, |arrays| texere_yarns_new(&arrays, &mut null_mut()));
    sizes!(cases, texere_counts, |counts| texere_plan_counts(own.plan, &mut counts));
    // Counts that are not those of the plan or of the yarns, and right counts with null arrays.
    case!(cases, texere_yarns_points(own.yarns, &mut 0, 1, &mut texere_point::default(), 1));
    case!(cases, texere_plan_mesh(own.plan, null(), null_mut(), 1, null_mut(), 1));
    let mut counts: texere_counts = sized();
    // SAFETY: all pointers are those of values that live as long as the call.
    done(unsafe { texere_plan_counts(own.plan, &mut counts) });
    case!(cases, texere_plan_mesh(own.plan, null(), null_mut(), counts.vertices, null_mut(), counts.indices));
    for settings in wrong_settings() {
        case!(cases, texere_plan_new(own.yarns, own.device, &settings, &mut null_mut()));
    }
    cases.extend(arrays());
    cases
}

/// Arrays from which no yarns can be made.
fn arrays() -> Vec<Case> {
    static OFFSETS: [&[u64]; 4] = [&[0, 2], &[1, 2], &[0, 2, 1], &[0, 1]];
    let mut cases: Vec<Case> = Vec::new();
    let right = texere_yarn_arrays { points: POINTS.as_ptr(), ..sized() };
    for offsets in OFFSETS {
        let (yarns, offsets) = (offsets.len() as u64 - 1, offsets.as_ptr());
        let arrays = texere_yarn_arrays { yarns, offsets, ..right };
        case!(cases, texere_yarns_new(&arrays, &mut null_mut()));
    }
    let many = texere_yarn_arrays { yarns: u64::MAX, offsets: OFFSETS[0].as_ptr(), ..right };
    case!(cases, texere_yarns_new(&many, &mut null_mut()));
    cases
}
