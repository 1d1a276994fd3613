//! Woven cloth: warp and weft that cross at right angles.

mod bend;
mod by_set;
mod cloth;
mod crimp;
mod crossing;
mod design;
mod draft;
mod drawdown;
mod error;
mod jam;
mod layers;
mod levels;
mod library;
mod loom;
mod notation;
mod path;
mod period;
mod pitch;
mod relief;
mod rest;
mod selvedge;
mod sett;
mod shape;
mod thread;
mod weave;
mod yarns;

pub use by_set::BySet;
pub use cloth::{POINTS_MAX, Woven};
pub use crimp::Crimp;
pub use design::WovenDesign;
pub use draft::{Draft, Shedding};
pub use drawdown::{CROSSINGS_MAX, Drawdown, THREADS_MAX};
pub use error::WovenError;
pub use loom::Loom;
pub use notation::REPEAT_MAX;
pub(crate) use period::Sample;
pub use pitch::Pitch;
pub use relief::{JamReport, Relief, Tightness};
pub use rest::{Stretch, WovenRest};
pub use sett::Sett;
pub use shape::Shape;
pub use thread::{
    FLATNESS_MAX, FLATNESS_MIN, SPACING_MAX, SPACING_MIN, STIFFNESS_MAX, STIFFNESS_MIN, Thread,
};
pub use weave::Weave;
pub use yarns::NO_CROSSING;
