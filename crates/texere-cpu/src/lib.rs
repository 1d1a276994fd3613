//! The CPU backends of texere.
//!
//! [`SerialBackend`] is a plain form of algorithms 1 and 3 of the paper "GPU-based yarn-level
//! parallel computing framework". Every other backend is compared with it. [`ParallelBackend`]
//! spreads short ranges of rings over all cores, inside a yarn as well as across yarns. It gives
//! the same bits as the serial backend. A [`Picker`] says which triangle of the mesh a ray hits
//! first.
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

mod asked;
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
mod relaxation;
mod rolls;
mod serial;

pub use backend::{ParallelBackend, SerialBackend};
pub use pages::prefer_huge;
pub use pick::{Hit, PickError, Picker};
