//! Counts the instructions for a ring of a mesh and for a control point. This is a check of speed
//! that other programs on the machine don't disturb.
//!
//! `valgrind --tool=callgrind` counts the instructions. Each count is the difference of two runs
//! that differ only in how often they do their work, so it leaves out start-up. A path of the CPU
//! backend is the kind of vector instructions that it uses, such as `portable` or `avx2`.

use std::fmt::Write;
use std::path::PathBuf;

use crate::steps::{Steps, root};

/// The kinds of mesh of `benches/src/instructions.rs`.
const MESHES: [&str; 5] = ["upright", "flattened", "minimizing", "bare", "streamed"];

/// The kinds of control points of `benches/src/instructions.rs`.
const POINTS: [&str; 2] = ["crossing", "round"];

/// The shorter run does its work once, and the longer run this many times more.
const TIMES: u32 = 10;

/// The factor by which a count may exceed the baseline. Another compiler changes counts by some per
/// cent. A loop that is no longer vectorised changes them by several times as much.
const TOLERANCE: f64 = 1.05;

/// The file of the baseline. It has a line for each path and kind: path, kind, and the instructions
/// for a ring or a control point.
fn baseline() -> PathBuf {
    root().join("benches/instructions.txt")
}

/// Compares the current counts with the baseline. Prints the paths that are left out, and why.
pub(crate) fn check(steps: &mut Steps) {
    if !cfg!(target_arch = "x86_64") {
        println!("\ninstructions: left out, the baseline is that of x86-64 processors");
        return;
    }
    if steps.succeed() && !steps.succeeds("valgrind", &["--version"]) {
        println!("\ninstructions: left out, there is no valgrind to count them");
        return;
    }
    let recorded = std::fs::read_to_string(baseline()).unwrap_or_default();
    for (name, counted) in count(steps) {
        let known = recorded.lines().find_map(|line| line.strip_prefix(&name)?.trim().parse::<f64>().ok());
        match known {
            Some(known) if counted <= known * TOLERANCE => println!("{name}: {counted:.1}, baseline {known:.1}"),
            Some(known) => steps.fail(format!(
                "{name}: {counted:.1} instructions, baseline {known:.1} (if that is meant: cargo xtask instructions record)"
            )),
            None => steps.fail(format!("{name}: not in benches/instructions.txt")),
        }
    }
}

/// Records the current counts as the baseline.
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

/// The instructions for a ring or a control point, by path and kind.
fn count(steps: &mut Steps) -> Vec<(String, f64)> {
    let build = ["build", "--release", "--locked", "--package", "texere-bench", "--bin", "instructions"];
    steps.cargo("instructions to count", &build, &[]);
    let mut counts = Vec::new();
    for (path, kind) in runs() {
        if !steps.succeed() {
            break;
        }
        let short = collected(steps, path, kind, 1);
        let long = collected(steps, path, kind, 1 + TIMES);
        match short.zip(long) {
            Some(((short, made), (long, _))) => {
                counts.push((format!("{path} {kind}"), (long - short) / f64::from(TIMES) / made));
            }
            None => steps.fail(format!("{path} {kind}: valgrind does not run it")),
        }
    }
    counts
}

/// The paths of the CPU backend that the processor has, and the kinds that each makes. AVX-512 is
/// left out, because valgrind does not run it. Control points have one path only.
fn runs() -> Vec<(&'static str, &'static str)> {
    let mut runs: Vec<_> = POINTS.iter().chain(&MESHES).map(|kind| ("portable", *kind)).collect();
    if has_avx2() {
        runs.extend(MESHES.map(|kind| ("avx2", kind)));
    } else {
        println!("instructions with AVX2: left out, this processor has none");
    }
    runs
}

fn has_avx2() -> bool {
    #[cfg(target_arch = "x86_64")]
    return std::arch::is_x86_feature_detected!("avx2");
    #[cfg(not(target_arch = "x86_64"))]
    false
}

/// The instructions of a run, and the number of rings or control points that it prints.
fn collected(steps: &Steps, path: &str, kind: &str, times: u32) -> Option<(f64, f64)> {
    let program = root().join("target/release/instructions");
    let times = times.to_string();
    let valgrind = ["--tool=callgrind", "--callgrind-out-file=/dev/null", program.to_str()?, kind, &times];
    let environment = [("TEXERE_SIMD", path), ("RAYON_NUM_THREADS", "1")];
    let text = steps.output("valgrind", &valgrind, &environment)?;
    let collected = text.lines().find_map(|line| line.split("Collected :").nth(1)?.trim().parse().ok())?;
    let made = text.lines().find_map(|line| line.parse().ok())?;
    Some((collected, made))
}
