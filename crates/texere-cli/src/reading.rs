//! Designs, and what their readers say of them; saved yarns.

use std::io::Write;
use std::path::Path;

use texere::{Design, Yarns};

use crate::args::{SettingsArgs, SettlingArgs, is_yarns};
use crate::fail::Fail;
use crate::terminal::line;

/// Reads a design, and says on standard error what its reader had to assume or leave out: standard
/// output is for what the command makes.
pub(crate) fn design(path: &Path) -> Result<Design, Fail> {
    let design = texere::read(path)?;
    say(design.remarks());
    Ok(design)
}

/// The yarns in `path`, where they are saved ones; none of a design.
///
/// **Errors**: also for options that take a design.
pub(crate) fn saved(
    path: &Path,
    settings: &SettingsArgs,
    settling: &SettlingArgs,
) -> Result<Option<Yarns>, Fail> {
    if !is_yarns(path) {
        return Ok(None);
    }
    let section = settings.section.as_ref().map(|_| "--section");
    if let Some(option) = section.or(settling.asked()) {
        return Err(Fail::needs_design(option, path));
    }
    let yarns = texere::read::yarns(path)?.yarns;
    Ok(Some(match settings.tension {
        Some(tension) => yarns.with_tension(tension)?,
        None => yarns,
    }))
}

/// [`design`] for a report, which says itself what is wrong with the cloth. Gives what was said
/// beforehand, too.
pub(crate) fn reported(path: &Path) -> Result<(Design, Vec<String>), Fail> {
    let design = texere::read(path)?;
    let errors = design.faults().iter().filter(|fault| fault.is_error).map(|fault| &fault.message);
    let pieces = design.structure.pieces();
    let apart = pieces.falls_apart().then(|| pieces.to_string());
    let faults: Vec<_> = errors.chain(&apart).collect();
    let said: Vec<_> = design.remarks().iter().filter(|remark| !faults.contains(remark)).cloned().collect();
    say(&said);
    Ok((design, said))
}

/// What of `warnings` has not been `said`.
pub(crate) fn unsaid(warnings: &[String], said: &[String]) -> Vec<String> {
    warnings.iter().filter(|warning| !said.contains(warning)).cloned().collect()
}

fn say(remarks: &[String]) {
    let mut out = std::io::stderr().lock();
    for remark in remarks {
        // When standard error is closed, there is nowhere left to say so.
        let _ = writeln!(out, "warning: {}", line(remark));
    }
}
