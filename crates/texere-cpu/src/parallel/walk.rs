//! A walk along a yarn, ring by ring: what rolls are made of.

use texere_core::{ControlPoint, PaddedPoints, Plan, RingSample, Sampling, Segment};

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
    let window = [padded[interval], padded[interval + 1], padded[interval + 2], padded[interval + 3]];
    Segment::new(&window, s)
}
