//! What a whole picture shows, pixel by pixel, as numbers.

use std::f32::consts::TAU;
use std::ops::ControlFlow;

use glam::{DVec3, Vec2, Vec3};
use rayon::prelude::*;
use wgpu::{BufferUsages, Extent3d, Origin3d, TexelCopyBufferInfo, TexelCopyBufferLayout, TextureAspect};

use crate::mapped::read_mapped;
use crate::screen::Screen;
use crate::seen::{DEPTH_BYTES, MARKS, PLACE_BYTES};
use crate::watch::Watch;
use crate::{Camera, Quality, RenderError, Scene};

/// What a picture shows in each pixel, row by row from the top. A pixel has the values of one
/// sample, which lies within half a pixel of the pixel's middle: the first sample of the screen
/// pixel that holds the middle. [`Scene::seen_at`] takes the same sample.
///
/// Where no yarn is seen, the yarn is [`Layers::NO_YARN`]. The depth is infinite there, and all
/// other values are 0.
#[derive(Debug, Clone, PartialEq)]
pub struct Layers {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// The number of the yarn, counted from 0.
    pub yarn: Vec<u32>,
    /// The distance along a line of sight ([`Camera::ray`]), from where the line begins, mm. The
    /// line goes through the middle of the screen pixel that holds the sample.
    pub depth: Vec<f32>,
    /// The place on the yarn's surface, mm.
    pub position: Vec<[f32; 3]>,
    /// The unit normal, out of the yarn. Where a yarn is cut open, the normal faces the eye, and on
    /// caps it points out of the yarn's end.
    pub normal: Vec<[f32; 3]>,
    /// The direction of the yarn's fibres along its surface, of length 1, towards the yarn's end.
    /// Fibres turn with the twist. On caps, and where a yarn is cut open, the tangent is equal to
    /// the normal.
    pub tangent: Vec<[f32; 3]>,
    /// The place on the yarn: the angle round it and the distance along it. The angle is in
    /// radians, and counted as in [`Attribute::angle`](texere_core::Attribute). The distance is in
    /// rings of the scene's mesh, in steps of an eighth of a ring, and begins again at 0 after
    /// 8,192 rings. Both are 0 on single fibres and on caps. Where a yarn is cut open, they are the
    /// place on its far wall.
    pub uv: Vec<[f32; 2]>,
}

/// The bytes of a sample's directions.
const DIRECTION_BYTES: u64 = 8;

/// The most bytes that are copied to the host at once: more than a hundred rows of a picture that
/// is 16,384 screen pixels wide.
const COPY_MOST: u64 = 64 << 20;

/// The values of one pixel in all layers, in the order of the fields of [`Layers`].
type Pixel = (u32, f32, [f32; 3], [f32; 3], [f32; 3], [f32; 2]);

impl Layers {
    /// The number that [`Layers::yarn`] has where no yarn is seen.
    pub const NO_YARN: u32 = u32::MAX;

    fn of([width, height]: [u32; 2], pixels: Vec<Pixel>) -> Self {
        Self {
            size: [width, height],
            yarn: pixels.iter().map(|pixel| pixel.0).collect(),
            depth: pixels.iter().map(|pixel| pixel.1).collect(),
            position: pixels.iter().map(|pixel| pixel.2).collect(),
            normal: pixels.iter().map(|pixel| pixel.3).collect(),
            tangent: pixels.iter().map(|pixel| pixel.4).collect(),
            uv: pixels.iter().map(|pixel| pixel.5).collect(),
        }
    }
}

impl Scene {
    /// What the last picture shows in each pixel. None before the first picture, and after one that
    /// was stopped.
    ///
    /// ```no_run
    /// # fn example(scene: &mut texere_render::Scene) -> Result<(), texere_render::RenderError> {
    /// use texere_render::{Camera, Layers, Quality};
    /// let camera = Camera::face(scene.extent(), [800, 600]);
    /// scene.picture(&camera, Quality { supersampling: 1, hairs: false })?;
    /// let Some(layers) = scene.layers()? else { return Ok(()) };
    /// println!("{} pixels show yarn", layers.yarn.iter().filter(|yarn| **yarn != Layers::NO_YARN).count());
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// **Errors**: [`RenderError::Backend`].
    pub fn layers(&self) -> Result<Option<Layers>, RenderError> {
        let (Some(camera), Some(screen)) = (&self.camera, &self.screen) else { return Ok(None) };
        let [width, height] = screen.size();
        let row = Row::of(screen);
        let rows = (COPY_MOST / row.bytes()).max(1).min(u64::from(height)) as u32;
        let mut pixels = Vec::with_capacity(width as usize * height as usize);
        for first in (0..height).step_by(rows as usize) {
            let count = rows.min(height - first);
            self.copy_rows(screen, &row, first, count, |bytes| {
                let lines = bytes.par_chunks_exact(row.bytes() as usize).zip(first..first + count);
                let line = |(bytes, y): (&[u8], u32)| {
                    (0..width).map(move |x| row.pixel(camera, bytes, [x, y])).collect::<Vec<_>>()
                };
                pixels.par_extend(lines.flat_map_iter(line));
            })?;
        }
        Ok(Some(Layers::of([width, height], pixels)))
    }

