//! Every function of the header refuses what it can't take, with the status that says so.

#![allow(clippy::unwrap_used, reason = "a test ends at what it did not expect")]

mod common;
#[path = "refusals/outputs.rs"]
mod outputs;
#[path = "refusals/pictures.rs"]
mod pictures;
#[path = "refusals/structures.rs"]
mod structures;
#[path = "refusals/tools.rs"]
mod tools;

use std::ffi::CStr;
use std::path::Path;
use std::ptr::{null, null_mut};

use texere_c::texere_status::*;
use texere_c::*;

use common::{message, sized};
use tools::{Case, strange};

/// All handles of a small cloth on `cpu`.
struct Handles {
    device: *mut texere_device,
    design: *mut texere_design,
    run: *mut texere_run,
    cloth: *mut texere_cloth,
    yarns: *mut texere_yarns,
    plan: *mut texere_plan,
    renderer: *mut texere_renderer,
}

const DESIGN: &str = "weave = { notation = \"plain\", ends = 4, picks = 4 }\nfinish.settle = false\n\
    yarns.a.diameter_mm = 0.2\nwarp = { yarns = [\"a\"], spacing_mm = 0.5 }\n\
    weft = { yarns = [\"a\"], spacing_mm = 0.5 }\n";

impl Handles {
    fn new() -> Self {
        let mut all = Self {
            device: null_mut(),
            design: null_mut(),
            run: null_mut(),
            cloth: null_mut(),
            yarns: null_mut(),
            plan: null_mut(),
            renderer: null_mut(),
        };
        // SAFETY: all pointers are those of values that live as long as the calls.
        unsafe {
            let (name, size) = ("plain.toml", DESIGN.len());
            assert_eq!(texere_device_open(c"cpu".as_ptr(), 3, &mut all.device), TEXERE_OK);
            assert_eq!(
                texere_design_read_memory(
                    name.as_ptr().cast(),
                    name.len(),
                    DESIGN.as_ptr(),
                    size,
                    None,
                    null_mut(),
                    &mut all.design
                ),
                TEXERE_OK,
                "{}",
                message()
            );
            assert_eq!(texere_run_new(&mut all.run), TEXERE_OK);
            assert_eq!(texere_cloth_rest(all.design, all.device, all.run, &mut all.cloth), TEXERE_OK);
            assert_eq!(texere_cloth_yarns(all.cloth, &mut all.yarns), TEXERE_OK);
            assert_eq!(texere_plan_new(all.yarns, all.device, null(), &mut all.plan), TEXERE_OK);
            assert_eq!(texere_renderer_open(null(), 0, &mut all.renderer), TEXERE_OK, "{}", message());
            assert_eq!(texere_renderer_show(all.renderer, all.yarns, null(), null()), TEXERE_OK);
        }
        all
    }
}

