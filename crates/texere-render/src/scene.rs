//! A fabric on the device, and pictures of it.

use std::borrow::Borrow;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::Vec3;
use texere_core::backend::{Chunk, Plan, Traffic};
use texere_core::settling::Settler;
use texere_core::{ControlPoint, DeviceKind, Limits, PlanError, Settings, Topology, Yarns};
use texere_wgpu::{PARAMETERS, WgpuSession};
use wgpu::{BindingResource, BufferUsages};

use crate::raster::Raster;
use crate::rasteriser::group;
use crate::screen::{SCREEN_GROUP, Screen};
use crate::uniform::{ViewUniform, YarnLook};
use crate::watch::Watch;
use crate::{Background, Camera, Extent, RenderError, Renderer};

/// The number of chunks whose tables a session keeps on the device.
const CHUNKS_KEPT: usize = 2;

/// The number of control points that are sent at once: 16 MB. Before the next ones are sent, the
/// progress callback can stop the work.
const UPLOAD_POINTS: usize = 1 << 20;

/// The progress, from 0 to 1, that callbacks get when all chunks are drawn, and when the picture is
/// lit. Nothing else depends on these numbers.
const DRAWN: f64 = 0.7;
const LIT: f64 = 0.9;

/// The quality of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Quality {
    /// A picture is made from a screen that is this many times as wide and as high as the picture.
    /// Each pixel of the screen has four samples.
    pub supersampling: u32,
    /// Whether fibres that stand off yarns are drawn. They are drawn if threads are four pixels
    /// wide or more, and never with [`Camera::cut`].
    pub hairs: bool,
}

impl Default for Quality {
    /// Four pixels of the screen, and thus sixteen samples, for each pixel of the picture; with
    /// fibres.
    fn default() -> Self {
        Self { supersampling: 2, hairs: true }
    }
}

/// The number of sides of tubes in a picture of woven cloth at rest.
const FINE_SIDES: u32 = 16;

/// The most control points of woven cloth at rest that is drawn with [`FINE_SIDES`]. Threads of
/// larger cloths are hardly wider than pixels.
const FINE_POINTS: usize = 4_000_000;

/// The default number of sides of tubes in a picture. If a yarn's section is a polygon, the default
/// is the number of the polygon's corners. `lies_close` is whether the yarns are flattened threads
/// of woven cloth at rest. These get more sides than others, unless the cloth is so large that its
/// threads are hardly wider than pixels. They lie so close that with fewer sides the ground would
/// show past their corners.
///
/// **Units**: sides of a section, as in [`Settings::sides`].
#[must_use]
pub fn picture_sides(yarns: &Yarns, lies_close: bool) -> u32 {
    let usual = if lies_close && yarns.points().len() <= FINE_POINTS {
        FINE_SIDES
    } else {
        Settings::default().sides
    };
    yarns.layout().corners().unwrap_or(usual)
}

/// A picture in host memory.
#[derive(Debug, Clone)]
pub struct Picture {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// Red, green and blue, a byte each, sRGB. The rows go from the top down.
    pub rgb: Vec<u8>,
    /// The share of each pixel that shows a yarn or a background, a byte: 255 is all of the pixel.
    /// It is less only with [`Background::Nothing`]. Colours are not multiplied by it.
    pub alpha: Vec<u8>,
    /// The time that each stage of the picture took.
    pub timings: PictureTimings,
}

impl Picture {
    /// The picture's red, green, blue and alpha, a byte each.
    #[must_use]
    pub fn rgba(&self) -> Vec<u8> {
        let pixels = self.rgb.chunks_exact(3).zip(&self.alpha);
        pixels.flat_map(|(rgb, &alpha)| [rgb[0], rgb[1], rgb[2], alpha]).collect()
    }
}

/// The time that each stage of a picture took. A stage begins when the stage before it has ended.
#[derive(Debug, Clone, Copy, Default)]
pub struct PictureTimings {
    /// The time before drawing: for allocating textures, if the picture before had another size,
    /// and for compiling the shader of light, if it was not used before.
    pub screen: Duration,
    /// The time for finding what each sample shows, chunk after chunk.
    pub draw: Duration,
    /// The time for working out visibility (ambient occlusion and shadows) and light.
    pub shade: Duration,
    /// The time for the copy to the host.
    pub copy: Duration,
}

