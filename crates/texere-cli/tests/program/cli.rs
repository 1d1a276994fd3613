//! The program as a user runs it: what it prints, what it writes, how it exits.

use std::process::Command;

use serde_json::Value;

use crate::{design, inspect, stderr, stdout, texere};

/// The paper's benchmark cloths: yarns, control points, rings, facets. They follow from the paper's
/// text: a yarn has a control point at each crossing and one at each end, K = 1 inserts one ring
/// between two points, and nc = 6 sides make 12 facets between rings. For 2880 x 1840 they give the
/// 254.47 million facets that the paper states.
#[test]
fn the_papers_cloths_have_the_papers_sizes() {
    for (size, yarns, control_points, rings, facets) in [
        ("163x150", 313u64, 49_526u64, 98_739u64, 1_181_112u64),
        ("489x450", 939, 441_978, 883_017, 10_584_936),
        ("815x750", 1_565, 1_225_630, 2_449_695, 29_377_560),
        ("1141x1050", 2_191, 2_400_482, 4_798_773, 57_558_984),
        ("1630x1500", 3_130, 4_896_260, 9_789_390, 117_435_120),
        ("2880x1840", 4_720, 10_607_840, 21_210_960, 254_474_880),
    ] {
        let report = inspect(&["--counts", &design(&format!("paper/{size}.toml"))]);
        assert_eq!(report["yarns"], yarns, "{size}");
        assert_eq!(report["control_points"], control_points, "{size}");
        assert_eq!(report["rings"], rings, "{size}");
        assert_eq!(report["vertices"], rings * 6, "{size}");
        assert_eq!(report["triangles"], facets, "{size}");
        assert_eq!(report["warnings"], Value::Array(vec![]), "{size}");
        assert!(report.get("clearance").is_none(), "{size}");
    }
}

#[test]
fn settings_change_what_is_counted() {
    let plain = design("plain.toml");
    let report = inspect(&[
        "--counts",
        "--subdivisions",
        "3",
        "--sides",
        "8",
        "--caps",
        "--topology",
        "indexed",
        &plain,
    ]);
    // There are 64 ends of 50 control points and 48 picks of 66. Three more stand where a thread
    // changes sides, which is between any two crossings. There are 4 rings an interval.
    let rings = 64 * ((49 + 3 * 47) * 4 + 1) + 48 * ((65 + 3 * 63) * 4 + 1);
    assert_eq!(report["rings"], rings);
    assert_eq!(report["vertices"], rings * 8 + 112 * 2 * 8);
    let triangles = (rings - 112) * 16 + 112 * 2 * 6;
    assert_eq!(report["triangles"], triangles);
    assert_eq!(report["bytes"], (rings * 8 + 112 * 2 * 8) * 24 + triangles * 3 * 4);
}

#[test]
fn a_drafts_text_has_the_last_pick_on_top_and_end_1_on_the_left() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("twill.toml");
    let text = "[weave]\nnotation = \"3/1\"\nends = 6\npicks = 4\n[yarns.a]\ndiameter_mm = 0.3\n\
                [warp]\nyarns = [\"a\"]\nper_cm = 8.0\n[weft]\nyarns = [\"a\"]\nper_cm = 8.0\n";
    std::fs::write(&path, text).unwrap();
    let output = texere(&["draft", path.to_str().unwrap(), "--text"]);
    // A right-hand twill: in the next pick, one row further up the page, the weft's float lies one
    // end further to the right.
    assert_eq!(stdout(&output), "110111\n101110\n011101\n111011\n");
}

#[test]
fn a_mesh_is_written_and_nothing_is_drawn_on_a_pipe() {
    let folder = tempfile::tempdir().unwrap();
    for (name, device) in [("plain.glb", "cpu"), ("plain.ply", "cpu-serial")] {
        let path = folder.path().join(name);
        let args = ["mesh", &design("plain.toml"), "-o", path.to_str().unwrap(), "--device", device];
        let output = texere(&args);
        assert!(output.status.success(), "{}", stderr(&output));
        assert_eq!(stderr(&output), "");
        let written = std::fs::metadata(&path).unwrap().len();
        assert!(stdout(&output).contains(&format!("{written} bytes")), "{}", stdout(&output));
    }
}

