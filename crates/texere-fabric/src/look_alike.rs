//! Characters that look like a hyphen or a slash, but are other characters. Word processors put
//! some of them in the place of a hyphen or a slash.

/// Looks in a text for the first character that looks like a hyphen but is another character.
/// Returns the name and the Unicode number of that character.
///
/// ```
/// assert_eq!(texere_fabric::hyphen_look_alike("1\u{2013}0"), Some("an en dash (U+2013)"));
/// assert_eq!(texere_fabric::hyphen_look_alike("1-0"), None);
/// ```
#[must_use]
pub fn hyphen_look_alike(text: &str) -> Option<&'static str> {
    text.chars().find_map(hyphen)
}

/// Looks in a text for the first character that looks like a slash but is another character.
/// Returns the name and the Unicode number of that character.
pub(crate) fn slash_look_alike(text: &str) -> Option<&'static str> {
    text.chars().find_map(slash)
}

const fn hyphen(sign: char) -> Option<&'static str> {
    Some(match sign {
        '\u{ad}' => "a soft hyphen (U+00AD)",
        '\u{2010}' => "a typographic hyphen (U+2010)",
        '\u{2011}' => "a non-breaking hyphen (U+2011)",
        '\u{2012}' => "a figure dash (U+2012)",
        '\u{2013}' => "an en dash (U+2013)",
        '\u{2014}' => "an em dash (U+2014)",
        '\u{2015}' => "a horizontal bar (U+2015)",
        '\u{2212}' => "a minus sign (U+2212)",
        '\u{fe58}' => "a small em dash (U+FE58)",
        '\u{fe63}' => "a small hyphen (U+FE63)",
        '\u{ff0d}' => "a wide hyphen (U+FF0D)",
        _ => return None,
    })
}

const fn slash(sign: char) -> Option<&'static str> {
    Some(match sign {
        '\u{2044}' => "a fraction slash (U+2044)",
        '\u{2215}' => "a division slash (U+2215)",
        '\u{29f8}' => "a big slash (U+29F8)",
        '\u{ff0f}' => "a wide slash (U+FF0F)",
        _ => return None,
    })
}
