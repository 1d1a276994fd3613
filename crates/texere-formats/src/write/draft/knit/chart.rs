//! Draws a stitch chart, and the needle diagram below it.

use std::io::Write;

use texere_fabric::weft::Knitted;

use super::grid::{Grid, extent};
use super::needles::Needles;
use super::symbols;
use super::yarn_color::yarn_color;
use crate::write::draft::Side;
use crate::write::draft::limits::{SIDE_AIM, SIDE_MAX, SQUARE_MAX};
use crate::write::draft::sheet::{Block, INK, PAPER, Rgb, Sheet};
use crate::write::picture::png;
use crate::write::{Output, WriteError};

/// The most wales, and the most passes of carriers, of a needle diagram. By eye: with more, its
/// loops are hard to tell apart.
const NEEDLES_MAX: usize = 100;

/// The most squares of a chart, as many as 8,192 wales and courses have. Large Jacquards have
/// fewer.
const SQUARES_MAX: usize = 1 << 26;

/// The smallest square with a symbol in it, pixels. By eye.
const SYMBOL_MIN: usize = 6;

/// The colour of a square where no yarn knits, tucks or floats.
const NONE: Rgb = [205, 205, 205];

/// The sum of a colour's three channels below which the colour is dark. Symbols are white on dark
/// colours, and black on others. By eye.
const DARK: u32 = 300;

/// Draws a knit's stitch chart to a PNG file: one repeat, or the whole piece if the knit has no
/// repeat. The needle diagram stands below the chart if `side` is the face, and what the chart
/// shows has at most 100 wales and 100 passes of carriers. Returns the picture's width and height
/// in pixels.
///
/// **Errors**: [`WriteError::NotPng`] if `output` does not end in `.png`,
/// [`WriteError::ChartTooLarge`], [`WriteError::Spared`], [`WriteError::Io`].
///
/// ```
/// use texere_core::{Material, Section};
/// use texere_fabric::weft::{Beds, Chart, Gauge, KnitYarn, Knitted, Machine};
/// use texere_formats::write::{Side, knit_draft};
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("rib.png");
/// let program = Chart::parse("kp", Beds::One)?.program()?;
/// let stitches = Machine::default().knit(&program)?.stitches;
/// let (yarn, gauge) = (KnitYarn::new(0.1), Gauge::new(1.0, 0.75));
/// let rib = Knitted::new(stitches, gauge, vec![yarn], vec![Material::default()], vec![Section::Circle], [8, 8])?;
/// knit_draft(&rib, Side::Face, &path)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn knit_draft(cloth: &Knitted, side: Side, output: impl Into<Output>) -> Result<[u32; 2], WriteError> {
    let output = png(output.into())?;
    drawn(cloth, side, |sheet| sheet.save(output))
}

/// Draws a knit's stitch chart to `out`: the bytes that [`knit_draft`] writes to a file. Returns
/// the picture's width and height in pixels.
///
/// **Errors**: [`WriteError::ChartTooLarge`], [`WriteError::Writer`] if `out` refuses bytes.
pub fn knit_draft_to(cloth: &Knitted, side: Side, out: impl Write) -> Result<[u32; 2], WriteError> {
    drawn(cloth, side, |sheet| sheet.save_to(out))
}

/// Draws a knit on a sheet, and passes the sheet to `save`.
fn drawn(
    cloth: &Knitted,
    side: Side,
    save: impl FnOnce(&Sheet<'_>) -> Result<[u32; 2], WriteError>,
) -> Result<[u32; 2], WriteError> {
    let (size, left) = sized(cloth)?;
    let grid = Grid::new(cloth.stitches());
    let small = size[0] <= NEEDLES_MAX && side == Side::Face;
    let needles = if small { Needles::new(cloth, size[0], left, NEEDLES_MAX) } else { None };
    let sheet = lay_out(cloth, &grid, needles.as_ref(), side);
    let [width, height] = sheet.size;
    if width.max(height) > SIDE_MAX {
        return Err(too_large(size));
    }
    save(&sheet)
}

/// A row of letters for each course of a knit's stitch chart, the last course first. The letters
/// are those of charts in design files, with `.` for a square that no yarn comes to.
///
/// **Errors**: [`WriteError::ChartTooLarge`].
pub fn knit_rows(cloth: &Knitted, side: Side) -> Result<impl Iterator<Item = String>, WriteError> {
    let ([wales, courses], _) = sized(cloth)?;
    let grid = Grid::new(cloth.stitches());
    Ok((0..courses).map(move |row| {
        let squares = (0..wales).map(|column| grid.square(column, row, side == Side::Back));
        squares.map(|square| square.map_or('.', |(symbol, _)| symbol.letter())).collect()
    }))
}

/// The number of wales and courses of the chart, and its leftmost wale. A chart with too many
/// squares is refused.
fn sized(cloth: &Knitted) -> Result<([usize; 2], i64), WriteError> {
    let (size, left) = extent(cloth.stitches());
    if size[0].saturating_mul(size[1]) > SQUARES_MAX { Err(too_large(size)) } else { Ok((size, left)) }
}

const fn too_large([wales, courses]: [usize; 2]) -> WriteError {
    WriteError::ChartTooLarge { wales, courses, side: SIDE_MAX, squares: SQUARES_MAX }
}

fn lay_out<'a>(cloth: &'a Knitted, grid: &'a Grid, needles: Option<&'a Needles>, side: Side) -> Sheet<'a> {
    let [wales, courses] = grid.size;
    let square = (SIDE_AIM / wales.max(courses).max(1)).clamp(1, SQUARE_MAX);
    let back = side == Side::Back;
    let mut sheet = Sheet::new(square, back);
    let [left, _] = Sheet::ORIGIN;
    let [_, below] = sheet.put(Block {
        place: Sheet::ORIGIN,
        squares: grid.size,
        square: [square; 2],
        color: Box::new(move |column, row, at| {
            let Some((symbol, carrier)) = grid.square(column, row, back) else { return NONE };
            let color = yarn_color(cloth, carrier);
            let inked = square >= SYMBOL_MIN && symbols::inked(symbol, at, square);
            let dark = color.iter().map(|&channel| u32::from(channel)).sum::<u32>() < DARK;
            match (inked, dark) {
                (false, _) => color,
                (true, false) => INK,
                (true, true) => PAPER,
            }
        }),
    });
    if let Some(needles) = needles {
        sheet.put(Block {
            place: [left, below],
            squares: needles.canvas.size,
            square: [1, 1],
            color: Box::new(|x, y, _| needles.canvas.pixel(x, y)),
        });
    }
    let (side, wale) = if back { ("BACK", "RIGHT") } else { ("FACE", "LEFT") };
    let mut legend = vec![
        format!("{side}. EMPTY: KNIT, DOT: PURL"),
        "BAR: BOTH BEDS, RING: YARN OVER".into(),
        "ARCH: TUCK, DASH: MISS".into(),
        "SLANTED: MOVED TO ANOTHER WALE".into(),
        format!("WALE 1 {wale}, COURSE 1 BOTTOM"),
        format!("{wales} WALES, {courses} COURSES"),
    ];
    if needles.is_some() {
        legend.push("NEEDLES: BACK BED ABOVE".into());
        legend.push("BLUE: LOOPS TRANSFERRED".into());
    }
    sheet.close(legend);
    sheet
}
