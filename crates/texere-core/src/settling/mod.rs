//! Settling of yarns by their contacts. Control points move until yarns nowhere pierce one another,
//! nowhere fold, and have the lengths that [`Settling::length()`] sets.
//!
//! A [`Settling`] is the problem, a [`SettlingPlan`] holds its tables, a [`Settler`] makes the
//! passes on a device, and [`settle`] calls the settler until the yarns are at rest. All devices
//! share the definitions in this module, such as [`Interval`], [`Chord`] and [`Pull`].

mod check;
mod contact;
pub(crate) mod error;
mod interval;
mod length;
mod neighbours;
mod pass;
mod place;
mod plan;
mod problem;
mod run;
mod settler;
mod strand;

pub use contact::{Chord, MARGIN, NEAR, ONE_PLACE, PARALLEL, SHORT, SKEW, STIFF};
use error::SettlingError;
pub use interval::{GAUSS, GAUSS_WEIGHTS, Interval, bends};
pub use length::{FREE_LEAST, FREE_MOST, FREED, Length, freed};
pub use neighbours::{LEADS_ON, Listed};
pub use pass::{
    BEND, BEND_MARGIN, BEND_PARTS, BEND_RADIUS, BENDS_MIN, BLOCK_BEND, CONTACT, CONTACTS_MIN, CROSSING,
    CROSSING_SHARE, Form, Gathered, INERTIA, PRESS, Pass, Pull, SOFT_BEND, STEP_DIAMETER, STEP_NEAR, STRIDE,
    moves,
};
pub use place::{Place, Scale};
pub use plan::{SKIN, SettlingCounts, SettlingPlan, Spans};
pub use problem::Settling;
pub(crate) use run::points_of;
pub use run::{Rest, settle, settled};
pub use settler::{Settler, SettlingSeen};
pub use strand::{SettlingYarn, tag};
