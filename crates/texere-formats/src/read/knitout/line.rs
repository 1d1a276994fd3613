//! A line of a knitout file, and the words of its operation.

use std::path::Path;
use std::str::SplitWhitespace;

use texere_fabric::weft::{Bed, Direction, Needle};

use super::limits::NEEDLE_MAX;
use crate::read::ReadError;
use crate::read::error::{no_hyphen, shown};

/// A line of a file.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line<'a> {
    pub(super) file: &'a Path,
    /// The number of the line, counted from 1.
    pub(super) number: usize,
    pub(super) text: &'a str,
}

impl<'a> Line<'a> {
    pub(super) const fn new(file: &'a Path, number: usize, text: &'a str) -> Self {
        Self { file, number, text }
    }

    /// The words of the operation. A comment ends the operation.
    pub(super) fn words(&self) -> Words<'a> {
        let operation = self.text.split(';').next().unwrap_or_default();
        Words { line: *self, operation, rest: operation.split_whitespace() }
    }

    /// The refusal of `word`, which is a part of this line.
    pub(super) fn refused(&self, word: &str, expected: impl Into<String>) -> ReadError {
        let before = (word.as_ptr() as usize).saturating_sub(self.text.as_ptr() as usize);
        let column = self.text.get(..before).unwrap_or_default().chars().count() + 1;
        let (file, line, value) = (self.file.into(), self.number, shown(word));
        let expected = expected.into() + &no_hyphen(word);
        ReadError::Word { file, line, column, value, expected }
    }
}

/// The words of an operation that are still to be read.
#[derive(Debug)]
pub(super) struct Words<'a> {
    line: Line<'a>,
    operation: &'a str,
    rest: SplitWhitespace<'a>,
}

impl<'a> Iterator for Words<'a> {
    type Item = &'a str;

    fn next(&mut self) -> Option<&'a str> {
        self.rest.next()
    }
}

impl<'a> Words<'a> {
    /// The next word. If there is none, the place behind the last word is refused.
    fn needed(&mut self, expected: &str) -> Result<&'a str, ReadError> {
        self.rest.next().ok_or_else(|| {
            let operation = self.operation.trim_end();
            self.line.refused(&operation[operation.len()..], expected)
        })
    }

    /// The refusal of a word.
    pub(super) fn refused(&self, word: &str, expected: impl Into<String>) -> ReadError {
        self.line.refused(word, expected)
    }

    /// Refuses words that are left.
    pub(super) fn end(mut self) -> Result<(), ReadError> {
        self.rest.next().map_or(Ok(()), |word| Err(self.line.refused(word, "the end of the operation")))
    }

    /// The direction in the next word, `+` or `-`.
    pub(super) fn direction(&mut self) -> Result<Direction, ReadError> {
        let expected = "a direction, + or -";
        match self.needed(expected)? {
            "+" => Ok(Direction::Right),
            "-" => Ok(Direction::Left),
            word => Err(self.line.refused(word, expected)),
        }
    }

    /// The needle or the slider in the next word.
    pub(super) fn needle(&mut self) -> Result<Needle, ReadError> {
        let expected = "a needle such as f1, b-2 or fs3";
        let word = self.needed(expected)?;
        let parsed = || {
            let (bed, rest) = match word.split_at_checked(1)? {
                ("f", rest) => (Bed::Front, rest),
                ("b", rest) => (Bed::Back, rest),
                _ => return None,
            };
            let number = rest.strip_prefix('s');
            Some((bed, number.is_some(), number.unwrap_or(rest).parse::<i32>().ok()?))
        };
        let (bed, slider, number) = parsed().ok_or_else(|| self.line.refused(word, expected))?;
        if !(-NEEDLE_MAX..=NEEDLE_MAX).contains(&number) {
            return Err(self.line.refused(word, format!("a needle from -{NEEDLE_MAX} to {NEEDLE_MAX}")));
        }
        Ok(Needle { bed, slider, number })
    }

    /// The number in the next word, and that word.
    pub(super) fn number(&mut self, expected: &str) -> Result<(f64, &'a str), ReadError> {
        let word = self.needed(expected)?;
        let number = word.parse().ok().filter(|number: &f64| number.abs() <= f64::from(NEEDLE_MAX));
        number.map(|number| (number, word)).ok_or_else(|| {
            self.line.refused(word, format!("{expected}: a number from -{NEEDLE_MAX} to {NEEDLE_MAX}"))
        })
    }

    /// Skips a direction and a needle. Older writers put them before the carriers of operations
    /// that bring yarns in or out. Returns whether they were there.
    pub(super) fn pass_place(&mut self) -> Result<bool, ReadError> {
        let mut ahead = self.rest.clone();
        let is_direction = |word: &str| {
            matches!(word, "+" | "-") || word.chars().count() == 1 && !no_hyphen(word).is_empty()
        };
        if !ahead.next().is_some_and(is_direction) {
            return Ok(false);
        }
        self.direction()?;
        self.needle().map(|_| true)
    }
}
