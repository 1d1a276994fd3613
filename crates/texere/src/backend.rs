//! The items that a backend implements and uses, and those that drive a backend chunk by chunk.
//!
//! [docs/BACKENDS.md](https://github.com/texere/texere/blob/main/docs/BACKENDS.md) describes step by
//! step how to write a backend. The rest of the names that a backend needs are in
//! [`mesh`](crate::mesh) ([`Limits`](crate::mesh::Limits), [`MeshPiece`](crate::mesh::MeshPiece),
//! [`Attribute`](crate::mesh::Attribute), [`PackedVertex`](crate::mesh::PackedVertex)) and at the
//! root ([`Backend`](crate::Backend), [`BackendError`](crate::BackendError),
//! [`DeviceInfo`](crate::DeviceInfo)).
//!
//! ```text
//! Yarns ──> Plan ──> Session ──> Engine, chunk by chunk ──> MeshMut
//! ```
//!
//! | to | use |
//! |---|---|
//! | write a backend | [`Backend`](crate::Backend), [`Engine`], [`NullBackend`] as the smallest example |
//! | read the tables of every yarn, block and chunk | [`Plan`], [`Block`], [`Chunk`] |
//! | compute splines, frames and sections as all backends do | [`definitions`] |
//! | settle on a device | [`settling`], [`crossings`] |
//! | run a plan, with its results in the program's own memory | [`Run`] |
//! | drive a backend chunk by chunk | [`Session`], [`Slot`], [`StageTimings`] |
//! | keep a mesh on a device, and edit it without a structure | [`LiveMesh`], [`Edits`] |
//! | have new memory filled without a page fault for each 4 kB | [`prefer_huge`] |
//!
//! ```
//! use texere::Backend;
//! use texere::backend::NullBackend;
//! assert_eq!(NullBackend::default().info().name, "null");
//! ```

pub use texere_core::backend::{
    AttributeSink, BLOCK_RINGS, Block, Chunk, ChunkDraw, Chunks, Draw, Edits, Engine, LiveMesh, MeshMut,
    MeshSink, NullBackend, PackedSink, PaddedPoints, Part, Plan, RingSink, Run, ScanChunk, ScanChunks,
    Schedule, Session, SessionError, Slot, StageTimings, TablesId, Traffic, Trajectory, WINDOW_POINTS,
    WorkWatch, filled, renew_virtual_ends, room, room_for, take_over_host, zeroed,
};
pub use texere_core::{OutOfMemory, crossings, definitions, settling};
pub use texere_cpu::prefer_huge;
