//! `cargo xtask mutate`: whether the suite fails if a kernel is broken.
//!
//! The task works on a copy of the repository under `target/`, which is built separately, so that
//! no broken file is left behind. For each schedule of a backend the suite must pass on the
//! unchanged copy. For each mutant it must then compile, find its devices, and fail.

use std::ffi::OsStr;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{ExitCode, Stdio};

use crate::mutants::{MUTANTS, Mutant};
use crate::steps::{command, root};

/// The outcome of a run of the suite.
#[derive(Debug, PartialEq, Eq)]
enum Suite {
    Passed,
    /// This number of trials failed.
    Failed(usize),
    /// The suite did not compile, ran no trial, or failed although no trial did. The text says why.
    Broken(String),
}

/// Runs all mutants, or those whose kernel, file or backend `only` names.
pub(crate) fn run(only: Option<&str>) -> ExitCode {
    match try_run(only) {
        Ok(0) => ExitCode::SUCCESS,
        Ok(missed) => {
            eprintln!("failed: {missed} not caught");
            ExitCode::FAILURE
        }
        Err(error) => {
            eprintln!("failed: {error}");
            ExitCode::FAILURE
        }
    }
}

fn try_run(only: Option<&str>) -> io::Result<usize> {
    let named = |mutant: &&Mutant| {
        only.is_none_or(|only| [mutant.kernel, mutant.file, mutant.backend].contains(&only))
    };
    let mutants: Vec<_> = MUTANTS.iter().filter(named).collect();
    if mutants.is_empty() {
        return Err(io::Error::other("no such kernel, file or backend"));
    }
    let copy = copy_of_the_repository()?;
    let (mut missed, mut sound) = (0, Vec::new());
    for mutant in mutants {
        let trials = mutant.trials();
        if !sound.contains(&trials) {
            match suite(&copy, mutant)? {
                Suite::Passed => println!("passes   {} as it is", trials[0]),
                other => return Err(io::Error::other(format!("{} as it is: {other:?}", trials[0]))),
            }
            sound.push(trials);
        }
        let (file, whole) = (copy.join(mutant.file), fs::read_to_string(root().join(mutant.file))?);
        if whole.matches(mutant.line).count() != 1 {
            let message = format!("{} does not have once: {}", mutant.file, mutant.line);
            return Err(io::Error::other(message));
        }
        fs::write(&file, whole.replace(mutant.line, mutant.broken))?;
        let outcome = suite(&copy, mutant)?;
        fs::write(&file, whole)?;
        let name = format!("{} {} ({})", mutant.backend, mutant.kernel, mutant.file);
        match outcome {
            Suite::Failed(trials) => println!("caught   {name}: {trials} trials fail"),
            other => {
                missed += 1;
                println!("MISSED   {name}: {other:?}");
            }
        }
    }
    Ok(missed)
}

/// Copies the working tree's files, tracked or new, to `target/mutate`. Returns that folder.
fn copy_of_the_repository() -> io::Result<PathBuf> {
    let copy = root().join("target/mutate");
    let list = ["ls-files", "-z", "--cached", "--others", "--exclude-standard"];
    let listed = command("git", &list).stderr(Stdio::inherit()).output()?;
    if !listed.status.success() {
        return Err(io::Error::other(format!("git ls-files: {}", listed.status)));
    }
    // The build is kept; files that are no longer in the repository are removed.
    for entry in fs::read_dir(&copy).into_iter().flatten() {
        let path = entry?.path();
        match path.file_name().and_then(OsStr::to_str) {
            Some("target") => {}
            _ if path.is_dir() => fs::remove_dir_all(path)?,
            _ => fs::remove_file(path)?,
        }
    }
    for file in listed.stdout.split(|byte| *byte == 0).filter(|file| !file.is_empty()) {
        let file = Path::new(str::from_utf8(file).map_err(io::Error::other)?);
        let target = copy.join(file);
        fs::create_dir_all(target.parent().unwrap_or(&copy))?;
        fs::copy(root().join(file), target)
            .map_err(|error| io::Error::new(error.kind(), format!("{}: {error}", file.display())))?;
    }
    Ok(copy)
}

/// Builds the suite of `copy` and runs the trials of `mutant`.
fn suite(copy: &Path, mutant: &Mutant) -> io::Result<Suite> {
    let cargo = |last: &[&str]| {
        let test = ["test", "--locked", "--package", "texere-conformance", "--test", "conformance"];
        let mut cargo = command("cargo", &[&test, last].concat());
        cargo.current_dir(copy);
        cargo
    };
    if !cargo(&["--no-run", "--quiet"]).status()?.success() {
        return Ok(Suite::Broken("it does not compile".into()));
    }
    let trials = mutant.trials();
    let trials: Vec<_> = ["--"].into_iter().chain(trials.iter().map(String::as_str)).collect();
    let ran = cargo(&trials).stderr(Stdio::inherit()).output()?;
    let said = String::from_utf8_lossy(&ran.stdout);
    let ended =
        |how: &str| said.lines().filter(|line| line.starts_with("test ") && line.ends_with(how)).count();
    // Without a device, or with a kernel that does not compile, no trial runs.
    Ok(match (ended(" ok"), ended(" FAILED")) {
        (0, 0) => Suite::Broken(format!("no trial ran: {}", ran.status)),
        (_, 0) if ran.status.success() => Suite::Passed,
        (_, 0) => Suite::Broken(ran.status.to_string()),
        (_, failed) => Suite::Failed(failed),
    })
}
