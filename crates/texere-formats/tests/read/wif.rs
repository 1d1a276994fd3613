//! WIF drafts: files that are accepted or refused, and equal cloth from both ways of giving lifts.

use std::error::Error;

use texere_core::{Origin, Settings};
use texere_fabric::Woven;
use texere_formats::{Design, ReadError, read};

use crate::read_file;

/// A straight 2/2 twill on four shafts, five ends by four picks, in centimetres.
const TWILL: &str = "[WIF]\nVersion=1.1\n[WEAVING]\nShafts=4\nTreadles=4\nRising Shed=true\n\
    [WARP]\nThreads=5\nUnits=Centimeters\nSpacing=0.2\nThickness=0.1\nColor=1\n\
    [WEFT]\nThreads=4\nUnits=Centimeters\nSpacing=0.3\nThickness=0.1\nColor=2\n\
    [COLOR PALETTE]\nEntries=2\nRange=0,255\n[COLOR TABLE]\n1=10,20,30\n2=40,50,60\n\
    [THREADING]\n1=1\n2=2\n3=3\n4=4\n5=1\n\
    [TIEUP]\n1=1,2\n2=2,3\n3=3,4\n4=4,1\n[TREADLING]\n1=1\n2=2\n3=3\n4=4\n";

/// The lift plan that equals the tie-up and the treadling of `TWILL`.
const LIFT_PLAN: &str = "[LIFTPLAN]\n1=1,2\n2=2,3\n3=3,4\n4=4,1\n";

/// The drawdown of `TWILL` as a weaver draws it: the last pick on top, and end 1 on the left.
const TWILL_DRAWDOWN: &str = "10011\n00110\n01100\n11001\n";

fn read_text(text: impl AsRef<[u8]>) -> Result<Design, ReadError> {
    read_file("draft.wif", text)
}

fn cloth(text: &str) -> Woven {
    read_text(text).unwrap().structure.woven().unwrap().cloth().clone()
}

fn drawdown(text: &str) -> String {
    let woven = cloth(text);
    let drawdown = woven.drawdown();
    let row = |pick| (0..drawdown.ends()).map(move |end| if drawdown.up(end, pick) { '1' } else { '0' });
    (0..drawdown.picks()).rev().flat_map(|pick| row(pick).chain(['\n'])).collect()
}

/// Asserts that the file is refused with a message that has all of `parts`.
fn refused(text: &str, parts: &[&str]) {
    let error = read_text(text).expect_err(text);
    for part in parts {
        assert!(error.to_string().contains(part), "\"{error}\" lacks \"{part}\"");
    }
}

#[test]
fn tie_up_with_treadling_and_lift_plan_give_one_drawdown() {
    assert_eq!(drawdown(TWILL), TWILL_DRAWDOWN);
    let lifted = TWILL.split("[TIEUP]").next().unwrap().to_owned() + LIFT_PLAN;
    assert_eq!(drawdown(&lifted), TWILL_DRAWDOWN);
    // A lift plan and a treadling that agree give no warning.
    assert!(read_text(TWILL.to_owned() + LIFT_PLAN).unwrap().warnings().is_empty());
    // If a lift plan and a treadling differ, the treadling counts.
    let odds = TWILL.to_owned() + &LIFT_PLAN.replace("1=1,2", "1=1,3");
    assert_eq!(drawdown(&odds), TWILL_DRAWDOWN);
    assert!(read_text(&odds).unwrap().warnings()[0].contains("lift plan and treadling"));
}

