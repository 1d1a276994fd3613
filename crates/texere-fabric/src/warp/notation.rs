//! Reading chain notation.

use thiserror::Error;

use super::{CHAIN_COURSES, Chain, Lap, NEEDLES_MOST, SPACE_MAX};
use crate::{hyphen_look_alike, slash_look_alike};

/// The most characters of a notation.
const TEXT_MAX: usize = 1 << 16;

/// The most characters of the notation that an error shows.
const SHOWN: usize = 24;

/// An error in chain notation.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("chain, column {column}: found {found}, expected {expected}")]
pub struct ChainError {
    /// The number of the character at which the error is, counted from 1.
    pub column: usize,
    /// The text at that character.
    pub found: String,
    /// A description of what may stand at that character.
    pub expected: String,
}

impl Chain {
    /// Reads chain notation. A lap from one needle space to another is written `1-0`. `/` stands
    /// for the underlap to the next course. `//` ends the chain, and may be left out.
    ///
    /// Parentheses repeat several courses: `(1-0/1-2)x12/2-3//`. Blanks have no meaning. With
    /// `step` 1, spaces are numbered one by one. With `step` 2, as on Raschel machines, they have
    /// even numbers only: `2-0/2-4//` is `1-0/1-2//`.
    ///
    /// **Errors**: [`ChainError`] with the column for a text that is not in this notation or longer
    /// than 65536 characters, for spaces beyond [`SPACE_MAX`], laps round more than
    /// [`NEEDLES_MOST`] needles, chains of more than [`CHAIN_COURSES`] courses, and another `step`
    /// than 1 or 2.
    ///
    /// **Source**: Spencer, Knitting Technology, 3rd edition, 2001, chapter 23, for the notation.
    /// Repeats in parentheses are an addition of texere.
    ///
    /// ```
    /// use texere_fabric::warp::Chain;
    /// let atlas = Chain::parse("(1-0/1-2)x2 / 2-3 / 2-1 //", 1)?;
    /// assert_eq!(atlas.to_string(), "1-0/1-2/1-0/1-2/2-3/2-1//");
    /// assert_eq!(Chain::parse("2-0/2-4//", 2)?, Chain::parse("1-0/1-2", 1)?);
    /// let error = Chain::parse("1-0/1-x//", 1).unwrap_err();
    /// assert_eq!(error.to_string(), "chain, column 7: found \"x\", expected a needle space from 0 to 512");
    /// # Ok::<(), texere_fabric::warp::ChainError>(())
    /// ```
    pub fn parse(text: &str, step: u32) -> Result<Self, ChainError> {
        let mut reader = Reader { text: text.chars().take(TEXT_MAX + 1).collect(), at: 0, step };
        if !(1..=2).contains(&step) {
            return Err(ChainError {
                column: 1,
                found: format!("a step of {step}"),
                expected: "1, or 2 where only every second number is a space".to_owned(),
            });
        }
        if reader.text.len() > TEXT_MAX {
            reader.at = TEXT_MAX;
            return Err(reader.expected(&format!("{TEXT_MAX} characters at most")));
        }
        reader.chain()
    }
}

/// A text, and the place up to which it has been read.
struct Reader {
    text: Vec<char>,
    at: usize,
    step: u32,
}

impl Reader {
    fn chain(&mut self) -> Result<Chain, ChainError> {
        let mut laps = Vec::new();
        loop {
            self.part(&mut laps)?;
            if !self.takes('/') {
                self.ends("\"/\" or the end")?;
                break;
            }
            if self.takes('/') {
                self.ends("nothing after \"//\"")?;
                break;
            }
        }
        Chain::new(laps).ok_or_else(|| self.expected("a lap"))
    }

