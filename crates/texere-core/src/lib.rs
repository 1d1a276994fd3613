//! What every stage and every backend of texere shares: yarns, plans, rings, meshes, and the backend trait.
//!
//! ```text
//! Yarns ──> Plan ──> Trajectory ──> Mesh
//!           core     backend        backend
//!                    stage 1        stage 2
//! ```
//!
//! [`Yarns`] hold control points, offsets and what belongs to each yarn. A [`Plan`] works out every count and offset
//! for one choice of [`Settings`]. A [`Backend`] turns control points into [`Ring`]s and rings into a [`Mesh`];
//! [`Pipeline`] drives it. A [`YarnPlace`] is one place on a yarn. The definitions that every backend must agree on are here too: [`Segment`] (the spline),
//! [`Frame`], [`Turn`] and [`Section`].
//!
//! Lengths are in mm, angles in radians unless a name says turns. x runs along the weft or course, y along the warp or
//! wale, z out of the technical face; right-handed. Triangles are counter-clockwise seen from outside.
//!
//! This crate does no I/O, knows no GPU and holds no unsafe code.

mod arrange;
mod attribute;
mod backend;
mod boundary;
mod counted;
pub mod crossings;
mod engine;
mod frame;
mod half;
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
mod turn;
mod twist;
mod vertex;
mod yarns;

pub use arrange::Placement;
pub use attribute::{ArcLength, Attribute, corner_angle};
pub use backend::{Backend, BackendError, Capabilities, DeviceInfo, DeviceKind, Schedule};
pub use boundary::{Boundary, BoundaryError, Ends};
pub use counted::counted;
pub use crossings::{Crossings, CrossingsError, CrossingsPlan, CrossingsSettler};
pub use engine::{
    AttributeSink, Engine, MeshSink, PackedSink, RingSink, ScanChunk, ScanChunks, Slot, StageTimings,
    take_over_host,
};
pub use frame::{Basis, Frame, NO_MIRROR, VERTICAL};
pub use lean::up_between;
pub use live::{Change, LiveMesh};
pub use material::{HAIRINESS_LIMIT, Material};
pub use memory::{OutOfMemory, filled, room, room_for, zeroed};
pub use mesh::{ChunkDraw, Draw, Mesh, MeshMut, MeshPiece};
pub use null::NullBackend;
pub use packed::{PackedVertex, Quantum};
pub use padded::{PaddedPoints, neighbours, renew_virtual_ends};
pub use pipeline::{Pipeline, PipelineError, Progress};
pub use place::YarnPlace;
pub use plan::{
    BLOCK_RINGS, Block, Bounds, Cap, Chunk, Chunks, Counts, Edits, Limits, MeshPlace, Part, Plan, PlanError,
    RINGS_MAX, Settings, TablesId, WINDOW_POINTS, YARN_RINGS_MAX,
};
pub use point::{COORDINATE_LIMIT, ControlPoint, Halves, RADIUS_MAX, RADIUS_MIN};
pub use ray::Ray;
pub use ring::{Ring, Stance, Trajectory};
pub use sampling::{RingSample, SUBDIVISIONS_MAX, Sampling};
pub use section::{SIDES_MAX, SIDES_MIN, Section, SectionError, SectionPoint, triangulate};
pub use session::{Session, SessionError, Traffic};
pub use settling::{Settler, Settling, SettlingError, SettlingPlan, settle};
pub use spline::{
    ARC_EVEN, ARC_NODES, ARC_PANELS, ARC_WEIGHTS, NO_LENGTH, RADIUS_FLOOR, SLOPE_LIMIT, Sample, Segment,
    ZERO_VELOCITY, tangent_factor,
};
pub use steep::UPRIGHT_TURN;
pub use subject::Subject;
pub use topology::{End, SHARED_GAPS, Topology, index_pattern};
pub use turn::{ARCTANGENT, COSINE, SINE, TAN_EIGHTH, Turn, atan2_turns};
pub use twist::{TWIST_STEP, TWIST_SUBDIVISIONS_MAX, Undersampled};
pub use vertex::Vertex;
pub use yarns::{
    Layout, Origin, TWIST_LIMIT, Yarn, YarnError, Yarns, YarnsBuilder, check_material, check_points,
    check_tension,
};
