//! A Jacquard in the `[knit]` table: a picture whose colours, or a chart whose letters, are yarns.

use std::collections::BTreeMap;

use texere_fabric::weft::Chart;
use toml::Spanned;

use super::knit::{Drawing, Reader};
use super::threads::Named;
use crate::read::error::{first_few, shown};
use crate::read::knitted_from::Legend;
use crate::read::{Design, ReadError};

impl Reader<'_> {
    /// A chart whose letters are yarns, as `colors` says.
    pub(super) fn letters(
        &self,
        name: String,
        text: &Spanned<String>,
        colors: &BTreeMap<Spanned<String>, Spanned<String>>,
    ) -> Result<Design, ReadError> {
        self.without_symbols("a chart of symbols, which has no [knit.colors]")?;
        let source = self.source;
        let refused = |error| self.refused("knit.chart", text.span(), error);
        let rows = Chart::letters(text.as_ref()).map_err(refused)?;
        let mut by_letter = self.by_letter(colors)?;
        let quoted = |letter: &char| format!("\"{letter}\"");
        let known = first_few(by_letter.keys().map(quoted));
        let (mut meant, mut numbers) = (Vec::new(), BTreeMap::new());
        for (number, row) in (1..).zip(&rows) {
            for (column, &letter) in (1..).zip(row) {
                if numbers.contains_key(&letter) {
                    continue;
                }
                let Some(yarn) = by_letter.remove(&letter) else {
                    let field = format!("knit.chart, row {number} from the top, column {column},");
                    let (place, value) = (source.place(&field, text.span()), shown(&letter.to_string()));
                    let expected = format!("a letter of [knit.colors]: {known}");
                    return Err(ReadError::BadValue { place, value, expected });
                };
                numbers.insert(letter, meant.len());
                meant.push(yarn.clone());
            }
        }
        let mut warnings = Vec::new();
        if !by_letter.is_empty() {
            let unused = first_few(by_letter.keys().map(quoted));
            warnings.push(format!("knit.colors has letters that the chart does not have: {unused}"));
        }
        let (yarns, of_letter) = self.by_name(&meant);
        let (wales, backing) = (rows.first().map_or(0, Vec::len), self.backing()?);
        let yarn = |column: usize, row: usize| of_letter[numbers[&rows[rows.len() - 1 - row][column]]];
        let chart = Chart::jacquard(wales, rows.len(), backing, yarn).map_err(refused)?;
        let drawing = Drawing {
            file: source.path,
            place: source.place("knit.chart", text.span()),
            legend: Legend::Yarns(backing),
            upside_down: false,
        };
        self.charted(name, chart, yarns, drawing, warnings)
    }

    /// The name of the yarn that each letter of `colors` stands for.
    fn by_letter<'a>(
        &self,
        colors: &'a BTreeMap<Spanned<String>, Spanned<String>>,
    ) -> Result<BTreeMap<char, &'a String>, ReadError> {
        let mut by_letter = BTreeMap::new();
        for (key, yarn) in colors {
            let mut letters = key.as_ref().chars();
            let letter = letters.next().filter(|letter| !letter.is_whitespace() && letters.next().is_none());
            let Some(letter) = letter else {
                let expected = "a letter of the chart, which is no space";
                return Err(self.source.bad("a letter of [knit.colors]", key, expected));
            };
            if self.yarns.thread(yarn.as_ref()).is_none() {
                let known = first_few(self.yarns.names().map(|name| format!("\"{name}\"")));
                let field = format!("knit.colors.{}", shown(key.as_ref()));
                return Err(self.source.bad(&field, yarn, &format!("a yarn of [yarns]: {known}")));
            }
            by_letter.insert(letter, yarn.as_ref());
        }
        Ok(by_letter)
    }

    /// The yarns that `meant` names, sorted by name, and the number of each name's yarn. The
    /// courses of a row come in the order of these numbers, so that the order does not depend on
    /// the picture.
    pub(super) fn by_name(&self, meant: &[String]) -> (Vec<Named>, Vec<u32>) {
        let mut names: Vec<&String> = meant.iter().collect();
        names.sort_unstable();
        names.dedup();
        let numbers = meant.iter().map(|name| names.binary_search(&name).unwrap_or(0) as u32).collect();
        let named = |name: &&String| self.yarns.thread(name).map(|thread| (name.to_string(), thread));
        (names.iter().filter_map(named).collect(), numbers)
    }

    /// Refuses keys that only charts of symbols have.
    pub(super) fn without_symbols(&self, needs: &'static str) -> Result<(), ReadError> {
        let keys =
            [self.table.yarns.as_ref().map(Spanned::span), self.table.beds.as_ref().map(Spanned::span)];
        match keys.into_iter().flatten().next() {
            Some(span) => {
                Err(ReadError::Without { place: self.source.place("knit.yarns or knit.beds", span), needs })
            }
            None => Ok(()),
        }
    }
}
