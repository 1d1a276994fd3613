//! Patterns from arrays give the same designs as patterns from files. The patterns are shaft
//! drafts, Jacquard pictures of weft knits, and Jacquard bars of warp knits.

use std::ptr::{null, null_mut};

use texere::Design;
use texere::woven::Draft;
use texere_c::texere_status::TEXERE_OK;
use texere_c::*;

use crate::arrays::{STITCHES, YARNS, with_warp, with_weft, with_woven, woven_text};
use crate::common::{message, sized};
use crate::{read, refused, same, saved, saved_by_rust};

/// Lists of numbers that live as long as the program.
fn lists(own: &[&[u32]]) -> texere_lists {
    let mut offsets = vec![0_u64];
    offsets.extend(own.iter().scan(0, |total, list| {
        *total += list.len() as u64;
        Some(*total)
    }));
    texere_lists { numbers: own.concat().leak().as_ptr(), offsets: offsets.leak().as_ptr() }
}

/// Lists of one number each.
fn one_each(own: impl Iterator<Item = u32>) -> texere_lists {
    texere_lists { numbers: own.collect::<Vec<_>>().leak().as_ptr(), offsets: null() }
}

/// A draft of the tests' twill: four shafts with a straight threading, and four treadles.
fn twill() -> texere_draft {
    texere_draft {
        shafts: 4,
        treadles: 4,
        threading: one_each((0..11).map(|end| end % 4 + 1)),
        // Pick p, counted from 0, lifts the ends p and p + 1, counted modulo 4.
        tie_up: lists(&[&[1, 2], &[3, 2, 0, 3], &[3, 4], &[4, 1]]),
        treadling: one_each((0..9).map(|pick| pick % 4 + 1)),
        ..sized()
    }
}

/// The design of the tests' woven cloth, made from a draft in place of the drawdown.
fn drafted(draft: &texere_draft) -> *mut texere_design {
    let mut design = null_mut();
    let made = with_draft(draft, &mut design);
    assert_eq!(made, TEXERE_OK, "{}", message());
    design
}

fn with_draft(draft: &texere_draft, design: &mut *mut texere_design) -> texere_status {
    with_woven(
        |woven| (woven.drawdown.data, woven.draft) = (null_mut(), draft),
        // SAFETY: the arrays live as long as the call.
        |woven| unsafe { texere_design_woven(woven, design) },
    )
}

/// Writes a design to a WIF file, and reads the file. Returns the draft in the file and the design.
fn written_draft(design: *const texere_design) -> (Draft, Design) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("c.wif");
    let place = path.to_str().unwrap();
    // SAFETY: the path lives as long as the call.
    let written = unsafe { texere_design_write(design, place.as_ptr().cast(), place.len()) };
    assert_eq!(written, TEXERE_OK, "{}", message());
    let read = texere::read(&path).unwrap();
    (read.structure.woven().unwrap().draft().unwrap().clone(), read)
}

fn wif(draft: &str) -> Draft {
    let head = "[WIF]\nVersion=1.1\n[WARP]\nThreads=11\n[WEFT]\nThreads=9\n";
    let text = format!("{head}{draft}");
    let read = texere::read_from("draft.wif", text.as_bytes(), |_| Err(std::io::ErrorKind::NotFound.into()));
    read.unwrap().structure.woven().unwrap().draft().unwrap().clone()
}

/// A section of a WIF file, with one numbered line for each value.
fn lines(section: &str, values: impl Iterator<Item = String>) -> String {
    let lines: String =
        (1..).zip(values).map(|(number, value): (u32, _)| format!("{number}={value}\n")).collect();
    format!("[{section}]\n{lines}")
}

#[test]
fn cloth_by_a_shaft_draft_is_that_of_its_drawdown() {
    let design = drafted(&twill());
    same(design, &read(&woven_text()));
    let threading = lines("THREADING", (0..11).map(|end| (end % 4 + 1).to_string()));
    let tie_up = "[TIEUP]\n1=1,2\n2=2,3\n3=3,4\n4=4,1\n";
    let treadling = lines("TREADLING", (0..9).map(|pick| (pick % 4 + 1).to_string()));
    let by_file = wif(&format!("[WEAVING]\nShafts=4\nTreadles=4\n{threading}{tie_up}{treadling}"));
    let (written, _) = written_draft(design);
    assert_eq!(written.drawdown().unwrap(), by_file.drawdown().unwrap());
    assert_eq!((written.threading, written.rising_shed), (by_file.threading, true));
}