#[test]
fn cloth_that_falls_apart_is_told() {
    assert!(read_text(TWILL).unwrap().remarks().is_empty());
    // Shafts 1 and 3 hold the ends of the face. Each back pick lifts all of them.
    let lifted = TWILL.split("[TIEUP]").next().unwrap().to_owned();
    let double = read_text(lifted + "[LIFTPLAN]\n1=1\n2=1,3,2\n3=3\n4=1,3,4\n").unwrap();
    let told = "there are 2 layers (3 ends with 2 picks, 2 ends with 2 picks)";
    assert!(double.remarks().iter().any(|remark| remark.contains(told)), "{:?}", double.remarks());
    // A pick without a lift lies on the face, loose.
    let loose = read_text(TWILL.replace("[TREADLING]\n1=1\n2=2\n", "[TREADLING]\n1=1\n")).unwrap();
    assert!(loose.remarks().iter().any(|remark| remark.contains("a loose pick")), "{:?}", loose.remarks());
}
#[test]
fn a_sinking_shed_is_the_other_face() {
    let sinking = drawdown(&TWILL.replace("Rising Shed=true", "Rising Shed=0"));
    let flipped: String = TWILL_DRAWDOWN
        .chars()
        .map(|c| {
            if c == '1' {
                '0'
            } else if c == '0' {
                '1'
            } else {
                c
            }
        })
        .collect();
    assert_eq!(sinking, flipped);
}

#[test]
fn an_end_on_several_shafts_and_a_pick_on_several_treadles() {
    let text = TWILL
        .replace("5=1\n[TIEUP]", "5=1,3\n[TIEUP]")
        .replace("[TREADLING]\n1=1\n", "[TREADLING]\n1=1,0,3\n");
    // Pick 1 now lifts shafts 1 to 4. End 5 is up wherever shaft 1 or shaft 3 is up.
    assert_eq!(drawdown(&text), "10011\n00111\n01101\n11111\n");
}

#[test]
fn dialects_read_alike() {
    let shuffled = "garbage before\r\n[text]\r\ntitle=T\r\n".to_owned() + &TWILL.replace('\n', "\r\n");
    assert_eq!(drawdown(&shuffled), TWILL_DRAWDOWN);
    assert_eq!(read_text(&shuffled).unwrap().name, "T");
    assert_eq!(drawdown(&TWILL.to_lowercase()), TWILL_DRAWDOWN);
    assert_eq!(drawdown(&TWILL.replace("[TIEUP]", "[LIFTPLAN]\n1=\n[TIEUP]\n")), TWILL_DRAWDOWN);
    assert_eq!(drawdown(&TWILL.replace("Treadles=4", "Treadles=2")), TWILL_DRAWDOWN);
    let mut latin = TWILL.as_bytes().to_vec();
    latin.extend_from_slice(b"[TEXT]\nTitle=Caf\xe9\n");
    assert_eq!(read_text(latin).unwrap().name, "Café");
}

#[test]
fn sparse_lists_take_defaults_and_a_treadle_without_a_row_lifts_nothing() {
    let text = TWILL
        .replace("Treadles=4", "Treadles=6")
        .replace("[TREADLING]\n1=1\n2=2\n", "[TREADLING]\n1=6\n")
        .replace("3=3\n4=4\n5=1\n", "3=\n4=0\n");
    assert_eq!(drawdown(&text), "10000\n00000\n00000\n00000\n");
}

#[test]
fn spacing_thickness_and_colour_of_single_threads() {
    let woven = cloth(
        &(TWILL.to_owned() + "[WARP SPACING]\n2=0.5\n[WARP THICKNESS]\n3=0.02\n4=\n[WEFT COLORS]\n2=1\n"),
    );
    let spacings: Vec<_> = woven.warp().iter().map(|end| end.spacing_mm).collect();
    assert_eq!(spacings, [2.0, 5.0, 2.0, 2.0, 2.0]);
    let radii: Vec<_> = woven.warp().iter().map(|end| end.radius_mm).collect();
    assert_eq!(radii, [0.5, 0.5, 0.1, 0.5, 0.5]);
    let colours: Vec<_> =
        woven.weft().iter().map(|pick| woven.materials()[pick.material as usize].srgb).collect();
    assert_eq!(colours, [[40, 50, 60], [10, 20, 30], [40, 50, 60], [40, 50, 60]]);
    // Columns of 2, 5, 2, 2 and 2 mm side by side, with an end in the middle of each.
    let yarns = woven.yarns().unwrap();
    let x: Vec<_> = (0..5).map(|end| yarns.yarn_points(end).unwrap()[0].x).collect();
    assert_eq!(x, [1.0, 4.5, 8.0, 10.0, 12.0]);
    assert_eq!(yarns.layout().yarns()[5].origin, Origin::Pick(1));
}

