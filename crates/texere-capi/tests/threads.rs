//! Calls of several threads at once: meshes made at the same time, and runs that another thread
//! cancels.

#![allow(clippy::unwrap_used, reason = "a test ends at what it did not expect")]

mod common;
#[path = "common/reading.rs"]
mod reading;

use std::ptr::{null, null_mut};
use std::sync::Barrier;
use std::thread;

use texere_c::texere_status::*;
use texere_c::*;

use common::{message, sized};
use reading::read;

/// The text of a 2/1 twill of `threads` ends and picks.
fn woven(threads: u32, settles: bool) -> String {
    format!(
        "weave = {{ notation = \"2/1\", ends = {threads}, picks = {threads} }}\n\
         finish.settle = {settles}\nyarns.a.diameter_mm = 0.2\n\
         warp = {{ yarns = [\"a\"], spacing_mm = 0.3 }}\nweft = {{ yarns = [\"a\"], spacing_mm = 0.3 }}\n"
    )
}

/// A handle that threads share. The library allows that.
struct Shared<H>(*mut H);

impl<H> Clone for Shared<H> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<H> Copy for Shared<H> {}

// SAFETY: the library looks handles up, and any thread may use them.
unsafe impl<H> Send for Shared<H> {}
// SAFETY: as above.
unsafe impl<H> Sync for Shared<H> {}

fn device() -> Shared<texere_device> {
    let mut device = null_mut();
    // SAFETY: all pointers are those of values that live as long as the call.
    assert_eq!(unsafe { texere_device_open(c"cpu".as_ptr(), 3, &mut device) }, TEXERE_OK);
    Shared(device)
}

fn placed(text: &str) -> Shared<texere_yarns> {
    let (design, mut cloth, mut yarns) = (read(text), null_mut(), null_mut());
    // SAFETY: all pointers are those of values that live as long as the calls.
    unsafe {
        assert_eq!(texere_cloth_placed(design, &mut cloth), TEXERE_OK, "{}", message());
        assert_eq!(texere_cloth_yarns(cloth, &mut yarns), TEXERE_OK);
        texere_cloth_free(cloth);
        texere_design_free(design);
    }
    Shared(yarns)
}

/// Makes the mesh of a design from its text. Returns the bits of the vertices, and the indices.
fn mesh(text: &str, device: Shared<texere_device>) -> (Vec<[u32; 6]>, Vec<u32>) {
    let yarns = placed(text);
    let (mut plan, mut counts) = (null_mut(), sized::<texere_counts>());
    let vertex = texere_vertex { position: [0.0; 3], normal: [0.0; 3] };
    // SAFETY: all pointers are those of values that live as long as the calls.
    unsafe {
        assert_eq!(texere_plan_new(yarns.0, device.0, null(), &mut plan), TEXERE_OK, "{}", message());
        assert_eq!(texere_plan_counts(plan, &mut counts), TEXERE_OK);
        let (mut vertices, mut indices) =
            (vec![vertex; counts.vertices as usize], vec![0; counts.indices as usize]);
        let (points, numbers) = (vertices.as_mut_ptr(), indices.as_mut_ptr());
        let made = texere_plan_mesh(plan, null(), points, counts.vertices, numbers, counts.indices);
        assert_eq!(made, TEXERE_OK, "{}", message());
        texere_plan_free(plan);
        texere_yarns_free(yarns.0);
        let bits = |vertex: &texere_vertex| {
            let ([x, y, z], [u, v, w]) = (vertex.position, vertex.normal);
            [x, y, z, u, v, w].map(f32::to_bits)
        };
        (vertices.iter().map(bits).collect(), indices)
    }
}

#[test]
fn eight_threads_mesh_eight_cloths_as_each_does_alone() {
    let device = device();
    let texts: Vec<_> = (0..8).map(|number| woven(9 + 5 * number, false)).collect();
    let alone: Vec<_> = texts.iter().map(|text| mesh(text, device)).collect();
    let start = Barrier::new(texts.len());
    thread::scope(|scope| {
        for (text, alone) in texts.iter().zip(&alone) {
            let start = &start;
            scope.spawn(move || {
                start.wait();
                for _ in 0..4 {
                    assert!(mesh(text, device) == *alone);
                }
            });
        }
    });
}

