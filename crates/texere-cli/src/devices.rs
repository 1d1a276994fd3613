//! `texere devices`

use std::error::Error;
use std::fmt::Write;

use serde_json::{Map, json};
use texere::{BackendError, Capabilities};

use crate::args::DevicesArgs;
use crate::fail::Fail;
use crate::terminal::lines;
use crate::{drivers, print};

pub(crate) fn run(args: &DevicesArgs) -> Result<(), Fail> {
    let devices = drivers::quietly(|| Ok::<_, BackendError>(texere::devices()))?;
    let (auto, why) = devices.auto();
    let missing = devices.missing.iter().map(|(family, error)| (*family, causes(error)));
    if args.json {
        let found = devices.found.iter().map(|device| {
            json!({
                "name": device.name,
                "device": device.device,
                "kind": device.kind.to_string(),
                "driver": device.driver,
                "schedule": device.schedule.to_string(),
                "memory_bytes": device.memory_bytes,
                "binding_bytes": device.limits.binding_bytes,
                "can": can(device.can).map(|(what, is)| (what.to_owned(), is.into())).into_iter().collect::<Map<_, _>>(),
            })
        });
        let missing: Vec<_> = missing.map(|(family, why)| json!({ "family": family, "why": why })).collect();
        let all = json!({ "auto": auto, "why": why, "found": found.collect::<Vec<_>>(), "missing": missing });
        return print::text(&format!("{all:#}\n"));
    }
    let mut text = String::new();
    for device in &devices.found {
        let (name, kind, driver) = (&device.name, &device.kind, &device.driver);
        let memory = device.memory_bytes.map(|bytes| format!(", {} MiB", bytes >> 20)).unwrap_or_default();
        let able: Vec<_> = can(device.can).into_iter().filter_map(|(what, is)| is.then_some(what)).collect();
        // Writing to a string can't fail.
        let _ = writeln!(
            text,
            "{name}: {kind}, {}{memory}, {driver}, {}; {}",
            device.device,
            device.schedule,
            able.join(", ")
        );
    }
    let _ = writeln!(text, "auto is {auto}: {why}");
    for (family, why) in missing {
        let _ = writeln!(text, "no {family} device: {why}");
    }
    print::text(&lines(&text))
}

/// The names of the capabilities that a device may have besides making meshes, each with whether
/// this device has it.
const fn can(can: Capabilities) -> [(&'static str, bool); 7] {
    let Capabilities { settle, settle_crossings, relax, edit, attributes, pack, draw } = can;
    [
        ("settle", settle),
        ("settle_crossings", settle_crossings),
        ("relax", relax),
        ("edit", edit),
        ("attributes", attributes),
        ("pack", pack),
        ("draw", draw),
    ]
}

/// An error and its causes in one line.
fn causes(error: &dyn Error) -> String {
    let mut text = error.to_string();
    let mut cause = error.source();
    while let Some(error) = cause {
        let _ = write!(text, ", because {error}");
        cause = error.source();
    }
    text
}
