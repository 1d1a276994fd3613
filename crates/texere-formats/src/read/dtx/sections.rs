//! The sections of a Fiberworks file, and their words and numbers.

use std::collections::HashMap;
use std::path::Path;

use crate::read::draft::{THREADS_MAX, lines};
use crate::read::error::shown;
use crate::read::{FilePlace, ReadError};

/// The sections that are read, in lower case. Others may have any size, because nothing of them is
/// kept.
const READ: [&str; 11] = [
    "description",
    "info",
    "threading",
    "tieup",
    "treadling",
    "liftplan",
    "color palette",
    "warp colors",
    "weft colors",
    "warp spacing",
    "weft spacing",
];

/// The name of the section that every file begins with.
const START: &str = "startdtx";

/// A line of a section.
#[derive(Debug, Clone, Copy)]
pub(super) struct Row<'a> {
    /// The line of the file, counted from 1.
    pub(super) line: usize,
    /// The text without space around it, and without the `%%` of a setting. Only the text of a
    /// setting may be empty.
    pub(super) text: &'a str,
    /// The number of letters before the text, in the line.
    indent: usize,
}

/// A word of a section, or a digit.
#[derive(Debug, Clone, Copy)]
pub(super) struct Word<'a> {
    row: Row<'a>,
    /// The place of the word's first byte in the row's text.
    at: usize,
    pub(super) text: &'a str,
}

/// A section of the file.
#[derive(Debug, Default)]
pub(super) struct Section<'a> {
    /// The line of the file that names the section.
    line: usize,
    /// Lines without `%%`.
    pub(super) rows: Vec<Row<'a>>,
    /// Lines that begin with `%%`, without these signs.
    settings: Vec<Row<'a>>,
}

/// The sections of a file, by name in lower case.
#[derive(Debug)]
pub(super) struct Sections<'a> {
    pub(super) file: &'a Path,
    sections: HashMap<&'static str, Section<'a>>,
}

impl<'a> Row<'a> {
    /// The words of the row. A word ends at a space.
    pub(super) fn words(self) -> impl Iterator<Item = Word<'a>> {
        let mut from = 0;
        let parts = self.text.split(char::is_whitespace).map(move |text| {
            let at = from;
            // A space may have several bytes.
            let space = self.text[at + text.len()..].chars().next().map_or(0, char::len_utf8);
            from = at + text.len() + space;
            Word { row: self, at, text }
        });
        parts.filter(|word| !word.text.is_empty())
    }

    /// Whether each digit of the row is 1. Digits may only be 0 and 1.
    pub(super) fn digits(self, file: &Path) -> impl Iterator<Item = Result<bool, ReadError>> {
        self.text.char_indices().map(move |(at, digit)| match digit {
            '0' => Ok(false),
            '1' => Ok(true),
            _ => {
                let text = &self.text[at..at + digit.len_utf8()];
                Err(Word { row: self, at, text }.refused(file, "1 or 0"))
            }
        })
    }

    /// The refusal of the row as a whole.
    pub(super) fn refused(self, file: &Path, expected: &str) -> ReadError {
        Word { row: self, at: 0, text: self.text }.refused(file, expected)
    }
}

impl<'a> Word<'a> {
    /// The parts of the word between its commas. A comma at an end of the word gives no part.
    pub(super) fn parts(self) -> impl Iterator<Item = Self> {
        let mut from = self.at;
        let parts = self.text.split(',').map(move |text| {
            let at = from;
            from += text.len() + 1;
            Self { at, text, ..self }
        });
        parts.filter(|part| !part.text.is_empty())
    }

    /// The whole number from 0 to `most` that the word is.
    pub(super) fn number(self, file: &Path, most: u32, of: &str) -> Result<u32, ReadError> {
        let number = self.text.parse().ok().filter(|number| *number <= most);
        number.ok_or_else(|| self.refused(file, &format!("{of} from 0 to {most}")))
    }

    /// The refusal of the word.
    pub(super) fn refused(self, file: &Path, expected: &str) -> ReadError {
        let column = self.row.indent + self.row.text[..self.at].chars().count() + 1;
        ReadError::Word {
            file: file.into(),
            line: self.row.line,
            column,
            value: shown(self.text),
            expected: expected.into(),
        }
    }
}

