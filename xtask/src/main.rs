//! Tasks of the repository: `cargo xtask test` and `cargo xtask check`, which together are what CI runs.

mod steps;

use std::process::ExitCode;

use steps::Steps;

/// Crates that go to crates.io.
const PUBLISHED: [&str; 6] =
    ["texere-core", "texere-fabric", "texere-formats", "texere-cpu", "texere", "texere-cli"];

fn main() -> ExitCode {
    let task = std::env::args().nth(1);
    let mut steps = Steps::default();
    match task.as_deref() {
        Some("test") => test(&mut steps),
        Some("check") => {
            check(&mut steps);
            readme(&mut steps);
        }
        _ => {
            eprintln!("usage: cargo xtask <test | check>");
            eprintln!("  test   all tests, doctests and the conformance suite");
            eprintln!("  check  formatting, lints, docs, licences, packages and the README's main command");
            return ExitCode::from(2);
        }
    }
    steps.finish()
}

/// All tests: units, integration, conformance, doctests.
fn test(steps: &mut Steps) {
    steps.cargo("tests", &["test", "--workspace", "--all-targets", "--locked"], &[]);
    steps.cargo("doctests", &["test", "--workspace", "--doc", "--locked"], &[]);
}

/// What needs no test run.
fn check(steps: &mut Steps) {
    steps.cargo("format", &["fmt", "--all", "--check"], &[]);
    steps.cargo(
        "lints",
        &["clippy", "--workspace", "--all-targets", "--locked", "--", "-D", "warnings"],
        &[],
    );
    let documented = ["doc", "--workspace", "--no-deps", "--locked", "--document-private-items"];
    steps.cargo("docs", &documented, &[("RUSTDOCFLAGS", "-D warnings -A rustdoc::private_intra_doc_links")]);
    if !steps.succeeds("cargo", &["deny", "--version"]) {
        steps.cargo("install cargo-deny", &["install", "cargo-deny", "--locked"], &[]);
    }
    // Advisories need a database that is fetched from the net at run time; the weekly workflow checks them.
    steps.cargo("licences and sources", &["deny", "--locked", "check", "bans", "licenses", "sources"], &[]);
    for package in PUBLISHED {
        let name = format!("package list of {package}");
        steps.cargo(&name, &["package", "--list", "--allow-dirty", "--package", package], &[]);
    }
}

/// The README's main command, as it stands there.
fn readme(steps: &mut Steps) {
    let mesh = ["texere", "mesh", "designs/herringbone.wif", "-o", "target/herringbone.glb"];
    steps.cargo("the README's main command", &mesh, &[]);
}
