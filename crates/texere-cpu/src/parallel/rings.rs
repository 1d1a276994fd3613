//! Stage 1 for a block: rings in lanes, one array for each component, in loops that vectorise.
//!
//! The formulas and their order are those of `Segment`, `Basis` and `Frame` in the core, so the bits are the same. Where
//! those branch for a rare case (a yarn at rest, a tangent along z), the loops here only notice it, and the core's own
//! function is called for that ring.

use texere_core::{
    BLOCK_RINGS, Basis, Block, ControlPoint, NO_LENGTH, PaddedPoints, Plan, RADIUS_FLOOR, Ring, SLOPE_LIMIT,
    Turn, VERTICAL, ZERO_VELOCITY,
};

use crate::session::Work;

/// Rings in a full block.
pub(super) const FULL: usize = BLOCK_RINGS as usize;

/// Room for the rings of a block and the one after it, in whole vectors.
pub(super) const N: usize = FULL + 8;

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
    pub(super) roll: [Turn; N],
    /// From each centre to the next one.
    pub(super) chord: [Lane; 3],
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
            chord: [ZERO; 3],
            still: ZERO,
            floor: ZERO,
        }
    }

    /// Makes the rings of `block`, whose number among all of the plan is `number`.
    #[inline(always)]
    pub(super) fn make(&mut self, work: &Work, block: &Block, number: u64) {
        let yarn = block.yarn as usize;
        self.upright(&work.plan, &work.points, yarn, block.first_ring, block.rings as usize);
        if work.plan.settings().frame.is_level(work.plan.twist_turns(yarn)) {
            self.roll = [Turn::ZERO; N];
        } else {
            self.turn(work, block, number);
        }
    }

    /// Makes `count` rings of `yarn` from `first` on, without rolls.
    #[inline(always)]
    pub(super) fn upright(
        &mut self,
        plan: &Plan,
        points: &PaddedPoints,
        yarn: usize,
        first: u32,
        count: usize,
    ) {
        self.count = count;
        self.evaluate(plan, points, yarn, first);
        self.tangents(plan, points, yarn, first);
        self.bases();
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

    /// Centre, radius, velocity (in `tangent`), growth (in `slope`) and chord: each interval's cubic, at each of its rings.
    #[inline(always)]
    fn evaluate(&mut self, plan: &Plan, points: &PaddedPoints, yarn: usize, first: u32) {
        let points: &[[f32; 4]] = bytemuck::cast_slice::<ControlPoint, _>(points.yarn(plan, yarn));
        let (s, step, per_interval) =
            (plan.sampling().s(), plan.sampling().step(), plan.settings().subdivisions + 1);
        // The last ring of an open yarn is t = 1 of the interval before.
        let last = if plan.yarn(yarn).closed { u32::MAX } else { plan.rings(yarn) - 1 };
        let mut interval = (first / per_interval) as usize - usize::from(first == last);
        let mut place = first % per_interval;
        let mut cubic = Cubic::new(points, interval, s);
        for k in 0..self.count {
            let at_end = first + k as u32 == last;
            if k > 0 && place == 0 && !at_end {
                interval += 1;
                cubic = Cubic::new(points, interval, s);
            }
            let t = if at_end { 1.0 } else { place as f32 * step };
            let (offset, velocity) = cubic.at(t);
            let ends_interval = place + 1 == per_interval;
            for axis in 0..3 {
                self.centre[axis][k] = cubic.start[axis] + offset[axis];
                self.tangent[axis][k] = velocity[axis];
                // Within an interval the next ring completes the chord.
                self.chord[axis][k] =
                    if ends_interval { cubic.span[axis] - offset[axis] } else { -offset[axis] };
                if k > 0 && place > 0 {
                    self.chord[axis][k - 1] += offset[axis];
                }
            }
            (self.radius[k], self.slope[k]) = (cubic.start[3] + offset[3], velocity[3]);
            (self.still[k], self.floor[k]) = (cubic.still, cubic.floor);
            place = if ends_interval { 0 } else { place + 1 };
        }
    }

    /// Unit tangents from velocities, slopes from growths, radii held above their floor.
    #[inline(always)]
    fn tangents(&mut self, plan: &Plan, points: &PaddedPoints, yarn: usize, first: u32) {
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
            self.mend_rest(plan, points, yarn, first);
        }
        for k in 0..N {
            let held = self.radius[k] < self.floor[k];
            self.radius[k] = if held { self.floor[k] } else { self.radius[k] };
            self.slope[k] = if held { 0.0 } else { self.slope[k] };
        }
    }

    /// Rings without velocity: the core knows their direction.
    #[cold]
    fn mend_rest(&mut self, plan: &Plan, points: &PaddedPoints, yarn: usize, first: u32) {
        let (padded, rings, closed) = (points.yarn(plan, yarn), plan.rings(yarn), plan.yarn(yarn).closed);
        for k in (0..self.count).filter(|&k| self.still[k] >= 0.0) {
            let sample = plan.sampling().sample(padded, first + k as u32, rings, closed).sample;
            for axis in 0..3 {
                self.tangent[axis][k] = sample.tangent[axis];
            }
            self.slope[k] = sample.slope;
        }
    }

    /// Upright sides and ups.
    #[inline(always)]
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
}

/// One interval of the spline: the coefficients of `Segment`, four components at a time.
struct Cubic {
    start: [f32; 4],
    span: [f32; 4],
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
    #[inline(always)]
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
            span: b,
            terms: [
                each(|k| (b[k] - a[k]) * s),
                each(|k| a[k] * doubled + b[k] * rest - c[k] * s),
                each(|k| (c[k] - a[k]) * s + b[k] * less),
            ],
            still: (ZERO_VELOCITY * (squared(a) + squared(b) + squared(c))).max(NO_LENGTH),
            floor: start[3].min(end[3]) * RADIUS_FLOOR,
        }
    }

    /// Offset from the start, and derivative, at `t`.
    #[inline(always)]
    fn at(&self, t: f32) -> ([f32; 4], [f32; 4]) {
        let [c1, c2, c3] = &self.terms;
        let thrice = 3.0 * t;
        (
            each(|k| (c1[k] + (c2[k] + c3[k] * t) * t) * t),
            each(|k| c1[k] + (c2[k] * 2.0 + c3[k] * thrice) * t),
        )
    }
}