#[test]
fn units_are_what_they_say() {
    for (unit, mm) in [("Inches", 25.4), ("DECIPOINTS", 25.4 / 720.0), ("centimeters", 10.0)] {
        let woven = cloth(&TWILL.replace("Units=Centimeters", &format!("Units={unit}")));
        assert!((woven.warp()[1].spacing_mm - 0.2 * mm).abs() < 1e-9, "{unit}");
        assert!((f64::from(woven.weft()[1].radius_mm) - 0.05 * mm).abs() < 1e-6, "{unit}");
    }
}

#[test]
fn missing_thickness_and_colour_are_told() {
    let design = read_text(TWILL.replace("Thickness=0.1\n", "").replace("Color=1\n", "")).unwrap();
    let told = design.warnings().join("\n");
    assert!(told.contains("[WARP] 5 of 5 threads have no thickness; 1.0000 mm"), "{told}");
    assert!(told.contains("[WEFT] 4 of 4 threads have no thickness; 1.0000 mm"), "{told}");
    assert!(told.contains("[WARP] 5 of 5 threads have no colour"), "{told}");
}

#[test]
fn a_colour_range_is_scaled() {
    let woven = cloth(&TWILL.replace("0,255", "0,999").replace("2=40,50,60", "2=999,500,0"));
    assert_eq!(woven.materials()[woven.weft()[0].material as usize].srgb, [255, 128, 0]);
}

#[test]
fn refusals_name_section_and_key() {
    refused(&TWILL.replace("[THREADING]", "[OTHER]"), &["[THREADING]"]);
    refused(&TWILL.replace("[TIEUP]", "[OTHER]"), &["[TIEUP]"]);
    refused(&TWILL.replace("[TREADLING]", "[OTHER]"), &["[TREADLING]"]);
    refused(TWILL.split("[TIEUP]").next().unwrap(), &["[LIFTPLAN]"]);
    refused(&TWILL.replace("Threads=5\n", ""), &["[WARP] Threads"]);
    refused(&TWILL.replace("Threads=4", "Threads=0"), &["line 14", "[WEFT] threads", "outside 1 to"]);
    refused(&TWILL.replace("Threads=4", "Threads=nan"), &["[WEFT] threads", "whole number"]);
    refused(&TWILL.replace("Threads=4", "Threads=99999999999"), &["[WEFT] threads", "outside 1 to"]);
    refused(&TWILL.replace("[TREADLING]\n1=1", "[TREADLING]\n1=1,5"), &["[TREADLING] 1 is 5", "to 4"]);
    refused(&TWILL.replace("[TIEUP]\n1=1,2", "[TIEUP]\n1=1,9"), &["[TIEUP] 1 is 9", "to 4"]);
    let beyond_any_loom = TWILL.replace("[THREADING]\n1=1", "[THREADING]\n1=100001");
    refused(&beyond_any_loom, &["[THREADING] 1 is 100001", "to 100000"]);
    refused(&TWILL.replace("[TIEUP]\n1=1,2", "[TIEUP]\n1=-1,2"), &["[TIEUP] 1 is -1", "outside 0 to 4"]);
    refused(
        &TWILL.replace("[THREADING]\n1=1", "[THREADING]\n1=x"),
        &["[THREADING] 1 is \"x\"", "whole numbers"],
    );
    refused(&TWILL.replace("Color=2", "Color=3"), &["[WEFT] color is 3", "1 to 2"]);
    refused(&(TWILL.to_owned() + "[WEFT COLORS]\n4=11\n"), &["[WEFT COLORS] 4 is 11", "1 to 2"]);
    refused(&TWILL.replace("[COLOR TABLE]", "[OTHER]"), &["[WARP] color", "[COLOR TABLE]"]);
    refused(&TWILL.replace("1=10,20,30", "1=10,20"), &["[COLOR TABLE] 1", "red, green and blue"]);
    refused(&TWILL.replace("Range=0,255", "Range=9,9"), &["[COLOR PALETTE] range"]);
    let tiny = TWILL.replace("Spacing=0.2", "Spacing=1e-300");
    refused(&tiny, &["line 10: [WARP] spacing is 1e-300, outside 0.0001 to 100"]);
    refused(&TWILL.replace("Thickness=0.1", "Thickness=1e-300"), &["line 11: [WARP] thickness is 1e-300"]);
    refused(&TWILL.replace("Spacing=0.2", "Spacing=-1"), &["[WARP] spacing is -1"]);
    refused(&TWILL.replace("Spacing=0.2", "Spacing=NaN"), &["[WARP] spacing is NaN"]);
    refused(&TWILL.replace("Spacing=0.2", "Spacing=wide"), &["[WARP] spacing is \"wide\""]);
    refused(&TWILL.replace("Units=Centimeters", "Units=ells"), &["[WARP] units is \"ells\"", "Decipoints"]);
    refused(&TWILL.replace("Rising Shed=true", "Rising Shed=maybe"), &["[WEAVING] rising shed is \"maybe\""]);
    refused("", &["Threads"]);
}

