//! Broken backends. Each does one thing wrong, and the suite has to find the fault.

use std::f64::consts::TAU;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::Duration;

use glam::Vec3;
use texere_core::backend::{
    Chunk, Engine, MeshMut, MeshSink, PackedSink, Part, Plan, RingSink, ScanChunks, Schedule, Slot,
    StageTimings,
};
use texere_core::definitions::{Ring, Turn};
use texere_core::{Backend, BackendError, Capabilities, ControlPoint, DeviceInfo, Limits, MeshPiece, Vertex};
use texere_cpu::SerialBackend;

use crate::compare::Fault;
use crate::poison::{POISONED_INDEX, POISONED_RING, POISONED_VERTEX};

/// The fault of a broken backend. It happens once, in the second chunk, unless its doc says
/// otherwise.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Sabotage {
    /// No fault.
    None,
    /// One vertex is off its place by a thousandth of the radius.
    ShiftedVertex,
    /// Two indices have changed places.
    SwappedIndices,
    /// The output is zeros, as from a device that lost its launch.
    Zeros,
    /// One coordinate is NaN.
    NotANumber,
    /// One normal is infinite.
    Infinity,
    /// One chunk is never written.
    MissingChunk,
    /// The last piece never comes.
    MissingPiece,
    /// A piece comes under the wrong number.
    MisplacedPiece,
    /// The section of one ring is turned by a hundredth of a radian.
    RolledSection,
    /// Outlines do not lean. It is a fault only for yarns with up directions.
    LevelOutlines,
    /// The first two parts of a chunk have changed places, in each chunk in which they have equally
    /// many rings.
    SwappedYarns,
    /// One ring is a thousandth too wide.
    WideRing,
    /// One tangent points backward.
    ReversedTangent,
    /// One normal points inward.
    InwardNormal,
    /// The ring that a cut repeats differs in the last bit.
    LooseSeam,
    /// The last ring of every closed yarn differs from its first in the last bit.
    LooseEnd,
    /// One vertex differs in the last bit. It is a fault only for a backend that promises equal
    /// bits.
    LastBit,
    /// Every cap covers a part of itself twice.
    OpenCap,
    /// Stage 2 takes no time.
    StoppedClock,
    /// Stage 2 takes a day.
    FastClock,
    /// Every upload sends the whole fabric.
    WholeUpload,
    /// Later uploads of control points are ignored.
    LostEdit,
    /// One packed coordinate is two quanta off.
    ShiftedPacked,
    /// One packed normal points inward.
    InwardPacked,
    /// One vertex of each ring that a cut repeats is packed a quantum off.
    CrackedPacked,
    /// The backend calls itself per-yarn, and refuses nothing.
    Eager,
    /// The backend calls itself per-yarn, and refuses everything.
    Lazy,
}

impl Sabotage {
    /// The faults of output that are faults for every backend, also without up directions.
    pub const ALL: [Self; 16] = [
        Self::ShiftedVertex,
        Self::SwappedIndices,
        Self::Zeros,
        Self::NotANumber,
        Self::Infinity,
        Self::MissingChunk,
        Self::MissingPiece,
        Self::MisplacedPiece,
        Self::RolledSection,
        Self::SwappedYarns,
        Self::WideRing,
        Self::ReversedTangent,
        Self::InwardNormal,
        Self::LooseSeam,
        Self::LooseEnd,
        Self::OpenCap,
    ];

