//! The types that a backend is written with.
//!
//! A [`Backend`](crate::Backend) opens an [`Engine`] for a [`Plan`], and a [`Session`] drives the
//! engine chunk by chunk.
//!
//! | part | types |
//! |---|---|
//! | tables of yarns, blocks and chunks | [`Plan`], [`Block`], [`Chunk`], [`Chunks`], [`Part`] |
//! | a plan's run on a device, chunk by chunk | [`Run`] |
//! | the driver, and its order of calls | [`Session`], [`Slot`], [`Schedule`], [`StageTimings`], [`Traffic`] |
//! | the work of one device | [`Engine`], [`ScanChunks`] |
//! | a callback that says whether to go on | [`WorkWatch`] |
//! | callbacks and slices that receive results | [`MeshMut`], [`MeshSink`], [`PackedSink`], [`AttributeSink`], [`RingSink`] |
//! | a mesh that stays on the device | [`LiveMesh`], [`Edits`], [`Draw`] |
//! | allocations that may fail | [`zeroed`], [`filled`], [`room`], [`room_for`] |
//! | points with virtual ends | [`PaddedPoints`], [`renew_virtual_ends`] |
//!
//! [`NullBackend`] is the smallest backend: it makes nothing.

pub use crate::device::Schedule;
pub use crate::engine::{
    AttributeSink, Engine, MeshSink, PackedSink, RingSink, ScanChunk, ScanChunks, Slot, StageTimings,
    take_over_host,
};
pub use crate::layout::Edits;
pub use crate::live::LiveMesh;
pub use crate::memory::{filled, room, room_for, zeroed};
pub use crate::mesh::{ChunkDraw, Draw, MeshMut};
pub use crate::null::NullBackend;
pub use crate::padded::{PaddedPoints, renew_virtual_ends};
pub use crate::pipeline::Run;
pub use crate::plan::{BLOCK_RINGS, Block, Chunk, Chunks, Part, Plan, TablesId, WINDOW_POINTS};
pub use crate::ring::Trajectory;
pub use crate::session::{Session, SessionError};
pub use crate::traffic::Traffic;
pub use crate::work_watch::WorkWatch;
