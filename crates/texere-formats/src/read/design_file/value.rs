//! Turns TOML's values into a design's values. Each value is read with its key and its line, for
//! errors.

use std::collections::BTreeMap;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::any::{Any, whole};
use super::source::Source;
use crate::read::ReadError;
use crate::read::error::{no_hyphen, said, shown};

/// A type of value that a key may hold.
pub(super) trait Value: Sized {
    /// The value of a key that is not there, or `None` if the key is required.
    fn absent() -> Option<Self> {
        None
    }

    fn read(node: &Node<'_>) -> Result<Self, ReadError>;
}

/// Reads a design file's text as a table.
///
/// **Errors**: [`ReadError::Syntax`] for a text that is not TOML, and the errors of the file's
/// keys.
pub(super) fn parse<T: Value>(source: &Source<'_>) -> Result<T, ReadError> {
    let table = DeTable::parse(source.text).map_err(|error| {
        let line = source.line(error.span().unwrap_or(0..0));
        let written = source.text.lines().nth(line - 1).and_then(|line| line.split('#').next());
        let message = said(error.message()) + &no_hyphen(written.unwrap_or_default());
        ReadError::Syntax { file: source.path.into(), line, message }
    })?;
    let span = table.span();
    T::read(&Node::root(source, &Spanned::new(span, DeValue::Table(table.into_inner()))))
}

/// A value of a design file and the keys that lead to it.
pub(super) struct Node<'a> {
    source: &'a Source<'a>,
    /// The table that the value stands in, and its key there. The file itself stands in no table.
    stands: Option<(&'a Node<'a>, &'a str)>,
    value: &'a Spanned<DeValue<'a>>,
}

impl<'a> Node<'a> {
    /// The whole file.
    pub(super) fn root(source: &'a Source<'a>, file: &'a Spanned<DeValue<'a>>) -> Self {
        Self { source, stands: None, value: file }
    }

    /// All keys that lead to the value, as errors write them.
    fn field(&self) -> String {
        match self.stands {
            None => String::new(),
            Some((Node { stands: None, .. }, key)) => key.into(),
            Some((table, key)) => format!("{}.{key}", table.field()),
        }
    }

    pub(super) fn text(&self) -> Option<&'a str> {
        self.value.as_ref().as_str()
    }

    /// The value as a table.
    pub(super) fn any_table(&self) -> Result<&'a DeTable<'a>, ReadError> {
        self.value.as_ref().as_table().ok_or_else(|| self.unfit("a table"))
    }

    /// The value as a table, which has no other keys than those `known`.
    pub(super) fn table(&self, known: &[&str]) -> Result<&'a DeTable<'a>, ReadError> {
        let table = self.any_table()?;
        self.only(table, known)?;
        Ok(table)
    }

    /// Refuses the first key of `table` that is not among those `known`.
    pub(super) fn only(&self, table: &DeTable<'_>, known: &[&str]) -> Result<(), ReadError> {
        let others = table.keys().filter(|key| !known.contains(&key.as_ref().as_ref()));
        let Some(key) = others.min_by_key(|key| key.span().start) else { return Ok(()) };
        let place = self.source.place(&format!("key \"{}\"", shown(key.as_ref())), key.span());
        Err(ReadError::UnknownKey { place, nearest: nearest(key.as_ref(), known) })
    }

    /// The value of `key` in `table`.
    pub(super) fn key<T: Value>(&self, table: &DeTable<'_>, key: &str) -> Result<T, ReadError> {
        match table.get(key) {
            Some(value) => T::read(&Node { source: self.source, stands: Some((self, key)), value }),
            None => T::absent().ok_or_else(|| ReadError::Value {
                place: self.source.place(&self.field(), self.value.span()),
                message: format!("key \"{key}\" is missing"),
            }),
        }
    }

    /// The refusal of the value, which is shown as the file has it.
    pub(super) fn unfit(&self, expected: &str) -> ReadError {
        self.source.unfit(&self.field(), self.value.span(), expected)
    }
}

/// The known key that is nearest in spelling to an unknown one, if any is near.
fn nearest(key: &str, known: &[&str]) -> Option<String> {
    // A key is a misspelling if it differs from a known key in few letters: at most a third of the
    // known key's letters, and one more. A key much longer than a known one is not compared letter
    // by letter, which would take long.
    let most = |known: &str| known.len().max(3) / 3 + 1;
    let nearest = known
        .iter()
        .filter(|known| key.len() <= known.len() + 4 * most(known))
        .map(|known| (strsim::damerau_levenshtein(key, known), known))
        .filter(|(distance, known)| *distance <= most(known))
        .min();
    nearest.map(|(_, known)| (*known).into())
}

impl Value for Any {
    fn read(node: &Node<'_>) -> Result<Self, ReadError> {
        Ok(Self::of(node.value.as_ref()))
    }
}

impl Value for String {
    fn read(node: &Node<'_>) -> Result<Self, ReadError> {
        node.text().map(Self::from).ok_or_else(|| node.unfit("text in quotes"))
    }
}

impl Value for i64 {
    fn read(node: &Node<'_>) -> Result<Self, ReadError> {
        let number = node.value.as_ref().as_integer().and_then(whole);
        number.ok_or_else(|| node.unfit("a whole number"))
    }
}

impl Value for f64 {
    fn read(node: &Node<'_>) -> Result<Self, ReadError> {
        Any::of(node.value.as_ref()).number().ok_or_else(|| node.unfit("a number"))
    }
}

impl Value for f32 {
    fn read(node: &Node<'_>) -> Result<Self, ReadError> {
        f64::read(node).map(|number| number as Self)
    }
}

impl<T: Value> Value for Option<T> {
    fn absent() -> Option<Self> {
        Some(None)
    }

    fn read(node: &Node<'_>) -> Result<Self, ReadError> {
        T::read(node).map(Some)
    }
}

impl<T: Value> Value for Spanned<T> {
    fn read(node: &Node<'_>) -> Result<Self, ReadError> {
        T::read(node).map(|value| Self::new(node.value.span(), value))
    }
}

impl<T: Value> Value for Vec<T> {
    fn read(node: &Node<'_>) -> Result<Self, ReadError> {
        let list = node.value.as_ref().as_array().ok_or_else(|| node.unfit("a list"))?;
        list.iter().map(|value| T::read(&Node { value, ..*node })).collect()
    }
}

/// A point.
impl Value for [f32; 2] {
    fn read(node: &Node<'_>) -> Result<Self, ReadError> {
        Vec::read(node)?.try_into().map_err(|_| node.unfit("two numbers"))
    }
}

impl<T: Value> Value for BTreeMap<Spanned<String>, T> {
    fn absent() -> Option<Self> {
        Some(Self::new())
    }

    fn read(node: &Node<'_>) -> Result<Self, ReadError> {
        let table = node.any_table()?;
        let values = table.iter().map(|(key, value)| {
            let stands = Some((node, key.as_ref().as_ref()));
            let value = T::read(&Node { stands, value, ..*node })?;
            Ok((Spanned::new(key.span(), key.as_ref().to_string()), value))
        });
        values.collect()
    }
}
