//! Design files of texere: values that are accepted, and faults that are named with their lines.

use texere_core::Section;
use texere_fabric::{Crimp, Shape, Woven};
use texere_formats::{Design, ReadError, read};

use crate::read_file;

pub(crate) const DENIM: &str = r##"name = "Denim"
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

pub(crate) fn read_text(text: &str) -> Result<Design, ReadError> {
    read_file("design.toml", text)
}

pub(crate) fn cloth(text: &str) -> Woven {
    read_text(text).unwrap().structure.woven().unwrap().cloth().clone()
}

/// `DENIM` with `from` replaced by `to` has to be refused, with a message that has all of `parts`.
pub(crate) fn refused(from: &str, to: &str, parts: &[&str]) {
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
