//! The pipelines: sieve, yarns, visibility, light.

use texere_core::{Backend, BackendError, DeviceInfo};
use texere_shaders::picture;
use texere_wgpu::WgpuBackend;
use wgpu::{BindingType, BufferBindingType, ShaderStages, TextureSampleType, TextureViewDimension};

use crate::screen::{COLOR, DEPTH, KEPT, SAMPLES, VISIBILITY};

/// An open device with the pipelines that make pictures.
///
/// ```no_run
/// use texere_core::{Settings, Yarns};
/// use texere_render::{Camera, Quality, Renderer};
/// use texere_wgpu::{Schedule, WgpuBackend};
/// # fn example(yarns: &Yarns) -> Result<(), texere_render::RenderError> {
/// let renderer = Renderer::new(WgpuBackend::open(0, Schedule::PerRing)?)?;
/// let mut scene = renderer.scene(yarns, &Settings::default())?;
/// let camera = Camera::face(scene.extent(), [800, 600]);
/// let picture = scene.picture(&camera, Quality::default())?;
/// assert_eq!(picture.rgb.len(), 3 * 800 * 600);
/// # Ok(())
/// # }
/// ```
///
/// Its clones are the same device with the same pipelines. A [`Scene`](crate::Scene) keeps one, and so may outlive the renderer that made it.
#[derive(Debug, Clone)]
pub struct Renderer {
    pub(crate) device: WgpuBackend,
    pub(crate) sieve: wgpu::ComputePipeline,
    /// Draws outsides only, for views that show no end of a yarn.
    pub(crate) outsides: wgpu::RenderPipeline,
    /// Draws insides, too.
    pub(crate) all_sides: wgpu::RenderPipeline,
    pub(crate) visibility: wgpu::RenderPipeline,
    pub(crate) shade: wgpu::RenderPipeline,
    pub(crate) layouts: Layouts,
}

/// Layouts of what the pipelines bind.
#[derive(Debug, Clone)]
pub(crate) struct Layouts {
    pub(crate) sieve: wgpu::BindGroupLayout,
    pub(crate) yarns: wgpu::BindGroupLayout,
    pub(crate) visibility: wgpu::BindGroupLayout,
    pub(crate) shade: wgpu::BindGroupLayout,
}

impl Renderer {
    /// Compiles the shaders for `device`.
    ///
    /// **Errors**: [`BackendError::Driver`], [`BackendError::DeviceLost`].
    pub fn new(device: WgpuBackend) -> Result<Self, BackendError> {
        Self::with_shaders(device, picture::SIEVE, picture::YARNS)
    }

    /// [`Renderer::new`] with other shaders for yarns, such as a broken one that a test must find.
    pub(crate) fn with_shaders(device: WgpuBackend, sieve: &str, yarns: &str) -> Result<Self, BackendError> {
        let layouts = device.scoped("Device::create_bind_group_layout", || Layouts::new(device.device()))?;
        let sieve = device.scoped("Device::create_compute_pipeline", || {
            Pipelines { device: device.device() }.sieve(sieve, &layouts.sieve)
        })?;
        let pipelines = device.scoped("Device::create_render_pipeline", || {
            let pipelines = Pipelines { device: device.device() };
            [
                pipelines.yarns(yarns, &layouts.yarns, Some(wgpu::Face::Back)),
                pipelines.yarns(yarns, &layouts.yarns, None),
                pipelines.screen("visibility", picture::VISIBILITY, &layouts.visibility, VISIBILITY),
                pipelines.screen("shade", picture::SHADE, &layouts.shade, COLOR),
            ]
        })?;
        let [outsides, all_sides, visibility, shade] = pipelines;
        Ok(Self { device, sieve, outsides, all_sides, visibility, shade, layouts })
    }

    /// The device.
    #[must_use]
    pub fn info(&self) -> &DeviceInfo {
        self.device.info()
    }

