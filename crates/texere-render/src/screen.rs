//! The textures and buffers that a picture is drawn into, and the copy that goes to the host.

use std::ops::Range;

use rayon::prelude::*;
use texere_core::{Backend, BackendError};
use texere_wgpu::WgpuBackend;
use wgpu::{BufferUsages, Extent3d, TextureFormat, TextureUsages};

use crate::mapped::read_mapped;

/// The number of samples of a pixel of the screen. The rasterisers of all devices have their four
/// samples at the same places, and pixels here have them there, too. If threads are less than four
/// pixels wide, each pixel shifts its samples.
pub(crate) const SAMPLES: u32 = 4;

/// `SCREEN_GROUP` of `view.wgsl`.
pub(crate) const SCREEN_GROUP: u32 = 8;

/// The bytes of a pixel of a picture.
const COLOR_BYTES: u32 = 4;

/// The bytes of a sample's key.
const KEY_BYTES: u64 = 8;

/// The most bytes of keys: enough for a picture of two million pixels with a supersampling of 2.
const KEYS_MOST: u64 = 256 << 20;

/// The memory for pictures of one size. It takes 8 bytes for each pixel of the picture, and 132
/// bytes for each pixel of the screen before the screen is scaled down. It takes less if the keys
/// of all samples would need more than [`KEYS_MOST`] or than a binding holds.
#[derive(Debug)]
pub(crate) struct Screen {
    size: [u32; 2],
    supersampling: u32,
    /// The depths of samples. This texture and the next two have a layer for each sample of a
    /// pixel.
    pub(crate) depths: wgpu::TextureView,
    pub(crate) directions: wgpu::TextureView,
    pub(crate) places: wgpu::TextureView,
    pub(crate) visibility: wgpu::TextureView,
    /// The four lit samples of each pixel, in one number each.
    pub(crate) lit: wgpu::TextureView,
    pub(crate) picture: wgpu::TextureView,
    /// The nearest triangle of each sample of a band.
    pub(crate) keys: wgpu::Buffer,
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
                texture("directions", large, SAMPLES, TextureFormat::Rg32Uint, copied),
                texture("places", large, SAMPLES, TextureFormat::Rg32Uint, copied),
                texture("visibility", large, 1, TextureFormat::Rgba8Unorm, read),
                texture("lit samples", large, 1, TextureFormat::Rgba32Uint, read),
                texture("picture", size, 1, TextureFormat::Rgba8Unorm, copied),
            ]
        })?;
        let [depths, directions, places, visibility, lit, picture] = textures;
        let bytes = u64::from(row_bytes(size)) * u64::from(size[1]);
        let host = device.buffer("picture", bytes, BufferUsages::MAP_READ | BufferUsages::COPY_DST)?;
        let key_bytes = key_row(large) * u64::from(large[1]);
        let most = KEYS_MOST.min(device.info().limits.binding_bytes).max(key_row(large));
        let keys = device.buffer(
            "samples",
            key_bytes.min(most / key_row(large) * key_row(large)),
            BufferUsages::STORAGE | BufferUsages::COPY_DST,
        )?;
        Ok(Self { size, supersampling, depths, directions, places, visibility, lit, picture, keys, host })
    }

    /// Whether pictures of this size can be drawn into the screen.
    pub(crate) fn fits(&self, size: [u32; 2], supersampling: u32) -> bool {
        (self.size, self.supersampling) == (size, supersampling)
    }

    /// Width and height of the picture, pixels.
    pub(crate) const fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Width and height of the screen before it is scaled down to the picture, pixels.
    pub(crate) fn large(&self) -> [u32; 2] {
        self.size.map(|pixels| pixels * self.supersampling)
    }

    /// The bands of rows that are drawn one after the other. A band has as many rows as there are
    /// keys for.
    pub(crate) fn bands(&self) -> impl Iterator<Item = Range<u32>> + use<> {
        let height = self.large()[1];
        let rows = (self.keys.size() / key_row(self.large())) as usize;
        (0..height).step_by(rows).map(move |first| first..height.min(first + rows as u32))
    }

    /// The bytes of the keys of `rows` rows.
    pub(crate) fn key_bytes(&self, rows: u32) -> u64 {
        u64::from(rows) * key_row(self.large())
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

    /// Asks for the copy to be mapped, after it has been submitted.
    pub(crate) fn map(&self) {
        self.host.map_async(wgpu::MapMode::Read, .., |_| ());
    }

    /// The pixels' colours, three bytes each, and their alpha, once the copy is done.
    pub(crate) fn take(&self, device: &WgpuBackend) -> Result<[Vec<u8>; 2], BackendError> {
        let row = row_bytes(self.size) as usize;
        let [width, height] = self.size.map(|pixels| pixels as usize);
        let pixels = read_mapped(device, &self.host, |view| {
            let [mut rgb, mut alpha] = [3 * width * height, width * height].map(|bytes| vec![0_u8; bytes]);
            let rows = rgb.par_chunks_exact_mut(3 * width).zip(alpha.par_chunks_exact_mut(width));
            rows.zip(view.par_chunks_exact(row)).for_each(|((rgb, alpha), row)| {
                let pixels = row.chunks_exact(COLOR_BYTES as usize);
                for ((rgb, alpha), pixel) in rgb.chunks_exact_mut(3).zip(alpha).zip(pixels) {
                    rgb.copy_from_slice(&pixel[..3]);
                    *alpha = pixel[3];
                }
            });
            [rgb, alpha]
        })?;
        device.scoped("Buffer::unmap", || self.host.unmap())?;
        Ok(pixels)
    }
}

/// The bytes of the keys of one row of a screen.
fn key_row(large: [u32; 2]) -> u64 {
    u64::from(large[0]) * u64::from(SAMPLES) * KEY_BYTES
}

/// The bytes of a row of the copy. wgpu requires multiples of 256.
fn row_bytes(size: [u32; 2]) -> u32 {
    (size[0] * COLOR_BYTES).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT)
}
