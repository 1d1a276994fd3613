//! The core of texere: yarns, plans, rings, meshes, and the trait that every backend implements.
//!
//! ```text
//! Yarns ──> Plan ──> Trajectory ──> Mesh
//!           core     backend        backend
//!                    stage 1        stage 2
//! ```
//!
//! [`Yarns`] hold the control points and the data of each yarn: material, section, twist. A
//! [`Plan`](backend::Plan) holds every count and offset for one choice of [`Settings`]. A
//! [`Backend`] turns control points into [`Ring`](definitions::Ring)s, and rings into a [`Mesh`]. A
//! [`Pipeline`] calls the backend.
//!
//! | module | holds |
//! |---|---|
//! | the root | types for programs: yarns, settings, pipelines, meshes, devices, errors |
//! | [`definitions`] | the geometry that all backends share: the spline, rolls, rings |
//! | [`mod@backend`] | types to write a backend with: plans, chunks, engines, sessions |
//! | [`settling`], [`crossings`], [`relaxation`] | how yarns come to rest, with the traits of a device that settles or relaxes |
//!
//! Lengths are in mm, and angles in radians unless a name says turns. x runs along the weft or
//! course, y along the warp or wale, and z out of the technical face. The axes are right-handed.
//! Triangles are counter-clockwise seen from outside.
//!
//! This crate does no I/O, knows no GPU and holds no unsafe code.

mod arrange;
mod attribute;
pub mod backend;
mod boundary;
mod counted;
pub mod crossings;
pub mod definitions;
mod device;
mod engine;
mod frame;
mod half;
mod interval;
mod layout;
mod lean;
mod live;
mod mapped;
mod material;
mod memory;
mod mesh;
mod null;
mod packed;
mod padded;
mod pipeline;
mod place;
mod plan;
mod point;
mod ray;
pub mod relaxation;
mod ring;
mod sampling;
mod section;
mod session;
pub mod settling;
mod spline;
mod stand;
mod steep;
mod subject;
mod topology;
mod traffic;
mod turn;
mod twist;
mod vertex;
mod work_watch;
mod yarns;

pub use arrange::Placement;
pub use attribute::{ArcLength, Attribute};
pub use boundary::{Boundary, BoundaryError, Ends};
pub use counted::counted;
pub use crossings::error::CrossingsError;
pub use device::{Backend, BackendError, Capabilities, DeviceInfo, DeviceKind};
pub use frame::Frame;
pub use layout::{Layout, Origin, TWIST_LIMIT, Yarn, check_tension};
pub use live::Change;
pub use material::{BENDING_LIMITS, HAIRINESS_LIMIT, Material};
pub use memory::OutOfMemory;
pub use mesh::{Mesh, MeshPiece};
pub use packed::{PackedVertex, Quantum};
pub use pipeline::{Pipeline, PipelineError, Progress};
pub use place::YarnPlace;
pub use plan::{
    Bounds, Cap, Counts, Limits, MeshPlace, PlanError, RINGS_MAX, Settings, YARN_RINGS_MAX, check_sides,
};
pub use point::{COORDINATE_LIMIT, ControlPoint, Halves, RADIUS_MAX, RADIUS_MIN};
pub use ray::Ray;
pub use relaxation::error::RelaxationError;
pub use section::{Section, SectionError, SectionPoint};
pub use settling::error::SettlingError;
pub use subject::Subject;
pub use topology::{End, Topology};
pub use twist::{TWIST_STEP, TWIST_SUBDIVISIONS_MAX, Undersampled};
pub use vertex::Vertex;
pub use yarns::{YarnError, Yarns, YarnsBuilder, check_material, check_points};
