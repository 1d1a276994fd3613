//! The compiled shaders of a schedule, and how they are launched.

use std::sync::{Arc, OnceLock};

use texere_core::BackendError;
use texere_core::backend::Schedule;
use texere_gpu::{Language, prelude, serial_unsupported};
use texere_shaders::{Access, Resource, Shader, grid};
use wgpu::{
    BindGroupEntry, BindGroupLayoutEntry, BindingResource, BindingType, BufferBindingType, ShaderStages,
};

use crate::attributes::AttributeKernels;
use crate::crossings::CrossingsKernels;
use crate::gpu::Gpu;
use crate::packed::PackedKernels;
use crate::settling::SettlingKernels;

/// A shader, ready to run.
#[derive(Debug)]
pub(crate) struct Kernel {
    shader: &'static Shader,
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::ComputePipeline,
}

/// An open device with its shaders: what a backend and its sessions share.
#[derive(Debug)]
pub(crate) struct Opened {
    pub(crate) gpu: Gpu,
    pub(crate) schedule: Schedule,
    /// For round yarns alone.
    pub(crate) round: Arc<Kernels>,
    /// For all yarns: compiled where they are wanted first.
    flattened: OnceLock<Arc<Kernels>>,
    /// Those that make attributes, likewise.
    attributes: OnceLock<Arc<AttributeKernels>>,
    /// Those that pack vertices, for round yarns alone and for all yarns, likewise.
    packing: [OnceLock<Arc<PackedKernels>>; 2],
    /// Those that bring yarns to rest, likewise.
    settling: [OnceLock<Arc<SettlingKernels>>; 2],
    /// Those that bring crossings to rest, likewise.
    crossings: OnceLock<Arc<CrossingsKernels>>,
}

impl Opened {
    /// Compiles the shaders for round yarns.
    ///
    /// **Errors**: [`BackendError::Compile`]; [`BackendError::Unsupported`] for
    /// [`Schedule::Serial`].
    pub(crate) fn new(gpu: Gpu, schedule: Schedule) -> Result<Self, BackendError> {
        let round = Arc::new(Kernels::new(&gpu, schedule, false)?);
        Ok(Self {
            gpu,
            schedule,
            round,
            flattened: OnceLock::new(),
            attributes: OnceLock::new(),
            packing: <_>::default(),
            settling: <_>::default(),
            crossings: OnceLock::new(),
        })
    }

    /// The shaders for all yarns.
    ///
    /// **Errors**: [`BackendError::Compile`].
    pub(crate) fn flattened(&self) -> Result<Arc<Kernels>, BackendError> {
        compiled(&self.flattened, || Kernels::new(&self.gpu, self.schedule, true))
    }

    /// The shaders that make attributes.
    ///
    /// **Errors**: [`BackendError::NoAttributes`] in the schedule per-yarn,
    /// [`BackendError::Compile`].
    pub(crate) fn attributes(&self) -> Result<Arc<AttributeKernels>, BackendError> {
        if self.schedule != Schedule::PerRing {
            return Err(BackendError::NoAttributes);
        }
        compiled(&self.attributes, || AttributeKernels::new(&self.gpu))
    }

    /// The shaders that pack vertices, for all yarns or for round ones alone.
    ///
    /// **Errors**: [`BackendError::NoPacking`] in the schedule per-yarn, [`BackendError::Compile`].
    pub(crate) fn packing(&self, flattened: bool) -> Result<Arc<PackedKernels>, BackendError> {
        if self.schedule != Schedule::PerRing {
            return Err(BackendError::NoPacking);
        }
        let place = &self.packing[usize::from(flattened)];
        compiled(place, || PackedKernels::new(&self.gpu, flattened))
    }

    /// The shaders that bring yarns to rest, for all yarns or for round ones alone.
    ///
    /// **Errors**: [`BackendError::Compile`].
    pub(crate) fn settling(&self, flattened: bool) -> Result<Arc<SettlingKernels>, BackendError> {
        let place = &self.settling[usize::from(flattened)];
        compiled(place, || SettlingKernels::new(&self.gpu, flattened))
    }

    /// The shaders that bring crossings to rest.
    ///
    /// **Errors**: [`BackendError::Compile`].
    pub(crate) fn crossings(&self) -> Result<Arc<CrossingsKernels>, BackendError> {
        compiled(&self.crossings, || CrossingsKernels::new(&self.gpu))
    }
}

/// What is in `place`, compiled first where nothing is.
fn compiled<T>(
    place: &OnceLock<Arc<T>>,
    compile: impl FnOnce() -> Result<T, BackendError>,
) -> Result<Arc<T>, BackendError> {
    if let Some(compiled) = place.get() {
        return Ok(compiled.clone());
    }
    let compiled = Arc::new(compile()?);
    // Another session may have been faster.
    Ok(place.get_or_init(|| compiled).clone())
}