#[test]
fn a_colour_below_one_is_refused_like_one_too_large() {
    for number in ["0", "-1", "0,1,2,3"] {
        let first = number.split(',').next().unwrap();
        for (section, key) in
            [("WARP", "color"), ("WEFT", "color"), ("WARP COLORS", "2"), ("WEFT COLORS", "3")]
        {
            let text = format!("{TWILL}[{section}]\n{key}={number}\n");
            refused(&text, &["line 42", &format!("[{section}] {key} is {first}, outside 1 to 2")]);
        }
    }
    // An empty value is no colour.
    assert!(read_text(format!("{TWILL}[WARP COLORS]\n2=\n")).is_ok());
}

#[test]
fn utf_16_is_read() {
    let text = format!("{TWILL}[TEXT]\nTitle=Köper 𝄞\n");
    let units = || text.encode_utf16();
    let little: Vec<u8> = units().flat_map(u16::to_le_bytes).collect();
    let big: Vec<u8> = units().flat_map(u16::to_be_bytes).collect();
    for bytes in [[b"\xff\xfe", &little[..]].concat(), [b"\xfe\xff", &big[..]].concat(), little, big] {
        let design = read_text(&bytes).unwrap();
        let woven = design.structure.woven().unwrap().cloth().clone();
        assert_eq!((design.name.as_str(), woven.warp().len()), ("Köper 𝄞", 5));
        // Reading a file that is cut within a character does not panic.
        let _ = read_text(&bytes[..bytes.len() - 1]);
    }
}

#[test]
fn a_loom_has_what_is_set_up_on_it() {
    let warned = |text: &str, parts: &[&str]| {
        let warnings = read_text(text).unwrap().warnings();
        let [warning] = &warnings[..] else { panic!("{warnings:?}") };
        parts.iter().for_each(|part| assert!(warning.contains(part), "{warning}"));
    };
    // There is a warning if ends are on more shafts than are stated, or if the tie-up has rows for
    // more treadles than are stated.
    warned(&TWILL.replace("Shafts=4", "Shafts=2"), &["[WEAVING] Shafts is 2", "[THREADING] goes up to 4"]);
    warned(&TWILL.replace("Treadles=4", "Treadles=2"), &["[WEAVING] Treadles is 2", "[TIEUP] goes up to 4"]);
    assert_eq!(drawdown(&TWILL.replace("Shafts=4", "Shafts=2")), TWILL_DRAWDOWN);
    // A lifted shaft, or a pressed treadle, that is neither counted nor set up is refused.
    let [lifted, pressed] = [("[TIEUP]\n1=1,2", "[TIEUP]\n1=1,5"), ("[TREADLING]\n1=1", "[TREADLING]\n1=5")]
        .map(|(from, to)| TWILL.replace(from, to));
    refused(&lifted, &["[TIEUP] 1 is 5, outside 0 to 4"]);
    refused(&pressed, &["[TREADLING] 1 is 5, outside 0 to 4"]);
    // Without a count, no shaft or treadle is refused.
    for (text, count) in [(lifted, "Shafts=4\n"), (pressed, "Treadles=4\n")] {
        let warnings = read_text(text.replace(count, "")).unwrap().warnings();
        assert!(warnings.iter().all(|warning| warning.contains("nothing binds")), "{warnings:?}");
    }
}