impl<'a> Sections<'a> {
    /// Reads the sections. If a section comes twice, the later one counts.
    ///
    /// **Errors**: [`ReadError::Word`] for a file that does not begin as Fiberworks files do, and
    /// for a section of more lines than a cloth may have threads.
    pub(super) fn parse(file: &'a Path, text: &'a str) -> Result<Self, ReadError> {
        let mut sections: HashMap<&'static str, Section<'a>> = HashMap::new();
        let (mut open, mut has_begun) = (None, false);
        for (line, whole) in (1..).zip(lines(text)) {
            let text = whole.trim();
            if text.is_empty() {
                continue;
            }
            let indent = whole.len() - whole.trim_start().len();
            let row = Row { line, text, indent: whole[..indent].chars().count() };
            let name = text.strip_prefix("@@").map(|name| name.trim().to_ascii_lowercase());
            if !has_begun && name.as_deref() != Some(START) {
                return Err(row.refused(file, "@@StartDTX, with which drafts of Fiberworks begin"));
            }
            has_begun = true;
            if let Some(name) = name {
                // Fiberworks 4.2 leaves two letters of this name out.
                let name = if name == "color palet" { "color palette" } else { &*name };
                open = READ.into_iter().find(|known| *known == name);
                if let Some(known) = open {
                    sections.insert(known, Section { line, ..Section::default() });
                }
            } else if let Some(section) = open.and_then(|name| sections.get_mut(name)) {
                let setting = text.strip_prefix("%%").map(str::trim);
                let list = if setting.is_some() { &mut section.settings } else { &mut section.rows };
                if list.len() >= THREADS_MAX as usize {
                    return Err(row.refused(file, &format!("the end of a section of {THREADS_MAX} lines")));
                }
                list.push(Row { text: setting.unwrap_or(text), ..row });
            }
        }
        Ok(Self { file, sections })
    }

    /// A section by its name in lower case, if it is there and has a line.
    pub(super) fn get(&self, name: &str) -> Option<&Section<'a>> {
        self.sections.get(name).filter(|section| !section.rows.is_empty())
    }

    /// Whether a section has the line `%%%%sinking`.
    pub(super) fn is_sinking(&self, name: &str) -> bool {
        let is = |row: &Row<'_>| row.text.trim_start_matches('%').eq_ignore_ascii_case("sinking");
        self.sections.get(name).is_some_and(|section| section.settings.iter().any(is))
    }

    /// The number of a line `%%key number` of `Info`, from 0 to `most`, with its line. None if
    /// there is no such line or it has no number.
    pub(super) fn info(&self, key: &str, most: u32) -> Result<Option<(u32, usize)>, ReadError> {
        let settings = self.sections.get("info").map_or(&[][..], |info| &info.settings);
        let found = settings.iter().rev().find_map(|row| {
            let mut words = row.words();
            let is = words.next()?.text.eq_ignore_ascii_case(key);
            Some((row, words.next()?)).filter(|_| is)
        });
        let Some((row, word)) = found else { return Ok(None) };
        let field = format!("@@Info %%{key}");
        let place = FilePlace::new(self.file, row.line, &field);
        let expected = || "a whole number".into();
        let value: u64 = word.text.parse().map_err(|_| ReadError::BadValue {
            place: place.clone(),
            value: shown(word.text),
            expected: expected(),
        })?;
        match u32::try_from(value).ok().filter(|value| *value <= most) {
            Some(value) => Ok(Some((value, row.line))),
            None => {
                Err(ReadError::OutOfRange { place, value: value as f64, low: 0.0, high: f64::from(most) })
            }
        }
    }

    /// The line of the file that names a section.
    pub(super) fn line(&self, name: &str) -> Option<usize> {
        Some(self.get(name)?.line)
    }

    /// The numbers of a section, each from 0 to `most`. `of` says what they number. The list is
    /// empty if the section is not there.
    pub(super) fn numbers(&self, name: &str, most: u32, of: &str) -> Result<Vec<u32>, ReadError> {
        let mut numbers = Vec::new();
        for word in self.get(name).into_iter().flat_map(|section| &section.rows).flat_map(|row| row.words()) {
            self.room_for_one(numbers.len(), word)?;
            numbers.push(word.number(self.file, most, of)?);
        }
        Ok(numbers)
    }

    /// Refuses `word`, the next entry of a list, if the `count` entries before it are already as
    /// many as a cloth may have threads.
    pub(super) fn room_for_one(&self, count: usize, word: Word<'_>) -> Result<(), ReadError> {
        if count < THREADS_MAX as usize {
            return Ok(());
        }
        Err(word.refused(self.file, &format!("the end of a list for {THREADS_MAX} threads")))
    }
}
