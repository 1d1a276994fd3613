//! Design files of texere: values that are accepted, and faults that are named with their lines.

use texere_core::Section;
use texere_core::crossings::Set;
use texere_core::settling::Length;
use texere_fabric::{Along, BySet, Crimp, Finish, JamReport, RestBy, Shape, Stretch, Woven};
use texere_formats::{Design, ReadError, read};

use crate::read_file;

const DENIM: &str = r##"name = "Denim"
[weave]
notation = "3/1"
ends = 7
picks = 5
[yarns.indigo]
tex = 84.0
color = "#2b3f6b"
twist_per_m = -500.0
[yarns.ecru]
diameter_mm = 0.25
plies = 2
[warp]
yarns = ["2 indigo", "ecru"]
per_cm = 12.5
[weft]
yarns = ["ecru"]
spacing_mm = 1.25
"##;

fn read_text(text: &str) -> Result<Design, ReadError> {
    read_file("design.toml", text)
}

fn cloth(text: &str) -> Woven {
    read_text(text).unwrap().structure.woven().unwrap().cloth().clone()
}

/// `DENIM` with `from` replaced by `to` has to be refused, with a message that has all of `parts`.
fn refused(from: &str, to: &str, parts: &[&str]) {
    assert!(DENIM.contains(from), "the fixture lacks {from}");
    let error = read_text(&DENIM.replacen(from, to, 1)).expect_err(to);
    for part in parts {
        assert!(error.to_string().contains(part), "\"{error}\" lacks \"{part}\"");
    }
}

#[test]
fn every_key_arrives() {
    let woven = cloth(DENIM);
    assert_eq!((woven.drawdown().ends(), woven.drawdown().picks()), (7, 5));
    let names: Vec<_> =
        woven.warp().iter().map(|end| woven.materials()[end.material as usize].name.as_str()).collect();
    assert_eq!(names, ["indigo", "indigo", "ecru", "indigo", "indigo", "ecru", "indigo"]);
    let (end, pick) = (woven.warp()[0], woven.weft()[0]);
    assert_eq!((end.spacing_mm, pick.spacing_mm), (0.8, 1.25));
    assert_eq!(woven.materials()[end.material as usize].srgb, [0x2b, 0x3f, 0x6b]);
    assert_eq!(woven.materials()[end.material as usize].tex, Some(84.0));
    // 500 turns S per metre are half a turn, -π, per millimetre.
    assert!((end.twist + std::f32::consts::PI).abs() < 1e-6);
    assert_eq!(woven.sections()[pick.section as usize], Section::plied(2));
    assert_eq!(pick.radius_mm, 0.125);
    // Peirce's cotton: 1/28 inch for the count 1, and 84 tex is count 590.5/84.
    assert!((end.radius_mm * 2.0 - 25.4 / (28.0 * (590.5f32 / 84.0).sqrt())).abs() < 2e-3);
}

/// Plies may be pressed into one another.
#[test]
fn a_valley_lies_between_plies() {
    let pressed = Section::Lobed { plies: 2, valley: 0.75 };
    assert!(cloth(&DENIM.replace("plies = 2", "plies = 2\nvalley = 0.75")).sections().contains(&pressed));
    let needs = ["valley", "is given without plies of 2 or more, which it belongs to"];
    refused("plies = 2", "valley = 0.75", &needs);
    refused("plies = 2", "plies = 1\nvalley = 0.75", &needs);
    refused("plies = 2", "plies = 2\nvalley = 0.4", &["yarns.ecru.valley", "is 0.4, outside 0.5 to 1"]);
    refused("plies = 2", "section = { shape = \"circle\" }\nvalley = 0.6", &needs);
    let both = "section = { shape = \"circle\" }\nplies = 2\nvalley = 0.6";
    refused("plies = 2", both, &["give exactly one of section and plies"]);
}

