//! Contacts, a vector of pairs of chords at a time.
//!
//! All pairs are looked at on their chords. Those that are near go on to their exact places, again in full vectors. What they
//! pull is then added up pair by pair, in the order of the lists.

use std::ops::Range;

use texere_core::settling::{CONTACT, Form, MARGIN, NEAR, Pass, SHORT, STRIDE, SettlingPlan, tag};

use super::curves::{Curve, weights};
use super::tables::{ChordRow, Fixed, IntervalRow, PullRow, rows};
use crate::parallel::simd::{
    Floats, Integers, LANES_MAX, Mask, Simd, between, difference, dot, plus, scale, select, share, to_bits,
    to_floats,
};

/// What pairs are made from.
#[derive(Debug, Clone, Copy)]
pub(super) struct Source<'a> {
    pub(super) plan: &'a SettlingPlan,
    pub(super) pass: &'a Pass,
    pub(super) fixed: &'a Fixed,
    pub(super) intervals: &'a [IntervalRow],
    pub(super) chords: &'a [ChordRow],
    /// Where each chord's neighbours begin, and the end of the last one's.
    pub(super) starts: &'a [u32],
    pub(super) neighbours: &'a [u32],
}

/// Memory of a task.
#[derive(Debug, Default)]
pub(super) struct Room {
    /// All pairs: both chords.
    ones: Vec<u32>,
    others: Vec<u32>,
    /// Those that are near: both chords, and where on them.
    near: [Vec<u32>; 2],
    shares: [Vec<f32>; 2],
}

impl Source<'_> {
    /// Adds the contacts of all chords in `own` to the sums of their intervals, the first of which is that of place `first`.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn add<S: Simd>(
        &self,
        simd: S,
        own: Range<u32>,
        first: u32,
        room: &mut Room,
        pulls: &mut [PullRow],
    ) {
        room.list(self, own);
        self.look(simd, room, first, pulls);
        if self.fixed.round {
            self.touch::<S, false>(simd, room, first, pulls);
        } else {
            self.touch::<S, true>(simd, room, first, pulls);
        }
    }

    /// Looks at all pairs on their chords.
    #[cfg_attr(optimized, inline(always))]
    fn look<S: Simd>(&self, simd: S, room: &mut Room, first: u32, pulls: &mut [PullRow]) {
        let chords: &[[[f32; 4]; 2]] = bytemuck::cast_slice(self.chords);
        let unit = simd.splat(self.plan.scale().unit());
        let nearer = simd.splat(NEAR * MARGIN * self.pass.growth);
        let frame = Images::new(simd, self.plan);
        let pairs = room.ones.len();
        let (short, half) = (simd.splat(SHORT), simd.splat(0.5));
        for k in (0..pairs).step_by(S::LANES) {
            let numbers = [lanes::<S>(&room.ones[k..]), lanes::<S>(&room.others[k..])];
            let (from, to) = (begins(simd, chords, &numbers[0]), begins(simd, chords, &numbers[1]));
            let [dx, dy, dz, one] = rows::<S, 2, 1>(simd, chords, &numbers[0]);
            let [ex, ey, ez, other] = rows::<S, 2, 1>(simd, chords, &numbers[1]);
            let (d, e, most) = ([dx, dy, dz], [ex, ey, ez], one + other);
            let (way, _) = frame.nearest(between(from, to), unit, scale(difference(e, d), half));
            let between = scale(to_floats(way), unit);
            // As `Chord::nearest`.
            let (a, c) = (dot(d, d).max(short), -dot(d, between));
            let (e2, f) = (dot(e, e).max(short), -dot(e, between));
            let b = dot(d, e);
            let determinant = a * e2 - b * b;
            let slanted = (simd.splat(1e-6) * (a * e2)).less(determinant);
            let s = slanted.select(share(simd, (b * f - c * e2) / determinant), simd.splat(0.5));
            let t = share(simd, (b * s + f) / e2);
            let s = share(simd, (b * t - c) / a);
            let apart = difference(plus(between, scale(e, t)), scale(d, s));
            let distance = dot(apart, apart).sqrt();
            let near = distance.less(nearer * most).bits();
            let (mut distances, mut ratios) = ([0.0; LANES_MAX], [0.0; LANES_MAX]);
            distance.store(&mut distances);
            (distance / most).store(&mut ratios);
            let (mut ss, mut ts) = ([0.0; LANES_MAX], [0.0; LANES_MAX]);
            s.store(&mut ss);
            t.store(&mut ts);
            for lane in 0..S::LANES.min(pairs - k) {
                if near & (1 << lane) != 0 {
                    room.near[0].push(numbers[0][lane]);
                    room.near[1].push(numbers[1][lane]);
                    room.shares[0].push(ss[lane]);
                    room.shares[1].push(ts[lane]);
                } else {
                    let owner = self.chords[numbers[0][lane] as usize].0[0][3].to_bits();
                    let pull = &mut pulls[(owner - first) as usize];
                    pull.see(distances[lane], ratios[lane]);
                }
            }
        }
    }

    /// Works out the exact places of near pairs, and what contacts pull.
    #[cfg_attr(optimized, inline(always))]
    fn touch<S: Simd, const FLATTENED: bool>(&self, simd: S, room: &Room, first: u32, pulls: &mut [PullRow]) {
        let chords: &[[[f32; 4]; 2]] = bytemuck::cast_slice(self.chords);
        let unit = simd.splat(self.plan.scale().unit());
        let frame = Images::new(simd, self.plan);
        let (pairs, half) = (room.near[0].len(), simd.splat(0.5));
        for k in (0..pairs).step_by(S::LANES) {
            let count = S::LANES.min(pairs - k);
            let numbers = [lanes::<S>(&room.near[0][k..]), lanes::<S>(&room.near[1][k..])];
            // The image, as it was found on the chords.
            let chord_way = between(begins(simd, chords, &numbers[0]), begins(simd, chords, &numbers[1]));
            let (one, other) = (spans(simd, chords, &numbers[0]), spans(simd, chords, &numbers[1]));
            let (_, image) = frame.nearest(chord_way, unit, scale(difference(other, one), half));
            let owners = [self.owners(&numbers[0]), self.owners(&numbers[1])];
            let curves = [
                Curve::<S>::new(simd, self.intervals, &owners[0]),
                Curve::<S>::new(simd, self.intervals, &owners[1]),
            ];
            let way = frame.moved(between(curves[0].start, curves[1].start), image);
            let way = scale(to_floats(way), unit);
            let (u, stride) = self.places(simd, &numbers[0], &room.shares[0][k..][..count]);
            let (v, other_stride) = self.places(simd, &numbers[1], &room.shares[1][k..][..count]);
            let (at, stride) = ([u, v], [stride, other_stride]);
            let contact = refined(simd, &curves, way, at, stride);
            let touches = Touches::new::<S, FLATTENED>(simd, &curves, &contact, self);
            for (lane, &owner) in owners[0][..count].iter().enumerate() {
                touches.add(
                    lane,
                    self.pass.form,
                    self.plan.tags()[owner as usize],
                    &mut pulls[(owner - first) as usize],
                );
            }
        }
    }
}

