//! Makes a drawdown from the `[weave]` table of a design file.

use std::collections::BTreeMap;

use texere_fabric::{Drawdown, Weave};
use toml::Spanned;

use super::schema::WeaveTable;
use super::source::Source;
use crate::read::ReadError;
use crate::read::error::{first_few, named, shown};
use crate::read::point_paper::PointPaper;

/// The drawdown of one weave over the whole cloth.
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

/// A drawdown in rows of digits, repeated over the whole cloth.
pub(super) fn from_rows(
    source: &Source<'_>,
    table: &WeaveTable,
    text: &Spanned<String>,
) -> Result<Drawdown, ReadError> {
    without_image(source, table)?;
    let field = "weave.drawdown";
    let rows: Vec<_> = text.as_ref().lines().map(str::trim).filter(|row| !row.is_empty()).collect();
    let width = rows.first().map_or(0, |row| row.len());
    if width == 0 {
        return Err(source.bad(field, text, "a row of 1 and 0 for each pick"));
    }
    for (row, number) in rows.iter().zip(1..) {
        let odd = |expected: String| {
            let place = source.place(&format!("{field}, row {number} from the top,"), text.span());
            ReadError::BadValue { place, value: shown(row), expected }
        };
        if !row.bytes().all(|digit| matches!(digit, b'0' | b'1')) {
            return Err(odd("1 where the warp is up, 0 where it is not".into()));
        }
        if row.len() != width {
            return Err(odd(format!("{width} digits, as in the row on top")));
        }
    }
    let size = |field, given: &Option<Spanned<i64>>, own| {
        given.as_ref().map_or(Ok(own), |count| source.count(field, count))
    };
    let (ends, picks) =
        (size("weave.ends", &table.ends, width)?, size("weave.picks", &table.picks, rows.len())?);
    // The last pick is the row on top.
    let up = |end: usize, pick: usize| rows[rows.len() - 1 - pick].as_bytes()[end] == b'1';
    Drawdown::repeating(ends, picks, (width, rows.len()), up).map_err(|error| source.fabric(error))
}

/// Refuses keys that are about an image.
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

/// The drawdown of an image, of which each pixel is a crossing.
pub(super) fn from_image(
    source: &Source<'_>,
    table: &WeaveTable,
    image: &Spanned<String>,
    warnings: &mut Vec<String>,
) -> Result<Drawdown, ReadError> {
    let weaves = table.colors.as_ref().map(|colors| weaves(source, colors.as_ref())).transpose()?;
    let [across, along] = match &table.repeat {
        None => [1, 1],
        Some(repeat) => match &repeat.as_ref()[..] {
            [across, along] => [source.count("weave.repeat", across)?, source.count("weave.repeat", along)?],
            _ => {
                let expected = "two whole numbers, across the ends and along the picks";
                return Err(source.unfit("weave.repeat", repeat.span(), expected));
            }
        },
    };
    let path = source.beside(image);
    let rows = table.rows.as_ref().map(|rows| *rows.as_ref()).unwrap_or_default();
    let refused = |error: ReadError| error.named(source.place("weave.image", image.span()));
    let paper = PointPaper::read(&path, source.files, rows).map_err(refused)?;
    // `Drawdown` refuses a cloth that is too large.
    let (ends, picks) = (paper.ends.saturating_mul(across), paper.picks.saturating_mul(along));
    for (field, given, size) in [("weave.ends", &table.ends, ends), ("weave.picks", &table.picks, picks)] {
        if let Some(given) = given.as_ref().filter(|given| i64::try_from(size) != Ok(*given.as_ref())) {
            return Err(source.bad(field, given, &format!("{size}, as the image and weave.repeat make it")));
        }
    }
    let drawdown = match weaves {
        None => {
            let darker = paper.darker().map_err(refused)?;
            let up = |end, pick| paper.color(end, pick) == darker;
            Drawdown::repeating(ends, picks, (paper.ends, paper.picks), up)
        }
        Some(weaves) => {
            let weaves = of_colors(source, &paper, weaves, warnings)?.map_err(refused)?;
            // The drawdown repeats where the paper and all its weaves repeat together.
            let repeat = weaves.iter().map(Weave::repeat).fold((paper.ends, paper.picks), |all, one| {
                (common_multiple(all.0, one.0), common_multiple(all.1, one.1))
            });
            let up = |end, pick| weaves[paper.color(end, pick)].up(end, pick);
            Drawdown::repeating(ends, picks, repeat, up)
        }
    };
    drawdown.map_err(|error| source.fabric(error))
}

/// The least common multiple, or `usize::MAX` if it does not fit.
fn common_multiple(a: usize, b: usize) -> usize {
    let (mut divisor, mut rest) = (a, b);
    while rest != 0 {
        (divisor, rest) = (rest, divisor % rest);
    }
    (a / divisor.max(1)).saturating_mul(b)
}

/// The table of colours, by red, green and blue. Each notation is parsed here only to refuse a bad
/// one. Weaves are not kept, because a table may have many more colours than the paper.
fn weaves<'a>(
    source: &Source<'_>,
    colors: &'a BTreeMap<Spanned<String>, Spanned<String>>,
) -> Result<BTreeMap<[u8; 3], Notated<'a>>, ReadError> {
    let mut weaves = BTreeMap::new();
    for (color, notation) in colors {
        let rgb = source.rgb("a colour of [weave.colors]", color)?;
        let notated = Notated { color, notation };
        notated.weave(source)?;
        if weaves.insert(rgb, notated).is_some() {
            return Err(source.bad("a colour of [weave.colors]", color, "each colour once, in either case"));
        }
    }
    Ok(weaves)
}

/// A colour and its weave, as `[weave.colors]` has them.
struct Notated<'a> {
    color: &'a Spanned<String>,
    notation: &'a Spanned<String>,
}

impl Notated<'_> {
    fn weave(&self, source: &Source<'_>) -> Result<Weave, ReadError> {
        source.weave(&format!("weave.colors.\"{}\"", self.color.as_ref()), self.notation)
    }
}

/// The weave of each colour of the paper. The outer error is a fault of the table. The inner error
/// is a fault of the image: a colour without a weave. A colour of the table that the paper lacks
/// gives a warning.
fn of_colors(
    source: &Source<'_>,
    paper: &PointPaper,
    mut weaves: BTreeMap<[u8; 3], Notated<'_>>,
    warnings: &mut Vec<String>,
) -> Result<Result<Vec<Weave>, ReadError>, ReadError> {
    let hex = |[red, green, blue]: &[u8; 3]| format!("#{red:02x}{green:02x}{blue:02x}");
    let known = first_few(weaves.keys().map(hex));
    let mut found = Vec::new();
    for color in &paper.colors {
        match color.rgb().and_then(|rgb| weaves.remove(&rgb)) {
            Some(notated) => found.push(notated.weave(source)?),
            None => return Ok(Err(color.refused(&paper.file, format!("one of [weave.colors]: {known}")))),
        }
    }
    if !weaves.is_empty() {
        let (count, file) = (weaves.len(), named(&paper.file));
        let colors = if count == 1 { "a colour" } else { &format!("{count} colours") };
        let unused = first_few(weaves.keys().map(hex));
        warnings.push(format!("weave.colors has {colors} that no pixel of {file} has: {unused}"));
    }
    Ok(Ok(found))
}
