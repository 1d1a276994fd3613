//! A fill through wgpu.

use std::time::Duration;

use texere::BackendError;
use texere_wgpu::{Schedule, WgpuBackend};
use wgpu::{
    BufferUsages, CommandEncoderDescriptor, ComputePassDescriptor, ComputePassTimestampWrites,
    ComputePipelineDescriptor, MapMode, PollType, QueryType, ShaderModuleDescriptor, ShaderSource,
};

/// One vec4 a lane; a grid in two dimensions, since one has no more than 65,535 workgroups.
const SOURCE: &str = "
@group(0) @binding(0) var<storage, read_write> out: array<vec4<u32>>;
@compute @workgroup_size(256)
fn fill(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let at = (group.y * 65535u + group.x) * 256u + lane;
    if at < arrayLength(&out) {
        out[at] = vec4(at);
    }
}";

/// Buffers on a wgpu device, and the pipeline that fills them.
#[derive(Debug)]
pub struct WgpuFill {
    device: wgpu::Device,
    queue: wgpu::Queue,
    pipeline: wgpu::ComputePipeline,
    bound: Vec<(wgpu::BindGroup, u32)>,
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    mapped: wgpu::Buffer,
}

pub(super) fn rig(index: usize, bytes: &[u64]) -> Result<(WgpuBackend, WgpuFill), BackendError> {
    let backend = WgpuBackend::open(index, Schedule::PerRing)?;
    let fill = WgpuFill::new(backend.device(), backend.queue(), bytes);
    Ok((backend, fill))
}

impl WgpuFill {
    fn new(device: &wgpu::Device, queue: &wgpu::Queue, bytes: &[u64]) -> Self {
        let descriptor =
            ShaderModuleDescriptor { label: Some("fill"), source: ShaderSource::Wgsl(SOURCE.into()) };
        // SAFETY: the shader checks its one bound itself. Like texere's own it does without further checks.
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
        let bound = bytes.iter().map(|&bytes| {
            let filled = buffer(bytes.next_multiple_of(16), BufferUsages::STORAGE);
            let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: None,
                layout: &pipeline.get_bind_group_layout(0),
                entries: &[wgpu::BindGroupEntry { binding: 0, resource: filled.as_entire_binding() }],
            });
            (group, bytes.div_ceil(16 * 256) as u32)
        });
        let bound = bound.collect();
        Self {
            bound,
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

impl super::Fill for WgpuFill {
    fn run(&mut self) -> Result<Duration, BackendError> {
        let driver = |call: &'static str| {
            move |source: Box<dyn std::error::Error + Send + Sync>| BackendError::Driver { call, source }
        };
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
            pass.dispatch_workgroups(65_535.min(*workgroups), workgroups.div_ceil(65_535), 1);
        }
        drop(pass);
        encoder.resolve_query_set(&self.queries, 0..2, &self.resolved, 0);
        encoder.copy_buffer_to_buffer(&self.resolved, 0, &self.mapped, 0, 16);
        self.queue.submit([encoder.finish()]);
        self.mapped.map_async(MapMode::Read, .., |_| ());
        let wait = PollType::Wait { submission_index: None, timeout: Some(Duration::from_secs(60)) };
        self.device.poll(wait).map_err(|error| driver("Device::poll")(error.into()))?;
        let view = self
            .mapped
            .get_mapped_range(..)
            .map_err(|error| driver("Buffer::get_mapped_range")(error.into()))?;
        let stamps: Vec<u64> = view.chunks_exact(8).map(bytemuck::pod_read_unaligned).collect();
        drop(view);
        self.mapped.unmap();
        let ticks = stamps[1].saturating_sub(stamps[0]);
        let nanoseconds = ticks as f64 * f64::from(self.queue.get_timestamp_period());
        Ok(Duration::from_nanos(nanoseconds as u64))
    }
}
