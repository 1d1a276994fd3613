//! Cloth at rest that is saved, and then given to commands in place of a design.

use std::fs;

use crate::rest::DESIGNS;
use crate::{stderr, stdout, texere};

#[test]
fn a_saved_cloth_has_the_mesh_of_its_design() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    for (name, text) in DESIGNS {
        let [design, saved] = ["toml", "yarns"].map(|ending| path(&format!("{name}.{ending}")));
        fs::write(&design, text).unwrap();
        let said = stdout(&texere(&["mesh", &design, "--device", "cpu", "-o", &saved]));
        assert!(said.contains("settling: ") && said.contains(" control points, "), "{said}");
        for (ending, option) in [
            ("ply", "--caps"),
            ("glb", "--caps"),
            ("glb", "--packed"),
            ("glb", "--compressed"),
            ("glb", "--compressed=khr"),
            ("glb", "--instanced"),
            ("ply", "--attributes=uv,tangent,yarn"),
        ] {
            let [own, other] = ["own", "other"].map(|which| path(&format!("{name}-{which}.{ending}")));
            for (input, output) in [(&design, &own), (&saved, &other)] {
                stdout(&texere(&["mesh", input, "--device", "cpu", option, "-o", output]));
            }
            assert!(fs::read(own).unwrap() == fs::read(other).unwrap(), "{name}: another {ending}, {option}");
        }
        let again = path(&format!("{name}-again.yarns"));
        // Nothing settles here, so a device that does not exist is not missed.
        stdout(&texere(&["mesh", &saved, "-o", &again, "--device", "none"]));
        assert!(fs::read(&saved).unwrap() == fs::read(again).unwrap(), "{name} is saved otherwise");
    }
}

/// Files of curves hold the control points of the cloth at rest. Writing them from saved yarns
/// needs no device.
#[test]
fn curves_are_those_of_the_cloth_at_rest() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let [design, saved, curves, stage] = ["cloth.toml", "cloth.yarns", "cloth.bcc", "cloth.usda"].map(path);
    fs::write(&design, DESIGNS[0].1).unwrap();
    for output in [&saved, &curves] {
        let said = stdout(&texere(&["mesh", &design, "--device", "cpu", "-o", output]));
        assert!(said.contains("settling: ") && said.contains(" control points, "), "{said}");
    }
    let yarns = texere::read::yarns(&saved).unwrap().yarns;
    let scale = texere::read::CurveScale { unit_mm: Some(1.0), diameter_mm: Some(0.1) };
    let read = texere::read::curves(&curves, scale).unwrap();
    let places = |yarns: &texere::Yarns| yarns.points().iter().map(|p| [p.x, p.y, p.z]).collect::<Vec<_>>();
    assert!(places(&read) == places(&yarns));
    // Nothing settles here, so a device that does not exist is not missed.
    stdout(&texere(&["mesh", &saved, "-o", &stage, "--device", "none"]));
    assert!(fs::read_to_string(&stage).unwrap().contains("token type = \"cubic\""));
    stdout(&texere(&["mesh", &saved, "-o", &stage, "--linear", "--device", "none"]));
    assert!(fs::read_to_string(&stage).unwrap().contains("token type = \"linear\""));
}

/// Saved yarns keep the tension of their splines, unless the command line gives another.
#[test]
fn saved_cloth_keeps_its_tension() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let mesh = |input: &str, options: &[&str]| {
        let output = path("cloth.ply");
        let args = ["mesh", input, "--device", "cpu", "-o", &output];
        stdout(&texere(&[&args[..], options].concat()));
        fs::read(output).unwrap()
    };
    let (design, saved) = (path("cloth.toml"), path("cloth.yarns"));
    fs::write(&design, DESIGNS[0].1).unwrap();
    stdout(&texere(&["mesh", &design, "--no-settle", "--tension", "0.5", "-o", &saved]));
    let [slack, taut] = ["0", "0.5"].map(|tension| mesh(&design, &["--no-settle", "--tension", tension]));
    assert!(slack != taut);
    assert!(mesh(&saved, &[]) == taut && mesh(&saved, &["--tension", "0"]) == slack);
}

