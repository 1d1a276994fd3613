//! A fabric on the device, and pictures of it.

use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::Vec3;
use texere_core::{
    Chunk, ControlPoint, Limits, Plan, SessionError, Settings, Settler, Topology, Traffic, Yarns,
};
use texere_wgpu::WgpuSession;
use wgpu::{BindingResource, BufferUsages};

use crate::screen::Screen;
use crate::sieve::Sieve;
use crate::uniform::{ViewUniform, YarnLook};
use crate::{Background, Camera, Extent, RenderError, Renderer};

/// Memory for two chunks of mesh, bytes: enough to keep any device busy, little beside the memory of pictures.
const CHUNK_MEMORY: u64 = 128 << 20;

// The list of one chunk's triangles is a single binding.
const _: () = assert!(Sieve::list_bytes(CHUNK_MEMORY / 2) <= 128 << 20);

/// The quality of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Quality {
    /// Pixels of the screen for a pixel of the picture, each way. Each has four samples, whatever this is.
    pub supersampling: u32,
}

impl Default for Quality {
    /// Four pixels of the screen, sixteen samples, for a pixel of the picture.
    fn default() -> Self {
        Self { supersampling: 2 }
    }
}

/// A picture in host memory.
#[derive(Debug, Clone)]
pub struct Picture {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// Red, green and blue, a byte each, sRGB; rows from the top.
    pub rgb: Vec<u8>,
    /// How much of each pixel shows a yarn or a background, a byte, 255 for all of it: less only with [`Background::Nothing`]. Colours are
    /// not multiplied with it.
    pub alpha: Vec<u8>,
    /// How long it took.
    pub timings: PictureTimings,
}

impl Picture {
    /// Red, green, blue and alpha, a byte each.
    #[must_use]
    pub fn rgba(&self) -> Vec<u8> {
        let pixels = self.rgb.chunks_exact(3).zip(&self.alpha);
        pixels.flat_map(|(rgb, &alpha)| [rgb[0], rgb[1], rgb[2], alpha]).collect()
    }
}

/// Time that a picture took, stage by stage, one after the other.
#[derive(Debug, Clone, Copy, Default)]
pub struct PictureTimings {
    /// Textures of its size, where the picture before had another.
    pub screen: Duration,
    /// Meshing and drawing, chunk after chunk.
    pub draw: Duration,
    /// Visibility, light, and the copy to the host.
    pub shade: Duration,
}

/// A fabric on a device: control points and tables. Its mesh is made anew, chunk by chunk, for each picture. Whatever the
/// fabric, only two chunks and one chunk's list of visible triangles are in memory, 214 MiB together.
#[derive(Debug)]
pub struct Scene {
    renderer: Renderer,
    plan: Arc<Plan>,
    limits: Limits,
    session: WgpuSession,
    extent: Extent,
    /// For each yarn, the mean length from ring to ring, mm.
    ring_lengths: Vec<f32>,
    looks: wgpu::Buffer,
    sieve: Sieve,
    view: wgpu::Buffer,
    background: Background,
    screen: Option<Screen>,
}

impl Renderer {
    /// Sends a fabric to the device, or several: [`Yarns::placed`] says where each is, [`Yarns::merged`] makes one of them. The settings' topology and caps are ignored: pictures list their own triangles, and
    /// show yarns solid, also where they end or are cut.
    ///
    /// **Errors**: [`RenderError::Plan`], [`RenderError::Backend`].
    pub fn scene(&self, yarns: &Yarns, settings: &Settings) -> Result<Scene, RenderError> {
        self.scene_of(yarns, settings, Extent::of(yarns), |session| session.upload(0, yarns.points()))
    }

    /// The same for `yarns` where a settler has left them: on this renderer's device they don't leave it.
    ///
    /// **Errors**: those of [`Renderer::scene`], and [`RenderError::Backend`] for a settler of other yarns.
    pub fn settled_scene(
        &self,
        yarns: &Yarns,
        settings: &Settings,
        settler: &mut dyn Settler,
    ) -> Result<Scene, RenderError> {
        let extent = Extent::settled(yarns, settler)?;
        self.scene_of(yarns, settings, extent, |session| session.take_settled(settler))
    }