/// Fibres stand off spun staple, which has twist, and not off filament. A design may state the
/// hairiness itself.
#[test]
fn yarns_of_every_structure_have_their_hairiness() {
    let jersey = "[knit]\nchart = \"k\"\nrepeat = [4, 4]\nloop_length_mm = 3.2\n";
    let tricot = "[warp_knit]\nwales = 4\ncourses = 4\nwales_per_cm = 10.0\ncourses_per_cm = 13.0\n\
        [[warp_knit.bars]]\nlapping = \"tricot\"\n";
    let plain = "[weave]\nnotation = \"plain\"\nends = 4\npicks = 4\n[warp]\nyarns = [\"ecru\"]\nper_cm = 12.0\n\
        [weft]\nyarns = [\"ecru\"]\nper_cm = 12.0\n";
    for structure in [jersey, tricot, plain] {
        for (said, hairiness) in [
            ("", 0.0),
            ("twist_per_m = -700.0", 5.0),
            ("hairiness = 8.5", 8.5),
            ("twist_per_m = 9.0\nhairiness = 0", 0.0),
        ] {
            let text = format!("{structure}[yarns.ecru]\ntex = 20.0\n{said}\n");
            let yarns = read_text(&text).unwrap().structure.yarns().unwrap();
            let material = yarns.layout().yarns()[0].material as usize;
            assert_eq!(yarns.materials()[material].hairiness, hairiness, "{text}");
        }
    }
}

/// A yarn has the bending stiffness that the design states. Otherwise the stiffness follows from
/// the yarn's fibre and tex. Cotton, and yarn without tex, have no stiffness of their own.
#[test]
fn yarns_bend_as_their_fibres_do() {
    for (said, bending) in [
        ("tex = 20.0", None),
        ("diameter_mm = 0.2\nfibre = \"wool\"", None),
        ("tex = 20.0\nfibre = \"cotton\"", None),
        ("tex = 20.0\nfibre = \"polyester\"", Some(20.0 * 9.46e-5)),
        ("cotton_count = 29.526\nfibre = \"polyester\"", Some(20.0 * 9.46e-5)),
        ("tex = 20.0\nfibre = \"wool\"\nbending_stiffness = 0.045", Some(0.045)),
        ("diameter_mm = 0.2\nbending_stiffness = 0.045", Some(0.045)),
    ] {
        let text =
            format!("[knit]\nchart = \"k\"\nrepeat = [4, 4]\nloop_length_mm = 3.2\n[yarns.ecru]\n{said}\n");
        let yarns = read_text(&text).unwrap().structure.yarns().unwrap();
        let material = yarns.layout().yarns()[0].material as usize;
        match (yarns.materials()[material].bending, bending) {
            (Some(found), Some(bending)) => assert!((found / bending - 1.0).abs() < 2e-3, "{said}: {found}"),
            (found, bending) => assert_eq!(found, bending, "{said}"),
        }
    }
}

#[test]
fn sections_have_their_numbers() {
    for (text, section) in [
        ("{ shape = \"circle\" }", Section::Circle),
        ("{ shape = \"ellipse\", aspect = 2.0 }", Section::Ellipse { aspect: 2.0 }),
        ("{ shape = \"lenticular\", aspect = 3.0 }", Section::Lenticular { aspect: 3.0, distortion: 0.0 }),
        (
            "{ shape = \"power-ellipse\", aspect = 2.0, exponent = 0.5 }",
            Section::PowerEllipse { aspect: 2.0, exponent: 0.5 },
        ),
        (
            "{ shape = \"polygon\", corners = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]] }",
            Section::Polygon(vec![[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]]),
        ),
    ] {
        let woven = cloth(&DENIM.replace("plies = 2", &format!("section = {text}")));
        assert_eq!(woven.sections()[woven.weft()[0].section as usize], section);
    }
}

#[test]
fn threads_lie_as_the_cloth_table_says() {
    let plain = cloth(DENIM);
    assert_eq!((plain.shape(), plain.crimp(), plain.selvedge()), (Shape::Round, Crimp::Stiffness, false));
    let table = "[cloth]\nshape = \"crossing\"\nwarp_crimp = 0.25\nselvedge = true\njam = \"report\"\n";
    let woven = cloth(&format!("{DENIM}{table}"));
    assert_eq!(
        (woven.shape(), woven.crimp(), woven.selvedge()),
        (Shape::Crossing, Crimp::WarpShare(0.25), true)
    );
    // A number may be written as a whole number, without a point.
    assert_eq!(cloth(&format!("{DENIM}[cloth]\nwarp_crimp = 1\n")).crimp(), Crimp::WarpShare(1.0));
    // One weft yarn instead of five equal ones.
    let yarns = |text: &str| read_text(text).unwrap().yarns().unwrap().layout().yarns().len();
    assert_eq!((yarns(DENIM), yarns(&format!("{DENIM}{table}"))), (7 + 5, 7 + 1));
}

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

