//! Settling of dense woven cloth by its crossings. The drawdown says which threads meet, so no
//! search is needed. At every crossing both threads shift sideways, rise, widen and flatten until
//! an energy is least. The energy keeps threads from piercing one another.
//!
//! A [`Crossings`] is the problem, a [`CrossingsPlan`] holds its tables, a [`CrossingsSettler`]
//! makes the passes on a device, and [`settle`] calls the settler until the cloth is at rest. All
//! devices share the definitions in this module. [`CrossingsPlan::block`] gathers the energy's
//! terms at one crossing. [`CrossingsPlan::moved`] makes the crossing's step.
//! [`CrossingsPlan::ahead`] gives the state that the next pass reads of the crossing.

mod block;
mod contacts;
mod crossing;
pub(crate) mod error;
mod here;
mod level;
mod neighbours;
mod pass;
mod passage;
mod plan;
mod problem;
mod rows;
mod run;
mod settler;
mod step;
mod terms;

pub use block::{CrossingBlock, DAMPING, PIVOT};
pub use contacts::{MARGIN, NEAR, STEEPER, TOUCH};
pub use crossing::{CrossingState, Set, ThreadState};
use error::CrossingsError;
pub use level::Level;
pub use neighbours::{BESIDE_MAX, Neighbours};
pub use pass::CrossingsPass;
pub use passage::{CURVED, STEPS, StraightPassage, TURN};
pub use plan::CrossingsPlan;
pub use problem::{CrossingThread, Crossings};
pub use rows::{ASPECT, Row, SHAPE, Site};
pub use run::{CrossingsRest, settle};
pub use settler::{CrossingsSeen, CrossingsSettler};
pub use step::{HALF_HEIGHT, HALF_WIDTH, MOMENTUM, STEP, UPHILL};
pub use terms::{AREA_GAIN, AREA_LOSS, BEND, PRESS, SIDEWAYS_BEND, SIDEWAYS_TENSION, SMOOTH, SOLID, TENSION};
