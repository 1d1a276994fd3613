//! Live cloth that is edited from C has the same mesh as one that is edited from Rust, on every
//! device.

#![allow(clippy::unwrap_used, reason = "a test ends at what it did not expect")]

mod attributes;
#[path = "../common/calls.rs"]
mod calls;
#[path = "../common/mod.rs"]
mod common;
mod picking;
mod read;
#[path = "../common/reading.rs"]
mod reading;

use std::ptr::{null, null_mut};
use std::sync::atomic::{AtomicBool, Ordering};

use calls::{devices, done, made, opened, rust_design};
use common::{message, sized};
use read::{Mesh, drawn, follow, points, read, rust_drawn, update, yarn_points};
use reading::read as design;
use texere::yarn::Material;
use texere::{ControlPoint, Design, Live, Settings, Yarn};
use texere_c::texere_status::*;
use texere_c::*;

const ENDS: u64 = 12;
const PICKS: u64 = 8;

const TWILL: &str = "weave = { notation = \"2/2\", ends = 12, picks = 8 }\nfinish.settle = false\n\
    yarns.a.diameter_mm = 0.2\nyarns.b = { diameter_mm = 0.2, tex = 20 }\n\
    warp = { yarns = [\"a\"], spacing_mm = 0.5 }\nweft = { yarns = [\"a\", \"b\"], spacing_mm = 0.5 }\n";

/// Jersey with a tuck and a miss.
const TUCKED: &str = "knit = { chart = \"kkkkk\\nktkmk\\nkkkkk\", repeat = [1, 2], loop_length_mm = 3.2 }\n\
    finish.settle = false\nyarns.a.diameter_mm = 0.2\n";

fn settings() -> texere_settings {
    texere_settings { subdivisions: 1, sides: 6, caps: 1, quantum_mm: 1.0, ..sized() }
}

fn own_settings() -> Settings {
    Settings { caps: true, ..Settings::default() }
}

/// Two live cloths of a design with its yarns as placed: one made from C, and one from Rust. Also
/// returns the design as Rust reads it.
fn live_cloth(text: &str, device: &str) -> (*mut texere_live, Live, Design) {
    let (handle, own, (device, backend)) = (design(text), rust_design(text), opened(device));
    // SAFETY: all pointers are those of values that live as long as the calls.
    let live = unsafe {
        let cloth = made(|out| texere_cloth_placed(handle, out));
        let live = made(|out| texere_live_of_cloth(cloth, device, &settings(), out));
        // A live cloth stays valid when its cloth, its device and the design are freed.
        texere_cloth_free(cloth);
        texere_device_free(device);
        texere_design_free(handle);
        live
    };
    let rust = Live::new(backend, &own.structure, own_settings()).unwrap();
    (live, rust, own)
}