/// Some programs write the spacing of threads as their thickness.
#[test]
fn threads_as_thick_as_they_are_spaced_get_room_to_cross() {
    let stated = |warp: &str, weft: &str, more: &str| {
        let text =
            TWILL.replace("Spacing=0.2\nThickness=0.1", warp).replace("Spacing=0.3\nThickness=0.1", weft);
        read_text(text + more).unwrap()
    };
    let diameters = |design: &Design| {
        let woven = design.structure.woven().unwrap().cloth();
        [woven.warp(), woven.weft()]
            .map(|set| set.iter().map(|thread| 2.0 * thread.radius_mm).collect::<Vec<_>>())
    };
    let near = |found: &[f32], expected: &[f32]| {
        assert!(
            found.iter().zip(expected).all(|(a, b)| (a / b - 1.0).abs() < 1e-5),
            "{found:?}, not {expected:?}"
        );
    };
    let both = ("Spacing=.212\nThickness=.212", "Spacing=.212\nThickness=.2115");
    let design = stated(both.0, both.1, "");
    // The diameter of all threads becomes half the spacing.
    let [warp, weft] = diameters(&design);
    assert!(
        warp.iter().chain(&weft).all(|diameter| (diameter / 1.06 - 1.0).abs() < 5e-3),
        "{warp:?} {weft:?}"
    );
    let warnings = design.warnings();
    for (warning, set) in warnings.iter().zip(["[WARP]", "[WEFT]"]) {
        assert!(warning.starts_with(set) && warning.contains("as thick as they are spaced"), "{warning}");
    }
    assert_eq!(warnings.len(), 2);
    // Thin threads stay thinner than the others. All threads are made thinner if some lie close.
    let design = stated(both.0, both.1, "[WARP THICKNESS]\n2=.106\n[WARP SPACING]\n2=.106\n");
    let [warp, weft] = diameters(&design);
    near(&warp, &[warp[0], warp[0] / 2.0, warp[0], warp[0], warp[0]]);
    assert!(warp[0] < 1.06 && weft.iter().all(|diameter| *diameter == weft[0]), "{warp:?} {weft:?}");
    assert!(design.warnings().concat().contains("lie closer than most"));
    // One set is scaled by itself. The other keeps its stated thickness.
    let design = stated("Spacing=.2\nThickness=.2", "Spacing=.4\nThickness=.08", "");
    assert!(design.warnings()[0].starts_with("[WARP] has") && design.warnings().len() == 1);
    let [warp, weft] = diameters(&design);
    near(&[warp[0], weft[0]], &[1.0, 0.8]);
    // A draft that can be woven is not changed. Threads that jam by the draft's own thickness are
    // reported, not changed.
    near(&diameters(&stated("Spacing=.2\nThickness=.1", "Spacing=.3\nThickness=.1", ""))[0], &[1.0]);
    near(&diameters(&stated("Spacing=.2\nThickness=.19", "Spacing=.3\nThickness=.19", ""))[0], &[1.9]);
}

