//! Yarns that settle first: the report, the plot, and that the command line overrides the design.

use std::fs;
use std::path::Path;

use serde_json::Value;
use tempfile::TempDir;

use crate::{design, stderr, stdout, texere};

/// A folder with a design of that name.
fn folder(name: &str, text: &str) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join(name), text).unwrap();
    folder
}

/// A cloth of threads of 0.3 mm. In each group of three, two threads lie `near` mm apart, too near
/// for threads to cross between them. The third lies 0.78 mm from both.
fn doubled(near: f64, finish: &str) -> TempDir {
    let far = 1.56 - near;
    folder(
        "doubled.toml",
        &format!(
            "[weave]\nnotation = \"plain\"\nends = 6\npicks = 6\n[finish]\n{finish}\n[yarns.a]\ndiameter_mm = 0.3\n\
             [warp]\nyarns = [\"a\"]\nspacing_mm = [{near}, {near}, {far}]\n[weft]\nyarns = [\"a\"]\nspacing_mm = [{near}, {near}, {far}]\n"
        ),
    )
}

/// A small jersey.
fn jersey(finish: &str) -> TempDir {
    folder(
        "jersey.toml",
        &format!(
            "[knit]\nchart = \"k\"\nrepeat = [4, 4]\nwales_per_cm = 10.0\ncourses_per_cm = 13.3\n[finish]\n{finish}\n\
             [yarns.a]\ndiameter_mm = 0.2\n"
        ),
    )
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
    let folder = doubled(0.48, "");
    let cloth = at(&folder, "doubled.toml");
    let (code, before) = json(&["check", &cloth, "--no-settle"]);
    assert_eq!((code, before.get("settling")), (4, None));
    assert!(before["pierces"].is_object() && before["jams"].is_object(), "{before}");
    let (code, after) = json(&["check", &cloth]);
    assert_eq!((code, &after["clean"]), (0, &Value::Bool(true)), "{after}");
    let settling = &after["settling"];
    assert_eq!(
        (&settling["device"], &settling["repeat"]["warp"]),
        (&Value::from("cpu"), &Value::from(6)),
        "{settling}"
    );
    assert!(settling["clearance"].as_f64().unwrap() >= 0.985 && settling["passes"].as_u64().unwrap() > 50);
    for set in ["warp", "weft"] {
        let [mean, least] = ["mean", "least"].map(|key| settling["area"][set][key].as_f64().unwrap());
        assert!((0.5..1.0).contains(&mean) && least <= mean, "{settling}");
    }
    let text = stdout(&texere(&["check", &cloth]));
    let clauses = ["passes on cpu, 6 by 6 threads\n", "  clearance ", "  area left of ends "];
    assert!(clauses.iter().all(|clause| text.contains(clause)), "{text}");

    // inspect measures the settled yarns.
    let (_, plain) = json(&["inspect", &cloth, "--no-settle"]);
    let (_, settled) = json(&["inspect", &cloth]);
    assert!(plain["clearance"]["min"].as_f64().unwrap() < 0.95 && plain.get("settling").is_none());
    assert!(settled["clearance"]["min"].as_f64().unwrap() > 0.98, "{settled}");
    assert_eq!(settled["settling"], *settling);
    // The warning that crossing threads pierce one another is gone.
    let warnings = |report: &Value| report["warnings"].as_array().unwrap().len();
    assert_eq!((warnings(&plain), warnings(&settled)), (2, 0), "{settled}");
    // The jams by Peirce's pitches are not reported for settled threads.
    assert!(plain["jam"].is_object() && settled.get("jam").is_none());
    let covered = |report: &Value| report["measures"]["cover"]["cloth"].as_f64().unwrap();
    assert!(covered(&settled) > covered(&plain) + 0.01, "{plain} {settled}");
}

#[test]
fn what_has_no_room_says_so_and_is_still_checked() {
    // Threads are three times as thick as their distance.
    let folder = doubled(0.1, "");
    let cloth = at(&folder, "doubled.toml");
    let text = fs::read_to_string(&cloth).unwrap().replace("1.46", "0.1");
    fs::write(&cloth, text).unwrap();
    let (code, report) = json(&["check", &cloth]);
    assert_eq!((code, &report["clean"]), (4, &Value::Bool(false)), "{report}");
    assert!(report["settling"]["clearance"].as_f64().unwrap() < 0.98 && report["jams"].is_null(), "{report}");
    let text = stdout(&texere(&["check", &cloth]));
    assert!(text.contains("% beyond the most they jam") && text.contains("cure  warp.spacing_mm"), "{text}");
    // With the spacing of the cure the cloth is clean.
    let spacing = &report["cures"][0];
    assert_eq!(spacing["key"], "warp.spacing_mm, weft.spacing_mm", "{report}");
    let (wider, _) = spacing["value"].as_str().unwrap().split_once(", ").unwrap();
    let text = fs::read_to_string(&cloth).unwrap().replace("[0.1, 0.1, 0.1]", wider);
    fs::write(&cloth, text).unwrap();
    assert_eq!(json(&["check", &cloth]).0, 0);
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
    assert!(said && !unsaid && rested != left);
    let plain = doubled(0.48, "settle = false");
    for (args, settles) in [(&[][..], false), (&["--settle"], true), (&["--no-settle"], false)] {
        let (_, report) = json(&[&["inspect", &at(&plain, "doubled.toml")], args].concat());
        assert_eq!(report.get("settling").is_some(), settles, "{args:?}");
    }
}

