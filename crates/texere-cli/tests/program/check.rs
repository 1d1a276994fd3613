//! `texere check`: the faults that it finds, and that its cures work.

use std::path::{Path, PathBuf};

use serde_json::Value;
use tempfile::TempDir;

use crate::{design, stderr, stdout, texere};

/// A 3/1 twill of yarns of 0.3 mm, with these spacings of ends and picks.
fn twill(folder: &Path, cloth: &str, ends: f64, picks: f64) -> PathBuf {
    let path = folder.join("twill.toml");
    let text = format!(
        "[weave]\nnotation = \"3/1\"\nends = 20\npicks = 16\n[finish]\nsettle = false\n[cloth]\n{cloth}\n[yarns.a]\ndiameter_mm = 0.3\n\
         [warp]\nyarns = [\"a\"]\nspacing_mm = {ends}\n[weft]\nyarns = [\"a\"]\nspacing_mm = {picks}\n"
    );
    std::fs::write(&path, text).unwrap();
    path
}

/// The exit code and the JSON of a check.
fn check(path: &Path, more: &[&str]) -> (i32, Value) {
    let output = texere(&[&["check", "--json", path.to_str().unwrap()], more].concat());
    let json = serde_json::from_str(&stdout(&output)).unwrap_or_else(|_| panic!("{}", stderr(&output)));
    (output.status.code().unwrap(), json)
}

fn cure<'a>(report: &'a Value, key: &str) -> Option<&'a Value> {
    report["cures"].as_array().unwrap().iter().find(|cure| cure["key"] == key)
}

#[test]
fn our_own_designs_are_clean() {
    for name in [
        "plain.toml",
        "denim.toml",
        "poplin.toml",
        "sheeting.toml",
        "drill.toml",
        "sateen.toml",
        "honeycomb.toml",
        "satin.toml",
        "damask.toml",
        "two-ply.toml",
        "herringbone.wif",
        "paper/163x150.toml",
    ] {
        let output = texere(&["check", &design(name)]);
        assert_eq!(output.status.code(), Some(0), "{name}: {}", stdout(&output));
        assert!(stdout(&output).contains("clean") && stderr(&output).is_empty(), "{name}");
    }
}

/// Plain weave at twice Ashenhurst's sett is jammed. The check names a wider spacing, at which the
/// cloth does come to rest. Yarns that can be squeezed more need less spacing.
#[test]
fn cloth_at_rest_is_jammed_where_its_fibres_have_no_room() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("cloth.toml");
    let written = |spacing: f64, tex: f64, yarn: &str| {
        let text = format!(
            "[weave]\nnotation = \"plain\"\nends = 12\npicks = 12\n[yarns.a]\ntex = {tex}\n{yarn}\n\
             [warp]\nyarns = [\"a\"]\nspacing_mm = {spacing}\n[weft]\nyarns = [\"a\"]\nspacing_mm = {spacing}\n"
        );
        std::fs::write(&path, text).unwrap();
        check(&path, &[])
    };
    let needed = ["", "packing = 0.9"].map(|yarn| {
        let (code, report) = written(0.205, 30.0, yarn);
        assert_eq!((code, &report["clean"]), (4, &Value::Bool(false)), "{yarn}");
        let words = stdout(&texere(&["check", path.to_str().unwrap()]));
        assert!(words.contains("jammed, not at rest"), "{words}");
        assert!(words.contains("threads are as dense as their fibres allow, and lack "), "{words}");
        assert!(!words.contains('…'), "{words}");
        let wider = cure(&report, "warp.spacing_mm, weft.spacing_mm").unwrap_or_else(|| panic!("{words}"));
        let (spacing, _) = wider["value"].as_str().unwrap().split_once(", ").unwrap();
        let spacing: f64 = spacing.parse().unwrap();
        assert_eq!(written(spacing, 30.0, yarn).0, 0, "{spacing}");
        // The design gives tex and no diameter, so the cure's thinner yarn is one of less tex.
        let thinner = cure(&report, "diameter_mm of every yarn").unwrap_or_else(|| panic!("{words}"));
        let effect = thinner["effect"].as_str().unwrap();
        let (_, times) = effect.split_once("with ").unwrap_or_else(|| panic!("{effect}"));
        let (times, _) = times.split_once(" times its tex").unwrap_or_else(|| panic!("{effect}"));
        assert_eq!(written(0.205, 30.0 * times.parse::<f64>().unwrap(), yarn).0, 0, "{effect}");
        spacing
    });
    assert!(needed[1] < needed[0], "{needed:?}");
}

