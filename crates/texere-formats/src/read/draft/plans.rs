//! From a file's plans to the draft and its drawdown.

use std::path::Path;

use texere_fabric::{Draft, Drawdown, Shedding};

use crate::read::ReadError;

/// The plans of a draft: which shafts carry each end, and how picks lift them.
#[derive(Debug)]
pub(crate) struct Plans {
    pub(crate) threading: Vec<Vec<u32>>,
    /// The tie-up with the treadling, or the lift plan.
    pub(crate) shedding: Shedding,
    /// The lift plan of a file that has a tie-up and a treadling as well.
    pub(crate) other: Option<Shedding>,
    /// Whether the shafts that are tied to a treadle rise. Otherwise they sink.
    pub(crate) rising_shed: bool,
}

impl Plans {
    /// The draft and its drawdown. If the other shedding weaves another cloth, a warning says
    /// so, and the treadling is taken.
    pub(crate) fn draft(
        self,
        file: &Path,
        warnings: &mut Vec<String>,
    ) -> Result<(Draft, Drawdown), ReadError> {
        let fabric = |source| ReadError::fabric(file, source);
        let Self { threading, shedding, other, rising_shed } = self;
        let mut draft = Draft { threading, shedding, rising_shed };
        let drawdown = draft.drawdown().map_err(fabric)?;
        if let Some(other) = other {
            let stands = std::mem::replace(&mut draft.shedding, other);
            if drawdown != draft.drawdown().map_err(fabric)? {
                warnings.push("lift plan and treadling give different cloths; the treadling is taken".into());
            }
            draft.shedding = stands;
        }
        Ok((draft, drawdown))
    }
}
