//! Drafts of looms, as weaving programs save them: WIF, and the files of Fiberworks PCW and of
//! WeavePoint.
//!
//! Each kind has a reader of its own. It finds the threading, the tie-up with the treadling or the
//! lift plan, and what the file says of each thread. From there on all kinds go one way: [`Plans`]
//! makes the drawdown, and [`DraftThreads`] makes the cloth.

mod kind;
mod limits;
mod loom_draft;
mod plans;
mod text;
mod threads;

pub(super) use kind::DraftKind;
pub(super) use limits::THREADS_MAX;
pub(crate) use limits::{FILE_MAX, LENGTH_MM};
pub(super) use loom_draft::LoomDraft;
pub(super) use plans::Plans;
pub(super) use text::{decode, lines};
pub(super) use threads::{ALIKE, DraftThreads, ThreadSet, color, mean};
