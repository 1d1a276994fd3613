//! Spacing, thickness and colour of each end and pick.

use texere_fabric::Thread;

use super::colors::{NO_COLOR, Palette};
use super::ini::Ini;
use super::numbers::{bad, length, numbered};
use crate::read::ReadError;

/// Spacing where the file gives none, mm: 10 threads to the centimetre.
const DEFAULT_SPACING_MM: f64 = 1.0;

/// The widest spacing or thickness that is taken, mm.
const LENGTH_LIMIT_MM: f64 = 1000.0;

/// What one of the two sets of threads is told by.
#[derive(Debug, Default)]
struct Set {
    spacing_mm: Vec<Option<f64>>,
    thickness_mm: Vec<Option<f64>>,
    material: Vec<Option<u32>>,
}

/// The warp's and the weft's threads, `counts` of them.
pub(super) fn read(
    ini: &Ini,
    counts: [u32; 2],
    palette: &mut Palette,
    warnings: &mut Vec<String>,
) -> Result<(Vec<Thread>, Vec<Thread>), ReadError> {
    let warp = Set::read(ini, "warp", counts[0], palette, warnings)?;
    let weft = Set::read(ini, "weft", counts[1], palette, warnings)?;
    // A set without any spacing of its own is set as close as the other.
    let [warp_pitch, weft_pitch] = [warp.mean_spacing(), weft.mean_spacing()];
    let fallback = warp_pitch.or(weft_pitch).unwrap_or(DEFAULT_SPACING_MM);
    for (name, pitch) in [("WARP", warp_pitch), ("WEFT", weft_pitch)] {
        if pitch.is_none() {
            warnings.push(format!("[{name}] has no spacing; {fallback:.4} mm is taken"));
        }
    }
    let diameter = warp_pitch.unwrap_or(fallback).min(weft_pitch.unwrap_or(fallback)) / 2.0;
    let threads =
        |name: &str, set: Set, warnings: &mut Vec<String>| set.threads(name, fallback, diameter, warnings);
    Ok((threads("WARP", warp, warnings), threads("WEFT", weft, warnings)))
}

impl Set {
    fn read(
        ini: &Ini,
        section: &str,
        count: u32,
        palette: &mut Palette,
        warnings: &mut Vec<String>,
    ) -> Result<Self, ReadError> {
        let unit = unit_mm(ini, section, warnings)?;
        let mut lengths = |what: &str| -> Result<Vec<Option<f64>>, ReadError> {
            let limit = LENGTH_LIMIT_MM / unit;
            let common =
                ini.get(section, what).map(|entry| length(ini, section, what, entry, limit)).transpose()?;
            let mut values = vec![common.flatten().map(|value| value * unit); count as usize];
            let single = format!("{section} {what}");
            for (number, entry) in numbered(ini, &single, count, warnings) {
                if entry.value.is_empty() {
                    continue;
                }
                if let Some(value) = length(ini, &single, &number.to_string(), entry, limit)? {
                    values[number as usize - 1] = Some(value * unit);
                }
            }
            Ok(values)
        };
        let (spacing_mm, thickness_mm) = (lengths("spacing")?, lengths("thickness")?);

        let common = ini.get(section, "color");
        let common =
            common.map(|entry| palette.material(ini, section, "color", entry)).transpose()?.flatten();
        let mut material = vec![common; count as usize];
        let single = format!("{section} colors");
        for (number, entry) in numbered(ini, &single, count, warnings) {
            if let Some(own) = palette.material(ini, &single, &number.to_string(), entry)? {
                material[number as usize - 1] = Some(own);
            }
        }
        Ok(Self { spacing_mm, thickness_mm, material })
    }

    fn mean_spacing(&self) -> Option<f64> {
        let known: Vec<f64> = self.spacing_mm.iter().copied().flatten().collect();
        (!known.is_empty()).then(|| known.iter().sum::<f64>() / known.len() as f64)
    }

    /// The threads, with `spacing` and `diameter` where the file gives none.
    fn threads(self, name: &str, spacing: f64, diameter: f64, warnings: &mut Vec<String>) -> Vec<Thread> {
        let count = self.material.len();
        let without = |what: &[bool]| what.iter().filter(|&&missing| missing).count();
        let thin = without(&self.thickness_mm.iter().map(Option::is_none).collect::<Vec<_>>());
        let plain = without(&self.material.iter().map(Option::is_none).collect::<Vec<_>>());
        if thin > 0 {
            warnings.push(format!(
                "[{name}] {thin} of {count} threads have no thickness; {diameter:.4} mm is taken, half the mean spacing"
            ));
        }
        if plain > 0 {
            warnings.push(format!("[{name}] {plain} of {count} threads have no colour; undyed is taken"));
        }
        // A thread without spacing among others that have one is set like their mean.
        let spacing = self.mean_spacing().unwrap_or(spacing);
        let each = self.spacing_mm.into_iter().zip(self.thickness_mm).zip(self.material);
        each.map(|((own_spacing, thickness), material)| Thread {
            spacing_mm: own_spacing.unwrap_or(spacing),
            radius_mm: (thickness.unwrap_or(diameter) / 2.0) as f32,
            material: material.unwrap_or(NO_COLOR),
            section: 0,
            twist: 0.0,
        })
        .collect()
    }
}

/// The unit of a section's lengths in mm.
fn unit_mm(ini: &Ini, section: &str, warnings: &mut Vec<String>) -> Result<f64, ReadError> {
    /// A decipoint is a tenth of a point, of which 72 make an inch.
    const DECIPOINT_MM: f64 = 25.4 / 720.0;
    let Some(entry) = ini.get(section, "units") else {
        if ini.get(section, "spacing").is_some() || ini.get(section, "thickness").is_some() {
            warnings.push(format!("[{}] has no Units; centimeters are taken", section.to_uppercase()));
        }
        return Ok(10.0);
    };
    match entry.value.to_lowercase().as_str() {
        "centimeters" | "centimetres" | "centimeter" | "cm" => Ok(10.0),
        "inches" | "inch" | "in" => Ok(25.4),
        "decipoints" | "decipoint" => Ok(DECIPOINT_MM),
        "millimeters" | "millimetres" | "millimeter" | "mm" => Ok(1.0),
        _ => Err(bad(ini, section, "units", entry, "Decipoints, Inches or Centimeters")),
    }
}
