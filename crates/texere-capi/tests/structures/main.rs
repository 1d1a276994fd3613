//! Designs from arrays have the same yarns as designs from texts, and a refusal names the array and
//! the value.

#![allow(clippy::unwrap_used, reason = "a test ends at what it did not expect")]

mod arrays;
#[path = "../common/mod.rs"]
mod common;
mod patterns;

use std::fs;
use std::path::Path;
use std::ptr::{null, null_mut};

use texere::Design;
use texere_c::texere_status::*;
use texere_c::*;

use arrays::{STITCHES, YARNS, section, with_warp, with_weft, with_woven, woven_text};
use common::{message, sized};

fn read(text: &str) -> Design {
    texere::read_from("text.toml", text.as_bytes(), |_| Err(std::io::ErrorKind::NotFound.into())).unwrap()
}

/// The yarns of a design as a file holds them, settled or not: points, twist, sections, materials.
fn saved(design: *const texere_design, settled: bool) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("c.yarns");
    let text = path.to_str().unwrap();
    let (mut device, mut cloth, mut yarns) = (null_mut(), null_mut(), null_mut());
    // SAFETY: all pointers are those of values that live as long as the calls.
    unsafe {
        assert_eq!(texere_device_open(c"cpu".as_ptr(), 3, &mut device), TEXERE_OK);
        let made = if settled {
            texere_cloth_rest(design, device, null(), &mut cloth)
        } else {
            texere_cloth_placed(design, &mut cloth)
        };
        assert_eq!(made, TEXERE_OK, "{}", message());
        assert_eq!(texere_cloth_yarns(cloth, &mut yarns), TEXERE_OK);
        assert_eq!(texere_yarns_write(yarns, text.as_ptr().cast(), text.len()), TEXERE_OK, "{}", message());
        texere_yarns_free(yarns);
        texere_cloth_free(cloth);
        texere_device_free(device);
    }
    fs::read(path).unwrap()
}

/// The yarns of a design that Rust has read.
fn saved_by_rust(design: &Design, settled: bool) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("rust.yarns");
    let device = texere::open("cpu").unwrap();
    let cloth = match settled {
        true => design.clone().rest(&*device).run(),
        false => design.clone().placed(0.0),
    };
    texere::write::yarns(cloth.unwrap().yarns(), &path).unwrap();
    fs::read(path).unwrap()
}

fn same(design: *const texere_design, text: &Design) {
    for settled in [false, true] {
        assert!(saved(design, settled) == saved_by_rust(text, settled), "settled: {settled}");
    }
}

#[test]
fn woven_cloth_by_arrays_is_that_of_its_text() {
    let mut design = null_mut();
    let made = with_woven(
        |_| (),
        // SAFETY: the arrays live as long as the call.
        |woven| unsafe { texere_design_woven(woven, &mut design) },
    );
    assert_eq!(made, TEXERE_OK, "{}", message());
    let text = read(&woven_text());
    same(design, &text);
    // Files that C writes and Rust reads have the drawdown of the text, too.
    let folder = tempfile::tempdir().unwrap();
    for (name, settled) in [("c.toml", true), ("c.wif", false)] {
        let path = folder.path().join(name);
        let place = path.to_str().unwrap();
        // SAFETY: the path lives as long as the call.
        let written = unsafe { texere_design_write(design, place.as_ptr().cast(), place.len()) };
        assert_eq!(written, TEXERE_OK, "{}", message());
        let again = texere::read(&path).unwrap();
        assert_eq!(again.settle, settled);
        let [again, text] =
            [&again, &text].map(|design| design.structure.woven().unwrap().cloth().drawdown());
        assert_eq!(again, text);
    }
}