    /// The faults that the comparison has to find in the output. It may find no other faults.
    #[must_use]
    pub const fn faults(self) -> &'static [Fault] {
        match self {
            Self::None
            | Self::LastBit
            | Self::StoppedClock
            | Self::FastClock
            | Self::WholeUpload
            | Self::LostEdit
            | Self::ShiftedPacked
            | Self::InwardPacked
            | Self::CrackedPacked
            | Self::Eager
            | Self::Lazy => &[],
            Self::ShiftedVertex => &[Fault::Position],
            Self::SwappedIndices | Self::OpenCap => &[Fault::Index],
            // Bits differ, too, because the chunks beside the faulty one share rings with it.
            Self::Zeros => {
                &[Fault::Position, Fault::Normal, Fault::Size, Fault::Tangent, Fault::Index, Fault::Bits]
            }
            Self::NotANumber | Self::Infinity => &[Fault::NotFinite],
            Self::MissingChunk => &[Fault::Missing, Fault::Bits],
            Self::MissingPiece => &[Fault::Missing],
            // Pieces after the misplaced one are not taken.
            Self::MisplacedPiece => &[Fault::Count, Fault::Missing, Fault::Bits],
            Self::RolledSection => &[Fault::Position, Fault::Normal, Fault::Roll],
            Self::LevelOutlines => &[Fault::Lean],
            Self::SwappedYarns => &[Fault::Position],
            Self::WideRing => &[Fault::Size],
            Self::ReversedTangent => &[Fault::Tangent],
            Self::InwardNormal => &[Fault::Normal],
            Self::LooseSeam | Self::LooseEnd => &[Fault::Bits],
        }
    }
}

/// The serial backend with a fault built in. Each of its chunks has at most two rows of the block
/// table: two blocks, or a block and the ring that a cut repeats.
#[derive(Debug)]
pub struct SabotagedBackend {
    info: DeviceInfo,
    serial: SerialBackend,
    sabotage: Sabotage,
}

impl SabotagedBackend {
    /// The serial backend with a fault.
    #[must_use]
    pub fn new(sabotage: Sabotage) -> Self {
        let serial = SerialBackend::new();
        let limits = Limits { blocks: 2, ..Limits::NONE };
        let can = Capabilities { pack: true, ..Capabilities::default() };
        let mut info = DeviceInfo { name: format!("{sabotage:?}"), limits, can, ..serial.info().clone() };
        if matches!(sabotage, Sabotage::Eager | Sabotage::Lazy) {
            info.schedule = Schedule::PerYarn;
        }
        Self { info, serial, sabotage }
    }
}

impl Backend for SabotagedBackend {
    fn info(&self) -> &DeviceInfo {
        &self.info
    }

    fn engine(&self, plan: Arc<Plan>) -> Result<Box<dyn Engine>, BackendError> {
        if self.sabotage == Sabotage::Lazy {
            let (schedule, what) = (self.info.name.clone(), "caps, nor anything else".into());
            return Err(BackendError::Unsupported { schedule, what });
        }
        let serial = self.serial.engine(plan.clone())?;
        Ok(Box::new(SabotagedEngine { plan, serial, sabotage: self.sabotage, kept: Vec::new() }))
    }
}

#[derive(Debug)]
struct SabotagedEngine {
    plan: Arc<Plan>,
    serial: Box<dyn Engine>,
    sabotage: Sabotage,
    /// The points of the first upload, which [`Sabotage::LostEdit`] keeps.
    kept: Vec<ControlPoint>,
}

/// The chunk in which most sabotage happens.
const VICTIM: u64 = 1;

impl SabotagedEngine {
    fn spoil_rings(&self, chunk: &Chunk, rings: &mut [Ring]) {
        let victim = chunk.index() == VICTIM;
        match self.sabotage {
            Sabotage::Zeros if victim => rings.fill(Ring::default()),
            Sabotage::MissingChunk if victim => rings.fill(POISONED_RING),
            Sabotage::RolledSection if victim => {
                rings[10].roll = rings[10].roll + Turn::from_turns((0.01 / TAU) as f32);
            }
            Sabotage::LevelOutlines => rings.iter_mut().for_each(|ring| ring.lean = Turn::ZERO),
            Sabotage::WideRing if victim => rings[10].half_width *= 1.001,
            Sabotage::ReversedTangent if victim => {
                rings[10].tangent = (-Vec3::from(rings[10].tangent)).into();
            }
            Sabotage::SwappedYarns => swap_yarns(chunk, 1, rings),
            _ => {}
        }
    }

