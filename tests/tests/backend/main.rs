//! Runs the suite on the backend that docs/BACKENDS.md explains.

mod host;

use std::process::ExitCode;

use texere_conformance::{Entry, run};

fn main() -> ExitCode {
    let mine = Entry::exact("host", || vec![host::open()]);
    run(std::env::args_os(), &[mine], "host")
}
