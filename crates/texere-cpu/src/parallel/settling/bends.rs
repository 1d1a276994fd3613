//! Pulls of an interval's own bends and length, a vector of intervals at a time.

use texere_core::settling::{
    BEND_MARGIN, BEND_PARTS, BEND_RADIUS, BLOCK_BEND, Form, GAUSS, GAUSS_WEIGHTS, Interval, Pass, Pull,
    SHORT, SOFT_BEND, SettlingPlan, bends, tag,
};

use super::curves::{Curve, acceleration, reach, velocity};
use super::tables::{IntervalRow, PullRow};
use crate::parallel::simd::{Floats, IN_TURN, LANES_MAX, Mask, Simd, difference, dot, plus, scale, select};

/// The intervals, and the lengths that they should have.
#[derive(Debug, Clone, Copy)]
pub(super) struct Own<'a> {
    pub(super) plan: &'a SettlingPlan,
    pub(super) pass: &'a Pass,
    pub(super) intervals: &'a [IntervalRow],
    /// The length that each interval should have, mm.
    pub(super) lengths: &'a [f32],
}

/// The slots of the core's `Pull` in lanes: nine numbers for each of an interval's four control
/// points.
type Slots<F> = [[F; 9]; 4];

impl Own<'_> {
    /// Adds the pulls of intervals' own bends and lengths to `pulls`. The first of `pulls` belongs
    /// to place `first`.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn add<S: Simd>(&self, simd: S, first: usize, pulls: &mut [PullRow]) {
        match self.pass.form {
            Form::Weighted => self.each::<S, false>(simd, first, pulls),
            Form::Block => self.each::<S, true>(simd, first, pulls),
        }
    }

    #[cfg_attr(optimized, inline(always))]
    fn each<S: Simd, const BLOCK: bool>(&self, simd: S, first: usize, pulls: &mut [PullRow]) {
        for (number, pulls) in pulls.chunks_mut(S::LANES).enumerate() {
            let place = first + number * S::LANES;
            self.vector::<S, BLOCK>(simd, place, pulls);
            for (pull, place) in pulls.iter_mut().zip(place..) {
                let tags = self.plan.tags()[place];
                if tags & tag::INTERVAL == 0 {
                    *pull = PullRow::NONE;
                }
            }
        }
    }

    #[cfg_attr(optimized, inline(always))]
    fn vector<S: Simd, const BLOCK: bool>(&self, simd: S, place: usize, pulls: &mut [PullRow]) {
        let (plan, pass, zero) = (self.plan, self.pass, simd.splat(0.0));
        let numbers: [u32; LANES_MAX] =
            std::array::from_fn(|lane| (place + lane.min(pulls.len() - 1)) as u32);
        let curve = Curve::<S>::new(simd, self.intervals, &numbers);
        let before = if BLOCK { slots::<S>(simd, pulls) } else { [[zero; 9]; 4] };
        let mut sums = before;
        let mut radius = simd.splat(f32::INFINITY);
        for u in (0..=BEND_PARTS).map(|part| part as f32 / BEND_PARTS as f32) {
            let weights = bends(u, plan.s());
            let sum = weights[0].abs() + weights[1].abs() + weights[2].abs() + weights[3].abs();
            let at = simd.splat(u);
            let (velocity, acceleration) =
                (velocity(simd, &curve.terms, at), acceleration(simd, &curve.terms, at));
            let square = dot(velocity, velocity).max(simd.splat(SHORT));
            let across = difference(acceleration, scale(velocity, dot(acceleration, velocity) / square));
            let bend = dot(across, across).sqrt();
            let bends = zero.less(bend);
            let towards = scale(across, simd.splat(1.0) / bend);
            let diameter = simd.splat(2.0) * reach(simd, curve.halves, at, velocity, towards);
            radius = bends.select(radius.min(square / (bend * diameter)), radius);
            let growth = simd.splat(pass.growth.max(0.5));
            let limit = square / (simd.splat(BEND_MARGIN * BEND_RADIUS) * diameter * growth);
            let soft = simd.splat(SOFT_BEND * pass.ease);
            let excess = limit.less(bend).select(bend - limit + soft * limit, soft * bend);
            let excess = bends.select(excess, zero);
            let counts = zero.less(excess);
            let towards = select(counts, towards, [zero; 3]);
            let way = scale(towards, excess / simd.splat(sum * sum));
            for (slot, weight) in sums.iter_mut().zip(weights) {
                let part = simd.splat(weight.abs() / sum);
                let part = counts.select(part, zero);
                let way = scale(way, simd.splat(-weight));
                if BLOCK {
                    let bend = simd.splat(BLOCK_BEND);
                    add_block(slot, scale(way, bend), towards, bend * part);
                } else {
                    for (sum, add) in slot[..4].iter_mut().zip([way[0], way[1], way[2], part]) {
                        *sum = *sum + add;
                    }
                }
            }
        }
        let ends = curve.speed(simd, GAUSS[0]) + curve.speed(simd, GAUSS[2]);
        let arc =
            ends * simd.splat(GAUSS_WEIGHTS[0]) + curve.speed(simd, GAUSS[1]) * simd.splat(GAUSS_WEIGHTS[1]);
        let [c1, c2, c3] = curve.terms;
        let chord = plus(plus(c1, c2), c3);
        let span = dot(chord, chord).sqrt();
        let along = select(zero.less(span), scale(chord, simd.splat(1.0) / span), [zero; 3]);
        let length = simd.load(&self.lengths[place..]);
        let ahead = scale(along, (arc - length) * simd.splat(0.5));
        if BLOCK {
            add_block(&mut sums[1], ahead, along, simd.splat(1.0));
            add_block(&mut sums[2], [-ahead[0], -ahead[1], -ahead[2]], along, simd.splat(1.0));
        }
        self.write::<S, BLOCK>(
            simd,
            place,
            &sums,
            [ahead[0], ahead[1], ahead[2], arc],
            (radius, (arc - length).abs() / length),
            pulls,
        );
    }

    #[cfg_attr(optimized, inline(always))]
    fn write<S: Simd, const BLOCK: bool>(
        &self,
        simd: S,
        place: usize,
        sums: &Slots<S::Floats>,
        length: [S::Floats; 4],
        (radius, off): (S::Floats, S::Floats),
        pulls: &mut [PullRow],
    ) {
        const STRIDE: usize = size_of::<PullRow>() / 4;
        let zero = simd.splat(0.0);
        let mut made = [PullRow::NONE; LANES_MAX];
        let floats: &mut [f32] = bytemuck::cast_slice_mut(&mut made);
        for (slot, [a, b, c, d, e, f, g, h, i]) in sums.iter().enumerate() {
            let to = &mut floats[12 * slot..];
            if BLOCK {
                simd.scatter([*a, *b, *c, *d], to, STRIDE);
                simd.scatter([*e, *f, *g, *h], &mut to[4..], STRIDE);
                simd.scatter([*i, zero, zero, zero], &mut to[8..], STRIDE);
            } else {
                simd.scatter([*a, *b, *c, *d], &mut to[4..], STRIDE);
            }
        }
        simd.scatter(length, &mut floats[48..], STRIDE);
        let (mut radii, mut offs) = ([0.0; LANES_MAX], [0.0; LANES_MAX]);
        radius.store(&mut radii);
        off.store(&mut offs);
        for (lane, (pull, made)) in pulls.iter_mut().zip(&made).enumerate() {
            let tags = self.plan.tags()[place + lane];
            let chords = self.plan.chords()[place + lane + 1] - self.plan.chords()[place + lane];
            if tags & (tag::OPENS | tag::ENDS) != 0 || chords > BEND_PARTS {
                // Bends at the ends of an open yarn count differently, and intervals of many chords
                // are measured in more places. The core's own function handles both cases.
                self.alone(place + lane, (tags, chords), pull);
                continue;
            }
            for (slot, made) in pull.slots.iter_mut().zip(made.slots) {
                if BLOCK {
                    *slot = made;
                } else {
                    slot[1] = made[1];
                }
            }
            pull.length = made.length;
            (pull.seen[2], pull.seen[3]) = (radii[lane], offs[lane]);
        }
    }

    fn alone(&self, place: usize, tags: (u32, u32), pull: &mut PullRow) {
        let mut own = Pull::none();
        for (slot, row) in own.slots.iter_mut().zip(&pull.slots) {
            slot.copy_from_slice(&row.as_flattened()[..9]);
        }
        let rows = &self.intervals[place].0;
        let interval = Interval::from_rows(rows);
        own.own(self.plan, self.pass, tags, &interval, self.lengths[place]);
        for (slot, row) in own.slots.iter().zip(&mut pull.slots) {
            row.as_flattened_mut()[..9].copy_from_slice(slot);
        }
        pull.length = [own.length.x, own.length.y, own.length.z, own.arc];
        let length = self.lengths[place];
        (pull.seen[2], pull.seen[3]) = (own.radius, (own.arc - length).abs() / length);
    }
}

