//! One pass: what pulls at an interval's four control points, and the step that each point takes.
//!
//! A pass only gathers: every interval reads places and writes its own [`Pull`], then every control
//! point reads the pulls of the four intervals that it steers. Sums go in one order, so every
//! schedule gives the same bits.

use glam::Vec3;

use super::contact::share;
use super::interval::weights;
use super::strand::tag;
use super::{Approach, Interval, Listed, MARGIN, NEAR, Pair, Place, SHORT, SettlingPlan, bends};

/// How a point's step is made from what pulls at it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Form {
    /// Contacts, bends and length each have their mean, and their steps add up. Soon near rest.
    #[default]
    Weighted,
    /// One step that suits all of them best, along the directions in which they pull: slower, but
    /// it comes to rest where others would pull to and fro.
    Block,
}

/// What a pass is made with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pass {
    /// How steps are made.
    pub form: Form,
    /// The share of their thickness that yarns have.
    pub growth: f32,
    /// The share of what eases the way to rest and is gone when it is reached: soft bends, tension,
    /// plates.
    pub ease: f32,
    /// The share of the last step that each point goes on with.
    pub momentum: f32,
}

/// The least radius of curvature, in diameters.
pub const BEND_RADIUS: f32 = 0.6;

/// How much larger than that radii are made.
pub const BEND_MARGIN: f32 = 1.02;

/// How stiff yarns are where they bend less than they may, as a share of what they are beyond,
/// while that eases.
pub const SOFT_BEND: f32 = 0.02;

/// How much contacts count.
pub const CONTACT: f32 = 1.12;

/// How much bends count beside them.
pub const BEND: f32 = 1.0;

/// The same in the block form.
pub const BLOCK_BEND: f32 = 5.0;

/// How far the exact places of a contact may lie from those on the chords, in chords.
pub const STRIDE: f32 = 0.6;

/// The share of what they lack that plates move points by in a pass.
pub const PRESS: f32 = 0.1;

/// The least weights of contacts, and of bends, that a mean is made with in the weighted form.
pub const CONTACTS_MIN: f32 = 0.64;
/// See [`CONTACTS_MIN`].
pub const BENDS_MIN: f32 = 0.3;

/// Yarns nearer than that, over both reaches, obey contact alone; what else pulls at them grows by
/// that share with what is more.
pub const CROSSING: f32 = 0.3;
/// See [`CROSSING`].
pub const CROSSING_SHARE: f32 = 2.5;

/// The longest step: a share of the least distance that was seen, and one of the diameter.
pub const STEP_NEAR: f32 = 0.2;
/// See [`STEP_NEAR`].
pub const STEP_DIAMETER: f32 = 0.1;

/// What keeps a point where it is, against all that pulls at it in the block form.
pub const INERTIA: f32 = 0.12;

/// Bends are looked at in so many equal parts of an interval, at the ends of all of them, and of
/// all its chords where it has more: with three places a yarn has 0.51 where 0.60 is claimed.
pub const BEND_PARTS: u32 = 8;

/// What pulls at the control points of an interval.
#[derive(Debug, Clone, Copy)]
pub struct Pull {
    /// What pulls at each of the four: with [`Form::Weighted`] the sum of contacts' ways, mm, and
    /// of their weights, then the same of bends, and a zero; with [`Form::Block`] the sum of all
    /// ways, mm, and of the squares of their directions, each with its weight: xx, xy, xz, yy, yz,
    /// zz.
    pub slots: [[f32; 9]; 4],
    /// Half of the length that the interval has too much, along its chord, mm.
    pub length: Vec3,
    /// Its length, mm.
    pub arc: f32,
    /// The least distance to another yarn that was seen, mm.
    pub near: f32,
    /// The same over both yarns' reaches: 1 where they touch.
    pub clearance: f32,
    /// The least radius of curvature, in the yarn's diameters.
    pub radius: f32,
}

impl Pull {
    /// Of an interval that nothing is near.
    #[must_use]
    pub const fn none() -> Self {
        Self {
            slots: [[0.0; 9]; 4],
            length: Vec3::ZERO,
            arc: 0.0,
            near: f32::INFINITY,
            clearance: f32::INFINITY,
            radius: f32::INFINITY,
        }
    }

