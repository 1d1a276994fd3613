//! What a picture shows at a point.

use glam::DVec3;
use wgpu::{BufferUsages, Extent3d, Origin3d, TexelCopyBufferInfo, TexelCopyBufferLayout, TextureAspect};

use crate::mapped::read_mapped;
use crate::{RenderError, Scene};

/// What a picture shows at a point: the yarn, and the place on its surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Seen {
    /// The number of the yarn, counted from 0.
    pub yarn: usize,
    /// The place on the yarn's surface, or on a fibre that stands off the yarn, mm. If the picture
    /// shows a yarn that is cut open, the place lies on the far wall inside.
    pub position: [f64; 3],
}

/// The bytes of a sample's place on the yarn.
pub(crate) const PLACE_BYTES: u64 = 8;

/// The bytes of a sample's depth.
pub(crate) const DEPTH_BYTES: u64 = 4;

/// `MARKS` of `view.wgsl`.
pub(crate) const MARKS: u32 = 0xc000_0000;

impl Scene {
    /// What the last picture shows at a point, in pixels from its left and upper edges. None if it
    /// shows no yarn there, if the point lies outside the picture, before the first picture, and
    /// after a picture that was stopped. The result is read from the picture's samples, so its time
    /// does not grow with the fabric.
    ///
    /// ```no_run
    /// # fn example(scene: &texere_render::Scene) -> Result<(), texere_render::RenderError> {
    /// if let Some(seen) = scene.seen_at([400.5, 300.5])? {
    ///     println!("yarn {} at {:?} mm", seen.yarn, seen.position);
    /// }
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// **Errors**: [`RenderError::Backend`].
    pub fn seen_at(&self, at: [f32; 2]) -> Result<Option<Seen>, RenderError> {
        let (Some(camera), Some(screen)) = (&self.camera, &self.screen) else { return Ok(None) };
        let [width, height] = camera.size().map(|pixels| pixels as f32);
        if !(0.0..width).contains(&at[0]) || !(0.0..height).contains(&at[1]) {
            return Ok(None);
        }
        let large = screen.large();
        let [x, y] = [0, 1].map(|axis| {
            let share = at[axis] / [width, height][axis];
            ((share * large[axis] as f32) as u32).min(large[axis] - 1)
        });
        let texels = [(screen.places.texture(), 0), (screen.depths.texture(), PLACE_BYTES)];
        let device = &self.renderer.device;
        let host = device.buffer(
            "a sample",
            DEPTH_BYTES + PLACE_BYTES,
            BufferUsages::MAP_READ | BufferUsages::COPY_DST,
        )?;
        let submission = device.scoped("Queue::submit", || {
            let mut encoder = device.device().create_command_encoder(&Default::default());
            for (texture, offset) in texels {
                let origin = Origin3d { x, y, z: 0 };
                encoder.copy_texture_to_buffer(
                    wgpu::TexelCopyTextureInfo { texture, mip_level: 0, origin, aspect: TextureAspect::All },
                    TexelCopyBufferInfo {
                        buffer: &host,
                        layout: TexelCopyBufferLayout { offset, ..Default::default() },
                    },
                    Extent3d { width: 1, height: 1, depth_or_array_layers: 1 },
                );
            }
            let submission = device.queue().submit([encoder.finish()]);
            host.map_async(wgpu::MapMode::Read, .., |_| ());
            submission
        })?;
        device.wait(submission)?;
        let [yarn, _, depth] = read_mapped(device, &host, |bytes| {
            [0, 1, 2].map(|word| bytemuck::pod_read_unaligned::<u32>(&bytes[4 * word..4 * word + 4]))
        })?;
        let depth = f32::from_bits(depth);
        if depth >= 1.0 {
            return Ok(None);
        }
        let middle = |pixel: u32, size: u32| (f64::from(pixel) + 0.5) / f64::from(size) * 2.0 - 1.0;
        let clip = DVec3::new(middle(x, large[0]), -middle(y, large[1]), f64::from(depth));
        let local = camera.clip_from_local().inverse().project_point3(clip);
        let position = (local + camera.target.as_dvec3()).to_array();
        Ok(Some(Seen { yarn: (yarn & !MARKS) as usize, position }))
    }
}