/// The slots of as many consecutive intervals as there are lanes. Lanes past the last interval
/// repeat that interval.
#[cfg_attr(optimized, inline(always))]
fn slots<S: Simd>(simd: S, pulls: &[PullRow]) -> Slots<S::Floats> {
    let mut slots = [[simd.splat(0.0); 9]; 4];
    let last = pulls.len() as u32 - 1;
    let mut numbers = IN_TURN;
    for number in &mut numbers {
        *number = last.min(*number);
    }
    for (slot, sums) in slots.iter_mut().enumerate() {
        for row in 0..3 {
            let values = simd.rows(PullRow::rows(pulls), &numbers, 3 * slot + row);
            for (sum, value) in sums[4 * row..].iter_mut().zip(values) {
                *sum = value;
            }
        }
    }
    slots
}

#[cfg_attr(optimized, inline(always))]
fn add_block<F: Floats>(slot: &mut [F; 9], way: [F; 3], direction: [F; 3], weight: F) {
    let [dx, dy, dz] = direction;
    let [wx, wy, wz] = scale(direction, weight);
    let add = [way[0], way[1], way[2], wx * dx, wx * dy, wx * dz, wy * dy, wy * dz, wz * dz];
    for (sum, add) in slot.iter_mut().zip(add) {
        *sum = *sum + add;
    }
}
