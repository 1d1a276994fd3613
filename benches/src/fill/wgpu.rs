//! A fill through wgpu.

use std::time::{Duration, Instant};

use texere::BackendError;
use wgpu::{
    BufferUsages, CommandEncoderDescriptor, ComputePassDescriptor, ComputePassTimestampWrites,
    ComputePipelineDescriptor, MapMode, PollType, QueryType, ShaderModuleDescriptor, ShaderSource,
};

use super::COPY_BYTES;

/// The shader writes one vec4 in each lane. The grid has two dimensions, because one dimension has
/// at most 65,535 workgroups.
const SOURCE: &str = "
@group(0) @binding(0) var<storage, read_write> out: array<vec4<u32>>;
@compute @workgroup_size(256)
fn fill(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let at = (group.y * groups.x + group.x) * 256u + lane;
    if at < arrayLength(&out) {
        out[at] = vec4(at);
    }
}";

/// Buffers on a wgpu device, and the pipeline that fills them.
#[derive(Debug)]
pub(super) struct WgpuFill {
    device: wgpu::Device,
    queue: wgpu::Queue,
    pipeline: wgpu::ComputePipeline,
    bound: Vec<(wgpu::BindGroup, u32)>,
    filled: Vec<wgpu::Buffer>,
    /// The host's memory that copies go to.
    host: wgpu::Buffer,
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    mapped: wgpu::Buffer,
}

/// A new device, with nothing on it.
pub(super) fn context(index: usize) -> Result<(wgpu::Device, wgpu::Queue), BackendError> {
    let backends = wgpu::Backends::VULKAN | wgpu::Backends::METAL | wgpu::Backends::DX12;
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends,
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    let adapters = pollster::block_on(instance.enumerate_adapters(backends));
    let adapter = adapters
        .get(index)
        .ok_or_else(|| BackendError::NoDevice { wanted: format!("wgpu:{index}"), found: Vec::new() })?;
    pollster::block_on(
        adapter.request_device(&wgpu::DeviceDescriptor {
            required_limits: adapter.limits(),
            ..Default::default()
        }),
    )
    .map_err(|source| driver("Adapter::request_device", source))
}

impl WgpuFill {
    pub(super) fn new(device: &wgpu::Device, queue: &wgpu::Queue, bytes: &[u64]) -> Self {
        let descriptor =
            ShaderModuleDescriptor { label: Some("fill"), source: ShaderSource::Wgsl(SOURCE.into()) };
        // SAFETY: the shader checks its one bound itself, so it needs no further checks.
        let module = unsafe {
            device.create_shader_module_trusted(descriptor, wgpu::ShaderRuntimeChecks::unchecked())
        };
        let pipeline = device.create_compute_pipeline(&ComputePipelineDescriptor {
            label: Some("fill"),
            layout: None,
            module: &module,
            entry_point: None,
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        let buffer = |size, usage| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: None,
                size,
                usage,
                mapped_at_creation: false,
            })
        };
        let usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC;
        let filled: Vec<_> = bytes.iter().map(|&bytes| buffer(bytes.next_multiple_of(16), usage)).collect();
        let bound = filled.iter().map(|filled| {
            let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: None,
                layout: &pipeline.get_bind_group_layout(0),
                entries: &[wgpu::BindGroupEntry { binding: 0, resource: filled.as_entire_binding() }],
            });
            (group, filled.size().div_ceil(16 * 256) as u32)
        });
        let bound = bound.collect();
        Self {
            bound,
            filled,
            host: buffer(COPY_BYTES, BufferUsages::MAP_READ | BufferUsages::COPY_DST),
            queries: device.create_query_set(&wgpu::QuerySetDescriptor {
                label: None,
                ty: QueryType::Timestamp,
                count: 2,
            }),
            resolved: buffer(16, BufferUsages::QUERY_RESOLVE | BufferUsages::COPY_SRC),
            mapped: buffer(16, BufferUsages::MAP_READ | BufferUsages::COPY_DST),
            pipeline,
            device: device.clone(),
            queue: queue.clone(),
        }
    }
}

fn driver(call: &'static str, source: impl std::error::Error + Send + Sync + 'static) -> BackendError {
    BackendError::Driver { call, source: source.into() }
}

impl WgpuFill {
    fn wait(&self) -> Result<(), BackendError> {
        let wait = PollType::Wait { submission_index: None, timeout: Some(Duration::from_secs(60)) };
        self.device.poll(wait).map(drop).map_err(|source| driver("Device::poll", source))
    }
}

impl super::Fill for WgpuFill {
    fn run(&mut self) -> Result<Duration, BackendError> {
        let mut encoder = self.device.create_command_encoder(&CommandEncoderDescriptor::default());
        let mut pass = encoder.begin_compute_pass(&ComputePassDescriptor {
            label: None,
            timestamp_writes: Some(ComputePassTimestampWrites {
                query_set: &self.queries,
                beginning_of_pass_write_index: Some(0),
                end_of_pass_write_index: Some(1),
            }),
        });
        pass.set_pipeline(&self.pipeline);
        for (group, workgroups) in &self.bound {
            pass.set_bind_group(0, group, &[]);
            // The rows of the grid are no longer than needed, because a workgroup without work
            // takes time, too.
            let rows = workgroups.div_ceil(65_535);
            pass.dispatch_workgroups(workgroups.div_ceil(rows), rows, 1);
        }
        drop(pass);
        encoder.resolve_query_set(&self.queries, 0..2, &self.resolved, 0);
        encoder.copy_buffer_to_buffer(&self.resolved, 0, &self.mapped, 0, 16);
        self.queue.submit([encoder.finish()]);
        self.mapped.map_async(MapMode::Read, .., |_| ());
        self.wait()?;
        let view =
            self.mapped.get_mapped_range(..).map_err(|source| driver("Buffer::get_mapped_range", source))?;
        let stamps: Vec<u64> = view.chunks_exact(8).map(bytemuck::pod_read_unaligned).collect();
        drop(view);
        self.mapped.unmap();
        let ticks = stamps[1].saturating_sub(stamps[0]);
        let nanoseconds = ticks as f64 * f64::from(self.queue.get_timestamp_period());
        Ok(Duration::from_nanos(nanoseconds as u64))
    }

    fn copy_to_host(&mut self) -> Result<Duration, BackendError> {
        let start = Instant::now();
        let mut encoder = self.device.create_command_encoder(&CommandEncoderDescriptor::default());
        for buffer in &self.filled {
            for offset in (0..buffer.size()).step_by(COPY_BYTES as usize) {
                let bytes = COPY_BYTES.min(buffer.size() - offset);
                encoder.copy_buffer_to_buffer(buffer, offset, &self.host, 0, bytes);
            }
        }
        self.queue.submit([encoder.finish()]);
        self.wait()?;
        Ok(start.elapsed())
    }

    /// Returns none, because the memory that wgpu maps for writing may be the device's own.
    fn copy_from_host(&mut self) -> Result<Option<Duration>, BackendError> {
        Ok(None)
    }
}
