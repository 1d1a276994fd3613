//! Every case on every device of every backend of this workspace.

use std::process::ExitCode;

use texere_conformance::{REGISTRY, run};

fn main() -> ExitCode {
    // Names of the backends that have to be there, with commas between them.
    let required = std::env::var("TEXERE_REQUIRE").unwrap_or_default();
    run(std::env::args_os(), REGISTRY, &required)
}
