//! What a picture is drawn into, and the copy that goes to the host.

use texere_core::BackendError;
use texere_wgpu::WgpuBackend;
use wgpu::{BufferUsages, Extent3d, TextureFormat, TextureUsages};

use crate::memory::read_mapped;

/// Samples of a pixel, where rasterisers of every device have them for four.
pub(crate) const SAMPLES: u32 = 4;

/// `SCREEN_GROUP` of `view.wgsl`.
pub(crate) const SCREEN_GROUP: u32 = 8;

/// Bytes of a pixel of a picture.
const COLOR_BYTES: u32 = 4;

/// The textures for one size of picture: 100 bytes a pixel, times the square of the supersampling, and 8 bytes.
#[derive(Debug)]
pub(crate) struct Screen {
    size: [u32; 2],
    supersampling: u32,
    /// A layer for each sample of a pixel.
    pub(crate) depths: wgpu::TextureView,
    pub(crate) directions: wgpu::TextureView,
    pub(crate) places: wgpu::TextureView,
    pub(crate) visibility: wgpu::TextureView,
    /// The four samples of a pixel in one number each.
    pub(crate) lit: wgpu::TextureView,
    pub(crate) picture: wgpu::TextureView,
    host: wgpu::Buffer,
}

impl Screen {
    pub(crate) fn new(
        device: &WgpuBackend,
        size: [u32; 2],
        supersampling: u32,
    ) -> Result<Self, BackendError> {
        let large = size.map(|pixels| pixels * supersampling);
        let texture = |label, [width, height]: [u32; 2], layers, format, usage| {
            let texture = device.device().create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: Extent3d { width, height, depth_or_array_layers: layers },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: TextureUsages::STORAGE_BINDING | usage,
                view_formats: &[],
            });
            texture.create_view(&wgpu::TextureViewDescriptor::default())
        };
        let read = TextureUsages::TEXTURE_BINDING;
        let copied = read | TextureUsages::COPY_SRC;
        let textures = device.scoped("Device::create_texture", || {
            [
                texture("depths", large, SAMPLES, TextureFormat::R32Float, copied),
                texture("directions", large, SAMPLES, TextureFormat::Rg32Uint, read),
                texture("places", large, SAMPLES, TextureFormat::Rg32Uint, copied),
                texture("visibility", large, 1, TextureFormat::Rgba8Unorm, read),
                texture("lit samples", large, 1, TextureFormat::Rgba32Uint, read),
                texture("picture", size, 1, TextureFormat::Rgba8Unorm, copied),
            ]
        })?;
        let [depths, directions, places, visibility, lit, picture] = textures;
        let bytes = u64::from(row_bytes(size)) * u64::from(size[1]);
        let host = device.buffer("picture", bytes, BufferUsages::MAP_READ | BufferUsages::COPY_DST)?;
        Ok(Self { size, supersampling, depths, directions, places, visibility, lit, picture, host })
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
        let [width, height] = self.size;
        encoder.copy_texture_to_buffer(
            self.picture.texture().as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &self.host,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(row_bytes(self.size)),
                    rows_per_image: None,
                },
            },
            Extent3d { width, height, depth_or_array_layers: 1 },
        );
    }

    /// Asks for the copy, once it is handed over, to be mapped.
    pub(crate) fn map(&self) {
        self.host.map_async(wgpu::MapMode::Read, .., |_| ());
    }

    /// The pixels' colours, three bytes each, and their alpha, once the copy is done.
    pub(crate) fn take(&self, device: &WgpuBackend) -> Result<[Vec<u8>; 2], BackendError> {
        let row = row_bytes(self.size) as usize;
        let [width, height] = self.size.map(|pixels| pixels as usize);
        let pixels = read_mapped(device, &self.host, |view| {
            let [mut rgb, mut alpha] = [3 * width * height, width * height].map(Vec::with_capacity);
            let rows = view.chunks_exact(row).take(height);
            for pixel in rows.flat_map(|row| row.chunks_exact(COLOR_BYTES as usize).take(width)) {
                rgb.extend_from_slice(&pixel[..3]);
                alpha.push(pixel[3]);
            }
            [rgb, alpha]
        })?;
        device.scoped("Buffer::unmap", || self.host.unmap())?;
        Ok(pixels)
    }
}

/// Bytes of a row of the copy, which wgpu wants in multiples of 256.
fn row_bytes(size: [u32; 2]) -> u32 {
    (size[0] * COLOR_BYTES).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT)
}
