//! `texere render` as a user runs it. It draws on whatever Vulkan device there is; lavapipe will do.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::path::PathBuf;
use std::process::{Command, Output};

const PLAIN: &str = "../../designs/plain.toml";

fn render(args: &[&str]) -> Output {
    let folder = env!("CARGO_MANIFEST_DIR");
    Command::new(env!("CARGO_BIN_EXE_texere")).current_dir(folder).arg("render").args(args).output().unwrap()
}

/// Width and height, as a PNG file's header has them.
fn png_size(path: &PathBuf) -> [u32; 2] {
    let bytes = std::fs::read(path).unwrap();
    assert_eq!(bytes[..8], *b"\x89PNG\r\n\x1a\n");
    [16, 20].map(|at| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap()))
}

#[test]
fn a_picture_has_the_size_that_was_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("plain.png");
    let out = path.to_str().unwrap();
    // Round threads: 64 ends of 191 points and 48 picks of 255, 24 triangles an interval.
    let output = render(&[PLAIN, "-o", out, "--size", "120x90", "--view", "back", "--supersampling", "1"]);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success() && text.contains("584448 triangles"), "{text}");
    assert_eq!(png_size(&path), [120, 90]);
}

#[test]
fn true_scale_makes_the_size() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("plain.png");
    // 64 ends and 48 picks, 15 to the centimetre: some 43 by 32 mm.
    let output = render(&[PLAIN, "-o", path.to_str().unwrap(), "--mm-per-pixel", "0.5"]);
    assert!(output.status.success());
    let [width, height] = png_size(&path);
    assert!((85..=90).contains(&width) && (64..=69).contains(&height), "{width} {height}");
}

#[test]
fn a_turntable_numbers_its_pictures() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("turn.png");
    let (out, size) = (path.to_str().unwrap(), "60x45");
    let output = render(&[PLAIN, "-o", out, "--view", "turntable", "--frames", "2", "--size", size]);
    assert!(output.status.success());
    let [first, second] =
        ["turn-001.png", "turn-002.png"].map(|name| std::fs::read(folder.path().join(name)));
    assert_ne!(first.unwrap(), second.unwrap());
    assert!(!path.exists());
}

#[test]
fn what_makes_no_picture_is_a_wrong_command_line() {
    for args in [
        &[PLAIN, "-o", "x.png", "--size", "0x10"][..],
        &[PLAIN, "-o", "x.png", "--size", "wide"],
        &[PLAIN, "-o", "x.png", "--device", "abacus"],
        &[PLAIN, "-o", "x.png", "--view", "close-up", "--width", "-1"],
        &[PLAIN, PLAIN, "-o", "x.png"],
        &[PLAIN],
    ] {
        let output = render(args);
        assert_eq!(output.status.code(), Some(2), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    }
}
