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
fn what_can_not_be_converted_is_said_and_nothing_written() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    for (name, output, code, said) in [
        ("rib.toml", "rib.wif", 2, "a WIF draft can't hold a weft knit"),
        ("tricot.toml", "tricot.toml", 2, "a design file can't hold a warp knit"),
        ("denim.toml", "denim.glb", 2, "denim.glb does not end in .wif or .toml"),
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