/// The draft has ends on two shafts, ends on no shaft, a sinking shed, a treadle that is tied to no
/// shaft, and a pick that presses no treadle.
#[test]
fn every_part_of_a_draft_is_that_of_a_wif_file() {
    let threading: [&[u32]; 11] = [&[1], &[2, 3], &[], &[3], &[1], &[2], &[3, 1], &[1], &[0], &[2], &[3]];
    let picks: [&[u32]; 9] = [&[1], &[2, 1], &[], &[3], &[1], &[2], &[3], &[1, 2, 3], &[2]];
    let text = |list: &&[u32]| list.iter().map(u32::to_string).collect::<Vec<_>>().join(",");
    let shafts = lines("THREADING", threading.iter().map(text));
    for treadles in [3, 0] {
        let tie_up: [&[u32]; 3] = [&[1, 3], &[], &[2]];
        let draft = texere_draft {
            sinking_shed: 1,
            shafts: 3,
            treadles,
            threading: lists(&threading),
            tie_up: lists(&tie_up[..treadles as usize]),
            treadling: lists(&picks),
            ..sized()
        };
        let rest = if treadles == 0 {
            lines("LIFTPLAN", picks.iter().map(text))
        } else {
            lines("TIEUP", tie_up.iter().map(text)) + &lines("TREADLING", picks.iter().map(text))
        };
        let head = format!("[WEAVING]\nRising Shed=false\nShafts=3\nTreadles={treadles}\n");
        let by_file = wif(&format!("{head}{shafts}{rest}"));
        let (written, design) = written_draft(drafted(&draft));
        let drawdown = by_file.drawdown().unwrap();
        assert_eq!(design.structure.woven().unwrap().cloth().drawdown(), &drawdown, "{treadles} treadles");
        assert_eq!(written.rising_shed, by_file.rising_shed);
        let sorted = |lists: &[Vec<u32>]| -> Vec<Vec<u32>> {
            lists.iter().cloned().map(|mut list| (list.sort_unstable(), list).1).collect()
        };
        assert_eq!(sorted(&written.threading), sorted(&by_file.threading), "{treadles} treadles");
    }
}

#[test]
fn what_is_wrong_with_a_draft_is_named_by_list_number_value_and_limit() {
    let draft = |change: fn(&mut texere_draft), words: &str| {
        let mut draft = twill();
        change(&mut draft);
        refused(with_draft(&draft, &mut null_mut()), &format!("woven.draft{words}"));
    };
    draft(|draft| draft.sinking_shed = 2, ".sinking_shed is 2, expected 0 or 1");
    draft(|draft| draft.shafts = 0, ".shafts is 0, expected 1 to 100000");
    draft(|draft| draft.treadles = 100_001, ".treadles is 100001, expected 0 to 100000");
    draft(|draft| draft.shafts = 3, ".threading.numbers[3] is 4, expected 0 to 3");
    draft(|draft| draft.treadling = one_each((3..12).rev()), ".treadling.numbers[0] is 11, expected 0 to 4");
    draft(|draft| draft.tie_up.numbers = null(), ".tie_up.numbers is null");
    draft(
        |draft| draft.tie_up.offsets = [0, 2, 1, 4, 5].as_ptr(),
        ".tie_up.offsets[2] is 1, expected 2 or more, as the one before",
    );
    draft(|draft| draft.tie_up.offsets = [1, 2, 3, 4, 5].as_ptr(), ".tie_up.offsets[0] is 1, expected 0");
    draft(
        |draft| draft.tie_up.offsets = [0, 2, 3, 4, u64::MAX].as_ptr(),
        &format!(".tie_up.numbers has {} values, more than memory can hold", u64::MAX),
    );
    // SAFETY: the arrays live as long as the call.
    let woven = |woven: &texere_woven| unsafe { texere_design_woven(woven, &mut null_mut()) };
    let draft = twill();
    let words = "woven has both a drawdown and a draft, expected one of them";
    refused(with_woven(|woven| woven.draft = &draft, woven), words);
    let words = "woven: cloth of 0 ends and 9 picks; each must be 1 to 1000000";
    let change = |woven: &mut texere_woven| {
        (woven.drawdown.data, woven.draft, woven.ends) = (null_mut(), &draft, 0);
    };
    refused(with_woven(change, woven), words);
}

