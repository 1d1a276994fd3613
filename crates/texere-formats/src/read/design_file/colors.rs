//! The meaning of the colours of an image.

use std::collections::BTreeMap;

use toml::Spanned;

use super::source::Source;
use crate::read::ReadError;
use crate::read::error::{first_few, named};
use crate::read::point_paper::PointPaper;

/// The meaning of each colour of the paper by `colors`, the table called `table`. The outer error
/// is a fault of the table. The inner error is a fault of the image: a colour that the table lacks.
/// A colour of the table that the paper lacks gives a warning.
pub(super) fn of_paper<'a>(
    source: &Source<'_>,
    paper: &PointPaper,
    table: &str,
    colors: &'a BTreeMap<Spanned<String>, Spanned<String>>,
    warnings: &mut Vec<String>,
) -> Result<Result<Vec<&'a Spanned<String>>, ReadError>, ReadError> {
    let mut by_rgb = BTreeMap::new();
    for (color, meant) in colors {
        let field = format!("a colour of [{table}]");
        let rgb = source.rgb(&field, color)?;
        if by_rgb.insert(rgb, meant).is_some() {
            return Err(source.bad(&field, color, "each colour once, in either case"));
        }
    }
    let hex = |[red, green, blue]: &[u8; 3]| format!("#{red:02x}{green:02x}{blue:02x}");
    let known = first_few(by_rgb.keys().map(hex));
    let mut found = Vec::new();
    for color in &paper.colors {
        match color.rgb().and_then(|rgb| by_rgb.remove(&rgb)) {
            Some(meant) => found.push(meant),
            None => return Ok(Err(color.refused(&paper.file, format!("one of [{table}]: {known}")))),
        }
    }
    if !by_rgb.is_empty() {
        let (count, unused) = (by_rgb.len(), first_few(by_rgb.keys().map(hex)));
        let colors = if count == 1 { "a colour" } else { &format!("{count} colours") };
        let file = named(&paper.file);
        warnings.push(format!("{table} has {colors} that no pixel of {file} has: {unused}"));
    }
    Ok(Ok(found))
}
