//! Measures the phases of the paper's figure 5, each alone: yarn geometry, buffer creation,
//! rendering.

use std::error::Error;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::{Duration, Instant};

use texere::backend::{Chunk, Plan, Schedule};
use texere::mesh::{Limits, MeshPiece, Topology};
use texere::picture::{Camera, Extent, Quality, Renderer};
use texere::{Backend, BackendError, DeviceInfo, Settings, Vertex, Yarns};
use texere_core::backend::Session;
use texere_wgpu::WgpuBackend;
use wgpu::BufferUsages;

/// Memory for two chunks of mesh, bytes.
const CHUNK_MEMORY: u64 = 128 << 20;

use crate::fill::Gpu;

/// The time of each phase by the host's clock. The phases run one after the other.
#[derive(Debug, Clone, Copy, Default)]
pub struct Phases {
    /// Splines and meshes on one core of the CPU: the paper's algorithms 1 and 3, into the host's
    /// memory.
    pub serial_geometry: Duration,
    /// Sending the vertices and indices of the serial mesh to the device that draws.
    pub serial_buffers: Duration,
    /// Splines and meshes on the device that draws, into its own memory.
    pub parallel_geometry: Duration,
    /// Sending control points and tables to the device that draws. Nothing else has to be sent.
    pub parallel_buffers: Duration,
    /// Drawing and lighting a picture, which is the same after either geometry.
    pub rendering: Duration,
}

impl Phases {
    /// Names of the phases, in the order of [`Phases::in_order`].
    pub const NAMES: [&str; 5] =
        ["geometry, serial", "buffers, serial", "geometry, parallel", "buffers, parallel", "drawing"];

    /// The times, each geometry before its buffers.
    #[must_use]
    pub const fn in_order(&self) -> [Duration; 5] {
        let Self { serial_geometry, serial_buffers, parallel_geometry, parallel_buffers, rendering } = *self;
        [serial_geometry, serial_buffers, parallel_geometry, parallel_buffers, rendering]
    }
}

/// A device that draws, and the serial backend.
#[derive(Debug)]
pub struct PhaseTimer {
    gpu: WgpuBackend,
    /// A renderer on the same device.
    renderer: Renderer,
    serial: Box<dyn Backend>,
}

impl PhaseTimer {
    /// Opens a device by a name such as `wgpu:0`.
    ///
    /// **Errors**: [`BackendError`] if there is no such device, or it does not draw.
    pub fn open(device: &str) -> Result<Self, BackendError> {
        let Gpu::Wgpu(gpu) = Gpu::open(device)? else {
            return Err(BackendError::NoDevice { wanted: device.into(), found: Vec::new() });
        };
        let (own, queue) = (gpu.device().clone(), gpu.queue().clone());
        let renderer = Renderer::new(WgpuBackend::from_device(own, queue, Schedule::PerRing)?)?;
        Ok(Self { gpu, renderer, serial: texere::open("cpu-serial")? })
    }

    /// The device that draws.
    #[must_use]
    pub fn info(&self) -> &DeviceInfo {
        self.gpu.info()
    }

    /// Times the phases for one fabric and a picture of its face of `size` pixels, each on a warm
    /// device.
    ///
    /// # Errors
    ///
    /// The errors of a device.
    pub fn phases(
        &self,
        yarns: &Yarns,
        settings: &Settings,
        size: [u32; 2],
    ) -> Result<Phases, Box<dyn Error>> {
        let camera = Camera::face(&Extent::of(yarns), size);
        // The first picture compiles and allocates.
        self.renderer.scene(yarns, settings)?.picture(&camera, Quality::default())?;

        let start = Instant::now();
        let mut scene = self.renderer.scene(yarns, settings)?;
        self.idle()?;
        let parallel_buffers = start.elapsed();
        let parallel_geometry = self.parallel_geometry(yarns, settings)?;
        scene.picture(&camera, Quality::default())?;
        let start = Instant::now();
        scene.picture(&camera, Quality::default())?;
        let rendering = start.elapsed();
        drop(scene);

        let (serial_geometry, serial_buffers) = self.serial(yarns, settings)?;
        Ok(Phases { serial_geometry, serial_buffers, parallel_geometry, parallel_buffers, rendering })
    }

