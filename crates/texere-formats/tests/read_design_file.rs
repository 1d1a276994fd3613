//! Our own design files: what is taken, and that each fault is named with its line.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test may panic")]

use texere_core::Section;
use texere_fabric::Woven;
use texere_formats::{Design, ReadError, Structure, read};

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
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("design.toml");
    std::fs::write(&path, text).unwrap();
    read(&path)
}

fn cloth(text: &str) -> Woven {
    let Structure::Woven(woven) = read_text(text).unwrap().structure else { panic!("not woven") };
    woven
}

/// The refusal of `DENIM` with `from` replaced by `to` has to hold all of `parts`.
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
    // 500 turns S a metre is half a turn, -π, a millimetre.
    assert!((end.twist + std::f32::consts::PI).abs() < 1e-6);
    assert_eq!(woven.sections()[pick.section as usize], Section::Lobed { plies: 2 });
    assert_eq!(pick.radius_mm, 0.125);
    // Peirce's cotton: 1/28 inch for the count 1, and 84 tex is count 590.5/84.
    assert!((end.radius_mm * 2.0 - 25.4 / (28.0 * (590.5f32 / 84.0).sqrt())).abs() < 2e-3);
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
fn a_draft_from_a_wif_file_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    let wif = "[WARP]\nThreads=4\nSpacing=0.1\nUnits=cm\n[WEFT]\nThreads=2\nSpacing=0.1\nUnits=cm\n\
               [THREADING]\n1=1\n2=2\n3=1\n4=2\n[LIFTPLAN]\n1=1\n2=2\n";
    std::fs::write(folder.path().join("draft.wif"), wif).unwrap();
    let path = folder.path().join("design.toml");
    std::fs::write(&path, "[weave]\nwif = \"draft.wif\"\n[yarns.a]\ndiameter_mm = 0.1\ncolor = \"#010203\"\n[weft]\nyarns = [\"a\"]\nper_cm = 20.0\n").unwrap();
    let Structure::Woven(woven) = read(&path).unwrap().structure else { panic!("not woven") };
    assert!(woven.drawdown().up(0, 0) && !woven.drawdown().up(1, 0));
    assert_eq!((woven.warp()[0].spacing_mm, woven.weft()[0].spacing_mm), (1.0, 0.5));
    assert_eq!(woven.materials()[woven.weft()[1].material as usize].srgb, [1, 2, 3]);
}

#[test]
fn faults_are_named_with_their_line() {
    refused("ends = 7", "end = 7", &["line 4", "\"end\"", "did you mean \"ends\"?"]);
    refused("per_cm = 12.5", "per_inch = 30.0", &["line 15", "\"per_inch\""]);
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
    refused("\"2 indigo\"", "\"2 denim\"", &["line 14", "\"2 denim\"", "\"ecru\", \"indigo\""]);
    refused("\"2 indigo\"", "\"0 indigo\"", &["\"0 indigo\"", "a number from 1"]);
    refused("[\"2 indigo\", \"ecru\"]", "[]", &["warp.yarns", "at least one"]);
    refused("per_cm = 12.5", "per_cm = 12.5\nspacing_mm = 0.8", &["exactly one", "warp.spacing_mm"]);
    refused("spacing_mm = 1.25\n", "", &["exactly one", "weft.spacing_mm"]);
    refused("[weft]\nyarns = [\"ecru\"]\nspacing_mm = 1.25\n", "", &["weft"]);
    refused("[weave]", "[weave", &["line 2"]);
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
