//! Objects of Vulkan and OpenCL that the library lends to a program that draws by itself.

#[cfg(vulkan)]
use ash::vk::Handle;
use texere::backend::{Chunk, Engine, Slot};
#[cfg(feature = "opencl")]
use texere::gpu::OpenClEngine;
#[cfg(vulkan)]
use texere::gpu::{WgpuEngine, wgpu, wgpu::hal::api::Vulkan};

use crate::failure::Failure;
use crate::sized::grows_after;

/// Buffers are `cl_mem`.
pub const TEXERE_NATIVE_OPENCL: u32 = 1;
/// Buffers are `VkBuffer`.
pub const TEXERE_NATIVE_VULKAN: u32 = 2;

/// The objects of OpenCL or Vulkan that a session works with, as numbers. A program casts each to
/// the type that its description names.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_native {
    /// Size of this struct, bytes. The caller sets it.
    pub struct_size: u32,
    /// TEXERE_NATIVE_OPENCL or TEXERE_NATIVE_VULKAN.
    pub kind: u32,
    /// The `VkInstance`; 0 with OpenCL.
    pub instance: u64,
    /// The `VkPhysicalDevice`; 0 with OpenCL, where the command queue knows its device.
    pub physical_device: u64,
    /// The `VkDevice` or `cl_context`.
    pub device: u64,
    /// The `VkQueue` or `cl_command_queue` that chunks are made on.
    pub queue: u64,
    /// The family of the `VkQueue`; 0 with OpenCL.
    pub queue_family: u32,
    /// Zero.
    pub reserved: u32,
}

grows_after!(texere_native, reserved);

/// A part of a buffer on a device.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default)]
pub struct texere_device_buffer {
    /// The `cl_mem` or `VkBuffer`; 0 if there are no values.
    pub buffer: u64,
    /// Where in the buffer the values begin, bytes.
    pub offset: u64,
    /// Size of all values, bytes.
    pub size: u64,
}

/// The mesh of a chunk on its device.
///
/// With OpenCL, `ready` is the `cl_event` of the last command that writes the buffers. A command of
/// the program that reads the buffers has to wait for that event.
///
/// With Vulkan, the commands that write the buffers have been submitted to the queue when the
/// buffers are lent. A command on that queue needs a memory barrier from the writes of compute
/// shaders to its own reads. Before it uses another queue, a program calls `texere_session_wait`.
/// While the program submits to the queue, no other thread may call the library with the same
/// device. The buffer of vertices may be used as a vertex buffer, a storage buffer or the source of
/// a transfer; that of indices as an index buffer, a storage buffer or the source of a transfer.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_device_mesh {
    /// Size of this struct, bytes. The caller sets it.
    pub struct_size: u32,
    /// TEXERE_NATIVE_OPENCL or TEXERE_NATIVE_VULKAN.
    pub kind: u32,
    /// The vertices, a `texere_vertex` each.
    pub vertices: texere_device_buffer,
    /// The indices, a `uint32_t` each, counted from the chunk's first vertex.
    pub indices: texere_device_buffer,
    /// The `cl_event` to wait for, valid until the session's next call; 0 with Vulkan.
    pub ready: u64,
}

grows_after!(texere_device_mesh, ready);

/// The objects of OpenCL or Vulkan that an engine works with. Fails if the engine has neither.
pub(crate) fn native(engine: &dyn Engine) -> Result<texere_native, Failure> {
    #[cfg(feature = "opencl")]
    if let Some(engine) = OpenClEngine::of(engine) {
        return Ok(texere_native {
            kind: TEXERE_NATIVE_OPENCL,
            device: engine.context().expose_provenance() as u64,
            queue: engine.queue().expose_provenance() as u64,
            ..NONE
        });
    }
    #[cfg(vulkan)]
    if let Some(engine) = WgpuEngine::of(engine) {
        // SAFETY: nothing is destroyed through the handles.
        if let Some(device) = unsafe { engine.device().as_hal::<Vulkan>() } {
            return Ok(texere_native {
                kind: TEXERE_NATIVE_VULKAN,
                instance: device.shared_instance().raw_instance().handle().as_raw(),
                physical_device: device.raw_physical_device().as_raw(),
                device: device.raw_device().handle().as_raw(),
                queue: device.raw_queue().as_raw(),
                queue_family: device.queue_family_index(),
                ..NONE
            });
        }
    }
    let _ = engine;
    Err(Failure::unsupported("the device has no buffers of OpenCL or Vulkan to lend"))
}

/// The mesh of the chunk in a slot. Fails as [`native`] does.
pub(crate) fn mesh(engine: &dyn Engine, slot: Slot, chunk: &Chunk) -> Result<texere_device_mesh, Failure> {
    let texere_native { kind, .. } = native(engine)?;
    let [vertices, indices, ready] = handles(engine, slot);
    let part = |buffer, count: u32, each: u64| match count {
        0 => texere_device_buffer::default(),
        count => texere_device_buffer { buffer, offset: 0, size: u64::from(count) * each },
    };
    Ok(texere_device_mesh {
        struct_size: size_of::<texere_device_mesh>() as u32,
        kind,
        vertices: part(vertices, chunk.vertices(), 24),
        indices: part(indices, chunk.indices(), 4),
        ready,
    })
}

/// The buffers of vertices and of indices of the chunk in a slot, and the event to wait for; each
/// is 0 if there is none.
fn handles(engine: &dyn Engine, slot: Slot) -> [u64; 3] {
    #[cfg(feature = "opencl")]
    if let Some(mesh) = OpenClEngine::of(engine).and_then(|engine| engine.device_mesh(slot)) {
        return [mesh.vertices, mesh.indices, mesh.ready].map(|object| object.expose_provenance() as u64);
    }
    #[cfg(vulkan)]
    if let Some(engine) = WgpuEngine::of(engine) {
        let [vertices, indices] = [engine.vertex_buffer(slot), engine.index_buffer(slot)].map(vulkan_buffer);
        return [vertices, indices, 0];
    }
    let _ = (engine, slot);
    [0; 3]
}

/// The `VkBuffer` of a buffer.
#[cfg(vulkan)]
fn vulkan_buffer(buffer: Option<&wgpu::Buffer>) -> u64 {
    // SAFETY: the buffer is not destroyed through its handle.
    let own = unsafe { buffer.and_then(|buffer| buffer.as_hal::<Vulkan>()) };
    // SAFETY: as above.
    own.map_or(0, |own| unsafe { own.raw_handle() }.as_raw())
}

/// No objects of any interface.
#[cfg(any(feature = "opencl", vulkan))]
const NONE: texere_native = texere_native {
    struct_size: size_of::<texere_native>() as u32,
    kind: 0,
    instance: 0,
    physical_device: 0,
    device: 0,
    queue: 0,
    queue_family: 0,
    reserved: 0,
};
