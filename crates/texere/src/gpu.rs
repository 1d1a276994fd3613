//! Devices of OpenCL and `wgpu`, and meshes on them that a program draws itself (features `opencl`,
//! `wgpu`).
//!
//! | to | use |
//! |---|---|
//! | make meshes on a program's own device | `WgpuBackend::from_device` |
//! | draw a mesh that lies on the device | `draw`, with `VERTEX_LAYOUT` and `ATTRIBUTE_LAYOUT` for the pipeline |
//! | unpack vertices of 12 bytes in a shader | `UNPACK`, with `PACKED_LAYOUT` for the pipeline |
//! | use the buffers of a mesh | `OpenClSession`, `WgpuSession`, `DeviceMesh` |
//! | use the tables from which shaders make a chunk | `ChunkTables` |

#[cfg(feature = "opencl")]
pub use texere_opencl::{DeviceMesh, OpenClBackend, OpenClEngine, OpenClSession};
#[cfg(feature = "wgpu")]
pub use texere_wgpu::{
    ATTRIBUTE_LAYOUT, ChunkTables, LONG_ATOMICS, PACKED_LAYOUT, UNPACK, VERTEX_LAYOUT, WgpuBackend,
    WgpuEngine, WgpuSession, draw, wgpu,
};
