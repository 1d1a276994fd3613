//! Pictures and drafts from C have the same bits as those from Rust. Pictures need a Vulkan device.
//! The software renderer lavapipe is enough.

#![allow(clippy::unwrap_used, reason = "a test ends at what it did not expect")]

mod common;
#[path = "common/reading.rs"]
mod reading;

use std::fs;
use std::path::Path;
use std::ptr::{null, null_mut};

use texere::picture::{Background, Camera, Cut, Extent, Picture, Pose, Quality, Scene, picture_sides};
use texere::{Cloth, Settings};
use texere_c::texere_status::*;
use texere_c::*;

use common::{message, sized};
use reading::read;

const DESIGN: &str = "weave = { notation = \"2/1\", ends = 6, picks = 6 }\nfinish.settle = false\n\
    yarns.a.diameter_mm = 0.3\nyarns.a.color = \"#a03010\"\nyarns.a.twist_per_m = 300.0\n\
    warp = { yarns = [\"a\"], spacing_mm = 0.5 }\nweft = { yarns = [\"a\"], spacing_mm = 0.5 }\n";

fn cloth(text: &str) -> Cloth {
    let missing = |_: &Path| Err(std::io::ErrorKind::NotFound.into());
    texere::read_from("text.toml", text.as_bytes(), missing).unwrap().placed(0.0).unwrap()
}

/// A renderer that shows the test's cloth.
fn renderer() -> *mut texere_renderer {
    let (mut cloth, mut yarns, mut renderer) = (null_mut(), null_mut(), null_mut());
    // SAFETY: all pointers are those of values that live as long as the calls.
    unsafe {
        assert_eq!(texere_cloth_placed(read(DESIGN), &mut cloth), TEXERE_OK);
        assert_eq!(texere_cloth_yarns(cloth, &mut yarns), TEXERE_OK);
        assert_eq!(texere_renderer_open(null(), 0, &mut renderer), TEXERE_OK, "{}", message());
        assert_eq!(texere_renderer_show(renderer, yarns, null(), null()), TEXERE_OK, "{}", message());
        texere_yarns_free(yarns);
        texere_cloth_free(cloth);
    }
    renderer
}

/// The scene that Rust makes of `cloth`, with the settings for a picture of woven cloth.
fn scene(cloth: &Cloth) -> Scene {
    let yarns = cloth.yarns();
    let settings = Settings { sides: picture_sides(yarns, true), ..Settings::default() };
    let renderer = texere::picture::open_renderer("auto").unwrap();
    renderer.scene(yarns, &settings.following_fibres(yarns)).unwrap()
}

fn usual() -> texere_picture {
    let mut picture = sized();
    // SAFETY: the place lives as long as the call.
    assert_eq!(unsafe { texere_picture_default(&mut picture) }, TEXERE_OK);
    texere_picture { width: 60, height: 40, ..picture }
}

/// The pixels of a picture from C, in rows of `stride` bytes.
fn drawn(renderer: *const texere_renderer, picture: &texere_picture, stride: usize) -> Vec<u8> {
    let mut pixels = vec![77; stride * picture.height as usize];
    let view =
        texere_view { data: pixels.as_mut_ptr().cast(), size: pixels.len() as u64, stride: stride as u64 };
    // SAFETY: the view is that of `pixels`.
    let made = unsafe { texere_renderer_picture(renderer, picture, null(), &view) };
    assert_eq!(made, TEXERE_OK, "{}", message());
    pixels
}

