//! How many instructions the mesh stage takes for a ring: a check of its speed that no neighbour on the machine disturbs.
//!
//! `valgrind --tool=callgrind` counts them. What start-up takes falls out of the difference between two runs.

use std::fmt::Write;
use std::path::PathBuf;

use crate::steps::{Steps, root};

/// Ways through the CPU backend. Valgrind knows no AVX-512.
const PATHS: [&str; 2] = ["portable", "avx2"];

/// Kinds of mesh, as `benches/src/instructions.rs` knows them.
const KINDS: [&str; 3] = ["upright", "minimizing", "bare"];

/// How many meshes the longer run makes more than the shorter one.
const TIMES: u32 = 10;

/// By how much a count may exceed the baseline: another compiler changes some per cent, a loop that no longer runs in
/// vectors several times as much.
const TOLERANCE: f64 = 1.05;

/// A line for each path and kind: path, kind, instructions a ring.
fn baseline() -> PathBuf {
    root().join("benches/instructions.txt")
}

/// Compares with the baseline, where there is a valgrind.
pub(crate) fn check(steps: &mut Steps) {
    if !steps.succeed() || !steps.succeeds("valgrind", &["--version"]) {
        println!("instructions: left out");
        return;
    }
    let recorded = std::fs::read_to_string(baseline()).unwrap_or_default();
    for (name, counted) in count(steps) {
        let known = recorded.lines().find_map(|line| line.strip_prefix(&name)?.trim().parse::<f64>().ok());
        match known {
            Some(known) if counted <= known * TOLERANCE => println!("{name}: {counted:.1}, baseline {known:.1}"),
            Some(known) => steps.fail(format!(
                "{name}: {counted:.1} instructions a ring, baseline {known:.1} (if that is meant: cargo xtask instructions record)"
            )),
            None => steps.fail(format!("{name}: not in benches/instructions.txt")),
        }
    }
}

/// Keeps the counts of now as the baseline.
pub(crate) fn record(steps: &mut Steps) {
    let mut lines = String::new();
    for (name, counted) in count(steps) {
        println!("{name}: {counted:.1}");
        let _ = writeln!(lines, "{name} {counted:.1}");
    }
    if let Err(error) = std::fs::write(baseline(), lines) {
        steps.fail(format!("benches/instructions.txt: {error}"));
    }
}

/// Instructions a ring, by path and kind.
fn count(steps: &mut Steps) -> Vec<(String, f64)> {
    let build = ["build", "--release", "--locked", "--package", "texere-bench", "--bin", "instructions"];
    steps.cargo("mesh stage to count", &build, &[]);
    let mut counts = Vec::new();
    for path in PATHS {
        for kind in KINDS {
            let short = collected(steps, path, kind, 1);
            let long = collected(steps, path, kind, 1 + TIMES);
            match short.zip(long) {
                Some(((short, rings), (long, _))) => {
                    counts.push((format!("{path} {kind}"), (long - short) / f64::from(TIMES) / rings));
                }
                None => steps.fail(format!("{path} {kind}: valgrind does not run it")),
            }
        }
    }
    counts
}

/// Instructions of a run, and the rings that it says it has.
fn collected(steps: &Steps, path: &str, kind: &str, times: u32) -> Option<(f64, f64)> {
    let program = root().join("target/release/instructions");
    let times = times.to_string();
    let valgrind = ["--tool=callgrind", "--callgrind-out-file=/dev/null", program.to_str()?, kind, &times];
    let environment = [("TEXERE_SIMD", path), ("RAYON_NUM_THREADS", "1")];
    let text = steps.output("valgrind", &valgrind, &environment)?;
    let collected = text.lines().find_map(|line| line.split("Collected :").nth(1)?.trim().parse().ok())?;
    let rings = text.lines().find_map(|line| line.parse().ok())?;
    Some((collected, rings))
}
