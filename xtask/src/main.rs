//! Tasks of the repository. CI runs the tasks `test`, `check`, `demo`, `hosts` and `python` on
//! every change, and `mutate` every week. Other tasks measure, draw pictures, pack, and install.

mod bench_tables;
mod build;
mod bundle;
mod demo;
mod hosts;
mod install;
mod instructions;
mod mutants;
mod mutate;
mod publishing;
mod python;
mod sources;
mod steps;
mod workspace;

use std::collections::BTreeSet;
use std::process::ExitCode;

use build::Build;
use demo::vulkan;
use steps::{Steps, root};

/// Debian's packages that run both GPU backends on a CPU: an OpenCL loader with PoCL, a Vulkan
/// loader with lavapipe.
const SOFTWARE_DEVICES: [&str; 4] =
    ["ocl-icd-libopencl1", "pocl-opencl-icd", vulkan::PACKAGES[0], vulkan::PACKAGES[1]];

/// Debian's packages for windows on a virtual screen.
const SCREEN: [&str; 6] =
    ["xvfb", "libx11-xcb1", "libxcursor1", "libxi6", "libxkbcommon-x11-0", "libxrandr2"];

fn main() -> ExitCode {
    let task = std::env::args().nth(1);
    let mut steps = Steps::default();
    match task.as_deref() {
        Some("test") => test(&mut steps),
        Some("check") => {
            check(&mut steps);
            install(&mut steps, "valgrind", &["valgrind"]);
            install_for_programs(&mut steps);
            // The count of instructions keeps one core busy, and so do most programs of `hosts`.
            steps.beside(
                |steps| {
                    instructions::check(steps);
                    demo::demo(steps, Build::Tested);
                },
                |steps| hosts::check(steps, Build::Tested),
            );
        }
        Some("hosts") => {
            install_for_programs(&mut steps);
            hosts::check(&mut steps, Build::Released);
        }
        Some("python") => python(&mut steps, Build::Released),
        Some("demo") => demo::demo(&mut steps, Build::Released),
        Some("gallery") => demo::gallery(&mut steps),
        Some("bench-tables") => {
            install(&mut steps, "software devices", &SOFTWARE_DEVICES);
            bench_tables::run(&mut steps, &std::env::args().skip(2).collect::<Vec<_>>());
        }
        Some("sources") => sources::run(&mut steps),
        Some("bundle") => bundle::run(&mut steps),
        Some("install") => install::run(&mut steps, &std::env::args().skip(2).collect::<Vec<_>>()),
        Some("mutate") => {
            install(&mut steps, "software devices", &SOFTWARE_DEVICES);
            return mutate::run(std::env::args().nth(2).as_deref());
        }
        Some("instructions") => {
            install(&mut steps, "valgrind", &["valgrind"]);
            match std::env::args().nth(2).as_deref() {
                Some("record") => instructions::record(&mut steps),
                _ => instructions::check(&mut steps),
            }
        }
        _ => {
            eprintln!(
                "usage: cargo xtask <demo | gallery | test | check | hosts | python | sources | mutate | instructions | bench-tables | bundle | install>"
            );
            eprintln!("  demo   a picture of denim at rest; installs a Vulkan driver where there is none");
            eprintln!("  gallery  the pictures of docs/gallery");
            eprintln!(
                "  test   all tests, doctests, the conformance suite and the tests of the Python package"
            );
            eprintln!(
                "  check  formatting, lints, docs, licences, spelling, packages, instruction counts, the demo's picture and programs that link the C library"
            );
            eprintln!("  hosts  programs in C, C++ and C# that link the installed library");
            eprintln!("  python  builds the Python package, installs it in target/python and tests it");
            eprintln!("  sources  circles of files, long functions and wide comments");
            eprintln!(
                "  mutate [KERNEL | FILE | BACKEND]  breaks a line of each kernel for meshes, and has the suite find it"
            );
            eprintln!(
                "  instructions [record]  counts those of meshes and control points, against the baseline or to be it"
            );
            eprintln!(
                "  bench-tables [--device NAME]…  the paper's tables and figures on this machine's devices"
            );
            eprintln!("  bundle  packs what tests and measures a machine that has a GPU and nothing else");
            eprintln!(
                "  install --prefix DIR  lays the library for C, C++ and C# where compilers look for it"
            );
            return ExitCode::from(2);
        }
    }
    steps.finish()
}

