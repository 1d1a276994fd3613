//! Keys that `[knit]` and `[warp_knit]` share: copies, compression, and the count of control
//! points.

use texere_fabric::weft::Cells;
use toml::Spanned;

use super::limits::COPIES_MAX;
use super::source::Source;
use crate::read::ReadError;

/// The least and the greatest share of its diameter that a yarn may keep between other yarns.
const COMPRESSION: [f64; 2] = [0.8, 1.0];

/// The share of its diameter that a yarn keeps between other yarns.
pub(super) fn compression(
    source: &Source<'_>,
    field: &str,
    share: Option<&Spanned<f64>>,
) -> Result<f64, ReadError> {
    share.map_or(Ok(1.0), |share| source.number(field, share, COMPRESSION))
}

/// The numbers of copies of a repeat across the wales and along the courses.
pub(super) fn copies(
    source: &Source<'_>,
    field: &str,
    repeat: Option<&Spanned<Vec<Spanned<i64>>>>,
) -> Result<[u32; 2], ReadError> {
    let Some(repeat) = repeat else { return Ok([1, 1]) };
    let [across, along] = &repeat.as_ref()[..] else {
        let expected = "two whole numbers, across the wales and along the courses";
        return Err(source.unfit(field, repeat.span(), expected));
    };
    Ok([source.integer(field, across, 1, COPIES_MAX)?, source.integer(field, along, 1, COPIES_MAX)?])
}

/// How a stitch is divided into control points: round or even cells.
pub(super) fn cells(
    source: &Source<'_>,
    field: &str,
    cells: Option<&Spanned<String>>,
) -> Result<Cells, ReadError> {
    match cells.map(|cells| (cells, cells.as_ref().as_str())) {
        None | Some((_, "round")) => Ok(Cells::Round),
        Some((_, "even")) => Ok(Cells::Even),
        Some((cells, _)) => Err(source.bad(field, cells, "\"round\" or \"even\"")),
    }
}
