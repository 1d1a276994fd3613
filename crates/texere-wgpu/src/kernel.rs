//! Compiling, binding and launching a shader.

use texere_core::BackendError;
use texere_gpu::{Language, prelude};
use texere_shaders::{Access, Resource, Shader, grid};
use wgpu::{
    BindGroupEntry, BindGroupLayoutEntry, BindingResource, BindingType, BufferBindingType, ShaderStages,
};

use crate::gpu::Gpu;
use crate::parameters::{self, with_parameters};

/// A shader, ready to run.
#[derive(Debug)]
pub(crate) struct Kernel {
    shader: &'static Shader,
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::ComputePipeline,
}

impl Kernel {
    pub(crate) fn new(gpu: &Gpu, shader: &'static Shader, flattened: bool) -> Result<Self, BackendError> {
        gpu.check_alive()?;
        let compiled = gpu.caught(|| {
            let layout = bind_group_layout(gpu, shader);
            let pipeline = pipeline(gpu, shader, &layout, flattened);
            Self { shader, layout, pipeline }
        });
        gpu.check_alive()?;
        compiled.map_err(|error| BackendError::Compile { kernel: shader.entry_point, log: error.to_string() })
    }

    /// Binds the resources that the shader uses, as `resource` returns them. If `resource` returns
    /// none for one of them, wgpu refuses the group.
    pub(crate) fn bind<'a>(
        &self,
        gpu: &Gpu,
        resource: impl Fn(Resource) -> Option<BindingResource<'a>>,
    ) -> wgpu::BindGroup {
        let entries: Vec<_> = self
            .shader
            .bindings
            .iter()
            .filter_map(|binding| {
                let resource = resource(binding.resource)?;
                Some(BindGroupEntry { binding: binding.resource as u32, resource })
            })
            .collect();
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(self.shader.entry_point),
            layout: &self.layout,
            entries: &entries,
        })
    }

    /// Records a run of `workgroups` workgroups.
    pub(crate) fn record(&self, pass: &mut wgpu::ComputePass<'_>, bound: &wgpu::BindGroup, workgroups: u32) {
        if workgroups > 0 {
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, bound, &[]);
            let (columns, rows) = grid(workgroups);
            pass.dispatch_workgroups(columns, rows, 1);
        }
    }

    /// The number of workgroups for `lanes` lanes.
    pub(crate) fn workgroups(&self, lanes: u32) -> u32 {
        lanes.div_ceil(self.shader.workgroup)
    }
}

fn bind_group_layout(gpu: &Gpu, shader: &Shader) -> wgpu::BindGroupLayout {
    let entries: Vec<_> = shader
        .bindings
        .iter()
        .map(|binding| BindGroupLayoutEntry {
            binding: binding.resource as u32,
            visibility: ShaderStages::COMPUTE,
            ty: BindingType::Buffer {
                ty: match binding.access {
                    Access::Uniform => parameters::binding(&gpu.device),
                    Access::Read => BufferBindingType::Storage { read_only: true },
                    Access::Write => BufferBindingType::Storage { read_only: false },
                },
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        })
        .collect();
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some(shader.entry_point),
        entries: &entries,
    })
}

fn pipeline(
    gpu: &Gpu,
    shader: &Shader,
    layout: &wgpu::BindGroupLayout,
    flattened: bool,
) -> wgpu::ComputePipeline {
    let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(shader.entry_point),
        bind_group_layouts: &[Some(layout)],
        immediate_size: 0,
    });
    let module = trusted_module(gpu, shader, flattened);
    gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some(shader.entry_point),
        layout: Some(&layout),
        module: &module,
        entry_point: Some(shader.entry_point),
        compilation_options: wgpu::PipelineCompilationOptions {
            // Every shader writes its workgroup memory before it reads it.
            zero_initialize_workgroup_memory: false,
            ..Default::default()
        },
        cache: None,
    })
}

/// A module without run-time checks. The checks would add a comparison to each access, in stages
/// that do little but access memory.
#[allow(unsafe_code, reason = "trusted shaders are the one thing that this crate needs it for")]
fn trusted_module(gpu: &Gpu, shader: &Shader, flattened: bool) -> wgpu::ShaderModule {
    let source = with_parameters(&gpu.device, prelude(Language::Wgsl, flattened) + shader.source);
    let descriptor = wgpu::ShaderModuleDescriptor {
        label: Some(shader.entry_point),
        source: wgpu::ShaderSource::Wgsl(source.into()),
    };
    // SAFETY: the source is one of texere-shaders' own. It does nothing that a check would stop.
    // In the shaders of meshes, attributes and packed vertices:
    // - Indices into buffers come from the block and cap tables and from the plan's own tables.
    //   Only a plan makes chunks, and a session accepts the chunks of its own plan alone. The
    //   plan's tables are bound whole, and every output is at least as long as the chunk says.
    //   Lengths along yarns have one value for each of the plan's blocks. Attributes and packed
    //   vertices have one for each of the chunk's vertices.
    // - Indices into workgroup memory are below BLOCK_RINGS or the workgroup's size: a block has at
    //   most BLOCK_RINGS rings.
    // - Loops run over the counts of a row or of `Params`, upwards in steps above zero, so they
    //   end.
    // - Divisors are `subdivisions + 1`; `sides`, which is at least 3; a lane's share `across`,
    //   which is at least 1, since a ring has at least 5 stores; and constants above zero. A yarn's
    //   `rings - 1` divides as a float only.
    // In the shaders of settling:
    // - Places, yarns and chords come from the tables of a settling's plan, which are bound whole,
    //   as is every buffer with a value for each of them. An interval's place has one place before
    //   it and two behind it. A number that a shader has written (of a cell, of a place in a cell,
    //   of a neighbour, or of a list's end) is below the length of what it indexes, or is compared
    //   with that length before it is used.
    // - Loops run up to a count, up to a place in a list, or over halves of a workgroup. A place in
    //   a list is below the length of the list's buffer.
    // - Divisors of whole numbers are a cell's size and the counts of cells, which the host makes
    //   at least 1, and the repeat, if there is one.
    // In the shaders of crossings:
    // - A site beside another is one of the plan's, or is not read: its end is less than the number
    //   of ends, and its pick less than the number of picks. The plan's tables are bound whole, as
    //   is every buffer with a value for each crossing. There is a row for each pass number that
    //   the host uses.
    // - Whole numbers are divided by the number of ends, which is at least 2, and by constants.
    unsafe { gpu.device.create_shader_module_trusted(descriptor, wgpu::ShaderRuntimeChecks::unchecked()) }
}
