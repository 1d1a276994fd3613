//! Relaxation of knits: yarns and their repeat move until bending and contact have the least
//! energy.
//!
//! A relaxed knit has no gauge of its own. Its yarns resist bending, they press on one another
//! where they touch, and they keep their length. The wales and courses that result are those with
//! the least energy, so the width and the height of the repeat are unknowns beside the control
//! points:
//!
//! ```text
//! E = B/2 ∫ κ² ds  +  ∬ v(distance) ds ds'
//!     bending         contact of shells
//!
//!   + EA/2 ∫ (length / length at rest - 1)² ds  +  P/2 ∫ z² ds
//!     length                                       press
//! ```
//!
//! κ is the curvature of a centreline. v is the energy of two soft shells that overlap, each round
//! a hard core: see [`Elastic`]. P is the stiffness that [`Relaxation::press`] sets, 0 unless set.
//! Forces are in N and energies in N mm. There is no friction and no twist.
//!
//! A [`Relaxation`] is the problem, a [`RelaxationPlan`] holds its tables, and a [`Relaxer`] works
//! out energies and forces on a device. [`relax`] calls the relaxer until the forces balance.
//!
//! **Source**: the model, and the data that it is compared with, are those of Singal, Dimitriyev et
//! al., "Programming mechanics in knitted materials, stitch by stitch", Nature Communications 15,
//! 2622 (2024).

mod descent;
mod elastic;
pub(crate) mod error;
mod even;
mod mirror;
mod near;
mod node;
mod plan;
mod problem;
mod pull;
mod relaxer;
mod run;
mod samples;
mod state;
mod stiffness;

pub use elastic::Elastic;
pub use near::{RelaxationLists, RelaxationNear};
pub use plan::{RelaxationInterval, RelaxationPlan, RelaxationYarn};
pub use problem::Relaxation;
pub use pull::{Energy, RelaxationPress, RelaxationPull};
pub use relaxer::{RelaxationSeen, Relaxer};
pub use run::{Relaxed, relax, relax_grown};
pub use samples::RelaxationSamples;
pub use state::RelaxationState;
