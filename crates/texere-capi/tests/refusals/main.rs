//! Every function of the header refuses invalid arguments with TEXERE_ARGUMENT.

#![allow(clippy::unwrap_used, reason = "a test ends at what it did not expect")]

#[path = "../common/calls.rs"]
mod calls;
mod check;
mod cloth;
#[path = "../common/mod.rs"]
mod common;
mod growth;
mod handles;
mod live;
mod mesh;
mod outputs;
mod pictures;
#[path = "../common/reading.rs"]
mod reading;
mod structures;
mod tools;

use std::path::Path;
use std::ptr::{null, null_mut};

use calls::done;
use common::{message, sized};
use handles::{DESIGN, Handles};
use reading::read;
use texere_c::texere_status::*;
use texere_c::*;
use tools::strange;

/// Functions that can't fail.
const CANT_FAIL: [&str; 14] = [
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
    "texere_live_free",
    "texere_picker_free",
    "texere_check_free",
];

#[test]
fn every_function_refuses_what_it_can_not_take() {
    let own: &'static Handles = Box::leak(Box::new(Handles::new()));
    let cases = [
        cloth::cases(own),
        structures::cases(own),
        mesh::cases(own),
        outputs::cases(own),
        pictures::cases(own),
        live::cases(own),
        check::cases(own),
    ];
    let cases: Vec<_> = cases.into_iter().flatten().collect();
    for (number, (name, call)) in cases.iter().enumerate() {
        assert_eq!(call(), TEXERE_ARGUMENT, "{name}, case {number}: {}", message());
        assert!(!message().is_empty(), "{name}, case {number}");
    }
    // The functions of the header, to make sure that no function is missing here.
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
        // The plan keeps its yarns and its device when their handles are freed.
        let (status, vertices) = handles::mesh(own.plan, null_mut());
        assert_eq!(status, TEXERE_OK, "{}", message());
        assert!(vertices.iter().all(|vertex| vertex.normal != [0.0; 3]));
        texere_plan_free(own.plan);
        assert_eq!(texere_plan_counts(own.plan, &mut sized()), TEXERE_ARGUMENT);
        assert_eq!(texere_run_cancel(own.run), TEXERE_ARGUMENT);
        for free in [null_mut(), strange()[0]] {
            texere_plan_free(free);
        }
    }
}

/// Whether the warp is up where the first end and the first pick cross.
fn lift(live: *const texere_live) -> u32 {
    let mut up = 0;
    // SAFETY: the place lives as long as the call.
    done(unsafe { texere_live_lift(live, 0, 0, &mut up) });
    up
}

#[test]
fn a_cancelled_run_ends_rest_mesh_edits_and_file() {
    let own = Handles::new();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("none.ply");
    let text = path.to_str().unwrap();
    // SAFETY: all pointers are those of values that live as long as the calls.
    unsafe {
        assert_eq!(texere_run_cancel(own.run), TEXERE_OK);
        assert_eq!(handles::mesh(own.plan, own.run).0, TEXERE_CANCELLED, "{}", message());
        assert_eq!(handles::live_mesh(own.live, own.run), TEXERE_CANCELLED, "{}", message());
        done(texere_live_set_lift(own.live, 0, 0, 1 - lift(own.live)));
        assert_eq!(texere_live_update(own.live, own.run, &mut sized()), TEXERE_CANCELLED, "{}", message());
        let mut update: texere_update = sized();
        done(texere_live_update(own.live, null(), &mut update));
        assert!(update.change_count > 0 && update.anew == 0, "the next update makes what was left");
        assert_eq!(texere_plan_write(own.plan, own.run, text.as_ptr().cast(), text.len()), TEXERE_CANCELLED);
        assert!(!path.exists());
        let design = read(&DESIGN.replace("finish.settle = false\n", ""));
        let mut cloth = null_mut();
        let rested = texere_cloth_rest(design, own.device, own.run, &mut cloth);
        assert_eq!(rested, TEXERE_CANCELLED, "{}", message());
        assert!(cloth.is_null());
    }
}