    /// A scene whose session gets its control points from `send`.
    fn scene_of(
        &self,
        yarns: &Yarns,
        settings: &Settings,
        extent: Extent,
        send: impl FnOnce(&mut WgpuSession) -> Result<(), SessionError>,
    ) -> Result<Scene, RenderError> {
        let settings = Settings { topology: Topology::None, caps: true, ..*settings };
        let plan = Arc::new(Plan::new(yarns.layout().clone(), settings)?);
        let limits = chunk_limits(&plan).min(&self.info().limits);
        let mut session = self.device.lending_session(plan.clone())?;
        send(&mut session)?;
        session.scan()?;
        let buffer = |what, bytes: &[u8], usage| self.filled(what, bytes, usage);
        Ok(Scene {
            renderer: self.clone(),
            session,
            extent,
            ring_lengths: ring_lengths(yarns, &plan),
            looks: buffer("looks", bytemuck::cast_slice(&YarnLook::all(yarns)), BufferUsages::STORAGE)?,
            sieve: Sieve::new(self)?,
            view: buffer("view", &[0; size_of::<ViewUniform>()], BufferUsages::UNIFORM)?,
            background: Background::Ground,
            screen: None,
            limits,
            plan,
        })
    }
}

impl Scene {
    /// Bytes that went between host and device so far, but for the pictures themselves.
    #[must_use]
    pub fn traffic(&self) -> Traffic {
        self.session.traffic()
    }

    /// The fabric's bounding box.
    #[must_use]
    pub const fn extent(&self) -> &Extent {
        &self.extent
    }

    /// The plan that its mesh is made from.
    #[must_use]
    pub const fn plan(&self) -> &Arc<Plan> {
        &self.plan
    }

    /// Cuts chunks to `limits` where the scene's own are wider.
    #[must_use]
    pub fn with_limits(self, limits: &Limits) -> Self {
        Self { limits: self.limits.min(limits), ..self }
    }

    /// What its pictures have from now on where no yarn is; at first ground.
    pub fn set_background(&mut self, background: Background) {
        self.background = background;
    }

    /// Makes a picture.
    ///
    /// **Errors**: [`RenderError::Size`] or [`RenderError::Supersampling`] for one that the device has no textures for,
    /// [`RenderError::Plan`] where not even one block fits the limits, [`RenderError::Backend`].
    pub fn picture(&mut self, camera: &Camera, quality: Quality) -> Result<Picture, RenderError> {
        let (size, supersampling) = (camera.size(), quality.supersampling);
        self.check_size(size, supersampling)?;
        let start = Instant::now();
        let device = &self.renderer.device;
        if self.screen.as_ref().is_none_or(|screen| !screen.fits(size, supersampling)) {
            self.screen = None;
            self.screen = Some(Screen::new(device, size, supersampling)?);
        }
        let view = ViewUniform::new(camera, self.background, supersampling, self.plan.settings().sides);
        self.renderer.write(&self.view, bytemuck::bytes_of(&view))?;
        let screened = Instant::now();
        self.draw(camera)?;
        let drawn = Instant::now();
        let [rgb, alpha] = self.shade()?;
        let timings =
            PictureTimings { screen: screened - start, draw: drawn - screened, shade: drawn.elapsed() };
        Ok(Picture { size, rgb, alpha, timings })
    }

    fn check_size(&self, [width, height]: [u32; 2], supersampling: u32) -> Result<(), RenderError> {
        let limit = self.renderer.side_limit();
        if width.min(height) == 0 || width.max(height) > limit {
            return Err(RenderError::Size { width, height, limit });
        }
        let most = limit / width.max(height);
        if !(1..=most).contains(&supersampling) {
            return Err(RenderError::Supersampling { supersampling, most, width, height, limit });
        }
        Ok(())
    }

    /// Meshes and draws chunk after chunk. While one is drawn the next is made.
    fn draw(&mut self, camera: &Camera) -> Result<(), RenderError> {
        let plan = self.plan.clone();
        let mut before = None;
        for chunk in plan.chunks(&self.limits)? {
            self.session.mesh(&chunk)?;
            let drawn = self.draw_chunk(&chunk, camera)?;
            // No more than two chunks are under way, so that each wait is for a chunk and not for a fabric.
            if let Some(submission) = before.replace(drawn) {
                self.renderer.device.wait(submission)?;
            }
        }
        match before {
            Some(submission) => Ok(self.renderer.device.wait(submission)?),
            None => Ok(()),
        }
    }

