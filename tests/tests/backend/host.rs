//! A whole backend: both stages on the host, one ring after the other. docs/BACKENDS.md explains it
//! piece by piece.

use std::{ops::ControlFlow, sync::Arc, time::Instant};

use texere_core::{backend::*, definitions::*, *};

type Done<T = ()> = Result<T, BackendError>;

#[derive(Debug)]
struct Host(DeviceInfo);

pub(crate) fn open() -> Done<Arc<dyn Backend>> {
    Ok(Arc::new(Host(DeviceInfo {
        name: "host".into(),
        device: "this computer".into(),
        driver: "none".into(),
        schedule: Schedule::Serial,
        kind: DeviceKind::Cpu,
        memory_bytes: None,
        limits: Limits::default(),
        can: Capabilities::default(),
        timed_by_device: false,
    })))
}

impl Backend for Host {
    fn info(&self) -> &DeviceInfo {
        &self.0
    }
    fn engine(&self, plan: Arc<Plan>) -> Done<Box<dyn Engine>> {
        let points = PaddedPoints::new(&plan)?;
        let (rolls, rings, meshes, timings) = Default::default();
        Ok(Box::new(HostEngine { plan, points, rolls, rings, meshes, timings }))
    }
}

#[derive(Debug)]
struct HostEngine {
    plan: Arc<Plan>,
    points: PaddedPoints,
    rolls: Vec<Turn>,      // one for each ring of the fabric; empty where no yarn needs a scan
    rings: [Vec<Ring>; 2], // of the chunk in each slot
    meshes: [(Vec<Vertex>, Vec<u32>); 2], // likewise
    timings: StageTimings,
}

impl HostEngine {
    fn sample(&self, yarn: usize, ring: u32) -> RingSample {
        let (plan, padded) = (&self.plan, self.points.yarn(&self.plan, yarn));
        plan.sampling().sample(padded, ring, plan.rings(yarn), plan.yarn(yarn).closed)
    }
    fn ring(&self, yarn: u32, ring: u32) -> Ring {
        let sample = self.sample(yarn as usize, ring).sample;
        let roll = self.rolls.get(self.plan.ring_offsets()[yarn as usize] as usize + ring as usize);
        self.plan.ring(yarn as usize, ring, &sample, roll.copied().unwrap_or(Turn::ZERO))
    }
}

impl Engine for HostEngine {
    fn upload(&mut self, first: u64, points: &[ControlPoint]) -> Done<u64> {
        let start = Instant::now();
        let changed = self.points.upload(&self.plan, first, points);
        self.timings.upload += start.elapsed();
        Ok((changed.end - changed.start) * size_of::<ControlPoint>() as u64)
    }

    fn scan(&mut self, _chunks: ScanChunks<'_>) -> Done {
        let (start, plan) = (Instant::now(), &self.plan);
        let mut rolls: Vec<Turn> = zeroed("rolls", plan.counts().rings)?;
        for (yarn, bounds) in plan.ring_offsets().windows(2).enumerate() {
            let rolls = &mut rolls[bounds[0] as usize..bounds[1] as usize];
            let (last, twist, mut here) = (rolls.len() - 1, plan.turns_per_mm(yarn), self.sample(yarn, 0));
            for ring in 1..=last {
                let next = self.sample(yarn, ring as u32);
                let (from, to, chord) = (here.sample.tangent, next.sample.tangent, here.chord_to(&next));
                rolls[ring] = rolls[ring - 1] + plan.frame(yarn).step(from, to, chord, twist);
                here = next;
            }
            let whole = if plan.yarn(yarn).closed { std::mem::take(&mut rolls[last]) } else { Turn::ZERO };
            (0..last).for_each(|ring| rolls[ring] = rolls[ring] - whole.share(ring as u32, last as u32));
        }
        self.rolls = rolls;
        self.timings.scan += start.elapsed();
        Ok(())
    }

    fn load(&mut self, _: Slot, _: &Chunk) -> Done {
        Ok(())
    }
    fn trajectory(&mut self, slot: Slot, chunk: &Chunk) -> Done {
        let (start, mut rings) = (Instant::now(), zeroed("rings", chunk.rings().into())?);
        for block in chunk.blocks() {
            let ring = |k| self.ring(block.yarn, block.first_ring + k);
            put(&mut rings, block.chunk_ring, (0..block.rings).map(ring));
        }
        self.rings[slot.index()] = rings;
        self.timings.trajectory += start.elapsed();
        Ok(())
    }

    fn mesh(&mut self, slot: Slot, chunk: &Chunk) -> Done {
        let (start, plan, sides) = (Instant::now(), &self.plan, self.plan.settings().sides);
        let mut vertices: Vec<Vertex> = zeroed("vertices", chunk.vertices().into())?;
        let (mut indices, pattern) = (zeroed("indices", chunk.indices().into())?, index_pattern(sides));
        for block in chunk.blocks() {
            let outline = plan.outline(plan.yarn(block.yarn as usize).section as usize);
            for k in 0..block.rings {
                let ring = self.ring(block.yarn, block.first_ring + k);
                let (stance, first) = (ring.stance(), block.first_vertex + k * sides);
                put(&mut vertices, first, outline.iter().map(|point| ring.vertex(&stance, point)));
                if k < block.quads {
                    put(&mut indices, block.first_index + k * sides * 6, pattern.iter().map(|i| first + i));
                }
            }
        }
        for cap in chunk.caps() {
            let yarn = cap.yarn as usize;
            let (end, sign) = if cap.end == End::Start { (0, -1.0) } else { (plan.rings(yarn) - 1, 1.0) };
            let normal = self.ring(cap.yarn, end).tangent.map(|along| along * sign);
            let (rim, own) = ((cap.chunk_ring * sides) as usize, cap.first_vertex as usize);
            vertices.copy_within(rim..rim + sides as usize, own);
            vertices[own..own + sides as usize].iter_mut().for_each(|vertex| vertex.normal = normal);
            let corners = plan.cap_indices(plan.yarn(yarn).section as usize, cap.end);
            put(&mut indices, cap.first_index, corners.map(|corner| cap.first_vertex + corner));
        }
        self.meshes[slot.index()] = (vertices, indices);
        self.timings.mesh += start.elapsed();
        Ok(())
    }

    fn read_trajectory(&mut self, slot: Slot, _: &Chunk, sink: RingSink<'_>) -> Done<ControlFlow<()>> {
        Ok(sink(&self.rings[slot.index()]))
    }
    fn read_mesh(&mut self, slot: Slot, _: &Chunk, sink: MeshSink<'_>) -> Done<ControlFlow<()>> {
        let (vertices, indices) = &self.meshes[slot.index()];
        let pieces = [MeshPiece::Vertices { first: 0, vertices }, MeshPiece::Indices { first: 0, indices }];
        Ok(pieces.into_iter().try_for_each(sink))
    }
    fn lends_its_own(&self) -> bool {
        true // results lie in the host's memory
    }
    fn timings(&mut self) -> StageTimings {
        self.timings
    }
}

fn put<T>(out: &mut [T], first: u32, values: impl Iterator<Item = T>) {
    out.iter_mut().skip(first as usize).zip(values).for_each(|(place, value)| *place = value);
}