impl Source<'_> {
    /// The places of the chords' intervals.
    #[cfg_attr(optimized, inline(always))]
    fn owners(&self, chords: &[u32; LANES_MAX]) -> [u32; LANES_MAX] {
        let mut owners = [0; LANES_MAX];
        for (owner, chord) in owners.iter_mut().zip(chords) {
            *owner = self.fixed.owners[*chord as usize];
        }
        owners
    }

    /// Where along their intervals places on chords are, and how far from there the exact ones may be.
    #[cfg_attr(optimized, inline(always))]
    fn places<S: Simd>(&self, simd: S, chords: &[u32; LANES_MAX], on: &[f32]) -> (S::Floats, S::Floats) {
        let (mut shares, mut share) = ([[0.0; 4]; LANES_MAX], [0.0; LANES_MAX]);
        for (shares, chord) in shares.iter_mut().zip(chords) {
            *shares = self.fixed.shares[*chord as usize];
        }
        share[..on.len()].copy_from_slice(on);
        let [_, _, piece, step] = simd.components(&shares);
        ((piece + simd.load(&share)) * step, simd.splat(STRIDE) * step)
    }
}

/// Where chords begin.
#[cfg_attr(optimized, inline(always))]
fn begins<S: Simd>(simd: S, chords: &[[[f32; 4]; 2]], numbers: &[u32]) -> [S::Integers; 3] {
    let [x, y, z, _] = rows::<S, 2, 0>(simd, chords, numbers);
    to_bits([x, y, z])
}

/// The spans of chords.
#[cfg_attr(optimized, inline(always))]
fn spans<S: Simd>(simd: S, chords: &[[[f32; 4]; 2]], numbers: &[u32]) -> [S::Floats; 3] {
    let [x, y, z, _] = rows::<S, 2, 1>(simd, chords, numbers);
    [x, y, z]
}