/// Runs all tests: a program that links the library, unit tests, integration tests, the conformance
/// suite, doctests and the tests of the Python package.
fn test(steps: &mut Steps) {
    install(steps, "software devices", &SOFTWARE_DEVICES);
    install(steps, "a screen", &SCREEN);
    consumer(steps);
    // The tests of the Python package run beside those in Rust.
    steps.beside(tests, |steps| python(steps, Build::Tested));
}

/// Builds and runs the tests in Rust, in two halves beside each other, because many tests keep only
/// one core busy. Both halves choose from all packages. For a part of the packages, the
/// dependencies would have other features and would be compiled again.
fn tests(steps: &mut Steps) {
    let packages = match workspace::packages() {
        Ok(packages) => packages,
        Err(error) => return steps.fail(error),
    };
    let run = ["test", "--workspace", "--locked"];
    steps.cargo("tests, built", &[&run[..], &["--all-targets", "--no-run"]].concat(), &[]);
    // Each half takes about half of the time. A name counts once, whatever packages have it.
    let names: BTreeSet<_> = packages.iter().flat_map(|package| &package.tests).collect();
    let chosen = |later: bool| {
        let half = names.iter().filter(move |name| (name.as_str() >= "n") == later);
        half.flat_map(|name| ["--test", name.as_str()])
    };
    let others = ["--lib", "--bins", "--examples", "--benches"];
    let first: Vec<_> = run.into_iter().chain(others).chain(chosen(false)).collect();
    let second: Vec<_> = run.into_iter().chain(chosen(true)).collect();
    steps.beside(
        |steps| {
            steps.cargo("tests, first half", &first, &[]);
            steps.cargo("doctests", &[&run[..], &["--doc"]].concat(), &[]);
        },
        |steps| steps.cargo("tests, second half", &second, &[]),
    );
}

/// Builds and tests the Python package.
fn python(steps: &mut Steps, build: Build) {
    install(steps, "Python", &python::PACKAGES);
    python::test(steps, build);
}

/// Builds and runs a program outside the workspace as `cargo run` does, without optimisation. The
/// crates that it links have the versions with which the workspace is tested.
fn consumer(steps: &mut Steps) {
    let versions = root().join("Cargo.lock");
    if let Err(error) = std::fs::copy(versions, root().join("tests/consumer/Cargo.lock")) {
        return steps.fail(format!("versions of the consumer's crates: {error}"));
    }
    let program = ["run", "--manifest-path", "tests/consumer/Cargo.toml", "--target-dir", "target/consumer"];
    steps.cargo("a program that links texere, unoptimised", &program, &[]);
}

