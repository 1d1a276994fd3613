//! Steps: commands run one after the other from the repository's root, each with its time.

use std::io::{self, Write};
use std::path::Path;
use std::process::{Command, ExitCode, Stdio};
use std::thread;
use std::time::{Duration, Instant};

/// The steps that have run. After a failure all further steps are skipped.
#[derive(Debug, Default)]
pub(crate) struct Steps {
    done: Vec<(String, Duration)>,
    failed: Option<String>,
    /// What the steps print, if it is kept until they have run.
    kept: Option<Vec<u8>>,
}

impl Steps {
    /// Runs cargo with `args` and extra environment variables.
    pub(crate) fn cargo(&mut self, name: &str, args: &[&str], env: &[(&str, &str)]) {
        self.run(name, &[&["cargo"], args].concat(), env);
    }

    /// Runs a program with its arguments and extra environment variables.
    pub(crate) fn run(&mut self, name: &str, program: &[&str], env: &[(&str, &str)]) {
        if self.failed.is_some() {
            return;
        }
        let title = format!("\n==> {name}: {}\n", program.join(" "));
        let start = Instant::now();
        let mut command = command(program[0], &program[1..]);
        command.envs(env.iter().copied());
        let status = match &mut self.kept {
            None => {
                print!("{title}");
                command.status()
            }
            Some(kept) => command.output().map(|output| {
                kept.extend([title.as_bytes(), &output.stdout, &output.stderr].concat());
                output.status
            }),
        };
        self.done.push((name.into(), start.elapsed()));
        match status {
            Ok(status) if status.success() => {}
            Ok(status) => self.failed = Some(format!("{name}: {status}")),
            Err(error) => self.failed = Some(format!("{name}: {error}")),
        }
    }

    /// Runs the steps of `one`, and those of `other` beside them. What the steps of `other` print
    /// is printed at the end.
    pub(crate) fn beside(&mut self, one: impl FnOnce(&mut Self), other: impl FnOnce(&mut Self) + Send) {
        if self.failed.is_some() {
            return;
        }
        let mut beside = Self { kept: Some(Vec::new()), ..Self::default() };
        thread::scope(|scope| {
            scope.spawn(|| other(&mut beside));
            one(self);
        });
        // The steps have run even if their output can't be printed, so the error is ignored.
        let _ = io::stdout().write_all(&beside.kept.unwrap_or_default());
        self.done.append(&mut beside.done);
        self.failed = self.failed.take().or(beside.failed);
    }

    /// A command's standard output and error output, if it succeeds.
    pub(crate) fn output(&self, program: &str, args: &[&str], env: &[(&str, &str)]) -> Option<String> {
        let output = command(program, args).envs(env.iter().copied()).output().ok()?;
        let text = [output.stdout, output.stderr].concat();
        output.status.success().then(|| String::from_utf8_lossy(&text).into_owned())
    }

    /// Records the failure of a step that is no command.
    pub(crate) fn fail(&mut self, failure: String) {
        self.failed.get_or_insert(failure);
    }

    /// Whether a command runs and succeeds. Its output is dropped.
    pub(crate) fn succeeds(&self, program: &str, args: &[&str]) -> bool {
        let status = command(program, args).stdout(Stdio::null()).stderr(Stdio::null()).status();
        status.is_ok_and(|status| status.success())
    }

    /// Installs Debian's `packages`.
    pub(crate) fn install(&mut self, name: &str, packages: &[&str]) {
        let sudo = !self.succeeds("test", &["-w", "/var/lib/dpkg"]);
        let apt = if sudo { ["sudo", "apt-get"].as_slice() } else { ["apt-get"].as_slice() };
        let environment = [("DEBIAN_FRONTEND", "noninteractive")];
        self.run("package lists", &[apt, &["update", "--quiet"]].concat(), &environment);
        let install = [apt, &["install", "--quiet", "--yes", "--no-install-recommends"], packages].concat();
        self.run(name, &install, &environment);
    }

    /// Whether all steps so far have succeeded.
    pub(crate) const fn succeed(&self) -> bool {
        self.failed.is_none()
    }

    /// Prints each step's time, and what failed.
    pub(crate) fn finish(self) -> ExitCode {
        println!();
        for (name, time) in &self.done {
            println!("{:8.1} s  {name}", time.as_secs_f64());
        }
        match self.failed {
            None => ExitCode::SUCCESS,
            Some(failure) => {
                eprintln!("failed: {failure}");
                ExitCode::FAILURE
            }
        }
    }
}

/// A command that starts in the repository's root.
pub(crate) fn command(program: &str, args: &[&str]) -> Command {
    let mut command = Command::new(program);
    command.args(args).current_dir(root());
    command
}

/// The repository's root.
pub(crate) fn root() -> &'static Path {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent().unwrap_or(here)
}