impl Room {
    fn list(&mut self, source: &Source<'_>, own: Range<u32>) {
        for list in [&mut self.ones, &mut self.others].into_iter().chain(&mut self.near) {
            list.clear();
        }
        self.shares.iter_mut().for_each(Vec::clear);
        let all = source.starts[own.start as usize] as usize..source.starts[own.end as usize] as usize;
        self.others.extend_from_slice(&source.neighbours[all]);
        for chord in own {
            let count = source.starts[chord as usize + 1] - source.starts[chord as usize];
            self.ones.extend(std::iter::repeat_n(chord, count as usize));
        }
    }
}

/// The first numbers of a list, the last one again where it has fewer than lanes.
#[cfg_attr(optimized, inline(always))]
fn lanes<S: Simd>(list: &[u32]) -> [u32; LANES_MAX] {
    let mut lanes = [0; LANES_MAX];
    if list.len() >= S::LANES {
        lanes[..S::LANES].copy_from_slice(&list[..S::LANES]);
    } else {
        lanes[..list.len()].copy_from_slice(list);
        lanes[list.len()..S::LANES].fill(list[list.len() - 1]);
    }
    lanes
}

/// Images of what repeats.
#[derive(Clone, Copy)]
struct Images<S: Simd> {
    simd: S,
    /// Whether anything repeats.
    any: bool,
    period: [i32; 2],
    frequency: [S::Floats; 2],
}

impl<S: Simd> Images<S> {
    #[cfg_attr(optimized, inline(always))]
    fn new(simd: S, plan: &SettlingPlan) -> Self {
        let period = plan.period();
        Self {
            simd,
            any: period != [0; 2],
            period,
            frequency: [simd.splat(plan.frequency()[0]), simd.splat(plan.frequency()[1])],
        }
    }

    /// The way to the nearest image, and how many repeats away that is, negated. `middles` lead from the ends of the way to what is to be
    /// near, mm.
    #[cfg_attr(optimized, inline(always))]
    fn nearest(
        &self,
        way: [S::Integers; 3],
        unit: S::Floats,
        middles: [S::Floats; 3],
    ) -> ([S::Integers; 3], [S::Floats; 2]) {
        if !self.any {
            return (way, [self.simd.splat(0.0); 2]);
        }
        let half = self.simd.splat(0.5);
        let image = [
            ((way[0].signed_to_floats() * unit + middles[0]) * self.frequency[0] + half).floor(),
            ((way[1].signed_to_floats() * unit + middles[1]) * self.frequency[1] + half).floor(),
        ];
        (self.moved(way, image), image)
    }

    #[cfg_attr(optimized, inline(always))]
    fn moved(&self, [x, y, z]: [S::Integers; 3], image: [S::Floats; 2]) -> [S::Integers; 3] {
        if !self.any {
            return [x, y, z];
        }
        let [width, height] = self.period;
        [
            x - image[0].to_signed().times(width.cast_unsigned()),
            y - image[1].to_signed().times(height.cast_unsigned()),
            z,
        ]
    }
}

/// Where pairs of intervals come near one another.
#[derive(Clone, Copy)]
struct Contacts<S: Simd> {
    at: [S::Floats; 2],
    way: [S::Floats; 3],
    distance: S::Floats,
}

/// As `Pair::refined`.
#[cfg_attr(optimized, inline(always))]
fn refined<S: Simd>(
    simd: S,
    curves: &[Curve<S>; 2],
    way: [S::Floats; 3],
    at: [S::Floats; 2],
    stride: [S::Floats; 2],
) -> Contacts<S> {
    let start = Contacts::new(curves, way, at);
    let velocities = [curves[0].velocity(simd, at[0]), curves[1].velocity(simd, at[1])];
    let squares = [dot(velocities[0], velocities[0]), dot(velocities[1], velocities[1])];
    let slopes = [-dot(start.way, velocities[0]), dot(start.way, velocities[1])];
    let bends = [
        -dot(start.way, curves[0].acceleration(simd, at[0])),
        dot(start.way, curves[1].acceleration(simd, at[1])),
    ];
    let (fifth, short) = (simd.splat(0.2), simd.splat(SHORT));
    let h = [
        (squares[0] + bends[0]).max(fifth * squares[0]).max(short),
        (squares[1] + bends[1]).max(fifth * squares[1]).max(short),
    ];
    let mixed = -dot(velocities[0], velocities[1]);
    let determinant = (h[0] * h[1] - mixed * mixed).max(simd.splat(0.05) * (h[0] * h[1]));
    let step = [
        (mixed * slopes[1] - h[1] * slopes[0]) / determinant,
        (mixed * slopes[0] - h[0] * slopes[1]) / determinant,
    ];
    let next = [
        share(simd, at[0] + step[0].max(-stride[0]).min(stride[0])),
        share(simd, at[1] + step[1].max(-stride[1]).min(stride[1])),
    ];
    let found = Contacts::new(curves, way, next);
    let nearer = found.distance.less(start.distance);
    Contacts {
        at: [nearer.select(found.at[0], start.at[0]), nearer.select(found.at[1], start.at[1])],
        way: select(nearer, found.way, start.way),
        distance: nearer.select(found.distance, start.distance),
    }
}

