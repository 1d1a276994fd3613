//! `texere convert`

use texere::Structure;
use texere::check::counted;
use texere::write::{self, Output};

use crate::args::ConvertArgs;
use crate::fail::Fail;
use crate::terminal::line;
use crate::{print, reading};

pub(crate) fn run(args: &ConvertArgs) -> Result<(), Fail> {
    let design = reading::design(&args.design)?;
    let output = Output::to(&args.output).sparing(design.files());
    let ending = args.output.extension().map(|ending| ending.to_ascii_lowercase());
    let left_out = match ending.as_ref().and_then(|ending| ending.to_str()) {
        Some("wif") => write::wif(&design, output)?,
        Some("k" | "knitout") => write::knitout(&design, output)?,
        _ => write::toml(&design, output)?,
    };
    for what in left_out {
        print::text(&format!("left out: {}\n", line(what)))?;
    }
    let size = match &design.structure {
        Structure::Woven(woven) => {
            let drawdown = woven.cloth().drawdown();
            [counted(drawdown.ends(), "end"), counted(drawdown.picks(), "pick")]
        }
        Structure::Weft(knit) => stitches(knit.size()),
        Structure::Warp(knit) => stitches(knit.size()),
        _ => return print::text(&format!("{}\n", line(args.output.display()))),
    };
    print::text(&format!("{}: {}\n", line(args.output.display()), size.join(", ")))
}

/// The size of a knit in words.
fn stitches([wales, courses]: [u32; 2]) -> [String; 2] {
    [counted(wales, "wale"), counted(courses, "course")]
}
