//! `cargo xtask bundle`: the programs that test and measure texere, in a folder for a machine that
//! has a GPU and no toolchain.
//!
//! The task downloads Debian's packages, so it needs `apt-get` and `dpkg`. The bundle runs on the
//! kind of processor on which it was made.

use std::fs;
use std::io;
use std::path::Path;

use crate::bench_tables::commit;
use crate::steps::{Steps, command, root};

/// The bundle's folder, from the repository's root. An archive of the folder lies beside it.
const FOLDER: &str = "target/bundle";

/// Debian's packages with the loaders through which programs find drivers.
const LOADERS: [&str; 8] = [
    "libvulkan1",
    "libegl1",
    "libglvnd0",
    "libopengl0",
    "libgl1",
    "libglx0",
    "libgles2",
    "ocl-icd-libopencl1",
];

/// Builds the programs, collects them in the folder, and packs it.
pub(crate) fn run(steps: &mut Steps) {
    let build = ["build", "--release", "--locked"];
    let bench = ["--package", "texere-bench", "--features", "gpu", "--bin", "texere-bench"];
    steps.cargo("bench", &[&build[..], &bench].concat(), &[]);
    steps.cargo(
        "program",
        &[&build[..], &["--package", "texere-cli", "--no-default-features"]].concat(),
        &[],
    );
    let suite = ["--package", "texere-conformance", "--test", "conformance"];
    let built = ["test", "--release", "--locked", "--no-run"];
    steps.cargo("conformance suite", &[&built[..], &suite].concat(), &[]);
    if !steps.succeed() {
        return;
    }
    // The suite is built already, so cargo only names the program's path.
    let output = steps.output("cargo", &[&built[..], &suite].concat(), &[]).unwrap_or_default();
    let Some(suite) = output.rsplit_once('(').and_then(|(_, path)| path.split(')').next()) else {
        return steps.fail("cargo does not say where the conformance suite is".into());
    };
    if let Err(error) = collect(steps, suite) {
        steps.fail(format!("{FOLDER}: {error}"));
    }
    steps.run("archive", &["tar", "-C", "target", "-czf", "target/texere-bundle.tar.gz", "bundle"], &[]);
    if steps.succeed() {
        println!("\n{FOLDER}/run tests and measures; target/texere-bundle.tar.gz holds the same.");
    }
}

fn collect(steps: &mut Steps, suite: &str) -> io::Result<()> {
    let folder = root().join(FOLDER);
    if folder.exists() {
        fs::remove_dir_all(&folder)?;
    }
    for inner in ["bin", "lib", "packages"] {
        fs::create_dir_all(folder.join(inner))?;
    }
    for (from, name) in [
        ("target/release/texere-bench", "texere-bench"),
        ("target/release/texere", "texere"),
        (suite, "conformance"),
    ] {
        let to = folder.join("bin").join(name);
        fs::copy(root().join(from), &to)?;
        steps.run(&format!("strip {name}"), &["strip", &to.to_string_lossy()], &[]);
    }
    fs::write(folder.join("commit"), commit(steps))?;
    fs::write(folder.join("nvidia_icd.json"), include_str!("bundle/nvidia_icd.json"))?;
    fs::write(folder.join("run"), include_str!("bundle/run.sh"))?;
    steps.run("make it run", &["chmod", "+x", &format!("{FOLDER}/run")], &[]);
    steps.run("designs", &["cp", "-r", "designs", FOLDER], &[]);
    loaders(&folder)
}

/// Downloads the loaders, and puts their libraries side by side.
fn loaders(folder: &Path) -> io::Result<()> {
    let packages = folder.join("packages");
    let fetched = command("apt-get", &["download"]).args(LOADERS).current_dir(&packages).status()?;
    if !fetched.success() {
        return Err(io::Error::other("apt-get download"));
    }
    let unpacked = folder.join("unpacked");
    for package in fs::read_dir(&packages)? {
        let package = package?.path();
        if !command("dpkg", &["-x"]).arg(&package).arg(&unpacked).status()?.success() {
            return Err(io::Error::other(format!("dpkg -x {}", package.display())));
        }
    }
    let mut folders = vec![unpacked.join("usr/lib")];
    while let Some(inner) = folders.pop() {
        for entry in fs::read_dir(inner)? {
            let (path, name) = entry.map(|entry| (entry.path(), entry.file_name()))?;
            if path.is_dir() {
                folders.push(path);
            } else if name.to_string_lossy().contains(".so.") {
                // Links are followed, so that there is a copy under each name.
                fs::copy(&path, folder.join("lib").join(name))?;
            }
        }
    }
    fs::remove_dir_all(unpacked)?;
    fs::remove_dir_all(packages)
}