#[test]
fn pictures_of_every_view_are_those_of_rust() {
    let (renderer, cloth, usual) = (renderer(), cloth(DESIGN), usual());
    assert_eq!(usual.field_of_view, Camera::FIELD_OF_VIEW);
    let mut scene = scene(&cloth);
    let (extent, size) = (*scene.extent(), [60, 40]);
    let pose = Pose { eye: [1.5, -4.0, 5.0], target: [1.5, 1.5, 0.0], up: [0.0, 0.0, 1.0] };
    let posed = texere_picture { eye: pose.eye, target: pose.target, up: pose.up, ..usual };
    let at = [1.25, 1.75];
    let placed = texere_picture { at, width_mm: 1.5, ..usual };
    let nothing = TEXERE_BACKGROUND_NOTHING;
    let colored = texere_picture { background: TEXERE_BACKGROUND_COLOR, color: [9, 200, 30], ..usual };
    let views: [(texere_picture, Camera, Quality, Background); 8] = [
        (usual, Camera::face(&extent, size), Quality::default(), Background::Ground),
        (
            texere_picture { turned_over: 1, background: nothing, ..usual },
            Camera::face(&extent, size).turned_over(),
            Quality::default(),
            Background::Nothing,
        ),
        (
            texere_picture { view: TEXERE_VIEW_OBLIQUE, turn: 0.4, ..colored },
            Camera::oblique(&extent, 0.4, size).unwrap(),
            Quality::default(),
            Background::Color([9, 200, 30]),
        ),
        (
            texere_picture { view: TEXERE_VIEW_CLOSE_UP, hairs: 0, ..placed },
            Camera::close_up(&extent, at, 1.5, size).unwrap(),
            Quality { hairs: false, ..Quality::default() },
            Background::Ground,
        ),
        (
            texere_picture { view: TEXERE_VIEW_CUT_WARP, supersampling: 1, ..placed },
            Camera::cut(&extent, Cut::Warp, at, 1.5, size).unwrap(),
            Quality { supersampling: 1, ..Quality::default() },
            Background::Ground,
        ),
        (
            texere_picture { view: TEXERE_VIEW_CUT_WEFT, ..placed },
            Camera::cut(&extent, Cut::Weft, at, 1.5, size).unwrap(),
            Quality::default(),
            Background::Ground,
        ),
        (
            texere_picture { view: TEXERE_VIEW_EYE, field_of_view: 0.6, ..posed },
            Camera::perspective(&extent, &pose, 0.6, size).unwrap(),
            Quality::default(),
            Background::Ground,
        ),
        (
            texere_picture { view: TEXERE_VIEW_PARALLEL, height_mm: 4.0, ..posed },
            Camera::orthographic(&extent, &pose, 4.0, size).unwrap(),
            Quality::default(),
            Background::Ground,
        ),
    ];
    let mut seen = Vec::new();
    for (number, (asked, camera, quality, background)) in views.iter().enumerate() {
        scene.set_background(*background);
        let own = scene.picture(camera, *quality).unwrap();
        let pixels = drawn(renderer, asked, 251);
        for (row, own) in pixels.chunks(251).zip(own.rgba().chunks(240)) {
            assert!(row[..240] == *own, "view {number}");
            assert_eq!(row[240..], [77; 11], "view {number}");
        }
        same_file(renderer, asked, &own, number);
        seen.push(own.rgb);
    }
    assert!(seen.windows(2).all(|pair| pair[0] != pair[1]));
    // SAFETY: the handle is one of the library's.
    unsafe { texere_renderer_free(renderer) };
}

/// Makes sure that the file from C has the bytes of the file from Rust.
fn same_file(renderer: *const texere_renderer, asked: &texere_picture, own: &Picture, number: usize) {
    let folder = tempfile::tempdir().unwrap();
    let [c, rust] = ["c.png", "rust.png"].map(|name| folder.path().join(name));
    let path = c.to_str().unwrap();
    // SAFETY: the path lives as long as the call.
    let written = unsafe { texere_renderer_write(renderer, asked, null(), path.as_ptr().cast(), path.len()) };
    assert_eq!(written, TEXERE_OK, "{}", message());
    let pixels = if asked.background == TEXERE_BACKGROUND_NOTHING { own.rgba() } else { own.rgb.clone() };
    texere::write::picture(own.size, &pixels, &rust).unwrap();
    assert!(fs::read(c).unwrap() == fs::read(rust).unwrap(), "view {number}");
}