    /// The backend that it draws on: a settler of it leaves yarns where [`Renderer::settled_scene`] finds them.
    #[must_use]
    pub const fn backend(&self) -> &WgpuBackend {
        &self.device
    }

    /// The longest side of a picture, supersampled, in pixels.
    #[must_use]
    pub fn side_limit(&self) -> u32 {
        self.device.device().limits().max_texture_dimension_2d
    }
}

const VIEW: BindingType =
    BindingType::Buffer { ty: BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: None };

const fn texture(sample_type: TextureSampleType, multisampled: bool) -> BindingType {
    BindingType::Texture { sample_type, view_dimension: TextureViewDimension::D2, multisampled }
}

impl Layouts {
    fn new(device: &wgpu::Device) -> Self {
        let kept = texture(TextureSampleType::Uint, true);
        let screen = [VIEW, texture(TextureSampleType::Depth, true), kept, kept];
        let visibility = texture(TextureSampleType::Float { filterable: false }, false);
        let storage = |read_only| BindingType::Buffer {
            ty: BufferBindingType::Storage { read_only },
            has_dynamic_offset: false,
            min_binding_size: None,
        };
        let (read, written) = (storage(true), storage(false));
        let layout = |label, visibility, types: &[BindingType]| {
            let entries: Vec<_> = (0..)
                .zip(types)
                .map(|(binding, &ty)| wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None })
                .collect();
            device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some(label),
                entries: &entries,
            })
        };
        Self {
            sieve: layout("sieve", ShaderStages::COMPUTE, &[VIEW, read, read, written, written]),
            yarns: layout("yarns", ShaderStages::VERTEX_FRAGMENT, &[VIEW, read, read, read]),
            visibility: layout("visibility", ShaderStages::FRAGMENT, &screen),
            shade: layout("shade", ShaderStages::FRAGMENT, &[&screen[..], &[visibility, read]].concat()),
        }
    }
}

/// Makes pipelines.
struct Pipelines<'a> {
    device: &'a wgpu::Device,
}

impl Pipelines<'_> {
    fn module(&self, label: &str, source: &str) -> wgpu::ShaderModule {
        self.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(label),
            source: wgpu::ShaderSource::Wgsl(source.to_owned().into()),
        })
    }

    fn layout(&self, layout: &wgpu::BindGroupLayout) -> wgpu::PipelineLayout {
        self.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &[Some(layout)],
            immediate_size: 0,
        })
    }

    fn sieve(&self, source: &str, layout: &wgpu::BindGroupLayout) -> wgpu::ComputePipeline {
        self.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("sieve"),
            layout: Some(&self.layout(layout)),
            module: &self.module("sieve", source),
            entry_point: Some("sieve"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        })
    }

    fn yarns(
        &self,
        source: &str,
        layout: &wgpu::BindGroupLayout,
        cull_mode: Option<wgpu::Face>,
    ) -> wgpu::RenderPipeline {
        let module = self.module("yarns", source);
        self.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("yarns"),
            layout: Some(&self.layout(layout)),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("yarn_corner"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState { cull_mode, ..Default::default() },
            depth_stencil: Some(wgpu::DepthStencilState {
                format: DEPTH,
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::Less),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState::default(),
            }),
            multisample: wgpu::MultisampleState { count: SAMPLES, ..Default::default() },
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("yarn_sample"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[Some(KEPT.into()), Some(KEPT.into())],
            }),
            multiview_mask: None,
            cache: None,
        })
    }

    /// A pass over the whole screen.
    fn screen(
        &self,
        entry_point: &str,
        source: &str,
        layout: &wgpu::BindGroupLayout,
        target: wgpu::TextureFormat,
    ) -> wgpu::RenderPipeline {
        let module = self.module(entry_point, source);
        self.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(entry_point),
            layout: Some(&self.layout(layout)),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("screen"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some(entry_point),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[Some(target.into())],
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}
