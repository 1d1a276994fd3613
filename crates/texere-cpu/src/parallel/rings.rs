//! Stage 1 for a block: rings in lanes, one array for each component, in loops that vectorise.
//!
//! The formulas and their order are those of `Segment`, `Basis` and `Frame` in the core, so the bits are the same. Where
//! those branch for a rare case (a yarn at rest, a tangent along z), the loops here only notice it, and the core's own
//! function is called for that ring.

use texere_core::{
    BLOCK_RINGS, Basis, Block, ControlPoint, RADIUS_FLOOR, Ring, SLOPE_LIMIT, Turn, VERTICAL, ZERO_VELOCITY,
};

use super::walk::Walk;
use crate::session::Work;

/// Rings in a full block.
const N: usize = BLOCK_RINGS as usize;

/// One component of all rings of a block.
pub(super) type Lane = [f32; N];

/// The rings of a block, with all that their vertices need.
pub(super) struct BlockRings {
    pub(super) count: usize,
    pub(super) centre: [Lane; 3],
    pub(super) radius: Lane,
    pub(super) tangent: [Lane; 3],
    pub(super) slope: Lane,
    pub(super) side: [Lane; 3],
    pub(super) up: [Lane; 3],
    roll: [Turn; N],
    /// While a block is made: what counts as no velocity, and as too thin.
    still: Lane,
    floor: Lane,
}

impl BlockRings {
    pub(super) fn new() -> Self {
        const ZERO: Lane = [0.0; N];
        Self {
            count: 0,
            centre: [ZERO; 3],
            radius: ZERO,
            tangent: [ZERO; 3],
            slope: ZERO,
            side: [ZERO; 3],
            up: [ZERO; 3],
            roll: [Turn::ZERO; N],
            still: ZERO,
            floor: ZERO,
        }
    }

    /// Makes the rings of `block`, whose number among all of the plan is `number`.
    pub(super) fn make(&mut self, work: &Work, block: &Block, number: u64) {
        self.count = block.rings as usize;
        self.evaluate(work, block);
        self.tangents(work, block);
        self.bases();
        let frame = work.plan.settings().frame;
        if frame.is_level(work.plan.twist_turns(block.yarn as usize)) {
            self.roll = [Turn::ZERO; N];
        } else {
            self.rolls(work, block, number);
        }
    }

    /// Ring `k` of the block.
    #[inline]
    pub(super) fn ring(&self, k: usize) -> Ring {
        Ring {
            centre: [self.centre[0][k], self.centre[1][k], self.centre[2][k]],
            radius: self.radius[k],
            tangent: [self.tangent[0][k], self.tangent[1][k], self.tangent[2][k]],
            roll: self.roll[k],
        }
    }

    /// Centre, radius, velocity (in `tangent`) and growth (in `slope`): each interval's cubic, at each of its rings.
    fn evaluate(&mut self, work: &Work, block: &Block) {
        let (plan, yarn) = (&work.plan, block.yarn as usize);
        let points: &[[f32; 4]] = bytemuck::cast_slice::<ControlPoint, _>(work.points.yarn(plan, yarn));
        let (s, step, per_interval) =
            (plan.sampling().s(), plan.sampling().step(), plan.settings().subdivisions + 1);
        // The last ring of an open yarn is t = 1 of the interval before.
        let last = if plan.yarn(yarn).closed { u32::MAX } else { plan.rings(yarn) - 1 };
        let mut interval = (block.first_ring / per_interval) as usize - usize::from(block.first_ring == last);
        let mut place = block.first_ring % per_interval;
        let mut cubic = Cubic::new(points, interval, s);
        for k in 0..self.count {
            let at_end = block.first_ring + k as u32 == last;
            if k > 0 && place == 0 && !at_end {
                interval += 1;
                cubic = Cubic::new(points, interval, s);
            }
            let t = if at_end { 1.0 } else { place as f32 * step };
            let (value, velocity) = cubic.at(t);
            for axis in 0..3 {
                self.centre[axis][k] = value[axis];
                self.tangent[axis][k] = velocity[axis];
            }
            (self.radius[k], self.slope[k]) = (value[3], velocity[3]);
            (self.still[k], self.floor[k]) = (cubic.still, cubic.floor);
            place = if place + 1 == per_interval { 0 } else { place + 1 };
        }
    }

    /// Unit tangents from velocities, slopes from growths, radii held above their floor.
    fn tangents(&mut self, work: &Work, block: &Block) {
        let [vx, vy, vz] = &mut self.tangent;
        let mut at_rest = false;
        for k in 0..N {
            let speed_squared = vx[k] * vx[k] + vy[k] * vy[k] + vz[k] * vz[k];
            // Past `count` lie the leavings of another block, which may rest.
            at_rest |= k < self.count && (speed_squared <= self.still[k]);
            let inverse = 1.0 / speed_squared.sqrt();
            vx[k] *= inverse;
            vy[k] *= inverse;
            vz[k] *= inverse;
            self.slope[k] = (self.slope[k] * inverse).clamp(-SLOPE_LIMIT, SLOPE_LIMIT);
            self.still[k] -= speed_squared;
        }
        if at_rest {
            self.mend_rest(work, block);
        }
        for k in 0..N {
            let held = self.radius[k] < self.floor[k];
            self.radius[k] = if held { self.floor[k] } else { self.radius[k] };
            self.slope[k] = if held { 0.0 } else { self.slope[k] };
        }
    }

