//! A value of a design file, of any kind.

use toml::de::{DeFloat, DeInteger, DeValue};

/// A value of any kind. The reader of its key says what it expected.
#[derive(Debug)]
pub(super) enum Any {
    Text(String),
    Number(f64),
    Truth(bool),
    List(Vec<Self>),
    /// A table, a date, or a number that is too large.
    Other,
}

impl Any {
    pub(super) fn of(value: &DeValue<'_>) -> Self {
        match value {
            DeValue::String(text) => Self::Text(text.to_string()),
            DeValue::Integer(number) => whole(number).map_or(Self::Other, |whole| Self::Number(whole as f64)),
            DeValue::Float(number) => real(number).map_or(Self::Other, Self::Number),
            DeValue::Boolean(truth) => Self::Truth(*truth),
            DeValue::Array(list) => Self::List(list.iter().map(|item| Self::of(item.as_ref())).collect()),
            DeValue::Datetime(_) | DeValue::Table(_) => Self::Other,
        }
    }

    pub(super) fn text(&self) -> Option<&str> {
        if let Self::Text(text) = self { Some(text) } else { None }
    }

    /// A number, written with a point or without.
    pub(super) fn number(&self) -> Option<f64> {
        if let Self::Number(number) = self { Some(*number) } else { None }
    }

    pub(super) fn truth(&self) -> Option<bool> {
        if let Self::Truth(truth) = self { Some(*truth) } else { None }
    }

    pub(super) fn list(&self) -> Option<&[Self]> {
        if let Self::List(list) = self { Some(list) } else { None }
    }
}

/// The whole number, or none if it does not fit into 64 bits.
pub(super) fn whole(number: &DeInteger<'_>) -> Option<i64> {
    i64::from_str_radix(number.as_str(), number.radix()).ok()
}

/// The number, or none if it is too large for an `f64`.
fn real(number: &DeFloat<'_>) -> Option<f64> {
    let value: f64 = number.as_str().parse().ok()?;
    (!value.is_infinite() || number.as_str().contains("inf")).then_some(value)
}