/// Installs Debian's `packages` if some are missing. Does nothing if the system is not Linux or has
/// no `apt-get`. For a backend without a device, the conformance suite leaves the backend out, or
/// fails if `TEXERE_REQUIRE` names it.
fn install(steps: &mut Steps, what: &str, packages: &[&'static str]) {
    let installed = |package: &str| steps.succeeds("dpkg", &["--status", package]);
    if !cfg!(target_os = "linux") || !steps.succeeds("apt-get", &["--version"]) {
        return;
    }
    let missing: Vec<_> = packages.iter().copied().filter(|package| !installed(package)).collect();
    if missing.is_empty() {
        return;
    }
    steps.install(what, &missing);
}

/// The most packages of a program that links texere with its default features, texere's own
/// included.
const LINKED_MOST: usize = 36;

/// Lints the package `texere` without features, and then with the feature of one file format at a
/// time. Fails if the package links more than [`LINKED_MOST`] packages with its default features.
fn features(steps: &mut Steps) {
    for feature in ["", "glb", "images", "knitout", "obj", "pictures", "ply", "stl", "texgen", "toml", "wif"]
    {
        let name = format!("the library, features: {}", if feature.is_empty() { "none" } else { feature });
        let package = ["--package", "texere", "--locked", "--no-default-features", "--features", feature];
        steps.cargo(&name, &[&["clippy"][..], &package, &["--", "-D", "warnings"]].concat(), &[]);
    }
    let tree =
        ["tree", "--package", "texere", "--edges", "normal", "--prefix", "none", "--no-dedupe", "--locked"];
    let Some(tree) = steps.output("cargo", &tree, &[]) else { return };
    // Each line begins with a name and a version. A path may follow.
    let package = |line: &str| line.split(' ').take(2).collect::<Vec<_>>().join(" ");
    let linked: BTreeSet<_> = tree.lines().filter(|line| line.contains(" v")).map(package).collect();
    if linked.len() > LINKED_MOST {
        steps.fail(format!("texere links {} packages, more than {LINKED_MOST}: {linked:?}", linked.len()));
    }
}

/// Installs the compilers and the Vulkan driver for the programs of `hosts`. Some of these programs
/// draw pictures.
fn install_for_programs(steps: &mut Steps) {
    vulkan::install(steps);
    install(steps, "compilers", &hosts::PACKAGES);
}

/// Runs the checks that are no tests.
fn check(steps: &mut Steps) {
    steps.cargo("format", &["fmt", "--all", "--check"], &[]);
    sources::run(steps);
    steps.cargo(
        "lints",
        &["clippy", "--workspace", "--all-targets", "--locked", "--", "-D", "warnings"],
        &[],
    );
    features(steps);
    let documented = ["doc", "--workspace", "--no-deps", "--locked", "--document-private-items"];
    steps.cargo("docs", &documented, &[("RUSTDOCFLAGS", "-D warnings -A rustdoc::private_intra_doc_links")]);
    // The docs of the package `texere` with all features, and with the default ones.
    for features in [&["--all-features"][..], &[]] {
        let facade = [&["doc", "--package", "texere", "--no-deps", "--locked"], features].concat();
        steps.cargo("docs of the facade", &facade, &[("RUSTDOCFLAGS", "-D warnings")]);
    }
    if !steps.succeeds("cargo", &["deny", "--version"]) {
        // cargo-deny is built without optimisation or debug info, because the build takes much
        // longer than a run.
        let plain = [("CARGO_PROFILE_DEV_DEBUG", "false")];
        steps.cargo("install cargo-deny", &["install", "cargo-deny", "--locked", "--debug"], &plain);
    }
    // Advisories need a database that is fetched from the net at run time. A job of CI checks
    // them.
    steps.cargo("licences and sources", &["deny", "--locked", "check", "bans", "licenses", "sources"], &[]);
    spelling(steps);
    publishing::check(steps);
}

/// The version of `typos` that checks the sources.
const TYPOS: &str = "1.52.0";

/// Checks the spelling, with the exceptions of `typos.toml`. If Python's installer is there, the
/// program comes from PyPI as a binary. Otherwise cargo builds it.
fn spelling(steps: &mut Steps) {
    let folder = "target/typos";
    let typos = format!("{folder}/bin/typos");
    let installed = steps.output(&typos, &["--version"], &[]).is_some_and(|said| said.contains(TYPOS));
    if !installed && steps.succeeds("python3", &["-m", "pip", "--version"]) {
        let program = format!("typos=={TYPOS}");
        let pip = ["python3", "-m", "pip", "install", "--quiet", "--upgrade", "--target", folder, &program];
        steps.run("install typos", &pip, &[]);
    } else if !installed {
        let program = ["install", "typos-cli", "--version", TYPOS, "--locked", "--root", folder];
        steps.cargo("install typos", &program, &[]);
    }
    steps.run("spelling", &[&typos], &[]);
}
