//! Where shaders read their parameters: uniforms, or storage on a software device.
//!
//! Mesa's software device compiles a shader anew at each launch if a branch depends on a uniform,
//! and keeps all that it compiled until the program ends (`nothing_is_compiled_twice` of
//! texere-render). On a GPU, uniforms are read faster.

use wgpu::{BufferBindingType, BufferUsages, Device, DeviceType};

/// The usages of a buffer of parameters.
pub const PARAMETERS: BufferUsages = BufferUsages::UNIFORM.union(BufferUsages::STORAGE);

/// The most buffers that a shader of texere binds, its parameters included. Shaders of pictures
/// bind the most.
const BUFFERS_MOST: u32 = 12;

/// A WGSL shader for `device`. It is `source` itself, or on a software device `source` with
/// read-only storage in place of its uniforms. The buffers need the usages [`PARAMETERS`]. Uniforms
/// stay on a software device that binds too few storage buffers, such as one that was opened with
/// wgpu's default limits.
#[doc(hidden)]
#[must_use]
pub fn with_parameters(device: &Device, source: String) -> String {
    if reads_storage(device) { source.replace("var<uniform>", "var<storage, read>") } else { source }
}

/// How a buffer of parameters is bound on `device`.
pub(crate) fn binding(device: &Device) -> BufferBindingType {
    if reads_storage(device) {
        BufferBindingType::Storage { read_only: true }
    } else {
        BufferBindingType::Uniform
    }
}

/// Whether shaders on `device` read their parameters from storage.
fn reads_storage(device: &Device) -> bool {
    device.adapter_info().device_type == DeviceType::Cpu
        && device.limits().max_storage_buffers_per_shader_stage >= BUFFERS_MOST
}
