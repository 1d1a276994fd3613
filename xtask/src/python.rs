//! The Python package: a wheel, installed and tested.

use std::fs;
use std::io;
use std::path::Path;

use crate::build::Build;
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

/// The folder of what is packed into a wheel.
const UNPACKED: &str = "target/python/unpacked";

/// The name of the library as cargo builds it, and in the package.
const LIBRARY: [&str; 2] = if cfg!(windows) {
    ["_texere.dll", "_texere.pyd"]
} else if cfg!(target_os = "macos") {
    ["lib_texere.dylib", "_texere.abi3.so"]
} else {
    ["lib_texere.so", "_texere.abi3.so"]
};

/// Makes the wheel, installs it in an environment of its own, and runs the package's tests and the
/// notebooks. The tests compare meshes with those of the `texere` program of [`Build::Tested`].
pub(crate) fn test(steps: &mut Steps, build: Build) {
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
    Build::Tested.libraries(steps);
    match build {
        Build::Released => {
            let manifest = format!("{PACKAGE}/Cargo.toml");
            let build =
                [&maturin, "build", "--release", "--locked", "--manifest-path", &manifest, "--out", WHEELS];
            steps.run("the Python package", &build, &[]);
        }
        Build::Tested => pack(steps, &python, &maturin),
    }
    let Some(wheel) = wheel(&root().join(WHEELS)) else {
        return steps.fail(format!("the Python package: no wheel in {WHEELS}"));
    };
    let anew = ["--force-reinstall", "--no-deps", &wheel];
    steps.run("the Python package, installed", &[&pip[..], &anew].concat(), &[]);
    let tests = format!("{PACKAGE}/tests");
    steps.run("tests of the Python package", &[&python, "-m", "pytest", "--quiet", &tests], &[]);
    steps.run("notebooks", &[&python, "-m", "pytest", "--quiet", "--nbmake", NOTEBOOKS], &[]);
}

/// Packs a wheel round the library that the tests have built. Maturin would compile it once more
/// with other features of wgpu, which takes minutes.
fn pack(steps: &mut Steps, python: &str, maturin: &str) {
    let unpacked = root().join(UNPACKED);
    let _ = fs::remove_dir_all(&unpacked);
    if let Err(error) = lay(&unpacked.join("texere")) {
        return steps.fail(format!("{UNPACKED}: {error}"));
    }
    let manifest = format!("{PACKAGE}/Cargo.toml");
    let about = [maturin, "pep517", "write-dist-info", "--manifest-path", &manifest];
    let about = [&about[..], &["--interpreter", python, "--metadata-directory", UNPACKED]].concat();
    steps.run("what the wheel says of itself", &about, &[]);
    steps.run("the Python package", &[python, "-m", "wheel", "pack", UNPACKED, "--dest-dir", WHEELS], &[]);
}

/// Copies the library and the Python sources to the folder `package`. Also makes the folder for
/// wheels.
fn lay(package: &Path) -> io::Result<()> {
    fs::create_dir_all(package)?;
    fs::create_dir_all(root().join(WHEELS))?;
    for source in fs::read_dir(root().join(PACKAGE).join("python/texere"))? {
        let source = source?;
        if source.file_type()?.is_file() {
            fs::copy(source.path(), package.join(source.file_name()))?;
        }
    }
    let [built, named] = LIBRARY;
    fs::copy(root().join(Build::Tested.folder()).join(built), package.join(named)).map(drop)
}

/// The wheel in a folder.
fn wheel(folder: &Path) -> Option<String> {
    let mut files = fs::read_dir(folder).ok()?.flatten().map(|entry| entry.path());
    let wheel = files.find(|path| path.extension().is_some_and(|ending| ending == "whl"))?;
    Some(wheel.to_string_lossy().into_owned())
}
