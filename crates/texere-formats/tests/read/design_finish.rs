//! The `[finish]` table of design files, and jammed cloth that is relieved.

use texere_core::Section;
use texere_core::crossings::Set;
use texere_core::settling::Length;
use texere_fabric::{Along, BySet, Finish, JamReport, RestBy, Stretch};
use texere_formats::Design;

use crate::design_file::{DENIM, read_text};

/// A jersey, to which tables are added.
const JERSEY: &str = "[knit]\nchart = \"k\"\nloop_length_mm = 3.2\n[yarns.ecru]\ntex = 20.0\n";

#[test]
fn yarns_settle_as_the_finish_table_says() {
    for text in [DENIM, JERSEY] {
        let plain = read_text(text).unwrap();
        assert_eq!((plain.settle, plain.finish), (true, Finish::default()));
    }
    let finished = |text: &str, table: &str| {
        let design = read_text(&format!("{text}[finish]\n{table}")).unwrap();
        (design.settle, design.finish)
    };
    // Keys that say how yarns settle do not decide whether they settle.
    let pressed = Finish { press_mm: Some(0.4), ..Finish::default() };
    assert_eq!(finished(JERSEY, "settle = false\npress = 0.4\n"), (false, pressed));
    let of = |length| Finish { length: Some(length), ..Finish::default() };
    assert_eq!(finished(JERSEY, "settle = true\nlength = \"held\"\n"), (true, of(Length::Held)));
    let free = "length = \"free\"\n";
    assert_eq!(finished(JERSEY, free), (true, of(Length::Free { tension: 0.0 })));
    let tension = of(Length::Free { tension: 0.05 });
    assert_eq!(finished(JERSEY, &format!("{free}tension = 0.05\n")).1, tension);
    assert_eq!(finished(JERSEY, "length = 1.25\n").1, of(Length::Given(1.25)));
    let energy = Finish { by: RestBy::Energy, ..Finish::default() };
    assert_eq!(finished(JERSEY, "rest = \"energy\"\n"), (true, energy));
    for along in Along::ALL {
        let held = Finish { hold: Some(along), ..energy };
        let table = format!("rest = \"energy\"\nhold = \"{}\"\n", along.name());
        assert_eq!(finished(JERSEY, &table), (true, held));
    }
    assert_eq!(finished(JERSEY, "rest = \"clear\"\n"), (true, Finish::default()));
    let long = Finish { length: Some(Length::Given(1.25)), ..energy };
    assert_eq!(finished(JERSEY, "rest = \"energy\"\nlength = 1.25\n").1, long);
    assert_eq!(finished(JERSEY, "length = 2\n").1, of(Length::Given(2.0)));
    let woven = Finish { taut: BySet { warp: 3.0, weft: 0.5 }, calender: 2.0, ..Finish::default() };
    assert_eq!(finished(DENIM, "warp_tension = 3\nweft_tension = 0.5\ncalender = 2\n"), (true, woven));
    assert!(!finished(DENIM, "settle = false\n").0);
    let stretch = |table: &str| read_text(&format!("{DENIM}[finish]\n{table}")).unwrap().stretch;
    assert_eq!(stretch("calender = 2\n"), None);
    assert_eq!(stretch("stretch_warp = 1.03\n"), Some(Stretch { along: Set::Warp, by: 1.03 }));
    assert_eq!(stretch("stretch_weft = 1\n"), Some(Stretch { along: Set::Weft, by: 1.0 }));
}

#[test]
fn a_finish_that_can_not_be_is_refused_with_its_line() {
    let refused = |text: &str, table: &str, parts: &[&str]| {
        let error = read_text(&format!("{text}[finish]\n{table}")).expect_err(table).to_string();
        for part in parts {
            assert!(error.contains(part), "\"{error}\" lacks \"{part}\"");
        }
    };
    let settle = &["design.toml, line 20", "finish.settle", "\"1\"", "true or false"];
    refused(DENIM, "settle = 1\n", settle);
    refused(JERSEY, "press = 0.0\n", &["line 7", "finish.press", "0", "0.001", "1000"]);
    refused(JERSEY, "press = \"hard\"\n", &["line 7", "finish.press", "hard", "number of mm"]);
    refused(JERSEY, "length = 2.5\n", &["line 7", "finish.length", "2.5", "0.5", "2"]);
    refused(
        JERSEY,
        "length = \"long\"\n",
        &["finish.length", "long", "\"held\", \"free\" or how many times"],
    );
    let free = "length = \"free\"\n";
    refused(JERSEY, &format!("{free}tension = 0.2\n"), &["line 8", "finish.tension", "0.2", "0.1"]);
    refused(JERSEY, "tension = 0.05\n", &["line 7", "finish.tension", "without finish.length = \"free\""]);
    let energy = "rest = \"energy\"\n";
    refused(JERSEY, "rest = \"well\"\n", &["line 7", "finish.rest", "well", "\"clear\" or \"energy\""]);
    refused(JERSEY, &format!("{energy}{free}"), &["line 8", "finish.length", "free", "\"clear\""]);
    refused(JERSEY, &format!("{energy}press = 1.0\n"), &["line 8", "finish.press", "only with", "\"clear\""]);
    let held = format!("{energy}hold = \"tight\"\n");
    refused(JERSEY, &held, &["line 8", "finish.hold", "tight", "\"courses\", \"wales\" or \"both\""]);
    refused(JERSEY, "hold = \"wales\"\n", &["line 7", "finish.hold", "only with finish.rest = \"energy\""]);
    refused(DENIM, "hold = \"wales\"\n", &["line 20", "finish.hold", "only in a knit"]);
    refused(DENIM, energy, &["line 20", "finish.rest", "only in a knit"]);
    refused(DENIM, "presses = 1.0\n", &["line 20", "presses", "press"]);
    refused(DENIM, "calender = 11\n", &["line 20", "finish.calender", "11", "0", "10"]);
    refused(DENIM, "warp_tension = \"high\"\n", &["line 20", "finish.warp_tension", "high", "a number"]);
    refused(DENIM, "stretch_warp = 2.5\n", &["line 20", "finish.stretch_warp", "2.5", "0.5", "2"]);
    refused(
        DENIM,
        "stretch_warp = 1.1\nstretch_weft = 1.1\n",
        &["line 21", "finish.stretch_weft", "not both"],
    );
    refused(JERSEY, "stretch_warp = 1.1\n", &["line 7", "finish.stretch_warp", "only in woven cloth"]);
    // Keys that only another kind of cloth has are refused.
    for table in ["length = 1.2\n", "tension = 0.01\n", "press = 1.0\n"] {
        refused(DENIM, table, &["line 20", "finish.", "only in a knit", "calender"]);
    }
    for table in ["warp_tension = 2\n", "weft_tension = 2\n", "calender = 2\n"] {
        refused(JERSEY, table, &["line 7", "finish.", "only in woven cloth", "press"]);
    }
}

