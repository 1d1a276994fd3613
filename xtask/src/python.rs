//! The Python package: built as its users' wheel is, installed and tested.

use std::fs;
use std::path::Path;

use crate::steps::{Steps, root};

/// Debian's packages that make environments of Python.
pub(crate) const PACKAGES: [&str; 2] = ["python3", "python3-venv"];

/// The folder of the package, from the repository's root.
const PACKAGE: &str = "crates/texere-python";

/// The notebooks, which are run from their first cell to their last.
const NOTEBOOKS: &str = "docs/notebooks";

/// The environment that the package is installed in, and the folder of its wheel.
const ENVIRONMENT: &str = "target/python/environment";
const WHEELS: &str = "target/python/wheels";

/// Builds the wheel, installs it in an environment of its own, and runs its tests against the
/// `texere` program.
pub(crate) fn test(steps: &mut Steps) {
    let (system, folder) = if cfg!(windows) { ("python", "Scripts") } else { ("python3", "bin") };
    let [python, maturin] = ["python", "maturin"].map(|name| format!("{ENVIRONMENT}/{folder}/{name}"));
    if !steps.succeeds(&python, &["-m", "pip", "--version"]) {
        steps.run("an environment of Python", &[system, "-m", "venv", "--clear", ENVIRONMENT], &[]);
    }
    let needed = format!("{PACKAGE}/tests/requirements.txt");
    let pip = [&python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"];
    steps.run("what builds and tests the package", &[&pip[..], &["--requirement", &needed]].concat(), &[]);
    // Wheels of other versions are not installed by mistake.
    let _ = fs::remove_dir_all(root().join(WHEELS));
    let manifest = format!("{PACKAGE}/Cargo.toml");
    let build =
        [&maturin, "build", "--profile", "dev", "--locked", "--manifest-path", &manifest, "--out", WHEELS];
    steps.run("the Python package", &build, &[]);
    let Some(wheel) = wheel(&root().join(WHEELS)) else {
        return steps.fail(format!("the Python package: no wheel in {WHEELS}"));
    };
    let anew = ["--force-reinstall", "--no-deps", &wheel];
    steps.run("the Python package, installed", &[&pip[..], &anew].concat(), &[]);
    // The program is built with the features that the tests before have built it with.
    steps.cargo("the program", &["build", "--workspace", "--bin", "texere", "--locked"], &[]);
    let tests = format!("{PACKAGE}/tests");
    steps.run("tests of the Python package", &[&python, "-m", "pytest", "--quiet", &tests], &[]);
    steps.run("notebooks", &[&python, "-m", "pytest", "--quiet", "--nbmake", NOTEBOOKS], &[]);
}

/// The wheel in a folder.
fn wheel(folder: &Path) -> Option<String> {
    let mut files = fs::read_dir(folder).ok()?.flatten().map(|entry| entry.path());
    let wheel = files.find(|path| path.extension().is_some_and(|ending| ending == "whl"))?;
    Some(wheel.to_string_lossy().into_owned())
}
