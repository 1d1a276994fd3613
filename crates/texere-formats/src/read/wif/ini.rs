//! The INI dialect of WIF files, as weaving programs really write it.
//!
//! No INI crate fits: real drafts have text before the first section, lines without `=`, doubled sections and keys,
//! mixed line ends and Latin-1 letters, and an error has to name the line.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// A `key=value` line.
#[derive(Debug, Clone)]
pub(super) struct Entry {
    /// The line, from 1.
    pub(super) line: usize,
    /// As written, without the space around it; may be empty.
    pub(super) value: String,
}

/// The sections of a file, by name in lower case; in them the entries, by key in lower case.
#[derive(Debug)]
pub(super) struct Ini {
    pub(super) file: PathBuf,
    sections: HashMap<String, HashMap<String, Entry>>,
}

impl Ini {
    /// Reads all sections. Where a section or a key comes twice, the later value of each key stands.
    pub(super) fn parse(file: &Path, bytes: &[u8]) -> Self {
        let mut sections: HashMap<String, HashMap<String, Entry>> = HashMap::new();
        let mut section = None;
        for (line, text) in lines(&decode(bytes)).enumerate() {
            let text = text.trim();
            if text.starts_with(';') {
                continue;
            }
            if let Some(name) = text.strip_prefix('[').and_then(|rest| rest.split(']').next()) {
                section = Some(name.trim().to_lowercase());
            } else if let (Some(section), Some((key, value))) = (&section, text.split_once('=')) {
                let entry = Entry { line: line + 1, value: value.trim().into() };
                sections.entry(section.clone()).or_default().insert(key.trim().to_lowercase(), entry);
            }
        }
        // A section of nothing but empty values says nothing.
        sections.retain(|_, entries| entries.values().any(|entry| !entry.value.is_empty()));
        Self { file: file.into(), sections }
    }

    /// Whether a section says anything. `name` is in lower case.
    pub(super) fn has(&self, name: &str) -> bool {
        self.sections.contains_key(name)
    }

    /// The value of a key that is there and not empty. Both names are in lower case.
    pub(super) fn get(&self, section: &str, key: &str) -> Option<&Entry> {
        self.sections.get(section)?.get(key).filter(|entry| !entry.value.is_empty())
    }

    /// The entries of a section, empty ones too.
    pub(super) fn entries(&self, section: &str) -> impl Iterator<Item = (&str, &Entry)> {
        self.sections.get(section).into_iter().flatten().map(|(key, entry)| (key.as_str(), entry))
    }
}

/// UTF-8 where it is that, Latin-1 where it is not.
fn decode(bytes: &[u8]) -> String {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    match std::str::from_utf8(bytes) {
        Ok(text) => text.into(),
        Err(_) => bytes.iter().map(|&byte| char::from(byte)).collect(),
    }
}

/// Lines that end in LF, CRLF or a lone CR.
fn lines(text: &str) -> impl Iterator<Item = &str> {
    text.split('\n').flat_map(|line| line.strip_suffix('\r').unwrap_or(line).split('\r'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_what_programs_really_write() {
        let text = b"junk\r\nkey=before any section\n[One]\rA = 1\r\nno equals sign\r\n;B=2\n[TWO\n[one]\na=3\nC=\n[Empty]\nx=\n\
                     [Text]\nAuthor=Andr\xe9=x\n";
        let ini = Ini::parse(Path::new("a.wif"), text);
        let a = ini.get("one", "a").unwrap();
        assert_eq!((a.value.as_str(), a.line), ("3", 9));
        assert!(ini.get("one", "b").is_none() && ini.get("one", "c").is_none());
        assert!(!ini.has("empty"));
        assert_eq!(ini.get("text", "author").unwrap().value, "André=x");
    }
}
