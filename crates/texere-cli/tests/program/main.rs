//! The program as a user runs it: what it prints, what it writes, how it exits.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test may panic")]

mod bake;
mod bounds;
mod check;
mod cli;
mod convert;
mod curves;
mod draft;
mod hostile;
mod inspect;
mod knit;
mod outputs;
mod reading;
mod rest;
mod saved;
mod settling;
mod strain;
mod twist;
mod warp_knit;

use std::path::PathBuf;
use std::process::{Command, Output};

use serde_json::Value;

fn texere(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_texere")).args(args).output().unwrap()
}

/// The path of one of our own designs.
fn design(name: &str) -> String {
    let folder: PathBuf = [env!("CARGO_MANIFEST_DIR"), "..", "..", "designs"].iter().collect();
    folder.join(name).to_string_lossy().into_owned()
}

/// The output of a command that succeeded, or of a check that found faults.
fn stdout(output: &Output) -> String {
    assert!(matches!(output.status.code(), Some(0 | 4)), "{}", stderr(output));
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// The JSON of `inspect`.
fn inspect(args: &[&str]) -> Value {
    let output = texere(&[&["inspect", "--json"], args].concat());
    assert!(output.status.success(), "{}", stderr(&output));
    serde_json::from_str(&stdout(&output)).unwrap()
}
