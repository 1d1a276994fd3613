//! Reads the notation of weaves. [`super::Weave`] has its grammar.

use super::library::{CREPE, HONEYCOMB, Reversal, drawn};
use crate::{WovenError, hyphen_look_alike, slash_look_alike};

/// The most ends, and the most picks, in the repeat of a weave.
///
/// Notation is for weaves that weavers name. A weave with a larger repeat is given by a picture.
pub(super) const REPEAT_MAX: usize = 4096;

/// A weave as it is written.
#[derive(Clone)]
pub(super) enum Notation {
    /// A row of ends, `base`. Each pick moves the row `step` ends further to the right. `step` is
    /// less than the length of the row. After `picks` picks the row has come back to its first
    /// place.
    Shifted { base: Vec<bool>, step: usize, picks: usize },
    /// A column of picks, `base`. The first `left` ends have the column as it is, and the next
    /// `right` ends have it inverted.
    Matt { base: Vec<bool>, left: usize, right: usize },
    /// A twill of move 1 whose line goes one way for `way` ends, and then back.
    Reversed { base: Vec<bool>, reversal: Reversal, way: usize },
    /// The end that each pick binds, counted from 0. In the pick this end alone is down or, if the
    /// weave is not `warp_faced`, up.
    Bound { order: Vec<usize>, warp_faced: bool },
    /// A drawing with the last pick on top.
    Drawn(&'static [&'static str; 8]),
}

impl Notation {
    /// Ends and picks of the repeat.
    pub(super) const fn repeat(&self) -> (usize, usize) {
        match self {
            Self::Shifted { base, picks, .. } => (base.len(), *picks),
            Self::Matt { base, left, right } => (*left + *right, base.len()),
            Self::Reversed { base, reversal, way } => (reversal.ends(*way), base.len()),
            Self::Bound { order, .. } => (order.len(), order.len()),
            Self::Drawn(drawing) => (drawing.len(), drawing.len()),
        }
    }

    /// Whether the warp is up where `end` and `pick` of the repeat cross.
    pub(super) fn up(&self, end: usize, pick: usize) -> bool {
        match self {
            Self::Shifted { base, step, .. } => base[(end + (base.len() - step) * pick) % base.len()],
            Self::Matt { base, left, .. } => base[pick] == (end < *left),
            Self::Reversed { base, reversal, way } => {
                let repeat = base.len();
                base[(reversal.origin(end, *way, repeat) + repeat - pick) % repeat]
            }
            Self::Bound { order, warp_faced } => (order[pick] == end) != *warp_faced,
            Self::Drawn(drawing) => drawn(*drawing, end, pick),
        }
    }
}

/// The most characters of a text that an error shows, more than any sensible notation has.
const SHOWN: usize = 60;

/// What is expected where a number may stand.
const NUMBER: &str = "a number from 1 to 4096";

const _: () = assert!(REPEAT_MAX == 4096);

/// What is expected where the picks of a satin name the ends that they bind.
const ORDER: &str = "each end of the satin once, in the order in which picks bind them: satin 6(1 3 5 2 6 4)";

/// What is expected behind the name of a satin.
const ENDS: &str = "the number of its ends: satin 8";
/// What is expected behind the name of a matt weave.
const THREADS: &str = "how many threads lie together: matt 2, or matt 3/2";
/// What is expected behind the name of a twill, or behind its hand.
const FLOATS: &str = "its floats, up and down in turn: twill 2/2";

/// The names of weaves, each with its other names.
const NAMES: [(&str, &[&str]); 11] = [
    ("plain", &["tabby"]),
    ("twill", &[]),
    ("satin", &[]),
    ("sateen", &[]),
    ("matt", &[]),
    ("hopsack", &["panama"]),
    ("basket", &[]),
    ("herringbone", &[]),
    ("pointed", &["point"]),
    ("honeycomb", &["waffle"]),
    ("crepe", &["crape", "oatmeal"]),
];

/// Names of cloths that no drawdown describes, each with what is expected instead.
const NOT_DRAWN: [(&[&str], &str); 2] = [
    (
        &["velvet", "velveteen", "corduroy", "plush", "terry"],
        "a weave whose threads all lie in the cloth (pile is not made)",
    ),
    (&["leno", "gauze"], "a weave whose ends do not cross one another (leno is not made)"),
];

