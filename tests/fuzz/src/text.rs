//! Mutations of text that respect its lines, sections, keys, numbers and lists.

use fastrand::Rng;

use crate::corpus;

/// Numbers that readers or number types treat differently from their neighbours.
const NUMBERS: &[&str] = &[
    "0",
    "-1",
    "1",
    "2",
    "3",
    "5",
    "8",
    "13",
    "0.5",
    "-0.0",
    "0.001",
    "0.0009",
    "1e-3",
    "1e-45",
    "1e-300",
    "1e300",
    "1e9",
    "nan",
    "inf",
    "-inf",
    "255",
    "256",
    "999",
    "1000",
    "4096",
    "4097",
    "100000",
    "100001",
    "1000000",
    "1000001",
    "4294967295",
    "4294967296",
    "9223372036854775807",
    "99999999999999999999",
    "0x10",
    "1_000",
    "1.",
    ".5",
    "+3",
    "1,5",
];

/// Words that readers know, for places where they do not belong, and letters, signs and codes that
/// readers may not expect.
const WORDS: &[&str] = &[
    "plain",
    "round",
    "crossing",
    "flatten",
    "shrink",
    "report",
    "true",
    "false",
    "polygon",
    "circle",
    "ellipse",
    "lenticular",
    "motif.png",
    "draft.wif",
    ".",
    "..",
    "/dev/null",
    "design.toml",
    "first-pick-first",
    "program.k",
    "knit",
    "tuck",
    "xfer",
    "f1",
    "b-2",
    "bs3",
    "birdseye",
    "even",
    "RRrr",
    "tricot",
    "atlas 3",
    "out",
    "1-0/1-2//",
    "0-2/3-1",
    "(1-0/2-3)x3",
    "0-0/511-512//",
    "free",
    "held",
    "#000000",
    "#FFFFFF",
    "a",
    "2 a",
    "",
    "Inches",
    "mm",
    "Decipoints",
    "é",
    "\u{1b}[31m",
    "𝄞",
    "\\u0000",
    "\"",
    "'''",
    "[[",
    "]]",
    "{",
    "=",
    "0,0,0",
    "1,1,1,1",
];

/// Applies up to five mutations to the lines of one of `seeds`. Some mutations take parts of
/// another seed. In 8 of 256 cases the bytes are then scrambled, and in 4 the text is encoded as
/// UTF-16.
pub(crate) fn mutated(seeds: &[&str], random: &mut Rng) -> Vec<u8> {
    let seed = |random: &mut Rng| random.choice(seeds).copied().unwrap_or_default();
    let mut lines: Vec<String> = seed(random).lines().map(Into::into).collect();
    let other: Vec<String> = seed(random).lines().map(Into::into).collect();
    for _ in 0..random.usize(0..6) {
        mutate(&mut lines, &other, random);
    }
    let ends = if random.u8(..) < 16 { "\r\n" } else { "\n" };
    let mut bytes = lines.join(ends).into_bytes();
    bytes.extend(ends.bytes());
    match random.u8(..) {
        0..8 => scrambled(&mut bytes, random),
        8..12 => {
            let text = String::from_utf8_lossy(&bytes).into_owned();
            let unit = if random.bool() { u16::to_le_bytes } else { u16::to_be_bytes };
            let mark = random.bool().then_some(0xfeff);
            bytes = mark.into_iter().chain(text.encode_utf16()).flat_map(unit).collect();
        }
        _ => {}
    }
    bytes
}

fn mutate(lines: &mut Vec<String>, other: &[String], random: &mut Rng) {
    let here = random.usize(..=lines.len());
    let last = lines.len().saturating_sub(1);
    let line = here.min(last);
    match random.u8(0..16) {
        0 if !lines.is_empty() => drop(lines.remove(line)),
        1 if !lines.is_empty() => lines.insert(here, lines[line].clone()),
        2 if !lines.is_empty() => lines.swap(line, random.usize(..=last)),
        // Lines of another seed are inserted before a line or at the end.
        3 if !other.is_empty() => {
            let from = random.usize(..other.len());
            let count = random.usize(..=other.len() - from).min(8);
            lines.splice(here..here, other[from..from + count].iter().cloned());
        }
        4 => {
            lines.truncate(here);
            lines.extend_from_slice(&other[random.usize(..=other.len())..]);
        }
        5 => lines.truncate(here),
        // A section moves to the end. If the section occurs twice, the move changes which of the
        // two counts.
        6 if !lines.is_empty() => {
            let start = (0..=line).rev().find(|&at| lines[at].starts_with(['[', '@'])).unwrap_or(0);
            let end =
                (start + 1..lines.len()).find(|&at| lines[at].starts_with(['[', '@'])).unwrap_or(lines.len());
            let section: Vec<_> = lines.drain(start..end).collect();
            lines.extend(section);
        }
        7 => lines.insert(here, format!("{}={}", random.u32(0..12), number(random))),
        8 => lines.insert(here, format!("{} = {}", word(random), number(random))),
        _ if lines.is_empty() => {}
        9 | 10 => lines[line] = with_key(&lines[line], &other[random.usize(..other.len())]),
        11 => lines[line] = with_list(&lines[line], random),
        _ => lines[line] = with_token(&lines[line], random),
    }
}

