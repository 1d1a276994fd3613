//! What is said of cloth that has settled: one word, by one threshold.

use std::fmt;

use texere_contact::{CLEAR, Clearance};
use texere_core::settling::Length;

use crate::{Finished, Settled, WovenRest};

/// How yarns may be off the length that they are to have, as a share: what settling asks for.
const LENGTH: f32 = 0.01;

/// Whether cloth that has settled is what was asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Verdict {
    /// No surface as drawn is nearer to another than [`CLEAR`], none folds, and all keep their
    /// lengths and their linking.
    AtRest,
    /// Yarns of a knit have no room: no form of settling has made them clear.
    Jammed,
    /// Something of that is not so.
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
    /// What is said of it: in the command line, in the window, and by [`Finished::is_at_rest`].
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        match self {
            Self::Knit(settled) => settled.verdict(),
            Self::Woven(rest) => rest.verdict(),
        }
    }

    /// Whether it is at rest: no surface pierces another ([`CLEAR`](texere_contact::CLEAR)) or
    /// folds, and yarns of a knit keep their lengths and their linking. Then `check` finds neither,
    /// too.
    #[must_use]
    pub fn is_at_rest(&self) -> bool {
        self.verdict() == Verdict::AtRest
    }
}

impl Settled {
    /// What is said of it, by its surfaces as they are drawn.
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

impl WovenRest {
    /// What is said of it, by its surfaces as they are drawn. Threads that still move by a little
    /// may be at rest.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        if is_clear(self.clearance[1], self.bend) { Verdict::AtRest } else { Verdict::NotAtRest }
    }
}

/// Whether surfaces of this clearance do not pierce, and of this bend do not fold.
fn is_clear(clearance: f64, bend: f64) -> bool {
    clearance >= CLEAR && bend >= 1.0
}
