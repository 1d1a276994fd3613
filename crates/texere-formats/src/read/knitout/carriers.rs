//! The carriers of a program by name, and the sets of carriers that operations take.

use std::collections::HashMap;

use texere_fabric::weft::CarrierSet;

use super::limits::{CARRIERS_MAX, NAME_MAX};
use super::line::Words;
use crate::read::ReadError;
use crate::read::error::{first_few, shown};

/// Whether a carrier may be called `word`. Messages and names of yarns contain the word, so it must
/// be short and printable.
pub(super) fn is_name(word: &str) -> bool {
    word.chars().count() <= NAME_MAX && !word.chars().any(char::is_control)
}

/// The text of errors for a word that is no name.
pub(super) const NAME: &str = "the name of a carrier: 40 letters at most, none of them a control code";

/// The carriers of a program, and the sets of carriers that occur.
#[derive(Debug)]
pub(super) struct Carriers<'a> {
    numbers: HashMap<&'a str, u32>,
    names: Vec<String>,
    /// Whether the header lists the carriers.
    declared: bool,
    sets: Vec<Vec<u32>>,
    set_numbers: HashMap<Vec<u32>, u32>,
    /// The set that is being read.
    set: Vec<u32>,
}

impl<'a> Carriers<'a> {
    /// The carriers that the header lists. Without a list, carriers are added as they occur.
    pub(super) fn new(declared: Option<&[&'a str]>) -> Self {
        let names = declared.unwrap_or_default();
        Self {
            numbers: names.iter().copied().zip(0..).collect(),
            names: names.iter().map(|&name| name.into()).collect(),
            declared: declared.is_some(),
            sets: vec![Vec::new()],
            set_numbers: HashMap::from([(Vec::new(), 0)]),
            set: Vec::new(),
        }
    }

    /// The carrier set that the rest of an operation names. None if no word is left.
    pub(super) fn set(&mut self, mut words: Words<'a>) -> Result<Option<CarrierSet>, ReadError> {
        self.set.clear();
        while let Some(word) = words.next() {
            let number = self.number(word, &words)?;
            if self.set.contains(&number) {
                return Err(words.refused(word, "each carrier once"));
            }
            self.set.push(number);
        }
        if self.set.is_empty() {
            return Ok(None);
        }
        if let Some(&number) = self.set_numbers.get(&self.set) {
            return Ok(Some(CarrierSet(number)));
        }
        let number = self.sets.len() as u32;
        self.set_numbers.insert(self.set.clone(), number);
        self.sets.push(self.set.clone());
        Ok(Some(CarrierSet(number)))
    }

    fn number(&mut self, word: &'a str, words: &Words<'a>) -> Result<u32, ReadError> {
        if let Some(&number) = self.numbers.get(word) {
            return Ok(number);
        }
        if self.declared {
            let known = first_few(self.names.iter().map(|name| shown(name)));
            return Err(words.refused(word, format!("a carrier of the header: {known}")));
        }
        if !is_name(word) {
            return Err(words.refused(word, NAME));
        }
        if self.names.len() == CARRIERS_MAX {
            return Err(words.refused(word, format!("one of the {CARRIERS_MAX} carriers before it")));
        }
        let number = self.names.len() as u32;
        self.names.push(word.into());
        self.numbers.insert(word, number);
        Ok(number)
    }

    /// Names and sets of the carriers, and whether the header has no list of carriers.
    pub(super) fn finish(self) -> (Vec<String>, Vec<Vec<u32>>, bool) {
        (self.names, self.sets, !self.declared)
    }
}
