//! `texere draft`

use texere::{Drawdown, Output, Side};

use crate::args::DraftArgs;
use crate::fail::Fail;
use crate::print;
use crate::terminal::line;

/// Bytes of rows that are gathered before they are printed: calls cost nothing beside the copying from here on.
const GATHERED: usize = 1 << 16;

pub(crate) fn run(args: &DraftArgs) -> Result<(), Fail> {
    let design = texere::read(&args.design)?;
    let woven = design.structure.woven().ok_or_else(|| Fail::not_woven(&args.design))?;
    let side = if args.back { Side::Back } else { Side::Face };
    if args.text {
        print_rows(woven.cloth().drawdown(), side)?;
    }
    if let Some(output) = &args.output {
        let sparing = Output::to(output).sparing(design.files());
        let [width, height] = texere::write_draft(woven.cloth(), woven.draft(), side, sparing)?;
        // With --text, standard output is the drawdown alone.
        if !args.text {
            print::text(&format!("{}: {width} × {height} pixels\n", line(output.display())))?;
        }
    }
    Ok(())
}

/// Prints a row for each pick, the last one on top, some rows at a time: the whole text is as large as the cloth.
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