    /// Lists the triangles that may be seen, and draws them.
    fn draw_chunk(&mut self, chunk: &Chunk, camera: &Camera) -> Result<wgpu::SubmissionIndex, RenderError> {
        let renderer = &self.renderer;
        self.sieve.fill(renderer, &self.plan, chunk, &self.ring_lengths)?;
        let vertices = self.session.vertex_buffer(chunk)?.as_entire_binding();
        let [runs, triangles] = self.sieve.bindings();
        let listed = [self.view.as_entire_binding(), vertices, runs, triangles];
        let drawn = renderer.bind(&renderer.layouts.yarns, &listed)?;
        let all = [&listed[..], &[self.sieve.draw.as_entire_binding()]].concat();
        let sieved = renderer.bind(&renderer.layouts.sieve, &all)?;
        let device = &renderer.device;
        let submission = device.scoped("Queue::submit", || {
            let mut encoder = device.device().create_command_encoder(&Default::default());
            {
                let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
                pass.set_pipeline(&renderer.sieve);
                pass.set_bind_group(0, &sieved, &[]);
                let (columns, rows) = self.sieve.groups();
                pass.dispatch_workgroups(columns, rows, 1);
            }
            if let Some(screen) = &self.screen {
                let mut pass = screen.yarn_pass(&mut encoder, chunk.index() == 0);
                pass.set_pipeline(if camera.sees_inside() {
                    &renderer.all_sides
                } else {
                    &renderer.outsides
                });
                pass.set_bind_group(0, &drawn, &[]);
                pass.draw_indirect(&self.sieve.draw, 0);
            }
            device.queue().submit([encoder.finish()])
        })?;
        Ok(submission)
    }

    /// Visibility, then light, then the copy to the host.
    fn shade(&self) -> Result<[Vec<u8>; 2], RenderError> {
        let (renderer, Some(screen)) = (&self.renderer, &self.screen) else {
            return Ok([Vec::new(), Vec::new()]);
        };
        let view = |view| BindingResource::TextureView(view);
        let kept = [
            self.view.as_entire_binding(),
            view(&screen.depths),
            view(&screen.directions),
            view(&screen.places),
        ];
        let seen = renderer.bind(&renderer.layouts.visibility, &kept)?;
        let all = [&kept[..], &[view(&screen.visibility), self.looks.as_entire_binding()]].concat();
        let lit = renderer.bind(&renderer.layouts.shade, &all)?;
        let device = &renderer.device;
        let submission = device.scoped("Queue::submit", || {
            let mut encoder = device.device().create_command_encoder(&Default::default());
            Screen::fill(&mut encoder, &screen.visibility, &renderer.visibility, &seen);
            Screen::fill(&mut encoder, &screen.color, &renderer.shade, &lit);
            screen.copy(&mut encoder);
            let submission = device.queue().submit([encoder.finish()]);
            screen.map();
            submission
        })?;
        device.wait(submission)?;
        Ok(screen.take(device)?)
    }
}

/// The limits that chunks of a picture's mesh are cut to, on any device.
///
/// ```
/// # use texere_core::{ControlPoint, Plan, Settings, Yarn, Yarns};
/// # let mut yarns = Yarns::builder();
/// # yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
/// let plan = Plan::new(yarns.build()?.layout().clone(), Settings::default())?;
/// assert_eq!(plan.chunks(&texere_render::chunk_limits(&plan))?.count(), 1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn chunk_limits(plan: &Plan) -> Limits {
    Limits { memory_bytes: plan.resident_bytes() + CHUNK_MEMORY, ..Limits::NONE }
}

/// The mean length from ring to ring of each yarn, mm, by its first control points: it only places the fibres' pattern.
fn ring_lengths(yarns: &Yarns, plan: &Plan) -> Vec<f32> {
    const POINTS: usize = 64;
    let per_interval = plan.settings().subdivisions as f32 + 1.0;
    let mean = |yarn| {
        let points = yarns.yarn_points(yarn).unwrap_or_default();
        let points = &points[..points.len().min(POINTS)];
        let place = |point: &ControlPoint| Vec3::new(point.x, point.y, point.z);
        let length: f32 = points.windows(2).map(|pair| place(&pair[0]).distance(place(&pair[1]))).sum();
        length / (points.len().max(2) - 1) as f32 / per_interval
    };
    (0..yarns.layout().yarns().len()).map(mean).collect()
}