pub(super) fn parse(text: &str) -> Result<Notation, WovenError> {
    let mut cursor = Cursor { text, rest: text };
    let name = text.split_whitespace().next().unwrap_or_default();
    let named = |(names, _): &&(&[&str], _)| names.iter().any(|known| known.eq_ignore_ascii_case(name));
    if let Some((_, expected)) = NOT_DRAWN.iter().find(named) {
        return Err(cursor.fail(expected));
    }
    let notation = match cursor.name()? {
        Some("plain") => Notation::Shifted { base: vec![true, false], step: 1, picks: 2 },
        Some("satin") => satin(&mut cursor, true)?,
        Some("sateen") => satin(&mut cursor, false)?,
        Some("matt" | "hopsack" | "basket") => matt(&mut cursor)?,
        Some("herringbone") => reversed(&mut cursor, Reversal::Cut)?,
        Some("pointed") => reversed(&mut cursor, Reversal::Point)?,
        Some("honeycomb") => Notation::Drawn(&HONEYCOMB),
        Some("crepe") => Notation::Drawn(&CREPE),
        _ => floats(&mut cursor)?,
    };
    if cursor.rest.trim_start().is_empty() { Ok(notation) } else { Err(cursor.fail("the end")) }
}

/// Reads what follows the name of a satin: its number of ends, and then its move, the order of its
/// binding points, or nothing.
fn satin(cursor: &mut Cursor<'_>, warp_faced: bool) -> Result<Notation, WovenError> {
    cursor.need(ENDS)?;
    let position = cursor.position();
    let ends = cursor.number(NUMBER)?;
    if let Some(order) = order(cursor, ends)? {
        return Ok(Notation::Bound { order, warp_faced });
    }
    let legal =
        |step: usize| (2..ends.saturating_sub(1)).contains(&step) && greatest_divisor(step, ends) == 1;
    let Some(smallest) = (2..ends).find(|&step| legal(step)) else {
        return Err(WovenError::NoSatin { text: cursor.shown(), position, ends });
    };
    let step = if cursor.sign('(') {
        let position = cursor.position();
        let written = cursor.step()?;
        let step = written.rem_euclid(ends as i64) as usize;
        if !legal(step) {
            return Err(WovenError::SatinMove { text: cursor.shown(), position, step: written, ends });
        }
        cursor.close()?;
        step
    } else {
        smallest
    };
    // In the first pick of a warp-faced satin all ends but the last are up. In the first pick of a
    // weft-faced satin all ends but the first are down.
    let base = (0..ends).map(|end| if warp_faced { end + 1 < ends } else { end == 0 }).collect();
    Ok(Notation::Shifted { base, step, picks: ends })
}

/// The ends that the picks of a satin bind, counted from 0. None if the number of ends is followed
/// by a move or by nothing.
fn order(cursor: &mut Cursor<'_>, ends: usize) -> Result<Option<Vec<usize>>, WovenError> {
    let before = cursor.rest;
    let (mut order, mut bound) = (Vec::new(), vec![false; ends]);
    if cursor.sign('(') && cursor.rest.trim_start().starts_with(|c: char| c.is_ascii_digit()) {
        while !cursor.sign(')') {
            let here = cursor.rest;
            let end = cursor.number(ORDER)?;
            let is_new = bound.get_mut(end - 1).is_some_and(|bound| !std::mem::replace(bound, true));
            // A single number is a move, which may be beyond the ends.
            let is_move = order.is_empty() && cursor.rest.trim_start().starts_with(')');
            if !is_new && !is_move {
                cursor.rest = here;
                return Err(cursor.fail(ORDER));
            }
            order.push(end - 1);
            cursor.sign(',');
        }
        if order.len() > 1 {
            return if order.len() == ends { Ok(Some(order)) } else { Err(cursor.fail(ORDER)) };
        }
    }
    cursor.rest = before;
    Ok(None)
}

/// Reads what follows the name of a matt weave, whose floats are as long along the picks as along
/// the ends.
fn matt(cursor: &mut Cursor<'_>) -> Result<Notation, WovenError> {
    cursor.need(THREADS)?;
    let left = cursor.number(NUMBER)?;
    let right = if cursor.sign('/') { cursor.number(NUMBER)? } else { left };
    let mut base = vec![true; left];
    base.resize(left + right, false);
    Ok(Notation::Matt { base, left, right })
}

