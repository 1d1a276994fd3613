//! An operation for each function of the library: a call with random arguments.

/// Makes operations of a list of names, weights and calls.
macro_rules! table {
    ($($name:ident, $weight:literal, |$caller:tt| $call:expr;)*) => {
        vec![$(Operation {
            name: stringify!($name),
            weight: $weight,
            fails: true,
            on_gpu: false,
            call: |$caller: &mut Caller<'_>| {
                // SAFETY: pointers are those of values that live as long as the call, or null;
                // handles are looked up.
                #[allow(unused_unsafe, reason = "some calls are safe")]
                unsafe { $call }
            },
        }),*]
    };
}

mod checks;
mod files;
mod live;
mod outputs;
mod pictures;
mod structures;

use std::ffi::c_void;
use std::ptr::{null, null_mut};

use texere_c::texere_status::TEXERE_OK;
use texere_c::*;

use crate::caller::Caller;
use crate::common::sized;

/// A call of one function.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Operation {
    pub(crate) name: &'static str,
    /// How often it is called, relative to the other operations.
    pub(crate) weight: usize,
    /// Whether the function can fail.
    pub(crate) fails: bool,
    /// Whether the function needs a GPU. Only the sequences of the trial `gpu` call such functions.
    pub(crate) on_gpu: bool,
    pub(crate) call: fn(&mut Caller<'_>) -> texere_status,
}

/// Four texts: woven cloth that does not settle and has a warning, because its threads are jammed;
/// a knit; woven cloth that settles; and an invalid design.
pub(crate) const DESIGNS: [&str; 4] = [
    "weave = { notation = \"plain\", ends = 3, picks = 2 }\nfinish.settle = false\n\
     yarns.a.diameter_mm = 0.2\nwarp = { yarns = [\"a\"], spacing_mm = 0.3 }\n\
     weft = { yarns = [\"a\"], spacing_mm = 0.3 }\n",
    "knit = { chart = \"kp\", wales_per_cm = 8.0, courses_per_cm = 10.0 }\nfinish.settle = false\n\
     yarns.a.diameter_mm = 0.3\n",
    "weave = { notation = \"plain\", ends = 2, picks = 2 }\nyarns.a.diameter_mm = 0.2\n\
     warp = { yarns = [\"a\"], spacing_mm = 0.5 }\nweft = { yarns = [\"a\"], spacing_mm = 0.5 }\n",
    "weave = { notation = \"plain\", ends = 2, picks = -2 }\n",
];

/// Names of files in the test's folder. Some operations write these files, and others read them.
const FILES: [&str; 10] =
    ["a.toml", "a.wif", "a.k", "a.yarns", "a.usda", "a.ply", "a.glb", "a.png", "none", "folder/a.toml"];

/// Reads a design from memory.
pub(crate) unsafe fn read(text: &str, out: *mut *mut texere_design) -> texere_status {
    let name = "text.toml";
    // SAFETY: name and text live as long as the call; the caller vouches for `out`.
    unsafe {
        texere_design_read_memory(
            name.as_ptr().cast(),
            name.len(),
            text.as_ptr(),
            text.len(),
            None,
            null_mut(),
            out,
        )
    }
}

/// All operations.
pub(crate) fn operations() -> Vec<Operation> {
    let mut all = [
        designs(),
        structures::operations(),
        cloths(),
        yarns(),
        plans(),
        files::operations(),
        outputs::operations(),
        live::operations(),
        checks::operations(),
        plain(),
    ]
    .concat();
    let on_gpu = [pictures::operations(), outputs::sessions()].concat();
    let on_gpu = on_gpu.into_iter().map(|operation| Operation { on_gpu: true, ..operation });
    all.extend(on_gpu);
    all.extend(frees());
    all
}