#[test]
fn what_takes_a_design_says_so_of_a_saved_cloth() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (design, saved, broken) = (path("cloth.toml"), path("cloth.yarns"), path("broken.yarns"));
    fs::write(&design, DESIGNS[0].1).unwrap();
    stdout(&texere(&["mesh", &design, "--no-settle", "-o", &saved]));
    let bytes = fs::read(&saved).unwrap();
    fs::write(&broken, &bytes[..bytes.len() - 1]).unwrap();
    let (ply, other) = (path("cloth.ply"), path("other.yarns"));
    let alone = "holds saved yarns alone";
    let cases: [(&[&str], i32, &str); 31] = [
        (&["inspect", &saved, "--diameter", "1"], 2, "--diameter is for files of curves"),
        (&["check", &saved, "--unit", "1"], 2, "--unit is for files of curves"),
        (&["draft", &saved, "--text"], 3, alone),
        (&["convert", &saved, &path("cloth.wif")], 3, alone),
        (
            &["mesh", &saved, "-o", &ply, "--settling-plot", &path("x.svg")],
            2,
            "--settling-plot needs --settle",
        ),
        (&["mesh", &saved, "-o", &ply, "--section", "ellipse:0"], 2, "invalid value"),
        (&["mesh", &saved, "-o", &other, "--triangles"], 2, "--triangles needs a mesh"),
        (&["mesh", &saved, "-o", &path("cloth.bcc"), "--triangles"], 2, "--triangles needs a mesh"),
        (&["mesh", &saved, "-o", &path("cloth.usda"), "--triangles", "--packed"], 2, "does not end in .glb"),
        (&["mesh", &saved, "-o", &other, "--caps"], 2, "--caps needs a mesh"),
        (&["mesh", &saved, "-o", &other, "--packed"], 2, "--packed needs a mesh"),
        (&["mesh", &design, "-o", &ply, "--packed"], 2, "does not end in .glb"),
        (&["mesh", &saved, "-o", &other, "--compressed"], 2, "--compressed needs a mesh"),
        (&["mesh", &design, "-o", &ply, "--compressed"], 2, "does not end in .glb"),
        (&["mesh", &saved, "-o", &other, "--instanced"], 2, "--instanced needs a mesh"),
        (&["mesh", &design, "-o", &ply, "--instanced"], 2, "does not end in .glb"),
        (&["mesh", &design, "-o", &path("c.glb"), "--instanced", "--packed"], 2, "cannot be used with"),
        (&["mesh", &saved, "-o", &other, "--attributes", "uv"], 2, "--attributes needs a mesh"),
        (&["mesh", &design, "-o", &ply, "--attributes", "uv,colour"], 2, "invalid value 'colour'"),
        (
            &["mesh", &design, "-o", &path("cloth.stl"), "--attributes", "uv"],
            2,
            "STL can't hold texture coordinates",
        ),
        (&["mesh", &design, "-o", &ply, "--linear"], 2, "does not end in .usda"),
        (&["mesh", &saved, "-o", &path("cloth.bcc"), "--linear"], 2, "does not end in .usda"),
        (&["mesh", &design, "-o", &other, "--sides", "9"], 2, "--sides needs a mesh"),
        (&["mesh", &saved, "-o", &path("cloth.usda"), "--sides", "9"], 2, "--sides needs a mesh"),
        (
            &["mesh", &saved, "-o", &path("cloth.bcc"), "--tension", "0.5"],
            2,
            "BCC can\'t hold splines of tension",
        ),
        (&["mesh", &saved, "-o", &saved], 2, "which must stay"),
        (&["mesh", &design, "-o", &other, "--no-settle", "--tension", "1"], 2, "tension is 1, outside 0"),
        (&["mesh", &saved, "-o", &ply, "--tension", "nan"], 2, "tension is NaN, outside 0"),
        (&["mesh", &broken, "-o", &ply], 3, "byte 16: the length in bytes is"),
        (&["mesh", &path("none.yarns"), "-o", &ply], 1, "can't read"),
        (
            &["mesh", &design, "-o", &path("cloth.fbx")],
            2,
            "there are: glb, ply, stl, obj, usda; and without a mesh: bcc, usda, yarns",
        ),
    ];
    for (args, code, said) in cases {
        let output = texere(args);
        assert_eq!(output.status.code(), Some(code), "{args:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(said), "{args:?}: {}", stderr(&output));
    }
    assert!(fs::read(&saved).unwrap() == bytes, "the saved cloth is another one");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 3, "something was written");
}