    /// Adds what one of its neighbours, the second, does to a chord of this interval, the first.
    #[inline]
    pub fn meet(&mut self, plan: &SettlingPlan, pass: &Pass, pair: [Listed<'_>; 2]) {
        let [one, other] = pair;
        let way = other.chord.at.wrapping_sub(one.chord.at);
        let image = plan.image([one.chord, other.chord], way);
        let between = plan.scale().length(plan.to_image(way, image));
        let shares = one.chord.nearest(other.chord, between);
        let apart = between + other.chord.span * shares[1] - one.chord.span * shares[0];
        let distance = apart.length_squared().sqrt();
        let most = one.interval.thickest() + other.interval.thickest();
        if distance >= NEAR * MARGIN * pass.growth * most {
            self.near = self.near.min(distance);
            self.clearance = self.clearance.min(distance / most);
            return;
        }
        let step = pair.map(|listed| 1.0 / listed.pieces as f32);
        let at = [0, 1].map(|side| (pair[side].piece as f32 + shares[side]) * step[side]);
        let way = plan.to_image(other.interval.start.wrapping_sub(one.interval.start), image);
        let intervals = Pair { intervals: [one.interval, other.interval], way: plan.scale().length(way) };
        let contact = intervals.refined(at, step.map(|step| STRIDE * step));
        self.touch(plan, pass, plan.tags()[one.place], &intervals, &contact);
    }

    /// Adds a contact.
    #[inline]
    fn touch(&mut self, plan: &SettlingPlan, pass: &Pass, tags: u32, pair: &Pair<'_>, contact: &Approach) {
        let [one, other] = pair.intervals;
        let [u, v] = contact.at;
        let direction = contact.direction([one.velocity(u), other.velocity(v)]);
        let reach = one.reach(u, direction) + other.reach(v, direction);
        self.near = self.near.min(contact.distance);
        self.clearance = self.clearance.min(contact.distance / reach);
        let lacks = MARGIN * pass.growth * reach - contact.distance;
        if lacks > 0.0 {
            let back = direction * (-0.5 * lacks);
            let weights = SettlingPlan::folded(tags, weights(u, plan.s()));
            for (slot, weight) in self.slots.iter_mut().zip(weights) {
                let (way, weight) = (back * weight, CONTACT * weight.abs());
                match pass.form {
                    Form::Weighted => add_weighted(slot, 0, way, weight),
                    Form::Block => add_block(slot, way, direction, weight),
                }
            }
        }
    }

    /// Adds what the interval's own bends and length do.
    #[inline]
    pub fn own(
        &mut self,
        plan: &SettlingPlan,
        pass: &Pass,
        (tags, chords): (u32, u32),
        interval: &Interval,
        length: f32,
    ) {
        let parts = chords.max(BEND_PARTS);
        for u in (0..=parts).map(|part| part as f32 / parts as f32) {
            let (velocity, acceleration) = (interval.velocity(u), interval.acceleration(u));
            let square = velocity.length_squared().max(SHORT);
            let across = acceleration - velocity * (acceleration.dot(velocity) / square);
            let bend = across.length_squared().sqrt();
            if bend <= 0.0 {
                continue;
            }
            let towards = across * (1.0 / bend);
            let diameter = 2.0 * interval.reach(u, towards);
            self.radius = self.radius.min(square / (bend * diameter));
            let limit = square / (BEND_MARGIN * BEND_RADIUS * diameter * pass.growth.max(0.5));
            let soft = SOFT_BEND * pass.ease;
            let excess = if bend > limit { bend - limit + soft * limit } else { soft * bend };
            if excess > 0.0 {
                let bends = SettlingPlan::folded(tags, bends(u, plan.s()));
                let sum = bends[0].abs() + bends[1].abs() + bends[2].abs() + bends[3].abs();
                let way = towards * (excess / (sum * sum));
                for (slot, bend) in self.slots.iter_mut().zip(bends) {
                    let (way, weight) = (way * -bend, bend.abs() / sum);
                    match pass.form {
                        Form::Weighted => add_weighted(slot, 4, way, weight),
                        Form::Block => add_block(slot, way * BLOCK_BEND, towards, BLOCK_BEND * weight),
                    }
                }
            }
        }
        let (arc, along) = interval.arc();
        self.arc = arc;
        self.length = along * ((arc - length) * 0.5);
        if pass.form == Form::Block {
            add_block(&mut self.slots[1], self.length, along, 1.0);
            add_block(&mut self.slots[2], -self.length, along, 1.0);
        }
    }
}

fn add_weighted(slot: &mut [f32; 9], first: usize, way: Vec3, weight: f32) {
    slot[first] += way.x;
    slot[first + 1] += way.y;
    slot[first + 2] += way.z;
    slot[first + 3] += weight;
}

fn add_block(slot: &mut [f32; 9], way: Vec3, direction: Vec3, weight: f32) {
    let Vec3 { x, y, z } = direction * weight;
    let squares = [
        x * direction.x,
        x * direction.y,
        x * direction.z,
        y * direction.y,
        y * direction.z,
        z * direction.z,
    ];
    for (sum, value) in slot.iter_mut().zip(way.to_array().into_iter().chain(squares)) {
        *sum += value;
    }
}

impl Pass {
    /// The step along z that plates make a point take, mm.
    #[must_use]
    #[inline]
    pub fn press(&self, plan: &SettlingPlan, place: &Place) -> f32 {
        let Some(gap) = plan.plates() else { return 0.0 };
        let z = place.at[2] as f32 * plan.scale().unit();
        (PRESS * self.ease * (z.abs() + place.halves.height() - 0.5 * gap).max(0.0)).copysign(-z)
    }
}

/// The pulls that a control point gathers: of the intervals that begin one place behind it, at it,
/// one and two places before it.
#[derive(Debug, Clone, Copy)]
pub struct Gathered<'a>(pub [Option<&'a Pull>; 4]);