/// The shaders of a schedule.
#[derive(Debug)]
pub(crate) enum Kernels {
    /// A lane a ring; our own.
    PerRing(Box<PerRing>),
    /// A lane a yarn; the paper's.
    PerYarn(Box<PerYarn>),
}

#[derive(Debug)]
pub(crate) struct PerRing {
    pub(crate) block_turns: Kernel,
    pub(crate) yarn_rolls: Kernel,
    pub(crate) trajectory: Kernel,
    /// For an even number of sides.
    pub(crate) mesh: Kernel,
    pub(crate) mesh_odd: Kernel,
    pub(crate) caps: Kernel,
}

#[derive(Debug)]
pub(crate) struct PerYarn {
    pub(crate) trajectory: Kernel,
    pub(crate) mesh: Kernel,
}

impl Kernels {
    fn new(gpu: &Gpu, schedule: Schedule, flattened: bool) -> Result<Self, BackendError> {
        let kernel = |shader| Kernel::new(gpu, shader, flattened);
        Ok(match schedule {
            Schedule::PerRing => Self::PerRing(Box::new(PerRing {
                block_turns: kernel(&texere_shaders::BLOCK_TURNS)?,
                yarn_rolls: kernel(&texere_shaders::YARN_ROLLS)?,
                trajectory: kernel(&texere_shaders::TRAJECTORY)?,
                mesh: kernel(&texere_shaders::MESH)?,
                mesh_odd: kernel(&texere_shaders::MESH_ODD)?,
                caps: kernel(&texere_shaders::CAPS)?,
            })),
            Schedule::PerYarn => Self::PerYarn(Box::new(PerYarn {
                trajectory: kernel(&texere_shaders::TRAJECTORY_PER_YARN)?,
                mesh: kernel(&texere_shaders::MESH_PER_YARN)?,
            })),
            Schedule::Serial => return Err(serial_unsupported(&gpu.name)),
        })
    }
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

    /// Binds what the shader uses, as `resource` finds it. What that does not find is left out, and
    /// wgpu refuses to bind the rest.
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

    /// Records a run of `workgroups`.
    pub(crate) fn record(&self, pass: &mut wgpu::ComputePass<'_>, bound: &wgpu::BindGroup, workgroups: u32) {
        if workgroups > 0 {
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, bound, &[]);
            let (columns, rows) = grid(workgroups);
            pass.dispatch_workgroups(columns, rows, 1);
        }
    }

    /// Workgroups for `lanes`.
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
                    Access::Uniform => BufferBindingType::Uniform,
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

/// Without run-time checks, which would cost a comparison an access in stages that do little else
/// than access memory.
#[allow(unsafe_code, reason = "trusted shaders are the one thing that this crate needs it for")]
fn trusted_module(gpu: &Gpu, shader: &Shader, flattened: bool) -> wgpu::ShaderModule {
    let source = prelude(Language::Wgsl, flattened) + shader.source;
    let descriptor = wgpu::ShaderModuleDescriptor {
        label: Some(shader.entry_point),
        source: wgpu::ShaderSource::Wgsl(source.into()),
    };
    // SAFETY: the source is one of texere-shaders' own, and what it may do unchecked it does not
    // do:
    // - Indices into buffers come from the block and cap tables and from the plan's own tables.
    //   Nobody but the plan makes chunks, and a session takes its own plan's alone; the plan's
    //   tables are bound whole, and every output is at least as long as the chunk says.
    // - Indices into workgroup memory are below BLOCK_RINGS or the workgroup's size: a block has at
    //   most BLOCK_RINGS rings.
    // - Loops run over the counts of a row or of `Params`, upwards in steps above zero, so they
    //   end.
    // - Divisors are `subdivisions + 1`, `sides`, at least 3, a lane's share `across`, at least 1
    //   since a ring has at least 5 stores, and constants above zero; a yarn's `rings - 1` divides
    //   as a float only.
    // - The lengths along yarns have one for each of the plan's blocks, and attributes and packed
    //   vertices one for each of the chunk's. In the shaders of settling it is so, too:
    // - Places, yarns and chords come from the tables of a settling's plan, bound whole, as is all
    //   that has a number each. An interval's place has one before it and two behind it. A number
    //   that a shader has written is below what it numbers, or is compared with that before it is
    //   used: cells, places in them, neighbours, and where lists end.
    // - Loops run up to a count, to a place in a list, which is below its buffer's length, or over
    //   halves of a workgroup.
    // - Divisors of whole numbers are a cell's size and the counts of cells, which the host makes
    //   at least 1, and a repeat where there is one. In those of crossings:
    // - A site beside another is one of the plan's, or is not read: its end is below the ends, its
    //   pick below the picks. Tables are the plan's, bound whole, as is all that has a number each;
    //   the rows of passes are as many as the host counts passes to.
    // - Whole numbers are divided by the ends, at least 2, and by constants.
    unsafe { gpu.device.create_shader_module_trusted(descriptor, wgpu::ShaderRuntimeChecks::unchecked()) }
}