/// Reads what follows the name of a reversed twill: its floats, and the number of ends after which
/// its line reverses.
fn reversed(cursor: &mut Cursor<'_>, reversal: Reversal) -> Result<Notation, WovenError> {
    let [all, ends, more] = match reversal {
        Reversal::Cut => [
            "the floats of a twill and, in brackets, after how many ends it reverses: herringbone 2/2(8)",
            "in brackets, after how many ends the twill reverses: herringbone 2/2(8)",
            "a number of at least half the ends of the twill's repeat",
        ],
        Reversal::Point => [
            "the floats of a twill and, in brackets, after how many ends it reverses: pointed 2/2(8)",
            "in brackets, after how many ends the twill reverses: pointed 2/2(8)",
            "a number of at least the ends of the twill's repeat",
        ],
    };
    cursor.need(all)?;
    let base = row(cursor)?;
    if !cursor.sign('(') {
        return Err(cursor.fail(ends));
    }
    let before = cursor.rest;
    let way = cursor.number(NUMBER)?;
    if way < reversal.least(base.len()) {
        cursor.rest = before;
        return Err(cursor.fail(more));
    }
    cursor.close()?;
    Ok(Notation::Reversed { base, reversal, way })
}

/// Reads a twill or a matt weave that is written by its floats. The hand of a twill may stand
/// before its floats or behind them.
fn floats(cursor: &mut Cursor<'_>) -> Result<Notation, WovenError> {
    let before = cursor.hand();
    cursor.word("twill");
    cursor.need(FLOATS)?;
    let base = row(cursor)?;
    let (mut position, mut written) = (cursor.position(), 1);
    let has_move = cursor.sign('(');
    if has_move {
        position = cursor.position();
        written = cursor.step()?;
        if before.is_none() && written > 0 && cursor.sign('+') {
            let (left, right) = (written as usize, cursor.number(NUMBER)?);
            cursor.close()?;
            return Ok(Notation::Matt { base, left, right });
        }
        cursor.close()?;
    }
    let behind = cursor.rest;
    let hand = if before.is_some() { before } else { cursor.hand() };
    if hand == Some(1) && written < 0 {
        cursor.rest = behind;
        return Err(cursor.fail("a left-hand twill: its move is negative"));
    }
    twill(cursor, position, base, hand.map_or(written, |hand| hand * written.abs()))
}

/// Reads floats, up and down in turn. The result has a value for each thread, true for up.
fn row(cursor: &mut Cursor<'_>) -> Result<Vec<bool>, WovenError> {
    let mut base = Vec::new();
    let mut up = cursor.number(NUMBER)?;
    loop {
        if !cursor.sign('/') {
            return Err(cursor.fail("\"/\""));
        }
        let down = cursor.number(NUMBER)?;
        let ends = base.len() + up + down;
        if ends > REPEAT_MAX {
            return Err(WovenError::Repeat { ends, picks: ends, limit: REPEAT_MAX });
        }
        base.resize(base.len() + up, true);
        base.resize(ends, false);
        if !cursor.sign('*') {
            return Ok(base);
        }
        up = cursor.number(NUMBER)?;
    }
}

/// A twill with the move `written`, which was read at `position`.
fn twill(
    cursor: &Cursor<'_>,
    position: usize,
    base: Vec<bool>,
    written: i64,
) -> Result<Notation, WovenError> {
    let ends = base.len();
    let step = written.rem_euclid(ends as i64) as usize;
    // From pick to pick, an end takes the values of `base` at all places that are a multiple of
    // `apart` away from its own, and at no others.
    let apart = greatest_divisor(step, ends);
    for end in 0..apart {
        if base.iter().skip(end).step_by(apart).all(|&up| up == base[end]) {
            return Err(WovenError::TwillMove {
                text: cursor.shown(),
                position,
                step: written,
                end: end + 1,
            });
        }
    }
    Ok(Notation::Shifted { base, step, picks: ends / apart })
}

/// The name of a weave that is spelt most like a word. None if no name is near: the number of
/// letters to change, add, remove or swap may be at most a third of the name's letters plus one,
/// and must be less than the number of the word's letters.
fn nearest(word: &str) -> Option<&'static str> {
    let word: String = word.chars().take(20).flat_map(char::to_lowercase).collect();
    let names = NAMES.iter().flat_map(|(name, others)| others.iter().chain([name]));
    let far = names.map(|name| (strsim::damerau_levenshtein(&word, name), *name));
    far.filter(|(far, name)| *far <= name.len() / 3 + 1 && *far < word.chars().count())
        .min()
        .map(|(_, name)| name)
}

/// The greatest common divisor of `a` and `b`. The divisor of 0 and `b` is `b`.
fn greatest_divisor(mut a: usize, mut b: usize) -> usize {
    while a != 0 {
        (a, b) = (b % a, a);
    }
    b
}

/// A text, and the rest of it that is still to be read. Methods that read skip spaces first.
struct Cursor<'a> {
    text: &'a str,
    rest: &'a str,
}