/// Mills give counts and threads per inch.
#[test]
fn yarns_and_setts_are_told_as_mills_do() {
    let text = |yarn: &str, sett: &str| {
        format!(
            "[weave]\nnotation = \"plain\"\nends = 4\npicks = 4\n[yarns.a]\n{yarn}\n[warp]\nyarns = [\"a\"]\n{sett}\n[weft]\nyarns = [\"a\"]\nper_cm = 8.0\n"
        )
    };
    let design = read_text(&text("cotton_count = 10", "per_inch = 20.0")).unwrap();
    let woven = design.structure.woven().unwrap().cloth();
    assert!((woven.materials()[0].tex.unwrap() - 59.05).abs() < 0.01);
    // Peirce: 1/28 inch over the root of the count.
    assert!((f64::from(woven.warp()[0].radius_mm) * 2.0 - 25.4 / 28.0 / 10f64.sqrt()).abs() < 1e-3);
    assert!((woven.warp()[0].spacing_mm - 1.27).abs() < 1e-9);
    // A quarter of the density gives twice the diameter.
    let fluffy = read_text(&text("tex = 59.05\ndensity = 0.2272727", "per_inch = 20.0")).unwrap();
    let ratio = fluffy.structure.woven().unwrap().cloth().warp()[0].radius_mm / woven.warp()[0].radius_mm;
    assert!((ratio - 2.0).abs() < 1e-3, "{ratio}");
    for (yarn, sett, parts) in [
        ("cotton_count = 10\ntex = 59", "per_cm = 8.0", &["cotton_count", "not both"][..]),
        ("cotton_count = 0", "per_cm = 8.0", &["cotton_count", "0.01"]),
        ("tex = 20\ndensity = 0.0", "per_cm = 8.0", &["density", "0.05"]),
        ("tex = 20", "per_cm = 8.0\nper_inch = 20.0", &["exactly one", "warp.per_inch"]),
        ("color = \"#ffffff\"", "per_cm = 8.0", &["yarns.a.diameter_mm", "cotton_count"]),
    ] {
        let error = read_text(&text(yarn, sett)).unwrap_err().to_string();
        assert!(parts.iter().all(|part| error.contains(part)), "{error}");
    }
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

#[test]
fn a_dash_that_looks_like_a_hyphen_is_named() {
    let number = "diameter_mm = \u{2212}0.3";
    let text =
        |line: &str| format!("[weave]\nnotation = \"plain\"\nends = 4\npicks = 4\n{line}\n[yarns.a]\n");
    for (line, sign) in [
        (number, "a minus sign (U+2212), not a hyphen"),
        ("end\u{2013}count = 3", "an en dash (U+2013), not a hyphen"),
        ("rows = \"last\u{2011}pick-first\"", "a non-breaking hyphen (U+2011), not a hyphen"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("design.toml");
        std::fs::write(&path, text(line)).unwrap();
        let told = read(&path).unwrap_err().to_string();
        assert!(told.contains("line 5") && told.contains(sign), "{told}");
    }
}

#[test]
fn a_list_of_spacings_is_repeated() {
    let woven = cloth(&DENIM.replace("per_cm = 12.5", "spacing_mm = [0.9, 0.3, 0.4]"));
    let spacings: Vec<_> = woven.warp().iter().map(|end| end.spacing_mm).collect();
    assert_eq!(spacings, [0.9, 0.3, 0.4, 0.9, 0.3, 0.4, 0.9]);
}

#[test]
fn faults_of_the_cloth_table_are_named() {
    let cloth = |key: &str, parts: &[&str]| {
        let to = format!("[cloth]\n{key}\n[yarns.indigo]");
        refused("[yarns.indigo]", &to, &[&["design.toml, line 7: cloth."], parts].concat());
    };
    let shapes = "expected \"round\" or \"crossing\"";
    cloth("shape = \"square\"", &["cloth.shape is \"square\"", shapes]);
    cloth("shape = 3", &["cloth.shape is \"3\"", shapes]);
    cloth("shape = \"Round\"", &["cloth.shape is \"Round\"", shapes]);
    cloth("warp_crimp = -0.01", &["cloth.warp_crimp is -0.01, outside 0 to 1"]);
    cloth("warp_crimp = 1.5", &["cloth.warp_crimp is 1.5, outside 0 to 1"]);
    cloth("warp_crimp = nan", &["cloth.warp_crimp is NaN, outside 0 to 1"]);
    cloth("warp_crimp = inf", &["cloth.warp_crimp is inf, outside 0 to 1"]);
    cloth("warp_crimp = \"half\"", &["cloth.warp_crimp is \"half\"", "a number from 0 to 1"]);
    cloth("selvedge = \"yes\"", &["cloth.selvedge is \"yes\"", "true or false"]);
    cloth("selvedge = 1", &["cloth.selvedge is \"1\"", "true or false"]);
    cloth("jam = \"squeeze\"", &["cloth.jam is \"squeeze\"", "\"report\" or \"flatten\" or \"shrink\""]);
    cloth("jam = true", &["cloth.jam is \"true\"", "\"shrink\""]);
    refused(
        "[yarns.indigo]",
        "[cloth]\nselvage = true\n[yarns.indigo]",
        &["line 7", "did you mean \"selvedge\"?"],
    );
    refused("[yarns.indigo]", "[cloth]\ncolour = 1\n[yarns.indigo]", &["line 7", "\"colour\" is not known"]);
    refused(
        "spacing_mm = 1.25",
        "spacing_mm = []",
        &["line 18: weft.spacing_mm is \"[]\"", "a list of them"],
    );
    refused(
        "spacing_mm = 1.25",
        "spacing_mm = [1.0, \"b\"]",
        &["line 18: weft.spacing_mm", "a list of them"],
    );
    refused(
        "spacing_mm = 1.25",
        "spacing_mm = [1.0, 0.0]",
        &["line 18", "number 2, is 0, outside 0.001 to 1000"],
    );
    refused("spacing_mm = 1.25", "spacing_mm = \"wide\"", &["line 18: weft.spacing_mm is \"wide\""]);
    refused(
        "spacing_mm = 1.25",
        "spacing_mm = -1",
        &["line 18: weft.spacing_mm is -1, outside 0.001 to 1000"],
    );
    refused("spacing_mm = 1.25", "spacing_mm = nan", &["weft.spacing_mm is NaN"]);
}

#[test]
fn threads_too_thin_to_shrink_are_refused() {
    let thin = DENIM
        .replace("tex = 84.0", "diameter_mm = 1000")
        .replace("diameter_mm = 0.25", "diameter_mm = 0.001");
    let dense = thin.replace("per_cm = 12.5", "spacing_mm = 0.001");
    let error =
        read_text(&format!("{dense}[finish]\nsettle = false\n[cloth]\njam = \"shrink\"\n")).unwrap_err();
    let cause = std::error::Error::source(&error).unwrap().to_string();
    assert!(
        error.to_string().contains("design.toml") && cause.contains("radius of end 3"),
        "{error}: {cause}"
    );
}

#[test]
fn a_draft_from_a_wif_file_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    let wif = "[WARP]\nThreads=4\nSpacing=0.1\nUnits=cm\n[WEFT]\nThreads=2\nSpacing=0.1\nUnits=cm\n\
               [THREADING]\n1=1\n2=2\n3=1\n4=2\n[LIFTPLAN]\n1=1\n2=2\n";
    std::fs::write(folder.path().join("draft.wif"), wif).unwrap();
    let path = folder.path().join("design.toml");
    std::fs::write(&path, "[weave]\nwif = \"draft.wif\"\n[yarns.a]\ndiameter_mm = 0.1\ncolor = \"#010203\"\n[weft]\nyarns = [\"a\"]\nper_cm = 20.0\n").unwrap();
    let woven = read(&path).unwrap().structure.woven().unwrap().cloth().clone();
    assert!(woven.drawdown().up(0, 0) && !woven.drawdown().up(1, 0));
    assert_eq!((woven.warp()[0].spacing_mm, woven.weft()[0].spacing_mm), (1.0, 0.5));
    assert_eq!(woven.materials()[woven.weft()[1].material as usize].srgb, [1, 2, 3]);
}

#[test]
fn faults_are_named_with_their_line() {
    refused("ends = 7", "end = 7", &["line 4", "\"end\"", "did you mean \"ends\"?"]);
    refused("per_cm = 12.5", "per_metre = 30.0", &["line 15", "\"per_metre\""]);
    refused("color", "colour", &["line 8", "\"colour\"", "\"color\""]);
    refused("ends = 7", "ends = 0", &["line 4", "weave.ends is 0", "1 to"]);
    refused("ends = 7", "ends = 4000000000", &["weave.ends", "1 to"]);
    refused("ends = 7", "ends = \"seven\"", &["line 4"]);
    refused("ends = 7\n", "", &["weave.ends"]);
    refused("notation = \"3/1\"", "notation = \"3/1\"\nwif = \"a.wif\"", &["exactly one", "weave.wif"]);
    refused("notation = \"3/1\"", "wif = \"a.toml\"", &["exactly one"]);
    refused("notation = \"3/1\"\nends = 7\npicks = 5", "wif = \"a.toml\"", &["weave.wif", ".wif file"]);
    refused("tex = 84.0", "tex = -1.0", &["line 7", "yarns.indigo.tex is -1"]);
    refused("tex = 84.0", "tex = nan", &["yarns.indigo.tex is NaN"]);
    refused("tex = 84.0", "tex = inf", &["yarns.indigo.tex is inf"]);
    refused("tex = 84.0\n", "", &["yarns.indigo.diameter_mm"]);
    refused("diameter_mm = 0.25", "diameter_mm = 0.0", &["yarns.ecru.diameter_mm is 0"]);
    refused("#2b3f6b", "#2b3f6", &["line 8", "a colour like"]);
    refused("#2b3f6b", "#+b3f6b", &["a colour like"]);
    refused("plies = 2", "plies = 99", &["line 12", "yarns.ecru.plies is 99"]);
    refused("plies = 2", "plies = 2\nsection = { shape = \"circle\" }", &["exactly one", "plies"]);
    refused(
        "plies = 2",
        "section = { shape = \"ellipse\", aspect = 99.0 }",
        &["line 12", "yarns.ecru.section"],
    );
    refused("plies = 2", "section = { shape = \"blob\" }", &["line 12", "blob"]);
    refused("twist_per_m = -500.0", "twist_per_m = 1e9", &["yarns.indigo.twist_per_m"]);
    refused("twist_per_m = -500.0", "fibre = \"hemp\"", &["line 9", "yarns.indigo.fibre", "hemp", "wool"]);
    refused("twist_per_m = -500.0", "packing = 0.95", &["yarns.indigo.packing", "0.95", "0.1", "0.91"]);
    refused("twist_per_m = -500.0", "stiffness = 200.0", &["yarns.indigo.stiffness", "200", "0.01", "100"]);
    for value in ["-0.1", "30.5", "nan"] {
        let line = format!("twist_per_m = -500.0\nhairiness = {value}");
        refused("twist_per_m = -500.0", &line, &["line 10", "yarns.indigo.hairiness", "0", "30"]);
    }
    refused("\"2 indigo\"", "\"2 denim\"", &["line 14", "\"2 denim\"", "\"ecru\", \"indigo\""]);
    refused("\"2 indigo\"", "\"0 indigo\"", &["\"0 indigo\"", "a number from 1"]);
    refused("[\"2 indigo\", \"ecru\"]", "[]", &["warp.yarns", "at least one"]);
    refused("per_cm = 12.5", "per_cm = 12.5\nspacing_mm = 0.8", &["exactly one", "warp.spacing_mm"]);
    refused("spacing_mm = 1.25\n", "", &["exactly one", "weft.spacing_mm"]);
    refused("[weft]\nyarns = [\"ecru\"]\nspacing_mm = 1.25\n", "", &["weft"]);
    refused("[weave]", "[weave", &["line 2"]);
}

#[test]
fn a_value_of_the_wrong_kind_is_named_with_its_key() {
    refused("ends = 7", "ends = \"seven\"", &["line 4: weave.ends is \"seven\"", "a whole number"]);
    refused("ends = 7", "ends = 7.5", &["line 4: weave.ends is \"7.5\"", "a whole number"]);
    refused("tex = 84.0", "tex = true", &["line 7: yarns.indigo.tex is \"true\"", "a number"]);
    refused("\"3/1\"", "[3, 1]", &["line 3: weave.notation is \"[3, 1]\"", "text in quotes"]);
    refused("[\"ecru\"]", "\"ecru\"", &["line 17: weft.yarns is \"ecru\"", "a list"]);
    refused("[\"ecru\"]", "[\"ecru\", 3]", &["line 17: weft.yarns is \"3\"", "text in quotes"]);
    refused("name = \"Denim\"", "name = 3", &["line 1: name is \"3\"", "text in quotes"]);
    refused("plies = 2", "section = 3", &["line 12: yarns.ecru.section is \"3\"", "a table"]);
    refused(
        "plies = 2",
        "section = { shape = \"blob\" }",
        &["line 12: yarns.ecru.section", "blob", "polygon"],
    );
    refused("plies = 2", "section = { shape = \"ellipse\" }", &["line 12: yarns.ecru.section", "aspect"]);
    refused(
        "plies = 2",
        "section = { shape = \"ellipse\", aspect = \"wide\" }",
        &["line 12: yarns.ecru.section", "wide", "expected"],
    );
    refused("[warp]\nyarns = [\"2 indigo\", \"ecru\"]", "[warp]", &["line 13: warp", "missing", "yarns"]);
    refused("plies = 2", "diameter_mm = 3", &["line 12", "duplicate key"]);
}

#[test]
fn a_number_that_is_far_too_small_is_not_written_in_zeros() {
    refused("tex = 84.0", "tex = 1e-300", &["line 7: yarns.indigo.tex is 1e-300, outside 0.001 to 10000000"]);
    refused("tex = 84.0", "tex = -1e300", &["yarns.indigo.tex is -1e300"]);
}

/// A polygon whose outline faces nowhere at a corner is refused at its line in the file. The edges
/// at such a corner are too short to have a direction, or they point opposite ways.
#[test]
fn a_polygon_without_a_direction_is_refused() {
    let corners = |corners: &str, parts: &[&str]| {
        let section = format!("section = {{ shape = \"polygon\", corners = {corners} }}");
        refused("plies = 2", &section, &[&["line 12: yarns.ecru.section"], parts].concat());
    };
    corners("[[1e-30, 0.0], [0.0, 1e-30], [-1e-30, 0.0]]", &["corner 1", "too small or too sharp"]);
    corners("[[1.0, 0.0], [1.0, 1e-30], [-1.0, 0.0]]", &["corner", "too small or too sharp"]);
    // A needle-shaped section: after rounding, both edges at its point are equal and opposite.
    corners("[[-1.0, 0.0], [1.0, 1e-45], [-1.0, 3e-45]]", &["corner", "too small or too sharp"]);
    corners("[[1.0, 0.0], [0.0, 1.0, 5.0], [-1.0, 0.0]]", &[]);
    corners("[[1.0, 0.0], [0.0, 1.0]]", &[]);
}

#[test]
fn polygons_that_are_taken_make_a_mesh() {
    for corners in [
        "[[1.0, -0.1], [0.2, 0.9], [-1.0, 0.0]]",
        "[[1e-9, 0.0], [0.0, 1e-9], [-1e-9, 0.0]]",
        "[[1.0, 0.0], [1.0, 1e-6], [-1.0, 0.0]]",
        "[[100.0, 0.0], [0.0, 100.0], [-100.0, -1e-3]]",
    ] {
        let section = format!("section = {{ shape = \"polygon\", corners = {corners} }}");
        let text = DENIM.replace("plies = 2", &section).replace("[\"2 indigo\", \"ecru\"]", "[\"ecru\"]");
        let Ok(design) = read_text(&text) else { continue };
        let yarns = design.yarns().unwrap();
        let mesh = texere_core::Pipeline::new(&yarns).sides(3).caps(true);
        let mesh = mesh.mesh(&texere_cpu::SerialBackend::new()).unwrap();
        let finite = |vertex: &texere_core::Vertex| {
            vertex.position.iter().chain(&vertex.normal).all(|value| value.is_finite())
        };
        assert!(mesh.vertices.iter().all(finite), "{corners}");
    }
}

#[test]
fn a_weave_that_is_none_is_refused_with_its_cause() {
    let error = read_text(&DENIM.replace("3/1", "3|1")).unwrap_err();
    let cause = std::error::Error::source(&error).unwrap().to_string();
    assert!(cause.contains("3|1"), "{cause}");
}

#[test]
fn bytes_that_are_not_text_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("design.toml");
    std::fs::write(&path, b"name = \"a\"\n\xff").unwrap();
    let error = read(&path).unwrap_err().to_string();
    assert!(error.contains("line 2"), "{error}");
}

