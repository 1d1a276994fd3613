//! The colour table of a WIF file.

use std::collections::BTreeMap;

use texere_core::{Material, counted};

use super::ini::{Entry, Ini};
use super::numbers::{bad, list, place};
use crate::read::ReadError;
use crate::read::draft::color;

/// The colours of a draft by number, and their materials.
#[derive(Debug)]
pub(super) struct Palette {
    materials: Vec<Material>,
    /// For each number of a colour, the number of its material.
    by_number: BTreeMap<u32, u32>,
}

impl Palette {
    pub(super) fn read(ini: &Ini<'_>, warnings: &mut Vec<String>) -> Result<Self, ReadError> {
        let mut palette = Self { materials: vec![Material::default()], by_number: BTreeMap::new() };
        let mut table = BTreeMap::new();
        let mut lines: Vec<_> =
            ini.entries("color table").filter(|(_, entry)| !entry.value.is_empty()).collect();
        // Lines are checked in the file's order, so that the error is the first of several faults.
        lines.sort_unstable_by_key(|(_, entry)| entry.line);
        for (key, entry) in lines {
            let expected = "red, green and blue, numbered from 1";
            let number = key.parse().ok().filter(|&number: &u32| number > 0);
            let number = number.ok_or_else(|| bad(ini, "color table", key, entry, expected))?;
            let rgb = few(ini, "color table", key, entry)?;
            let rgb = <[u32; 3]>::try_from(rgb).map_err(|_| bad(ini, "color table", key, entry, expected))?;
            table.insert(number, rgb);
        }
        let (low, high) = range(ini, &table, warnings)?;
        let mut clamped = 0;
        for (number, rgb) in table {
            let srgb = rgb.map(|channel| {
                clamped += u32::from(!(low..=high).contains(&channel));
                scaled(channel, low, high)
            });
            palette.by_number.insert(number, palette.materials.len() as u32);
            palette.materials.push(color(number, srgb));
        }
        if clamped > 0 {
            let (values, lie) = (counted(clamped, "value"), if clamped == 1 { "lies" } else { "lie" });
            warnings.push(format!("{values} of [COLOR TABLE] {lie} outside the range {low} to {high}"));
        }
        Ok(palette)
    }

    /// The material of the colour that `entry` names: a number of the table, or a number with red,
    /// green and blue. `None` if the entry names no colour.
    pub(super) fn material(
        &mut self,
        ini: &Ini<'_>,
        section: &str,
        key: &str,
        entry: &Entry<'_>,
    ) -> Result<Option<u32>, ReadError> {
        let Some(first) = list(ini, section, key, entry).next().transpose()? else { return Ok(None) };
        // Colour 0 is refused below. Shaft 0 stands for no shaft, but colour 0 does not stand for
        // no colour.
        let number = u32::try_from(first).unwrap_or(0);
        if let Some(&material) = self.by_number.get(&number) {
            return Ok(Some(material));
        }
        if number > 0
            && let [_, red, green, blue] = few(ini, section, key, entry)?[..]
        {
            let srgb = [red, green, blue].map(|channel| scaled(channel, 0, 255));
            let material = self.materials.len() as u32;
            self.by_number.insert(number, material);
            self.materials.push(color(number, srgb));
            return Ok(Some(material));
        }
        if self.by_number.is_empty() {
            return Err(bad(ini, section, key, entry, "no colour, since there is no [COLOR TABLE]"));
        }
        let high = self.by_number.keys().max().copied().unwrap_or(0);
        if number == 0 || number > high {
            let (place, value) = (place(ini, section, key, entry), first as f64);
            return Err(ReadError::OutOfRange { place, value, low: 1.0, high: high.into() });
        }
        Err(bad(ini, section, key, entry, "the number of a colour in [COLOR TABLE]"))
    }

    pub(super) fn into_materials(self) -> Vec<Material> {
        self.materials
    }
}

/// The numbers of a value, five at most.
fn few(ini: &Ini<'_>, section: &str, key: &str, entry: &Entry<'_>) -> Result<Vec<u32>, ReadError> {
    let numbers = list(ini, section, key, entry).take(5).map(|number| {
        u32::try_from(number?).map_err(|_| bad(ini, section, key, entry, "numbers from 0 to 4294967295"))
    });
    numbers.collect()
}

/// The range of the table's values. If the file states none, it is the first of 0 to 255, 0 to 999
/// (Fiberworks) and 0 to 65,535 that holds all values, or else 0 to the greatest value.
fn range(
    ini: &Ini<'_>,
    table: &BTreeMap<u32, [u32; 3]>,
    warnings: &mut Vec<String>,
) -> Result<(u32, u32), ReadError> {
    if let Some(entry) = ini.get("color palette", "range") {
        return match few(ini, "color palette", "range", entry)?[..] {
            [low, high] if low < high => Ok((low, high)),
            [high] if high > 0 => {
                warnings.push(format!("[COLOR PALETTE] Range is {high} alone; 0 to {high} is taken"));
                Ok((0, high))
            }
            _ => Err(bad(ini, "color palette", "range", entry, "two numbers, the lower one first")),
        };
    }
    let most = table.values().flatten().max().copied().unwrap_or(0);
    let high = [255, 999, 65_535].into_iter().find(|&high| most <= high).unwrap_or(most);
    if !table.is_empty() {
        warnings.push(format!("[COLOR PALETTE] has no Range; 0 to {high} is taken"));
    }
    Ok((0, high))
}

/// Scales `channel` from `low`..=`high` to 0..=255, rounded.
fn scaled(channel: u32, low: u32, high: u32) -> u8 {
    let (channel, span) = (u64::from(channel.clamp(low, high) - low), u64::from(high - low));
    ((channel * 255 + span / 2) / span) as u8
}
