//! The CPU backends of texere.
//!
//! [`SerialBackend`] is the paper's algorithms 1 and 3, written to be read: the gold reference that
//! every other backend is held against. [`ParallelBackend`] spreads short ranges of rings over all
//! cores, inside a yarn as well as across yarns, and gives the same bits. A [`Picker`] says which
//! triangle of the mesh a ray hits first.
//!
//! ```
//! use texere_core::{ControlPoint, Pipeline, Yarn, Yarns};
//! use texere_cpu::{ParallelBackend, SerialBackend};
//! let mut yarns = Yarns::builder();
//! yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, x * x, 0.0, 0.1)));
//! let yarns = yarns.build()?;
//! let gold = Pipeline::new(&yarns).mesh(&SerialBackend::new())?;
//! let mesh = Pipeline::new(&yarns).mesh(&ParallelBackend::open()?)?;
//! assert_eq!(gold.vertices, mesh.vertices);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod attributes;
mod backend;
mod caps;
mod cells;
mod crossings;
mod engine;
mod packed;
mod pages;
mod parallel;
mod pick;
mod rolls;
mod serial;

pub use backend::{ParallelBackend, SerialBackend};
pub use pick::{Hit, PickError, Picker};
