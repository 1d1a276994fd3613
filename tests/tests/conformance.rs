//! Every case on every device of every backend of this workspace.

use std::process::ExitCode;

fn main() -> ExitCode {
    texere_conformance::run(std::env::args_os(), texere_conformance::REGISTRY)
}
