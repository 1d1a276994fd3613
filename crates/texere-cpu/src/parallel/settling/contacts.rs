//! Contacts, a vector of pairs of chords at a time.
//!
//! All pairs are first tested on their chords. For pairs that are near one another the exact places
//! are worked out, again in full vectors. Then their pulls are added up pair by pair, in the order
//! of the lists.

use std::ops::Range;

use texere_core::settling::{
    CONTACT, Form, MARGIN, NEAR, ONE_PLACE, Pass, SHORT, SKEW, STIFF, STRIDE, SettlingPlan, tag,
};

use super::chords::{Chords, Images, Nearest};
use super::curves::{Curve, weights};
use super::tables::{ChordRow, Fixed, IntervalRow, PullRow};
use crate::parallel::simd::{
    Floats, Integers, LANES_MAX, Mask, Simd, between, difference, dot, first as lanes, least, plus, scale,
    select, share, to_floats,
};

/// The input that pairs are made from.
#[derive(Debug, Clone, Copy)]
pub(super) struct Source<'a> {
    pub(super) plan: &'a SettlingPlan,
    pub(super) pass: &'a Pass,
    pub(super) fixed: &'a Fixed,
    pub(super) intervals: &'a [IntervalRow],
    pub(super) chords: &'a [ChordRow],
    /// The position of each chord's first neighbour in `neighbours`, and at the end the number of
    /// all neighbours.
    pub(super) starts: &'a [u32],
    /// The neighbours of all chords, and [`LANES_MAX`] entries more.
    pub(super) neighbours: &'a [u32],
}

/// Memory of a task.
#[derive(Debug, Default)]
pub(super) struct Room {
    /// The first chord of each pair, and [`LANES_MAX`] entries more.
    ones: Vec<u32>,
    /// The number of pairs that are near one another.
    count: usize,
    /// The two chords of each near pair.
    near: [Vec<u32>; 2],
    /// For each near pair, the places on both chords, as shares of them, and minus the numbers of
    /// repeats to the image of the second chord.
    on: Vec<[f32; 4]>,
}

impl Source<'_> {
    /// Adds the contacts of intervals to `pulls`. The first of `pulls` belongs to place `first`.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn add<S: Simd>(&self, simd: S, first: usize, room: &mut Room, pulls: &mut [PullRow]) {
        room.list(self, self.plan.chords()[first]..self.plan.chords()[first + pulls.len()]);
        self.look(simd, room, first, pulls);
        match self.pass.form {
            Form::Weighted => self.touch::<S, false>(simd, room, first, pulls),
            Form::Block => self.touch::<S, true>(simd, room, first, pulls),
        }
    }

    /// Measures all pairs on their chords. Near pairs are noted in `room`, and the distances of all
    /// other pairs in `pulls`.
    #[cfg_attr(optimized, inline(always))]
    fn look<S: Simd>(&self, simd: S, room: &mut Room, first: usize, pulls: &mut [PullRow]) {
        let nearer = simd.splat(NEAR * MARGIN * self.pass.growth);
        let images = Images::new(simd, self.plan);
        let chords = &self.plan.chords()[first..];
        let begin = self.starts[chords[0] as usize] as usize;
        let far = simd.splat(f32::INFINITY);
        for (own, pull) in chords.windows(2).zip(pulls) {
            let [start, end] = [own[0], own[1]].map(|chord| self.starts[chord as usize] as usize);
            let (mut distances, mut ratios) = (far, far);
            for k in (start..end).step_by(S::LANES) {
                let (ones, others) = (&room.ones[k - begin..][..S::LANES], &self.neighbours[k..][..S::LANES]);
                let one = Chords::new(simd, self.chords, ones);
                let other = Chords::new(simd, self.chords, others);
                let found = Nearest::new(simd, &images, &one, &other);
                let distance = dot(found.apart, found.apart).sqrt();
                let most = one.thickest + other.thickest;
                let near = distance.less(nearer * most);
                let own = simd.load(&ORDER).less(simd.splat((end - k) as f32));
                let seen = near.select(far, own.select(distance, far));
                (distances, ratios) = (distances.min(seen), ratios.min(seen / most));
                let mut near = near.bits() & lanes::<S>(end - k);
                if near == 0 {
                    continue;
                }
                let mut on = [[0.0; 4]; LANES_MAX];
                let ([s, t], [right, up]) = (found.shares, found.image);
                simd.scatter([s, t, right, up], on.as_flattened_mut(), 4);
                while near != 0 {
                    let lane = near.trailing_zeros() as usize;
                    near &= near - 1;
                    (room.near[0][room.count], room.near[1][room.count]) = (ones[lane], others[lane]);
                    room.on[room.count] = on[lane];
                    room.count += 1;
                }
            }
            if start < end {
                pull.see(least::<S>(distances), least::<S>(ratios));
            }
        }
    }

    /// Works out the exact places of near pairs, and the pulls of their contacts.
    #[cfg_attr(optimized, inline(always))]
    fn touch<S: Simd, const BLOCK: bool>(&self, simd: S, room: &Room, first: usize, pulls: &mut [PullRow]) {
        let images = Images::new(simd, self.plan);
        let mut touches = Touches::NONE;
        for k in (0..room.count).step_by(S::LANES) {
            let count = S::LANES.min(room.count - k);
            let numbers = [&room.near[0][k..][..S::LANES], &room.near[1][k..][..S::LANES]];
            let owners = [self.owners::<S>(numbers[0]), self.owners::<S>(numbers[1])];
            let curves = [
                Curve::<S>::new(simd, self.intervals, &owners[0]),
                Curve::<S>::new(simd, self.intervals, &owners[1]),
            ];
            let [s, t, right, up] = simd.components(&room.on[k..]);
            let way = images.moved(between(curves[0].start, curves[1].start), [right, up]);
            let way = scale(to_floats(way), images.unit);
            let (u, stride) = self.places(simd, numbers[0], s);
            let (v, other_stride) = self.places(simd, numbers[1], t);
            let contact = refined(simd, &curves, way, [u, v], [stride, other_stride]);
            let tags = self.tags::<S>(&owners[0]);
            touches.find::<S, BLOCK>(simd, &curves, &contact, self, &tags);
            for (lane, &owner) in owners[0][..count].iter().enumerate() {
                touches.add::<BLOCK>(lane, &mut pulls[owner as usize - first]);
            }
        }
    }
}

