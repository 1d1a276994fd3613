//! The table of a design file that says how a weft knit is knitted.

use std::io::Write;

use texere_fabric::weft::{Backing, Beds, Cell, Chart, Gauge, Knitted};

use super::super::WriteError;
use super::format::DESIGN_FILE as FORMAT;
use super::text::{Text, within};
use super::toml_knit;
use super::toml_text::quoted;
use super::yarns::Yarns;
use crate::read::{Drawn, KnittedFrom, Legend, limits};

/// The table `[knit]` with a chart, checked.
pub(super) struct WeftTable<'a> {
    chart: &'a Chart,
    /// The letter of each yarn, if the chart is the face of a Jacquard.
    letters: Option<Vec<char>>,
    keys: Vec<String>,
    /// The table `[knit.colors]`, or an empty text if letters stand for stitches.
    colors: String,
}

impl<'a> WeftTable<'a> {
    pub(super) fn new(
        knit: &Knitted,
        from: &'a KnittedFrom,
        left_out: &mut Vec<String>,
    ) -> Result<(Self, Yarns), WriteError> {
        let unheld = |what: &str| WriteError::Unheld { format: FORMAT, what: what.into() };
        let Drawn::Cells { chart, legend, .. } = &from.drawn else {
            return Err(unheld("a program of a knitting machine; a knitout file holds it"));
        };
        let carriers = chart.yarns().max().map_or(0, |most| most as usize + 1);
        let carriers = knit.carriers().get(..carriers);
        let carriers = carriers.ok_or_else(|| unheld("a weft knit with fewer yarns than its chart"))?;
        let yarns = Yarns::of_knit(carriers, knit.materials(), knit.sections(), |_| true)?;
        let mut keys = Vec::new();
        let (mut letters, mut colors) = (None, String::new());
        match legend {
            Legend::Stitches => {
                if (0..chart.rows()).any(|row| chart.symbols(row).is_none()) {
                    return Err(unheld("a chart with a loop that moves as no symbol says"));
                }
                keys.extend((chart.beds() == Beds::Two).then(|| "beds = 2".into()));
                let turn = turn(chart);
                if turn != [0] {
                    keys.push(format!("yarns = [{}]", yarns.items_of(&turn).join(", ")));
                }
            }
            Legend::Yarns(backing) => {
                // The courses of a row come in the order of the yarns' names.
                if !yarns.names().is_sorted() {
                    return Err(unheld("a Jacquard whose yarns come in another order than their names"));
                }
                keys.extend(backing.map(|backing| match backing {
                    Backing::Birdseye => "backing = \"birdseye\"".into(),
                    Backing::Ladder => "backing = \"ladder\"".into(),
                }));
                let given: Vec<char> = all_letters().take(carriers.len()).collect();
                let color = |(letter, name): (&char, &String)| {
                    format!("{} = {}\n", quoted(&letter.to_string()), quoted(name))
                };
                colors = given.iter().zip(yarns.names()).map(color).collect();
                colors.insert_str(0, "\n[knit.colors]\n");
                letters = Some(given);
            }
        }
        keys.extend(toml_knit::repeat("knit", knit.copies())?);
        keys.extend(gauge(knit.gauge(), left_out)?);
        keys.extend(toml_knit::cells(knit.cells()));
        keys.extend(from.float_max.map(|most| format!("float_max = {most}")));
        Ok((Self { chart, letters, keys, colors }, yarns))
    }

    pub(super) fn write<W: Write>(&self, text: &mut Text<W>) -> Result<(), WriteError> {
        text.line("\n[knit]\nchart = '''")?;
        match &self.letters {
            None => {
                for row in (0..self.chart.rows()).rev() {
                    text.line(&self.chart.symbols(row).unwrap_or_default())?;
                }
            }
            Some(letters) => face(self.chart, letters, text)?,
        }
        text.line("'''")?;
        for key in &self.keys {
            text.line(key)?;
        }
        text.put(&self.colors)
    }
}

/// Writes the face of a Jacquard, a row for each row of its picture, the last one on top. `letters`
/// has the letter of each yarn.
fn face<W: Write>(chart: &Chart, letters: &[char], text: &mut Text<W>) -> Result<(), WriteError> {
    let yarns: Vec<u32> = chart.yarns().collect();
    let courses: Vec<usize> = (0..chart.courses()).collect();
    for row in courses.chunk_by(|one, other| chart.row(*one) == chart.row(*other)).rev() {
        let mut line = vec![' '; chart.wales()];
        for &course in row {
            for (place, cell) in line.iter_mut().zip(chart.course(course)) {
                // Exactly one yarn of the row knits on each front needle.
                if matches!(cell, Cell::Knit | Cell::Both) {
                    *place = letters[yarns[course] as usize];
                }
            }
        }
        text.line(&line.into_iter().collect::<String>())?;
    }
    Ok(())
}

/// Letters that stand for yarns: the Latin ones, digits, then letters of other scripts.
fn all_letters() -> impl Iterator<Item = char> {
    let plain = ('a'..='z').chain('A'..='Z').chain('0'..='9');
    plain.chain(('\u{c0}'..=char::MAX).filter(|letter| letter.is_alphanumeric()))
}

/// The shortest list of yarns that gives each course of a chart its yarn. A reader repeats the rows
/// of the chart until their number is a multiple of the list's length. The number of rows must then
/// be the number of the chart's courses.
fn turn(chart: &Chart) -> Vec<u32> {
    let yarns: Vec<u32> = chart.yarns().collect();
    let (courses, rows) = (yarns.len(), chart.rows());
    let courses_read =
        |length: usize| (1..=length).find(|times| times * rows % length == 0).map(|times| times * rows);
    let gives = |length: &usize| {
        courses % length == 0
            && yarns.iter().zip(&yarns[*length..]).all(|(one, other)| one == other)
            && courses_read(*length) == Some(courses)
    };
    let length = (1..=courses).find(gives).unwrap_or(courses);
    yarns[..length].to_vec()
}

/// The keys for the distances of wales and courses, and for the length of loops. A loop length that
/// gives both distances stands alone.
fn gauge(gauge: &Gauge, left_out: &mut Vec<String>) -> Result<Vec<String>, WriteError> {
    let Some(loop_mm) = gauge.loop_length_mm else { return toml_knit::gauge("knit", gauge, left_out) };
    within(FORMAT, || "knit.loop_length_mm".into(), loop_mm, limits::LOOP_MM)?;
    let mut keys = Vec::new();
    if *gauge != Gauge::munden(loop_mm) {
        keys = toml_knit::gauge("knit", gauge, left_out)?;
    }
    keys.push(format!("loop_length_mm = {loop_mm:?}"));
    Ok(keys)
}
