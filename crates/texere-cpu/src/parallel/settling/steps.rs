//! The steps of control points, a vector of them at a time.

use texere_core::settling::{
    BEND, BENDS_MIN, CONTACTS_MIN, CROSSING, CROSSING_SHARE, Form, INERTIA, Pass, Place, STEP_DIAMETER,
    STEP_NEAR, SettlingPlan, SettlingSeen, moves,
};

use super::tables::{FRONT, PullRow};
use crate::parallel::simd::{
    Floats, IN_TURN, Integers, LANES_MAX, Simd, difference, dot, plus, rounded, scale, select, share,
};

/// The input of all steps of a pass.
#[derive(Debug, Clone, Copy)]
pub(super) struct Gather<'a> {
    pub(super) plan: &'a SettlingPlan,
    pub(super) pass: &'a Pass,
    /// All places. [`FRONT`] entries come before the first.
    pub(super) places: &'a [Place],
    /// The pulls of all intervals. [`FRONT`] entries come before the first.
    pub(super) pulls: &'a [PullRow],
}

impl Gather<'_> {
    /// Moves the places from number `first` on, one for each of `steps`, and returns the longest
    /// step, mm.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn step<S: Simd>(
        &self,
        simd: S,
        first: usize,
        steps: &mut [[f32; 4]],
        next: &mut [Place],
    ) -> f32 {
        let mut longest = SettlingSeen::NOTHING.step;
        let (zero, units) = (simd.splat(0.0), simd.splat(1.0 / self.plan.scale().unit()));
        for (number, (steps, next)) in steps.chunks_mut(S::LANES).zip(next.chunks_mut(S::LANES)).enumerate() {
            let place = first + number * S::LANES;
            let mut lasts = [[0.0; 4]; LANES_MAX];
            lasts[..steps.len()].copy_from_slice(steps);
            let [x, y, z, _] = simd.components(&lasts);
            let step = self.vector(simd, place, [x, y, z]);
            let length = dot(step, step).sqrt();
            let moved = rounded(simd, scale(step, units));
            let (mut lengths, mut made) = ([0.0; LANES_MAX], [[0.0; 4]; LANES_MAX]);
            length.store(&mut lengths);
            simd.scatter([step[0], step[1], step[2], zero], made.as_flattened_mut(), 4);
            let mut ways = [[0; LANES_MAX]; 3];
            for axis in 0..3 {
                moved[axis].store(&mut ways[axis]);
            }
            for (lane, (step, next)) in steps.iter_mut().zip(next).enumerate() {
                *next = self.places[FRONT + place + lane];
                if moves(self.plan.tags()[place + lane]) {
                    *step = made[lane];
                    let way = ways.map(|way| way[lane].cast_signed());
                    *next = next.moved(way.into());
                    longest = longest.max(lengths[lane]);
                }
            }
        }
        longest
    }

    /// `Gathered::step` of the core.
    #[cfg_attr(optimized, inline(always))]
    fn vector<S: Simd>(&self, simd: S, place: usize, last: [S::Floats; 3]) -> [S::Floats; 3] {
        let (plan, pass) = (self.plan, self.pass);
        let (zero, one) = (simd.splat(0.0), simd.splat(1.0));
        let block = pass.form == Form::Block;
        let mut sums = [zero; 12];
        let mut near = simd.splat(f32::INFINITY);
        let mut clearance = near;
        for slot in 0..4 {
            let pulls = PullRow::rows(&self.pulls[FRONT + place + 1 - slot..]);
            for row in 0..if block { 3 } else { 2 } {
                let values = simd.rows(pulls, &IN_TURN, 3 * slot + row);
                for (sum, value) in sums[4 * row..].iter_mut().zip(values) {
                    *sum = *sum + value;
                }
            }
            let [distance, ratio, ..] = simd.rows(pulls, &IN_TURN, PullRow::SEEN);
            (near, clearance) = (near.min(distance), clearance.min(ratio));
        }
        let places = &self.places[FRONT + place..];
        let (mut diameters, mut presses) = ([0.0; LANES_MAX], [0.0; LANES_MAX]);
        for lane in 0..S::LANES {
            let (width, height) = (places[lane].halves.width(), places[lane].halves.height());
            diameters[lane] = 2.0 * width.min(height);
            presses[lane] = pass.press(plan, &places[lane]);
        }
        let (diameter, press) = (simd.load(&diameters), simd.load(&presses));
        let on = scale(last, simd.splat(pass.momentum));
        let step = if block {
            let [x, y, z, xx, xy, xz, yy, yz, zz, ..] = sums;
            let inertia = simd.splat(INERTIA);
            let solved = solved(simd, [xx + inertia, xy, xz, yy + inertia, yz, zz + inertia], [x, y, z]);
            let mut step = plus(solved, on);
            step[2] = step[2] + press;
            step
        } else {
            let [cx, cy, cz, contacts, bx, by, bz, bends, ..] = sums;
            let room = clearance / simd.splat(pass.growth) - simd.splat(CROSSING);
            let apart = share(simd, room * simd.splat(CROSSING_SHARE));
            let bend = scale([bx, by, bz], simd.splat(BEND) / bends.max(simd.splat(BENDS_MIN)));
            let pulls = PullRow::rows(&self.pulls[FRONT + place - 1..]);
            let [bx, by, bz, _] = simd.rows(pulls, &IN_TURN, PullRow::LENGTH);
            let [x, y, z, _] = simd.rows(&pulls[1..], &IN_TURN, PullRow::LENGTH);
            let mut others = plus(plus(bend, difference([x, y, z], [bx, by, bz])), on);
            others[2] = others[2] + press;
            plus(scale([cx, cy, cz], one / contacts.max(simd.splat(CONTACTS_MIN))), scale(others, apart))
        };
        let most = (simd.splat(STEP_NEAR) * near).min(simd.splat(STEP_DIAMETER) * diameter);
        let length = dot(step, step).sqrt();
        select(most.less(length), scale(step, most / length), step)
    }
}

/// `solved` of the core.
#[cfg_attr(optimized, inline(always))]
fn solved<S: Simd>(
    simd: S,
    [xx, xy, xz, yy, yz, zz]: [S::Floats; 6],
    [x, y, z]: [S::Floats; 3],
) -> [S::Floats; 3] {
    let (a, b, c) = (yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy);
    let (d, e, f) = (xx * zz - xz * xz, xy * xz - xx * yz, xx * yy - xy * xy);
    let determinant = xx * a + xy * b + xz * c;
    let inverse = simd.splat(1.0) / determinant.max(simd.splat(INERTIA * INERTIA * INERTIA));
    [(a * x + b * y + c * z) * inverse, (b * x + d * y + e * z) * inverse, (c * x + e * y + f * z) * inverse]
}
