//! A session on the CPU: memory, order of calls and timings; the stages themselves come from [`Stages`].

use std::fmt::Debug;
use std::ops::{ControlFlow, Range};
use std::sync::Arc;
use std::time::{Duration, Instant};

use texere_core::{
    BackendError, Chunk, ControlPoint, MeshMut, MeshPiece, PaddedPoints, Plan, Ring, Session, StageTimings,
    Traffic, Vertex, check_output, zeroed,
};

use crate::pages;
use crate::rolls::Rolls;

/// What the stages read.
#[derive(Debug)]
pub(crate) struct Work {
    pub(crate) plan: Arc<Plan>,
    pub(crate) points: PaddedPoints,
    pub(crate) rolls: Rolls,
}

/// Rings of a chunk, and the growth of the radius at each, which a [`Ring`] has no room for.
#[derive(Debug, Default)]
pub(crate) struct ChunkRings {
    pub(crate) rings: Vec<Ring>,
    pub(crate) slopes: Vec<f32>,
}

/// The two stages and the scan, one way of doing them.
pub(crate) trait Stages: Copy + Debug + Send + 'static {
    /// Whether `mesh` works out its rings itself.
    const FUSED: bool;
    fn scan(self, plan: &Plan, points: &PaddedPoints, rolls: &mut Rolls) -> Result<(), BackendError>;
    fn trajectory(self, work: &Work, chunk: &Chunk, out: &mut ChunkRings);
    /// `rings` are those of `chunk`, unless fused.
    fn mesh(self, work: &Work, chunk: &Chunk, rings: &ChunkRings, out: MeshMut<'_>);
}

/// A chunk in flight. Its memory serves the next chunk but one again.
#[derive(Debug, Default)]
struct Slot {
    /// The chunk's blocks. Its index would not do: chunks of another cut have the same.
    blocks: Option<Range<u64>>,
    has_rings: bool,
    has_mesh: bool,
    rings: ChunkRings,
    vertices: Vec<Vertex>,
    indices: Vec<u32>,
}

impl Slot {
    fn holds(&self, chunk: &Chunk) -> bool {
        self.blocks.as_ref() == Some(&chunk.block_range)
    }
}

#[derive(Debug)]
pub(crate) struct CpuSession<S> {
    work: Work,
    scanned: bool,
    /// Two in flight, the one launched first in front.
    slots: [Slot; 2],
    timings: StageTimings,
    traffic: Traffic,
    stages: S,
}

impl<S: Stages> CpuSession<S> {
    pub(crate) fn new(stages: S, plan: Arc<Plan>) -> Result<Self, BackendError> {
        let points = PaddedPoints::new(&plan)?;
        pages::prefer_huge(points.points());
        Ok(Self {
            work: Work { plan, points, rolls: Rolls::default() },
            scanned: false,
            slots: Default::default(),
            timings: StageTimings::default(),
            traffic: Traffic::default(),
            stages,
        })
    }

    fn check_scanned(&self, call: &'static str) -> Result<(), BackendError> {
        if self.scanned || !self.work.plan.needs_scan() {
            Ok(())
        } else {
            Err(BackendError::OutOfOrder { call, needed: "scan" })
        }
    }

    /// The slot of `chunk`; if it is new, that of the chunk launched longest ago, emptied.
    fn claim(&mut self, chunk: &Chunk) -> &mut Slot {
        let place = self.slots.iter().position(|slot| slot.holds(chunk)).unwrap_or_else(|| {
            self.slots.swap(0, 1);
            let slot = &mut self.slots[1];
            slot.blocks = Some(chunk.block_range.clone());
            (slot.has_rings, slot.has_mesh) = (false, false);
            1
        });
        &mut self.slots[place]
    }

    fn find(&self, chunk: &Chunk, wanted: fn(&Slot) -> bool) -> Result<&Slot, BackendError> {
        self.slots
            .iter()
            .find(|slot| slot.holds(chunk) && wanted(slot))
            .ok_or(BackendError::NotInFlight { chunk: chunk.index })
    }