    /// What a view shows in each pixel. No picture is made, so nothing is lit. Pixels are not
    /// supersampled, and single fibres are left out. `progress` gets the share of the work done, as
    /// in [`Scene::picture_with_progress`].
    ///
    /// **Errors**: the errors of [`Scene::picture_with_progress`].
    pub fn view_layers(
        &mut self,
        camera: &Camera,
        mut progress: impl FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Layers, RenderError> {
        let watch = &mut Watch::new(&mut progress);
        self.ready(watch)?;
        self.look(camera, Quality { supersampling: 1, hairs: false })?;
        self.drawn(watch, |_, _| Ok(()))?;
        Ok(self.layers()?.unwrap_or_else(|| Layers::of([0; 2], Vec::new())))
    }

    /// Copies the samples of `count` rows of the picture to the host, and passes them to `take`.
    fn copy_rows(
        &self,
        screen: &Screen,
        row: &Row,
        first: u32,
        count: u32,
        take: impl FnOnce(&[u8]),
    ) -> Result<(), RenderError> {
        let device = &self.renderer.device;
        let usage = BufferUsages::MAP_READ | BufferUsages::COPY_DST;
        let host = device.buffer("rows of samples", row.bytes() * u64::from(count), usage)?;
        let submission = device.scoped("Queue::submit", || {
            let mut encoder = device.device().create_command_encoder(&Default::default());
            for number in 0..count {
                let origin = Origin3d { x: 0, y: row.large_of(first + number), z: 0 };
                for (texture, part) in [&screen.places, &screen.directions, &screen.depths].iter().zip(0..) {
                    encoder.copy_texture_to_buffer(
                        wgpu::TexelCopyTextureInfo {
                            texture: texture.texture(),
                            mip_level: 0,
                            origin,
                            aspect: TextureAspect::All,
                        },
                        TexelCopyBufferInfo {
                            buffer: &host,
                            layout: TexelCopyBufferLayout {
                                offset: row.bytes() * u64::from(number) + row.start(part),
                                ..Default::default()
                            },
                        },
                        Extent3d { width: row.large, height: 1, depth_or_array_layers: 1 },
                    );
                }
            }
            let submission = device.queue().submit([encoder.finish()]);
            host.map_async(wgpu::MapMode::Read, .., |_| ());
            submission
        })?;
        device.wait(submission)?;
        Ok(read_mapped(device, &host, take)?)
    }
}

/// The layout of a row of screen pixels in the copy, each with its first sample. A row has three
/// parts: all places, then all directions, then all depths.
#[derive(Debug, Clone, Copy)]
struct Row {
    /// The number of screen pixels of a row.
    large: u32,
    /// The number of screen pixels across a pixel of the picture.
    supersampling: u32,
}

impl Row {
    fn of(screen: &Screen) -> Self {
        Self { large: screen.large()[0], supersampling: screen.large()[0] / screen.size()[0] }
    }

    /// The byte of a row at which part number `part` begins. A sample's place and its directions
    /// take two words of 4 bytes each, its depth one.
    fn start(&self, part: u64) -> u64 {
        u64::from(self.large) * [0, PLACE_BYTES, PLACE_BYTES + DIRECTION_BYTES][part as usize]
    }

    /// The bytes of a row, with padding, because copies of samples begin at multiples of 8 bytes.
    fn bytes(&self) -> u64 {
        (u64::from(self.large) * (PLACE_BYTES + DIRECTION_BYTES + DEPTH_BYTES)).next_multiple_of(8)
    }

    /// The pixel of the screen, in a row or a column, that stands for a pixel of the picture.
    fn large_of(&self, pixel: u32) -> u32 {
        pixel * self.supersampling + self.supersampling / 2
    }

    /// A pixel of the picture from the bytes of its row.
    fn pixel(&self, camera: &Camera, bytes: &[u8], [x, y]: [u32; 2]) -> Pixel {
        let column = self.large_of(x) as usize;
        let word = |part, words: usize, number: usize| {
            let at = self.start(part) as usize + 4 * (column * words + number);
            bytemuck::pod_read_unaligned::<u32>(&bytes[at..at + 4])
        };
        let depth = f32::from_bits(word(2, 1, 0));
        if depth >= 1.0 {
            return (Layers::NO_YARN, f32::INFINITY, [0.0; 3], [0.0; 3], [0.0; 3], [0.0; 2]);
        }
        // The middle of the screen pixel, in pixels of the picture.
        let [right, down] =
            [x, y].map(|pixel| (f64::from(self.large_of(pixel)) + 0.5) / f64::from(self.supersampling));
        let [width, height] = camera.size().map(f64::from);
        let clip = DVec3::new(right / width * 2.0 - 1.0, 1.0 - down / height * 2.0, f64::from(depth));
        let local = camera.clip_from_local().inverse().project_point3(clip);
        let position = local + camera.target.as_dvec3();
        let sight = camera.ray([right as f32, down as f32]);
        let away = (position - DVec3::from(sight.origin)).dot(DVec3::from(sight.direction));
        let [angle, along] = [word(0, 2, 1) & 0xffff, word(0, 2, 1) >> 16];
        (
            word(0, 2, 0) & !MARKS,
            away as f32,
            position.as_vec3().to_array(),
            direction(word(1, 2, 0)),
            direction(word(1, 2, 1)),
            [angle as f32 * (TAU / 65_535.0), along as f32 / 8.0],
        )
    }
}

/// Unpacks a direction, as `from_octahedron` of `view.wgsl` does.
fn direction(packed: u32) -> [f32; 3] {
    let flat = Vec2::new((packed & 0xffff) as f32, (packed >> 16) as f32) / 65_535.0 * 2.0 - 1.0;
    let z = 1.0 - flat.x.abs() - flat.y.abs();
    let sign = |value: f32| if value < 0.0 { -1.0 } else { 1.0 };
    let turned = Vec2::new((1.0 - flat.y.abs()) * sign(flat.x), (1.0 - flat.x.abs()) * sign(flat.y));
    let across = if z >= 0.0 { flat } else { turned };
    Vec3::new(across.x, across.y, z).normalize().to_array()
}