#[test]
fn weft_knits_by_arrays_are_those_of_their_texts() {
    let mut design = null_mut();
    let made = with_weft(
        &STITCHES,
        |_| (),
        // SAFETY: the arrays live as long as the call.
        |knit| unsafe { texere_design_weft_knit(knit, &mut design) },
    );
    assert_eq!(made, TEXERE_OK, "{}", message());
    let text = "[knit]\nchart = \"\"\"\nRRrrkp\nkkkktm\"\"\"\nrepeat = [2, 1]\nwales_per_cm = 8.0\n\
        courses_per_cm = 10.0\nyarns = [\"a\", \"2 bé\"]\n";
    same(design, &read(&format!("{text}{YARNS}")));
    // Two beds, a loop length, and the same number of control points for each stitch.
    let stitches = [
        (TEXERE_STITCH_KNIT, 0),
        (TEXERE_STITCH_BOTH, 0),
        (TEXERE_STITCH_PURL, 0),
        (TEXERE_STITCH_BACK_TUCK, 0),
    ];
    let made = with_weft(
        &stitches,
        |knit| {
            *knit = texere_weft_knit { beds: 2, cells: TEXERE_CELLS_EVEN, wales: 2, ..*knit };
            (knit.turn, knit.turn_count, knit.loop_length_mm) = (null(), 0, 4.0);
        },
        // SAFETY: as above.
        |knit| unsafe { texere_design_weft_knit(knit, &mut design) },
    );
    assert_eq!(made, TEXERE_OK, "{}", message());
    let text = "[knit]\nchart = \"\"\"\npu\nkb\"\"\"\nbeds = 2\nrepeat = [2, 1]\nwales_per_cm = 8.0\n\
        courses_per_cm = 10.0\nloop_length_mm = 4.0\ncells = \"even\"\nyarns = [\"a\"]\n";
    let text = read(&format!("{text}{YARNS}"));
    // The design from the text drops the yarn that is not knitted. Both designs have the same
    // control points.
    let (mut cloth, mut yarns, mut counts) = (null_mut(), null_mut(), sized::<texere_yarn_counts>());
    let own = text.placed(0.0).unwrap();
    let mut points = vec![texere_point::default(); own.yarns().points().len()];
    let mut offsets = vec![0; own.yarns().layout().offsets().len()];
    // SAFETY: all pointers are those of values that live as long as the calls.
    unsafe {
        assert_eq!(texere_cloth_placed(design, &mut cloth), TEXERE_OK, "{}", message());
        assert_eq!(texere_cloth_yarns(cloth, &mut yarns), TEXERE_OK);
        assert_eq!(texere_yarns_counts(yarns, &mut counts), TEXERE_OK);
        let (offset_count, point_count) = (offsets.len() as u64, points.len() as u64);
        let copied =
            texere_yarns_points(yarns, offsets.as_mut_ptr(), offset_count, points.as_mut_ptr(), point_count);
        assert_eq!(copied, TEXERE_OK, "{}", message());
    }
    assert_eq!(offsets, own.yarns().layout().offsets());
    for (point, own) in points.iter().zip(own.yarns().points()) {
        assert_eq!([point.x, point.y, point.z].map(f32::to_bits), [own.x, own.y, own.z].map(f32::to_bits));
    }
}

#[test]
fn a_warp_knit_by_arrays_is_that_of_its_text() {
    let mut design = null_mut();
    let made = with_warp(
        |_, _, _| (),
        // SAFETY: the arrays live as long as the call.
        |knit| unsafe { texere_design_warp_knit(knit, &mut design) },
    );
    assert_eq!(made, TEXERE_OK, "{}", message());
    let text = "[warp_knit]\nwales = 6\ncourses = 4\nrepeat = [1, 2]\nwales_per_cm = 8.0\n\
        courses_per_cm = 10.0\n[[warp_knit.bars]]\nlapping = \"1-0/2-3//\"\nthreading = [\"a\"]\n\
        [[warp_knit.bars]]\nlapping = \"1-2/1-0//\"\nthreading = [\"a\", \"out\", \"bé\"]\nrun_in_mm = 1500.0\n\
        offset = 1\n";
    same(design, &read(&format!("{text}{YARNS}")));
    let path = "none.wif";
    // SAFETY: the path lives as long as the call.
    let written = unsafe { texere_design_write(design, path.as_ptr().cast(), path.len()) };
    assert_eq!(written, TEXERE_UNSUPPORTED, "{}", message());
    assert!(!Path::new(path).exists());
}

