//! The three phases of the paper's figure 5, each alone: yarn geometry, buffer creation, rendering.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::{Duration, Instant};

use texere_core::{
    Backend, BackendError, Chunk, MeshPiece, Plan, Session, Settings, Topology, Vertex, Yarns,
};
use wgpu::BufferUsages;

use crate::scene::chunk_limits;
use crate::{Camera, Extent, Quality, RenderError, Renderer};

/// Time of each phase, one after the other, by the host's clock.
#[derive(Debug, Clone, Copy, Default)]
pub struct Phases {
    /// Splines and meshes on one core of the CPU: the paper's algorithms 1 and 3, into the host's memory.
    pub serial_geometry: Duration,
    /// That mesh, vertices and indices, to the device that draws.
    pub serial_buffers: Duration,
    /// Splines and meshes on the device that draws, into its own memory.
    pub parallel_geometry: Duration,
    /// Control points and tables to that device: all that has to be sent then.
    pub parallel_buffers: Duration,
    /// Drawing and lighting a picture, which is the same for both.
    pub rendering: Duration,
}

impl Renderer {
    /// Times the phases for one fabric and a picture of its face of `size` pixels, each on a device that is warm.
    /// `serial` is the serial backend.
    ///
    /// **Errors**: those of [`Renderer::scene`] and of [`Scene::picture`](crate::Scene::picture).
    pub fn phases(
        &self,
        yarns: &Yarns,
        settings: &Settings,
        serial: &dyn Backend,
        size: [u32; 2],
    ) -> Result<Phases, RenderError> {
        let camera = Camera::face(&Extent::of(yarns), size);
        // A first picture, which compiles and allocates.
        self.scene(yarns, settings)?.picture(&camera, Quality::default())?;

        let start = Instant::now();
        let mut scene = self.scene(yarns, settings)?;
        self.idle()?;
        let parallel_buffers = start.elapsed();
        scene.mesh()?;
        self.idle()?;
        let start = Instant::now();
        scene.mesh()?;
        self.idle()?;
        let parallel_geometry = start.elapsed();
        scene.picture(&camera, Quality::default())?;
        let start = Instant::now();
        scene.picture(&camera, Quality::default())?;
        // A picture makes its mesh, which is not part of this phase.
        let rendering = start.elapsed().saturating_sub(parallel_geometry);
        drop(scene);

        let (serial_geometry, serial_buffers) = self.serial(yarns, settings, serial)?;
        Ok(Phases { serial_geometry, serial_buffers, parallel_geometry, parallel_buffers, rendering })
    }

    /// Times geometry and buffers of the serial backend, chunk by chunk, so that any fabric fits the host.
    fn serial(
        &self,
        yarns: &Yarns,
        settings: &Settings,
        serial: &dyn Backend,
    ) -> Result<(Duration, Duration), RenderError> {
        // With caps, as the parallel phase has them.
        let settings = Settings { topology: Topology::Indexed, caps: true, ..*settings };
        let plan = Arc::new(Plan::new(yarns.layout().clone(), settings)?);
        let mut session = Session::new(serial, plan.clone())?;
        session.upload(0, yarns.points())?;
        session.scan()?;
        let (mut geometry, mut buffers) = (Duration::ZERO, Duration::ZERO);
        for chunk in plan.chunks(&chunk_limits(&plan).min(&self.info().limits))? {
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

    /// Makes buffers of a chunk's mesh, and waits until it is there.
    fn send(&self, session: &mut Session, chunk: &Chunk) -> Result<(), RenderError> {
        let buffer = |usage, count: u32, each: usize| {
            self.buffer("serial mesh", u64::from(count) * each as u64, usage)
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
            let queue = self.device.queue();
            outcome = self.device.scoped("Queue::write_buffer", || queue.write_buffer(buffer, offset, bytes));
            if outcome.is_ok() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        })?;
        outcome?;
        Ok(self.idle()?)
    }

    /// Waits until the device has done all that it was given.
    fn idle(&self) -> Result<(), BackendError> {
        let submission = self.device.scoped("Queue::submit", || self.device.queue().submit([]))?;
        self.device.wait(submission)
    }
}
