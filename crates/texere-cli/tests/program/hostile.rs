//! Text that would control a terminal, and a system without threads or memory.

use std::fs;
use std::process::{Command, Output};

use crate::{design, stderr, stdout, texere};

const THREADS: &str = "[warp]\nyarns = [\"a\\u001b]0;owned\\u0007\"]\nper_cm = 8.0\n\
                       [weft]\nyarns = [\"a\\u001b]0;owned\\u0007\"]\nper_cm = 8.0\n";

fn is_tame(text: &str) -> bool {
    let steers = |sign: char| {
        sign.is_control() && sign != '\n' || ('\u{202a}'..='\u{202e}').contains(&sign) || sign == '\u{2066}'
    };
    !text.contains(steers) && text.lines().all(|line| line.chars().count() < 320)
}

#[test]
fn what_a_design_says_never_steers_the_terminal() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("cloth\u{1b}[31m\u{202e}.toml");
    let name =
        format!("Denim\\u001b[2J\\u009b1m\\u202e\\n{:>16}  0\\r\\n{}", "triangles", "long ".repeat(1000));
    let text = format!(
        "name = \"{name}\"\n[weave]\nnotation = \"plain\"\nends = 4\npicks = 4\n\
         [yarns.\"a\\u001b]0;owned\\u0007\"]\ndiameter_mm = 0.3\n{THREADS}"
    );
    fs::write(&path, text).unwrap();
    let (path, mesh) = (path.to_str().unwrap(), folder.path().join("cloth\u{1b}[31m.ply"));
    for args in [
        vec!["inspect", path],
        vec!["check", path],
        vec!["mesh", path, "--device", "cpu", "-o", mesh.to_str().unwrap()],
    ] {
        let output = texere(&args);
        let said = stdout(&output);
        assert!(is_tame(&said) && is_tame(&stderr(&output)), "{said:?}");
        assert!(said.contains("\\u{1b}"), "{said}");
        // The name takes one line, and cannot imitate a line of the report.
        assert_ne!(said.lines().nth(1).map(str::trim_start), Some("triangles  0"));
    }
    let json = texere(&["inspect", "--json", "--counts", path]);
    let json: serde_json::Value = serde_json::from_str(&stdout(&json)).unwrap();
    assert!(json["name"].as_str().unwrap().starts_with("Denim\u{1b}[2J\u{9b}1m\u{202e}\n"));
}

#[test]
fn errors_are_a_line_or_two_and_tame() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bad.toml");
    let (long, codes) = ("x".repeat(1 << 20), "\\u001b[31m".repeat(1000));
    let path = path.to_str().unwrap();
    for weave in [
        format!("notation = \"{long}\"\nends = 4\npicks = 4"),
        format!("notation = \"{codes}\"\nends = 4\npicks = 4"),
        format!("notation = \"plain\"\nends = \"{codes}\"\npicks = 4"),
        format!("notation = \"plain\"\nends = 4\npicks = 4\n\"{codes}\" = 1"),
        format!("image = \"{codes}\""),
    ] {
        fs::write(path, format!("[weave]\n{weave}\n[yarns.a]\ndiameter_mm = 0.3\n")).unwrap();
        let output = texere(&["inspect", path]);
        assert!(matches!(output.status.code(), Some(1 | 3)), "{}", stderr(&output));
        assert!(is_tame(&stderr(&output)) && stderr(&output).lines().count() <= 3, "{}", stderr(&output));
    }
    // Arguments of the command line are made safe, too.
    for args in
        [["inspect", "no\u{1b}[31mfile.toml"], ["inspect", "--counts\u{1b}[31m"], ["render", &long[..5000]]]
    {
        let output = texere(&args);
        assert!(!output.status.success() && is_tame(&stderr(&output)), "{}", stderr(&output));
    }
}

/// Runs the program as on a system without threads: stacks of the size in `RUST_MIN_STACK` can't be
/// had.
fn without_threads(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_texere"))
        .args(args)
        .env("RUST_MIN_STACK", "70368744177664")
        .output()
        .unwrap()
}

#[cfg(target_os = "linux")]
#[test]
fn one_thread_is_enough() {
    let folder = tempfile::tempdir().unwrap();
    let files = ["alone.ply", "all.ply"].map(|name| folder.path().join(name));
    let [alone, all] = files.each_ref().map(|path| path.to_str().unwrap());
    let plain = design("plain.toml");
    let mesh = |out| ["mesh", &plain, "--device", "cpu", "-o", out].map(String::from);
    let mesh = [alone, all].map(mesh);
    let [by_one, by_all] = mesh.each_ref().map(|args| args.each_ref().map(String::as_str));
    let output = without_threads(&by_one);
    assert!(output.status.success() && stderr(&output).is_empty(), "{}", stderr(&output));
    assert!(texere(&by_all).status.success());
    assert!(fs::read(alone).unwrap() == fs::read(all).unwrap());
    for args in [&["inspect", &plain][..], &["check", &plain], &["draft", &plain, "--text"]] {
        let output = without_threads(args);
        assert_eq!(stdout(&output), stdout(&texere(args)), "{args:?}");
        assert!(stderr(&output).is_empty(), "{}", stderr(&output));
    }
}

/// The text of a large draft is printed in less memory than the text has bytes.
#[cfg(target_os = "linux")]
#[test]
fn a_drafts_text_needs_no_memory_beside_the_design() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("large.toml");
    let (ends, picks) = (16_000, 16_000);
    let text = format!(
        "[weave]\nnotation = \"plain\"\nends = {ends}\npicks = {picks}\n[yarns.a]\ndiameter_mm = 0.3\n\
         [warp]\nyarns = [\"a\"]\nper_cm = 8.0\n[weft]\nyarns = [\"a\"]\nper_cm = 8.0\n"
    );
    fs::write(&path, text).unwrap();
    // The text has 256 MB; the drawdown an eighth of it.
    let output = Command::new("sh")
        .args(["-c", "ulimit -v 250000; exec \"$0\" draft \"$1\" --text | tail -c 16001"])
        .args([env!("CARGO_BIN_EXE_texere"), path.to_str().unwrap()])
        .env("RAYON_NUM_THREADS", "1")
        .output()
        .unwrap();
    assert!(stderr(&output).is_empty(), "{}", stderr(&output));
    assert_eq!(stdout(&output), "10".repeat(8000) + "\n");
}

/// Mesa's layers print warnings about the environment whenever drivers are listed. A command that
/// succeeds does not show these warnings.
#[test]
fn what_drivers_write_is_not_the_programs() {
    let folder = tempfile::tempdir().unwrap();
    let mesh = folder.path().join("plain.ply");
    let (plain, mesh) = (design("plain.toml"), mesh.to_str().unwrap());
    for args in [vec!["mesh", &plain, "--device", "auto", "-o", mesh], vec!["devices"]] {
        let output = Command::new(env!("CARGO_BIN_EXE_texere"))
            .args(args)
            .env_remove("XDG_RUNTIME_DIR")
            .env("OCL_ICD_VENDORS", "/nowhere")
            .output()
            .unwrap();
        assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(0), ""));
    }
}
