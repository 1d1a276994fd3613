//! Counts with their nouns.

use std::fmt::Display;

/// A count with its noun, in the singular or the plural. The plural is the noun with an s.
///
/// ```
/// use texere_core::counted;
/// assert_eq!((counted(1, "loop").as_str(), counted(2, "loop").as_str()), ("1 loop", "2 loops"));
/// ```
#[must_use]
pub fn counted(count: impl Display + PartialEq + From<u8>, one: &str) -> String {
    let s = if count == 1.into() { "" } else { "s" };
    format!("{count} {one}{s}")
}