/// Calls with one wrong argument each; everything else about them is right.
fn wrong_calls(own: &'static Handles) -> Vec<Case> {
    let mut cases: Vec<Case> = Vec::new();
    macro_rules! case {
        ($name:ident($($argument:expr),*)) => {
            // SAFETY: what is wrong is what the library says that it refuses.
            cases.push((stringify!($name), Box::new(move || unsafe { $name($($argument),*) })))
        };
    }
    let path = |text: &'static CStr| (text.as_ptr(), text.count_bytes());
    let (cpu, length) = path(c"cpu");
    let (toml, toml_length) = path(c"plain.toml");
    // A null place for the result.
    case!(texere_error_place(null_mut()));
    case!(texere_device_open(cpu, length, null_mut()));
    case!(texere_design_read(toml, toml_length, null_mut()));
    case!(texere_design_read_memory(
        toml,
        toml_length,
        DESIGN.as_ptr(),
        DESIGN.len(),
        None,
        null_mut(),
        null_mut()
    ));
    case!(texere_run_new(null_mut()));
    case!(texere_run_progress(own.run, null_mut()));
    case!(texere_cloth_rest(own.design, own.device, null(), null_mut()));
    case!(texere_cloth_placed(own.design, null_mut()));
    case!(texere_cloth_report(own.cloth, null_mut()));
    case!(texere_cloth_warning(own.cloth, 0, null_mut()));
    case!(texere_cloth_yarns(own.cloth, null_mut()));
    case!(texere_device_describe(own.device, null_mut()));
    case!(texere_settings_default(own.yarns, null_mut()));
    case!(texere_yarns_counts(own.yarns, null_mut()));
    case!(texere_yarns_new(null(), &mut null_mut()));
    case!(texere_plan_new(own.yarns, own.device, null(), null_mut()));
    case!(texere_plan_counts(own.plan, null_mut()));
    case!(texere_plan_draws(own.plan, null_mut()));
    // A null text that has a length, and one that is not UTF-8.
    for (text, length) in [(null(), 4), (b"\xff\xfe".as_ptr().cast(), 2)] {
        case!(texere_device_open(text, length, &mut null_mut()));
        case!(texere_design_read(text, length, &mut null_mut()));
        case!(texere_design_read_memory(text, length, DESIGN.as_ptr(), 4, None, null_mut(), &mut null_mut()));
        case!(texere_yarns_read(text, length, &mut null_mut()));
        case!(texere_yarns_write(own.yarns, text, length));
        case!(texere_plan_write(own.plan, null(), text, length));
    }
    case!(texere_design_read_memory(toml, toml_length, null(), 9, None, null_mut(), &mut null_mut()));
    // Handles that are null, that are none, that are of another kind.
    macro_rules! handles {
        ($kind:ty, |$handle:ident| $name:ident($($argument:expr),*)) => {
            let own_of_another_kind = if stringify!($kind) == "texere_run" { own.device.cast() } else { own.run.cast() };
            let others: [*mut $kind; 4] = [null_mut(), strange()[0], strange()[1], own_of_another_kind];
            for $handle in others {
                case!($name($($argument),*));
            }
        };
    }
    handles!(texere_run, |run| texere_run_cancel(run));
    handles!(texere_run, |run| texere_run_progress(run, &mut 0.0));
    handles!(texere_device, |device| texere_device_describe(device, &mut sized()));
    handles!(texere_design, |design| texere_cloth_rest(design, own.device, null(), &mut null_mut()));
    handles!(texere_device, |device| texere_cloth_rest(own.design, device, null(), &mut null_mut()));
    handles!(texere_design, |design| texere_cloth_placed(design, &mut null_mut()));
    handles!(texere_cloth, |cloth| texere_cloth_report(cloth, &mut sized()));
    handles!(texere_cloth, |cloth| texere_cloth_warning(cloth, 0, &mut null()));
    handles!(texere_cloth, |cloth| texere_cloth_yarns(cloth, &mut null_mut()));
    handles!(texere_yarns, |yarns| texere_settings_default(yarns, &mut sized()));
    handles!(texere_yarns, |yarns| texere_yarns_write(yarns, toml, toml_length));
    handles!(texere_yarns, |yarns| texere_yarns_counts(yarns, &mut sized()));
    handles!(texere_yarns, |yarns| texere_yarns_points(yarns, null_mut(), 0, null_mut(), 0));
    handles!(texere_yarns, |yarns| texere_plan_new(yarns, own.device, null(), &mut null_mut()));
    handles!(texere_device, |device| texere_plan_new(own.yarns, device, null(), &mut null_mut()));
    handles!(texere_plan, |plan| texere_plan_counts(plan, &mut sized()));
    handles!(texere_plan, |plan| texere_plan_draws(plan, &mut null()));
    handles!(texere_plan, |plan| texere_plan_mesh(plan, null(), null_mut(), 0, null_mut(), 0));
    handles!(texere_plan, |plan| texere_plan_write(plan, null(), toml, toml_length));
    for run in strange() {
        case!(texere_cloth_rest(own.design, own.device, run, &mut null_mut()));
        case!(texere_plan_mesh(own.plan, run, null_mut(), 0, null_mut(), 0));
        case!(texere_plan_write(own.plan, run, toml, toml_length));
    }
    // Structs of another size than the library's.
    macro_rules! sizes {
        ($kind:ty, |$given:ident| $name:ident($($argument:expr),*)) => {
            for size in [0, 4, size_of::<$kind>() as u32 - 1, size_of::<$kind>() as u32 + 1, u32::MAX] {
                // SAFETY: as above; zeros are a value of each of these structs.
                cases.push((stringify!($name), Box::new(move || unsafe {
                    let mut $given: $kind = std::mem::zeroed();
                    $given.struct_size = size;
                    $name($($argument),*)
                })));
            }
        };
    }
    sizes!(texere_device_info, |info| texere_device_describe(own.device, &mut info));
    sizes!(texere_report, |report| texere_cloth_report(own.cloth, &mut report));
    sizes!(texere_settings, |settings| texere_settings_default(own.yarns, &mut settings));
    sizes!(texere_settings, |settings| texere_plan_new(own.yarns, own.device, &settings, &mut null_mut()));
    sizes!(texere_yarn_counts, |counts| texere_yarns_counts(own.yarns, &mut counts));
    sizes!(texere_yarn_arrays, |arrays| texere_yarns_new(&arrays, &mut null_mut()));
    sizes!(texere_counts, |counts| texere_plan_counts(own.plan, &mut counts));
    // Numbers of values that are not those of the plan or of the yarns, and null arrays of the
    // right ones.
    case!(texere_yarns_points(own.yarns, &mut 0, 1, &mut texere_point::default(), 1));
    case!(texere_plan_mesh(own.plan, null(), null_mut(), 1, null_mut(), 1));
    case!(texere_cloth_warning(own.cloth, u64::MAX, &mut null()));
    cases.push((
        "texere_plan_mesh",
        Box::new(|| {
            let mut counts: texere_counts = sized();
            // SAFETY: null arrays are refused.
            unsafe {
                assert_eq!(texere_plan_counts(own.plan, &mut counts), TEXERE_OK);
                texere_plan_mesh(own.plan, null(), null_mut(), counts.vertices, null_mut(), counts.indices)
            }
        }),
    ));
    cases.extend(structures::cases(own));
    cases.extend(pictures::cases(own));
    // Settings and arrays out of range.
    for settings in [
        texere_settings { sides: 2, ..settings() },
        texere_settings { frame: 9, ..settings() },
        texere_settings { topology: 3, ..settings() },
        texere_settings { caps: 2, ..settings() },
        texere_settings { subdivisions: u32::MAX, ..settings() },
    ] {
        case!(texere_plan_new(own.yarns, own.device, &settings, &mut null_mut()));
    }
    static POINTS: [texere_point; 2] = [
        texere_point { x: 0.0, y: 0.0, z: 0.0, half_width: 0.1, half_height: 0.1 },
        texere_point { x: f32::NAN, y: 0.0, z: 0.0, half_width: 0.1, half_height: 0.1 },
    ];
    static OFFSETS: [&[u64]; 4] = [&[0, 2], &[1, 2], &[0, 2, 1], &[0, 1]];
    for offsets in OFFSETS {
        let arrays = texere_yarn_arrays {
            yarns: offsets.len() as u64 - 1,
            offsets: offsets.as_ptr(),
            points: POINTS.as_ptr(),
            ..sized()
        };
        case!(texere_yarns_new(&arrays, &mut null_mut()));
    }
    let many = texere_yarn_arrays {
        yarns: u64::MAX,
        offsets: OFFSETS[0].as_ptr(),
        points: POINTS.as_ptr(),
        ..sized()
    };
    case!(texere_yarns_new(&many, &mut null_mut()));
    cases
}

