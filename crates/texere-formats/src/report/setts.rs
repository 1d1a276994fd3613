//! How close the threads of woven cloth lie, compared with the greatest sett of its weave and
//! yarns.

use std::fmt;

use serde::Serialize;
use texere_fabric::{Sett, Woven};

use super::measures::Sets;

/// The share by which a sett may exceed the greatest one without a warning, because diameters are
/// rounded to `f32`.
const ROUNDING: f64 = 1e-6;

/// The setts of warp and weft.
pub(crate) fn setts(cloth: &Woven) -> Sets<SettReport> {
    cloth.setts().map(SettReport::from).into()
}

/// [`Sett`] with its share of the greatest sett. In JSON, the names of these fields are the keys.
#[derive(Debug, Serialize)]
pub(crate) struct SettReport {
    per_cm: f64,
    greatest_per_cm: f64,
    interlacings: f64,
    share: f64,
    jammed_per_cm: Option<f64>,
}

impl From<Sett> for SettReport {
    fn from(sett: Sett) -> Self {
        Self {
            per_cm: sett.per_cm,
            greatest_per_cm: sett.greatest_per_cm,
            interlacings: sett.interlacings,
            share: sett.share(),
            jammed_per_cm: sett.jammed_per_cm,
        }
    }
}

impl Sets<SettReport> {
    /// Lines of text, each with a label and a sentence.
    pub(crate) fn lines(&self) -> [(&'static str, String); 2] {
        [("sett", format!("ends {}", self.warp)), ("", format!("picks {}", self.weft))]
    }
}

impl fmt::Display for SettReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { per_cm, greatest_per_cm, share, jammed_per_cm, .. } = self;
        write!(f, "{per_cm:.2} to the cm, {greatest_per_cm:.2} is the most for round yarns in this weave")?;
        if let Some(jammed) = jammed_per_cm {
            write!(f, ", which jams at {jammed:.2}")?;
        }
        if *share <= 1.0 + ROUNDING {
            return Ok(());
        }
        // Both numbers are rounded up, so that a cloth that follows them is within the greatest
        // sett.
        let (spacing_mm, thinner) = ((1e5 / greatest_per_cm).ceil() / 1e4, (share * 1e2).ceil() / 1e2);
        write!(
            f,
            "; {:.1} % beyond the most they jam or flatten: {spacing_mm:.4} mm from one to the next, or yarns {thinner:.2} times as \
             thin, would be within it",
            (share - 1.0) * 100.0
        )
    }
}
