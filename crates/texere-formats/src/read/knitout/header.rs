//! The first lines of a knitout file: what machine, carriers and yarns it is for.

use std::collections::HashMap;
use std::iter::Peekable;

use super::carriers::{NAME, is_name};
use super::limits::{CARRIERS_MAX, GAUGE, TEXT_MAX};
use super::line::Line;
use super::warnings::Warnings;
use crate::read::ReadError;
use crate::read::error::shown;
use crate::read::knitted_from::{ProgramHead, StitchSize};

/// The version of knitout that is read.
const VERSION: u32 = 2;

/// Reads the line `;!knitout-2`, and warns if it is missing or has another version.
pub(super) fn magic<'a>(
    lines: &mut Peekable<impl Iterator<Item = (usize, &'a str)>>,
    warnings: &mut Warnings,
) {
    let version = |(_, text): &(usize, &str)| text.trim_end().strip_prefix(";!knitout-").map(str::to_owned);
    let Some(version) = lines.peek().and_then(version) else {
        warnings.once("magic", 1, "no \";!knitout-2\", with which knitout begins; it is taken for that");
        return;
    };
    lines.next();
    if version.parse() != Ok(VERSION) {
        let said = format!("knitout {}; it is read as knitout {VERSION}", shown(&version));
        warnings.once("magic", 1, &said);
    }
}

/// The name and the value of a header, `;;Name: value`.
pub(super) fn name(text: &str) -> Option<(&str, &str)> {
    let (name, value) = text.trim_start().strip_prefix(";;")?.split_once(':')?;
    Some((name.trim(), value.trim()))
}

/// Whether a machine is one of Shima Seiki's SWG machines, by its name.
pub(crate) fn is_swg(machine: &str) -> bool {
    machine.starts_with("SWG")
}

/// The value of a header as it is kept: at most [`TEXT_MAX`] letters, none of them a control code.
pub(crate) fn kept(value: &str) -> String {
    value.chars().filter(|letter| !letter.is_control()).take(TEXT_MAX).collect()
}

/// Whether knitout 2 has a header of this name.
pub(super) fn is_known(name: &str) -> bool {
    matches!(name, "Machine" | "Gauge" | "Carriers" | "Position") || name.starts_with("Yarn-")
}

/// The header of a file.
#[derive(Debug, Default)]
pub(super) struct Header<'a> {
    /// The carriers, front to back.
    pub(super) carriers: Option<Vec<&'a str>>,
    /// Number of needles to the inch, and the line of its header.
    pub(super) gauge: Option<(f64, usize)>,
    machine: Option<&'a str>,
    /// The place of the knit on the bed, which makes no difference to the cloth.
    position: Option<&'a str>,
    /// The yarn in each carrier, and the line of its header.
    yarns: HashMap<&'a str, (&'a str, usize)>,
}

impl<'a> Header<'a> {
    /// Reads a line without an operation: a header, a comment, or an empty line.
    pub(super) fn read(&mut self, line: &Line<'a>, warnings: &mut Warnings) -> Result<(), ReadError> {
        let Some((name, value)) = name(line.text) else { return Ok(()) };
        match name {
            "Carriers" => {
                let mut carriers = Vec::new();
                for carrier in value.split_whitespace() {
                    if !is_name(carrier) {
                        return Err(line.refused(carrier, NAME));
                    }
                    if carriers.contains(&carrier) {
                        return Err(line.refused(carrier, "each carrier once"));
                    }
                    if carriers.len() == CARRIERS_MAX {
                        return Err(line.refused(carrier, format!("{CARRIERS_MAX} carriers at most")));
                    }
                    carriers.push(carrier);
                }
                self.carriers = Some(carriers).filter(|carriers| !carriers.is_empty());
            }
            "Gauge" => {
                let [low, high] = GAUGE;
                let gauge = value.parse().ok().filter(|gauge| (low..=high).contains(gauge));
                if gauge.is_none() {
                    let said = format!("Gauge \"{}\" is no number of needles to the inch", shown(value));
                    warnings.once("gauge", line.number, &said);
                }
                self.gauge = gauge.map(|gauge| (gauge, line.number));
            }
            "Machine" => self.machine = Some(value),
            "Position" => self.position = Some(value),
            _ => match name.strip_prefix("Yarn-") {
                Some(carrier) => drop(self.yarns.insert(carrier, (value, line.number))),
                None => {
                    let said = format!("header \"{}\" is not known; it is left out", shown(name));
                    warnings.once(&format!("header {name}"), line.number, &said);
                }
            },
        }
        Ok(())
    }

    /// What the header says of the machine, with the sizes of the program's stitches.
    pub(super) fn head(&self, sizes: Vec<StitchSize>) -> ProgramHead {
        ProgramHead { machine: self.machine.map(kept), position: self.position.map(kept), sizes }
    }

    /// The fractions of a rack at which back needles lie between front needles, so that both beds
    /// can knit at once. A fraction is counted up from the next lower whole number: that of the
    /// rack -0.75 is 0.25. The fraction is 0.25 on Shima Seiki's SWG machines, and 0.5 on other
    /// machines. If the file names no machine, both are allowed.
    pub(super) fn all_needle_racks(&self) -> &'static [f64] {
        match self.machine {
            Some(machine) if is_swg(machine) => &[0.25],
            Some(_) => &[0.5],
            None => &[0.25, 0.5],
        }
    }

    /// The yarn in each of `carriers`. If other carriers have yarns, the first of them gives a
    /// warning.
    pub(super) fn yarns_of(mut self, carriers: &[String], warnings: &mut Warnings) -> Vec<Option<String>> {
        let yarn = |carrier: &String| self.yarns.remove(carrier.as_str()).map(|(yarn, _)| kept(yarn));
        let yarns = carriers.iter().map(yarn).collect();
        if let Some((carrier, (_, line))) = self.yarns.iter().min_by_key(|(_, (_, line))| line) {
            let said = format!("a yarn in carrier \"{}\", which there is not", shown(carrier));
            warnings.once("yarn", *line, &said);
        }
        yarns
    }
}
