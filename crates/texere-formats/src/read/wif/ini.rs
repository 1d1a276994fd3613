//! The INI dialect of WIF files, as weaving programs really write it.
//!
//! No INI crate fits: real drafts have text before the first section, lines without `=`, doubled
//! sections and keys, mixed line ends and Latin-1 letters, and an error has to name the line.

use std::borrow::Cow;
use std::collections::HashMap;
use std::path::Path;

use crate::read::draft::lines;
use crate::read::keys::Keys;

/// A `key=value` line.
#[derive(Debug, Clone, Copy)]
pub(super) struct Entry<'a> {
    /// The line, counted from 1.
    pub(super) line: usize,
    /// The value as written, without comment and without space around it. It may be empty.
    pub(super) value: &'a str,
}

/// The entries of a section, by key in lower case.
type Section<'a> = HashMap<Cow<'a, str>, Entry<'a>>;

/// The sections of a file, by name in lower case.
#[derive(Debug)]
pub(super) struct Ini<'a> {
    pub(super) file: &'a Path,
    sections: HashMap<Cow<'a, str>, Section<'a>>,
}

/// The sections that are kept: those that describe the cloth, and those with its title and with the
/// program that wrote the file. Other sections may have any size, because nothing of them is kept.
const READ: [&str; 17] = [
    "wif",
    TEXT,
    "weaving",
    "warp",
    "weft",
    "threading",
    "tieup",
    "treadling",
    "liftplan",
    "color palette",
    "color table",
    "warp colors",
    "weft colors",
    "warp spacing",
    "weft spacing",
    "warp thickness",
    "weft thickness",
];

/// The section of titles and authors, where a semicolon within a value is text.
const TEXT: &str = "text";

impl<'a> Ini<'a> {
    /// Reads the sections. If a section or a key comes twice, the later value counts.
    pub(super) fn parse(file: &'a Path, text: &'a str) -> Self {
        let mut sections: HashMap<Cow<'a, str>, Section<'a>> = HashMap::new();
        let (mut section, mut is_text) = (None, false);
        for (line, text) in lines(text).enumerate() {
            let text = text.trim();
            let comment = if is_text && !text.starts_with([';', '[']) { None } else { text.find(';') };
            let text = comment.map_or(text, |from| &text[..from]);
            if let Some(name) = text.strip_prefix('[').and_then(|rest| rest.split(']').next()) {
                let name = lower_case(name.trim());
                is_text = name == TEXT;
                section = READ.contains(&name.as_ref()).then(|| sections.entry(name).or_default());
            } else if let (Some(section), Some((key, value))) = (&mut section, text.split_once('=')) {
                section.insert(plain_key(key.trim()), Entry { line: line + 1, value: value.trim() });
            }
        }
        // A section in which all values are empty counts as missing.
        sections.retain(|_, entries| entries.values().any(|entry| !entry.value.is_empty()));
        Self { file, sections }
    }

    /// The keys that errors of the cloth name, with their lines.
    pub(super) fn keys(&self) -> Keys {
        let single = ["threads", "spacing", "thickness"].into_iter().flat_map(|key| {
            let of =
                move |set: &str| Some((format!("[{}] {key}", set.to_uppercase()), self.get(set, key)?.line));
            ["warp", "weft"].into_iter().filter_map(of)
        });
        let whole = ["tieup", "liftplan"].into_iter().filter_map(|section| {
            let first = self.entries(section).map(|(_, entry)| entry.line).min()?;
            Some((format!("[{}]", section.to_uppercase()), first))
        });
        let numbered = READ
            .into_iter()
            .filter(|section| section.ends_with(" spacing") || section.ends_with(" thickness"));
        let numbered = numbered.map(|section| {
            let said = self.entries(section).filter(|(_, entry)| !entry.value.is_empty());
            let mut threads: Vec<(u32, usize)> =
                said.filter_map(|(key, entry)| Some((key.parse().ok()?, entry.line))).collect();
            threads.sort_unstable();
            (section.to_uppercase(), threads)
        });
        Keys {
            file: self.file.into(),
            lines: single.chain(whole).collect(),
            numbered: numbered.collect(),
            ..Keys::default()
        }
    }

    /// Whether a section is there and has a value. `name` is in lower case.
    pub(super) fn has(&self, name: &str) -> bool {
        self.sections.contains_key(name)
    }

    /// The entry of a key, if there is one and its value is not empty. Both names are in lower
    /// case.
    pub(super) fn get(&self, section: &str, key: &str) -> Option<&Entry<'a>> {
        self.sections.get(section)?.get(key).filter(|entry| !entry.value.is_empty())
    }

    /// The entries of a section, empty ones included.
    pub(super) fn entries(&self, section: &str) -> impl Iterator<Item = (&str, &Entry<'a>)> {
        self.sections.get(section).into_iter().flatten().map(|(key, entry)| (key.as_ref(), entry))
    }
}

/// A key in the spelling by which it is looked up. A number loses its plus sign and its leading
/// zeros, so that 01 and 1 are one key. Any other key is in lower case. Most keys are plain
/// numbers, which are not copied.
fn plain_key(key: &str) -> Cow<'_, str> {
    match key.parse::<u32>() {
        Ok(number) if key.starts_with(['0', '+']) => Cow::Owned(number.to_string()),
        _ => lower_case(key),
    }
}

fn lower_case(name: &str) -> Cow<'_, str> {
    if name.bytes().all(|byte| byte.is_ascii_digit() || byte.is_ascii_lowercase()) {
        Cow::Borrowed(name)
    } else {
        Cow::Owned(name.to_lowercase())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::read::draft::decode;

    #[test]
    fn a_semicolon_begins_a_comment_but_in_titles() {
        let text = "[Warp] ;the ends\nThreads=8;eight\nSpacing= ; as the weft\n;Color=1\n[TEXT]\nTitle=Bird's eye; red\n\
                    ;Author=none\n[Weft];\nThreads=4 ; = 4\n; Units=cm\nUnits;no=in\n";
        let ini = Ini::parse(Path::new("a.wif"), text);
        let value = |section, key| ini.get(section, key).map(|entry| entry.value);
        assert_eq!(
            (value("warp", "threads"), value("warp", "spacing"), value("warp", "color")),
            (Some("8"), None, None)
        );
        assert_eq!((value("text", "title"), value("text", "author")), (Some("Bird's eye; red"), None));
        assert_eq!((value("weft", "threads"), value("weft", "units")), (Some("4"), None));
    }

    #[test]
    fn reads_what_programs_really_write() {
        let text = b"junk\r\nkey=before any section\n[Warp]\rA = 1\r\nno equals sign\r\n;B=2\n[TWO\n[warp]\na=3\nC=\n[Weft]\nx=\n\
                     [Text]\nAuthor=Andr\xe9=x\n";
        let text = decode(text);
        let ini = Ini::parse(Path::new("a.wif"), &text);
        let a = ini.get("warp", "a").unwrap();
        assert_eq!((a.value, a.line), ("3", 9));
        assert!(ini.get("warp", "b").is_none() && ini.get("warp", "c").is_none());
        assert!(!ini.has("weft"));
        assert_eq!(ini.get("text", "author").unwrap().value, "André=x");
    }
}
