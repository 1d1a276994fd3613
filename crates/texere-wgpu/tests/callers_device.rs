//! The conformance suite's pairwise cases on a caller's device, which is opened without any
//! feature, as a viewer might open it.

use std::process::ExitCode;
use std::sync::Arc;

use texere_conformance::{Entry, cases, run};
use texere_core::{Backend, BackendError};
use texere_wgpu::{Schedule, WgpuBackend};

fn main() -> ExitCode {
    run(std::env::args_os(), &[Entry::near("wgpu", || vec![open()]).with_cases(cases::pairwise)], "wgpu")
}

fn open() -> Result<Arc<dyn Backend>, BackendError> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends: wgpu::Backends::PRIMARY,
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    let adapter =
        pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default())).map_err(
            |source| BackendError::Driver { call: "Instance::request_adapter", source: source.into() },
        )?;
    let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor::default()))
        .map_err(|source| BackendError::Driver { call: "Adapter::request_device", source: source.into() })?;
    Ok(Arc::new(WgpuBackend::from_device(device, queue, Schedule::PerRing)?))
}
