//! Settings of a mesh, its pieces, its vertices, its edits, and rays to pick yarns with.
//!
//! | to | use |
//! |---|---|
//! | choose how rings turn, and how triangles are indexed | [`Frame`], [`Topology`] |
//! | bound the memory that a device takes | [`Limits`] |
//! | know how many vertices and triangles there will be | [`Counts`] |
//! | make a mesh of only the part of the cloth in a rectangle | [`Bounds`] |
//! | read a mesh piece by piece | [`MeshPiece`], [`Progress`] |
//! | make vertices of 12 bytes | [`PackedVertex`], [`Quantum`] |
//! | know where on its yarn a vertex lies | [`Attribute`], [`ArcLength`] |
//! | know what an edit changed | [`Update`], [`Change`] |
//! | know what a ray hits | [`Ray`], [`MeshPlace`] |
//!
//! ```
//! use texere::mesh::{Frame, Topology};
//! use texere::{ControlPoint, Pipeline, Settings, Yarn, Yarns};
//! let mut yarns = Yarns::builder();
//! yarns.yarn(Yarn::default(), &[0.0, 1.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
//! let settings = Settings { frame: Frame::RotationMinimizing, topology: Topology::None, ..Settings::default() };
//! let mesh = Pipeline::new(&yarns.build()?).settings(settings).mesh(&*texere::open("cpu")?)?;
//! assert!(!mesh.vertices.is_empty() && mesh.indices.is_empty());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub use texere_core::{
    ArcLength, Attribute, Bounds, Cap, Change, Counts, End, Frame, Limits, MeshPiece, MeshPlace,
    PackedVertex, PlanError, Progress, Quantum, RINGS_MAX, Ray, TWIST_STEP, TWIST_SUBDIVISIONS_MAX, Topology,
    Undersampled, YARN_RINGS_MAX, check_sides,
};
pub use texere_cpu::PickError;

pub use crate::live::{LiveError, Update};
