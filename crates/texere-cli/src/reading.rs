//! Designs, and what their readers say of them.

use std::io::Write;
use std::path::Path;

use texere::Design;

use crate::fail::Fail;
use crate::terminal::line;

/// Reads a design, and says on standard error what its reader had to assume or leave out: standard output is for what the command makes.
pub(crate) fn design(path: &Path) -> Result<Design, Fail> {
    let design = texere::read(path)?;
    let mut out = std::io::stderr().lock();
    for remark in design.remarks() {
        // When standard error is closed, there is nowhere left to say so.
        let _ = writeln!(out, "warning: {}", line(remark));
    }
    Ok(design)
}
