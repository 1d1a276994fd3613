//! The search of one ray for the first triangle on its way. Triangles are made only in blocks whose
//! boxes the ray meets.

use texere_core::backend::BLOCK_RINGS;
use texere_core::definitions::Ring;
use texere_core::{Bounds, End, MeshPlace, Ray};

use super::beam::{Beam, Touch};
use super::picker::Picker;
use crate::serial::rings;

/// The number of rings of a block, and one more: the block's last triangles end at the first ring
/// of the next block.
const RINGS: usize = BLOCK_RINGS as usize + 1;

/// The factor by which reaches ([`Picker::reaches`]) are enlarged. Rounding in sections and frames
/// may put a vertex slightly beyond its section's reach.
const REACH_SLACK: f32 = 1.0 + 1e-5;

/// The first triangle that a ray hits. [`YarnPlace::at`](texere_core::YarnPlace::at) takes the
/// yarn, the interval and `t` of the hit. A structure's `place` then names that place in a weaver's
/// or a knitter's terms.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// Distance from the ray's origin, in lengths of the ray's direction: in mm if the direction
    /// has length 1.
    pub distance: f64,
    /// The triangle's place.
    pub place: MeshPlace,
    /// The point that is hit, mm.
    pub position: [f64; 3],
    /// The control interval of the yarn, counted from 0.
    pub interval: u32,
    /// Position along the interval, from 0 to 1, interpolated between the triangle's two rings. On
    /// a cap it is the position of the yarn's end.
    pub t: f64,
}

impl Picker {
    /// The first triangle that `ray` hits, from either side. If several triangles lie at the same
    /// distance, it is the triangle of the yarn with the lowest number, and on that yarn the first
    /// one. None if the ray hits nothing, has a direction of zero, or has numbers that are not
    /// finite.
    #[must_use]
    pub fn pick(&self, ray: &Ray) -> Option<Hit> {
        Search::new(self, Beam::new(ray)?).run()
    }
}

/// The search of one ray through the cloth.
#[derive(Debug)]
struct Search<'a> {
    picker: &'a Picker,
    beam: Beam,
    /// The vertices of the rings that are being tested: two rings of a tube, or one of a cap.
    corners: Vec<[f32; 3]>,
    nearest: Option<Nearest>,
}

/// The nearest triangle so far.
#[derive(Debug, Clone, Copy)]
struct Nearest {
    touch: Touch,
    corners: [[f32; 3]; 3],
    place: MeshPlace,
    /// Position of the hit between the place's ring and the next, from 0 to 1.
    onward: f64,
}

impl Nearest {
    /// The values by which hits are ordered. Hits at equal distances are ordered along the yarns,
    /// so that the result does not depend on the order in which boxes are visited.
    fn order(&self) -> (f64, u32, u32, Option<bool>, u32) {
        let MeshPlace { yarn, ring, side, cap } = self.place;
        (self.touch.along, yarn, ring, cap.map(|end| end == End::Finish), side)
    }
}

impl<'a> Search<'a> {
    fn new(picker: &'a Picker, beam: Beam) -> Self {
        Self { picker, beam, corners: Vec::new(), nearest: None }
    }

    /// Searches the whole cloth.
    fn run(mut self) -> Option<Hit> {
        let picker = self.picker;
        let (mut most, beam) = (f64::INFINITY, self.beam);
        picker.cloth.visit(&beam, &mut most, &mut |position| {
            let yarn = picker.order[position] as usize;
            let mut most = self.most();
            picker.yarns[yarn].visit(&beam, &mut most, &mut |block| {
                self.block(yarn, block as u32);
                self.most()
            });
            most
        });
        self.hit()
    }

    /// The distance of the nearest hit so far. Triangles beyond it do not matter.
    fn most(&self) -> f64 {
        self.nearest.map_or(f64::INFINITY, |nearest| nearest.touch.along)
    }

    /// Tests the triangles of a block.
    fn block(&mut self, yarn: usize, block: u32) {
        let plan = &self.picker.work.plan;
        let (first, all) = (block * BLOCK_RINGS, plan.rings(yarn));
        let left = all - first;
        let mut made = [Ring::default(); RINGS];
        let made = &mut made[..RINGS.min(left as usize)];
        rings(&self.picker.work, yarn, first, made);
        for (k, pair) in (first..).zip(made.windows(2)) {
            if self.may_meet(yarn, pair) {
                self.tube(yarn, k, pair);
            }
        }
        if plan.settings().caps && !plan.yarn(yarn).closed {
            if first == 0 {
                self.cap(yarn, End::Start, 0, &made[0]);
            }
            if left <= BLOCK_RINGS {
                self.cap(yarn, End::Finish, all - 1, &made[made.len() - 1]);
            }
        }
    }

