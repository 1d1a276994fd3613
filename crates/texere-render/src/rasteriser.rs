//! The compiled shaders that draw a fabric without a mesh.

use std::borrow::Cow;
use std::sync::{Arc, OnceLock};

use texere_core::BackendError;
use texere_gpu::{Language, prelude};
use texere_shaders::picture;
use texere_wgpu::{LONG_ATOMICS, WgpuBackend, with_parameters};
use wgpu::{BindGroupEntry, BindingResource};

use crate::RenderError;
use crate::watch::Watch;

/// The kind of atomics that find the nearest triangle of a sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Keys {
    /// Atomics of 64 bits: depth and triangle at once.
    Whole,
    /// Atomics of 32 bits: first the depth, then the triangle.
    InRounds,
}

impl Keys {
    /// The faster kind that `device` has.
    pub(crate) fn of(device: &WgpuBackend) -> Self {
        if device.device().features().contains(LONG_ATOMICS) { Self::Whole } else { Self::InRounds }
    }

    /// The number of times that all triangles are gone through.
    pub(crate) const fn rounds(self) -> usize {
        match self {
            Self::Whole => 1,
            Self::InRounds => 2,
        }
    }
}

/// The shaders of a device for each kind of fabric. Each is compiled at its first use.
#[derive(Debug)]
pub(crate) struct Rasteriser {
    pub(crate) keys: Keys,
    raster: [&'static str; 2],
    hairs: &'static str,
    resolve: Cow<'static, str>,
    /// The shaders of each kind of fabric, indexed by `flattened`, `rolled` and `hairy`.
    kinds: [[[OnceLock<Arc<Pipelines>>; 2]; 2]; 2],
}

/// The kind of fabric that shaders are specialised for: whether any yarn is flattened, any section
/// turns, and any fibre stands off.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Kind {
    pub(crate) flattened: bool,
    pub(crate) rolled: bool,
    pub(crate) hairy: bool,
}

/// The shaders for one kind of fabric.
#[derive(Debug)]
pub(crate) struct Pipelines {
    pub(crate) cull: wgpu::ComputePipeline,
    pub(crate) list_all: wgpu::ComputePipeline,
    pub(crate) count_listed: wgpu::ComputePipeline,
    pub(crate) count_left: wgpu::ComputePipeline,
    /// The pipelines for quads of at most two by two pixels, for quads of a few samples, and for
    /// quads of many samples.
    pub(crate) rasters: [wgpu::ComputePipeline; 3],
    pub(crate) caps: wgpu::ComputePipeline,
    /// The pipeline of hairs; none if no yarn has hairs.
    pub(crate) hairs: Option<wgpu::ComputePipeline>,
    pub(crate) resolve: wgpu::ComputePipeline,
}

impl Rasteriser {
    pub(crate) fn new(keys: Keys) -> Self {
        let (raster, hairs) = match keys {
            Keys::Whole => (picture::RASTER, picture::HAIRS),
            Keys::InRounds => (picture::RASTER_IN_ROUNDS, picture::HAIRS_IN_ROUNDS),
        };
        Self { keys, raster, hairs, resolve: Cow::Borrowed(picture::RESOLVE), kinds: <_>::default() }
    }

    /// These shaders with another source for the shader that works out what samples show. Tests
    /// give a broken one, which must be noticed.
    #[cfg(test)]
    pub(crate) fn with_resolve(self, resolve: String) -> Self {
        Self { resolve: Cow::Owned(resolve), ..self }
    }

    /// The shaders for a kind of fabric. The callback of `watch` is called after each shader that
    /// is compiled, because a driver takes a tenth of a second for some.
    ///
    /// **Errors**: [`RenderError::Backend`], [`RenderError::Cancelled`].
    pub(crate) fn pipelines(
        &self,
        device: &WgpuBackend,
        kind: Kind,
        watch: &mut Watch<'_>,
    ) -> Result<Arc<Pipelines>, RenderError> {
        let Kind { flattened, rolled, hairy } = kind;
        let place = &self.kinds[usize::from(flattened)][usize::from(rolled)][usize::from(hairy)];
        if let Some(compiled) = place.get() {
            return Ok(compiled.clone());
        }
        let before = prelude(Language::Wgsl, flattened);
        let call = "Device::create_compute_pipeline";
        let module = |source: &str| device.scoped(call, || module(device.device(), before.clone() + source));
        let mut pipeline = |module: &wgpu::ShaderModule, entry_point: &str| {
            let compiled = device.scoped(call, || pipeline(device.device(), module, entry_point))?;
            watch.ask().map(|()| compiled)
        };
        let cull = module(picture::CULL)?;
        let raster = module(self.raster[usize::from(rolled)])?;
        let resolve = module(&(picture::hairy(hairy).to_owned() + &self.resolve))?;
        let compiled = Pipelines {
            cull: pipeline(&cull, "cull")?,
            list_all: pipeline(&cull, "list_all")?,
            count_listed: pipeline(&cull, "count_listed")?,
            count_left: pipeline(&cull, "count_left")?,
            rasters: [
                pipeline(&raster, "raster")?,
                pipeline(&raster, "raster_few")?,
                pipeline(&raster, "raster_many")?,
            ],
            caps: pipeline(&raster, "raster_caps")?,
            hairs: if hairy { Some(pipeline(&module(self.hairs)?, "hairs")?) } else { None },
            resolve: pipeline(&resolve, "resolve")?,
        };
        // Another scene may have compiled them meanwhile.
        Ok(place.get_or_init(|| Arc::new(compiled)).clone())
    }
}

/// The compiled value in `place`. It is compiled if `place` is empty.
///
/// **Errors**: [`BackendError::Driver`], [`BackendError::DeviceLost`].
pub(crate) fn compiled_once<'a, T>(
    place: &'a OnceLock<T>,
    device: &WgpuBackend,
    compile: impl FnOnce(&wgpu::Device) -> T,
) -> Result<&'a T, BackendError> {
    if let Some(compiled) = place.get() {
        return Ok(compiled);
    }
    let compiled = device.scoped("Device::create_compute_pipeline", || compile(device.device()))?;
    // Another scene may have compiled it meanwhile.
    Ok(place.get_or_init(|| compiled))
}

pub(crate) fn module(device: &wgpu::Device, source: impl Into<String>) -> wgpu::ShaderModule {
    device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(with_parameters(device, source.into()).into()),
    })
}

/// A compute pipeline whose layout follows from its shader.
pub(crate) fn pipeline(
    device: &wgpu::Device,
    module: &wgpu::ShaderModule,
    entry_point: &str,
) -> wgpu::ComputePipeline {
    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some(entry_point),
        layout: None,
        module,
        entry_point: Some(entry_point),
        compilation_options: wgpu::PipelineCompilationOptions {
            // Every shader writes its workgroup memory before it reads it.
            zero_initialize_workgroup_memory: false,
            ..Default::default()
        },
        cache: None,
    })
}

/// Binds resources to group `number` of a pipeline.
pub(crate) fn group(
    device: &wgpu::Device,
    pipeline: &wgpu::ComputePipeline,
    number: u32,
    resources: &[(u32, BindingResource<'_>)],
) -> wgpu::BindGroup {
    let entries: Vec<_> = resources
        .iter()
        .map(|(binding, resource)| BindGroupEntry { binding: *binding, resource: resource.clone() })
        .collect();
    let layout = &pipeline.get_bind_group_layout(number);
    device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &entries })
}
