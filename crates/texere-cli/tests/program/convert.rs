//! `texere convert` as a user runs it.

use std::fs;

use crate::{design, stderr, stdout, texere};

#[test]
fn a_design_goes_to_wif_and_back_again() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let given = design("denim.toml");
    let said = stdout(&texere(&["convert", &given, &at("denim.wif")]));
    let lines: Vec<_> = said.lines().collect();
    for what in ["yarns.tex", "yarns.twist_per_m", "names of yarns, such as \"", "finish.settle"] {
        assert!(lines.iter().any(|line| line.starts_with(&format!("left out: {what}"))), "{what}: {said}");
    }
    assert_eq!(*lines.last().unwrap(), format!("{}: 96 ends, 72 picks", at("denim.wif")));
    let said = stdout(&texere(&["convert", &at("denim.wif"), &at("back.TOML")]));
    assert!(said.starts_with("left out: the draft: threading"), "{said}");
    fs::rename(at("back.TOML"), at("back.toml")).unwrap();
    let rows = |path: &str| stdout(&texere(&["draft", path, "--text"]));
    assert_eq!(rows(&at("denim.wif")), rows(&given));
    assert_eq!(rows(&at("back.toml")), rows(&given));
    // A design file converted to a design file loses nothing.
    let said = stdout(&texere(&["convert", &given, &at("denim.toml")]));
    assert_eq!(said, format!("{}: 96 ends, 72 picks\n", at("denim.toml")));
    let inspected = |path: &str| crate::inspect(&[path]);
    assert_eq!(inspected(&at("denim.toml")), inspected(&given));
}

#[test]
fn knits_go_to_files_that_give_them_again() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    for (name, size) in [
        ("cable.toml", "24 wales, 24 courses"),
        ("jacquard.toml", "40 wales, 24 courses"),
        ("tricot.toml", "18 wales, 24 courses"),
    ] {
        let (given, made) = (design(name), at(name));
        assert_eq!(stdout(&texere(&["convert", &given, &made])), format!("{made}: {size}\n"));
        assert_eq!(crate::inspect(&[&made]), crate::inspect(&[&given]), "{name}");
    }
    let program = ";!knitout-2\n;;Carriers: 1\n;;Gauge: 7\nin 1\ntuck - f2 1\ntuck - f1 1\nknit + f1 1\nknit + f2 1\n\
                   out 1\ndrop f1\ndrop f2\n";
    let lines = |path: &str| {
        let text = fs::read_to_string(path).unwrap();
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        lines.sort_unstable();
        lines
    };
    fs::write(at("jersey.k"), program).unwrap();
    for output in ["made.k", "made.knitout"] {
        let said = stdout(&texere(&["convert", &at("jersey.k"), &at(output)]));
        assert_eq!(said, format!("{}: 2 wales, 2 courses\n", at(output)));
        assert_eq!(lines(&at(output)), lines(&at("jersey.k")));
    }
}

#[test]
fn what_can_not_be_converted_is_said_and_nothing_written() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    for (name, output, code, said) in [
        ("rib.toml", "rib.wif", 2, "a WIF draft can't hold a weft knit"),
        ("tricot.toml", "tricot.wif", 2, "a WIF draft can't hold a warp knit"),
        ("rib.toml", "rib.k", 2, "a knitout file can't hold a repeat"),
        ("denim.toml", "denim.k", 2, "a knitout file can't hold woven cloth"),
        ("denim.toml", "denim.glb", 2, "denim.glb does not end in .wif or .toml or .k or .knitout"),
        ("no-such.toml", "denim.wif", 1, "can't read"),
    ] {
        let output = texere(&["convert", &design(name), &at(output)]);
        assert_eq!(output.status.code(), Some(code), "{name}: {}", stderr(&output));
        assert!(stderr(&output).contains(said), "{name}: {}", stderr(&output));
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    // A design is not replaced by its own conversion.
    fs::copy(design("denim.toml"), at("denim.toml")).unwrap();
    let output = texere(&["convert", &at("denim.toml"), &at("denim.toml")]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("which must stay"), "{}", stderr(&output));
}