#[test]
fn jammed_cloth_is_named_with_its_numbers_and_its_cure_cures() {
    let folder = TempDir::new().unwrap();
    let path = twill(folder.path(), "", 0.4, 0.66);
    let (code, report) = check(&path, &[]);
    assert_eq!((code, &report["clean"]), (4, &Value::Bool(false)));
    assert_eq!((&report["jams"]["ends"], &report["jams"]["picks"]), (&Value::from(19), &Value::from(0)));
    let worst = &report["jams"]["threads"][0];
    assert_eq!((worst["thread"].as_str(), worst["pitch_mm"].as_f64()), (Some("end 2"), Some(0.4)));
    // Peirce: √3 diameters of equal round threads.
    assert!((worst["pitch_min_mm"].as_f64().unwrap() - 0.3 * 3f64.sqrt()).abs() < 1e-6);
    assert!(
        report["pierces"]["min"].as_f64().unwrap() < 0.985 && report["folds"]["min"].as_f64().unwrap() < 1.0
    );
    assert!(report["pierces"]["worst"][0]["yarns"][0].as_str().unwrap().starts_with("end "));

    // With the spacing of the cure the cloth is clean.
    let spacing = cure(&report, "warp.spacing_mm, weft.spacing_mm").unwrap();
    let (ends, picks) = spacing["value"].as_str().unwrap().split_once(", ").unwrap();
    let wider = twill(folder.path(), "", ends.parse().unwrap(), picks.parse().unwrap());
    let (code, after) = check(&wider, &[]);
    assert_eq!(code, 0, "{after}");
    // Flattening leaves the faults that the cure lists.
    let flatten = cure(&report, "cloth.jam").unwrap();
    let (code, after) = check(&twill(folder.path(), "jam = \"flatten\"", 0.4, 0.66), &[]);
    assert!(after["jams"].is_null() && after["pierces"].is_null(), "{after}");
    assert_eq!((flatten["leaves"].as_str(), code), (Some("folds"), 4));
    assert!(!after["folds"].is_null() && cure(&after, "cloth.jam").is_none());

    let output = texere(&["check", twill(folder.path(), "", 0.4, 0.66).to_str().unwrap()]);
    let text = stdout(&output);
    assert!(text.contains("end 2 is 0.4000 mm from the one before and needs 0.5196 mm"), "{text}");
    assert!(
        text.contains("cure  cloth.jam = \"flatten\"")
            && stderr(&output).contains("pierces itself, folds, jams")
    );
}

/// A 3/1 twill of equal yarns takes 1.5 diameters a thread: 0.45 mm. With ends 0.4 mm apart the
/// sett is an eighth beyond the greatest.
#[test]
fn a_sett_beyond_the_greatest_is_said_with_what_is_within_it() {
    let folder = TempDir::new().unwrap();
    let path = twill(folder.path(), "", 0.4, 0.66);
    let (_, report) = check(&path, &[]);
    let [warp, weft] = ["warp", "weft"].map(|set| report["setts"][set]["share"].as_f64().unwrap());
    assert!((warp - 1.125).abs() < 1e-6 && (weft - 0.45 / 0.66).abs() < 1e-6, "{report}");
    let beyond = |path: &Path| stdout(&texere(&["check", path.to_str().unwrap()]));
    let text = beyond(&path);
    assert!(text.contains("sett  ends 25.00 to the cm, 22.22 is the most"), "{text}");
    assert!(text.contains("; 12.5 % beyond the most they jam or flatten: 0.45"), "{text}");
    assert!(
        text.contains(" or yarns 1.13 times as thin") && text.matches("beyond the most").count() == 1,
        "{text}"
    );
    // With the printed spacing the sett is within the limit.
    let (_, told) = text.split_once("flatten: ").unwrap();
    let spacing = told.split(' ').next().unwrap().parse().unwrap();
    let text = beyond(&twill(folder.path(), "", spacing, 0.66));
    assert!(!text.contains("beyond it"), "{text}");
}

#[test]
fn how_exact_touching_is_can_be_said() {
    let folder = TempDir::new().unwrap();
    let path = twill(folder.path(), "shape = \"crossing\"", 0.9, 0.9);
    assert_eq!(check(&path, &[]).0, 0);
    // With one control point a crossing the clearance is some 0.99. That passes the usual check,
    // but not one with an accuracy of 0.001.
    let (code, report) = check(&path, &["--accuracy", "0.001"]);
    assert_eq!(code, 4, "{report}");
    assert!(report["folds"].is_null() && report["jams"].is_null());
    assert!(report["pierces"]["min"].as_f64().unwrap() > 0.985);
    for bad in ["-0.1", "1", "nan", "much"] {
        let output = texere(&["check", path.to_str().unwrap(), &format!("--accuracy={bad}")]);
        assert_eq!(output.status.code(), Some(2), "{bad}");
    }
}