    /// Times the mesh on the device that draws: vertices without indices, and with caps.
    fn parallel_geometry(&self, yarns: &Yarns, settings: &Settings) -> Result<Duration, Box<dyn Error>> {
        let settings = Settings { topology: Topology::None, caps: true, ..*settings };
        let plan = Arc::new(Plan::new(yarns.layout().clone(), settings)?);
        let mut session = crate::session(&self.gpu, &plan, yarns)?;
        let mut mesh = || -> Result<Duration, Box<dyn Error>> {
            let start = Instant::now();
            for chunk in plan.chunks(&self.limits(&plan))? {
                session.mesh(&chunk)?;
            }
            self.idle()?;
            Ok(start.elapsed())
        };
        mesh()?;
        mesh()
    }

    /// Times geometry and buffers of the serial backend, chunk by chunk, so that any fabric fits
    /// the host.
    fn serial(&self, yarns: &Yarns, settings: &Settings) -> Result<(Duration, Duration), Box<dyn Error>> {
        // The mesh has caps, as in the parallel geometry.
        let settings = Settings { topology: Topology::Indexed, caps: true, ..*settings };
        let plan = Arc::new(Plan::new(yarns.layout().clone(), settings)?);
        let mut session = crate::session(&*self.serial, &plan, yarns)?;
        let (mut geometry, mut buffers) = (Duration::ZERO, Duration::ZERO);
        for chunk in plan.chunks(&self.limits(&plan))? {
            let start = Instant::now();
            session.mesh(&chunk)?;
            let _ = session.read_mesh(&chunk, &mut |_| ControlFlow::Continue(()))?;
            geometry += start.elapsed();
            let start = Instant::now();
            self.send(&mut session, &chunk)?;
            buffers += start.elapsed();
        }
        Ok((geometry, buffers))
    }

    /// Makes buffers of a chunk's mesh, and waits until the mesh is in them.
    fn send(&self, session: &mut Session, chunk: &Chunk) -> Result<(), Box<dyn Error>> {
        let buffer = |usage, count: u32, each: usize| {
            self.gpu.buffer("serial mesh", u64::from(count) * each as u64, usage | BufferUsages::COPY_DST)
        };
        let vertices = buffer(BufferUsages::VERTEX, chunk.vertices(), size_of::<Vertex>())?;
        let indices = buffer(BufferUsages::INDEX, chunk.indices(), size_of::<u32>())?;
        let mut outcome = Ok(());
        let _ = session.read_mesh(chunk, &mut |piece| {
            let (buffer, offset, bytes): (_, _, &[u8]) = match piece {
                MeshPiece::Vertices { first, vertices: piece } => {
                    (&vertices, u64::from(first) * size_of::<Vertex>() as u64, bytemuck::cast_slice(piece))
                }
                MeshPiece::Indices { first, indices: piece } => {
                    (&indices, u64::from(first) * size_of::<u32>() as u64, bytemuck::cast_slice(piece))
                }
                _ => return ControlFlow::Continue(()),
            };
            let queue = self.gpu.queue();
            outcome = self.gpu.scoped("Queue::write_buffer", || queue.write_buffer(buffer, offset, bytes));
            if outcome.is_ok() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        })?;
        outcome?;
        Ok(self.idle()?)
    }

    /// The limits of a chunk. Two chunks of this size keep any device busy.
    fn limits(&self, plan: &Plan) -> Limits {
        Limits { memory_bytes: plan.resident_bytes() + CHUNK_MEMORY, ..self.info().limits }
    }

    /// Waits until the device has finished all its work.
    fn idle(&self) -> Result<(), BackendError> {
        let submission = self.gpu.scoped("Queue::submit", || self.gpu.queue().submit([]))?;
        self.gpu.wait(submission)
    }
}
