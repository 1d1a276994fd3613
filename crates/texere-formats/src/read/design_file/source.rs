//! The text of a design file, and the lines of its faults.

use std::ops::Range;
use std::path::{Path, PathBuf};

use texere_fabric::{FabricError, Weave};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::any::Any;
use crate::read::error::{no_hyphen, shown};
use crate::read::file::Files;
use crate::read::keys::Keys;
use crate::read::{FilePlace, ReadError};

/// The most threads of a warp or weft.
const THREAD_LIMIT: i64 = 1_000_000;

/// The text of a design file, its path, and the way to open the files that it names.
pub(super) struct Source<'a> {
    pub(super) path: &'a Path,
    pub(super) text: &'a str,
    pub(super) files: &'a Files<'a>,
}

impl<'a> Source<'a> {
    pub(super) fn new(path: &'a Path, bytes: &'a [u8], files: &'a Files<'a>) -> Result<Self, ReadError> {
        let text = std::str::from_utf8(bytes).map_err(|error| {
            let line = bytes[..error.valid_up_to()].iter().filter(|&&byte| byte == b'\n').count() + 1;
            ReadError::Syntax { file: path.into(), line, message: "not UTF-8".into() }
        })?;
        Ok(Self { path, text, files })
    }

    /// The path of a file that the design names, relative to the design's folder.
    pub(super) fn beside(&self, file: &Spanned<String>) -> PathBuf {
        self.path.parent().unwrap_or(Path::new("")).join(file.as_ref())
    }

    /// All keys of the file, or no keys if the file is not TOML.
    pub(super) fn keys(&self) -> Keys {
        let mut found = Vec::new();
        if let Ok(table) = DeTable::parse(self.text) {
            keys_of("", table.get_ref(), &mut found);
        }
        found.sort_unstable_by_key(|(_, at)| *at);
        let (mut line, mut from) = (1, 0);
        let lines = found.into_iter().map(|(key, at)| {
            line += self.text.as_bytes()[from..at].iter().filter(|byte| **byte == b'\n').count();
            from = at;
            (key, line)
        });
        Keys { file: self.path.into(), lines: lines.collect(), ..Keys::default() }
    }

    /// The text at `span` as the file has it, without quotes.
    fn written(&self, span: Range<usize>) -> String {
        shown(self.text.get(span).unwrap_or_default().trim_matches(['"', '\'']))
    }

    pub(super) fn line(&self, span: Range<usize>) -> usize {
        self.text.bytes().take(span.start).filter(|&byte| byte == b'\n').count() + 1
    }

    pub(super) fn place(&self, field: &str, span: Range<usize>) -> FilePlace {
        FilePlace::new(self.path, self.line(span), field)
    }

    pub(super) fn bad<T: ToString>(&self, field: &str, value: &Spanned<T>, expected: &str) -> ReadError {
        let (place, value) = (self.place(field, value.span()), shown(&value.as_ref().to_string()));
        let expected = expected.to_owned() + &no_hyphen(&value);
        ReadError::BadValue { place, value, expected }
    }

    /// The refusal of a value of the wrong kind. The value is shown as the file has it.
    pub(super) fn odd(&self, field: &str, value: &Spanned<Any>, expected: &str) -> ReadError {
        self.unfit(field, value.span(), expected)
    }

    /// The refusal of what stands at `span`, shown as the file has it.
    pub(super) fn unfit(&self, field: &str, span: Range<usize>, expected: &str) -> ReadError {
        let (place, value) = (self.place(field, span.clone()), self.written(span));
        let expected = expected.to_owned() + &no_hyphen(&value);
        ReadError::BadValue { place, value, expected }
    }

    /// The number in `value`, whole or not, without limits.
    pub(super) fn float(
        &self,
        field: &str,
        value: &Spanned<Any>,
        expected: &str,
    ) -> Result<Spanned<f64>, ReadError> {
        let number = value.as_ref().number().ok_or_else(|| self.odd(field, value, expected))?;
        Ok(Spanned::new(value.span(), number))
    }

    /// The number in `value`, which must be from `low` to `high`.
    pub(super) fn number(
        &self,
        field: &str,
        value: &Spanned<f64>,
        [low, high]: [f64; 2],
    ) -> Result<f64, ReadError> {
        if (low..=high).contains(value.as_ref()) {
            return Ok(*value.as_ref());
        }
        Err(ReadError::OutOfRange {
            place: self.place(field, value.span()),
            value: *value.as_ref(),
            low,
            high,
        })
    }

    /// The number in `value`, which must lie in `range`. None if the key is not there.
    pub(super) fn optional(
        &self,
        field: &str,
        value: &Option<Spanned<f64>>,
        range: [f64; 2],
    ) -> Result<Option<f64>, ReadError> {
        value.as_ref().map(|value| self.number(field, value, range)).transpose()
    }

    /// The number of threads in `value`.
    pub(super) fn count(&self, field: &str, value: &Spanned<i64>) -> Result<usize, ReadError> {
        self.integer(field, value, 1, THREAD_LIMIT).map(|count| count as usize)
    }

    pub(super) fn integer(
        &self,
        field: &str,
        value: &Spanned<i64>,
        low: i64,
        high: i64,
    ) -> Result<u32, ReadError> {
        let number = *value.as_ref();
        match u32::try_from(number) {
            Ok(fits) if (low..=high).contains(&number) => Ok(fits),
            _ => {
                let (place, value) = (self.place(field, value.span()), number as f64);
                Err(ReadError::OutOfRange { place, value, low: low as f64, high: high as f64 })
            }
        }
    }

    /// The colour that `color` writes as `#rrggbb`.
    pub(super) fn rgb(&self, field: &str, color: &Spanned<String>) -> Result<[u8; 3], ReadError> {
        let is_hex =
            |digits: &&str| digits.len() == 6 && digits.bytes().all(|digit| digit.is_ascii_hexdigit());
        let digits = color.as_ref().strip_prefix('#').filter(is_hex);
        let value = digits.and_then(|digits| u32::from_str_radix(digits, 16).ok());
        let [_, red, green, blue] =
            value.ok_or_else(|| self.bad(field, color, "a colour like #26406e"))?.to_be_bytes();
        Ok([red, green, blue])
    }

    pub(super) fn weave(&self, field: &str, notation: &Spanned<String>) -> Result<Weave, ReadError> {
        let weave = Weave::parse(notation.as_ref());
        weave.map_err(|source| ReadError::Weave { place: self.place(field, notation.span()), source })
    }

    pub(super) fn fabric(&self, source: FabricError) -> ReadError {
        ReadError::fabric(self.path, source)
    }
}

/// Adds the keys of a table to `found`, each with the byte at which it begins. `above` is the path
/// of keys that leads to the table.
fn keys_of(above: &str, table: &DeTable<'_>, found: &mut Vec<(String, usize)>) {
    for (key, value) in table {
        let key_at = key.span().start;
        let key = format!("{above}{}", key.get_ref());
        match value.get_ref() {
            DeValue::Table(table) => keys_of(&format!("{key}."), table, found),
            // A key of a table in a list is named by the list, the list's singular, the table's
            // number and the key itself: `bars, bar 2: lapping`.
            DeValue::Array(list) => {
                let one = key.rsplit('.').next().unwrap_or_default().trim_end_matches('s');
                for (number, item) in (1..).zip(list.iter()) {
                    if let DeValue::Table(table) = item.get_ref() {
                        keys_of(&format!("{key}, {one} {number}: "), table, found);
                    }
                }
            }
            _ => {}
        }
        found.push((key, key_at));
    }
}