#[test]
fn the_papers_shape_is_cured_by_the_round_one() {
    let folder = TempDir::new().unwrap();
    // Threads are less than two diameters apart. With one control point a crossing the spline cuts
    // corners and threads pierce; threads of the round shape just pass.
    let path = twill(folder.path(), "shape = \"crossing\"", 0.59, 0.59);
    let (code, report) = check(&path, &[]);
    assert_eq!(code, 4);
    let round = cure(&report, "cloth.shape").unwrap_or_else(|| panic!("{report}"));
    assert_eq!(round["value"], "\"round\"");
    let (_, after) = check(&twill(folder.path(), "shape = \"round\"", 0.59, 0.59), &[]);
    assert!(after["jams"].is_null() && after["pierces"].is_null(), "{after}");
}

/// Plain cloth of yarns far thicker than their spacing.
fn thick(folder: &Path, [ends, picks]: [usize; 2], diameter: f64, spacing: f64) -> PathBuf {
    let path = folder.join("thick.toml");
    let text = format!(
        "[weave]\nnotation = \"plain\"\nends = {ends}\npicks = {picks}\n[yarns.a]\ndiameter_mm = {diameter}\n\
         [warp]\nyarns = [\"a\"]\nspacing_mm = {spacing}\n[weft]\nyarns = [\"a\"]\nspacing_mm = {spacing}\n"
    );
    std::fs::write(&path, text).unwrap();
    path
}

#[test]
fn yarns_thicker_than_several_pitches_are_named_and_cured_by_numbers() {
    let folder = TempDir::new().unwrap();
    for (size, diameter, spacing) in
        [([24, 24], 1000.0, 0.75), ([7, 9], 25.0, 0.25), ([163, 150], 25.0, 0.25), ([24, 24], 2.0, 0.75)]
    {
        let path = thick(folder.path(), size, diameter, spacing);
        let (code, report) = check(&path, &["--no-settle"]);
        assert_eq!((code, &report["clean"]), (4, &Value::Bool(false)), "{report}");
        let crowded = &report["crowded"];
        let number = |key: &str| crowded[key].as_f64().unwrap_or_else(|| panic!("{crowded}"));
        assert!((number("thickness_mm") / diameter - 1.0).abs() < 1e-6 && number("pitch_mm") == spacing);
        assert!(number("fill") > 1.0, "{crowded}");
        let (set, _) = crowded["yarn"].as_str().unwrap().split_once(' ').unwrap();
        assert!(matches!(set, "end" | "pick"), "{crowded}");

        // With the diameter of the cure the cloth is clean.
        let thin = cure(&report, "diameter_mm of every yarn").unwrap_or_else(|| panic!("{report}"));
        assert!(thin["leaves"].is_null());
        let thin = thin["value"].as_str().unwrap().parse().unwrap();
        let (code, after) = check(&thick(folder.path(), size, thin, spacing), &[]);
        assert_eq!((code, &after["crowded"]), (0, &Value::Null), "{after}");
        // It is clean with the spacing of the cure, too, if a design file allows that spacing.
        if let Some(wide) = cure(&report, "warp.spacing_mm, weft.spacing_mm") {
            let (wide, _) = wide["value"].as_str().unwrap().split_once(", ").unwrap();
            let (code, after) = check(&thick(folder.path(), size, diameter, wide.parse().unwrap()), &[]);
            assert_eq!(code, 0, "{after}");
        }
    }
    let path = thick(folder.path(), [24, 24], 1000.0, 0.75);
    let output = texere(&["check", path.to_str().unwrap()]);
    assert!(stderr(&output).contains("thick.toml is crowded, folds, jams"), "{}", stderr(&output));
    let said = " is 1000.0000 mm thick and 0.7500 mm from the one before";
    assert!(stdout(&output).contains(said), "{}", stdout(&output));
    let text = stdout(&texere(&["inspect", path.to_str().unwrap()]));
    assert!(
        text.contains("times as much yarn as there is room for")
            && text.contains(said)
            && text.contains("of touching at the most"),
        "{text}"
    );
}