/// A yarn is as firm as its twist makes it. Filament without twist is soft, but the design has to
/// state the twist of 0. If a design says nothing of twist, the yarn counts as cotton of ordinary
/// twist.
#[test]
fn firmness_follows_twist() {
    let firmness = |lines: &str| {
        let text = DENIM.replace("twist_per_m = -500.0\n", "").replace("tex = 84.0", lines);
        cloth(&text).warp()[0].firmness
    };
    assert_eq!(firmness("tex = 84.0"), 1.0);
    assert_eq!(firmness("tex = 84.0\ntwist_per_m = 0.0"), 0.1);
    assert_eq!(firmness("tex = 84.0\ntwist_per_m = 0.0\nfirmness = 3.0"), 3.0);
    assert_eq!(firmness("tex = 84.0\ntwist_per_m = 9000.0"), 10.0);
    // 500 turns a metre on a radius of 0.1715 mm.
    let tangent =
        0.5 * std::f64::consts::TAU * (4.0 * 84.0 * 1.1 / (1000.0 * std::f64::consts::PI)).sqrt() / 2.0;
    for twist in ["500.0", "-500.0"] {
        let found = f64::from(firmness(&format!("tex = 84.0\ntwist_per_m = {twist}")));
        assert!((found - (tangent / 0.42).powi(2)).abs() < 1e-5, "{twist}: {found}");
    }
}

