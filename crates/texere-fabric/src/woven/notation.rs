//! Reads the notation of weaves; [`super::Weave`] has its grammar.

use super::library::{CREPE, HONEYCOMB, Reversal, drawn};
use crate::FabricError;

/// The most ends, and the most picks, in the repeat of a weave.
///
/// Notation is for weaves that a weaver can name; what repeats over more threads than this is a picture.
pub const REPEAT_MAX: usize = 4096;

/// A weave as it is written.
#[derive(Clone)]
pub(super) enum Notation {
    /// A row of ends, each pick moved `step` ends (0 to below its length) further to the right; `picks` until it is back.
    Shifted { base: Vec<bool>, step: usize, picks: usize },
    /// A column of picks, upright for `left` ends and upside down for `right`.
    Matt { base: Vec<bool>, left: usize, right: usize },
    /// A twill of move 1 whose line goes one way for `way` ends and back again.
    Reversed { base: Vec<bool>, reversal: Reversal, way: usize },
    /// A drawing, the last pick on top.
    Drawn(&'static [&'static str; 8]),
}

impl Notation {
    /// Ends and picks of the repeat.
    pub(super) const fn repeat(&self) -> (usize, usize) {
        match self {
            Self::Shifted { base, picks, .. } => (base.len(), *picks),
            Self::Matt { base, left, right } => (*left + *right, base.len()),
            Self::Reversed { base, reversal, way } => (reversal.ends(*way), base.len()),
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
            Self::Drawn(drawing) => drawn(*drawing, end, pick),
        }
    }
}

/// Characters of a text that an error shows: more than any sensible notation has.
const SHOWN: usize = 60;

/// What is expected where a number may stand.
const NUMBER: &str = "a number from 1 to 4096";

const _: () = assert!(REPEAT_MAX == 4096);

/// What is expected where a weave may start.
const WEAVE: &str = "the name of a weave or a number from 1 to 4096";

/// Cloths that no drawdown says, by name, and what is expected instead.
const NOT_DRAWN: [(&[&str], &str); 2] = [
    (
        &["velvet", "velveteen", "corduroy", "plush", "terry"],
        "a weave whose threads all lie in the cloth (pile is not made)",
    ),
    (&["leno", "gauze"], "a weave whose ends do not cross one another (leno is not made)"),
];

pub(super) fn parse(text: &str) -> Result<Notation, FabricError> {
    let mut cursor = Cursor { text, rest: text };
    let name = text.split_whitespace().next().unwrap_or_default();
    let named = |(names, _): &&(&[&str], _)| names.iter().any(|known| known.eq_ignore_ascii_case(name));
    if let Some((_, expected)) = NOT_DRAWN.iter().find(named) {
        return Err(cursor.fail(expected));
    }
    let notation = if cursor.word("plain") {
        Notation::Shifted { base: vec![true, false], step: 1, picks: 2 }
    } else if cursor.word("satin") {
        satin(&mut cursor, true)?
    } else if cursor.word("sateen") {
        satin(&mut cursor, false)?
    } else if cursor.word("matt") || cursor.word("hopsack") || cursor.word("basket") {
        matt(&mut cursor)?
    } else if cursor.word("herringbone") {
        reversed(&mut cursor, Reversal::Cut, "a number of at least half the ends of the twill's repeat")?
    } else if cursor.word("pointed") {
        reversed(&mut cursor, Reversal::Point, "a number of at least the ends of the twill's repeat")?
    } else if cursor.word("honeycomb") {
        Notation::Drawn(&HONEYCOMB)
    } else if cursor.word("crepe") {
        Notation::Drawn(&CREPE)
    } else if cursor.word("twill") {
        floats(&mut cursor, NUMBER)?
    } else {
        floats(&mut cursor, WEAVE)?
    };
    if cursor.rest.trim_start().is_empty() { Ok(notation) } else { Err(cursor.fail("the end")) }
}

/// A satin's number and move, after its name.
fn satin(cursor: &mut Cursor<'_>, warp_faced: bool) -> Result<Notation, FabricError> {
    let position = cursor.position();
    let ends = cursor.number(NUMBER)?;
    let legal =
        |step: usize| (2..ends.saturating_sub(1)).contains(&step) && greatest_divisor(step, ends) == 1;
    let Some(smallest) = (2..ends).find(|&step| legal(step)) else {
        return Err(FabricError::NoSatin { text: cursor.shown(), position, ends });
    };
    let step = if cursor.sign('(') {
        let position = cursor.position();
        let written = cursor.step()?;
        let step = written.rem_euclid(ends as i64) as usize;
        if !legal(step) {
            return Err(FabricError::SatinMove { text: cursor.shown(), position, step: written, ends });
        }
        cursor.close()?;
        step
    } else {
        smallest
    };
    // Warp-faced: all up but the last; weft-faced: all down but the first.
    let base = (0..ends).map(|end| if warp_faced { end + 1 < ends } else { end == 0 }).collect();
    Ok(Notation::Shifted { base, step, picks: ends })
}

