//! Texts and tables in TOML.

use std::fmt::Write as _;

/// A text in quotes, as TOML writes it.
pub(super) fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for letter in text.chars() {
        match letter {
            '"' | '\\' => quoted.extend(['\\', letter]),
            letter if letter.is_control() => {
                // Writing to a string does not fail.
                let _ = write!(quoted, "\\u{:04x}", u32::from(letter));
            }
            letter => quoted.push(letter),
        }
    }
    quoted + "\""
}

/// A table of `keys`, or an empty text if there are none.
pub(super) fn table(name: &str, keys: &[String]) -> String {
    if keys.is_empty() { String::new() } else { format!("\n[{name}]\n{}\n", keys.join("\n")) }
}
