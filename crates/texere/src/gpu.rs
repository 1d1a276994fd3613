//! Devices of OpenCL and `wgpu`, and meshes that a program draws itself (features `opencl`,
//! `wgpu`).
//!
//! | to | take |
//! |---|---|
//! | make meshes on a program's own device | `WgpuBackend::from_device` |
//! | draw a mesh that lies on the device | `draw`, with `VERTEX_LAYOUT`, `PACKED_LAYOUT`, `ATTRIBUTE_LAYOUT` for the pipeline |
//! | unpack vertices of 12 bytes in a shader | `UNPACK` |
//! | have the buffers of a mesh | `OpenClSession`, `WgpuSession`, `DeviceMesh` |
//! | have the tables that shaders make a chunk from | `ChunkTables` |

#[cfg(feature = "opencl")]
pub use texere_opencl::{DeviceMesh, OpenClBackend, OpenClEngine, OpenClSession};
#[cfg(feature = "wgpu")]
pub use texere_wgpu::{
    ATTRIBUTE_LAYOUT, ChunkTables, LONG_ATOMICS, PACKED_LAYOUT, UNPACK, VERTEX_LAYOUT, WgpuBackend,
    WgpuEngine, WgpuSession, draw, wgpu,
};
