//! From the `[weave]` table of a design file to a drawdown.

use std::collections::BTreeMap;
use std::path::Path;

use texere_fabric::{Drawdown, Weave};
use toml::Spanned;

use super::schema::{Source, WeaveTable};
use crate::read::ReadError;
use crate::read::point_paper::PointPaper;

/// One weave over the whole cloth.
pub(super) fn from_notation(
    source: &Source<'_>,
    table: &WeaveTable,
    notation: &Spanned<String>,
) -> Result<Drawdown, ReadError> {
    without_image(source, table)?;
    let needed = |field: &str| ReadError::MissingKey {
        file: source.path.into(),
        field: field.into(),
        needed_for: "a notation needs a size",
    };
    let ends = table.ends.as_ref().ok_or_else(|| needed("weave.ends"))?;
    let picks = table.picks.as_ref().ok_or_else(|| needed("weave.picks"))?;
    let (ends, picks) = (source.count("weave.ends", ends)?, source.count("weave.picks", picks)?);
    let weave = source.weave("weave.notation", notation)?;
    weave.drawdown(ends, picks).map_err(|error| source.fabric(error))
}

/// Refuses keys that say something of an image.
pub(super) fn without_image(source: &Source<'_>, table: &WeaveTable) -> Result<(), ReadError> {
    let spans = [
        ("weave.rows", table.rows.as_ref().map(Spanned::span)),
        ("weave.repeat", table.repeat.as_ref().map(Spanned::span)),
        ("weave.colors", table.colors.as_ref().map(Spanned::span)),
    ];
    match spans.into_iter().find_map(|(field, span)| Some((field, span?))) {
        Some((field, span)) => {
            Err(ReadError::Without { place: source.place(field, span), needs: "weave.image" })
        }
        None => Ok(()),
    }
}

/// An image, each pixel a crossing.
pub(super) fn from_image(
    source: &Source<'_>,
    table: &WeaveTable,
    image: &str,
    warnings: &mut Vec<String>,
) -> Result<Drawdown, ReadError> {
    let weaves = table.colors.as_ref().map(|colors| weaves(source, colors.as_ref())).transpose()?;
    let [across, along] = match &table.repeat {
        None => [1, 1],
        Some(repeat) => {
            let [across, along] = repeat.as_ref();
            [source.count("weave.repeat", across)?, source.count("weave.repeat", along)?]
        }
    };
    let path = source.path.parent().unwrap_or(Path::new("")).join(image);
    let rows = table.rows.as_ref().map(|rows| *rows.as_ref()).unwrap_or_default();
    let paper = PointPaper::read(&path, rows)?;
    // Drawdown refuses what is too large.
    let (ends, picks) = (paper.ends.saturating_mul(across), paper.picks.saturating_mul(along));
    for (field, given, size) in [("weave.ends", &table.ends, ends), ("weave.picks", &table.picks, picks)] {
        if let Some(given) = given.as_ref().filter(|given| i64::try_from(size) != Ok(*given.as_ref())) {
            return Err(source.bad(field, given, &format!("{size}, as the image and weave.repeat make it")));
        }
    }
    let drawdown = match weaves {
        None => {
            let darker = paper.darker()?;
            Drawdown::from_fn(ends, picks, |end, pick| paper.color(end, pick) == darker)
        }
        Some(weaves) => {
            let weaves = of_colors(&paper, weaves, warnings)?;
            Drawdown::from_fn(ends, picks, |end, pick| weaves[paper.color(end, pick)].up(end, pick))
        }
    };
    drawdown.map_err(|error| source.fabric(error))
}

/// The table of colours, by red, green and blue.
fn weaves(
    source: &Source<'_>,
    colors: &BTreeMap<Spanned<String>, Spanned<String>>,
) -> Result<BTreeMap<[u8; 3], Weave>, ReadError> {
    let mut weaves = BTreeMap::new();
    for (color, notation) in colors {
        let rgb = source.rgb("a colour of [weave.colors]", color)?;
        let weave = source.weave(&format!("weave.colors.\"{}\"", color.as_ref()), notation)?;
        if weaves.insert(rgb, weave).is_some() {
            return Err(source.bad("a colour of [weave.colors]", color, "each colour once, in either case"));
        }
    }
    Ok(weaves)
}

/// The weave of each colour of the paper; a warning for each that is in the table alone.
fn of_colors(
    paper: &PointPaper,
    mut weaves: BTreeMap<[u8; 3], Weave>,
    warnings: &mut Vec<String>,
) -> Result<Vec<Weave>, ReadError> {
    let hex = |[red, green, blue]: &[u8; 3]| format!("#{red:02x}{green:02x}{blue:02x}");
    let known: Vec<_> = weaves.keys().map(hex).collect();
    let found = paper.colors.iter().map(|color| {
        let weave = color.rgb().and_then(|rgb| weaves.remove(&rgb));
        weave
            .ok_or_else(|| color.refused(&paper.file, format!("one of [weave.colors]: {}", known.join(", "))))
    });
    let found = found.collect::<Result<_, _>>()?;
    let unused = weaves.keys().map(hex);
    let file = paper.file.display();
    warnings.extend(unused.map(|color| format!("weave.colors has {color}, which no pixel of {file} has")));
    Ok(found)
}