fn settings() -> texere_settings {
    texere_settings { subdivisions: 1, sides: 6, quantum_mm: 1.0, ..sized() }
}

/// Functions that can't fail.
const CANT_FAIL: [&str; 11] = [
    "texere_abi",
    "texere_version",
    "texere_error_message",
    "texere_device_free",
    "texere_design_free",
    "texere_run_free",
    "texere_session_free",
    "texere_cloth_free",
    "texere_yarns_free",
    "texere_plan_free",
    "texere_renderer_free",
];

#[test]
fn every_function_refuses_what_it_can_not_take() {
    let own: &'static Handles = Box::leak(Box::new(Handles::new()));
    let mut cases = wrong_calls(own);
    cases.extend(outputs::cases(own));
    for (number, (name, call)) in cases.iter().enumerate() {
        assert_eq!(call(), TEXERE_ARGUMENT, "{name}, case {number}: {}", message());
        assert!(!message().is_empty(), "{name}, case {number}");
    }
    // The header's list, so that none is forgotten.
    let header =
        std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("include/texere.h")).unwrap();
    let names = header.lines().filter_map(|line| {
        let (before, _) = line.split_once('(')?;
        let name = before.rsplit([' ', '*']).next()?;
        (name.starts_with("texere_") && !line.starts_with("//") && !line.contains("typedef")).then_some(name)
    });
    let mut seen = 0;
    for name in names {
        seen += 1;
        assert!(
            CANT_FAIL.contains(&name) || cases.iter().any(|(case, _)| *case == name),
            "{name} is not tried"
        );
    }
    assert!(seen > 25, "only {seen} functions were found in the header");
}