#[test]
fn a_finish_is_that_of_its_text() {
    let (text, mut design) = (woven_text(), null_mut());
    let finish =
        "finish = { warp_tension = 2.0, weft_tension = 0.5, calender = 3.0, stretch_warp = 1.005 }\n";
    let made = with_woven(
        |_| (),
        // SAFETY: the arrays live as long as the call.
        |woven| unsafe { texere_design_woven(woven, &mut design) },
    );
    assert_eq!(made, TEXERE_OK, "{}", message());
    let (mut usual, mut finished) = (sized::<texere_finish>(), null_mut());
    // SAFETY: all pointers are those of values that live as long as the calls.
    unsafe {
        assert_eq!(texere_design_finish(design, &mut usual), TEXERE_OK);
        let asked = texere_finish {
            warp_tension: 2.0,
            weft_tension: 0.5,
            calender: 3.0,
            stretch: TEXERE_STRETCH_WARP,
            stretch_by: 1.005,
            ..usual
        };
        assert_eq!(texere_design_finished(design, &asked, &mut finished), TEXERE_OK, "{}", message());
        let mut found = sized::<texere_finish>();
        assert_eq!(texere_design_finish(finished, &mut found), TEXERE_OK);
        assert_eq!((found.stretch, found.stretch_by, found.calender), (TEXERE_STRETCH_WARP, 1.005, 3.0));
    }
    let text = read(&format!("{finish}{text}"));
    assert!(saved(finished, true) == saved_by_rust(&text, true));
    // The design from which the finished one was made is unchanged.
    assert!(saved(design, true) != saved(finished, true));
}

/// Makes sure that a call failed with TEXERE_ARGUMENT and this message.
fn refused(status: texere_status, words: &str) {
    assert_eq!(status, TEXERE_ARGUMENT, "{words}: {}", message());
    assert_eq!(message(), words);
}