impl Gathered<'_> {
    /// The step that a control point takes, mm. `last` is the step that it took before.
    #[must_use]
    #[inline]
    pub fn step(&self, plan: &SettlingPlan, pass: &Pass, place: &Place, last: Vec3) -> Vec3 {
        let nothing = Pull::none();
        let pulls = self.0.map(|pull| pull.unwrap_or(&nothing));
        let (mut sums, mut near, mut clearance) = ([0.0_f32; 9], f32::INFINITY, f32::INFINITY);
        for (slot, pull) in pulls.into_iter().enumerate() {
            for (sum, value) in sums.iter_mut().zip(pull.slots[slot]) {
                *sum += value;
            }
            near = near.min(pull.near);
            clearance = clearance.min(pull.clearance);
        }
        let halves = [place.halves.width(), place.halves.height()];
        let diameter = 2.0 * halves[0].min(halves[1]);
        let press = pass.press(plan, place);
        let on = last * pass.momentum;
        let step = match pass.form {
            Form::Weighted => {
                let [cx, cy, cz, contacts, bx, by, bz, bends, _] = sums;
                // Yarns that are about to cross obey contact alone.
                let apart = share((clearance / pass.growth - CROSSING) * CROSSING_SHARE);
                let bend = Vec3::new(bx, by, bz) * (BEND / bends.max(BENDS_MIN));
                let mut others = bend + (pulls[1].length - pulls[2].length) + on;
                others.z += press;
                Vec3::new(cx, cy, cz) * (1.0 / contacts.max(CONTACTS_MIN)) + others * apart
            }
            Form::Block => {
                let [x, y, z, xx, xy, xz, yy, yz, zz] = sums;
                let mut step =
                    solved([xx + INERTIA, xy, xz, yy + INERTIA, yz, zz + INERTIA], Vec3::new(x, y, z)) + on;
                step.z += press;
                step
            }
        };
        let most = (STEP_NEAR * near).min(STEP_DIAMETER * diameter);
        let length = step.length_squared().sqrt();
        if length > most { step * (most / length) } else { step }
    }
}

/// What a symmetrical matrix, positive by its diagonal, turns into `right`: by its cofactors.
#[inline]
fn solved([xx, xy, xz, yy, yz, zz]: [f32; 6], right: Vec3) -> Vec3 {
    let (a, b, c) = (yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy);
    let (d, e, f) = (xx * zz - xz * xz, xy * xz - xx * yz, xx * yy - xy * xy);
    let determinant = xx * a + xy * b + xz * c;
    let inverse = 1.0 / determinant.max(INERTIA * INERTIA * INERTIA);
    Vec3::new(
        (a * right.x + b * right.y + c * right.z) * inverse,
        (b * right.x + d * right.y + e * right.z) * inverse,
        (c * right.x + e * right.y + f * right.z) * inverse,
    )
}

/// Whether a place is a control point that may move.
#[must_use]
#[inline]
pub const fn moves(tags: u32) -> bool {
    tags & (tag::POINT | tag::PINNED) == tag::POINT
}
