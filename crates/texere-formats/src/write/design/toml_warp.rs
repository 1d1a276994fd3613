//! Writes the table `[warp_knit]` of a design file.

use texere_fabric::warp::{Bar, Threading, WarpKnitted};
use texere_fabric::{SPACING_MAX, SPACING_MIN};

use super::super::WriteError;
use super::format::DESIGN_FILE as FORMAT;
use super::text::within;
use super::toml_knit;
use super::toml_text::quoted;
use super::yarns::Yarns;
use crate::read::{GUIDE_WITHOUT_YARN, limits};

/// The table `[warp_knit]` with its guide bars.
pub(super) fn warp_table(
    knit: &WarpKnitted,
    left_out: &mut Vec<String>,
) -> Result<(String, Yarns), WriteError> {
    // A yarn whose name ends in the word `out` gets another name: in a threading, `out` is a guide
    // without yarn.
    let is_yarn = |name: &str| name.split_whitespace().next_back() != Some(GUIDE_WITHOUT_YARN);
    let yarns = Yarns::of_knit(knit.guide_yarns(), knit.materials(), knit.sections(), is_yarn)?;
    let [wales, courses] = knit.lapped_size();
    for (key, side) in [("wales", wales), ("courses", courses)] {
        within(FORMAT, || format!("warp_knit.{key}"), side.into(), [1.0, limits::SIDE_MAX as f64])?;
    }
    let mut keys = vec![format!("wales = {wales}"), format!("courses = {courses}")];
    keys.extend(toml_knit::repeat("warp_knit", knit.copies())?);
    keys.extend(toml_knit::gauge("warp_knit", knit.gauge(), left_out)?);
    keys.extend(toml_knit::cells(knit.cells()));
    let mut table = format!("\n[warp_knit]\n{}\n", keys.join("\n"));
    for (number, bar) in (1..).zip(knit.bars()) {
        table.push_str(&format!("\n[[warp_knit.bars]]\n{}\n", bar_keys(number, bar, &yarns)?.join("\n")));
    }
    Ok((table, yarns))
}

/// The keys of a bar. `number` is its number, counted from 1.
fn bar_keys(number: usize, bar: &Bar, yarns: &Yarns) -> Result<Vec<String>, WriteError> {
    let field = |key: &str| format!("warp_knit.bars, bar {number}: {key}");
    let unheld = |what: String| WriteError::Unheld { format: FORMAT, what };
    if bar.jacquard.is_some() {
        return Err(unheld(format!("bar {number}, a Jacquard bar, whose displacements come from an image")));
    }
    let guides = bar.threading.period();
    within(FORMAT, || field("threading"), guides as f64, [1.0, limits::GUIDES_MAX as f64])?;
    if bar.threading.guides().iter().all(Option::is_none) {
        return Err(unheld(format!("bar {number}, a bar without yarns")));
    }
    let mut keys = vec![
        format!("lapping = \"{}\"", bar.chain),
        format!("threading = [{}]", threading(&bar.threading, yarns).join(", ")),
    ];
    if bar.offset != 0 {
        let most = limits::OFFSET_MAX as f64;
        within(FORMAT, || field("offset"), bar.offset.into(), [-most, most])?;
        keys.push(format!("offset = {}", bar.offset));
    }
    if let Some(run_in_mm) = bar.run_in_mm {
        within(FORMAT, || field("run_in_mm"), run_in_mm, [SPACING_MIN, SPACING_MAX])?;
        keys.push(format!("run_in_mm = {run_in_mm:?}"));
    }
    Ok(keys)
}

/// The items of the key `threading`. Neighbouring guides with one yarn, or without yarn, are one
/// item.
fn threading(threading: &Threading, yarns: &Yarns) -> Vec<String> {
    let runs = threading.guides().chunk_by(|one, other| one == other);
    let items = |run: &[Option<u32>]| match (run[0], run.len()) {
        (Some(yarn), times) => yarns.items(yarn, times),
        (None, 1) => vec![quoted(GUIDE_WITHOUT_YARN)],
        (None, times) => vec![quoted(&format!("{times} {GUIDE_WITHOUT_YARN}"))],
    };
    runs.flat_map(items).collect()
}
