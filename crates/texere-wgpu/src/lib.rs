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
//! A viewer that has a wgpu device of its own gives it to [`WgpuBackend::from_device`] and draws
//! from the very buffers that the mesh was written to: those of a
//! [`LiveMesh`](texere_core::backend::LiveMesh), which keeps all of it, with [`draw`](fn@draw), or
//! chunk by chunk those of a [`WgpuSession`](WgpuBackend::lending_session).
//!
//! What is worth knowing:
//!
//! - A fresh buffer is cleared by wgpu before its first use, so the first chunk of a session takes
//!   longer than those after it, which use its memory again.
//! - wgpu does not say how much memory a device has, so chunks are cut to what one binding may
//!   hold. Where that is more than the memory, give stricter limits: [`WgpuBackend::with_limits`].
//! - A software device such as llvmpipe silently ends a lane that loops for long. There
//!   [`Schedule::PerYarn`] gives a long yarn to several lanes.
//! - The shaders run without bounds checks. What they index by comes from a plan and the chunks
//!   that it was cut into, and a session takes no other plan's chunks.

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
pub use session::{ChunkTables, WgpuSession};
pub use texere_core::backend::Schedule;
pub use texere_shaders::UNPACK;
/// The wgpu that devices and buffers are of, version 30: a program that gives texere its device
/// makes that with this one. A new major version of it is a new minor version of texere.
pub use wgpu;