/// Changes or replaces one of the numbers and words of a line. Appends a number if there is none.
fn with_token(line: &str, random: &mut Rng) -> String {
    let is_part = |letter: char| letter.is_ascii_alphanumeric() || ".-#_".contains(letter);
    let mut tokens: Vec<(usize, usize)> = Vec::new();
    let mut start = None;
    for (at, letter) in line.char_indices().chain([(line.len(), ' ')]) {
        match (is_part(letter), start) {
            (true, None) => start = Some(at),
            (false, Some(from)) => {
                tokens.push((from, at));
                start = None;
            }
            _ => {}
        }
    }
    // The value changes more often than the key. The last tokens are the value.
    let Some(&(from, to)) =
        tokens.get(random.usize(..tokens.len().max(1)).max(random.usize(..tokens.len().max(1))))
    else {
        return format!("{line}{}", number(random));
    };
    let token = &line[from..to];
    let new = match (token.parse::<f64>(), random.u8(0..8)) {
        (Ok(value), 0..3) => (value * [-1.0, 0.1, 0.5, 2.0, 10.0][random.usize(..5)]).to_string(),
        (Ok(value), 3) => (value + 1.0).to_string(),
        (Ok(_), _) => number(random).into(),
        (Err(_), 0..4) => word(random).into(),
        (Err(_), 4) => token.to_uppercase(),
        (Err(_), 5) => token.repeat(random.usize(0..4)),
        (Err(_), _) => number(random).into(),
    };
    format!("{}{new}{}", &line[..from], &line[to..])
}

/// Joins the key of one line with the value of another. If either has no key, the other line is
/// returned.
fn with_key(line: &str, other: &str) -> String {
    match (line.split_once('='), other.split_once('=')) {
        (Some((key, _)), Some((_, value))) => format!("{key}={value}"),
        _ => other.into(),
    }
}

/// Adds or removes one item of a list, repeats the list, or reverses it.
fn with_list(line: &str, random: &mut Rng) -> String {
    let (head, items) = line.split_once(['=', '[']).unwrap_or((line, ""));
    let sign = line[head.len()..].chars().next().unwrap_or('=');
    let mut items: Vec<&str> = items.split(',').collect();
    let at = random.usize(..items.len());
    match random.u8(0..5) {
        0 => drop(items.remove(at)),
        1 => items.insert(at, number(random)),
        2 => items = items.repeat(random.usize(1..5)),
        3 => items = items.repeat(1 << random.u32(0..12)),
        _ => items.reverse(),
    }
    format!("{head}{sign}{}", items.join(","))
}

fn number(random: &mut Rng) -> &'static str {
    random.choice(NUMBERS).copied().unwrap_or_default()
}

fn word(random: &mut Rng) -> &'static str {
    random.choice(WORDS).copied().unwrap_or_default()
}

/// Changes, inserts, removes or repeats bytes, or cuts off the end, up to four times and without
/// regard to the meaning.
pub(crate) fn scrambled(bytes: &mut Vec<u8>, random: &mut Rng) {
    for _ in 0..random.usize(1..5) {
        let at = random.usize(..=bytes.len());
        match random.u8(0..5) {
            0 => bytes.insert(at, random.u8(..)),
            1 => bytes.truncate(at),
            2 => {
                let count = (bytes.len() - at).min(random.usize(0..40));
                let again = bytes[at..at + count].to_vec();
                bytes.splice(at..at, again);
            }
            _ if at == bytes.len() => {}
            3 => drop(bytes.remove(at)),
            _ => bytes[at] ^= 1 << random.u8(0..8),
        }
    }
}

/// A notation after up to three changes: another notation is appended, a sign is inserted, the
/// whole is repeated, or a number or a word is changed or replaced.
pub(crate) fn notation(random: &mut Rng) -> String {
    let seed = |random: &mut Rng| random.choice(corpus::NOTATIONS).copied().unwrap_or_default();
    let mut text = seed(random).to_owned();
    for _ in 0..random.usize(0..4) {
        match random.u8(0..6) {
            0 => text.push_str(seed(random)),
            1 => {
                let at = random.usize(..=text.len());
                if text.is_char_boundary(at) {
                    let sign = ["(", ")", "/", "*", "+", "-", " ", "\u{1}", "ß", "1/1*"];
                    text.insert_str(at, sign[random.usize(..sign.len())]);
                }
            }
            2 => text = text.repeat(random.usize(0..40)),
            _ => text = with_token(&text, random),
        }
    }
    text
}
