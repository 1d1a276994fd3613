//! Reads designs, saved yarns and curves, and prints the remarks of readers.

use std::io::Write;
use std::path::Path;

use texere::Design;
use texere::mesh::check_sides;
use texere::rest::Piece;

use crate::args::{CurveArgs, SettingsArgs, is_read_as_curves, is_yarns, says_thickness};
use crate::fail::Fail;
use crate::terminal::line;

/// Reads a design, and prints on standard error what its reader had to assume or leave out.
/// Standard output is for the command's own output.
pub(crate) fn design(path: &Path) -> Result<Design, Fail> {
    let design = texere::read(path)?;
    say(design.remarks());
    Ok(design)
}

/// Reads a design as [`design`] does, or the yarns of a file of saved yarns or of curves, and gives
/// them the section of the command line, if there is one.
///
/// **Errors**: those of reading, an option of `curves` for a file of another kind, a diameter that
/// curves lack, a section that yarns can't have, and sides that a polygon's tube can't have.
pub(crate) fn cloth(path: &Path, curves: CurveArgs, settings: &SettingsArgs) -> Result<Design, Fail> {
    let mut design = match yarns(path, curves)? {
        Some(design) => design,
        None => design(path)?,
    };
    apply(settings, &mut design)?;
    Ok(design)
}

/// Gives the yarns of a design the section of the command line, if there is one, and checks the
/// number of sides on the command line.
///
/// **Errors**: a section that yarns can't have, and sides that a polygon's tube can't have.
pub(crate) fn apply(settings: &SettingsArgs, design: &mut Design) -> Result<(), Fail> {
    if let Some(section) = &settings.section {
        design.structure.set_section(section.clone()).map_err(|error| design.refused(error))?;
    }
    if let Some(sides) = settings.sides {
        check_sides(sides, design.structure.sections())?;
    }
    Ok(())
}

/// Reads a design or yarns for a report. Prints the reader's remarks on standard error, except
/// those about faults of the cloth, which the report names itself. Also returns the printed
/// remarks.
pub(crate) fn reported(path: &Path, curves: CurveArgs) -> Result<(Design, Vec<String>), Fail> {
    let design = match yarns(path, curves)? {
        Some(design) => design,
        None => texere::read(path)?,
    };
    let errors = design.faults().iter().filter(|fault| fault.is_error).map(|fault| &fault.message);
    let pieces = design.structure.pieces();
    let apart = pieces.falls_apart().then(|| pieces.to_string());
    let faults: Vec<_> = errors.chain(&apart).collect();
    let said: Vec<_> = design.remarks().iter().filter(|remark| !faults.contains(remark)).cloned().collect();
    say(&said);
    Ok((design, said))
}

/// The yarns of a file of saved yarns or of curves, or none if it is a design.
fn yarns(path: &Path, curves: CurveArgs) -> Result<Option<Design>, Fail> {
    let is_curves = is_read_as_curves(path);
    if let Some(option) = curves.given().filter(|_| !is_curves) {
        return Err(Fail::needs_curves(option, path));
    }
    let scale = curves.scale();
    let piece = match (is_yarns(path), is_curves) {
        (true, _) => texere::read::yarns(path)?.into_piece(),
        (_, true) if !says_thickness(path) && scale.diameter_mm.is_none() => {
            return Err(Fail::needs_diameter(path));
        }
        (_, true) => Piece::cut(texere::read::curves(path, scale)?),
        _ => return Ok(None),
    };
    Ok(Some(Design::of_file(path, piece)))
}

fn say(remarks: &[String]) {
    let mut out = std::io::stderr().lock();
    for remark in remarks {
        // If standard error is closed, there is nowhere to report it.
        let _ = writeln!(out, "warning: {}", line(remark));
    }
}