    /// Runs stage 1 for `chunk` unless it has run.
    fn ensure_rings(&mut self, chunk: &Chunk) -> Result<(), BackendError> {
        let slot = self.claim(chunk);
        if slot.has_rings {
            return Ok(());
        }
        let mut rings = std::mem::take(&mut slot.rings);
        resize("rings", &mut rings.rings, chunk.rings.into())?;
        resize("slopes", &mut rings.slopes, chunk.rings.into())?;
        timed(&mut self.timings.trajectory, || self.stages.trajectory(&self.work, chunk, &mut rings));
        let slot = self.claim(chunk);
        (slot.rings, slot.has_rings) = (rings, true);
        Ok(())
    }
}

/// Makes `buffer` `length` long; what it held is lost. Memory that is large enough is kept.
pub(crate) fn resize<T: bytemuck::Zeroable>(
    what: &'static str,
    buffer: &mut Vec<T>,
    length: u64,
) -> Result<(), BackendError> {
    if (buffer.capacity() as u64) < length {
        *buffer = zeroed(what, length)?;
    }
    buffer.resize_with(length as usize, T::zeroed);
    Ok(())
}

fn timed<T>(total: &mut Duration, work: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let result = work();
    *total += start.elapsed();
    result
}

impl<S: Stages> Session for CpuSession<S> {
    fn upload(&mut self, first: u64, points: &[ControlPoint]) -> Result<(), BackendError> {
        let start = Instant::now();
        let padded = self.work.points.upload(&self.work.plan, first, points)?;
        self.traffic.uploaded += (padded.end - padded.start) * size_of::<ControlPoint>() as u64;
        // What was worked out before belongs to the old points.
        self.scanned = false;
        for slot in &mut self.slots {
            slot.blocks = None;
        }
        self.timings.upload += start.elapsed();
        Ok(())
    }

    fn scan(&mut self) -> Result<(), BackendError> {
        if self.work.plan.needs_scan() && !self.scanned {
            let Self { work: Work { plan, points, rolls }, timings, stages, .. } = self;
            timed(&mut timings.scan, || stages.scan(plan, points, rolls))?;
        }
        self.scanned = true;
        Ok(())
    }

    fn trajectory(&mut self, chunk: &Chunk) -> Result<(), BackendError> {
        self.check_scanned("trajectory")?;
        self.ensure_rings(chunk)
    }

    fn mesh(&mut self, chunk: &Chunk) -> Result<(), BackendError> {
        let slot = self.claim(chunk);
        let (mut vertices, mut indices) =
            (std::mem::take(&mut slot.vertices), std::mem::take(&mut slot.indices));
        resize("vertices", &mut vertices, chunk.vertices.into())?;
        resize("indices", &mut indices, chunk.indices.into())?;
        self.mesh_into(chunk, MeshMut { vertices: &mut vertices, indices: &mut indices })?;
        let slot = self.claim(chunk);
        (slot.vertices, slot.indices, slot.has_mesh) = (vertices, indices, true);
        Ok(())
    }

    fn read_trajectory(
        &mut self,
        chunk: &Chunk,
        sink: &mut dyn FnMut(&[Ring]) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, BackendError> {
        self.find(chunk, |slot| slot.has_rings || slot.has_mesh)?;
        self.ensure_rings(chunk)?;
        Ok(sink(&self.find(chunk, |slot| slot.has_rings)?.rings.rings))
    }

    fn read_mesh(
        &mut self,
        chunk: &Chunk,
        sink: &mut dyn FnMut(MeshPiece<'_>) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, BackendError> {
        let slot = self.find(chunk, |slot| slot.has_mesh)?;
        let mut flow = sink(MeshPiece::Vertices { first: 0, vertices: &slot.vertices });
        if flow.is_continue() && !slot.indices.is_empty() {
            flow = sink(MeshPiece::Indices { first: 0, indices: &slot.indices });
        }
        Ok(flow)
    }

    fn mesh_into(&mut self, chunk: &Chunk, out: MeshMut<'_>) -> Result<(), BackendError> {
        check_output(chunk, &out)?;
        self.check_scanned("mesh")?;
        if !S::FUSED {
            self.ensure_rings(chunk)?;
        }
        let slot = self.claim(chunk);
        let rings = std::mem::take(&mut slot.rings);
        timed(&mut self.timings.mesh, || self.stages.mesh(&self.work, chunk, &rings, out));
        self.claim(chunk).rings = rings;
        Ok(())
    }

    fn timings(&self) -> StageTimings {
        self.timings
    }

    fn traffic(&self) -> Traffic {
        self.traffic
    }
}