/// A fabric on a device, as control points and tables. A picture needs no mesh. It needs memory for
/// its samples: eight bytes for the nearest triangle of each sample, and 25 bytes for what the
/// sample shows and for its light. The renderer keeps that memory for the next scene.
#[derive(Debug)]
pub struct Scene {
    pub(crate) renderer: Renderer,
    pub(crate) plan: Arc<Plan>,
    pub(crate) session: WgpuSession,
    limits: Limits,
    /// All chunks, if they are few enough to stay in the session; otherwise none.
    chunks: Vec<Chunk>,
    extent: Extent,
    looks: wgpu::Buffer,
    raster: Raster,
    pub(crate) view: wgpu::Buffer,
    background: Background,
    pub(crate) screen: Option<Arc<Screen>>,
    /// Whether the last picture was lit without ambient occlusion and shadows
    /// ([`ViewUniform::is_far`]).
    is_far: bool,
    /// The camera of the last picture.
    pub(crate) camera: Option<Camera>,
    /// The submission that the device may still work on after a picture was stopped.
    under_way: Option<wgpu::SubmissionIndex>,
}

/// A picture that stays on the device, made by [`Scene::frame`].
#[derive(Debug, Clone)]
pub struct DevicePicture {
    /// Red, green, blue and alpha, a byte each, to be sampled or copied. Values are sRGB, though
    /// the format is [`wgpu::TextureFormat::Rgba8Unorm`]. The texture is lent: the scene's next
    /// picture of the same size is drawn into it. After the scene is dropped, another scene of the
    /// renderer may use it.
    pub texture: wgpu::TextureView,
    /// The time that each stage of the picture took. The time for the copy is zero.
    pub timings: PictureTimings,
}

impl Renderer {
    /// Sends a fabric to the device. To show several fabrics, put them into one: [`Yarns::placed`]
    /// sets where each is, and [`Yarns::merged`] joins them. The settings' topology and caps are
    /// ignored: pictures list their own triangles, and show yarns as solid where they end or are
    /// cut. [`Settings::following_fibres`] gives enough rings for the yarns' twist.
    ///
    /// **Errors**: [`RenderError::Plan`], [`RenderError::Backend`].
    pub fn scene(&self, yarns: &Yarns, settings: &Settings) -> Result<Scene, RenderError> {
        self.watched_scene(yarns, settings, &mut Watch::none())
    }