/// A picture of two colours, six columns wide and three rows high. The bottom row comes first.
const PICTURE: [u32; 18] = [0, 0, 1, 1, 0, 0, 0, 1, 0, 1, 1, 0, 1, 1, 1, 1, 1, 1];

/// Reads a design whose text names the file `picture.png`. The file shows [`PICTURE`], with black
/// for 0 and white for 1.
fn read_beside_picture(text: &str) -> Design {
    let rows = PICTURE.chunks(6).rev().flatten();
    let pixels: Vec<u8> = rows.flat_map(|color| [*color as u8 * 255; 3]).collect();
    let mut png = Vec::new();
    texere::write::picture_to([6, 3], &pixels, &mut png).unwrap();
    texere::read_from("text.toml", text.as_bytes(), |_| Ok(png.clone())).unwrap()
}

fn jacquard(knit: &mut texere_weft_knit) {
    (knit.beds, knit.stitches, knit.turn, knit.turn_count) = (0, null(), null(), 0);
    (knit.courses, knit.jacquard) = (3, PICTURE.as_ptr());
}

#[test]
fn jacquards_of_weft_knits_are_those_of_their_pictures() {
    for (backing, line) in [
        (TEXERE_BACKING_NONE, ""),
        (TEXERE_BACKING_BIRDSEYE, "backing = \"birdseye\"\n"),
        (TEXERE_BACKING_LADDER, "backing = \"ladder\"\n"),
    ] {
        let mut design = null_mut();
        let made = with_weft(
            &[],
            |knit| {
                jacquard(knit);
                knit.backing = backing;
            },
            // SAFETY: the arrays live as long as the call.
            |knit| unsafe { texere_design_weft_knit(knit, &mut design) },
        );
        assert_eq!(made, TEXERE_OK, "{}", message());
        let text = format!(
            "[knit]\nimage = \"picture.png\"\n{line}repeat = [2, 1]\nwales_per_cm = 8.0\n\
             courses_per_cm = 10.0\n[knit.colors]\n\"#000000\" = \"a\"\n\"#ffffff\" = \"bé\"\n{YARNS}"
        );
        let text = read_beside_picture(&text);
        assert!(saved(design, false) == saved_by_rust(&text, false), "backing {backing}");
    }
}

/// A Jacquard for a chain of two laps. `colors` are the cells of its image, and `shifts` has four
/// numbers for each colour.
fn image(colors: &[u8], shifts: &[u8]) -> texere_jacquard {
    let color_count = shifts.len() as u64 / 4;
    texere_jacquard { guides: 6, rounds: 3, colors: colors.as_ptr(), color_count, shifts: shifts.as_ptr() }
}

/// The shifts of two colours. Colour 0 leaves both laps as they are. Colour 1 moves the first lap
/// by one needle and leaves the second.
const SHIFTS: [u8; 8] = [0, 0, 0, 0, 1, 1, 0, 0];

/// Calls `call` with a warp knit of two guide bars. The front bar has `jacquard`, the other bar has
/// no Jacquard.
fn with_jacquard<T>(jacquard: texere_jacquard, call: impl FnOnce(&texere_warp_knit) -> T) -> T {
    let none = texere_jacquard { guides: 0, rounds: 9, colors: null(), color_count: 9, shifts: null() };
    let jacquards = [jacquard, none];
    with_warp(
        |knit, _, laps| {
            (knit.courses, knit.copies, knit.jacquards) = (6, [1, 1], jacquards.as_ptr());
            laps[1] = texere_lap { from: 1, to: 2 };
        },
        call,
    )
}

