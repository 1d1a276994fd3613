//! Spacing, thickness and colour of each end and pick.

use texere_core::backend::filled;

use super::colors::Palette;
use super::ini::Ini;
use super::numbers::{bad, length, numbered};
use super::program::is_ours;
use crate::read::ReadError;
use crate::read::draft::{ALIKE, DraftThreads, LENGTH_MM, ThreadSet, mean};

/// The units of the standard, in mm. A decipoint is a tenth of a point, of which 72 make an inch.
pub(crate) const UNITS_MM: [(&str, f64); 3] =
    [("Centimeters", 10.0), ("Inches", 25.4), ("Decipoints", 25.4 / 720.0)];

/// The threads of warp and weft. `counts` are the numbers of ends and picks.
pub(super) fn read(
    ini: &Ini<'_>,
    [ends, picks]: [u32; 2],
    mut palette: Palette,
    warnings: &mut Vec<String>,
) -> Result<DraftThreads, ReadError> {
    let warp = set(ini, ["warp", "[WARP]"], ends, &mut palette, warnings)?;
    let weft = set(ini, ["weft", "[WEFT]"], picks, &mut palette, warnings)?;
    Ok(DraftThreads { warp, weft, materials: palette.into_materials() })
}

/// The threads of one set, whose section is called `section` in lower case.
fn set(
    ini: &Ini<'_>,
    [section, place]: [&'static str; 2],
    count: u32,
    palette: &mut Palette,
    warnings: &mut Vec<String>,
) -> Result<ThreadSet, ReadError> {
    let unit = unit_mm(ini, section, warnings)?;
    let mut lengths = |what: &str| -> Result<(Option<f64>, Vec<Option<f64>>), ReadError> {
        let limits = LENGTH_MM.map(|limit| limit / unit);
        let common =
            ini.get(section, what).map(|entry| length(ini, section, what, entry, limits)).transpose()?;
        let common = common.flatten().map(|value| value * unit);
        let mut values = filled("lengths of threads", count as usize, common)?;
        let single = format!("{section} {what}");
        for (number, entry) in numbered(ini, &single, count, warnings)? {
            if entry.value.is_empty() {
                continue;
            }
            if let Some(value) = length(ini, &single, &number.to_string(), &entry, limits)? {
                values[number as usize - 1] = Some(value * unit);
            }
        }
        Ok((common, values))
    };
    let ((spacing, spacing_mm), (thickness, thickness_mm)) = (lengths("spacing")?, lengths("thickness")?);

    let common = ini.get(section, "color");
    let common = common.map(|entry| palette.material(ini, section, "color", entry)).transpose()?.flatten();
    let mut material = filled("colours of threads", count as usize, common)?;
    let single = format!("{section} colors");
    for (number, entry) in numbered(ini, &single, count, warnings)? {
        if let Some(own) = palette.material(ini, &single, &number.to_string(), &entry)? {
            material[number as usize - 1] = Some(own);
        }
    }
    let drawn = !is_ours(ini) && is_drawn([spacing, thickness], [&spacing_mm, &thickness_mm]);
    Ok(ThreadSet { place, spacing_mm, thickness_mm, drawn, material })
}

/// Whether the thickness for the whole set equals the spacing for the whole set, or all threads
/// together are at least as thick as they are spaced. `common` has the spacing and the thickness
/// for the whole set, `each` those of all threads.
fn is_drawn(common: [Option<f64>; 2], each: [&[Option<f64>]; 2]) -> bool {
    let ratio = |[spacing, thickness]: [Option<f64>; 2]| {
        spacing.zip(thickness).map(|(spacing, thickness)| thickness / spacing)
    };
    ratio(common).is_some_and(|ratio| (ratio - 1.0).abs() <= ALIKE)
        || ratio(each.map(mean)).is_some_and(|ratio| ratio >= 1.0 - ALIKE)
}

/// The unit of a section's lengths, mm. If the section names none, it is the other set's unit, or
/// else centimetres.
fn unit_mm(ini: &Ini<'_>, section: &str, warnings: &mut Vec<String>) -> Result<f64, ReadError> {
    let other = if section == "warp" { "weft" } else { "warp" };
    let units = [section, other].into_iter().find_map(|of| Some((of, ini.get(of, "units")?)));
    if units.is_none_or(|(of, _)| of != section) && has_lengths(ini, section) {
        let taken = units.map_or("centimeters", |(_, entry)| entry.value);
        let from =
            if units.is_some() { format!(", as in [{}],", other.to_uppercase()) } else { String::new() };
        warnings.push(format!("[{}] has no Units; {taken}{from} are taken", section.to_uppercase()));
    }
    let Some((section, entry)) = units else { return Ok(10.0) };
    let [(_, centimeters), (_, inches), (_, decipoints)] = UNITS_MM;
    match entry.value.to_lowercase().as_str() {
        "centimeters" | "centimetres" | "centimeter" | "cm" => Ok(centimeters),
        "inches" | "inch" | "in" => Ok(inches),
        "decipoints" | "decipoint" => Ok(decipoints),
        "millimeters" | "millimetres" | "millimeter" | "mm" => Ok(1.0),
        _ => Err(bad(ini, section, "units", entry, "Decipoints, Inches or Centimeters")),
    }
}

/// Whether a set gives the thickness or the spacing of any thread.
fn has_lengths(ini: &Ini<'_>, section: &str) -> bool {
    ["spacing", "thickness"]
        .iter()
        .any(|what| ini.get(section, what).is_some() || ini.has(&format!("{section} {what}")))
}