#[test]
fn faults_of_the_design_are_not_the_cloths() {
    let folder = TempDir::new().unwrap();
    let path = twill(folder.path(), "jam = \"squeeze\"", 0.4, 0.66);
    let output = texere(&["check", path.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(3));
    assert!(stderr(&output).contains("line 8: cloth.jam is \"squeeze\""), "{}", stderr(&output));
    assert_eq!(texere(&["check", "no-such-file.toml"]).status.code(), Some(1));
}

#[test]
fn knits_that_fall_apart_are_named_as_woven_cloth_is() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("apart.toml");
    let table = "[warp_knit]\nwales = 8\ncourses = 6\nwales_per_cm = 10\ncourses_per_cm = 14\n[yarns.w]\ndiameter_mm = 0.12\n";
    for (bar, said, empty) in [
        ("lapping = \"pillar\"", "there are 8 pieces", 0),
        ("lapping = \"tricot\"\nthreading = [\"2 w\", \"2 out\"]", "there are 2 pieces", 2),
    ] {
        std::fs::write(&path, format!("{table}[[warp_knit.bars]]\n{bar}\n")).unwrap();
        let (code, report) = check(&path, &[]);
        assert_eq!((code, &report["clean"]), (4, &Value::Bool(false)));
        let words = report["apart"]["said"].as_str().unwrap();
        assert!(
            words.contains("nothing binds all threads into one cloth") && words.contains(said),
            "{words}"
        );
        assert_eq!(report["empty_needles"]["count"].as_u64().unwrap_or(0), empty);
        let output = texere(&["inspect", path.to_str().unwrap()]);
        assert!(stdout(&output).contains(words), "{}", stdout(&output));
        assert!(stderr(&texere(&["check", path.to_str().unwrap()])).contains("falls apart"));
    }
}

/// Rings follow even a hard twist of 2,000 turns a metre, four turns from pick to pick, so that no
/// tube is wrung. 80,000 turns a metre are over half a turn from ring to ring even in the finest
/// mesh that is chosen for twist, and are reported.
#[test]
fn a_mesh_that_twist_wrings_is_told() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("crepe.toml");
    let cloth = |twist: f64| {
        format!(
            "[weave]\nnotation = \"plain\"\nends = 6\npicks = 6\n[finish]\nsettle = false\n[yarns.a]\ndiameter_mm = 0.2\n\
             twist_per_m = {twist}\n[warp]\nyarns = [\"a\"]\nspacing_mm = 2.0\n[weft]\nyarns = [\"a\"]\nspacing_mm = 2.0\n"
        )
    };
    std::fs::write(&path, cloth(0.0)).unwrap();
    let (code, report) = check(&path, &[]);
    assert_eq!((code, &report["wrung"], &report["inside_out"]), (0, &Value::Null, &Value::Null));
    assert!(report["drawn"]["width"].as_f64().unwrap() > 0.999);

    std::fs::write(&path, cloth(2000.0)).unwrap();
    let (code, report) = check(&path, &[]);
    assert_eq!((code, &report["wrung"], &report["undersampled"]), (0, &Value::Null, &Value::Null));
    assert!(report["drawn"]["width"].as_f64().unwrap() > 0.7);

    std::fs::write(&path, cloth(80_000.0)).unwrap();
    let (code, report) = check(&path, &[]);
    assert_eq!((code, &report["clean"]), (4, &Value::Bool(false)));
    assert!(report["wrung"]["width"].as_f64().unwrap() < 0.5);
    assert_eq!(report["wrung"]["width_at"]["place_mm"].as_array().map(Vec::len), Some(3));
    assert!(report["undersampled"].as_str().unwrap().starts_with("undersampled twist: "), "{report}");
    assert!(cure(&report, "--subdivisions").is_none());
    let said = texere(&["check", path.to_str().unwrap()]);
    assert!(stdout(&said).contains("wrung") && stderr(&said).contains("is wrung"), "{}", stderr(&said));
}

/// Tubes of a tricot are nearly as wide between rings as on them. The tricot's mesh is the same in
/// either frame.
#[test]
fn steep_yarns_are_not_wrung_and_equal_in_either_frame() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("tricot.toml");
    let tricot = "[warp_knit]\nwales = 4\ncourses = 4\nwales_per_cm = 10.0\ncourses_per_cm = 13.333\n\
                  [[warp_knit.bars]]\nlapping = \"1-0/1-2//\"\n[yarns.white]\ndiameter_mm = 0.1\n";
    std::fs::write(&path, tricot).unwrap();
    let (_, report) = check(&path, &[]);
    assert_eq!((&report["wrung"], &report["inside_out"]), (&Value::Null, &Value::Null), "{report}");
    assert!(report["drawn"]["width"].as_f64().unwrap() > 0.97, "{report}");
    let mesh = |frame: &[&str], name: &str| {
        let out = folder.path().join(name);
        let own = ["mesh", path.to_str().unwrap(), "-o", out.to_str().unwrap(), "--device", "cpu"];
        let made = texere(&[&own, frame].concat());
        assert_eq!(made.status.code(), Some(0), "{}", stderr(&made));
        std::fs::read(out).unwrap()
    };
    let usual = mesh(&[], "usual.ply");
    assert!(usual == mesh(&["--frame", "upright"], "upright.ply"));
    assert!(usual == mesh(&["--frame", "rotation-minimizing"], "minimizing.ply"));
}