    /// Sends a fabric to the device as [`Renderer::scene`] does. `progress` gets the share of the
    /// control points that are sent, from 0 to 1. If it returns `Break`, no more are sent.
    ///
    /// **Errors**: those of [`Renderer::scene`], and [`RenderError::Cancelled`].
    pub fn scene_with_progress(
        &self,
        yarns: &Yarns,
        settings: &Settings,
        mut progress: impl FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Scene, RenderError> {
        self.watched_scene(yarns, settings, &mut Watch::new(&mut progress))
    }

    fn watched_scene(
        &self,
        yarns: &Yarns,
        settings: &Settings,
        watch: &mut Watch<'_>,
    ) -> Result<Scene, RenderError> {
        watch.tell(0.0)?;
        let (points, extent) = (yarns.points(), Extent::of(yarns));
        self.scene_of(yarns, settings, extent, watch, |session, watch| {
            let mut first = 0;
            for piece in points.chunks(UPLOAD_POINTS) {
                session.upload(first, piece)?;
                first += piece.len() as u64;
                watch.tell(first as f64 / points.len() as f64)?;
            }
            Ok(())
        })
    }

    /// A scene that shows `yarns` in the places to which `settler` has moved them. If the settler
    /// is on this renderer's device, the places do not go through the host. Which yarns are
    /// [steep](texere_core::Layout::is_steep), and how outlines [lean](texere_core::Layout::ups),
    /// remains as in `yarns`.
    ///
    /// **Errors**: those of [`Renderer::scene`], and [`RenderError::Backend`] for a settler of
    /// other yarns.
    pub fn settled_scene(
        &self,
        yarns: &Yarns,
        settings: &Settings,
        settler: &mut dyn Settler,
    ) -> Result<Scene, RenderError> {
        let extent = Extent::settled(yarns, settler)?;
        let watch = &mut Watch::none();
        self.scene_of(yarns, settings, extent, watch, |session, _| Ok(session.take_settled(settler)?))
    }

    /// A scene whose session gets its control points from `send`.
    fn scene_of(
        &self,
        yarns: &Yarns,
        settings: &Settings,
        extent: Extent,
        watch: &mut Watch<'_>,
        send: impl FnOnce(&mut WgpuSession, &mut Watch<'_>) -> Result<(), RenderError>,
    ) -> Result<Scene, RenderError> {
        watch.tell(0.0)?;
        let settings = Settings { topology: Topology::None, caps: true, ..*settings };
        let plan = Arc::new(Plan::new(yarns.layout().clone(), settings)?);
        watch.tell(0.0)?;
        let mut session = self.device.lending_session(plan.clone())?;
        watch.tell(0.0)?;
        let limits = Raster::chunk_limits(&plan, yarns, self.info());
        let mut chunks = Ok(Vec::new());
        // Chunks are cut while points are sent.
        rayon::in_place_scope(|scope| {
            scope.spawn(|_| chunks = kept_chunks(&plan, &limits));
            send(&mut session, watch)?;
            let mut asked = Ok(());
            let _ = session.scan_watched(&mut || {
                asked = watch.ask();
                if asked.is_ok() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
            })?;
            asked
        })?;
        watch.ask()?;
        let buffer = |what, bytes: &[u8], usage| self.filled(what, bytes, usage);
        let view = buffer("view", &[0; size_of::<ViewUniform>()], PARAMETERS)?;
        Ok(Scene {
            renderer: self.clone(),
            session,
            extent,
            looks: buffer(
                "looks",
                bytemuck::cast_slice(&YarnLook::all(yarns, &ring_lengths(yarns, &plan))),
                BufferUsages::STORAGE,
            )?,
            raster: Raster::new(self, view.clone(), &plan, yarns)?,
            view,
            background: Background::Ground,
            screen: None,
            is_far: false,
            camera: None,
            under_way: None,
            chunks: chunks?,
            limits,
            plan,
        })
    }
}

impl Scene {
    /// The bytes sent between host and device so far, without the pictures themselves.
    #[must_use]
    pub fn traffic(&self) -> Traffic {
        self.session.traffic()
    }

    /// The fabric's bounding box.
    #[must_use]
    pub const fn extent(&self) -> &Extent {
        &self.extent
    }

    /// The plan of the fabric's mesh.
    #[must_use]
    pub const fn plan(&self) -> &Arc<Plan> {
        &self.plan
    }

    /// This scene with chunks cut to `limits`, if the scene's own are wider.
    #[cfg(test)]
    pub(crate) fn with_limits(self, limits: &Limits) -> Self {
        let limits = self.limits.min(limits);
        // If no block fits the limits, making a picture is an error.
        Self { chunks: kept_chunks(&self.plan, &limits).unwrap_or_default(), limits, ..self }
    }

    /// Sets the background of pictures from now on. At first it is [`Background::Ground`].
    pub fn set_background(&mut self, background: Background) {
        self.background = background;
    }

    /// Makes a picture.
    ///
    /// **Errors**: [`RenderError::Size`] or [`RenderError::Supersampling`] for a picture that is
    /// empty or too large for the device's textures, or supersampled 0 times; [`RenderError::Plan`]
    /// if not even one block fits the limits, [`RenderError::Backend`].
    pub fn picture(&mut self, camera: &Camera, quality: Quality) -> Result<Picture, RenderError> {
        self.watched_picture(camera, quality, &mut Watch::none())
    }

    /// Makes a picture as [`Scene::picture`] does. `progress` gets the share of the work done, from
    /// 0 to 1, and is called every ten milliseconds while the device works. `Break` ends the wait.
    /// The device finishes what it has begun, and the next picture waits for that.
    ///
    /// **Errors**: those of [`Scene::picture`], and [`RenderError::Cancelled`].
    pub fn picture_with_progress(
        &mut self,
        camera: &Camera,
        quality: Quality,
        mut progress: impl FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Picture, RenderError> {
        self.watched_picture(camera, quality, &mut Watch::new(&mut progress))
    }

    fn watched_picture(
        &mut self,
        camera: &Camera,
        quality: Quality,
        watch: &mut Watch<'_>,
    ) -> Result<Picture, RenderError> {
        let timings = self.watched_frame(camera, quality, watch)?.timings;
        let start = Instant::now();
        let [rgb, alpha] = self.copy()?;
        let timings = PictureTimings { copy: start.elapsed(), ..timings };
        Ok(Picture { size: camera.size(), rgb, alpha, timings })
    }

    /// Makes a picture and leaves it on the device, for a window that shows it. The picture is
    /// finished when this returns.
    ///
    /// **Errors**: those of [`Scene::picture`].
    pub fn frame(&mut self, camera: &Camera, quality: Quality) -> Result<DevicePicture, RenderError> {
        self.watched_frame(camera, quality, &mut Watch::none())
    }

    fn watched_frame(
        &mut self,
        camera: &Camera,
        quality: Quality,
        watch: &mut Watch<'_>,
    ) -> Result<DevicePicture, RenderError> {
        self.ready(watch)?;
        let start = Instant::now();
        let texture = self.look(camera, quality)?;
        let screened = Instant::now();
        let drawn = self.drawn(watch, |scene, watch| scene.shade(watch))?;
        let timings = PictureTimings {
            screen: screened - start,
            draw: drawn - screened,
            shade: drawn.elapsed(),
            copy: Duration::ZERO,
        };
        Ok(DevicePicture { texture, timings })
    }

    /// Waits for what the device still works on after a picture that was stopped.
    pub(crate) fn ready(&mut self, watch: &mut Watch<'_>) -> Result<(), RenderError> {
        watch.tell(0.0)?;
        if let Some(submission) = self.under_way.clone() {
            watch.wait(&self.renderer.device, &submission)?;
            self.under_way = None;
        }
        Ok(())
    }

    /// Draws all chunks, then does what comes `after`. Returns the time at which all chunks were
    /// drawn. After an error, [`Scene::seen_at`] finds nothing at any point, since the picture is
    /// not finished.
    pub(crate) fn drawn(
        &mut self,
        watch: &mut Watch<'_>,
        after: impl FnOnce(&Self, &mut Watch<'_>) -> Result<(), RenderError>,
    ) -> Result<Instant, RenderError> {
        let drawn = self.draw(watch).map(|()| Instant::now());
        drawn.and_then(|drawn| after(self, watch).map(|()| drawn)).inspect_err(|_| {
            self.camera = None;
            self.under_way = watch.take_under_way();
        })
    }

    /// Makes room for a picture, and sends the view. Returns the picture's texture.
    pub(crate) fn look(
        &mut self,
        camera: &Camera,
        quality: Quality,
    ) -> Result<wgpu::TextureView, RenderError> {
        let (size, Quality { supersampling, hairs }) = (camera.size(), quality);
        self.check_size(size, supersampling)?;
        let screen = match self.screen.take().filter(|screen| screen.fits(size, supersampling)) {
            Some(screen) => screen,
            None => self.renderer.screen(size, supersampling)?,
        };
        let texture = self.screen.insert(screen).picture.clone();
        self.camera = Some(camera.clone());
        let view = ViewUniform::new(camera, self.background, supersampling, hairs && self.raster.is_hairy());
        self.raster.has_hairs = view.has_hairs();
        self.raster.sees_all = camera.sees_all();
        self.is_far = view.is_far();
        // The shader is compiled here, so that its first compilation does not count as drawing.
        self.renderer.shade(self.is_far)?;
        self.renderer.write(&self.view, bytemuck::bytes_of(&view))?;
        Ok(texture)
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

    /// Draws all chunks, one after the other.
    pub(crate) fn draw(&mut self, watch: &mut Watch<'_>) -> Result<(), RenderError> {
        if self.chunks.is_empty() {
            let plan = self.plan.clone();
            return self.draw_chunks(plan.chunks(&self.limits)?, watch);
        }
        let kept = std::mem::take(&mut self.chunks);
        let drawn = self.draw_chunks(kept.iter(), watch);
        self.chunks = kept;
        drawn
    }

    /// Draws `chunks`. While one is drawn, the tables of the next are sent.
    fn draw_chunks(
        &mut self,
        chunks: impl Iterator<Item: Borrow<Chunk>>,
        watch: &mut Watch<'_>,
    ) -> Result<(), RenderError> {
        let all = self.plan.counts().rings.max(1) as f64;
        let Self { renderer, session, raster, screen: Some(screen), .. } = self else { return Ok(()) };
        let is_cpu = renderer.info().kind == DeviceKind::Cpu;
        let (mut before, mut rings) = (None, 0_u64);
        for chunk in chunks {
            let chunk = chunk.borrow();
            let tables = session.chunk_tables(chunk)?;
            let pipelines = raster.pipelines(renderer, tables, watch)?;
            for band in screen.bands() {
                let drawn = raster.draw(renderer, &pipelines, tables, chunk, screen, band)?;
                // No more than two chunks are in progress, so that each wait is for one chunk and
                // not for a whole fabric. If the device is a CPU, the driver's call that submits a
                // second chunk returns only when the first chunk is done, and the caller could not
                // stop the work meanwhile. Each chunk is then waited for before the next is
                // submitted.
                let waited = if is_cpu { Some(drawn) } else { before.replace(drawn) };
                if let Some(submission) = waited {
                    watch.wait(&renderer.device, &submission)?;
                }
            }
            rings += u64::from(chunk.rings());
            watch.tell(DRAWN * (rings as f64 / all).min(1.0))?;
        }
        before.map_or(Ok(()), |submission| watch.wait(&renderer.device, &submission))
    }

    /// Works out visibility, then light, and then pixels from their samples.
    pub(crate) fn shade(&self, watch: &mut Watch<'_>) -> Result<(), RenderError> {
        let (renderer, Some(screen)) = (&self.renderer, &self.screen) else { return Ok(()) };
        let texture = BindingResource::TextureView;
        let (view, visibility) = (self.view.as_entire_binding(), texture(&screen.visibility));
        let kept = [
            (0, view),
            (1, texture(&screen.depths)),
            (2, texture(&screen.directions)),
            (3, texture(&screen.places)),
            (4, visibility),
        ];
        let lit = [(5, self.looks.as_entire_binding()), (6, texture(&screen.lit))];
        let gathered = [kept[0].clone(), (1, texture(&screen.lit)), (2, texture(&screen.picture))];
        let (device, shade) = (&renderer.device, renderer.shade(self.is_far)?);
        let submission = device.scoped("Queue::submit", || {
            let mut encoder = device.device().create_command_encoder(&Default::default());
            {
                let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
                let mut fill = |pipeline: &wgpu::ComputePipeline, own: &[_], size: [u32; 2]| {
                    pass.set_pipeline(pipeline);
                    pass.set_bind_group(1, &group(device.device(), pipeline, 1, own), &[]);
                    let [columns, rows] = size.map(|pixels| pixels.div_ceil(SCREEN_GROUP));
                    pass.dispatch_workgroups(columns, rows, 1);
                };
                if !self.is_far {
                    fill(&renderer.visibility, &kept, screen.large());
                }
                fill(shade, &[&kept[..], &lit].concat(), screen.large());
                fill(&renderer.gather, &gathered, screen.size());
            }
            device.queue().submit([encoder.finish()])
        })?;
        watch.wait(device, &submission)?;
        watch.tell(LIT)
    }

    /// Copies the picture to the host, and returns its colours and its alpha.
    pub(crate) fn copy(&self) -> Result<[Vec<u8>; 2], RenderError> {
        let Some(screen) = &self.screen else { return Ok([Vec::new(), Vec::new()]) };
        let device = &self.renderer.device;
        let submission = device.scoped("Queue::submit", || {
            let mut encoder = device.device().create_command_encoder(&Default::default());
            screen.copy(&mut encoder);
            let submission = device.queue().submit([encoder.finish()]);
            screen.map();
            submission
        })?;
        device.wait(submission)?;
        Ok(screen.take(device)?)
    }
}

/// All chunks of a plan, if they are few enough to stay in a session; otherwise none.
///
/// **Errors**: [`PlanError`] if not even one block fits the limits.
fn kept_chunks(plan: &Plan, limits: &Limits) -> Result<Vec<Chunk>, PlanError> {
    let first: Vec<_> = plan.chunks(limits)?.take(CHUNKS_KEPT + 1).collect();
    Ok(if first.len() > CHUNKS_KEPT { Vec::new() } else { first })
}

/// The mean distance from ring to ring of each yarn, mm, estimated from its first control points.
/// It is used only to scale the fibres' pattern.
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
