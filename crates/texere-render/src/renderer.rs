//! The pipelines: yarns, visibility, light, pixels.

use std::sync::Arc;

use texere_core::{Backend, BackendError, DeviceInfo};
use texere_shaders::picture;
use texere_wgpu::WgpuBackend;

use crate::rasteriser::{Keys, Rasteriser, module, pipeline};

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
    pub(crate) rasteriser: Arc<Rasteriser>,
    pub(crate) visibility: wgpu::ComputePipeline,
    pub(crate) shade: wgpu::ComputePipeline,
    pub(crate) gather: wgpu::ComputePipeline,
}

impl Renderer {
    /// Compiles the shaders for `device`.
    ///
    /// **Errors**: [`BackendError::Driver`], [`BackendError::DeviceLost`].
    pub fn new(device: WgpuBackend) -> Result<Self, BackendError> {
        let keys = Keys::of(&device);
        Self::with_rasteriser(device, Rasteriser::new(keys))
    }

    pub(crate) fn with_rasteriser(device: WgpuBackend, rasteriser: Rasteriser) -> Result<Self, BackendError> {
        let [visibility, shade, gather] = device.scoped("Device::create_compute_pipeline", || {
            let device = device.device();
            [
                pipeline(device, &module(device, picture::VISIBILITY), "visibility"),
                pipeline(device, &module(device, picture::SHADE), "shade"),
                pipeline(device, &module(device, picture::GATHER), "gather"),
            ]
        })?;
        Ok(Self { device, rasteriser: Arc::new(rasteriser), visibility, shade, gather })
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
