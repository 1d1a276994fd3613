//! Textures that a picture is drawn into, and the copy that goes to the host.

use texere_core::BackendError;
use texere_wgpu::WgpuBackend;
use wgpu::{Extent3d, LoadOp, Operations, StoreOp, TextureFormat, TextureUsages};

/// Samples of a pixel: 4x multisampling, which every device has.
pub(crate) const SAMPLES: u32 = 4;

pub(crate) const DEPTH: TextureFormat = TextureFormat::Depth32Float;
pub(crate) const KEPT: TextureFormat = TextureFormat::Rgba16Uint;
pub(crate) const VISIBILITY: TextureFormat = TextureFormat::Rg8Unorm;
pub(crate) const COLOR: TextureFormat = TextureFormat::Rgba8UnormSrgb;

/// Bytes of a pixel of [`COLOR`].
const COLOR_BYTES: u32 = 4;

/// The textures for one size of picture: 82 bytes a pixel, times the square of the supersampling, and 8 bytes.
#[derive(Debug)]
pub(crate) struct Screen {
    size: [u32; 2],
    supersampling: u32,
    pub(crate) depths: wgpu::TextureView,
    pub(crate) directions: wgpu::TextureView,
    pub(crate) places: wgpu::TextureView,
    pub(crate) visibility: wgpu::TextureView,
    pub(crate) color: wgpu::TextureView,
    host: wgpu::Buffer,
}

impl Screen {
    pub(crate) fn new(
        device: &WgpuBackend,
        size: [u32; 2],
        supersampling: u32,
    ) -> Result<Self, BackendError> {
        let row = row_bytes(size);
        device.scoped("Device::create_texture", || {
            let view = |label, size: [u32; 2], samples, format, usage| {
                let texture = device.device().create_texture(&wgpu::TextureDescriptor {
                    label: Some(label),
                    size: Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
                    mip_level_count: 1,
                    sample_count: samples,
                    dimension: wgpu::TextureDimension::D2,
                    format,
                    usage: TextureUsages::RENDER_ATTACHMENT | usage,
                    view_formats: &[],
                });
                texture.create_view(&wgpu::TextureViewDescriptor::default())
            };
            let large = size.map(|pixels| pixels * supersampling);
            let read = TextureUsages::TEXTURE_BINDING;
            Self {
                size,
                supersampling,
                depths: view("depths", large, SAMPLES, DEPTH, read),
                directions: view("directions", large, SAMPLES, KEPT, read),
                places: view("places", large, SAMPLES, KEPT, read),
                visibility: view("visibility", large, 1, VISIBILITY, read),
                color: view("color", size, 1, COLOR, TextureUsages::COPY_SRC),
                host: device.device().create_buffer(&wgpu::BufferDescriptor {
                    label: Some("picture"),
                    size: u64::from(row) * u64::from(size[1]),
                    usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
                    mapped_at_creation: false,
                }),
            }
        })
    }

    /// Whether pictures of this size can be drawn into it.
    pub(crate) fn fits(&self, size: [u32; 2], supersampling: u32) -> bool {
        (self.size, self.supersampling) == (size, supersampling)
    }

    /// A pass that draws yarns, over what earlier ones left unless it is the `first`.
    pub(crate) fn yarn_pass<'a>(
        &self,
        encoder: &'a mut wgpu::CommandEncoder,
        first: bool,
    ) -> wgpu::RenderPass<'a> {
        let kept = |view| {
            let load = if first { LoadOp::Clear(wgpu::Color::TRANSPARENT) } else { LoadOp::Load };
            Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target: None,
                ops: Operations { load, store: StoreOp::Store },
            })
        };
        let load = if first { LoadOp::Clear(1.0) } else { LoadOp::Load };
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("yarns"),
            color_attachments: &[kept(&self.directions), kept(&self.places)],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.depths,
                depth_ops: Some(Operations { load, store: StoreOp::Store }),
                stencil_ops: None,
            }),
            ..Default::default()
        })
    }

    /// Records a pass that fills `target` with what `pipeline` makes of `bound`.
    pub(crate) fn fill(
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        pipeline: &wgpu::RenderPipeline,
        bound: &wgpu::BindGroup,
    ) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("screen"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: target,
                depth_slice: None,
                resolve_target: None,
                ops: Operations { load: LoadOp::Clear(wgpu::Color::BLACK), store: StoreOp::Store },
            })],
            ..Default::default()
        });
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, bound, &[]);
        pass.draw(0..3, 0..1);
    }

    /// Records the copy to the host.
    pub(crate) fn copy(&self, encoder: &mut wgpu::CommandEncoder) {
        let [width, height] = self.size;
        encoder.copy_texture_to_buffer(
            self.color.texture().as_image_copy(),
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
        let width = (self.size[0] * COLOR_BYTES) as usize;
        let pixels = device.scoped("Buffer::get_mapped_range", || {
            self.host.get_mapped_range(..).map(|view| {
                let pixels = view.len() / 4;
                let [mut rgb, mut alpha] = [3 * pixels, pixels].map(Vec::with_capacity);
                for pixel in view.chunks_exact(row).flat_map(|row| row[..width].chunks_exact(4)) {
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

/// Bytes of a row of the copy, which wgpu wants in multiples of 256.
fn row_bytes(size: [u32; 2]) -> u32 {
    (size[0] * COLOR_BYTES).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT)
}