/// Cloths of four tie-ups, with equal and unequal spacings, are clear if texere chooses the
/// diameters, because a draft states no thickness or one that equals the spacing.
#[test]
fn what_is_given_room_does_not_pierce() {
    let tie_ups = [
        "1=1\n2=2\n3=1,3\n4=2,4\n",
        "1=1,3\n2=2,4\n3=1,3\n4=2,4\n",
        "1=1\n2=2\n3=3\n4=4\n",
        "1=1,2\n2=2,3\n3=3,4\n4=4,1\n",
    ];
    let spacings = [
        "",
        "2=.159\n3=.106\n4=.053\n",
        "1=.053\n2=.106\n3=.159\n5=.265\n6=.318\n",
        "1=.6\n5=.6\n9=.6\n",
        "2=.05\n4=.05\n6=.05\n8=.05\n10=.05\n12=.05\n",
    ];
    let straight: String = (1..=12).map(|thread| format!("{thread}={}\n", (thread - 1) % 4 + 1)).collect();
    let straight = &straight;
    // Lines with values for a whole set and for single threads.
    let set = |name: &str, spacing: &str, own: &str, stated: bool| {
        let thickness =
            if stated { format!("Thickness={spacing}\n[{name} THICKNESS]\n{own}") } else { String::new() };
        format!(
            "[{name}]\nThreads=12\nUnits=cm\nSpacing={spacing}\n[{name} SPACING]\n{own}[{name}]\n{thickness}"
        )
    };
    for stated in [true, false] {
        for (tie_up, weft_spacing) in
            tie_ups.iter().flat_map(|tie_up| [".212", ".1", ".6"].map(|weft| (tie_up, weft)))
        {
            for (warp, weft) in spacings.iter().flat_map(|warp| spacings.iter().map(move |weft| (warp, weft)))
            {
                let (warp, weft) =
                    (set("WARP", ".212", warp, stated), set("WEFT", weft_spacing, weft, stated));
                let draft = format!("[THREADING]\n{straight}[TIEUP]\n{tie_up}[TREADLING]\n{straight}");
                let design = read_text(format!("{warp}{weft}{draft}")).unwrap();
                let clearance =
                    texere_contact::clearance(&design.yarns().unwrap(), &Settings::default()).unwrap().min;
                // If threads touch by construction, the splines between their control points come
                // to 0.99 of touching.
                assert!(clearance > 0.985, "{clearance}: {warp}{weft}{draft}");
            }
        }
    }
}

/// Thick and thin ends in turn, in columns as wide as the threads are drawn. Ends that are three
/// times as thick stay three times as thick.
#[test]
fn thick_and_thin_drafts_keep_their_thick_threads() {
    let own = |what: &str, thick: &str| format!("[WARP {what}]\n2={thick}\n4={thick}\n");
    // First all threads are as thick as their columns are wide. Then only the thin threads are.
    for more in [own("SPACING", "0.6") + &own("THICKNESS", "0.6"), own("THICKNESS", "0.6")] {
        let text = TWILL.replace("Spacing=0.2\nThickness=0.1", "Spacing=0.2\nThickness=0.2") + &more;
        let design = read_text(&text).unwrap();
        let woven = design.structure.woven().unwrap().cloth();
        for pair in woven.warp().windows(2) {
            let [thin, thick] =
                [pair[0].radius_mm.min(pair[1].radius_mm), pair[0].radius_mm.max(pair[1].radius_mm)];
            assert!((thick / thin - 3.0).abs() < 1e-4, "{thin} {thick}");
        }
        assert!(design.warnings()[0].contains("as thick as they are spaced"));
    }
}

/// Columns of ends are 1 mm and 2 mm wide in turn, as in thick-and-thin drafts. Each end lies
/// 1.5 mm from the next.
#[test]
fn threads_lie_in_the_middle_of_their_columns() {
    let own = "[WARP SPACING]\n2=0.2\n4=0.2\n[WARP THICKNESS]\n2=0.12\n4=0.12\n";
    let text = TWILL.replace("Spacing=0.2\nThickness=0.1", "Spacing=0.1\nThickness=0.05");
    let text = text.replace("Spacing=0.3\nThickness=0.1", "Spacing=0.3\nThickness=0.03") + own;
    let woven = cloth(&text);
    assert!((woven.size_mm()[0] - 7.0).abs() < 1e-12);
    for (end, at) in woven.middles_mm().warp.iter().enumerate() {
        assert!((at - (0.5 + 1.5 * end as f64)).abs() < 1e-12, "{at}");
    }
    assert!(woven.warnings().is_empty());
}