#[test]
fn devices_are_listed_by_the_names_that_open_them() {
    let output = texere(&["devices", "--json"]);
    let all: Value = serde_json::from_str(&stdout(&output)).unwrap();
    let names: Vec<_> =
        all["found"].as_array().unwrap().iter().map(|device| device["name"].as_str().unwrap()).collect();
    assert!(names.ends_with(&["cpu", "cpu-serial"]), "{names:?}");
    assert!(names.contains(&all["auto"].as_str().unwrap()), "{all}");
    // Devices of a family are either found, or the family is missing with a reason.
    for family in ["opencl", "wgpu"] {
        let found = names.iter().any(|name| name.starts_with(family));
        let missing = all["missing"].as_array().unwrap().iter().any(|each| each["family"] == family);
        assert!(found != missing, "{all}");
    }
    // Only `wgpu` devices draw pictures. All devices settle, and pack vertices.
    for device in all["found"].as_array().unwrap() {
        let (name, can) = (device["name"].as_str().unwrap(), &device["can"]);
        assert_eq!(can["draw"], name.starts_with("wgpu"), "{device}");
        assert_eq!((&can["settle"], &can["pack"]), (&true.into(), &true.into()), "{device}");
    }
    let text = stdout(&texere(&["devices"]));
    assert!(names.iter().all(|name| text.contains(&format!("{name}: "))), "{text}");
}

/// With hidden loaders the remaining devices are listed, and the missing families are reported.
#[test]
#[cfg(target_os = "linux")]
fn hidden_loaders_are_said_to_be_missing() {
    let output = Command::new(env!("CARGO_BIN_EXE_texere"))
        .args(["devices"])
        .env("OCL_ICD_VENDORS", "/nowhere")
        .env("OCL_ICD_FILENAMES", "")
        .env("VK_DRIVER_FILES", "/nowhere.json")
        .env("VK_ICD_FILENAMES", "/nowhere.json")
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    let text = stdout(&output);
    assert!(
        text.contains("cpu: ") && text.contains("no opencl device: ") && text.contains("no wgpu device: "),
        "{text}"
    );
}

#[test]
fn exit_codes_say_whose_fault_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let bad = folder.path().join("bad.toml");
    std::fs::write(&bad, "[weave]\nnotation = \"plain\"\nend = 3\n").unwrap();
    let (bad, plain) = (bad.to_str().unwrap(), design("plain.toml"));
    let nowhere = folder.path().join("no").join("folder").join("x.glb");
    let nowhere = nowhere.to_str().unwrap();
    for (args, code, said) in [
        (vec!["inspect", "no-such-file.wif"], 1, "no-such-file.wif"),
        (vec!["inspect", bad], 3, "line 3: key \"end\" is not known; did you mean \"ends\"?"),
        (vec!["inspect", "picture.jpeg"], 3, "known endings"),
        (vec!["inspect", &plain, "--sides", "2"], 2, "2 sides, outside 3 to 256"),
        (vec!["inspect", &plain, "--tension", "nan"], 2, "tension is NaN"),
        (vec!["inspect", &plain, "--subdivisions", "1000000000000"], 2, "1000000000000"),
        (vec!["inspect", &plain, "--subdivisions", "4000000000"], 2, "4000000000 subdivisions"),
        (vec!["inspect", &plain, "--section", "blob"], 2, "expected circle"),
        (vec!["inspect", &plain, "--section", "ellipse:900"], 2, "aspect is 900"),
        (vec!["inspect", &plain, "--section", "lobed:2:nan"], 2, "valley is NaN"),
        (vec!["inspect", &plain, "--section", "lobed:2.5:0.8"], 2, "lobed:PLIES[:VALLEY]"),
        (vec!["mesh", &plain, "-o", nowhere], 1, "x.glb"),
        (vec!["mesh", &plain, "-o", "mesh.fbx"], 2, "glb, ply"),
        (vec!["mesh", &plain, "-o", nowhere, "--device", "abacus"], 2, "\"abacus\"; there are: "),
        (vec!["weave", &plain], 2, "unrecognized subcommand"),
    ] {
        let output = texere(&args);
        assert_eq!(output.status.code(), Some(code), "{args:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(said), "{args:?}: {}", stderr(&output));
    }
}

#[test]
fn vectors_that_the_processor_does_not_have_are_refused() {
    let (folder, plain) = (tempfile::tempdir().unwrap(), design("plain.toml"));
    let path = folder.path().join("mesh.glb");
    let with_vectors = |vectors: &str, args: &[&str]| {
        Command::new(env!("CARGO_BIN_EXE_texere")).args(args).env("TEXERE_SIMD", vectors).output().unwrap()
    };
    let mesh = ["mesh", &plain, "-o", path.to_str().unwrap(), "--device", "cpu"];
    let said = "TEXERE_SIMD is \"avx9\"; this processor has: portable";

    let output = with_vectors("avx9", &mesh);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(stderr(&output).contains(said), "{}", stderr(&output));
    assert!(!path.exists());
    let devices = stdout(&with_vectors("avx9", &["devices"]));
    assert!(
        devices.contains(&format!("no cpu device: {said}")) && devices.contains("cpu-serial: "),
        "{devices}"
    );

    let output = with_vectors("portable", &mesh);
    assert!(output.status.success() && path.exists(), "{}", stderr(&output));
}
