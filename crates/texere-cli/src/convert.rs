//! `texere convert`

use texere::check::counted;
use texere::write::Output;

use crate::args::ConvertArgs;
use crate::fail::Fail;
use crate::terminal::line;
use crate::{print, reading};

pub(crate) fn run(args: &ConvertArgs) -> Result<(), Fail> {
    let design = reading::design(&args.design)?;
    let output = Output::to(&args.output).sparing(design.files());
    let is_wif = args.output.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("wif"));
    let left_out =
        if is_wif { texere::write::wif(&design, output)? } else { texere::write::toml(&design, output)? };
    for what in left_out {
        print::text(&format!("left out: {}\n", line(what)))?;
    }
    let size = design.structure.woven().map(|woven| woven.cloth().drawdown());
    let (ends, picks) = size.map_or((0, 0), |drawdown| (drawdown.ends(), drawdown.picks()));
    print::text(&format!(
        "{}: {}, {}\n",
        line(args.output.display()),
        counted(ends, "end"),
        counted(picks, "pick")
    ))
}
