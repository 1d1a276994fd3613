//! Spacing, thickness and colour of each end and pick.

use texere_core::backend::{filled, room};
use texere_core::{Material, Section, counted};
use texere_fabric::{Drawdown, FabricError, Thread, Woven};

use super::colors::{NO_COLOR, Palette};
use super::ini::Ini;
use super::limits::LENGTH_MM;
use super::numbers::{bad, length, numbered};
use super::program::is_ours;
use crate::read::ReadError;

/// The spacing if the file gives none, mm: 10 threads to the centimetre.
const DEFAULT_SPACING_MM: f64 = 1.0;

/// The units of the standard, in mm. A decipoint is a tenth of a point, of which 72 make an inch.
pub(crate) const UNITS_MM: [(&str, f64); 3] =
    [("Centimeters", 10.0), ("Inches", 25.4), ("Decipoints", 25.4 / 720.0)];

/// The least distance of neighbouring threads in units of Peirce's least pitch, if the file does
/// not state how thick threads are and all are equal and evenly spaced. It is 2/√3, which is what
/// threads have whose diameter is half their spacing. The test `what_is_given_room_does_not_pierce`
/// shows that threads so far apart are clear of one another.
const ROOM: f64 = 1.154_700_538_379_251_5;

/// The least distance of neighbouring threads in the same units, if threads are uneven in spacing
/// or thickness. It keeps threads clear beside gaps of up to twelve times their pitch, and beside
/// threads of a twelfth of their diameter, as `what_is_given_room_does_not_pierce` tests.
const ROOM_UNEVEN: f64 = 1.85;

/// The share by which threads may lie closer than [`ROOM`] or [`ROOM_UNEVEN`] asks without becoming
/// thinner, because radii are rounded to `f32`.
const ROUNDING: f64 = 1e-6;

/// The share by which two spacings, two thicknesses, or a thickness and a spacing may differ and
/// still count as equal. Programs round them.
const ALIKE: f64 = 0.01;

/// The warp's threads, or the weft's, as far as the file describes them.
#[derive(Debug, Default)]
struct Set {
    /// Spacing and thickness, mm, of threads that have none of their own.
    common: [Option<f64>; 2],
    spacing_mm: Vec<Option<f64>>,
    thickness_mm: Vec<Option<f64>>,
    material: Vec<Option<u32>>,
}

/// The threads of warp and weft, and whether the file states how thick they are. `counts` are the
/// numbers of ends and picks.
pub(super) fn read(
    ini: &Ini<'_>,
    counts: [u32; 2],
    palette: &mut Palette,
    warnings: &mut Vec<String>,
) -> Result<([Vec<Thread>; 2], bool), ReadError> {
    let warp = Set::read(ini, "warp", counts[0], palette, warnings)?;
    let weft = Set::read(ini, "weft", counts[1], palette, warnings)?;
    // A set without a spacing of its own takes the other set's.
    let [warp_pitch, weft_pitch] = [&warp, &weft].map(|set| mean(&set.spacing_mm));
    let fallback = warp_pitch.or(weft_pitch).unwrap_or(DEFAULT_SPACING_MM);
    for (name, pitch) in [("WARP", warp_pitch), ("WEFT", weft_pitch)] {
        if pitch.is_none() {
            warnings.push(format!("[{name}] has no spacing; {fallback:.4} mm is taken"));
        }
    }
    let diameter = warp_pitch.unwrap_or(fallback).min(weft_pitch.unwrap_or(fallback)) / 2.0;
    let drawn = [&warp, &weft].map(|set| !is_ours(ini) && set.is_drawn());
    let missing = [&warp, &weft].map(|set| mean(&set.thickness_mm).is_none());
    let threads = [
        warp.threads("WARP", drawn[0], fallback, diameter, warnings)?,
        weft.threads("WEFT", drawn[1], fallback, diameter, warnings)?,
    ];
    Ok((threads, drawn == [false; 2] && missing != [true; 2]))
}

/// The cloth of the threads `warp` and `weft`, for a file that does not state how thick they are.
/// If some threads have no room to cross, all are made thinner by one factor.
///
/// Many programs write the width at which they draw a thread, the whole of its spacing, as its
/// thickness. Threads of that thickness can't be woven, because threads that cross them have to
/// pass between them. A `Thickness` that equals the set's `Spacing`, or threads that together are
/// as wide as the set, therefore give only the ratios of thicknesses. The mean thickness is then
/// that of a file without thickness: half the mean spacing of the set that lies closer. Equal
/// threads, evenly spaced, are then 2/√3 times Peirce's least pitch apart
/// ([`texere_fabric::Pitch`]). Uneven threads may be closer.
pub(super) fn roomy(
    drawdown: Drawdown,
    [warp, weft]: [Vec<Thread>; 2],
    materials: Vec<Material>,
    sections: Vec<Section>,
    warnings: &mut Vec<String>,
) -> Result<Woven, FabricError> {
    let woven = Woven::new(drawdown, warp, weft, materials, sections)?;
    let sets = woven.pitches().into_array();
    let even = sets.iter().all(|set| are_alike(set.iter().map(|pitch| pitch.pitch_mm)))
        && [woven.warp(), woven.weft()]
            .iter()
            .all(|set| are_alike(set.iter().map(|thread| thread.radius_mm.into())));
    let room = if even { ROOM } else { ROOM_UNEVEN };
    let needed =
        sets.iter().flatten().map(|pitch| (room * pitch.passing_mm).max(pitch.beside_mm) / pitch.pitch_mm);
    let needed = needed.fold(0.0, f64::max);
    if needed <= 1.0 + ROUNDING {
        return Ok(woven);
    }
    let factor = (1.0 / needed) as f32;
    warnings.push(format!(
        "some threads lie closer than most; all diameters are taken {factor:.4} times as large"
    ));
    let thinner = |set: &[Thread]| {
        set.iter().map(|thread| Thread { radius_mm: factor * thread.radius_mm, ..*thread }).collect()
    };
    let (warp, weft) = (thinner(woven.warp()), thinner(woven.weft()));
    Woven::new(woven.drawdown().clone(), warp, weft, woven.materials().to_vec(), woven.sections().to_vec())
}