impl Source<'_> {
    /// For each of `chords`, the place at which its interval begins.
    #[cfg_attr(optimized, inline(always))]
    fn owners<S: Simd>(&self, chords: &[u32]) -> [u32; LANES_MAX] {
        let mut owners = [0; LANES_MAX];
        for (owner, chord) in owners.iter_mut().zip(&chords[..S::LANES]) {
            *owner = self.fixed.owners[*chord as usize];
        }
        owners
    }

    /// The tags of the intervals at `places`.
    #[cfg_attr(optimized, inline(always))]
    fn tags<S: Simd>(&self, places: &[u32; LANES_MAX]) -> [u32; LANES_MAX] {
        let mut tags = [0; LANES_MAX];
        for (tags, place) in tags.iter_mut().zip(&places[..S::LANES]) {
            *tags = self.plan.tags()[*place as usize];
        }
        tags
    }

    /// Turns places on `chords`, given as shares of the chords, into shares of the chords'
    /// intervals. Also returns how far the exact places may lie from these places, as shares of the
    /// intervals.
    #[cfg_attr(optimized, inline(always))]
    fn places<S: Simd>(&self, simd: S, chords: &[u32], share: S::Floats) -> (S::Floats, S::Floats) {
        let shares: &[[[f32; 4]; 1]] = bytemuck::cast_slice(&self.fixed.shares);
        let [_, _, piece, step] = simd.rows(shares, chords, 0);
        ((piece + share) * step, simd.splat(STRIDE) * step)
    }
}

impl Room {
    fn list(&mut self, source: &Source<'_>, own: Range<u32>) {
        self.ones.clear();
        for chord in own {
            let count = source.starts[chord as usize + 1] - source.starts[chord as usize];
            self.ones.extend(std::iter::repeat_n(chord, count as usize));
        }
        self.count = 0;
        let most = self.ones.len() + LANES_MAX;
        self.ones.resize(most, 0);
        self.near.iter_mut().for_each(|near| near.resize(most, 0));
        self.on.resize(most, [0.0; 4]);
    }
}

/// The number of each lane.
const ORDER: [f32; LANES_MAX] =
    [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0, 13.0, 14.0, 15.0];

/// The places where pairs of intervals come near one another, one on each.
#[derive(Clone, Copy)]
struct Contacts<S: Simd> {
    at: [S::Floats; 2],
    way: [S::Floats; 3],
    distance: S::Floats,
}

/// `Pair::refined` of the core.
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
    let (stiff, short) = (simd.splat(STIFF), simd.splat(SHORT));
    let h = [
        (squares[0] + bends[0]).max(stiff * squares[0]).max(short),
        (squares[1] + bends[1]).max(stiff * squares[1]).max(short),
    ];
    let mixed = -dot(velocities[0], velocities[1]);
    let determinant = (h[0] * h[1] - mixed * mixed).max(simd.splat(SKEW) * (h[0] * h[1]));
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
    /// Two places on two intervals. The second interval begins `way` from the first.
    #[cfg_attr(optimized, inline(always))]
    fn new(curves: &[Curve<S>; 2], way: [S::Floats; 3], at: [S::Floats; 2]) -> Self {
        let way = difference(plus(way, curves[1].offset(at[1])), curves[0].offset(at[0]));
        Self { at, way, distance: dot(way, way).sqrt() }
    }
}

