//! The OpenCL backend of texere: GPUs of any maker, and CPUs through PoCL.
//!
//! It needs OpenCL 1.2 and no extension. The OpenCL library is loaded at run time, so a program
//! that links this crate builds and starts without it. [`OpenClBackend::devices`] then says what is
//! missing.
//!
//! ```
//! use texere_opencl::OpenClBackend;
//! match OpenClBackend::devices() {
//!     Ok(devices) => devices.iter().for_each(|device| println!("{}: {}", device.name, device.device)),
//!     Err(error) => println!("{error}: {:?}", std::error::Error::source(&error).map(|source| source.to_string())),
//! }
//! ```
//!
//! A program with an OpenCL queue of its own opens a backend on it with
//! [`OpenClBackend::on_queue`], and takes the mesh in device memory with
//! [`OpenClSession::device_mesh`].

mod attributes;
mod backend;
mod buffer;
mod chunk_memory;
mod clock;
mod crossings;
mod device;
mod device_mesh;
mod engine;
mod faults;
mod handles;
mod kernel;
mod kernels;
mod opened;
mod packed;
mod per_ring;
mod per_yarn;
mod pinned;
mod readback;
mod room;
mod session;
mod settling;
mod tables;
mod upload;
mod work;

pub use backend::OpenClBackend;
pub use device_mesh::DeviceMesh;
pub use engine::OpenClEngine;
pub use faults::OpenClError;
pub use session::OpenClSession;
pub use texere_core::backend::Schedule;
