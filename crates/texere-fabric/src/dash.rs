//! Characters that look like a hyphen and are none.

/// The name of the first character of a text that looks like a hyphen, `-`, but is another: a dash or a minus sign, as word processors and
/// web pages put in its place. It is for messages about texts where a hyphen or a negative number belongs.
///
/// ```
/// use texere_fabric::hyphen_look_alike;
/// assert_eq!(hyphen_look_alike("1\u{2013}0").as_deref(), Some("an en dash, U+2013, where a hyphen \"-\" belongs"));
/// assert_eq!(hyphen_look_alike("1-0"), None);
/// ```
#[must_use]
pub fn hyphen_look_alike(text: &str) -> Option<String> {
    text.chars().find_map(|letter| {
        let name = match letter {
            '\u{2010}' => "a typographic hyphen",
            '\u{2011}' => "a hyphen without a break",
            '\u{2012}' => "a figure dash",
            '\u{2013}' => "an en dash",
            '\u{2014}' => "an em dash",
            '\u{2015}' => "a horizontal bar",
            '\u{2212}' => "a minus sign",
            '\u{fe58}' => "a small em dash",
            '\u{fe63}' => "a small hyphen",
            '\u{ff0d}' => "a wide hyphen",
            _ => return None,
        };
        Some(format!("{name}, U+{:04X}, where a hyphen \"-\" belongs", u32::from(letter)))
    })
}