fn plain() -> Vec<Operation> {
    let can_not = table! {
        texere_abi, 1, |_| {
            assert_eq!(texere_abi(), TEXERE_ABI);
            TEXERE_OK
        };
        texere_version, 1, |_| {
            assert!(!texere_version().is_null());
            TEXERE_OK
        };
        texere_error_message, 1, |_| {
            assert!(!texere_error_message().is_null());
            TEXERE_OK
        };
    };
    let can = table! {
        texere_error_place, 2, |caller| {
            let place = texere_place { file: null(), line: 0, column: 0 };
            caller.place(place, |place| texere_error_place(place))
        };
        texere_diameter, 2, |caller| {
            let [tex, density] = [20.0, 0.9].map(|usual| caller.random.number(usual));
            caller.place(0.0, |diameter| texere_diameter(tex, density, diameter))
        };
        texere_device_open, 3, |caller| {
            let name = caller.text(&["cpu", "cpu-serial"]);
            caller.out(|out| texere_device_open(name.pointer(), name.length(), out))
        };
        texere_device_describe, 3, |caller| {
            let (device, info) = (caller.handle(), caller.sized());
            caller.place(info, |info| texere_device_describe(device, info))
        };
        texere_run_new, 2, |caller| caller.out(|out| texere_run_new(out));
        texere_run_cancel, 2, |caller| texere_run_cancel(caller.handle());
        texere_run_progress, 3, |caller| {
            let run = caller.handle();
            caller.place(0.0, |share| texere_run_progress(run, share))
        };
    };
    let can_not = can_not.into_iter().map(|operation| Operation { fails: false, ..operation });
    can_not.chain(can).collect()
}

fn frees() -> Vec<Operation> {
    let frees = table! {
        texere_device_free, 1, |caller| caller.free::<texere_device>();
        texere_design_free, 2, |caller| caller.free::<texere_design>();
        texere_run_free, 3, |caller| caller.free::<texere_run>();
        texere_cloth_free, 3, |caller| caller.free::<texere_cloth>();
        texere_yarns_free, 3, |caller| caller.free::<texere_yarns>();
        texere_plan_free, 3, |caller| caller.free::<texere_plan>();
        texere_live_free, 2, |caller| caller.free::<texere_live>();
        texere_picker_free, 2, |caller| caller.free::<texere_picker>();
        texere_check_free, 2, |caller| caller.free::<texere_check>();
    };
    let on_gpu = table! {
        texere_renderer_free, 1, |caller| caller.free::<texere_renderer>();
        texere_session_free, 1, |caller| caller.free::<texere_session>();
    };
    let on_gpu = on_gpu.into_iter().map(|operation| Operation { on_gpu: true, ..operation });
    frees.into_iter().chain(on_gpu).map(|operation| Operation { fails: false, ..operation }).collect()
}

/// Gives the bytes that `user` points to, whatever file is asked for.
unsafe extern "C" fn file(
    user: *mut c_void,
    _: *const std::ffi::c_char,
    _: usize,
    data: *mut *const u8,
    size: *mut usize,
) -> i32 {
    // SAFETY: the library gives places for both; `user` is that of the call below.
    unsafe {
        let text = *user.cast::<&str>();
        (*data, *size) = (text.as_ptr(), text.len());
        i32::from(text.is_empty())
    }
}

