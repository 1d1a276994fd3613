//! The `texere` program. It inspects and checks textile designs, and makes meshes, pictures and
//! drafts of them.
//!
//! Exit codes: 0 done; 1 a device, a file or memory failed; 2 the command line or the variable
//! `TEXERE_SIMD` is wrong; 3 the design is wrong; 4 `check` found faults.

mod args;
mod bake;
mod check;
mod convert;
mod cores;
mod devices;
mod draft;
mod drivers;
mod fail;
mod inspect;
mod mesh;
mod print;
mod progress;
mod reading;
mod render;
mod settling;
#[cfg(unix)]
mod signals;
mod terminal;
mod test;
#[cfg(feature = "view")]
mod view;

use std::ffi::OsString;
use std::io::Write;
use std::process::ExitCode;

use args::{Args, Command};
use clap::Parser;

fn main() -> ExitCode {
    let command = match Args::try_parse() {
        Ok(args) => args.command,
        Err(error) => return misused(&error),
    };
    #[cfg(unix)]
    signals::listen();
    cores::start();
    let outcome = match command {
        Command::Devices(args) => devices::run(&args),
        Command::Inspect(args) => inspect::run(&args),
        Command::Check(args) => check::run(&args),
        Command::Mesh(args) => mesh::run(&args),
        Command::Draft(args) => draft::run(&args),
        Command::Convert(args) => convert::run(&args),
        Command::Bake(args) => bake::run(&args),
        Command::Render(args) => render::run(&args),
        Command::Test(args) => test::run(&args),
        #[cfg(feature = "view")]
        Command::View(args) => view::run(&args),
    };
    #[cfg(unix)]
    signals::give_way();
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(fail) => failed(&fail),
    }
}

fn failed(fail: &fail::Fail) -> ExitCode {
    // If the message can't be written to standard error, there is nowhere else to report it.
    let _ = writeln!(std::io::stderr(), "{fail}");
    fail.exit_code()
}

/// Prints the fault of the command line, or the help or version that was asked for.
fn misused(error: &clap::Error) -> ExitCode {
    if !error.use_stderr() {
        // This is help, or the version.
        return match error.print().and_then(|()| std::io::stdout().flush()) {
            Ok(()) => ExitCode::SUCCESS,
            Err(refused) => failed(&fail::Fail::output(refused)),
        };
    }
    let is_harmless = |arg: OsString| {
        let arg = arg.to_string_lossy();
        terminal::line(&arg) == arg
    };
    if std::env::args_os().all(is_harmless) {
        // `exit` prints the arguments unchanged, in colours on a terminal. It is used only if no
        // argument holds codes that control the terminal.
        error.exit();
    }
    let _ = std::io::stderr().write_all(terminal::lines(&error.to_string()).as_bytes());
    ExitCode::from(fail::USAGE)
}
