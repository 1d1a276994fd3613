//! `texere draft`

use texere::{Drawdown, Side, Structure};

use crate::args::DraftArgs;
use crate::fail::Fail;

pub(crate) fn run(args: &DraftArgs) -> Result<(), Fail> {
    let design = texere::read(&args.design)?;
    let Structure::Woven(woven) = &design.structure else {
        return Err(Fail::not_woven(&args.design));
    };
    let side = if args.back { Side::Back } else { Side::Face };
    if args.text {
        crate::print(&text(woven.drawdown(), side))?;
    }
    if let Some(output) = &args.output {
        let [width, height] = texere::write_draft(woven, design.draft.as_ref(), side, output)?;
        // With --text, standard output is the drawdown alone.
        if !args.text {
            crate::print(&format!("{}: {width} × {height} pixels\n", output.display()))?;
        }
    }
    Ok(())
}

/// A row for each pick, the last one on top.
fn text(drawdown: &Drawdown, side: Side) -> String {
    let (ends, picks) = (drawdown.ends(), drawdown.picks());
    let on_top = |column: usize, pick| match side {
        Side::Face => drawdown.up(column, pick),
        Side::Back => !drawdown.up(ends - 1 - column, pick),
    };
    let row = |pick| (0..ends).map(move |column| if on_top(column, pick) { '1' } else { '0' });
    (0..picks).rev().flat_map(|pick| row(pick).chain(['\n'])).collect()
}