#[test]
fn a_plot_shows_every_pass_and_marks_the_stages() {
    let folder = jersey("");
    let (knit, plot) = (at(&folder, "jersey.toml"), at(&folder, "rest.svg"));
    fs::write(&plot, "old").unwrap();
    let (_, report) = json(&["check", &knit, "--settling-plot", &plot]);
    let svg = fs::read_to_string(&plot).unwrap();
    assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n"));
    for part in
        ["clearance", "radius of curvature", "length off", "longest step", "growing", "easing", "1e-2"]
    {
        assert!(svg.contains(part), "{part}: {svg}");
    }
    // Every pass has a step, so its line has no gaps. In the other lines infinity and 0 leave gaps.
    let line = svg.lines().find(|line| line.contains("#cc79a7\" stroke-width=\"1.5\"")).unwrap();
    let passes = line.matches(['M', 'L']).count() as u64;
    assert_eq!(Value::from(passes), report["settling"]["passes"]);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
}

#[test]
fn flags_that_make_no_sense_are_refused() {
    let folder = jersey("settle = false");
    let (knit, plot) = (at(&folder, "jersey.toml"), at(&folder, "rest.svg"));
    let woven = doubled(0.48, "");
    fs::write(&plot, "old").unwrap();
    let before = fs::read(&knit).unwrap();
    for (args, said) in [
        (&["check", &knit, "--settle", "--no-settle"][..], "cannot be used with"),
        (&["inspect", &knit, "--settle", "--counts"], "cannot be used with"),
        (&["check", &knit, "--no-settle", "--settling-plot", &plot], "cannot be used with"),
        (&["check", &knit, "--settle", "--settling-plot", "rest.png"], "does not end in .svg"),
        (&["check", &knit, "--settling-plot", &plot], "--settling-plot needs --settle"),
        (&["check", &at(&woven, "doubled.toml"), "--settling-plot", &plot], "--settling-plot is for knits"),
    ] {
        let output = texere(args);
        assert_eq!(output.status.code(), Some(2), "{args:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(said), "{args:?}: {}", stderr(&output));
    }
    // A link to the design is refused before anything settles.
    let link = at(&folder, "link.svg");
    fs::hard_link(&knit, &link).unwrap();
    let output = texere(&["inspect", &knit, "--settle", "--settling-plot", &link]);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(stderr(&output).contains("which must stay") && fs::read(Path::new(&knit)).unwrap() == before);
    assert_eq!(fs::read(&plot).unwrap(), b"old");
}

/// A cloth that is stretched along its warp becomes longer and narrower, and keeps the length of
/// its yarns. A stretch that its threads don't allow is refused.
#[test]
fn stretched_cloth_keeps_its_yarn() {
    let sheeting = |finish: &str| {
        folder(
            "sheeting.toml",
            &format!(
                "[weave]\nnotation = \"plain\"\nends = 24\npicks = 20\n[finish]\n{finish}\n[yarns.a]\ncotton_count = 20.0\n\
                 [warp]\nyarns = [\"a\"]\nper_inch = 60.0\n[weft]\nyarns = [\"a\"]\nper_inch = 60.0\n"
            ),
        )
    };
    let measured = |finish: &str| {
        let folder = sheeting(finish);
        let (code, report) = json(&["inspect", &at(&folder, "sheeting.toml")]);
        assert_eq!(code, 0);
        let number = |value: &Value| value.as_f64().unwrap();
        [
            &report["size_mm"][0],
            &report["size_mm"][1],
            &report["measures"]["length_mm"],
            &report["measures"]["crimp"]["weft"],
        ]
        .map(number)
    };
    let [[width, height, yarn, _], [narrower, longer, kept, crimped]] =
        ["", "stretch_warp = 1.03"].map(measured);
    assert!(
        (longer / height - 1.03).abs() < 1e-6 && narrower < 0.97 * width,
        "{width} {narrower}, {height} {longer}"
    );
    assert!((kept / yarn - 1.0).abs() < 2e-3 && crimped > 0.1, "{yarn} {kept}, {crimped}");
    let output = texere(&["inspect", &at(&sheeting("stretch_warp = 1.3"), "sheeting.toml")]);
    assert!(!output.status.success() && stderr(&output).contains("straight at 1.07"), "{}", stderr(&output));
    // Stretched cloth has other spacings than its design, so no spacings are recommended.
    let stretched = sheeting("stretch_warp = 1.03");
    let said = stdout(&texere(&["check", &at(&stretched, "sheeting.toml"), "--accuracy", "0.001"]));
    assert!(said.contains("cure  none was looked for: the design stretches the cloth"), "{said}");
}

/// A warp knit whose drawn surfaces pierce one another. Settling measures upright ellipses of one
/// repeat, while the drawn surfaces of the whole cloth have plies.
const PIERCES_AS_DRAWN: &str = "[warp_knit]\nwales = 2\ncourses = 4\nneedles_per_inch = 20.0388\ncourses_per_cm = 15.3001\ncompression = 0.8019\n\
    [[warp_knit.bars]]\nlapping = \"tricot\"\nstep = 2\nthreading = [\"b\", \"b\"]\n\
    [[warp_knit.bars]]\nlapping = \"8-10//\"\nstep = 2\nthreading = [\"a\", \"b\"]\nrun_in_mm = 865.8104\n[finish]\nlength = 1.8704\n\
    [yarns.a]\ndiameter_mm = 0.0615\nplies = 12\n[yarns.b]\ndiameter_mm = 0.2278\nsection = { shape = \"ellipse\", aspect = 1.1039 }\n";

/// A locknit between plates closer than its yarns can lie.
const PRESSED: &str = "[warp_knit]\nwales = 6\ncourses = 6\nwales_per_cm = 14.8\ncourses_per_cm = 19.7\n\
    [[warp_knit.bars]]\nlapping = \"1-0/2-3//\"\nthreading = [\"a\"]\n[[warp_knit.bars]]\nlapping = \"1-2/1-0//\"\nthreading = [\"a\"]\n\
    [finish]\npress = 0.2\n[yarns.a]\ntex = 4.444\ndensity = 0.8\n";

fn said(command: &str, text: &str) -> (Value, String) {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("cloth.toml");
    fs::write(&path, text).unwrap();
    let path = path.to_str().unwrap();
    let json = texere(&[command, "--json", path]);
    (serde_json::from_str(&stdout(&json)).unwrap(), stdout(&texere(&[command, path])))
}

#[test]
fn what_is_at_rest_is_clean_and_what_pierces_is_not_at_rest() {
    let denim = fs::read_to_string(design("denim.toml")).unwrap();
    for text in [PIERCES_AS_DRAWN, PRESSED, &denim] {
        let (report, words) = said("check", text);
        assert_eq!(report["settling"]["at_rest"], report["clean"], "{words}");
        assert_eq!(words.contains("not at rest"), report["clean"] == false, "{words}");
        let (report, words) = said("inspect", text);
        assert_eq!(report["settling"]["clearance"], report["clearance"]["min"], "{words}");
        assert_eq!(report["clearance"]["piercing"] == 0, report["settling"]["at_rest"] == true, "{words}");
        assert!(report["settling"]["at_rest"] == false || !words.contains("pierce"), "{words}");
    }
    let (report, _) = said("check", PIERCES_AS_DRAWN);
    assert_eq!(report["clean"], false);
}

/// Plies of woven cloth press into one another, and reports say how far.
#[test]
fn pressed_plies_are_said() {
    let plied = |[ends, picks]: [f64; 2], plies: &str| {
        format!(
            "[weave]\nnotation = \"plain\"\nends = 8\npicks = 8\n[yarns.a]\ntex = 118\ntwist_per_m = 330\n{plies}\n\
             [warp]\nyarns = [\"a\"]\nper_cm = {ends}\n[weft]\nyarns = [\"a\"]\nper_cm = {picks}\n"
        )
    };
    for (text, valley, words) in [
        (
            plied([8.0, 12.0], "plies = 2"),
            Value::from(0.85),
            "plies pressed, with valleys between them at 0.85 of a ply's reach",
        ),
        (
            plied([22.0, 15.0], "plies = 3"),
            Value::from(1.0),
            "plies pressed until no valley is left between them",
        ),
    ] {
        let (report, said) = said("check", &text);
        assert_eq!(report["settling"]["valley"], valley, "{said}");
        assert!(said.contains(words), "{said}");
    }
    let (report, said) = said("check", &plied([8.0, 12.0], ""));
    assert!(report["settling"]["valley"].is_null() && !said.contains("plies"), "{said}");
}

#[test]
fn a_press_that_is_not_reached_is_said() {
    let (report, words) = said("inspect", PRESSED);
    let thick = report["measures"]["thickness_mm"].as_f64().unwrap();
    assert!(thick > 0.21, "{thick}");
    let warning = format!("the press of 0.200 mm is not reached: the cloth is {thick:.3} mm thick at rest");
    assert!(report["warnings"].as_array().unwrap().iter().any(|said| *said == warning[..]), "{words}");
    assert_eq!(report["settling"]["press"]["reached_mm"].as_f64(), Some(thick));
    assert!(said("check", PRESSED).1.contains(&warning));
    // Plates 2 mm apart hardly touch the cloth.
    let (report, words) = said("inspect", &PRESSED.replace("press = 0.2\n", "press = 2.0\n"));
    assert!(report["warnings"].as_array().unwrap().is_empty(), "{words}");
}