#[test]
fn what_is_wrong_is_named_by_array_number_value_and_limit() {
    // SAFETY: the arrays live as long as the calls.
    let woven = |woven: &texere_woven| unsafe { texere_design_woven(woven, &mut null_mut()) };
    let thread = |change: fn(&mut texere_thread)| {
        with_woven(
            |_| (),
            |given| {
                // SAFETY: the struct has nine picks.
                let mut weft = unsafe { std::slice::from_raw_parts(given.weft, 9) }.to_vec();
                change(&mut weft[3]);
                woven(&texere_woven { weft: weft.as_ptr(), ..*given })
            },
        )
    };
    let at = "woven.weft[3]:";
    let words = format!("{at} spacing of pick 4 is -1 mm, outside 0.000001 to 1000000 mm");
    refused(thread(|thread| thread.spacing_mm = -1.0), &words);
    refused(thread(|thread| thread.material = 2), &format!("{at} pick 4 is of material 2, but there are 2"));
    refused(thread(|thread| thread.section = 9), &format!("{at} pick 4 has section 9, but there are 2"));
    let words = format!("{at} pick 4 has a flatness of 11, outside 0.1 to 10");
    refused(thread(|thread| thread.flatness = 11.0), &words);
    refused(with_woven(|own| own.shape = 2, woven), "woven.shape is 2, expected 0 to 1");
    let words = "woven: cloth of 0 ends and 9 picks; each must be 1 to 1000000";
    refused(with_woven(|own| own.ends = 0, woven), words);
    let words = "woven.drawdown.stride is 1, expected a multiple of 1 from 2 bytes";
    refused(with_woven(|own| own.drawdown.stride = 1, woven), words);
    let words = "woven.drawdown.size is 25 bytes, and 9 rows need 26";
    refused(with_woven(|own| own.drawdown.size = 25, woven), words);
    refused(with_woven(|own| own.warp = null(), woven), "woven.warp is null");

    // SAFETY: as above.
    let weft = |knit: &texere_weft_knit| unsafe { texere_design_weft_knit(knit, &mut null_mut()) };
    let mut stitches = STITCHES;
    stitches[8].0 = 12;
    refused(with_weft(&stitches, |_| (), weft), "knit.stitches[8].kind is 12, expected 0 to 7");
    stitches[8] = (TEXERE_STITCH_BOTH, 0);
    let words = "knit.stitches[8]: row 1, column 3 of the chart: this stitch needs two beds";
    refused(with_weft(&stitches, |_| (), weft), words);
    let words = "knit.turn[1] is 1, but there are 1, counted from 0";
    refused(with_weft(&STITCHES, |knit| knit.yarn_count = 1, weft), words);

    // SAFETY: as above.
    let warp = |knit: &texere_warp_knit| unsafe { texere_design_warp_knit(knit, &mut null_mut()) };
    let words = "knit.bars[0].laps[1].to is 513, expected 0 to 512";
    refused(with_warp(|_, _, laps| laps[1].to = 513, warp), words);
    let words = "knit.bars[0].laps[1] goes round 3 needles, 2 at most are taken";
    refused(with_warp(|_, _, laps| laps[1].to = 5, warp), words);
    refused(
        with_warp(|_, bars, _| bars[1].lap_count = 0, warp),
        "knit.bars[1].lap_count is 0, expected 1 to 4096",
    );
    let words = "knit.bars[1].threading: a guide of guide bar 2 holds yarn 2, but there are 1";
    refused(with_warp(|knit, _, _| knit.yarn_count = 1, warp), words);
}

#[test]
fn every_section_is_that_of_rust() {
    use texere::yarn::Section;
    let corners = [1.5_f32, 0.0, 0.0, 1.0, -1.5, 0.0, 0.0, -1.0];
    let [circle, ellipse, lens, power, lobed, polygon] = [0, 1, 2, 3, 4, 5].map(|shape| texere_section {
        count: 4,
        form: 0.25,
        corners: corners.as_ptr(),
        ..section(shape)
    });
    let sections = [
        (circle, Section::Circle),
        (ellipse, Section::Ellipse { aspect: 1.5 }),
        (lens, Section::Lenticular { aspect: 1.5, distortion: 0.25 }),
        (power, Section::PowerEllipse { aspect: 1.5, exponent: 0.25 }),
        (texere_section { form: 0.0, ..lobed }, Section::plied(4)),
        (texere_section { form: 0.75, ..lobed }, Section::Lobed { plies: 4, valley: 0.75 }),
        (polygon, Section::Polygon(vec![[1.5, 0.0], [0.0, 1.0], [-1.5, 0.0], [0.0, -1.0]])),
    ];
    for (given, section) in sections {
        let (all, mut design) = ([given; 2], null_mut());
        let made = with_woven(
            |woven| woven.looks.sections = all.as_ptr(),
            // SAFETY: the arrays live as long as the call.
            |woven| unsafe { texere_design_woven(woven, &mut design) },
        );
        assert_eq!(made, TEXERE_OK, "{}", message());
        let text = read(&woven_text());
        let cloth = text.structure.woven().unwrap().cloth();
        let (warp, weft) = (cloth.warp().to_vec(), cloth.weft().to_vec());
        let (materials, sections) = (cloth.materials().to_vec(), vec![section; 2]);
        let cloth = cloth.with_threads(warp, weft, materials, sections).unwrap();
        let woven = texere::woven::WovenDesign::new(cloth, None, texere::woven::Relief::Report).unwrap();
        let own = Design::of("own", texere::Structure::Woven(woven));
        assert!(saved(design, false) == saved_by_rust(&own, false));
    }
}
