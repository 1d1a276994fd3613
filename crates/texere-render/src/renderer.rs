//! A device with the pipelines of pictures: yarns, visibility, light, pixels.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use texere_core::{Backend, BackendError, DeviceInfo};
use texere_shaders::picture;
use texere_wgpu::WgpuBackend;

use crate::rasteriser::{Keys, Rasteriser, compiled_once, module, pipeline};
use crate::screen::Screen;

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
/// Clones share the device and the pipelines. A [`Scene`](crate::Scene) keeps a clone, so it may
/// outlive the renderer that made it.
#[derive(Debug, Clone)]
pub struct Renderer {
    pub(crate) device: WgpuBackend,
    pub(crate) rasteriser: Arc<Rasteriser>,
    pub(crate) visibility: wgpu::ComputePipeline,
    /// The pipelines that light samples, for near views and for far views. Each is compiled at its
    /// first use.
    shade: Arc<[OnceLock<wgpu::ComputePipeline>; 2]>,
    pub(crate) gather: wgpu::ComputePipeline,
    /// The screen of the last picture.
    screen: Arc<Mutex<Option<Arc<Screen>>>>,
}

impl Renderer {
    /// Compiles the shaders of visibility and of pixels for `device`. All other shaders are
    /// compiled at their first use.
    ///
    /// **Errors**: [`BackendError::Driver`], [`BackendError::DeviceLost`].
    pub fn new(device: WgpuBackend) -> Result<Self, BackendError> {
        let keys = Keys::of(&device);
        Self::with_rasteriser(device, Rasteriser::new(keys))
    }

    pub(crate) fn with_rasteriser(device: WgpuBackend, rasteriser: Rasteriser) -> Result<Self, BackendError> {
        let [visibility, gather] = device.scoped("Device::create_compute_pipeline", || {
            let device = device.device();
            [
                pipeline(device, &module(device, picture::VISIBILITY), "visibility"),
                pipeline(device, &module(device, picture::GATHER), "gather"),
            ]
        })?;
        let (rasteriser, shade, screen) = (Arc::new(rasteriser), Arc::default(), Arc::default());
        Ok(Self { device, rasteriser, visibility, shade, gather, screen })
    }

    /// The pipeline that lights samples, for near views or, with `is_far`, for far views.
    ///
    /// **Errors**: [`BackendError::Driver`], [`BackendError::DeviceLost`].
    pub(crate) fn shade(&self, is_far: bool) -> Result<&wgpu::ComputePipeline, BackendError> {
        compiled_once(&self.shade[usize::from(is_far)], &self.device, |device| {
            pipeline(device, &module(device, picture::far(is_far).to_owned() + picture::SHADE), "shade")
        })
    }

    /// A screen for pictures of this size. The screen of the last picture is used again if it fits
    /// and no scene holds it any more, because a device takes longer to allocate so much memory
    /// than to draw.
    ///
    /// **Errors**: [`BackendError::OutOfMemory`], [`BackendError::Driver`],
    /// [`BackendError::DeviceLost`].
    pub(crate) fn screen(&self, size: [u32; 2], supersampling: u32) -> Result<Arc<Screen>, BackendError> {
        let mut last = self.screen.lock().unwrap_or_else(PoisonError::into_inner);
        // A screen that does not fit is freed before another is allocated.
        let free =
            last.take().filter(|screen| screen.fits(size, supersampling) && Arc::strong_count(screen) == 1);
        let screen = match free {
            Some(screen) => screen,
            None => Arc::new(Screen::new(&self.device, size, supersampling)?),
        };
        Ok(last.insert(screen).clone())
    }

    /// The information about the device.
    #[must_use]
    pub fn info(&self) -> &DeviceInfo {
        self.device.info()
    }

    /// The backend that the renderer draws on. Yarns that a settler of this backend has settled
    /// stay on the device for [`Renderer::settled_scene`].
    #[must_use]
    pub const fn backend(&self) -> &WgpuBackend {
        &self.device
    }

    /// The longest side that the device allows a supersampled picture, pixels.
    pub(crate) fn side_limit(&self) -> u32 {
        self.device.device().limits().max_texture_dimension_2d
    }
}
