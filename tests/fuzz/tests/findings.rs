//! Inputs that failed once. Each has a folder, whose name says whether the input has to be accepted
//! (`taken-`) or refused (`refused-`).

use std::path::Path;

use texere_fuzz::{Depth, Outcome, drive};

#[test]
fn what_has_failed_once_does_not_again() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("findings");
    let mut seen = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let entry = entry.unwrap().path();
        let name = entry.file_name().unwrap().to_string_lossy().into_owned();
        let design = ["design.toml", "design.wif", "design.k", "design.yarns", "design.bcc"]
            .map(|file| entry.join(file))
            .into_iter()
            .find(|file| file.exists());
        let outcome = drive(&design.unwrap(), Depth::Rest);
        match name.split('-').next() {
            Some("refused") => assert!(matches!(outcome, Outcome::Refused(_)), "{name}: {outcome:?}"),
            Some("taken") => assert_eq!(outcome, Outcome::Taken, "{name}"),
            _ => panic!("{name} says neither refused- nor taken-"),
        }
        seen += 1;
    }
    assert!(seen > 0);
}
