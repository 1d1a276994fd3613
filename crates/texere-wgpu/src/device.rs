//! The devices that can compute, and the limits of each.

use std::sync::OnceLock;

use texere_core::backend::Schedule;
use texere_core::{BackendError, DeviceInfo, DeviceKind, Limits};
use texere_gpu::capabilities;
use wgpu::{Backends, DeviceType, DownlevelFlags, Features, InstanceDescriptor, InstanceFlags};

/// The default limit of the blocks of a launch: some 16 million rings. Launches of this size end
/// before a driver's watchdog stops them, even on a software device.
pub const LAUNCH_BLOCKS: u64 = 1 << 18;

/// Features with which a picture finds the depth and the triangle of a sample at once. Without them
/// a picture goes through all triangles twice.
pub const LONG_ATOMICS: Features = Features::SHADER_INT64.union(Features::SHADER_INT64_ATOMIC_MIN_MAX);

/// All adapters that can compute. They are listed once, and drivers stay loaded until the process
/// ends.
///
/// NVIDIA's driver crashes if adapters are listed, or its libEGL is unloaded, in two threads at
/// once. When `tests/tests/leaning.rs` opened and dropped devices in several threads, the process
/// crashed in four of six runs.
pub(crate) fn adapters() -> &'static [wgpu::Adapter] {
    static ADAPTERS: OnceLock<(wgpu::Instance, Vec<wgpu::Adapter>)> = OnceLock::new();
    let (_, adapters) = ADAPTERS.get_or_init(|| {
        let backends = Backends::VULKAN | Backends::METAL | Backends::DX12;
        let instance = wgpu::Instance::new(InstanceDescriptor {
            backends,
            // No validation layer, not even in a debug build, unless the environment asks for it.
            flags: InstanceFlags::empty().with_env(),
            ..InstanceDescriptor::new_without_display_handle()
        });
        let mut adapters = pollster::block_on(instance.enumerate_adapters(backends));
        adapters.retain(|adapter| {
            adapter.get_downlevel_capabilities().flags.contains(DownlevelFlags::COMPUTE_SHADERS)
        });
        (instance, adapters)
    });
    adapters
}

pub(crate) fn none(wanted: String, adapters: &[wgpu::Adapter]) -> BackendError {
    let found = adapters.iter().enumerate();
    let found = found.map(|(index, adapter)| format!("wgpu:{index} ({})", adapter.get_info().name)).collect();
    BackendError::NoDevice { wanted, found }
}

pub(crate) fn describe(
    name: String,
    adapter: &wgpu::AdapterInfo,
    limits: &wgpu::Limits,
    timed_by_device: bool,
    schedule: Schedule,
) -> DeviceInfo {
    let binding_bytes = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
    DeviceInfo {
        name,
        device: adapter.name.clone(),
        driver: format!("{} {} ({})", adapter.driver, adapter.driver_info, adapter.backend),
        schedule,
        kind: match adapter.device_type {
            DeviceType::DiscreteGpu => DeviceKind::DiscreteGpu,
            DeviceType::IntegratedGpu => DeviceKind::IntegratedGpu,
            DeviceType::Cpu => DeviceKind::Cpu,
            _ => DeviceKind::Other,
        },
        // wgpu does not report the memory of a device.
        memory_bytes: None,
        limits: Limits {
            // Buffers are rounded up to multiples of 16 bytes, and must not exceed the limit
            // afterwards.
            binding_bytes: binding_bytes / 16 * 16,
            blocks: LAUNCH_BLOCKS,
            ..Limits::NONE
        },
        can: capabilities(schedule, true),
        timed_by_device,
    }
}