    /// Whether the ray may meet the tube between the first and the last of `rings`.
    fn may_meet(&self, yarn: usize, rings: &[Ring]) -> bool {
        let section = self.picker.work.plan.yarn(yarn).section;
        let reach = self.picker.reaches[section as usize] * REACH_SLACK;
        let around = |ring: &Ring| {
            let reach = ring.half_width.max(ring.half_height) * reach;
            let slack = ring.centre.iter().fold(reach, |most, at| most.max(at.abs())) * (4.0 * f32::EPSILON);
            Bounds {
                low: ring.centre.map(|at| at - reach - slack),
                high: ring.centre.map(|at| at + reach + slack),
            }
        };
        let bounds = rings.iter().map(around).fold(Bounds::NOTHING, |all, one| all.joined(&one));
        self.beam.enters(&bounds, self.most()).is_some()
    }

    /// Tests the triangles between ring number `ring` and the next.
    fn tube(&mut self, yarn: usize, ring: u32, pair: &[Ring]) {
        self.stand(yarn, pair);
        let picker = self.picker;
        for (triangle, indices) in (0..).zip(picker.pattern.as_chunks::<3>().0) {
            let place = MeshPlace { yarn: yarn as u32, ring, side: triangle / 2, cap: None };
            // The vertices of the next ring come after those of the first.
            let sides = self.corners.len() / 2;
            let beyond = |touch: &Touch| {
                let weights = indices.iter().zip(touch.weights);
                weights.filter(|(index, _)| **index as usize >= sides).map(|(_, weight)| weight).sum()
            };
            self.triangle(*indices, place, beyond);
        }
    }

    /// Tests the triangles of a cap on ring number `number`.
    fn cap(&mut self, yarn: usize, end: End, number: u32, ring: &Ring) {
        if !self.may_meet(yarn, std::slice::from_ref(ring)) {
            return;
        }
        self.stand(yarn, std::slice::from_ref(ring));
        let picker = self.picker;
        let plan = &picker.work.plan;
        let place = MeshPlace { yarn: yarn as u32, ring: number, side: 0, cap: Some(end) };
        let mut indices = plan.cap_indices(plan.yarn(yarn).section as usize, end);
        while let (Some(a), Some(b), Some(c)) = (indices.next(), indices.next(), indices.next()) {
            self.triangle([a, b, c], place, |_| 0.0);
        }
    }

    /// Makes the vertices of `rings`, in place of those before.
    fn stand(&mut self, yarn: usize, rings: &[Ring]) {
        let plan = &self.picker.work.plan;
        let outline = plan.outline(plan.yarn(yarn).section as usize);
        self.corners.clear();
        for ring in rings {
            let stance = ring.stance();
            self.corners.extend(outline.iter().map(|point| ring.vertex(&stance, point).position));
        }
    }

    fn triangle(&mut self, indices: [u32; 3], place: MeshPlace, onward: impl Fn(&Touch) -> f64) {
        let corners = indices.map(|index| self.corners[index as usize]);
        let Some(touch) = self.beam.touches(corners) else { return };
        let found = Nearest { touch, corners, place, onward: onward(&touch) };
        if self.nearest.is_none_or(|nearest| found.order() < nearest.order()) {
            self.nearest = Some(found);
        }
    }

    fn hit(&self) -> Option<Hit> {
        let Nearest { touch, corners, place, onward } = self.nearest?;
        let plan = &self.picker.work.plan;
        let along = |axis: usize| {
            corners.iter().zip(touch.weights).map(|(corner, weight)| f64::from(corner[axis]) * weight).sum()
        };
        let per_interval = plan.settings().subdivisions + 1;
        let (mut interval, step) = (place.ring / per_interval, place.ring % per_interval);
        let mut t = (f64::from(step) + onward) / f64::from(per_interval);
        if place.cap == Some(End::Finish) {
            (interval, t) = (interval - 1, 1.0);
        }
        Some(Hit {
            distance: self.beam.unscaled(touch.along),
            place,
            position: [0, 1, 2].map(along),
            interval,
            t: t.min(1.0),
        })
    }
}
