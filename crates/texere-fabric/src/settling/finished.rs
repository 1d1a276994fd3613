//! A structure whose yarns have come to rest: a knit by contact or by its energy, woven cloth by
//! its crossings.

use texere_core::Yarns;

use super::Settled;
use crate::{FabricWarning, RelaxedKnit, WovenRest};

/// A fabric at rest, or as near to rest as it came: see
/// [`Structure::settle`](crate::Structure::settle).
#[derive(Debug, Clone)]
#[non_exhaustive]
#[allow(clippy::large_enum_variant, reason = "a fabric is finished once")]
pub enum Finished {
    /// A knit, or yarns that no structure made, settled by contact.
    Knit(Settled),
    /// A knit at rest by its energy.
    Relaxed(RelaxedKnit),
    /// Woven cloth, settled by its crossings.
    Woven(WovenRest),
}

impl Finished {
    /// The yarns of the fabric.
    #[must_use]
    pub const fn yarns(&self) -> &Yarns {
        match self {
            Self::Knit(settled) => &settled.yarns,
            Self::Relaxed(relaxed) => &relaxed.yarns,
            Self::Woven(rest) => &rest.yarns,
        }
    }

    /// The yarns of the fabric, without the figures of settling.
    #[must_use]
    pub fn into_yarns(self) -> Yarns {
        match self {
            Self::Knit(settled) => settled.yarns,
            Self::Relaxed(relaxed) => relaxed.yarns,
            Self::Woven(rest) => rest.yarns,
        }
    }

    /// Warnings about the fabric at rest: [`FabricWarning::PressMissed`].
    #[must_use]
    pub fn warnings(&self) -> Vec<FabricWarning> {
        let press = match self {
            Self::Knit(settled) => settled.press,
            Self::Relaxed(_) | Self::Woven(_) => None,
        };
        press.and_then(|press| press.missed()).into_iter().collect()
    }
}