    fn spoil_mesh(&self, chunk: &Chunk, vertices: &mut [Vertex], indices: &mut [u32]) {
        let sides = self.plan.settings().sides as usize;
        let victim = chunk.index() == VICTIM;
        match self.sabotage {
            Sabotage::ShiftedVertex if victim => {
                let centre = ring_centre(&vertices[10 * sides..11 * sides]);
                let vertex = &mut vertices[10 * sides + 2];
                let shift = (Vec3::from(vertex.position) - centre) * 1e-3;
                vertex.position = (Vec3::from(vertex.position) + shift).into();
            }
            Sabotage::SwappedIndices if victim => indices.swap(100, 101),
            Sabotage::Zeros if victim => {
                vertices.fill(Vertex::default());
                indices.fill(0);
            }
            Sabotage::NotANumber if victim => vertices[70].position[1] = f32::NAN,
            Sabotage::Infinity if victim => vertices[70].normal[2] = f32::NEG_INFINITY,
            Sabotage::MissingChunk if victim => {
                vertices.fill(POISONED_VERTEX);
                indices.fill(POISONED_INDEX);
            }
            Sabotage::RolledSection if victim => roll(&mut vertices[10 * sides..11 * sides]),
            Sabotage::SwappedYarns => swap_yarns(chunk, sides, vertices),
            Sabotage::InwardNormal if victim => {
                vertices[70].normal = (-Vec3::from(vertices[70].normal)).into();
            }
            Sabotage::LastBit if victim => {
                let first = &mut vertices[0].position[0];
                *first = first.next_up();
            }
            Sabotage::LooseSeam if victim && chunk.repeats_ring() => {
                let last = &mut vertices[chunk.rings() as usize * sides - 1].position[0];
                *last = last.next_up();
            }
            Sabotage::LooseEnd => {
                let ends = |part: &&Part| part.first_ring + part.rings == self.plan.rings(part.yarn as usize);
                for part in chunk.parts().iter().filter(ends) {
                    if self.plan.yarn(part.yarn as usize).closed {
                        let end = (part.first_vertex + part.rings * sides as u32) as usize;
                        let last = &mut vertices[end - 1].position[0];
                        *last = last.next_up();
                    }
                }
            }
            Sabotage::OpenCap => {
                for cap in chunk.caps() {
                    let first = cap.first_index as usize;
                    indices.copy_within(first..first + 3, first + 3);
                }
            }
            _ => {}
        }
    }
}

/// The middle of a ring of vertices.
fn ring_centre(ring: &[Vertex]) -> Vec3 {
    ring.iter().map(|vertex| Vec3::from(vertex.position)).sum::<Vec3>() / ring.len() as f32
}

/// Turns a ring of vertices by a hundredth of a radian.
fn roll(ring: &mut [Vertex]) {
    let centre = ring_centre(ring);
    let arms = [0, 1].map(|k: usize| Vec3::from(ring[k].position) - centre);
    let axis = arms[0].cross(arms[1]).normalize();
    let turned = |v: Vec3| glam::Quat::from_axis_angle(axis, 0.01) * v;
    for vertex in ring {
        vertex.position = (centre + turned(Vec3::from(vertex.position) - centre)).into();
        vertex.normal = turned(vertex.normal.into()).into();
    }
}

/// Exchanges the first two parts of a chunk if they are equally long. Each ring has `per_ring`
/// values.
fn swap_yarns<T>(chunk: &Chunk, per_ring: usize, values: &mut [T]) {
    if let [first, second, ..] = chunk.parts()
        && first.rings == second.rings
    {
        let (one, other) = values.split_at_mut(first.rings as usize * per_ring);
        one.swap_with_slice(&mut other[..second.rings as usize * per_ring]);
    }
}

impl Engine for SabotagedEngine {
    fn upload(&mut self, first: u64, points: &[ControlPoint]) -> Result<u64, BackendError> {
        if self.sabotage == Sabotage::LostEdit {
            let range = first as usize..first as usize + points.len();
            if let Some(old) = self.kept.get(range) {
                return self.serial.upload(first, old);
            }
            self.kept = points.to_vec();
        }
        let sent = self.serial.upload(first, points)?;
        Ok(if self.sabotage == Sabotage::WholeUpload { self.plan.resident_bytes() } else { sent })
    }