/// What a yarn can be squeezed to follows from its own density, and from how dense its fibre is.
#[test]
fn a_yarn_keeps_its_own_density_over_that_of_its_packed_fibre() {
    let least = |lines: &str| {
        let text = DENIM.replace("tex = 84.0", lines);
        cloth(&text).warp()[0].least_area
    };
    let off = |lines: &str, expected: f64| {
        let found = f64::from(least(lines));
        assert!((found - expected).abs() < 1e-6, "{lines}: {found}, not {expected}");
    };
    let (peirce, cotton) = (1.0 / 1.1, 1.52);
    off("tex = 84.0", peirce / (0.8 * cotton));
    off("diameter_mm = 0.3", peirce / (0.8 * cotton));
    off("tex = 84.0\ndensity = 0.6", 0.6 / (0.8 * cotton));
    off("tex = 84.0\npacking = 0.9", peirce / (0.9 * cotton));
    // A yarn of wool has as much air in it as one of cotton, unless its density is given.
    off("tex = 84.0\nfibre = \"wool\"", peirce / (0.8 * cotton));
    off("tex = 84.0\nfibre = \"wool\"\ndensity = 0.7", 0.7 / (0.8 * 1.31));
    // Tex and diameter give the density: 84 g a kilometre fill a section of a quarter of pi times
    // 0.16 mm².
    off("tex = 84.0\ndiameter_mm = 0.4", 84.0 / (250.0 * std::f64::consts::PI * 0.16) / (0.8 * cotton));
    // A yarn as dense as its packed fibre can't be squeezed.
    off("tex = 84.0\ndensity = 1.4", 1.0);
    off("tex = 84.0\nleast_area = 0.5", 0.5);
    // Of the same tex, a yarn of a lighter fibre is thicker.
    let radius = |lines: &str| cloth(&DENIM.replace("tex = 84.0", lines)).warp()[0].radius_mm;
    let thicker = radius("tex = 84.0\nfibre = \"nylon\"") / radius("tex = 84.0");
    assert!((thicker.powi(2) - 1.52 / 1.14).abs() < 1e-5, "{thicker}");
}

/// The limit that a refusal names is itself allowed.
#[test]
fn limits_themselves_are_taken() {
    let keys =
        ["stiffness", "bending_stiffness", "firmness", "flatness", "hairiness", "packing", "least_area"];
    let limits = keys.map(|key| {
        let outside = DENIM.replace("tex = 84.0", &format!("tex = 84.0\n{key} = 1e7"));
        let Err(ReadError::OutOfRange { low, high, .. }) = read_text(&outside) else { panic!("{key}") };
        (key, [low, high])
    });
    for (key, ends) in limits {
        for limit in ends {
            let told = read_text(&DENIM.replace("tex = 84.0", &format!("tex = 84.0\n{key} = {limit}")));
            let design = told.unwrap_or_else(|error| panic!("{key} = {limit}: {error}"));
            // What can be read can be written.
            let folder = tempfile::tempdir().unwrap();
            texere_formats::write::toml(&design, folder.path().join("again.toml")).unwrap();
        }
    }
    let cloth = cloth(&DENIM.replace("tex = 84.0", "tex = 84.0\nflatness = 0.1"));
    assert_eq!(cloth.warp()[0].flatness, 0.1);
}
