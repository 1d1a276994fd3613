//! Every case on every device of every backend of this workspace.

use std::process::ExitCode;

use texere_conformance::{REGISTRY, run};

fn main() -> ExitCode {
    // Names, with commas between them, of the backends that must be there.
    let required = std::env::var("TEXERE_REQUIRE").unwrap_or_default();
    run(std::env::args_os(), REGISTRY, &required)
}