/// The pulls of contacts, lane by lane.
struct Touches {
    distance: [f32; LANES_MAX],
    ratio: [f32; LANES_MAX],
    /// The bits of the lanes whose contacts pull.
    pulling: u32,
    /// What each lane adds to the slots of a [`PullRow`].
    adds: [[[[f32; 4]; 3]; 4]; LANES_MAX],
}

impl Touches {
    const NONE: Self = Self {
        distance: [0.0; LANES_MAX],
        ratio: [0.0; LANES_MAX],
        pulling: 0,
        adds: [[[[0.0; 4]; 3]; 4]; LANES_MAX],
    };

    #[cfg_attr(optimized, inline(always))]
    fn find<S: Simd, const BLOCK: bool>(
        &mut self,
        simd: S,
        curves: &[Curve<S>; 2],
        contact: &Contacts<S>,
        source: &Source<'_>,
        tags: &[u32; LANES_MAX],
    ) {
        let Contacts { at: [u, v], way, distance } = *contact;
        let velocities = [curves[0].velocity(simd, u), curves[1].velocity(simd, v)];
        // `Approach::direction` of the core.
        let [a, b] = velocities;
        let square = [a[1] * b[2] - b[1] * a[2], a[2] * b[0] - b[2] * a[0], a[0] * b[1] - b[0] * a[1]];
        let way = select(simd.splat(ONE_PLACE).less(distance), way, square);
        let length = dot(way, way);
        let (zero, one) = (simd.splat(0.0), simd.splat(1.0));
        let direction = select(zero.less(length), scale(way, one / length.sqrt()), [zero, zero, one]);
        let reach = curves[0].reach(simd, u, velocities[0], direction)
            + curves[1].reach(simd, v, velocities[1], direction);
        let lacks = simd.splat(MARGIN * source.pass.growth) * reach - distance;
        distance.store(&mut self.distance);
        (distance / reach).store(&mut self.ratio);
        self.pulling = zero.less(lacks).bits();
        if self.pulling == 0 {
            return;
        }
        let back = scale(direction, simd.splat(-0.5) * lacks);
        let weights = folded(simd, tags, weights(simd, u, source.plan.s()));
        let floats = self.adds.as_flattened_mut().as_flattened_mut().as_flattened_mut();
        for (slot, weight) in weights.into_iter().enumerate() {
            let to = &mut floats[12 * slot..];
            let [x, y, z] = scale(back, weight);
            let weight = simd.splat(CONTACT) * weight.abs();
            if BLOCK {
                let ([dx, dy, dz], [wx, wy, wz]) = (direction, scale(direction, weight));
                simd.scatter([x, y, z, wx * dx], to, 48);
                simd.scatter([wx * dy, wx * dz, wy * dy, wy * dz], &mut to[4..], 48);
                simd.scatter([wz * dz, zero, zero, zero], &mut to[8..], 48);
            } else {
                simd.scatter([x, y, z, weight], to, 48);
            }
        }
    }

    /// Adds the contact of a lane to the pulls of its interval.
    #[cfg_attr(optimized, inline(always))]
    fn add<const BLOCK: bool>(&self, lane: usize, pull: &mut PullRow) {
        pull.see(self.distance[lane], self.ratio[lane]);
        if self.pulling & (1 << lane) == 0 {
            return;
        }
        for (slot, add) in pull.slots.iter_mut().zip(&self.adds[lane]) {
            for (sums, add) in slot.iter_mut().zip(add).take(if BLOCK { 3 } else { 1 }) {
                for (sum, add) in sums.iter_mut().zip(add) {
                    *sum += add;
                }
            }
        }
    }
}

/// `SettlingPlan::folded` of the core.
#[cfg_attr(optimized, inline(always))]
fn folded<S: Simd>(simd: S, tags: &[u32; LANES_MAX], weights: [S::Floats; 4]) -> [S::Floats; 4] {
    let mut any = 0;
    for tags in tags {
        any |= tags;
    }
    if any & (tag::OPENS | tag::ENDS) == 0 {
        return weights;
    }
    let (tags, [a, b, c, d]) = (simd.load_integers(tags), weights);
    let (zero, two) = (simd.splat(0.0), simd.splat(2.0));
    let (opens, ends) = (tags.has_bit(tag::OPENS), tags.has_bit(tag::ENDS));
    let [a, b, c] = [opens.select(zero, a), opens.select(b + two * a, b), opens.select(c - a, c)];
    [a, ends.select(b - d, b), ends.select(c + two * d, c), ends.select(zero, d)]
}
