//! The verdict on cloth that has settled.

use std::fmt;

use texere_contact::{CLEAR, Clearance};
use texere_core::settling::Length;

use crate::{Finished, RelaxedKnit, Settled, WovenRest};

/// Share by which the length of a yarn's interval may differ from the length that it should have.
/// Settling itself aims for this share. With half the value, and with twice, no test is red.
const LENGTH: f32 = 0.01;

/// Whether settled cloth is what was asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Verdict {
    /// The surfaces, as they are drawn, have no contact whose
    /// [ratio](texere_contact::Contact::ratio) is below [`CLEAR`], and none of them folds. Yarns of
    /// a knit keep their linking. If they settled by contact, they have the lengths that they
    /// should have, unless lengths are free. If they rest by their energy, the forces balance.
    AtRest,
    /// Yarns have no room. Those of a knit keep their linking, but even the passes of the block
    /// form, the second form of settling by contact, did not bring them to rest. Threads of woven
    /// cloth are as dense as their fibres allow, and still pierce one another or fold.
    Jammed,
    /// A condition of [`Verdict::AtRest`] is not met, and the yarns are not
    /// [jammed](Verdict::Jammed).
    NotAtRest,
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::AtRest => "at rest",
            Self::Jammed => "jammed, not at rest",
            Self::NotAtRest => "not at rest",
        })
    }
}

impl Finished {
    /// The verdict on the cloth. The command line, the program's window and
    /// [`Finished::is_at_rest`] all use this verdict.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        match self {
            Self::Knit(settled) => settled.verdict(),
            Self::Relaxed(relaxed) => relaxed.verdict(),
            Self::Woven(rest) => rest.verdict(),
        }
    }

    /// Whether the cloth is at rest: whether its verdict is [`Verdict::AtRest`]. The program's
    /// `check` then finds no piercing and no fold.
    #[must_use]
    pub fn is_at_rest(&self) -> bool {
        self.verdict() == Verdict::AtRest
    }
}

impl Settled {
    /// The verdict, measured on surfaces as they are drawn.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        let Clearance { min, curvature_min, crowd, .. } = &self.clearance;
        let keeps_lengths = matches!(self.length, Length::Free { .. }) || self.rest.end.length <= LENGTH;
        match crowd {
            None if self.is_linked() && keeps_lengths && is_clear(*min, *curvature_min) => Verdict::AtRest,
            _ if self.is_linked() && self.rest.block_passes > 0 => Verdict::Jammed,
            _ => Verdict::NotAtRest,
        }
    }
}

impl RelaxedKnit {
    /// The verdict: forces balance, and surfaces as they are drawn neither pierce nor fold.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        let Clearance { min, curvature_min, crowd, .. } = &self.clearance;
        let rests = self.balanced && self.is_linked();
        if rests && crowd.is_none() && is_clear(*min, *curvature_min) {
            Verdict::AtRest
        } else {
            Verdict::NotAtRest
        }
    }
}

impl WovenRest {
    /// The verdict, measured on surfaces as they are drawn. Threads may be at rest though they
    /// still move a little from pass to pass.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        match is_clear(self.clearance[1], self.bend) {
            true => Verdict::AtRest,
            false if self.solid => Verdict::Jammed,
            false => Verdict::NotAtRest,
        }
    }
}

/// Whether surfaces with this clearance do not pierce, and with this bend do not fold.
pub(crate) fn is_clear(clearance: f64, bend: f64) -> bool {
    clearance >= CLEAR && bend >= 1.0
}
