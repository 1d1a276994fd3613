//! WIF drafts: what is taken, what is refused, and that both ways of telling a lift give one cloth.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test may panic")]

use std::error::Error;

use texere_core::Origin;
use texere_fabric::Woven;
use texere_formats::{Design, ReadError, Structure, read};

/// A straight 2/2 twill on four shafts, five ends by four picks, in centimetres.
const TWILL: &str = "[WIF]\nVersion=1.1\n[WEAVING]\nShafts=4\nTreadles=4\nRising Shed=true\n\
    [WARP]\nThreads=5\nUnits=Centimeters\nSpacing=0.2\nThickness=0.1\nColor=1\n\
    [WEFT]\nThreads=4\nUnits=Centimeters\nSpacing=0.3\nThickness=0.1\nColor=2\n\
    [COLOR PALETTE]\nEntries=2\nRange=0,255\n[COLOR TABLE]\n1=10,20,30\n2=40,50,60\n\
    [THREADING]\n1=1\n2=2\n3=3\n4=4\n5=1\n\
    [TIEUP]\n1=1,2\n2=2,3\n3=3,4\n4=4,1\n[TREADLING]\n1=1\n2=2\n3=3\n4=4\n";

/// The lift plan that says the same as `TWILL`'s tie-up and treadling.
const LIFT_PLAN: &str = "[LIFTPLAN]\n1=1,2\n2=2,3\n3=3,4\n4=4,1\n";

/// What a weaver draws for `TWILL`: the last pick on top, end 1 on the left.
const TWILL_DRAWDOWN: &str = "10011\n00110\n01100\n11001\n";

fn read_text(text: impl AsRef<[u8]>) -> Result<Design, ReadError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("draft.wif");
    std::fs::write(&path, text).unwrap();
    read(&path)
}

fn cloth(text: &str) -> Woven {
    let Structure::Woven(woven) = read_text(text).unwrap().structure else { panic!("not woven") };
    woven
}

fn drawdown(text: &str) -> String {
    let woven = cloth(text);
    let drawdown = woven.drawdown();
    let row = |pick| (0..drawdown.ends()).map(move |end| if drawdown.up(end, pick) { '1' } else { '0' });
    (0..drawdown.picks()).rev().flat_map(|pick| row(pick).chain(['\n'])).collect()
}

/// The refusal's own line, which has to hold all of `parts`.
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
    // Both, and in agreement: nothing to warn of.
    assert!(read_text(TWILL.to_owned() + LIFT_PLAN).unwrap().warnings().is_empty());
    // Both, and at odds: the treadling stands.
    let odds = TWILL.to_owned() + &LIFT_PLAN.replace("1=1,2", "1=1,3");
    assert_eq!(drawdown(&odds), TWILL_DRAWDOWN);
    assert!(read_text(&odds).unwrap().warnings()[0].contains("lift plan and treadling"));
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
    // Pick 1 now lifts shafts 1 to 4; end 5 is up wherever shaft 1 or 3 is.
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
    // End 1 lies half its spacing from the edge of the cloth, end 2 its own spacing further on.
    let yarns = woven.yarns().unwrap();
    let x: Vec<_> = (0..5).map(|end| yarns.yarn_points(end).unwrap()[0].x).collect();
    assert_eq!(x, [1.0, 6.0, 8.0, 10.0, 12.0]);
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
    refused(&TWILL.replace("[THREADING]\n1=1", "[THREADING]\n1=7"), &["[THREADING] 1 is 7", "to 4"]);
    refused(
        &TWILL.replace("[THREADING]\n1=1", "[THREADING]\n1=x"),
        &["[THREADING] 1 is \"x\"", "whole numbers"],
    );
    refused(&TWILL.replace("Color=2", "Color=3"), &["[WEFT] color is 3", "1 to 2"]);
    refused(&(TWILL.to_owned() + "[WEFT COLORS]\n4=11\n"), &["[WEFT COLORS] 4 is 11", "1 to 2"]);
    refused(&TWILL.replace("[COLOR TABLE]", "[OTHER]"), &["[WARP] color", "[COLOR TABLE]"]);
    refused(&TWILL.replace("1=10,20,30", "1=10,20"), &["[COLOR TABLE] 1", "red, green and blue"]);
    refused(&TWILL.replace("Range=0,255", "Range=9,9"), &["[COLOR PALETTE] range"]);
    refused(&TWILL.replace("Spacing=0.2", "Spacing=-1"), &["[WARP] spacing is -1"]);
    refused(&TWILL.replace("Spacing=0.2", "Spacing=NaN"), &["[WARP] spacing is NaN"]);
    refused(&TWILL.replace("Spacing=0.2", "Spacing=wide"), &["[WARP] spacing is \"wide\""]);
    refused(&TWILL.replace("Units=Centimeters", "Units=ells"), &["[WARP] units is \"ells\"", "Decipoints"]);
    refused(&TWILL.replace("Rising Shed=true", "Rising Shed=maybe"), &["[WEAVING] rising shed is \"maybe\""]);
    refused("", &["Threads"]);
}

#[test]
fn files_that_are_not_there_or_not_drafts() {
    let missing = read("no/such/draft.wif").unwrap_err();
    assert!(missing.to_string().contains("draft.wif") && missing.source().is_some());
    let unknown = read("draft.docx").unwrap_err().to_string();
    assert!(unknown.contains(".wif, .toml"), "{unknown}");
}
