//! `texere devices`

use std::fmt::Write;

use serde_json::json;

use crate::args::DevicesArgs;
use crate::fail::Fail;

pub(crate) fn run(args: &DevicesArgs) -> Result<(), Fail> {
    let devices = texere::devices();
    if args.json {
        let list: Vec<_> = devices
            .iter()
            .map(|device| {
                json!({
                    "name": device.name,
                    "device": device.device,
                    "kind": device.kind.to_string(),
                    "driver": device.driver,
                    "schedule": device.schedule,
                    "memory_bytes": device.memory_bytes,
                })
            })
            .collect();
        return crate::print(&format!("{:#}\n", json!(list)));
    }
    let mut text = String::new();
    for (number, device) in devices.iter().enumerate() {
        let auto = if number == 0 { " (auto)" } else { "" };
        let (name, schedule) = (&device.name, &device.schedule);
        // Writing to a string can't fail.
        let _ =
            writeln!(text, "{name}{auto}: {}, {}, {}, {schedule}", device.kind, device.device, device.driver);
    }
    crate::print(&text)
}