#[test]
fn jacquards_of_guide_bars_are_those_of_their_pictures() {
    let mut design = null_mut();
    let colors = PICTURE.map(|color| color as u8);
    // SAFETY: the arrays live as long as the call.
    let made =
        with_jacquard(image(&colors, &SHIFTS), |knit| unsafe { texere_design_warp_knit(knit, &mut design) });
    assert_eq!(made, TEXERE_OK, "{}", message());
    let text = "[warp_knit]\nwales = 6\ncourses = 6\nrepeat = [1, 1]\nwales_per_cm = 8.0\n\
        courses_per_cm = 10.0\n[[warp_knit.bars]]\nlapping = \"1-0/1-2//\"\nthreading = [\"a\"]\n\
        image = \"picture.png\"\ncolors = { \"#000000\" = \"0-0/0-0\", \"#ffffff\" = \"1-1/0-0\" }\n\
        [[warp_knit.bars]]\nlapping = \"1-2/1-0//\"\nthreading = [\"a\", \"out\", \"bé\"]\nrun_in_mm = 1500.0\n\
        offset = 1\n";
    let text = read_beside_picture(&format!("{text}{YARNS}"));
    assert!(saved(design, false) == saved_by_rust(&text, false));
}

#[test]
fn what_is_wrong_with_a_jacquard_is_named_by_array_number_value_and_limit() {
    // SAFETY: the arrays live as long as the calls.
    let weft = |knit: &texere_weft_knit| unsafe { texere_design_weft_knit(knit, &mut null_mut()) };
    let knit = |change: fn(&mut texere_weft_knit), words: &str| {
        let change = |knit: &mut texere_weft_knit| {
            jacquard(knit);
            change(knit);
        };
        refused(with_weft(&[], change, weft), words);
    };
    knit(|knit| knit.backing = 3, "knit.backing is 3, expected 0 to 2");
    knit(|knit| knit.yarn_count = 1, "knit.jacquard[2] is 1, but there are 1, counted from 0");
    knit(
        |knit| knit.beds = 1,
        "knit.jacquard is not null, so knit.stitches has to be null, knit.turn_count and knit.beds 0",
    );
    knit(|knit| knit.courses = 0, "knit.jacquard: a chart of 6 wales and 0 rows; each must be 1 to 65536");
    let words = "knit.backing is 1, expected 0 without a knit.jacquard";
    refused(with_weft(&STITCHES, |knit| knit.backing = 1, weft), words);

    let colors = PICTURE.map(|color| color as u8);
    let bars = |change: fn(&mut texere_jacquard), shifts: [u8; 8], words: &str| {
        let mut own = image(&colors, &shifts);
        change(&mut own);
        // SAFETY: the arrays live as long as the call.
        let made = with_jacquard(own, |knit| unsafe { texere_design_warp_knit(knit, &mut null_mut()) });
        refused(made, &format!("knit.jacquards[0]{words}"));
    };
    let cells = "expected 1 to 4294967295 cells";
    bars(|own| own.rounds = 0, SHIFTS, &format!(" has 6 guides and 0 rounds, {cells}"));
    bars(|own| own.rounds = 1 << 30, SHIFTS, &format!(" has 6 guides and 1073741824 rounds, {cells}"));
    bars(|own| own.color_count = 0, SHIFTS, ".color_count is 0, expected 1 to 256");
    bars(|own| own.color_count = 1, SHIFTS, ".colors[2] is 1, but there are 1, counted from 0");
    bars(|own| own.shifts = null(), SHIFTS, ".shifts is null");
    bars(|_| (), [0, 0, 0, 0, 0, 2, 0, 0], ".shifts[5] is 2, expected 0 or 1");
    // A colour moves the beginning of a lap away from the lap's end. The lap, which goes round two
    // needles, then goes round three.
    let wide = with_jacquard(image(&colors, &[0, 0, 0, 0, 1, 0, 0, 0]), |knit| {
        // SAFETY: the struct has two bars.
        let mut bars = unsafe { std::slice::from_raw_parts(knit.bars, 2) }.to_vec();
        let laps = [texere_lap { from: 2, to: 0 }, texere_lap { from: 1, to: 2 }];
        bars[0].laps = laps.as_ptr();
        let knit = texere_warp_knit { bars: bars.as_ptr(), ..*knit };
        // SAFETY: the arrays live as long as the call.
        unsafe { texere_design_warp_knit(&knit, &mut null_mut()) }
    });
    let words = "a colour of guide bar 1's Jacquard makes its lap 3-0 at course 1: 3 needles; a lap goes round 2 at most";
    refused(wide, &format!("knit.jacquards[0].shifts: {words}"));
}