    fn scan(&mut self, chunks: ScanChunks<'_>) -> Result<(), BackendError> {
        self.serial.scan(chunks)
    }

    fn load(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError> {
        self.serial.load(slot, chunk)
    }

    fn mesh_reads_rings(&self) -> bool {
        self.serial.mesh_reads_rings()
    }

    fn trajectory(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError> {
        self.serial.trajectory(slot, chunk)
    }

    fn mesh(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError> {
        self.serial.mesh(slot, chunk)
    }

    fn read_trajectory(
        &mut self,
        slot: Slot,
        chunk: &Chunk,
        sink: RingSink<'_>,
    ) -> Result<ControlFlow<()>, BackendError> {
        let mut rings = Vec::new();
        let _ = self.serial.read_trajectory(slot, chunk, &mut |piece| {
            rings.extend_from_slice(piece);
            ControlFlow::Continue(())
        })?;
        self.spoil_rings(chunk, &mut rings);
        Ok(sink(&rings))
    }

    fn read_mesh(
        &mut self,
        slot: Slot,
        chunk: &Chunk,
        sink: MeshSink<'_>,
    ) -> Result<ControlFlow<()>, BackendError> {
        let (mut vertices, mut indices) = (Vec::new(), Vec::new());
        let _ = self.serial.read_mesh(slot, chunk, &mut |piece| {
            match piece {
                MeshPiece::Vertices { vertices: piece, .. } => vertices.extend_from_slice(piece),
                MeshPiece::Indices { indices: piece, .. } => indices.extend_from_slice(piece),
                _ => {}
            }
            ControlFlow::Continue(())
        })?;
        self.spoil_mesh(chunk, &mut vertices, &mut indices);
        let first = u32::from(self.sabotage == Sabotage::MisplacedPiece && chunk.index() == VICTIM);
        let flow = sink(MeshPiece::Vertices { first, vertices: &vertices });
        let withheld = self.sabotage == Sabotage::MissingPiece && chunk.index() == VICTIM;
        if flow.is_break() || withheld {
            return Ok(flow);
        }
        Ok(sink(MeshPiece::Indices { first: 0, indices: &indices }))
    }

    fn packed(&mut self, slot: Slot, chunk: &Chunk) -> Result<(), BackendError> {
        self.serial.packed(slot, chunk)
    }

    fn read_packed(
        &mut self,
        slot: Slot,
        chunk: &Chunk,
        sink: PackedSink<'_>,
    ) -> Result<ControlFlow<()>, BackendError> {
        let mut packed = Vec::new();
        let _ = self.serial.read_packed(slot, chunk, &mut |_, piece| {
            packed.extend_from_slice(piece);
            ControlFlow::Continue(())
        })?;
        match self.sabotage {
            Sabotage::ShiftedPacked if chunk.index() == VICTIM => packed[70].position[0] ^= 2,
            Sabotage::InwardPacked if chunk.index() == VICTIM => packed[70].normal = [0, 1],
            Sabotage::CrackedPacked if chunk.repeats_ring() => {
                let end = chunk.rings() * self.plan.settings().sides;
                packed[end as usize - 1].position[0] ^= 1;
            }
            _ => {}
        }
        Ok(sink(0, &packed))
    }

    fn mesh_into(&mut self, slot: Slot, chunk: &Chunk, out: MeshMut<'_>) -> Result<(), BackendError> {
        let MeshMut { vertices, indices } = out;
        self.serial.mesh_into(slot, chunk, MeshMut { vertices, indices })?;
        self.spoil_mesh(chunk, vertices, indices);
        Ok(())
    }

    fn lends_its_own(&self) -> bool {
        true
    }

    fn timings(&mut self) -> StageTimings {
        let timings = self.serial.timings();
        match self.sabotage {
            Sabotage::StoppedClock => StageTimings { mesh: Duration::ZERO, ..timings },
            Sabotage::FastClock => StageTimings { mesh: Duration::from_secs(24 * 60 * 60), ..timings },
            _ => timings,
        }
    }
}
