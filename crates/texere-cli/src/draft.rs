//! `texere draft`

use texere::Structure;

use crate::args::DraftArgs;
use crate::fail::Fail;

pub(crate) fn run(args: &DraftArgs) -> Result<(), Fail> {
    let design = texere::read(&args.design)?;
    let Structure::Woven(woven) = &design.structure else {
        return Err(Fail::not_woven(&args.design));
    };
    let drawdown = woven.drawdown();
    let row = |pick| (0..drawdown.ends()).map(move |end| if drawdown.up(end, pick) { '1' } else { '0' });
    let text: String = (0..drawdown.picks()).rev().flat_map(|pick| row(pick).chain(['\n'])).collect();
    crate::print(&text)
}