/// Makes `call` with a run, which another thread cancels as soon as its progress is above 0.
/// Returns the status of the call.
fn cancelled(call: impl FnOnce(*const texere_run) -> texere_status) -> texere_status {
    let mut run = null_mut();
    // SAFETY: the place lives as long as the call.
    assert_eq!(unsafe { texere_run_new(&mut run) }, TEXERE_OK);
    let run = Shared(run);
    thread::scope(|scope| {
        scope.spawn(move || {
            let (run, mut share) = (run, 0.0);
            while share == 0.0 {
                thread::yield_now();
                // SAFETY: the place lives as long as the call.
                let told = unsafe { texere_run_progress(run.0, &mut share) };
                // The run was freed: the call ended before it could be cancelled.
                if told != TEXERE_OK {
                    return;
                }
            }
            // SAFETY: handles are looked up.
            assert_eq!(unsafe { texere_run_cancel(run.0) }, TEXERE_OK);
        });
        let status = call(run.0);
        // SAFETY: as above.
        unsafe { texere_run_free(run.0) };
        status
    })
}

#[test]
fn a_run_that_another_thread_cancels_ends_rest() {
    let device = device();
    // Woven cloth comes to rest by its crossings, a knit by contact of its yarns.
    let knit = "knit = { chart = \"\"\"\nkpkpkp\npkpkpk\nkkkppp\"\"\", repeat = [8, 8], wales_per_cm = 8.0, \
        courses_per_cm = 10.0 }\nyarns.a.diameter_mm = 0.3\n";
    for text in [&woven(60, true), knit] {
        let (design, mut cloth) = (read(text), null_mut());
        // SAFETY: all pointers are those of values that live as long as the call.
        let ended = cancelled(|run| unsafe { texere_cloth_rest(design, device.0, run, &mut cloth) });
        assert_eq!(ended, TEXERE_CANCELLED, "{}", message());
        assert!(cloth.is_null());
    }
}

#[test]
fn a_run_that_another_thread_cancels_ends_a_mesh() {
    let (device, yarns) = (device(), placed(&woven(400, false)));
    let settings = texere_settings { subdivisions: 3, sides: 12, caps: 1, quantum_mm: 1.0, ..sized() };
    let (mut plan, mut counts) = (null_mut(), sized::<texere_counts>());
    // SAFETY: all pointers are those of values that live as long as the calls.
    unsafe {
        assert_eq!(texere_plan_new(yarns.0, device.0, &settings, &mut plan), TEXERE_OK, "{}", message());
        assert_eq!(texere_plan_counts(plan, &mut counts), TEXERE_OK);
        let vertex = texere_vertex { position: [0.0; 3], normal: [0.0; 3] };
        let (mut vertices, mut indices) =
            (vec![vertex; counts.vertices as usize], vec![0; counts.indices as usize]);
        let (points, numbers) = (vertices.as_mut_ptr(), indices.as_mut_ptr());
        let ended =
            cancelled(|run| texere_plan_mesh(plan, run, points, counts.vertices, numbers, counts.indices));
        assert_eq!(ended, TEXERE_CANCELLED, "{}", message());
    }
}

#[test]
fn a_run_that_another_thread_cancels_ends_a_picture() {
    let yarns = placed(&woven(100, false));
    let (mut renderer, mut picture) = (null_mut(), sized());
    let mut pixels = vec![0_u8; 4 * 640 * 480];
    let view = texere_view { data: pixels.as_mut_ptr().cast(), size: pixels.len() as u64, stride: 4 * 640 };
    // SAFETY: all pointers are those of values that live as long as the calls.
    unsafe {
        assert_eq!(texere_renderer_open(null(), 0, &mut renderer), TEXERE_OK, "{}", message());
        assert_eq!(texere_renderer_show(renderer, yarns.0, null(), null()), TEXERE_OK, "{}", message());
        assert_eq!(texere_picture_default(&mut picture), TEXERE_OK);
        let picture = texere_picture { width: 640, height: 480, ..picture };
        let ended = cancelled(|run| texere_renderer_picture(renderer, &picture, run, &view));
        assert_eq!(ended, TEXERE_CANCELLED, "{}", message());
        assert!(pixels.iter().all(|byte| *byte == 0));
    }
}
