//! The wgpu backend of texere: Vulkan, Metal and Direct3D 12.
//!
//! ```no_run
//! use texere_core::{ControlPoint, Pipeline, Yarn, Yarns};
//! use texere_wgpu::{Schedule, WgpuBackend};
//! let mut yarns = Yarns::builder();
//! yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, x * x, 0.0, 0.1)));
//! let yarns = yarns.build()?;
//! let device = WgpuBackend::open(0, Schedule::PerRing)?;
//! let mesh = Pipeline::new(&yarns).mesh(&device)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A viewer with a wgpu device of its own gives it to [`WgpuBackend::from_device`], and draws from
//! the very buffers that the mesh was written to. [`draw`](fn@draw) draws a
//! [`LiveMesh`](texere_core::backend::LiveMesh), which keeps all of its mesh; a
//! [`WgpuSession`](WgpuBackend::lending_session) lends buffers chunk by chunk.
//!
//! Some properties of wgpu affect its users:
//!
//! - wgpu clears a new buffer before its first use. The first chunks of a session therefore take
//!   longer than later ones, which use the same memory again.
//! - wgpu does not report a device's memory, so chunks are cut to what one binding may hold. If
//!   that is more than the memory, set stricter limits with [`WgpuBackend::with_limits`].
//! - A software device such as llvmpipe silently ends a lane that loops for a long time. On such a
//!   device [`Schedule::PerYarn`] gives a long yarn to several lanes.
//! - Shaders run without bounds checks. Their indices come from a plan and its chunks, and a
//!   session refuses the chunks of any other plan.

mod answer;
mod attributes;
mod backend;
mod buffer;
mod chunk_memory;
mod clock;
mod crossings;
mod device;
mod draw;
mod engine;
mod gpu;
mod kernel;
mod kernels;
mod mapped;
mod opened;
mod packed;
mod parameters;
mod per_ring;
mod per_yarn;
mod readback;
mod room;
mod session;
mod settling;
mod tables;
mod upload;

pub use backend::WgpuBackend;
pub use device::{LAUNCH_BLOCKS, LONG_ATOMICS};
pub use draw::{ATTRIBUTE_LAYOUT, PACKED_LAYOUT, VERTEX_LAYOUT, draw};
pub use engine::WgpuEngine;
pub use parameters::{PARAMETERS, with_parameters};
pub use session::{ChunkTables, WgpuSession};
pub use texere_core::backend::Schedule;
pub use texere_shaders::UNPACK;
/// The crate wgpu of these devices and buffers, version 30. A program that gives texere its device
/// must use this version. A new major version of wgpu makes a new minor version of texere.
pub use wgpu;