/// A draft with a comment after every value and every section's name is read like the draft without
/// comments. A title keeps its semicolon.
#[test]
fn a_semicolon_behind_any_value_begins_a_comment() {
    let full = TWILL.to_owned()
        + LIFT_PLAN
        + "[WARP SPACING]\n2=0.3\n[WARP THICKNESS]\n2=0.12\n[WEFT COLORS]\n1=1\n[WARP COLORS]\n3=2\n";
    let commented: String = full
        .lines()
        .map(|line| {
            if line.contains('=') { format!("{line}   ; 3, no=1\n") } else { format!("{line} ; a section\n") }
        })
        .collect();
    let commented = commented + "[TEXT]\nTitle=Black; white\n";
    assert_eq!(cloth(&commented), cloth(&full));
    let design = read_text(&commented).unwrap();
    assert_eq!(
        (design.name.as_str(), design.warnings().len()),
        ("Black; white", read_text(&full).unwrap().warnings().len())
    );
    // The value before the comment is still checked.
    refused(&TWILL.replace("Threads=5", "Threads=five ; 5"), &["[WARP] threads is \"five\""]);
    refused(&TWILL.replace("Shed=true", "Shed=maybe;true"), &["[WEAVING] rising shed is \"maybe\""]);
}

#[test]
fn a_range_of_one_number_begins_at_0() {
    for (range, scaled) in [("255", [10, 20, 30]), ("510", [5, 10, 15])] {
        let design = read_text(TWILL.replace("Range=0,255", &format!("Range={range}"))).unwrap();
        let woven = design.structure.woven().unwrap().cloth();
        assert_eq!(woven.materials()[woven.warp()[0].material as usize].srgb, scaled);
        assert!(design.warnings()[0].contains(&format!("0 to {range} is taken")), "{:?}", design.warnings());
        assert_eq!(design.warnings().len(), 1);
    }
    refused(&TWILL.replace("Range=0,255", "Range=0"), &["[COLOR PALETTE] range is \"0\""]);
}

#[test]
fn a_loom_without_treadles_is_woven_by_its_lift_plan() {
    let none = TWILL.replace("Treadles=4", "Treadles=0");
    // The tie-up is not checked, whatever its value.
    let odd = none.replace("4=4,1\n[TREADLING]", "4=99,1\n[TREADLING]") + LIFT_PLAN;
    assert_eq!(drawdown(&odd), TWILL_DRAWDOWN);
    assert!(read_text(&odd).unwrap().warnings()[0].contains("Treadles is 0; the lift plan is taken"));
    // Without a lift plan the treadles of the tie-up are used, as if too few were declared.
    assert_eq!(drawdown(&none), TWILL_DRAWDOWN);
    assert!(read_text(&none).unwrap().warnings()[0].contains("Treadles is 0, but [TIEUP] goes up to 4"));
    // If too few shafts are declared, the loom has those on which ends are threaded.
    let shafts = TWILL.replace("Shafts=4", "Shafts=0");
    assert_eq!(drawdown(&shafts), TWILL_DRAWDOWN);
    assert!(read_text(&shafts).unwrap().warnings()[0].contains("Shafts is 0, but [THREADING] goes up to 4"));
}

#[test]
fn a_file_that_counts_from_0_is_told_so() {
    let threads =
        TWILL.replace("[THREADING]\n1=1\n2=2\n3=3\n4=4\n5=1\n", "[THREADING]\n0=1\n1=2\n2=3\n3=4\n4=1\n");
    refused(&threads, &["line 26: [THREADING] 0 is \"1\"", "counts from 0"]);
    let picks = TWILL.replace("[TREADLING]\n1=1\n2=2\n3=3\n4=4\n", "[TREADLING]\n0=1\n1=2\n2=3\n3=4\n");
    refused(&picks, &["[TREADLING] 0 is", "counts from 0"]);
    let treadles =
        TWILL.replace("[TIEUP]\n1=1,2\n2=2,3\n3=3,4\n4=4,1\n", "[TIEUP]\n0=1,2\n1=2,3\n2=3,4\n3=4,1\n");
    refused(&treadles, &["[TIEUP] 0 is", "counts from 0"]);
    let shafts =
        TWILL.replace("[THREADING]\n1=1\n2=2\n3=3\n4=4\n5=1\n", "[THREADING]\n1=0\n2=1\n3=2\n4=3\n5=0\n");
    let shafts =
        shafts.replace("[TIEUP]\n1=1,2\n2=2,3\n3=3,4\n4=4,1\n", "[TIEUP]\n1=0,1\n2=1,2\n3=2,3\n4=3,0\n");
    refused(&shafts, &["[THREADING] 1 is \"0\"", "shafts are counted from 1", "from 0"]);
    // If the loom has more shafts, or an unknown number, the file is read: an end may be on no
    // shaft, and a treadle tied to none.
    for weaving in ["Shafts=8\n", ""] {
        let design = read_text(shafts.replace("Shafts=4\n", weaving)).unwrap();
        let told =
            |warning: &String| warning.contains("[THREADING] 1 is shaft 0") && warning.contains("from 1");
        assert!(design.warnings().iter().any(told), "{weaving:?}: {:?}", design.warnings());
    }
    // A file that counts treadles from 0 in the tie-up and in the treadling is refused, too.
    let pressed = treadles.replace("[TREADLING]\n1=1\n2=2\n3=3\n4=4\n", "[TREADLING]\n1=0\n2=1\n3=2\n4=3\n");
    refused(&pressed, &["counts from 0"]);
    // A surplus line without a value is left out.
    assert_eq!(drawdown(&TWILL.replace("[THREADING]\n", "[THREADING]\n0=\n")), TWILL_DRAWDOWN);
}

