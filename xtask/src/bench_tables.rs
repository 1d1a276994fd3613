//! `cargo xtask bench-tables`: the paper's tables and figures on this machine's devices.

use crate::steps::{Steps, root};

/// The folder of the report, from the repository's root.
const OUTPUT: &str = "target/tables";

/// Measures, and writes the report. `args` are passed to `texere-bench tables`, such as `--device
/// opencl:0`.
pub(crate) fn run(steps: &mut Steps, args: &[String]) {
    let command = [&["cargo xtask bench-tables".to_owned()], args].concat().join(" ");
    let heading = format!("`{command}` at commit {}.", commit(steps));
    let tables = ["tables", "--heading", &heading, "--output", OUTPUT];
    let run = ["run", "--release", "--locked", "--package", "texere-bench", "--features", "gpu", "--"];
    let args: Vec<_> = args.iter().map(String::as_str).collect();
    steps.cargo("tables", &[&run[..], &tables, &args].concat(), &[]);
    if steps.succeed() {
        println!("\nThe report is {}.", root().join(OUTPUT).join("BENCHMARKS.md").display());
    }
}

/// The commit that is checked out, marked as dirty if files are changed; or "unknown".
pub(crate) fn commit(steps: &Steps) -> String {
    let described = steps.output("git", &["describe", "--always", "--dirty"], &[]);
    described.map_or_else(|| "unknown".into(), |commit| commit.trim().to_owned())
}