fn designs() -> Vec<Operation> {
    table! {
        texere_design_read, 4, |caller| {
            let path = caller.path(&FILES);
            caller.out(|out| texere_design_read(path.pointer(), path.length(), out))
        };
        texere_design_read_memory, 4, |caller| {
            let name = caller.text(&["a.toml", "a.wif", "a.k", "a"]);
            let mut text = caller.random.pick(&[&DESIGNS[..], &["weave.wif = \"b.wif\"\n", "", "[a"]].concat());
            let (data, size) = (text.as_ptr(), text.len());
            let size = if caller.random.one_in(8) { caller.random.below(size + 1) } else { size };
            let callback: texere_file_callback = if caller.random.one_in(2) { Some(file) } else { None };
            let user = (&raw mut text).cast();
            caller.out(|out| {
                texere_design_read_memory(name.pointer(), name.length(), data, size, callback, user, out)
            })
        };
        texere_design_write, 2, |caller| {
            let (design, path) = (caller.handle(), caller.path(&FILES));
            texere_design_write(design, path.pointer(), path.length())
        };
        texere_design_draft, 1, |caller| {
            let (design, path) = (caller.handle(), caller.path(&FILES));
            texere_design_draft(design, caller.random.choice(2), path.pointer(), path.length())
        };
        texere_design_finish, 3, |caller| {
            let (design, finish) = (caller.handle(), caller.sized());
            caller.place(finish, |finish| texere_design_finish(design, finish))
        };
        texere_design_finished, 3, |caller| {
            let random = |caller: &mut Caller<'_>, usual| caller.random.number(usual) as f32;
            let finish = texere_finish {
                settle: caller.random.choice(2),
                length_kind: caller.random.pick(&[0, 0, 0, 1, 2, 3, 4]),
                length: random(caller, 1.0),
                press_mm: if caller.random.one_in(4) { random(caller, 0.5) } else { 0.0 },
                warp_tension: random(caller, 1.0),
                weft_tension: random(caller, 1.0),
                calender: random(caller, 1.0),
                stretch: caller.random.pick(&[0, 0, 0, 1, 2, 3]),
                passes: caller.random.choice(20),
                stretch_by: caller.random.number(1.0),
                ..caller.sized()
            };
            let design = caller.handle();
            caller.out(|out| texere_design_finished(design, &finish, out))
        };
    }
}

fn cloths() -> Vec<Operation> {
    table! {
        texere_cloth_rest, 1, |caller| {
            let (design, device, run) = (caller.handle(), caller.handle(), caller.handle_or_null());
            caller.out(|out| texere_cloth_rest(design, device, run, out))
        };
        texere_cloth_placed, 5, |caller| {
            let design = caller.handle();
            caller.out(|out| texere_cloth_placed(design, out))
        };
        texere_cloth_report, 4, |caller| {
            let (cloth, report) = (caller.handle(), caller.sized());
            caller.place(report, |report| texere_cloth_report(cloth, report))
        };
        texere_cloth_warning, 2, |caller| {
            let (cloth, number) = (caller.handle(), caller.random.pick(&[0, 0, 1, u64::MAX]));
            caller.place(null(), |words| texere_cloth_warning(cloth, number, words))
        };
        texere_cloth_yarns, 5, |caller| {
            let cloth = caller.handle();
            caller.out(|out| texere_cloth_yarns(cloth, out))
        };
    }
}

