//! What a picture is drawn into, and the copy that goes to the host.

use texere_core::BackendError;
use texere_wgpu::WgpuBackend;
use wgpu::{BufferUsages, Extent3d, TextureFormat, TextureUsages};

/// Samples of a pixel, where rasterisers of every device have them for four.
pub(crate) const SAMPLES: u32 = 4;

/// `SCREEN_GROUP` of `screen.wgsl`, and the side of the workgroups of `resolve.wgsl`.
pub(crate) const SCREEN_GROUP: u32 = 8;

/// Bytes of a pixel of a picture.
const COLOR_BYTES: usize = 4;

/// The textures for one size of picture: 84 bytes a pixel, times the square of the supersampling, and 8 bytes.
#[derive(Debug)]
pub(crate) struct Screen {
    size: [u32; 2],
    supersampling: u32,
    /// A layer for each sample of a pixel.
    pub(crate) depths: wgpu::TextureView,
    pub(crate) surfaces: wgpu::TextureView,
    pub(crate) visibility: wgpu::TextureView,
    pub(crate) picture: wgpu::Buffer,
    host: wgpu::Buffer,
}

impl Screen {
    pub(crate) fn new(
        device: &WgpuBackend,
        size: [u32; 2],
        supersampling: u32,
    ) -> Result<Self, BackendError> {
        let pixels = u64::from(size[0]) * u64::from(size[1]) * COLOR_BYTES as u64;
        let [width, height] = size.map(|pixels| pixels * supersampling);
        let texture = |label, layers, format| {
            let texture = device.device().create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: Extent3d { width, height, depth_or_array_layers: layers },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: TextureUsages::STORAGE_BINDING | TextureUsages::TEXTURE_BINDING,
                view_formats: &[],
            });
            texture.create_view(&wgpu::TextureViewDescriptor::default())
        };
        let textures = device.scoped("Device::create_texture", || {
            [
                texture("depths", SAMPLES, TextureFormat::R32Float),
                texture("surfaces", SAMPLES, TextureFormat::Rgba32Uint),
                texture("visibility", 1, TextureFormat::Rgba8Unorm),
            ]
        })?;
        let [depths, surfaces, visibility] = textures;
        Ok(Self {
            size,
            supersampling,
            depths,
            surfaces,
            visibility,
            picture: device.buffer("picture", pixels, BufferUsages::STORAGE | BufferUsages::COPY_SRC)?,
            host: device.buffer("picture", pixels, BufferUsages::MAP_READ | BufferUsages::COPY_DST)?,
        })
    }

    /// Whether pictures of this size can be drawn into it.
    pub(crate) fn fits(&self, size: [u32; 2], supersampling: u32) -> bool {
        (self.size, self.supersampling) == (size, supersampling)
    }

    /// Width and height of the picture, pixels.
    pub(crate) const fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The same before it is scaled down to the picture's.
    pub(crate) fn large(&self) -> [u32; 2] {
        self.size.map(|pixels| pixels * self.supersampling)
    }

    /// Records the copy to the host.
    pub(crate) fn copy(&self, encoder: &mut wgpu::CommandEncoder) {
        encoder.copy_buffer_to_buffer(&self.picture, 0, &self.host, 0, self.picture.size());
    }

    /// Asks for the copy, once it is handed over, to be mapped.
    pub(crate) fn map(&self) {
        self.host.map_async(wgpu::MapMode::Read, .., |_| ());
    }

    /// The pixels' colours, three bytes each, and their alpha, once the copy is done.
    pub(crate) fn take(&self, device: &WgpuBackend) -> Result<[Vec<u8>; 2], BackendError> {
        let pixels = self.size[0] as usize * self.size[1] as usize;
        let pixels = device.scoped("Buffer::get_mapped_range", || {
            self.host.get_mapped_range(..).map(|view| {
                let [mut rgb, mut alpha] = [3 * pixels, pixels].map(Vec::with_capacity);
                for pixel in view.chunks_exact(COLOR_BYTES).take(pixels) {
                    rgb.extend_from_slice(&pixel[..3]);
                    alpha.push(pixel[3]);
                }
                [rgb, alpha]
            })
        })?;
        let pixels = pixels.map_err(|source| BackendError::Driver {
            call: "Buffer::get_mapped_range",
            source: source.into(),
        })?;
        device.scoped("Buffer::unmap", || self.host.unmap())?;
        Ok(pixels)
    }
}