impl<S: Simd> Contacts<S> {
    /// Two places, on intervals of which the second begins `way` from the first.
    #[cfg_attr(optimized, inline(always))]
    fn new(curves: &[Curve<S>; 2], way: [S::Floats; 3], at: [S::Floats; 2]) -> Self {
        let way = difference(plus(way, curves[1].offset(at[1])), curves[0].offset(at[0]));
        Self { at, way, distance: dot(way, way).sqrt() }
    }
}

/// What contacts come to, lane by lane.
struct Touches {
    distance: [f32; LANES_MAX],
    ratio: [f32; LANES_MAX],
    lacks: [f32; LANES_MAX],
    direction: [[f32; LANES_MAX]; 3],
    back: [[f32; LANES_MAX]; 3],
    weights: [[f32; LANES_MAX]; 4],
}

impl Touches {
    #[cfg_attr(optimized, inline(always))]
    fn new<S: Simd, const FLATTENED: bool>(
        simd: S,
        curves: &[Curve<S>; 2],
        contact: &Contacts<S>,
        source: &Source<'_>,
    ) -> Self {
        let Contacts { at: [u, v], way, distance } = *contact;
        let velocities = [curves[0].velocity(simd, u), curves[1].velocity(simd, v)];
        // As `Contact::direction`.
        let [a, b] = velocities;
        let square = [a[1] * b[2] - b[1] * a[2], a[2] * b[0] - b[2] * a[0], a[0] * b[1] - b[0] * a[1]];
        let way = select(simd.splat(1e-9).less(distance), way, square);
        let length = dot(way, way);
        let one = simd.splat(1.0);
        let nothing = simd.splat(0.0);
        let direction =
            select(nothing.less(length), scale(way, one / length.sqrt()), [nothing, nothing, one]);
        let reach = curves[0].reach::<FLATTENED>(simd, u, velocities[0], direction)
            + curves[1].reach::<FLATTENED>(simd, v, velocities[1], direction);
        let lacks = simd.splat(MARGIN * source.pass.growth) * reach - distance;
        let back = scale(direction, simd.splat(-0.5) * lacks);
        let weights = weights(simd, u, source.plan.s());
        let mut touches = Self {
            distance: [0.0; LANES_MAX],
            ratio: [0.0; LANES_MAX],
            lacks: [0.0; LANES_MAX],
            direction: [[0.0; LANES_MAX]; 3],
            back: [[0.0; LANES_MAX]; 3],
            weights: [[0.0; LANES_MAX]; 4],
        };
        distance.store(&mut touches.distance);
        (distance / reach).store(&mut touches.ratio);
        lacks.store(&mut touches.lacks);
        for axis in 0..3 {
            direction[axis].store(&mut touches.direction[axis]);
            back[axis].store(&mut touches.back[axis]);
        }
        for (weights, to) in weights.into_iter().zip(&mut touches.weights) {
            weights.store(to);
        }
        touches
    }

    /// Adds a lane's contact to what pulls at its interval.
    #[cfg_attr(optimized, inline(always))]
    fn add(&self, lane: usize, form: Form, tags: u32, pull: &mut PullRow) {
        pull.see(self.distance[lane], self.ratio[lane]);
        if self.lacks[lane] <= 0.0 {
            return;
        }
        let mut weights = self.weights.map(|weights| weights[lane]);
        if tags & (tag::OPENS | tag::ENDS) != 0 {
            weights = SettlingPlan::folded(tags, weights);
        }
        let [x, y, z] = self.back.map(|back| back[lane]);
        for (slot, weight) in pull.slots.iter_mut().zip(weights) {
            let (way, weight) = ([x * weight, y * weight, z * weight], CONTACT * weight.abs());
            match form {
                Form::Weighted => {
                    for (sum, add) in slot[0].iter_mut().zip([way[0], way[1], way[2], weight]) {
                        *sum += add;
                    }
                }
                Form::Block => {
                    let [dx, dy, dz] = self.direction.map(|direction| direction[lane]);
                    let (wx, wy, wz) = (dx * weight, dy * weight, dz * weight);
                    let squares = [wx * dx, wx * dy, wx * dz, wy * dy, wy * dz, wz * dz];
                    for (sum, add) in slot.as_flattened_mut().iter_mut().zip(way.into_iter().chain(squares)) {
                        *sum += add;
                    }
                }
            }
        }
    }
}