/// An edit from C, and the same edit from Rust.
type Edit = (&'static str, fn(*const texere_live) -> texere_status, fn(&mut Live));

const NONE: texere_material =
    texere_material { name: null(), name_length: 0, tex: 0.0, hairiness: 0.0, srgb: [0; 3], reserved: 0 };

/// `count` control points of a yarn that goes up and down.
fn bow(count: usize) -> Vec<ControlPoint> {
    (0..count).map(|at| ControlPoint::new(at as f32 * 0.1, 1.1, (at % 3) as f32 * 0.2, 0.15)).collect()
}

const BLOCK: [u8; 12] = [1, 0, 0, 1, 1, 1, 0, 0, 1, 0, 1, 1];

/// A call from C.
macro_rules! c {
    ($call:expr) => {{
        // SAFETY: all pointers are those of values that live as long as the call.
        unsafe { $call }
    }};
}
use c;

/// The edits of woven cloth, in the order in which the test makes them.
const EDITS: [Edit; 8] = [
    ("a lift", |live| c!(texere_live_set_lift(live, 7, 3, 0)), |live| live.set_lift(7, 3, false).unwrap()),
    (
        "lifts of 3 ends and 4 picks",
        |live| c!(texere_live_set_drawdown(live, 2, 3, 1, 4, BLOCK.as_ptr())),
        |live| live.set_drawdown(2..5, 1..5, |end, pick| BLOCK[(pick - 1) * 3 + end - 2] == 1).unwrap(),
    ),
    (
        "a yarn",
        |live| {
            let what = texere_yarn { material: 1, twist: 0.7, ..sized() };
            let points = points(&bow(20));
            c!(texere_live_set_yarn(live, 5, &what, points.as_ptr(), points.len()))
        },
        |live| {
            let before = live.mesh().plan().layout().yarns()[5];
            live.set_yarn(5, Yarn { material: 1, twist: 0.7, ..before }, &bow(20)).unwrap();
        },
    ),
    (
        "points that a yarn has no room for",
        |live| {
            let points = points(&bow(300));
            c!(texere_live_set_points(live, 14, points.as_ptr(), points.len()))
        },
        |live| live.set_points(14, &bow(300)).unwrap(),
    ),
    (
        "fewer points",
        |live| {
            let points = points(&bow(4));
            c!(texere_live_set_points(live, 14, points.as_ptr(), points.len()))
        },
        |live| live.set_points(14, &bow(4)).unwrap(),
    ),
    (
        "a material",
        |live| {
            let name = c"silk".as_ptr();
            let material =
                texere_material { name, name_length: 4, tex: 8.0, hairiness: 2.0, srgb: [1, 2, 3], ..NONE };
            c!(texere_live_set_material(live, 1, &material))
        },
        |live| {
            let silk = Material {
                name: "silk".into(),
                srgb: [1, 2, 3],
                tex: Some(8.0),
                hairiness: 2.0,
                bending: None,
            };
            live.set_material(1, silk).unwrap();
        },
    ),
    (
        "the tension of splines",
        |live| c!(texere_live_set_tension(live, 0.3)),
        |live| live.set_tension(0.3).unwrap(),
    ),
    (
        "a lift again",
        |live| c!(texere_live_set_lift(live, 7, 3, 1)),
        |live| live.set_lift(7, 3, true).unwrap(),
    ),
];

/// How many vertices and indices Rust's update makes again.
fn changed(live: &mut Live) -> ([u64; 2], bool) {
    let update = live.update().unwrap();
    let mesh = live.mesh();
    let [sides, mut vertices, mut indices] = [u64::from(mesh.plan().settings().sides), 0, 0];
    for change in &update.changes {
        let caps = change.caps.len() as u64;
        vertices += change.vertices.len() as u64 + caps * sides;
        indices += change.indices.len() as u64 + caps * (sides - 2) * 3;
    }
    ([vertices, indices], update.anew)
}

#[test]
fn edits_make_the_mesh_that_they_make_from_rust() {
    for device in devices() {
        let (live, mut rust, _) = live_cloth(TWILL, device);
        let (mut whole, mut followed) = (Mesh::default(), Mesh::default());
        let unedited: Edit = ("none", |_| TEXERE_OK, |_| ());
        for (what, edit, same) in [unedited].into_iter().chain(EDITS) {
            done(edit(live));
            same(&mut rust);
            let ((changes, anew), (wanted, wanted_anew)) = (update(live), changed(&mut rust));
            let vertices: u64 = changes.iter().map(|change| change.vertex_count).sum();
            let indices: u64 = changes.iter().map(|change| change.index_count).sum();
            assert_eq!(([vertices, indices], anew), (wanted, wanted_anew), "{what} on {device}");
            read(live, &mut whole);
            assert!(drawn(live, &whole) == rust_drawn(&mut rust), "{what} on {device}");
            follow(live, &changes, &mut followed);
            assert!(
                drawn(live, &followed) == drawn(live, &whole),
                "{what} on {device}: what changed is not all"
            );
            let now = made(|out| c!(texere_live_yarns(live, out)));
            assert_eq!(yarn_points(now), points(rust.yarns().unwrap().points()), "{what} on {device}");
        }
        // SAFETY: the library looks handles up.
        unsafe { texere_live_free(live) };
    }
}

/// An edit is undone by setting the old value: the mesh then has the same bits as before the edit.
#[test]
fn edits_that_are_set_back_give_the_first_mesh() {
    for device in devices() {
        let (live, _, _) = live_cloth(TWILL, device);
        let mut mesh = Mesh::default();
        update(live);
        read(live, &mut mesh);
        let first = drawn(live, &mesh);
        // SAFETY: all pointers are those of values that live as long as the calls.
        unsafe {
            let (mut lifts, mut yarn, mut material) = (vec![0; (ENDS * PICKS) as usize], sized(), NONE);
            for (cell, lift) in (0..).zip(&mut lifts) {
                let mut up = 9;
                done(texere_live_lift(live, cell % ENDS, cell / ENDS, &mut up));
                *lift = u8::try_from(up).unwrap();
            }
            done(texere_live_yarn(live, 14, &mut yarn));
            let own = made(|out| texere_live_yarns(live, out));
            done(texere_live_material(live, 1, &mut material));
            let name = std::slice::from_raw_parts(material.name.cast::<u8>(), material.name_length).to_vec();
            assert_eq!((&name[..], material.tex), (&b"b"[..], 20.0));
            for (what, edit, _) in EDITS {
                done(edit(live));
                update(live);
                read(live, &mut mesh);
                assert!(what == "a material" || drawn(live, &mesh) != first, "{what} on {device}");
            }
            done(texere_live_set_tension(live, 0.0));
            done(texere_live_set_rest(live, own));
            done(texere_live_set_drawdown(live, 0, ENDS, 0, PICKS, lifts.as_ptr()));
            done(texere_live_set_material(
                live,
                1,
                &texere_material { name: name.as_ptr().cast(), ..material },
            ));
            update(live);
            mesh = Mesh::default();
            read(live, &mut mesh);
            assert!(drawn(live, &mesh) == first, "on {device}");
            let (mut after, mut same): (texere_yarn, _) = (sized(), NONE);
            done(texere_live_yarn(live, 14, &mut after));
            done(texere_live_material(live, 1, &mut same));
            assert_eq!((after.material, after.twist, after.closed), (yarn.material, yarn.twist, yarn.closed));
            assert_eq!((same.srgb, same.tex, same.name_length), (material.srgb, material.tex, 1));
        }
    }
}

/// A knit with a tuck and a miss replaces a plain knit. Then a weave replaces that knit.
#[test]
fn another_structure_takes_the_place_of_the_first() {
    for device in devices() {
        let plain = TUCKED.replace("ktkmk", "kkkkk");
        let (tucked, own) = (design(TUCKED), rust_design(TUCKED));
        let (live, mut rust, _) = live_cloth(&plain, device);
        update(live);
        rust.update().unwrap();
        done(c!(texere_live_set_structure(live, tucked)));
        rust.set_structure(&own.structure).unwrap();
        let ((changes, anew), (wanted, wanted_anew)) = (update(live), changed(&mut rust));
        assert_eq!(changes.iter().map(|change| change.vertex_count).sum::<u64>(), wanted[0], "on {device}");
        assert_eq!(anew, wanted_anew, "on {device}");
        let mut mesh = Mesh::default();
        read(live, &mut mesh);
        assert!(drawn(live, &mesh) == rust_drawn(&mut rust), "on {device}");
        assert_eq!(c!(texere_live_set_lift(live, 0, 0, 1)), TEXERE_ARGUMENT, "a knit has no lifts");
        let (twill, fresh) = (design(TWILL), live_cloth(TWILL, device).0);
        done(c!(texere_live_set_structure(live, twill)));
        done(c!(texere_live_set_lift(live, 7, 3, 0)));
        done(c!(texere_live_set_lift(fresh, 7, 3, 0)));
        let mut other = mesh.clone();
        for (live, mesh) in [(live, &mut mesh), (fresh, &mut other)] {
            update(live);
            read(live, mesh);
        }
        assert!(drawn(live, &mesh) == drawn(fresh, &other), "on {device}");
    }
}

/// A live cloth has the yarns as placed, and then the yarns at rest.
#[test]
fn yarns_at_rest_take_the_place_of_those_that_are_placed() {
    let text = TWILL.replace("finish.settle = false\n", "").replace("0.5", "0.35");
    let handle = design(&text);
    for name in devices() {
        let (device, backend) = opened(name);
        // SAFETY: all pointers are those of values that live as long as the calls.
        unsafe {
            let placed = made(|out| texere_cloth_placed(handle, out));
            let rest = made(|out| texere_cloth_rest(handle, device, null(), out));
            let yarns = made(|out| texere_cloth_yarns(rest, out));
            let [live, at_rest] =
                [placed, rest].map(|cloth| made(|out| texere_live_of_cloth(cloth, device, &settings(), out)));
            let given = made(|out| texere_live_of_yarns(yarns, device, &settings(), out));
            update(live);
            done(texere_live_set_rest(live, yarns));
            let meshes = [live, at_rest, given].map(|live| {
                let mut mesh = Mesh::default();
                update(live);
                read(live, &mut mesh);
                drawn(live, &mesh)
            });
            assert!(meshes[0] == meshes[1] && meshes[1] == meshes[2], "on {name}");
            // A live cloth keeps its weave with yarns at rest. A live cloth of yarns has none.
            done(texere_live_set_lift(live, 0, 0, 0));
            assert_eq!(texere_live_set_lift(given, 0, 0, 0), TEXERE_ARGUMENT);
            assert!(message().contains("no weave"), "{}", message());
            let cloth = rust_design(&text).rest(&*backend).run().unwrap();
            assert_eq!(yarn_points(yarns), points(cloth.yarns().points()), "on {name}");
        }
    }
}

/// A call fails while another thread uses the live cloth. Afterwards the cloth works as before.
#[test]
fn a_live_cloth_that_another_thread_uses_is_refused() {
    let (live, _, _) = live_cloth(TWILL, "cpu");
    update(live);
    let (number, stop) = (live.addr(), &AtomicBool::new(false));
    let handle = move || std::ptr::without_provenance_mut::<texere_live>(number);
    std::thread::scope(|threads| {
        let other = threads.spawn(move || {
            // There are enough edits for the main thread to call during one of them on any machine.
            let mut edits = 0;
            while edits < 2_000 && !stop.load(Ordering::Relaxed) {
                match c!(texere_live_set_tension(handle(), (edits % 2) as f32 * 0.1)) {
                    TEXERE_OK => edits += 1,
                    status => assert_eq!(status, TEXERE_ARGUMENT, "{}", message()),
                }
            }
        });
        let (mut counts, mut refused): (texere_counts, _) = (sized(), false);
        while !refused && !other.is_finished() {
            refused = c!(texere_live_counts(handle(), &mut counts)) == TEXERE_ARGUMENT;
        }
        stop.store(true, Ordering::Relaxed);
        assert!(refused);
        assert_eq!(message(), "the live cloth is in use by another thread");
    });
    // SAFETY: the library looks handles up.
    unsafe {
        update(live);
        done(texere_live_set_lift(live, 0, 0, 1));
        texere_live_free(live);
        assert_eq!(texere_live_set_lift(live, 0, 0, 1), TEXERE_ARGUMENT);
        texere_live_free(null_mut());
    }
}
