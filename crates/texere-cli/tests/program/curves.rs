//! Curves that other programs wrote: meshes, pictures, measures, rest.

use std::fs;

use serde_json::Value;

use crate::rest::DESIGNS;
use crate::{inspect, stderr, stdout, texere};

/// Curves of an OBJ file, with a diameter and a unit, have the same mesh as after they are saved as
/// a BCC file.
#[test]
fn curves_of_another_program_are_meshed_and_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (lines, curves, ply, other) = (path("lines.obj"), path("lines.bcc"), path("a.ply"), path("b.ply"));
    fs::write(&lines, "v 0 0 0\nv 0.01 0 0\nv 0.02 0.01 0\nv 0 0.01 0.001\nl 1 2 3\nl 3 4 1\n").unwrap();
    let metres = ["--diameter", "0.5", "--unit", "1000"];
    let mesh = |input: &str, output: &str, options: &[&str]| {
        texere(&[&["mesh", input, "--device", "cpu", "-o", output][..], options].concat())
    };
    let said = stdout(&mesh(&lines, &curves, &metres));
    assert!(said.contains("1 yarn, 4 control points"), "{said}");
    stdout(&mesh(&lines, &ply, &metres));
    stdout(&mesh(&curves, &other, &["--diameter", "0.5"]));
    let mesh_of_lines = fs::read(&ply).unwrap();
    assert!(mesh_of_lines == fs::read(&other).unwrap(), "another mesh");
    let design = path("cloth.toml");
    fs::write(&design, DESIGNS[0].1).unwrap();
    for (output, code, said) in [
        (
            mesh(&lines, &ply, &[]),
            2,
            "lines.obj holds curves, which have no thickness: give it with --diameter MM",
        ),
        (mesh(&lines, &ply, &["--diameter", "0"]), 2, "millimetres above 0"),
        (mesh(&lines, &ply, &["--diameter", "1", "--settling-plot", "x.svg"]), 2, "needs --settle"),
        (mesh(&design, &ply, &["--diameter", "1"]), 2, "--diameter is for files of curves"),
        (mesh(&design, &ply, &["--unit", "1"]), 2, "--unit is for files of curves"),
        (mesh(&lines, &lines, &metres), 2, "which must stay"),
        (mesh(&ply.replace("a.ply", "none.obj"), &ply, &metres), 1, "can't read"),
    ] {
        assert_eq!(output.status.code(), Some(code), "{}", stderr(&output));
        assert!(stderr(&output).contains(said), "{}", stderr(&output));
    }
    assert!(fs::read(&ply).unwrap() == mesh_of_lines);
}

/// A polyline of seven vertices, 6 mm long, along x or along y at the height `z`.
fn line(axis: usize, z: f64, first: usize) -> String {
    let along =
        (-3..=3).map(|at| if axis == 0 { format!("v {at} 0 {z}\n") } else { format!("v 0 {at} {z}\n") });
    let numbers = (first..first + 7).map(|number| format!(" {number}"));
    format!("{}l{}\n", along.collect::<String>(), numbers.collect::<String>())
}

/// Two yarns of 0.5 mm that cross at a distance of 0.4 mm pierce one another: 0.8 of touching. At
/// rest they do not. All numbers follow from the coordinates alone.
#[test]
fn curves_are_measured_checked_and_settled() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (lines, saved, plot) = (path("lines.obj"), path("cloth.yarns"), path("rest.svg"));
    fs::write(&lines, line(0, 0.2, 1) + &line(1, -0.2, 8)).unwrap();

    let found = inspect(&[&lines, "--diameter", "0.5"]);
    assert_eq!((found["name"].as_str(), found["yarns"].as_u64()), (Some("lines"), Some(2)));
    let near = |value: &Value, expected: f64| {
        let value = value.as_f64().unwrap();
        assert!((value - expected).abs() < 1e-6, "{value} for {expected}");
    };
    near(&found["measures"]["length_mm"], 12.0);
    near(&found["measures"]["thickness_mm"], 0.9);
    near(&found["size_mm"][0], 6.5);
    near(&found["size_mm"][1], 6.5);
    near(&found["clearance"]["min"], 0.8);
    assert_eq!(found["clearance"]["worst"][0]["yarns"], serde_json::json!(["yarn 1", "yarn 2"]));
    let doubled = inspect(&[&lines, "--diameter", "1", "--unit", "2"]);
    near(&doubled["measures"]["length_mm"], 24.0);
    near(&doubled["clearance"]["min"], 0.8);
    let under = stdout(&texere(&["inspect", &lines, "--diameter", "0.5", "--at", "0.1,0.1"]));
    let at = under.find("yarn 1,").zip(under.find("yarn 2,"));
    assert!(at.is_some_and(|(upper, lower)| upper < lower), "{under}");

    let check = texere(&["check", &lines, "--diameter", "0.5"]);
    assert_eq!(check.status.code(), Some(4));
    let said = stdout(&check);
    assert!(said.contains("yarn 1 and yarn 2, 0.8000, at x 0.000, y 0.000, z 0.000 mm"), "{said}");
    assert!(stderr(&check).contains("lines.obj pierces itself"), "{}", stderr(&check));

    let settle = ["mesh", &lines, "--diameter", "0.5", "--settle", "--settling-plot", &plot];
    let said = stdout(&texere(&[&settle[..], &["-o", &saved, "--device", "cpu"]].concat()));
    assert!(said.starts_with("settling: at rest after "), "{said}");
    assert!(fs::read_to_string(plot).unwrap().contains("<svg"));
    let check = texere(&["check", &saved]);
    assert_eq!(check.status.code(), Some(0), "{}", stdout(&check));
    let rest = inspect(&[&saved]);
    assert!(rest["clearance"]["min"].as_f64().unwrap() >= 0.985);
    // Both ends of both yarns are held, so that the box stays.
    near(&rest["size_mm"][0], 6.5);

    // A thinner section of the same yarns leaves them clear where they lie.
    let flat = inspect(&[&lines, "--diameter", "0.5", "--section", "ellipse:2"]);
    assert!(flat["clearance"]["min"].as_f64().unwrap() > 1.0);
}

/// An error of settling names the file and the curve.
#[test]
fn a_curve_that_cannot_settle_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let lines = folder.path().join("lines.obj").to_str().unwrap().to_owned();
    fs::write(&lines, line(0, 0.0, 1) + "v 0 0 1\nv 90 0 1\nl 8 9\n").unwrap();
    let check = texere(&["check", &lines, "--diameter", "0.01", "--settle"]);
    assert_eq!(check.status.code(), Some(3), "{}", stdout(&check));
    let said = stderr(&check);
    assert!(said.contains("lines.obj") && said.contains("yarn 2: from one of"), "{said}");
}
