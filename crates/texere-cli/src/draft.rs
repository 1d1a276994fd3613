//! `texere draft`

use texere::weft::Knitted;
use texere::woven::Drawdown;
use texere::write::{Output, Side};

use crate::args::DraftArgs;
use crate::fail::Fail;
use crate::terminal::line;
use crate::{print, reading};

/// Bytes of rows that are gathered before they are printed. At this size the fixed cost of a system
/// call is small beside that of copying the bytes.
const GATHERED: usize = 1 << 16;

pub(crate) fn run(args: &DraftArgs) -> Result<(), Fail> {
    let design = reading::design(&args.design)?;
    let side = if args.back { Side::Back } else { Side::Face };
    let (woven, knit) = (design.structure.woven(), design.structure.knitted());
    let warp = design.structure.warp_knitted();
    if args.text {
        match (woven, knit, warp) {
            (Some(woven), ..) => print_rows(woven.cloth().drawdown(), side)?,
            (None, Some(knit), _) => print_stitches(knit, side)?,
            (None, None, Some(warp)) => print::text(&(texere::write::warp_rows(warp).join("\n") + "\n"))?,
            (None, None, None) => return Err(Fail::no_draft(&args.design)),
        }
    }
    if let Some(output) = &args.output {
        let sparing = Output::to(output).sparing(design.files());
        let [width, height] = match (woven, knit, warp) {
            (Some(woven), ..) => texere::write::draft(woven.cloth(), woven.draft(), side, sparing)?,
            (None, Some(knit), _) => texere::write::knit_draft(knit, side, sparing)?,
            (None, None, Some(warp)) => texere::write::warp_draft(warp, side, sparing)?,
            (None, None, None) => return Err(Fail::no_draft(&args.design)),
        };
        // With --text, standard output holds the rows of the draft alone.
        if !args.text {
            print::text(&format!("{}: {width} × {height} pixels\n", line(output.display())))?;
        }
    }
    Ok(())
}

/// Prints a row for each course, the last one on top, some rows at a time.
fn print_stitches(knit: &Knitted, side: Side) -> Result<(), Fail> {
    let mut rows = String::new();
    for row in texere::write::knit_rows(knit, side)? {
        rows.push_str(&row);
        rows.push('\n');
        if rows.len() >= GATHERED {
            print::text(&rows)?;
            rows.clear();
        }
    }
    print::text(&rows)
}

/// Prints a row for each pick, the last one on top, some rows at a time, because the whole text
/// would be as large as the cloth.
fn print_rows(drawdown: &Drawdown, side: Side) -> Result<(), Fail> {
    let (ends, picks) = (drawdown.ends(), drawdown.picks());
    let on_top = |column: usize, pick| match side {
        Side::Face => drawdown.up(column, pick),
        Side::Back => !drawdown.up(ends - 1 - column, pick),
    };
    let mut rows = String::new();
    let room = ends + 1 + GATHERED;
    rows.try_reserve_exact(room).map_err(|_| Fail::out_of_memory("rows of the drawdown", room))?;
    for pick in (0..picks).rev() {
        rows.extend((0..ends).map(|column| if on_top(column, pick) { '1' } else { '0' }));
        rows.push('\n');
        if rows.len() >= GATHERED || pick == 0 {
            print::text(&rows)?;
            rows.clear();
        }
    }
    Ok(())
}