impl Cursor<'_> {
    /// Reads `word`, in small or capital letters, if it stands here as a word of its own.
    fn word(&mut self, word: &str) -> bool {
        self.rest = self.rest.trim_start();
        let Some((head, rest)) = self.rest.split_at_checked(word.len()) else { return false };
        let found = head.eq_ignore_ascii_case(word) && !rest.starts_with(char::is_alphabetic);
        if found {
            self.rest = rest;
        }
        found
    }

    /// Reads the name of a weave, and returns the weave's first name. None if floats stand here, or
    /// the hand of a twill.
    fn name(&mut self) -> Result<Option<&'static str>, WovenError> {
        let before = self.rest;
        if self.hand().is_some() {
            self.rest = before;
            return Ok(None);
        }
        let known = NAMES
            .iter()
            .find(|(name, others)| self.word(name) || others.iter().any(|other| self.word(other)));
        if known.is_some() || self.rest.starts_with(|c: char| c.is_ascii_digit()) {
            return Ok(known.map(|(name, _)| *name));
        }
        if hyphen_look_alike(self.next()).or(slash_look_alike(self.next())).is_some() {
            return Err(self.fail(NUMBER));
        }
        let written = self.rest.split(|c: char| !c.is_alphabetic()).next().unwrap_or_default();
        Err(WovenError::NoWeave { text: self.shown(), position: self.position(), near: nearest(written) })
    }

    /// Reads the hand of a twill: 1 for a right-hand (Z) twill, -1 for a left-hand (S) twill.
    fn hand(&mut self) -> Option<i64> {
        let hands = [("left-hand", -1), ("left", -1), ("s", -1), ("right-hand", 1), ("right", 1), ("z", 1)];
        hands.into_iter().find(|(word, _)| self.word(word)).map(|(_, hand)| hand)
    }

    /// Reads the character `sign`, if it stands here.
    fn sign(&mut self, sign: char) -> bool {
        self.rest = self.rest.trim_start();
        let rest = self.rest.strip_prefix(sign);
        self.rest = rest.unwrap_or(self.rest);
        rest.is_some()
    }

    /// Returns an error if the text ends here.
    fn need(&self, expected: &'static str) -> Result<(), WovenError> {
        if self.next().is_empty() { Err(self.fail(expected)) } else { Ok(()) }
    }

    fn close(&mut self) -> Result<(), WovenError> {
        if self.sign(')') { Ok(()) } else { Err(self.fail("\")\"")) }
    }

    /// Reads a number from 1 to [`REPEAT_MAX`].
    fn number(&mut self, expected: &'static str) -> Result<usize, WovenError> {
        self.rest = self.rest.trim_start();
        let digits = self.rest.len() - self.rest.trim_start_matches(|c: char| c.is_ascii_digit()).len();
        let split = self.rest.split_at_checked(digits);
        match split.and_then(|(number, rest)| Some((number.parse().ok()?, rest))) {
            Some((number, rest)) if (1..=REPEAT_MAX).contains(&number) => {
                self.rest = rest;
                Ok(number)
            }
            _ => Err(self.fail(expected)),
        }
    }

    /// Reads the move of a twill or a satin.
    fn step(&mut self) -> Result<i64, WovenError> {
        let negative = self.sign('-');
        let number = self.number(NUMBER)? as i64;
        Ok(if negative { -number } else { number })
    }

    /// Number of the next character, counted from 1.
    fn position(&self) -> usize {
        self.text.chars().count() - self.rest.trim_start().chars().count() + 1
    }

    /// The text as errors show it: on one line, and cut if it is long.
    fn shown(&self) -> String {
        let mut shown = String::new();
        for (place, character) in self.text.chars().enumerate() {
            if place == SHOWN {
                shown.push('…');
                break;
            }
            shown.push(if character.is_control() { ' ' } else { character });
        }
        shown
    }

    /// The next character that is no space; empty at the end.
    fn next(&self) -> &str {
        let next = self.rest.trim_start();
        &next[..next.chars().next().map_or(0, char::len_utf8)]
    }

    fn fail(&self, expected: &'static str) -> WovenError {
        if let Some(sign) = hyphen_look_alike(self.next()) {
            return WovenError::Hyphen { text: self.shown(), position: self.position(), sign };
        }
        if let Some(sign) = slash_look_alike(self.next()) {
            return WovenError::Slash { text: self.shown(), position: self.position(), sign };
        }
        WovenError::Notation { text: self.shown(), position: self.position(), expected }
    }
}