#[test]
fn what_was_freed_is_refused_and_may_be_freed_again() {
    let own = Handles::new();
    // SAFETY: the library looks handles up.
    unsafe {
        texere_yarns_free(own.run.cast()); // of another kind: left alone
        assert_eq!(texere_run_cancel(own.run), TEXERE_OK);
        for _ in 0..2 {
            texere_device_free(own.device);
            texere_design_free(own.design);
            texere_run_free(own.run);
            texere_cloth_free(own.cloth);
            texere_yarns_free(own.yarns);
            texere_renderer_free(own.renderer);
        }
        // The plan keeps what it needs.
        let mut counts: texere_counts = sized();
        assert_eq!(texere_plan_counts(own.plan, &mut counts), TEXERE_OK);
        let mut vertices =
            vec![texere_vertex { position: [0.0; 3], normal: [0.0; 3] }; counts.vertices as usize];
        let mut indices = vec![0; counts.indices as usize];
        let made = texere_plan_mesh(
            own.plan,
            null(),
            vertices.as_mut_ptr(),
            counts.vertices,
            indices.as_mut_ptr(),
            counts.indices,
        );
        assert_eq!(made, TEXERE_OK, "{}", message());
        assert!(vertices.iter().all(|vertex| vertex.normal != [0.0; 3]));
        texere_plan_free(own.plan);
        assert_eq!(texere_plan_counts(own.plan, &mut counts), TEXERE_ARGUMENT);
        assert_eq!(texere_run_cancel(own.run), TEXERE_ARGUMENT);
        for free in [null_mut(), strange()[0]] {
            texere_plan_free(free);
        }
    }
}

#[test]
fn a_cancelled_run_ends_rest_mesh_and_file() {
    let own = Handles::new();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("none.ply");
    let text = path.to_str().unwrap();
    // SAFETY: all pointers are those of values that live as long as the calls.
    unsafe {
        assert_eq!(texere_run_cancel(own.run), TEXERE_OK);
        let mut counts: texere_counts = sized();
        assert_eq!(texere_plan_counts(own.plan, &mut counts), TEXERE_OK);
        let mut vertices =
            vec![texere_vertex { position: [0.0; 3], normal: [0.0; 3] }; counts.vertices as usize];
        let mut indices = vec![0; counts.indices as usize];
        let made = texere_plan_mesh(
            own.plan,
            own.run,
            vertices.as_mut_ptr(),
            counts.vertices,
            indices.as_mut_ptr(),
            counts.indices,
        );
        assert_eq!(made, TEXERE_CANCELLED, "{}", message());
        assert_eq!(texere_plan_write(own.plan, own.run, text.as_ptr().cast(), text.len()), TEXERE_CANCELLED);
        assert!(!path.exists());
        let (mut design, settled) = (null_mut(), DESIGN.replace("finish.settle = false\n", ""));
        let name = "poplin.toml";
        let read = texere_design_read_memory(
            name.as_ptr().cast(),
            name.len(),
            settled.as_ptr(),
            settled.len(),
            None,
            null_mut(),
            &mut design,
        );
        assert_eq!(read, TEXERE_OK, "{}", message());
        let mut cloth = null_mut();
        assert_eq!(
            texere_cloth_rest(design, own.device, own.run, &mut cloth),
            TEXERE_CANCELLED,
            "{}",
            message()
        );
        assert!(cloth.is_null());
    }
}