/// Keys that make room in cloth as woven are refused in cloth at rest. Keys without effect there
/// are reported.
#[test]
fn cloth_at_rest_gives_way_by_itself() {
    for jam in ["flatten", "shrink"] {
        let table = format!("{DENIM}[cloth]\njam = \"{jam}\"\n");
        let error = read_text(&table).unwrap_err().to_string();
        assert!(error.contains("line 20: cloth.jam") && error.contains("finish.settle = false"), "{error}");
        assert!(read_text(&format!("{table}[finish]\nsettle = false\n")).is_ok());
    }
    let table = format!("{DENIM}[cloth]\nshape = \"crossing\"\nwarp_crimp = 0.5\n");
    let remarks = read_text(&table).unwrap().remarks().join("\n");
    for key in ["cloth.shape", "cloth.warp_crimp"] {
        assert!(remarks.contains(&format!("{key} counts for nothing in cloth at rest")), "{remarks}");
    }
    assert!(read_text(&format!("{table}[finish]\nsettle = false\n")).unwrap().remarks().is_empty());
    // A yarn's own flatness counts in cloth at rest.
    let flat = DENIM.replacen("tex = ", "flatness = 1.5\ntex = ", 1);
    assert_ne!(flat, DENIM);
    assert!(read_text(&flat).unwrap().remarks().is_empty());
}

fn jams(design: &Design) -> JamReport {
    *design.structure.woven().unwrap().jam_report()
}

#[test]
fn jammed_threads_are_relieved_as_the_design_says() {
    // Ends of 0.3 mm, 0.4 mm apart. Picks of 0.25 mm need more room to cross them.
    let dense = DENIM.replace("tex = 84.0", "diameter_mm = 0.3").replace("per_cm = 12.5", "spacing_mm = 0.4");
    let read = |jam: &str| read_text(&format!("{dense}[finish]\nsettle = false\n[cloth]\n{jam}")).unwrap();
    let report = read("");
    assert!(jams(&report).before.warp.jammed > 0 && jams(&report).after == jams(&report).before);
    let told = report.warnings().join("\n");
    assert!(
        told.contains("threads that cross pierce one another") && told.contains("has 0.4000 mm"),
        "{told}"
    );
    // Plies can't be flattened. The dense ends take a larger share of the crimp, which makes enough
    // room.
    for jam in ["jam = \"flatten\"\n", "jam = \"shrink\"\n"] {
        let relieved = read(jam);
        assert_eq!(jams(&relieved).before, jams(&report).before);
        assert_eq!(
            jams(&relieved).after.map(|set| set.jammed),
            BySet { warp: 0, weft: 0 },
            "{:?}",
            jams(&relieved)
        );
        assert!(relieved.warnings().is_empty());
    }
    // A share of the crimp that is given stays, so that threads have to become thinner.
    let shrunk = read("jam = \"shrink\"\nwarp_crimp = 0.5\n");
    assert!(jams(&shrunk).scaled < 1.0 && jams(&shrunk).warp_share == [0.5; 2], "{:?}", jams(&shrunk));
    let woven = shrunk.structure.woven().unwrap().cloth();
    assert!((woven.warp()[0].radius_mm / 0.15 - jams(&shrunk).scaled).abs() < 1e-6);
}

#[test]
fn another_section_is_relieved_anew() {
    let dense = DENIM.replace("tex = 84.0", "diameter_mm = 0.3").replace("per_cm = 12.5", "spacing_mm = 0.4");
    let text = format!("{dense}[finish]\nsettle = false\n[cloth]\njam = \"shrink\"\nwarp_crimp = 0.5\n");
    let round = |sections: &[Section]| {
        let mut design = read_text(&text).unwrap();
        for section in sections {
            design.structure.set_section(section.clone()).unwrap();
        }
        assert!(jams(&design).scaled < 1.0, "{:?}", jams(&design));
        let woven = design.structure.woven().unwrap().cloth().clone();
        (jams(&design), woven.weft()[0].radius_mm)
    };
    // Relief begins from the threads as designed, not from an earlier relief.
    let wide = Section::Ellipse { aspect: 3.0 };
    assert_eq!(round(&[wide, Section::Circle]), round(&[Section::Circle]));
}
