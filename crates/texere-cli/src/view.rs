//! `texere view`

use texere_view::{Event, View};

use crate::args::ViewArgs;
use crate::fail::Fail;
use crate::terminal::line;
use crate::{drivers, print};

pub(crate) fn run(args: &ViewArgs) -> Result<(), Fail> {
    let view = View {
        device: args.device.clone(),
        settings: args.settings.settings(),
        tension: args.settings.tension(0.0),
        sides: args.settings.sides,
        subdivisions: args.settings.subdivisions,
        section: args.settings.section.clone(),
        settle: args.rest.settles(),
        size: args.size,
        ..View::of(&args.design)
    };
    let mut printed = Ok(());
    // Drivers are loaded for the window, and again when yarns settle.
    drivers::quietly(|| {
        view.open(|event: &Event| match event {
            // If a line could not be printed, the program does not leave here, but returns that
            // failure.
            Event::Closed if printed.is_ok() => leave(),
            event if printed.is_ok() => printed = print::text(&format!("{}\n", line(event))),
            _ => {}
        })
    })?;
    printed
}

/// Ends the program at once, whatever its threads and the device are doing. A driver must not be
/// closed while it works, so it stays open, and the operating system frees everything.
fn leave() -> ! {
    #[cfg(unix)]
    crate::signals::give_way();
    texere::write::abandon();
    #[cfg(unix)]
    signal_hook::low_level::exit(0);
    #[cfg(not(unix))]
    std::process::exit(0)
}