#[test]
fn a_number_with_zeros_or_a_sign_before_it_is_the_same_key() {
    // The key is tried alone, and after the key in its usual spelling, whose value it replaces.
    for key in ["01", "0001", "+1"] {
        let alone = TWILL.replace("[THREADING]\n1=1\n", &format!("[THREADING]\n{key}=1\n"));
        assert_eq!(drawdown(&alone), TWILL_DRAWDOWN, "{key}");
        let again = TWILL.replace("[THREADING]\n1=1\n", &format!("[THREADING]\n1=3\n{key}=1\n"));
        assert_eq!(drawdown(&again), TWILL_DRAWDOWN, "{key}");
    }
    let shafts = TWILL.replace("[TIEUP]\n1=1,2\n2=2,3\n", "[TIEUP]\n01=4\n1=1,2\n2=2,3\n");
    assert_eq!(drawdown(&shafts), TWILL_DRAWDOWN);
    // A colour with several such keys has the value of the last one.
    let colors = TWILL.to_owned() + "[COLOR TABLE]\n9=9,9,9\n09=1,1,1\n[WARP COLORS]\n1=9\n+1=9\n";
    for _ in 0..10 {
        let cloth = cloth(&colors);
        assert_eq!(cloth.materials()[cloth.warp()[0].material as usize].srgb, [1, 1, 1]);
    }
    // The first of two faults is reported, every time.
    for _ in 0..10 {
        refused(&(TWILL.to_owned() + "[COLOR TABLE]\n9=9,9\n8=x\n"), &["[COLOR TABLE] 9"]);
    }
}

#[test]
fn a_set_without_a_unit_has_that_of_the_other() {
    for (set, other) in [("WARP", "WEFT"), ("WEFT", "WARP")] {
        let inches = TWILL.replace("Units=Centimeters", "Units=Inches");
        let start = inches.find(&format!("[{set}]")).unwrap();
        let text = inches[..start].to_owned() + &inches[start..].replacen("Units=Inches\n", "", 1);
        let design = read_text(&text).unwrap();
        assert_eq!(cloth(&text), cloth(&inches));
        let warnings = design.warnings();
        assert!(
            warnings.len() == 1
                && warnings[0].contains(&format!("[{set}] has no Units; Inches, as in [{other}]")),
            "{warnings:?}"
        );
    }
    assert!((cloth(&TWILL.replace("Units=Centimeters\n", "")).warp()[0].spacing_mm - 2.0).abs() < 1e-12);
}

#[test]
fn files_that_are_not_there_or_not_drafts() {
    let missing = read("no/such/draft.wif").unwrap_err();
    assert!(missing.to_string().contains("draft.wif") && missing.source().is_some());
    let unknown = read("draft.docx").unwrap_err().to_string();
    assert!(unknown.contains(".wif, .toml"), "{unknown}");
}