    /// Rings without velocity: the core knows their direction.
    #[cold]
    fn mend_rest(&mut self, work: &Work, block: &Block) {
        let (plan, yarn) = (&work.plan, block.yarn as usize);
        let (padded, rings, closed) =
            (work.points.yarn(plan, yarn), plan.rings(yarn), plan.yarn(yarn).closed);
        for k in (0..self.count).filter(|&k| self.still[k] >= 0.0) {
            let sample = plan.sampling().sample(padded, block.first_ring + k as u32, rings, closed).sample;
            for axis in 0..3 {
                self.tangent[axis][k] = sample.tangent[axis];
            }
            self.slope[k] = sample.slope;
        }
    }

    /// Upright sides and ups.
    fn bases(&mut self) {
        let ([tx, ty, tz], [sx, sy, sz], [ux, uy, uz]) = (&self.tangent, &mut self.side, &mut self.up);
        let mut vertical = false;
        for k in 0..N {
            let level = tx[k] * tx[k] + ty[k] * ty[k];
            vertical |= k < self.count && level < VERTICAL;
            let inverse = 1.0 / level.sqrt();
            let (x, y) = (-ty[k] * inverse, tx[k] * inverse);
            (sx[k], sy[k], sz[k]) = (x, y, 0.0);
            (ux[k], uy[k], uz[k]) = (-tz[k] * y, tz[k] * x, tx[k] * y - ty[k] * x);
        }
        if vertical {
            self.mend_vertical();
        }
    }

    /// Rings whose tangent is along z: the core knows their side.
    #[cold]
    fn mend_vertical(&mut self) {
        for k in 0..self.count {
            let tangent = glam::Vec3::from_array(self.ring(k).tangent);
            self.set_basis(k, &Basis::upright(tangent));
        }
    }

    fn set_basis(&mut self, k: usize, basis: &Basis) {
        for axis in 0..3 {
            self.side[axis][k] = basis.side[axis];
            self.up[axis][k] = basis.up[axis];
        }
    }

    /// Rolls from the block's start on, and the bases turned by them.
    fn rolls(&mut self, work: &Work, block: &Block, number: u64) {
        let (plan, yarn) = (&work.plan, block.yarn as usize);
        let (twist, frame) = (plan.twist_turns(yarn), plan.settings().frame);
        let mut walk = Walk::new(plan, &work.points, yarn, block.first_ring);
        let mut sum = work.rolls.at_block(number);
        let mut here = walk.step();
        for k in 0..self.count {
            self.roll[k] = work.rolls.closed_up(plan, yarn, block.first_ring + k as u32, sum);
            self.set_basis(k, &self.ring(k).basis());
            if k + 1 < self.count {
                let next = walk.step();
                let chord = here.chord_to(&next);
                sum = sum + frame.step(here.sample.tangent, next.sample.tangent, chord, twist);
                here = next;
            }
        }
    }
}

/// One interval of the spline: the coefficients of `Segment`, four components at a time.
struct Cubic {
    start: [f32; 4],
    terms: [[f32; 4]; 3],
    still: f32,
    floor: f32,
}

/// `f` of each of the four components.
#[inline(always)]
fn each(f: impl FnMut(usize) -> f32) -> [f32; 4] {
    std::array::from_fn(f)
}

impl Cubic {
    fn new(points: &[[f32; 4]], interval: usize, s: f32) -> Self {
        let [before, start, end, after] =
            [points[interval], points[interval + 1], points[interval + 2], points[interval + 3]];
        let a = each(|k| before[k] - start[k]);
        let b = each(|k| end[k] - start[k]);
        let c = each(|k| after[k] - start[k]);
        let (doubled, rest, less) = (2.0 * s, 3.0 - 2.0 * s, s - 2.0);
        let squared = |v: [f32; 4]| v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
        Self {
            start,
            terms: [
                each(|k| (b[k] - a[k]) * s),
                each(|k| a[k] * doubled + b[k] * rest - c[k] * s),
                each(|k| (c[k] - a[k]) * s + b[k] * less),
            ],
            still: ZERO_VELOCITY * (squared(a) + squared(b) + squared(c)),
            floor: start[3].min(end[3]) * RADIUS_FLOOR,
        }
    }

    /// Value and derivative at `t`.
    #[inline]
    fn at(&self, t: f32) -> ([f32; 4], [f32; 4]) {
        let [c1, c2, c3] = &self.terms;
        let thrice = 3.0 * t;
        (
            each(|k| self.start[k] + (c1[k] + (c2[k] + c3[k] * t) * t) * t),
            each(|k| c1[k] + (c2[k] * 2.0 + c3[k] * thrice) * t),
        )
    }
}
