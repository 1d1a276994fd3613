//! `texere view`

use texere_view::{Event, View};

use crate::args::ViewArgs;
use crate::drivers;
use crate::fail::Fail;
use crate::print;
use crate::terminal::line;

pub(crate) fn run(args: &ViewArgs) -> Result<(), Fail> {
    let view = View {
        device: args.device.clone(),
        settings: args.settings.settings(),
        sides: args.settings.sides,
        subdivisions: args.settings.subdivisions,
        section: args.settings.section.clone(),
        settle: args.rest.settles(),
        size: args.size,
        ..View::of(&args.design)
    };
    let mut printed = Ok(());
    // Drivers are loaded for the window, and again where yarns settle.
    drivers::quietly(|| {
        view.open(|event: &Event| {
            if printed.is_ok() {
                printed = print::text(&format!("{}\n", line(event)));
            }
        })
    })?;
    printed
}
