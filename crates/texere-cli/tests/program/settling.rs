//! Yarns that settle first: what is said of it, what is drawn, and which word counts, the design's or the command line's.

use std::fs;
use std::path::Path;

use serde_json::Value;
use tempfile::TempDir;

use crate::{stderr, stdout, texere};

/// Doubled threads of 0.3 mm that lie `near` mm from the one before: too near for those that cross them.
fn doubled(near: f64, finish: &str) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let text = format!(
        "[weave]\nnotation = \"plain\"\nends = 6\npicks = 6\n[finish]\n{finish}\n[yarns.a]\ndiameter_mm = 0.3\n\
         [warp]\nyarns = [\"a\"]\nspacing_mm = [0.78, {near}]\n[weft]\nyarns = [\"a\"]\nspacing_mm = [0.78, {near}]\n"
    );
    fs::write(folder.path().join("doubled.toml"), text).unwrap();
    folder
}

fn at(folder: &TempDir, name: &str) -> String {
    folder.path().join(name).to_str().unwrap().to_owned()
}

/// The JSON of a command, and its exit code.
fn json(args: &[&str]) -> (i32, Value) {
    let output = texere(&[args, &["--json"]].concat());
    let json = serde_json::from_str(&stdout(&output)).unwrap_or_else(|_| panic!("{}", stderr(&output)));
    (output.status.code().unwrap(), json)
}

#[test]
fn a_cloth_that_pierces_itself_comes_to_rest_and_is_clean() {
    let folder = doubled(0.48, "length = \"free\"");
    let cloth = at(&folder, "doubled.toml");
    let (code, before) = json(&["check", &cloth]);
    assert_eq!((code, before.get("settling")), (4, None));
    assert!(before["pierces"].is_object() && before["jams"].is_object(), "{before}");
    let (code, after) = json(&["check", &cloth, "--settle"]);
    assert_eq!((code, &after["clean"]), (0, &Value::Bool(true)), "{after}");
    let settling = &after["settling"];
    assert_eq!((&settling["at_rest"], &settling["linked"]), (&Value::Bool(true), &Value::Bool(true)));
    assert!(settling["clearance"].as_f64().unwrap() >= 0.995 && settling["passes"].as_u64().unwrap() > 40);
    assert!(settling["radius_diameters"].as_f64().unwrap() >= 0.594, "{settling}");
    assert_eq!((&settling["device"], &settling["length_off"]), (&Value::from("cpu"), &Value::Null));
    let text = stdout(&texere(&["check", &cloth, "--settle"]));
    assert!(text.contains("settling  at rest after ") && text.contains("linking unchanged"), "{text}");

    // What inspect measures are the yarns that have settled.
    let (_, plain) = json(&["inspect", &cloth]);
    let (_, settled) = json(&["inspect", &cloth, "--settle"]);
    assert!(plain["clearance"]["min"].as_f64().unwrap() < 0.95 && plain.get("settling").is_none());
    assert!(settled["clearance"]["min"].as_f64().unwrap() > 0.98, "{settled}");
    assert_eq!(settled["settling"], *settling);
    assert_eq!(settled["control_points"], plain["control_points"]);
    // That crossing threads pierce one another is no longer so.
    let warnings = |report: &Value| report["warnings"].as_array().unwrap().len();
    assert_eq!((warnings(&plain), warnings(&settled)), (2, 0));
    let text = stdout(&texere(&["inspect", &cloth, "--settle"]));
    assert!(text.contains("settling  at rest after ") && text.contains("lengths free"), "{text}");
}

#[test]
fn what_finds_no_rest_says_so_and_is_still_checked() {
    let folder = doubled(0.39, "settle = true");
    let (code, report) = json(&["check", &at(&folder, "doubled.toml")]);
    assert_eq!((code, &report["settling"]["at_rest"]), (4, &Value::Bool(false)), "{report}");
    assert!(report["settling"]["length_off"].as_f64().unwrap() > 0.0 && report["jams"].is_null(), "{report}");
    let text = stdout(&texere(&["check", &at(&folder, "doubled.toml")]));
    assert!(text.contains("not at rest after ") && text.contains("with --no-settle"), "{text}");
}

#[test]
fn the_command_line_overrides_the_design() {
    let settling = doubled(0.48, "settle = true");
    let cloth = at(&settling, "doubled.toml");
    let meshed = |args: &[&str]| {
        let mesh = at(&settling, "cloth.ply");
        let output = texere(&[&["mesh", &cloth, "-o", &mesh, "--device", "cpu-serial"], args].concat());
        let text = stdout(&output);
        (text.contains("settling: ") && text.contains("on cpu-serial"), fs::read(mesh).unwrap())
    };
    let (said, rested) = meshed(&[]);
    let (unsaid, left) = meshed(&["--no-settle"]);
    assert!(said && !unsaid && rested != left && rested.len() == left.len());
    let plain = doubled(0.48, "settle = false");
    for (args, settles) in [(&[][..], false), (&["--settle"], true), (&["--no-settle"], false)] {
        let (_, report) = json(&[&["inspect", &at(&plain, "doubled.toml")], args].concat());
        assert_eq!(report.get("settling").is_some(), settles, "{args:?}");
    }
}

#[test]
fn a_plot_shows_every_pass_and_marks_the_stages() {
    let folder = doubled(0.48, "settle = true\nlength = \"free\"");
    let (cloth, plot) = (at(&folder, "doubled.toml"), at(&folder, "rest.svg"));
    fs::write(&plot, "old").unwrap();
    let (_, report) = json(&["check", &cloth, "--settling-plot", &plot]);
    let svg = fs::read_to_string(&plot).unwrap();
    assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n"));
    for part in
        ["clearance", "radius of curvature", "length off", "longest step", "growing", "easing", "1e-2"]
    {
        assert!(svg.contains(part), "{part}: {svg}");
    }
    // Every pass has a step; what is infinite or 0 leaves a gap in the other lines.
    let line = svg.lines().find(|line| line.contains("#cc79a7\" stroke-width=\"1.5\"")).unwrap();
    let passes = line.matches(['M', 'L']).count() as u64;
    assert_eq!(Value::from(passes), report["settling"]["passes"]);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
}

#[test]
fn flags_that_make_no_sense_are_refused() {
    let folder = doubled(0.48, "");
    let (cloth, plot) = (at(&folder, "doubled.toml"), at(&folder, "rest.svg"));
    fs::write(&plot, "old").unwrap();
    let before = fs::read(&cloth).unwrap();
    for (args, said) in [
        (&["check", &cloth, "--settle", "--no-settle"][..], "cannot be used with"),
        (&["inspect", &cloth, "--settle", "--counts"], "cannot be used with"),
        (&["check", &cloth, "--no-settle", "--settling-plot", &plot], "cannot be used with"),
        (&["check", &cloth, "--settle", "--settling-plot", "rest.png"], "does not end in .svg"),
        (&["check", &cloth, "--settling-plot", &plot], "--settling-plot needs --settle"),
    ] {
        let output = texere(args);
        assert_eq!(output.status.code(), Some(2), "{args:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(said), "{args:?}: {}", stderr(&output));
    }
    // A link to the design is refused before anything settles.
    let link = at(&folder, "link.svg");
    fs::hard_link(&cloth, &link).unwrap();
    let output = texere(&["inspect", &cloth, "--settle", "--settling-plot", &link]);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(stderr(&output).contains("which must stay") && fs::read(Path::new(&cloth)).unwrap() == before);
    assert_eq!(fs::read(&plot).unwrap(), b"old");
}
