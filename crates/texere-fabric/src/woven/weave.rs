//! The weave: one repeat, by its usual notation.

use std::fmt;
use std::str::FromStr;

use super::notation::{self, Notation, REPEAT_MAX};
use crate::{Drawdown, FabricError, WovenError};

/// One repeat of a weave, from its usual notation.
///
/// ```text
/// weave  = "plain" | "honeycomb" | "crepe"
///        | [ hand ] [ "twill" ] [ hand ] floats [ "(" move ")" ] [ hand ]
///        | floats "(" number "+" number ")"                       matt (basket, hopsack, rib)
///        | ( "matt" | "hopsack" | "basket" ) number [ "/" number ]
///        | ( "satin" | "sateen" ) number [ "(" move | order ")" ]
///        | ( "herringbone" | "pointed" ) floats "(" number ")"
/// floats = number "/" number { "*" number "/" number }            warp up "/" warp down
/// hand   = "S" | "left" | "left-hand" | "Z" | "right" | "right-hand"        once
/// move   = [ "-" ] number
/// order  = number { [ "," ] number }                              each end once
/// number = 1 to 4096
/// ```
///
/// Spaces may stand between any two parts, and case does not matter. The first pick is the bottom
/// row, the first end the left column.
///
/// - **Twill** `U/D(M)`: in the first pick U ends are up, the next D down; each pick moves that M
///   ends further to the right (1 where no move is given). A positive move is a right-hand (Z)
///   twill, a negative one left-hand (S). `U1/D1*U2/D2` strings several floats together. The hand
///   may be said in words: `2/2 S`, `twill 2/2 left`.
/// - **Matt** `U/D(L+R)`: the first L ends are up for U picks, then down for D; the next R ends the
///   other way round. `2/2(2+2)` is the common basket weave, `1/1(1+1)` plain weave. By its name a
///   matt has as many ends together as picks: `matt 2` is `2/2(2+2)`, and `hopsack 3/2` is
///   `3/2(3+2)`.
/// - **Satin** `N(M)` is warp-faced, (N-1)/1, **sateen** weft-faced, 1/(N-1). M shares no factor
///   with N and is neither 1 nor N-1; without it the smallest such move is taken. An irregular one
///   names the end that each pick binds: `satin 6(1 3 5 2 6 4)`.
/// - **Herringbone** `U/D(N)` is the twill `U/D`, right-hand for N ends and left-hand for the next
///   N. Where the line turns it is cut: the other way starts half a repeat of the twill further on,
///   so that in a balanced twill warp floats meet weft floats. `herringbone 2/2(2)` is the broken
///   twill. N is at least half the ends of the twill's repeat.
/// - **Pointed** `U/D(N)` turns at a single end instead, N ends from point to point with both of
///   them; N is at least the ends of the twill's repeat.
/// - **Honeycomb** (waffle) is the common one on eight ends and eight picks, ridges of floats round
///   a plain hollow.
/// - **Other names**: tabby is plain, waffle honeycomb, panama hopsack, point pointed, and crape
///   and oatmeal are crepe.
/// - **Crepe** is one on eight ends, made of the twill `2/2*1/1*1/1` with its ends in the order of
///   a satin.
///
/// ```
/// use texere_fabric::Weave;
/// let satin: Weave = "satin 8(3)".parse()?;
/// assert_eq!(satin.repeat(), (8, 8));
/// let error = "satin 8(2)".parse::<Weave>().unwrap_err();
/// assert!(error.to_string().contains("character 9: a satin of 8 ends can't have move 2"));
/// # Ok::<(), texere_fabric::FabricError>(())
/// ```
#[derive(Clone)]
pub struct Weave {
    repeat: Repeat,
}

/// The repeat. A notation is kept as one: the drawdown of a satin of 4,095 ends would fill two
/// megabytes, of which a small cloth needs little.
#[derive(Clone)]
enum Repeat {
    Written(Notation),
    Woven(Drawdown),
}

impl fmt::Debug for Weave {
    /// Shows the size alone, as [`Drawdown`] does.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Weave").field("repeat", &self.repeat()).finish_non_exhaustive()
    }
}

/// Weaves are equal where all crossings of their repeats are, whatever their notation.
impl PartialEq for Weave {
    fn eq(&self, other: &Self) -> bool {
        let (ends, picks) = self.repeat();
        let same = |pick| (0..ends).all(|end| self.up(end, pick) == other.up(end, pick));
        (ends, picks) == other.repeat() && (0..picks).all(same)
    }
}

impl Eq for Weave {}

impl Weave {
    /// The weave that repeats `repeat`.
    ///
    /// **Errors**: [`WovenError::Repeat`] for more than 4096 ends or picks.
    pub fn new(repeat: Drawdown) -> Result<Self, WovenError> {
        Self { repeat: Repeat::Woven(repeat) }.checked()
    }

    /// Reads the notation of a weave.
    ///
    /// **Errors**: [`WovenError::NoWeave`] for a name that no weave has, [`WovenError::Hyphen`] and
    /// [`WovenError::Slash`] for signs that only look like these, [`WovenError::Notation`] where
    /// the text departs from the grammar otherwise, [`WovenError::SatinMove`],
    /// [`WovenError::NoSatin`] and [`WovenError::TwillMove`] for what can't be woven,
    /// [`WovenError::Repeat`].
    pub fn parse(text: &str) -> Result<Self, WovenError> {
        Self { repeat: Repeat::Written(notation::parse(text)?) }.checked()
    }

    fn checked(self) -> Result<Self, WovenError> {
        let (ends, picks) = self.repeat();
        if ends > REPEAT_MAX || picks > REPEAT_MAX {
            return Err(WovenError::Repeat { ends, picks, limit: REPEAT_MAX });
        }
        Ok(self)
    }

    /// Whether the warp is up where `end` and `pick` of an endless cloth cross, both from 0.
    #[must_use]
    pub fn up(&self, end: usize, pick: usize) -> bool {
        let (ends, picks) = self.repeat();
        let (end, pick) = (end % ends, pick % picks);
        match &self.repeat {
            Repeat::Written(notation) => notation.up(end, pick),
            Repeat::Woven(drawdown) => drawdown.up(end, pick),
        }
    }

    /// Ends and picks of the repeat.
    #[must_use]
    pub const fn repeat(&self) -> (usize, usize) {
        match &self.repeat {
            Repeat::Written(notation) => notation.repeat(),
            Repeat::Woven(drawdown) => (drawdown.ends(), drawdown.picks()),
        }
    }

    /// A cloth of `ends` and `picks` in this weave.
    ///
    /// **Errors**: the errors of [`Drawdown::new`].
    pub fn drawdown(&self, ends: usize, picks: usize) -> Result<Drawdown, FabricError> {
        Drawdown::repeating(ends, picks, self.repeat(), |end, pick| self.up(end, pick))
    }
}

impl FromStr for Weave {
    type Err = WovenError;

    fn from_str(text: &str) -> Result<Self, WovenError> {
        Self::parse(text)
    }
}
