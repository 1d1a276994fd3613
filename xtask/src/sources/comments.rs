//! Comments that are too wide.

use super::files::Source;

/// The most columns of a line that has a comment.
const COLUMNS_MOST: usize = 100;

/// All lines with a comment that are wider than [`COLUMNS_MOST`], with their columns. Addresses,
/// rows of tables and code in docs may be wider.
pub(crate) fn find(files: &[Source]) -> Vec<String> {
    let mut found = Vec::new();
    for file in files {
        let lines: Vec<_> = file.text.lines().collect();
        let mut in_code = false;
        let mut last = 0;
        for (number, comment) in comments(&file.text) {
            let said = comment.trim_start_matches(['/', '!', '*', ' ']);
            // A fence without an end ends with its comment.
            in_code &= number <= last + 1;
            last = number;
            if said.starts_with("```") {
                in_code = !in_code;
                continue;
            }
            let columns = lines[number].chars().count();
            if columns > COLUMNS_MOST && !in_code && !said.starts_with('|') && !said.contains("://") {
                found.push(format!("{}:{}: {columns} columns", file.path.display(), number + 1));
            }
        }
    }
    found
}

/// The comment of each line, with the line's number, counted from 0.
fn comments(text: &str) -> Vec<(usize, &str)> {
    let mut found = Vec::new();
    let (mut at, mut line) = (0, 0);
    while at < text.len() {
        let rest = &text[at..];
        let length = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            block(rest)
        } else {
            let length = literal(rest, text[..at].chars().next_back());
            line += rest[..length].matches('\n').count();
            at += length;
            continue;
        };
        let lines = rest[..length].split('\n');
        found.extend(lines.enumerate().map(|(further, part)| (line + further, part)));
        line += rest[..length].matches('\n').count();
        at += length;
    }
    found
}

/// The number of bytes of the block comment that `text` begins with, nested comments included.
fn block(text: &str) -> usize {
    let (mut depth, mut at) = (0_usize, 0);
    while at < text.len() {
        let rest = &text[at..];
        if rest.starts_with("/*") {
            depth += 1;
            at += 2;
        } else if rest.starts_with("*/") {
            depth -= 1;
            at += 2;
            if depth == 0 {
                return at;
            }
        } else {
            at += rest.chars().next().map_or(1, char::len_utf8);
        }
    }
    text.len()
}

/// The number of bytes of the string or character literal that `text` begins with, or else of its
/// first character.
fn literal(text: &str, before: Option<char>) -> usize {
    let first = text.chars().next().map_or(1, char::len_utf8);
    let in_word = before.is_some_and(|before| before.is_alphanumeric() || before == '_');
    if let (Some(raw), false) = (text.strip_prefix('r').or_else(|| text.strip_prefix("br")), in_word) {
        let hashes = raw.len() - raw.trim_start_matches('#').len();
        if raw[hashes..].starts_with('"') {
            let open = text.len() - raw.len() + hashes + 1;
            let close = format!("\"{}", "#".repeat(hashes));
            return text[open..].find(&close).map_or(text.len(), |end| open + end + close.len());
        }
    }
    if text.starts_with('"') {
        return quoted(text, '"');
    }
    // A single quote begins a lifetime, unless a backslash follows it or a second quote stands
    // behind one character.
    let mut after = text.chars().skip(1);
    match (text.starts_with('\''), after.next(), after.next()) {
        (true, Some('\\'), _) | (true, Some(_), Some('\'')) => quoted(text, '\''),
        _ => first,
    }
}

/// The number of bytes up to the second `quote`. Quotes behind a backslash do not count.
fn quoted(text: &str, quote: char) -> usize {
    let mut escaped = false;
    for (at, character) in text.char_indices().skip(1) {
        if character == quote && !escaped {
            return at + quote.len_utf8();
        }
        escaped = character == '\\' && !escaped;
    }
    text.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wide(path: &str, text: &str) -> Vec<String> {
        find(&[Source { path: path.into(), text: text.to_owned() }])
    }

    /// A line of 101 columns is found in each kind of comment, and a line of 100 is not.
    #[test]
    fn the_first_column_too_many_counts() {
        for (before, after) in [
            ("// ", ""),
            ("/// ", ""),
            ("    //! ", ""),
            ("let a = 'b'; // ", ""),
            ("fn a<'b>(c: &'b str) {} // ", ""),
            ("let a = \"\\\"\"; // ", ""),
            ("let a = r#\"\"\"#; // ", ""),
            ("/* ", " */"),
            ("/* /* */ ", " */"),
        ] {
            for columns in [100, 101] {
                let text = format!("\n{before}{}{after}\n", "ä".repeat(columns - before.len() - after.len()));
                let found = wide("a.rs", &text);
                let expected: &[_] = if columns == 101 { &["a.rs:2: 101 columns".to_owned()] } else { &[] };
                assert_eq!(found, expected, "{text}");
            }
        }
        let text = format!("/*\n{}\n*/\n", "a ".repeat(60));
        assert_eq!(wide("a.wgsl", &text), ["a.wgsl:2: 120 columns"]);
    }

    #[test]
    fn what_cannot_be_wrapped_may_be_wide() {
        let long = "a".repeat(120);
        for text in [
            format!("/// <https://example.org/{long}>"),
            format!("/// | {long} |"),
            format!("/// ```\n/// {long}\n/// ```"),
            format!("let a = \"// {long}\";"),
            format!("let a = \"\\\"// {long}\";"),
            format!("let a = \"\n// {long}\";"),
            format!("let a = r##\"\"# // {long}\"##;"),
            format!("let a = {long};"),
        ] {
            assert_eq!(wide("a.rs", &text), Vec::<String>::new());
        }
        // The fence ends before the long line.
        assert_eq!(wide("a.rs", &format!("/// ```\n/// ```\n/// {long}")), ["a.rs:3: 124 columns"]);
    }
}
