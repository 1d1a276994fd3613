//! One block: its rings, then its vertices, from tables and in loops of known length.

use texere_core::{
    BLOCK_RINGS, Block, ControlPoint, PaddedPoints, Plan, Ring, RingSample, Sampling, SectionPoint, Segment,
    Turn, Vertex,
};

use crate::session::Work;

/// The rings of a block with all that its vertices need.
pub(super) struct BlockRings {
    pub(super) rings: [Ring; BLOCK_RINGS as usize],
    pub(super) slopes: [f32; BLOCK_RINGS as usize],
}

impl Default for BlockRings {
    fn default() -> Self {
        Self { rings: [Ring::default(); _], slopes: [0.0; _] }
    }
}

/// Walks along a yarn ring by ring, making each interval's segment once.
pub(super) struct Walk<'a> {
    padded: &'a [ControlPoint],
    sampling: &'a Sampling,
    rings: u32,
    closed: bool,
    interval: usize,
    segment: Segment,
    /// The next ring, and its place in its interval, from 0 to K.
    ring: u32,
    place: u32,
}

impl<'a> Walk<'a> {
    /// Stands at ring `ring` of `yarn`.
    pub(super) fn new(plan: &'a Plan, points: &'a PaddedPoints, yarn: usize, ring: u32) -> Self {
        let (padded, sampling) = (points.yarn(plan, yarn), plan.sampling());
        let (rings, closed) = (plan.rings(yarn), plan.yarn(yarn).closed);
        let per_interval = sampling.subdivisions() + 1;
        let at_end = !closed && ring + 1 == rings;
        let interval = (ring / per_interval) as usize - usize::from(at_end);
        let segment = segment(padded, interval, sampling.s());
        Self { padded, sampling, rings, closed, interval, segment, ring, place: ring % per_interval }
    }

    /// The ring reached; moves on to the next.
    pub(super) fn step(&mut self) -> RingSample {
        let at_end = !self.closed && self.ring + 1 == self.rings;
        let t = if at_end { 1.0 } else { self.place as f32 * self.sampling.step() };
        let sample = self.segment.sample(t);
        let ends_interval = self.place == self.sampling.subdivisions();
        let here = RingSample { sample, span: self.segment.span(), ends_interval };
        self.ring += 1;
        self.place += 1;
        if ends_interval {
            self.place = 0;
            // The last ring of an open yarn stays on the last segment, at t = 1.
            if self.ring + u32::from(!self.closed) < self.rings {
                self.interval += 1;
                self.segment = segment(self.padded, self.interval, self.sampling.s());
            }
        }
        here
    }
}

fn segment(padded: &[ControlPoint], interval: usize, s: f32) -> Segment {
    Segment::new(&[0, 1, 2, 3].map(|k| padded[interval + k]), s)
}

/// Stage 1 for one block, whose number among all is `number`.
pub(super) fn block_rings(work: &Work, block: &Block, number: u64, out: &mut BlockRings) {
    let (plan, yarn) = (&work.plan, block.yarn as usize);
    let twist = plan.twist_turns(yarn);
    let frame = plan.settings().frame;
    let level = frame.is_level(twist);
    let mut walk = Walk::new(plan, &work.points, yarn, block.first_ring);
    let mut roll = work.rolls.at_block(number);
    let mut here = walk.step();
    for k in 0..block.rings {
        let place = k as usize;
        let closed_up = work.rolls.closed_up(plan, yarn, block.first_ring + k, roll);
        let ring = Ring::new(&here.sample, if level { Turn::ZERO } else { closed_up });
        out.rings[place] = ring;
        out.slopes[place] = here.sample.slope;
        if k + 1 < block.rings {
            let next = walk.step();
            if !level {
                let chord = here.chord_to(&next);
                roll = roll + frame.step(here.sample.tangent, next.sample.tangent, chord, twist);
            }
            here = next;
        }
    }
}

impl BlockRings {
    /// Stage 2: the vertices of the first `count` rings, `outline.len()` each.
    pub(super) fn vertices(&self, count: usize, outline: &[SectionPoint], out: &mut [Vertex]) {
        // The usual numbers of sides get loops of known length, which the compiler unrolls and vectorises.
        match outline.len() {
            4 => self.vertices_of::<4>(count, outline, out),
            6 => self.vertices_of::<6>(count, outline, out),
            8 => self.vertices_of::<8>(count, outline, out),
            12 => self.vertices_of::<12>(count, outline, out),
            sides => {
                let rings = self.rings[..count].iter().zip(&self.slopes);
                for ((ring, slope), ring_out) in rings.zip(out.chunks_exact_mut(sides)) {
                    let basis = ring.basis();
                    for (vertex, point) in ring_out.iter_mut().zip(outline) {
                        *vertex = ring.vertex(&basis, *slope, point);
                    }
                }
            }
        }
    }

    fn vertices_of<const SIDES: usize>(&self, count: usize, outline: &[SectionPoint], out: &mut [Vertex]) {
        let Some(outline) = outline.first_chunk::<SIDES>() else { return };
        let (rings_out, _) = out.as_chunks_mut::<SIDES>();
        for ((ring, slope), ring_out) in self.rings[..count].iter().zip(&self.slopes).zip(rings_out) {
            let basis = ring.basis();
            for (vertex, point) in ring_out.iter_mut().zip(outline) {
                *vertex = ring.vertex(&basis, *slope, point);
            }
        }
    }
}

/// The indices of consecutive rings' quads, the first ring's vertices starting at `first_vertex`.
pub(super) fn indices(first_vertex: u32, sides: u32, pattern: &[u32], out: &mut [u32]) {
    let mut base = first_vertex;
    for quads in out.chunks_exact_mut(pattern.len()) {
        for (index, offset) in quads.iter_mut().zip(pattern) {
            *index = base + offset;
        }
        base += sides;
    }
}