#[test]
fn a_point_of_a_picture_shows_the_yarn_that_rust_sees() {
    let (renderer, cloth, asked) = (renderer(), cloth(DESIGN), usual());
    let mut scene = scene(&cloth);
    let mut extent = texere_extent::default();
    let mut seen = texere_seen { is_yarn: 7, ..texere_seen::default() };
    // SAFETY: all pointers are those of values that live as long as the calls.
    unsafe {
        assert_eq!(texere_renderer_extent(renderer, &mut extent), TEXERE_OK);
        let own = Extent::of(cloth.yarns());
        assert_eq!(extent, texere_extent { low: own.low, high: own.high });
        assert_eq!(texere_renderer_seen(renderer, 30.0, 20.0, &mut seen), TEXERE_OK);
        assert_eq!(seen.is_yarn, 0, "there is no picture yet");
        drawn(renderer, &asked, 240);
        scene.picture(&Camera::face(scene.extent(), [60, 40]), Quality::default()).unwrap();
        let mut yarns = 0;
        for (x, y) in (0..60).flat_map(|x| (0..40).map(move |y| (x as f32 + 0.5, y as f32 + 0.5))) {
            assert_eq!(texere_renderer_seen(renderer, x, y, &mut seen), TEXERE_OK);
            let own = scene.seen_at([x, y]).unwrap();
            let found = (seen.is_yarn == 1).then_some((seen.yarn as usize, seen.position));
            assert_eq!(found, own.map(|own| (own.yarn, own.position)), "{x}, {y}");
            yarns += seen.is_yarn;
        }
        assert!((500..2400).contains(&yarns), "{yarns} of 2400 pixels show a yarn");
        texere_renderer_free(renderer);
    }
}

#[test]
fn a_cancelled_run_ends_a_picture_and_leaves_memory_and_file_alone() {
    let (renderer, asked) = (renderer(), usual());
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("none.png");
    let text = path.to_str().unwrap();
    let (mut run, mut pixels) = (null_mut(), vec![77_u8; 9600]);
    let view = texere_view { data: pixels.as_mut_ptr().cast(), size: 9600, stride: 240 };
    let mut seen = texere_seen::default();
    // SAFETY: all pointers are those of values that live as long as the calls.
    unsafe {
        assert_eq!(texere_run_new(&mut run), TEXERE_OK);
        assert_eq!(texere_run_cancel(run), TEXERE_OK);
        assert_eq!(texere_renderer_picture(renderer, &asked, run, &view), TEXERE_CANCELLED, "{}", message());
        let written = texere_renderer_write(renderer, &asked, run, text.as_ptr().cast(), text.len());
        assert_eq!(written, TEXERE_CANCELLED);
        assert!(!path.exists() && pixels.iter().all(|byte| *byte == 77));
        assert_eq!(texere_renderer_seen(renderer, 30.0, 20.0, &mut seen), TEXERE_OK);
        assert_eq!(seen.is_yarn, 0);
    }
    // The renderer makes pictures as before.
    let whole = drawn(renderer, &asked, 240);
    assert!(
        whole.chunks(4).all(|pixel| pixel[3] == 255)
            && whole != drawn(renderer, &texere_picture { turned_over: 1, ..asked }, 240)
    );
}

#[test]
fn drafts_of_every_structure_are_those_of_rust() {
    let knit = "knit = { chart = \"kp\\npk\", repeat = [4, 4], wales_per_cm = 8.0, courses_per_cm = 10.0 }\n\
        finish.settle = false\nyarns.a.diameter_mm = 0.3\n";
    let warp = "warp_knit = { wales = 4, courses = 4, wales_per_cm = 8.0, courses_per_cm = 10.0, \
        bars = [{ lapping = \"1-0/1-2//\" }] }\nfinish.settle = false\nyarns.a.diameter_mm = 0.3\n";
    let folder = tempfile::tempdir().unwrap();
    let [c, rust] = ["c.png", "rust.png"].map(|name| folder.path().join(name));
    let path = c.to_str().unwrap();
    for text in [DESIGN, knit, warp] {
        for (back, side) in [(0, texere::write::Side::Face), (1, texere::write::Side::Back)] {
            // SAFETY: the path lives as long as the call.
            let drawn = unsafe { texere_design_draft(read(text), back, path.as_ptr().cast(), path.len()) };
            assert_eq!(drawn, TEXERE_OK, "{}", message());
            let cloth = cloth(text);
            let structure = &cloth.design().structure;
            match (structure.woven(), structure.knitted(), structure.warp_knitted()) {
                (Some(woven), ..) => texere::write::draft(woven.cloth(), woven.draft(), side, &rust),
                (_, Some(knit), _) => texere::write::knit_draft(knit, side, &rust),
                (.., knit) => texere::write::warp_draft(knit.unwrap(), side, &rust),
            }
            .unwrap();
            assert!(fs::read(&c).unwrap() == fs::read(&rust).unwrap());
        }
    }
}