/// A matt weave by its name: as many ends together as picks.
fn matt(cursor: &mut Cursor<'_>) -> Result<Notation, FabricError> {
    let left = cursor.number(NUMBER)?;
    let right = if cursor.sign('/') { cursor.number(NUMBER)? } else { left };
    let mut base = vec![true; left];
    base.resize(left + right, false);
    Ok(Notation::Matt { base, left, right })
}

/// A twill's floats and the ends after which its line reverses.
fn reversed(
    cursor: &mut Cursor<'_>,
    reversal: Reversal,
    expected: &'static str,
) -> Result<Notation, FabricError> {
    let base = row(cursor, NUMBER)?;
    if !cursor.sign('(') {
        return Err(cursor.fail("\"(\""));
    }
    let before = cursor.rest;
    let way = cursor.number(NUMBER)?;
    if way < reversal.least(base.len()) {
        cursor.rest = before;
        return Err(cursor.fail(expected));
    }
    cursor.close()?;
    Ok(Notation::Reversed { base, reversal, way })
}

/// A twill or a matt weave.
fn floats(cursor: &mut Cursor<'_>, expected: &'static str) -> Result<Notation, FabricError> {
    let base = row(cursor, expected)?;
    if !cursor.sign('(') {
        return twill(cursor, cursor.position(), base, 1);
    }
    let position = cursor.position();
    let written = cursor.step()?;
    if written > 0 && cursor.sign('+') {
        let (left, right) = (written as usize, cursor.number(NUMBER)?);
        cursor.close()?;
        return Ok(Notation::Matt { base, left, right });
    }
    cursor.close()?;
    twill(cursor, position, base, written)
}

/// Floats up and down in turn, thread by thread.
fn row(cursor: &mut Cursor<'_>, expected: &'static str) -> Result<Vec<bool>, FabricError> {
    let mut base = Vec::new();
    let mut up = cursor.number(expected)?;
    loop {
        if !cursor.sign('/') {
            return Err(cursor.fail("\"/\""));
        }
        let down = cursor.number(NUMBER)?;
        let ends = base.len() + up + down;
        if ends > REPEAT_MAX {
            return Err(FabricError::Repeat { ends, picks: ends, limit: REPEAT_MAX });
        }
        base.resize(base.len() + up, true);
        base.resize(ends, false);
        if !cursor.sign('*') {
            return Ok(base);
        }
        up = cursor.number(NUMBER)?;
    }
}

/// A twill of move `written`, which stands at `position`.
fn twill(
    cursor: &Cursor<'_>,
    position: usize,
    base: Vec<bool>,
    written: i64,
) -> Result<Notation, FabricError> {
    let ends = base.len();
    let step = written.rem_euclid(ends as i64) as usize;
    // An end meets every float that lies a multiple of this further along the row, and no other.
    let apart = greatest_divisor(step, ends);
    for end in 0..apart {
        if base.iter().skip(end).step_by(apart).all(|&up| up == base[end]) {
            return Err(FabricError::TwillMove {
                text: cursor.shown(),
                position,
                step: written,
                end: end + 1,
            });
        }
    }
    Ok(Notation::Shifted { base, step, picks: ends / apart })
}

/// The greatest common divisor; that of 0 and `b` is `b`.
fn greatest_divisor(mut a: usize, mut b: usize) -> usize {
    while a != 0 {
        (a, b) = (b % a, a);
    }
    b
}

/// What is left of a text. Every method skips spaces first.
struct Cursor<'a> {
    text: &'a str,
    rest: &'a str,
}

impl Cursor<'_> {
    /// Takes `word`, in any case.
    fn word(&mut self, word: &str) -> bool {
        self.rest = self.rest.trim_start();
        let Some((head, rest)) = self.rest.split_at_checked(word.len()) else { return false };
        let found = head.eq_ignore_ascii_case(word);
        if found {
            self.rest = rest;
        }
        found
    }

    /// Takes one character.
    fn sign(&mut self, sign: char) -> bool {
        self.rest = self.rest.trim_start();
        let rest = self.rest.strip_prefix(sign);
        self.rest = rest.unwrap_or(self.rest);
        rest.is_some()
    }

    fn close(&mut self) -> Result<(), FabricError> {
        if self.sign(')') { Ok(()) } else { Err(self.fail("\")\"")) }
    }

    /// Takes a number from 1 to [`REPEAT_MAX`].
    fn number(&mut self, expected: &'static str) -> Result<usize, FabricError> {
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

    /// Takes a move.
    fn step(&mut self) -> Result<i64, FabricError> {
        let negative = self.sign('-');
        let number = self.number(NUMBER)? as i64;
        Ok(if negative { -number } else { number })
    }

    /// Which character comes next, from 1.
    fn position(&self) -> usize {
        self.text.chars().count() - self.rest.trim_start().chars().count() + 1
    }

    /// The text as errors show it: on one line, cut where it is long.
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

    fn fail(&self, expected: &'static str) -> FabricError {
        FabricError::Notation { text: self.shown(), position: self.position(), expected }
    }
}
