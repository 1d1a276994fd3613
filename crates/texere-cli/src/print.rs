//! Output to standard output.

use std::io::Write;

use serde::Serialize;

use crate::fail::Fail;
use crate::terminal::line;

/// Prints `report` as JSON, for programs.
pub(crate) fn json(report: &impl Serialize) -> Result<(), Fail> {
    let json = serde_json::to_string_pretty(report).map_err(|error| Fail::output(error.into()))?;
    text(&(json + "\n"))
}

/// Prints a report for people: its name, then its lines, with labels that end at column `width`.
pub(crate) fn lines(name: &str, width: usize, lines: &[(&str, String)]) -> Result<(), Fail> {
    let lines = lines.iter().map(|(what, said)| format!("{what:>width$}  {}\n", line(said)));
    text(&(line(name) + "\n" + &lines.collect::<String>()))
}

/// Prints `text` to standard output. A pipe that its reader has closed is no failure.
pub(crate) fn text(text: &str) -> Result<(), Fail> {
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => Err(Fail::output(error)),
        _ => Ok(()),
    }
}
