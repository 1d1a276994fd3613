//! Colours and spacings of a Fiberworks file.

use texere_core::Material;
use texere_core::backend::filled;

use super::sections::{Row, Sections};
use crate::read::ReadError;
use crate::read::draft::{DraftThreads, LENGTH_MM, ThreadSet, color};

/// The unit of spacings, mm. Fiberworks writes a spacing of 4 as 0.212 cm to WIF.
const UNIT_MM: f64 = 0.53;

/// The spacing of threads without one, in units. Fiberworks writes 0.212 cm to WIF for them.
const SPACING: u32 = 4;

/// The colours of a warp and a weft without colours, counted from 0.
const COLORS: [usize; 2] = [0, 1];

/// The threads of warp and weft. `counts` are the numbers of ends and picks.
pub(super) fn threads(dtx: &Sections<'_>, [ends, picks]: [u32; 2]) -> Result<DraftThreads, ReadError> {
    let mut materials = vec![Material::default()];
    let rows = dtx.get("color palette").into_iter().flat_map(|section| &section.rows);
    for (number, row) in (1..).zip(rows) {
        materials.push(color(number, rgb(dtx, *row)?));
    }
    let colors = materials.len() - 1;
    let set = |place, names: [&str; 2], count, default: usize| {
        let material = self::materials(dtx, names[0], count, colors, default)?;
        let (spacing_mm, thickness_mm) = (spacings(dtx, names[1], count)?, filled("threads", count, None)?);
        Ok::<_, ReadError>(ThreadSet { place, spacing_mm, thickness_mm, drawn: false, material })
    };
    Ok(DraftThreads {
        warp: set("in the warp", ["warp colors", "warp spacing"], ends as usize, COLORS[0])?,
        weft: set("in the weft", ["weft colors", "weft spacing"], picks as usize, COLORS[1])?,
        materials,
    })
}

/// The colour in a row of the palette.
fn rgb(dtx: &Sections<'_>, row: Row<'_>) -> Result<[u8; 3], ReadError> {
    let channel = |text: &str| text.trim().parse().ok();
    let channels: Option<Vec<u8>> = row.text.split(',').take(4).map(channel).collect();
    let rgb = channels.and_then(|channels| <[u8; 3]>::try_from(channels).ok());
    rgb.ok_or_else(|| row.refused(dtx.file, "red, green and blue from 0 to 255, separated by commas"))
}

/// The number of each thread's material. Threads beyond the list have the colour of the first.
fn materials(
    dtx: &Sections<'_>,
    section: &str,
    count: usize,
    colors: usize,
    default: usize,
) -> Result<Vec<Option<u32>>, ReadError> {
    if colors == 0 && dtx.get(section).is_some() {
        let needed_for = "the colours of threads are numbers of its lines";
        return Err(ReadError::MissingKey {
            file: dtx.file.into(),
            field: "@@Color Palette".into(),
            needed_for,
        });
    }
    let most = colors.saturating_sub(1) as u32;
    let numbers = dtx.numbers(section, most, "a colour of @@Color Palette")?;
    // The first material is that of threads without a colour.
    let first = numbers.first().map_or(default, |&number| number as usize) as u32 + 1;
    let mut materials =
        filled("colours of threads", count, Some(first).filter(|&first| first <= colors as u32))?;
    for (material, number) in materials.iter_mut().zip(numbers) {
        *material = Some(number + 1);
    }
    Ok(materials)
}

/// The spacing of each thread, mm.
fn spacings(dtx: &Sections<'_>, section: &str, count: usize) -> Result<Vec<Option<f64>>, ReadError> {
    let most = (LENGTH_MM[1] / UNIT_MM) as u32;
    let units = dtx.numbers(section, most, "a spacing in units of 0.53 mm")?;
    let usual = Some(f64::from(SPACING) * UNIT_MM);
    let mut spacings = filled("lengths of threads", count, usual)?;
    // 0 counts as not given, as in WIF.
    for (spacing, units) in spacings.iter_mut().zip(units).filter(|(_, units)| *units > 0) {
        *spacing = Some(f64::from(units) * UNIT_MM);
    }
    Ok(spacings)
}