fn yarns() -> Vec<Operation> {
    table! {
        texere_yarns_new, 4, |caller| {
            let points: Vec<_> = (0..8)
                .map(|number| {
                    let mut near = |usual: f64| caller.random.number(usual) as f32;
                    let (x, y, z) = (near(f64::from(number) + 1.0), near(1.0), near(0.2));
                    texere_point { x, y, z, half_width: near(0.1), half_height: near(0.1) }
                })
                .collect();
            let offsets = [0, caller.random.pick(&[2, 4, 4, 4, 9]), 8];
            let (closed, twist) = ([0, caller.random.below(2) as u8], [0.0, caller.random.number(1.0) as f32]);
            let arrays = texere_yarn_arrays {
                tension: caller.random.pick(&[0.0, 0.0, 0.5, 1.0, f32::NAN]),
                yarns: caller.random.pick(&[2, 2, 2, 1, 0, u64::MAX]),
                offsets: offsets.as_ptr(),
                points: points.as_ptr(),
                closed: if caller.random.one_in(2) { null() } else { closed.as_ptr() },
                twist: if caller.random.one_in(2) { null() } else { twist.as_ptr() },
                ..caller.sized()
            };
            // A call with these offsets would read past the end of `points`, which is not allowed.
            if offsets[1] > 8 && arrays.yarns == 1 {
                return caller.out(|out| texere_yarns_new(null(), out));
            }
            caller.out(|out| texere_yarns_new(&arrays, out))
        };
        texere_yarns_read, 2, |caller| {
            let path = caller.path(&FILES);
            caller.out(|out| texere_yarns_read(path.pointer(), path.length(), out))
        };
        texere_yarns_read_curves, 2, |caller| {
            let (path, lengths) = (caller.path(&FILES), [0, 1].map(|_| caller.random.pick(&[0.0, 1.0, -1.0, 0.2])));
            caller.out(|out| {
                texere_yarns_read_curves(path.pointer(), path.length(), lengths[0], lengths[1], out)
            })
        };
        texere_yarns_write, 1, |caller| {
            let (yarns, path) = (caller.handle(), caller.path(&FILES));
            texere_yarns_write(yarns, path.pointer(), path.length())
        };
        texere_yarns_counts, 4, |caller| {
            let (yarns, counts) = (caller.handle(), caller.sized());
            caller.place(counts, |counts| texere_yarns_counts(yarns, counts))
        };
        texere_yarns_points, 4, |caller| {
            let yarns = caller.handle();
            let mut counts: texere_yarn_counts = sized();
            let is_there = texere_yarns_counts(yarns, &mut counts) == TEXERE_OK;
            let mut offsets = vec![0; counts.yarns as usize + 1];
            let mut points = vec![texere_point::default(); counts.points as usize];
            let offset_count = caller.count(if is_there { counts.yarns + 1 } else { 0 });
            let point_count = caller.count(counts.points);
            texere_yarns_points(yarns, offsets.as_mut_ptr(), offset_count, points.as_mut_ptr(), point_count)
        };
        texere_settings_default, 4, |caller| {
            let (yarns, settings) = (caller.handle(), caller.sized());
            caller.place(settings, |settings| texere_settings_default(yarns, settings))
        };
    }
}

/// Settings of a mesh.
fn settings(caller: &mut Caller<'_>) -> texere_settings {
    texere_settings {
        subdivisions: caller.random.pick(&[0, 1, 3, u32::MAX]),
        sides: caller.random.pick(&[3, 6, 8, 2, u32::MAX]),
        frame: caller.random.choice(2),
        topology: caller.random.choice(3),
        caps: caller.random.choice(2),
        quantum_mm: caller.random.pick(&[1.0, 0.25, 0.25, 0.25, 0.3]),
        ..caller.sized()
    }
}

fn plans() -> Vec<Operation> {
    table! {
        texere_plan_new, 5, |caller| {
            let (yarns, device) = (caller.handle(), caller.handle());
            if caller.random.one_in(2) {
                return caller.out(|out| texere_plan_new(yarns, device, null(), out));
            }
            let settings = settings(caller);
            caller.out(|out| texere_plan_new(yarns, device, &settings, out))
        };
        texere_plan_counts, 4, |caller| {
            let (plan, counts) = (caller.handle(), caller.sized());
            caller.place(counts, |counts| texere_plan_counts(plan, counts))
        };
        texere_plan_draws, 3, |caller| {
            let plan = caller.handle();
            caller.place(null(), |draws| texere_plan_draws(plan, draws))
        };
        texere_plan_mesh, 4, |caller| {
            let (plan, run) = (caller.handle(), caller.handle_or_null());
            let mut counts: texere_counts = sized();
            texere_plan_counts(plan, &mut counts);
            let vertex = texere_vertex { position: [0.0; 3], normal: [0.0; 3] };
            let (mut vertices, mut indices) =
                (vec![vertex; counts.vertices as usize], vec![0; counts.indices as usize]);
            let (vertex_count, index_count) = (caller.count(counts.vertices), caller.count(counts.indices));
            texere_plan_mesh(plan, run, vertices.as_mut_ptr(), vertex_count, indices.as_mut_ptr(), index_count)
        };
        texere_plan_write, 1, |caller| {
            let (plan, run, path) = (caller.handle(), caller.handle_or_null(), caller.path(&FILES));
            texere_plan_write(plan, run, path.pointer(), path.length())
        };
    }
}
