//! The mesh of yarns in one piece, as files have it: each ring once, then all caps.
//!
//! Where a mesh is cut into chunks within a yarn, the ring at the cut belongs to both chunks, with
//! equal bits. Each chunk is written over the end of the one before, so that the ring is there
//! once, and no vertex of a tube is moved afterwards. Vertices of caps are kept apart, and come
//! last. The device writes no indices: the host copies their pattern and adds each draw's first
//! vertex, which takes as long as writing them.

use std::ops::ControlFlow;
use std::sync::Arc;

use rayon::prelude::*;
use texere::backend::{Chunk, MeshMut, Plan, Run, Session, prefer_huge, zeroed};
use texere::mesh::{Attribute, Limits, Progress, Topology};
use texere::{Backend, PipelineError, Settings, Vertex, Yarns};

use crate::watch;

/// A mesh whose indices count from its first vertex.
#[derive(Debug)]
pub(crate) struct Whole {
    pub(crate) vertices: Vec<Vertex>,
    pub(crate) indices: Vec<u32>,
}

/// A plan of the mesh, its chunks for a device, and where each lies in the whole.
#[derive(Debug)]
struct Laid {
    plan: Arc<Plan>,
    limits: Limits,
    chunks: Vec<(Chunk, Place)>,
}

/// Where the vertices of a chunk lie in the whole.
#[derive(Debug, Clone, Copy)]
struct Place {
    /// The number, in the whole, of the first vertex of the chunk's tubes. `length` is how many
    /// vertices of tubes there are; they come first in the chunk.
    tubes: usize,
    length: usize,
    /// The number, in the whole, of the first vertex of the chunk's caps.
    caps: usize,
}

impl Place {
    /// Where a vertex of the chunk lies.
    fn of(&self, vertex: usize) -> usize {
        vertex.checked_sub(self.length).map_or(self.tubes + vertex, |of_caps| self.caps + of_caps)
    }
}

impl Laid {
    fn new(yarns: &Yarns, settings: Settings, device: &dyn Backend) -> Result<Self, PipelineError> {
        let settings = Settings { topology: Topology::Shared, ..settings };
        let plan = Arc::new(Plan::new(yarns.layout().clone(), settings)?);
        let limits = Limits::default().min(&device.info().limits);
        let (sides, all) = (settings.sides as usize, plan.counts().rings as usize);
        let (mut rings, mut caps, mut chunks) = (0, 0, Vec::new());
        for chunk in plan.chunks(&limits)? {
            let own = chunk.rings() as usize;
            let place = Place { tubes: rings * sides, length: own * sides, caps: (all + caps) * sides };
            rings += own - usize::from(chunk.repeats_ring());
            caps += chunk.caps().len();
            chunks.push((chunk, place));
        }
        Ok(Self { plan, limits, chunks })
    }

    /// The number of vertices of all tubes.
    fn tubes(&self) -> usize {
        self.plan.counts().rings as usize * self.plan.settings().sides as usize
    }

    /// A session with the control points and their rolls.
    fn session(
        &self,
        yarns: &Yarns,
        device: &dyn Backend,
        run: &watch::Run,
    ) -> Result<Session, PipelineError> {
        let tell = |_: Progress| run.tell(0.0);
        Ok(Run::start(device, self.plan.clone(), yarns.points(), self.limits, tell)?.into_session())
    }

    /// Tells how many chunks are done.
    fn tell(&self, done: usize, run: &watch::Run) -> Result<(), PipelineError> {
        match run.tell((done + 1) as f64 / self.chunks.len() as f64) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(PipelineError::Cancelled),
        }
    }

    /// The triangles of all tubes, then those of all caps.
    fn indices(&self) -> Result<Vec<u32>, PipelineError> {
        let pattern = self.plan.shared_indices();
        let mut indices = zeroed("indices", 3 * self.plan.counts().triangles)?;
        prefer_huge(&indices);
        let (mut rest, mut draws) = (&mut indices[..], Vec::new());
        for is_cap in [false, true] {
            for (chunk, place) in &self.chunks {
                for draw in self.plan.draws(chunk) {
                    let own = (draw.base_vertex - chunk.first_vertex()) as usize;
                    if (own >= place.length) != is_cap {
                        continue;
                    }
                    let drawn = &pattern[draw.indices.start as usize..draw.indices.end as usize];
                    let (out, others) = rest.split_at_mut(drawn.len());
                    draws.push((out, drawn, place.of(own) as u32));
                    rest = others;
                }
            }
        }
        draws.into_par_iter().for_each(|(out, drawn, first)| {
            out.iter_mut().zip(drawn).for_each(|(index, corner)| *index = first + corner);
        });
        Ok(indices)
    }
}

impl Whole {
    /// Makes the mesh on `device`.
    pub(crate) fn new(
        yarns: &Yarns,
        settings: Settings,
        device: &dyn Backend,
        run: &watch::Run,
    ) -> Result<Self, PipelineError> {
        let laid = Laid::new(yarns, settings, device)?;
        let mut vertices: Vec<Vertex> = zeroed("vertices", laid.plan.counts().vertices)?;
        prefer_huge(&vertices);
        let mut session = laid.session(yarns, device, run)?;
        // Caps of a chunk lie where the next chunk is written.
        let mut caps = Vec::new();
        for (number, (chunk, place)) in laid.chunks.iter().enumerate() {
            let window = &mut vertices[place.tubes..place.tubes + chunk.vertices() as usize];
            session.mesh_into(chunk, MeshMut { vertices: window, indices: &mut [] })?;
            caps.extend_from_slice(&window[place.length..]);
            laid.tell(number, run)?;
        }
        vertices[laid.tubes()..].copy_from_slice(&caps);
        drop(session);
        Ok(Self { vertices, indices: laid.indices()? })
    }
}

/// Makes the attributes of the vertices of [`Whole::new`] on `device`.
pub(crate) fn attributes(
    yarns: &Yarns,
    settings: Settings,
    device: &dyn Backend,
    run: &watch::Run,
) -> Result<Vec<Attribute>, PipelineError> {
    let laid = Laid::new(yarns, settings, device)?;
    let mut attributes: Vec<Attribute> = zeroed("attributes", laid.plan.counts().vertices)?;
    let mut session = laid.session(yarns, device, run)?;
    if session.measure_watched(&mut || run.tell(0.0))?.is_break() {
        return Err(PipelineError::Cancelled);
    }
    for (number, (chunk, place)) in laid.chunks.iter().enumerate() {
        session.attributes(chunk)?;
        let _ = session.read_attributes(chunk, &mut |first, piece| {
            let first = first as usize;
            let (tubes, caps) = piece.split_at(piece.len().min(place.length.saturating_sub(first)));
            for (start, part) in [(first, tubes), (first + tubes.len(), caps)] {
                if !part.is_empty() {
                    attributes[place.of(start)..][..part.len()].copy_from_slice(part);
                }
            }
            ControlFlow::Continue(())
        })?;
        laid.tell(number, run)?;
    }
    Ok(attributes)
}
