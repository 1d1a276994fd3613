//! The weave: one repeat, given by its usual notation.

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
/// Spaces may stand between any two parts, and case does not matter. In a drawing of the weave, the
/// first pick is the bottom row and the first end is the left column.
///
/// - **Twill** `U/D(M)`: in the first pick U ends are up, the next D down; each pick moves this
///   pattern M ends further to the right (1 if no move is given). A positive move makes a
///   right-hand (Z) twill, a negative move a left-hand (S) twill. `U1/D1*U2/D2` strings several
///   floats together. The hand may be given in words: `2/2 S`, `twill 2/2 left`.
/// - **Matt** `U/D(L+R)`: the first L ends are up for U picks, then down for D; the next R ends are
///   down for U picks, then up for D. `2/2(2+2)` is the common basket weave, `1/1(1+1)` plain
///   weave. A matt that is written by name has equal floats in both directions: `matt 2` is
///   `2/2(2+2)`, and `hopsack 3/2` is `3/2(3+2)`.
/// - **Satin** `N(M)` has N ends and is warp-faced: (N-1)/1. **Sateen** `N(M)` is weft-faced:
///   1/(N-1). Each pick moves the binding point M ends further to the right. M must share no factor
///   with N, and must be neither 1 nor N-1. Without M, the smallest such move is used. An irregular
///   satin names the end that each pick binds: `satin 6(1 3 5 2 6 4)`.
/// - **Herringbone** `U/D(N)` is the twill `U/D`, right-hand for N ends and left-hand for the next
///   N. Where the direction changes, the next end is taken half a repeat of the twill further on.
///   In a balanced twill, warp floats therefore lie beside weft floats. `herringbone 2/2(2)` is the
///   broken twill. N is at least half the ends of the twill's repeat.
/// - **Pointed** `U/D(N)` turns at a single end instead. From one point to the next there are N
///   ends, both points included. N is at least the number of ends of the twill's repeat.
/// - **Honeycomb** (waffle) is the usual one on eight ends and eight picks: ridges of floats round
///   a hollow of plain weave.
/// - **Other names**: tabby is another name of plain, waffle of honeycomb, panama of hopsack, point
///   of pointed, and crape and oatmeal of crepe.
/// - **Crepe** is a weave on eight ends: the twill `2/2*1/1*1/1` with its ends in the order of a
///   satin.
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

/// The repeat of a weave. A weave that was read from notation keeps the notation instead of a
/// drawdown. The drawdown of a satin of 4,095 ends would fill two megabytes, and a small cloth uses
/// little of it.
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

/// Weaves are equal if all crossings of their repeats are equal, whatever their notation.
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
    /// [`WovenError::Slash`] for characters that only look like a hyphen or a slash,
    /// [`WovenError::Notation`] if the text departs from the grammar in another way,
    /// [`WovenError::SatinMove`], [`WovenError::NoSatin`] and [`WovenError::TwillMove`] for weaves
    /// that can't be woven, and [`WovenError::Repeat`] for more than 4096 ends or picks.
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

    /// Whether the warp is up where `end` and `pick` of an endless cloth, both counted from 0,
    /// cross.
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

    /// The drawdown of a cloth of `ends` ends and `picks` picks in this weave.
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