/// Whether lengths are equal, but for rounding.
fn are_alike(lengths: impl Iterator<Item = f64> + Clone) -> bool {
    lengths.clone().fold(0.0, f64::max) <= (1.0 + ALIKE) * lengths.fold(f64::INFINITY, f64::min)
}

/// The mean of the lengths that are known, or none if none is known.
fn mean(lengths: &[Option<f64>]) -> Option<f64> {
    let (count, sum) =
        lengths.iter().flatten().fold((0, 0.0), |(count, sum), length| (count + 1, sum + length));
    (count > 0).then(|| sum / f64::from(count))
}

impl Set {
    fn read(
        ini: &Ini<'_>,
        section: &str,
        count: u32,
        palette: &mut Palette,
        warnings: &mut Vec<String>,
    ) -> Result<Self, ReadError> {
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
        let common =
            common.map(|entry| palette.material(ini, section, "color", entry)).transpose()?.flatten();
        let mut material = filled("colours of threads", count as usize, common)?;
        let single = format!("{section} colors");
        for (number, entry) in numbered(ini, &single, count, warnings)? {
            if let Some(own) = palette.material(ini, &single, &number.to_string(), &entry)? {
                material[number as usize - 1] = Some(own);
            }
        }
        Ok(Self { common: [spacing, thickness], spacing_mm, thickness_mm, material })
    }

    /// Whether the thickness for the whole set equals the spacing for the whole set, or all threads
    /// together are at least as thick as they are spaced.
    fn is_drawn(&self) -> bool {
        let alike = |[spacing, thickness]: [Option<f64>; 2]| {
            spacing.zip(thickness).map(|(spacing, thickness)| thickness / spacing)
        };
        alike(self.common).is_some_and(|ratio| (ratio - 1.0).abs() <= ALIKE)
            || alike([&self.spacing_mm, &self.thickness_mm].map(|of| mean(of)))
                .is_some_and(|ratio| ratio >= 1.0 - ALIKE)
    }

    /// The threads of the set. `spacing` and `diameter`, mm, are used where the file gives none. If
    /// thicknesses are `drawn`, they are scaled so that their mean is `diameter`.
    fn threads(
        self,
        name: &str,
        drawn: bool,
        spacing: f64,
        diameter: f64,
        warnings: &mut Vec<String>,
    ) -> Result<Vec<Thread>, ReadError> {
        let count = self.material.len();
        let threads = counted(count, "thread");
        let have = |count| if count == 1 { "has" } else { "have" };
        // Drawn thicknesses still give the ratios of the threads' diameters.
        let scale = mean(&self.thickness_mm).filter(|_| drawn).map_or(1.0, |drawn| diameter / drawn);
        let thin = self.thickness_mm.iter().filter(|thickness| thickness.is_none()).count();
        let plain = self.material.iter().filter(|material| material.is_none()).count();
        if drawn {
            warnings.push(format!(
                "[{name}] has threads as thick as they are spaced, which leaves those that cross no room; {diameter:.4} mm \
                 is taken, half the mean spacing, for their mean"
            ));
        } else if thin > 0 {
            warnings.push(format!(
                "[{name}] {thin} of {threads} {} no thickness; {diameter:.4} mm is taken, half the mean spacing", have(thin)
            ));
        }
        if plain > 0 {
            warnings
                .push(format!("[{name}] {plain} of {threads} {} no colour; undyed is taken", have(plain)));
        }
        // A thread without a spacing gets the mean of those that have one.
        let spacing = mean(&self.spacing_mm).unwrap_or(spacing);
        let mut all = room("threads", count)?;
        let each = self.spacing_mm.into_iter().zip(self.thickness_mm).zip(self.material);
        all.extend(each.map(|((own_spacing, thickness), material)| Thread {
            spacing_mm: own_spacing.unwrap_or(spacing),
            radius_mm: (thickness.map_or(diameter, |thickness| scale * thickness) / 2.0) as f32,
            flatness: 1.0,
            stiffness: 1.0,
            material: material.unwrap_or(NO_COLOR),
            section: 0,
            twist: 0.0,
        }));
        Ok(all)
    }
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
