//! Handles of a small cloth on `cpu`, one of each kind but the session: `cpu` has no sessions.

use std::ffi::{CStr, c_char};
use std::ptr::null;

use texere_c::*;

use crate::calls::{done, made};
use crate::common::sized;
use crate::reading::read;

/// The handles of a small cloth.
pub(crate) struct Handles {
    pub(crate) device: *mut texere_device,
    pub(crate) design: *mut texere_design,
    pub(crate) run: *mut texere_run,
    pub(crate) cloth: *mut texere_cloth,
    pub(crate) yarns: *mut texere_yarns,
    pub(crate) plan: *mut texere_plan,
    pub(crate) live: *mut texere_live,
    pub(crate) picker: *mut texere_picker,
    pub(crate) check: *mut texere_check,
    pub(crate) renderer: *mut texere_renderer,
}

pub(crate) const DESIGN: &str = "weave = { notation = \"plain\", ends = 4, picks = 4 }\nfinish.settle = false\n\
    yarns.a.diameter_mm = 0.2\nwarp = { yarns = [\"a\"], spacing_mm = 0.5 }\n\
    weft = { yarns = [\"a\"], spacing_mm = 0.5 }\n";

impl Handles {
    pub(crate) fn new() -> Self {
        let (cpu, length) = text(c"cpu");
        // SAFETY: all pointers are those of values that live as long as the calls.
        unsafe {
            let device = made(|out| texere_device_open(cpu, length, out));
            let design = read(DESIGN);
            let run = made(|out| texere_run_new(out));
            let cloth = made(|out| texere_cloth_rest(design, device, run, out));
            let yarns = made(|out| texere_cloth_yarns(cloth, out));
            let plan = made(|out| texere_plan_new(yarns, device, null(), out));
            let live = made(|out| texere_live_of_cloth(cloth, device, null(), out));
            done(texere_live_update(live, null(), &mut sized()));
            let picker = made(|out| texere_picker_new(yarns, null(), out));
            let check = made(|out| texere_check_new(cloth, null(), TEXERE_ACCURACY, null(), out));
            let renderer = made(|out| texere_renderer_open(null(), 0, out));
            done(texere_renderer_show(renderer, yarns, null(), null()));
            Self { device, design, run, cloth, yarns, plan, live, picker, check, renderer }
        }
    }
}

/// A text as C passes it: a pointer and a length.
pub(crate) fn text(text: &'static CStr) -> (*const c_char, usize) {
    (text.as_ptr(), text.count_bytes())
}

/// Memory for a mesh of these sizes.
fn memory(counts: &texere_counts) -> (Vec<texere_vertex>, Vec<u32>) {
    let blank = texere_vertex { position: [0.0; 3], normal: [0.0; 3] };
    (vec![blank; counts.vertices as usize], vec![0; counts.indices as usize])
}

/// Makes the mesh of a plan in new memory. Returns the status of the call and the vertices.
pub(crate) fn mesh(plan: *const texere_plan, run: *const texere_run) -> (texere_status, Vec<texere_vertex>) {
    let mut counts: texere_counts = sized();
    // SAFETY: all pointers are those of values that live as long as the calls.
    unsafe {
        done(texere_plan_counts(plan, &mut counts));
        let (mut vertices, mut indices) = memory(&counts);
        let (to, also) = (vertices.as_mut_ptr(), indices.as_mut_ptr());
        (texere_plan_mesh(plan, run, to, counts.vertices, also, counts.indices), vertices)
    }
}

/// Reads the mesh of a live cloth into new memory. Returns the status of the call.
pub(crate) fn live_mesh(live: *const texere_live, run: *const texere_run) -> texere_status {
    let mut counts: texere_counts = sized();
    // SAFETY: all pointers are those of values that live as long as the calls.
    unsafe {
        done(texere_live_counts(live, &mut counts));
        let (mut vertices, mut indices) = memory(&counts);
        let (to, also) = (vertices.as_mut_ptr(), indices.as_mut_ptr());
        texere_live_mesh(live, run, to, counts.vertices, also, counts.indices)
    }
}
