//! Numbers and lists of numbers in WIF sections.

use texere_core::backend::filled;
use texere_core::counted;
use texere_fabric::LOOM_MAX;

use super::ini::{Entry, Ini};
use crate::read::error::shown;
use crate::read::{FilePlace, ReadError};

/// The place of an entry, as WIF writes it: `[WARP COLORS] 3`.
pub(super) fn place(ini: &Ini<'_>, section: &str, key: &str, entry: &Entry<'_>) -> FilePlace {
    FilePlace::new(ini.file, entry.line, &format!("[{}] {key}", section.to_uppercase()))
}

pub(super) fn bad(ini: &Ini<'_>, section: &str, key: &str, entry: &Entry<'_>, expected: &str) -> ReadError {
    let (place, value) = (place(ini, section, key, entry), shown(entry.value));
    ReadError::BadValue { place, value, expected: expected.into() }
}

/// A whole number from `low` to `high`, or `None` if the key is missing or empty.
pub(super) fn integer(
    ini: &Ini<'_>,
    section: &str,
    key: &str,
    low: u32,
    high: u32,
) -> Result<Option<u32>, ReadError> {
    let Some(entry) = ini.get(section, key) else { return Ok(None) };
    let value: f64 = entry.value.parse().map_err(|_| bad(ini, section, key, entry, "a whole number"))?;
    if value.fract() != 0.0 {
        return Err(bad(ini, section, key, entry, "a whole number"));
    }
    if !(f64::from(low)..=f64::from(high)).contains(&value) {
        let place = place(ini, section, key, entry);
        return Err(ReadError::OutOfRange { place, value, low: low.into(), high: high.into() });
    }
    Ok(Some(value as u32))
}

/// The numbers of a comma-separated value.
pub(super) fn list(
    ini: &Ini<'_>,
    section: &str,
    key: &str,
    entry: &Entry<'_>,
) -> impl Iterator<Item = Result<i64, ReadError>> {
    let items = entry.value.split(',').map(str::trim).filter(|item| !item.is_empty());
    items.map(move |item| {
        item.parse().map_err(|_| bad(ini, section, key, entry, "whole numbers separated by commas"))
    })
}

/// The lists of a section of `number=list` lines, one for each of 1 to `count`. A list has each of
/// its numbers once, and leaves out 0, which stands for none. Numbers above `limit` are refused;
/// `limit` is [`LOOM_MAX`] at most. Lines beyond `count` are left out with a warning.
pub(super) fn lists(
    ini: &Ini<'_>,
    section: &str,
    count: u32,
    limit: u32,
    warnings: &mut Vec<String>,
) -> Result<Vec<Vec<u32>>, ReadError> {
    let mut lists = filled("a draft", count as usize, Vec::new())?;
    // For each number, the last list that has it.
    let mut had = vec![0; LOOM_MAX as usize + 1];
    for (number, entry) in numbered(ini, section, count, warnings)? {
        let key = number.to_string();
        for value in list(ini, section, &key, &entry) {
            let value = value?;
            if !(0..=i64::from(limit)).contains(&value) {
                let place = place(ini, section, &key, &entry);
                let (value, high) = (value as f64, limit.into());
                return Err(ReadError::OutOfRange { place, value, low: 0.0, high });
            }
            if value > 0 && std::mem::replace(&mut had[value as usize], number) != number {
                lists[number as usize - 1].push(value as u32);
            }
        }
    }
    Ok(lists)
}

/// The lines of a section whose key is a number from 1 to `count`, sorted. A warning counts the
/// other lines. A section that begins at 0 and has no line `count` is refused, because all of its
/// lines would stand for the wrong threads.
pub(super) fn numbered<'a>(
    ini: &Ini<'a>,
    section: &str,
    count: u32,
    warnings: &mut Vec<String>,
) -> Result<Vec<(u32, Entry<'a>)>, ReadError> {
    let (mut lines, mut others) = (Vec::new(), 0);
    for (key, entry) in ini.entries(section) {
        match key.parse::<u32>() {
            Ok(number) if (1..=count).contains(&number) => lines.push((number, *entry)),
            _ => others += 1,
        }
    }
    lines.sort_by_key(|&(number, _)| number);
    if let Some(first) = ini.get(section, "0")
        && lines.last().is_none_or(|&(number, _)| number < count)
    {
        return Err(bad(
            ini,
            section,
            "0",
            first,
            "lines numbered from 1, as in WIF; this section counts from 0",
        ));
    }
    if others > 0 {
        let section = section.to_uppercase();
        let (are, they) = if others == 1 { ("is", "it is") } else { ("are", "they are") };
        let lines = counted(others, "line");
        warnings
            .push(format!("[{section}] has {lines} that {are} not numbered 1 to {count}; {they} left out"));
    }
    Ok(lines)
}

/// A length in the file's unit from `low` to `high`, or `None` for 0.
pub(super) fn length(
    ini: &Ini<'_>,
    section: &str,
    key: &str,
    entry: &Entry<'_>,
    [low, high]: [f64; 2],
) -> Result<Option<f64>, ReadError> {
    // Some programs write a decimal comma if their user's language has one.
    let value: f64 =
        entry.value.replace(',', ".").parse().map_err(|_| bad(ini, section, key, entry, "a length"))?;
    if value == 0.0 {
        return Ok(None);
    }
    if !(low..=high).contains(&value) {
        return Err(ReadError::OutOfRange { place: place(ini, section, key, entry), value, low, high });
    }
    Ok(Some(value))
}
