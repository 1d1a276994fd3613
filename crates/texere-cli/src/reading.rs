//! Reads designs, saved yarns and curves, and prints the remarks of readers.

use std::io::Write;
use std::path::Path;

use texere::{Design, Yarns};

use crate::args::{CurveArgs, SettingsArgs, SettlingArgs, is_read_as_curves, is_yarns, says_thickness};
use crate::fail::Fail;
use crate::terminal::line;

/// Reads a design, and prints on standard error what its reader had to assume or leave out.
/// Standard output is for the command's own output.
pub(crate) fn design(path: &Path) -> Result<Design, Fail> {
    let design = texere::read(path)?;
    say(design.remarks());
    Ok(design)
}

/// The yarns in `path`, if it is a file of saved yarns or of curves, or none if it is a design.
///
/// **Errors**: those of reading, an option of the command line that needs a file of another kind,
/// and a diameter that curves lack.
pub(crate) fn yarns(
    path: &Path,
    curves: CurveArgs,
    settings: &SettingsArgs,
    settling: &SettlingArgs,
) -> Result<Option<Yarns>, Fail> {
    let is_curves = is_read_as_curves(path);
    if let Some(option) = curves.given().filter(|_| !is_curves) {
        return Err(Fail::needs_curves(option, path));
    }
    if !is_yarns(path) && !is_curves {
        return Ok(None);
    }
    let section = settings.section.as_ref().map(|_| "--section");
    if let Some(option) = section.or(settling.asked()) {
        return Err(Fail::needs_design(option, path));
    }
    let scale = curves.scale();
    if is_curves && !says_thickness(path) && scale.diameter_mm.is_none() {
        return Err(Fail::needs_diameter(path));
    }
    let yarns = if is_curves { texere::read::curves(path, scale)? } else { texere::read::yarns(path)?.yarns };
    Ok(Some(match settings.tension {
        Some(tension) => yarns.with_tension(tension)?,
        None => yarns,
    }))
}

/// Reads a design for a report. Prints the reader's remarks on standard error, except those about
/// faults of the cloth, which the report names itself. Also returns the printed remarks.
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

fn say(remarks: &[String]) {
    let mut out = std::io::stderr().lock();
    for remark in remarks {
        // If standard error is closed, there is nowhere to report it.
        let _ = writeln!(out, "warning: {}", line(remark));
    }
}
