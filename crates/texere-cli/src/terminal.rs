//! Text that is safe on a terminal: text of a design, a path or a driver can be long, and can hold
//! codes that control the terminal.

use std::borrow::Cow;
use std::fmt;

/// The most characters that are shown of a text: two lines of a wide terminal.
const SHOWN: usize = 240;

/// A text on a single line. Codes that control a terminal or turn the direction of writing are
/// shown by their numbers. A long text loses its middle.
///
/// The start of a message names its subject, and its end the fault, so both stay.
pub(crate) fn line(text: impl fmt::Display) -> String {
    let text = text.to_string();
    let escaped: String = cut(&text).chars().map(escape).collect();
    cut(&escaped).into_owned()
}

/// [`line()`] for each line of a text.
pub(crate) fn lines(text: &str) -> String {
    text.lines().map(|each| line(each) + "\n").collect()
}

fn cut(text: &str) -> Cow<'_, str> {
    let count = text.chars().count();
    if count <= SHOWN {
        return text.into();
    }
    let start: String = text.chars().take(SHOWN / 2).collect();
    let end: String = text.chars().skip(count - SHOWN / 2 + 1).collect();
    format!("{start}…{end}").into()
}

fn escape(character: char) -> Cow<'static, str> {
    // Control codes, marks of direction (Unicode 16, section 23.2), and ends of lines or
    // paragraphs.
    let steers = character.is_control()
        || matches!(character, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    if steers { character.escape_default().to_string().into() } else { character.to_string().into() }
}

#[cfg(test)]
mod tests {
    use super::line;

    #[test]
    fn what_steers_a_terminal_is_shown_by_its_number() {
        assert_eq!(line("plain weave, 3/1 — größer 綾"), "plain weave, 3/1 — größer 綾");
        assert_eq!(line("a\u{1b}]0;b\u{7}\u{9b}1m\n\tc"), "a\\u{1b}]0;b\\u{7}\\u{9b}1m\\n\\tc");
        assert_eq!(line("\u{202e}txt\u{2066}\u{200f}\u{2028}"), "\\u{202e}txt\\u{2066}\\u{200f}\\u{2028}");
    }

    #[test]
    fn what_is_long_keeps_its_start_and_its_end() {
        let whole = "x".repeat(240);
        assert_eq!(line(&whole), whole);
        for long in ["x".repeat(100_000), "\u{1b}".repeat(300), "ä".repeat(241)] {
            let shown = line(format!("start {long} end"));
            assert_eq!(shown.chars().count(), 240);
            assert!(shown.starts_with("start ") && shown.ends_with(" end") && shown.contains('…'), "{shown}");
        }
    }
}