    /// A lap, or several in parentheses.
    fn part(&mut self, laps: &mut Vec<Lap>) -> Result<(), ChainError> {
        if !self.takes('(') {
            let lap = self.lap()?;
            laps.push(lap);
            return self.courses(laps.len(), self.at);
        }
        let first = laps.len();
        loop {
            let lap = self.lap()?;
            laps.push(lap);
            self.courses(laps.len(), self.at)?;
            if self.takes(')') {
                break;
            }
            self.must('/', "\"/\" or \")\"")?;
        }
        self.must('x', "\"x\" and how often, as in (1-0/1-2)x12")?;
        let (times, start) = self.number("how often, from 1")?;
        if times == 0 {
            return Err(self.expected_at(start, "how often, from 1"));
        }
        let group: Vec<Lap> = laps.split_off(first);
        self.courses(first.saturating_add(group.len().saturating_mul(times as usize)), start)?;
        (0..times).for_each(|_| laps.extend(&group));
        Ok(())
    }

    fn courses(&self, count: usize, start: usize) -> Result<(), ChainError> {
        if count > CHAIN_COURSES {
            return Err(self.expected_at(start, &format!("{CHAIN_COURSES} courses at most")));
        }
        Ok(())
    }

    fn lap(&mut self) -> Result<Lap, ChainError> {
        let (from, _) = self.space()?;
        self.must('-', "\"-\"")?;
        let (to, start) = self.space()?;
        let lap = Lap { from, to };
        if lap.overlap().abs() > NEEDLES_MOST {
            let step = self.step as i32;
            let near = |needles: i32| step * (from + needles).clamp(0, SPACE_MAX);
            let (low, high) = (near(-NEEDLES_MOST), near(NEEDLES_MOST));
            let expected =
                format!("a space from {low} to {high}: a lap goes round {NEEDLES_MOST} needles at most");
            return Err(self.expected_at(start, &expected));
        }
        Ok(lap)
    }

    /// A needle space, and the index of its first character.
    fn space(&mut self) -> Result<(i32, usize), ChainError> {
        let most = SPACE_MAX as u32 * self.step;
        let expected = match self.step {
            1 => format!("a needle space from 0 to {most}"),
            _ => format!("an even number from 0 to {most}"),
        };
        let (number, start) = self.number(&expected)?;
        if number > most || !number.is_multiple_of(self.step) {
            return Err(self.expected_at(start, &expected));
        }
        Ok(((number / self.step) as i32, start))
    }

    /// A number, and the index of its first digit.
    fn number(&mut self, expected: &str) -> Result<(u32, usize), ChainError> {
        self.skip();
        let start = self.at;
        let digits = self.text[start..].iter().take_while(|letter| letter.is_ascii_digit()).count();
        if digits == 0 {
            return Err(self.expected(expected));
        }
        self.at += digits;
        let number = self.text[start..self.at].iter().fold(0u32, |number, digit| {
            number.saturating_mul(10).saturating_add(digit.to_digit(10).unwrap_or(0))
        });
        Ok((number, start))
    }

    fn takes(&mut self, letter: char) -> bool {
        self.skip();
        let takes = self.text.get(self.at) == Some(&letter);
        self.at += usize::from(takes);
        takes
    }

    fn must(&mut self, letter: char, expected: &str) -> Result<(), ChainError> {
        if self.takes(letter) { Ok(()) } else { Err(self.expected(expected)) }
    }

    fn ends(&mut self, expected: &str) -> Result<(), ChainError> {
        self.skip();
        if self.at == self.text.len() { Ok(()) } else { Err(self.expected(expected)) }
    }

    fn skip(&mut self) {
        self.at += self.text[self.at..].iter().take_while(|letter| letter.is_whitespace()).count();
    }

    fn expected(&self, expected: &str) -> ChainError {
        self.expected_at(self.at, expected)
    }

    fn expected_at(&self, at: usize, expected: &str) -> ChainError {
        let rest = &self.text[at.min(self.text.len())..];
        let digits = rest.iter().take_while(|letter| letter.is_ascii_digit()).count();
        let shown: String = rest.iter().take(digits.clamp(1, SHOWN)).collect();
        let found = match (hyphen_look_alike(&shown), slash_look_alike(&shown)) {
            _ if rest.is_empty() => "the end".to_owned(),
            (Some(sign), _) => format!("{shown:?}, {sign}, not a hyphen"),
            (_, Some(sign)) => format!("{shown:?}, {sign}, not a slash"),
            _ => format!("{shown:?}"),
        };
        ChainError { column: at + 1, found, expected: expected.to_owned() }
    }
}
