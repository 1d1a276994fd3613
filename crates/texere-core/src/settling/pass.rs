//! One pass: the pulls at an interval's four control points, and the step of each point.
//!
//! If two yarns are too near, each is pushed away by half of the lacking distance. If a yarn bends
//! too tightly, it is straightened. If an interval is too long or too short, its ends are moved.
//! Each control point then makes one step that combines all pulls at it.
//!
//! ```text
//! for each interval:                               Pull, written once
//!     for each neighbour of each of its chords:    meet
//!         find the nearest places of the two chords, then of the two splines
//!         if they are nearer than the two yarns reach:
//!             push the interval's four points by half of the lack, each by its weight there
//!     for each of its parts:                       own
//!         if the yarn bends more tightly than BEND_RADIUS allows:
//!             move the four points so that the excess becomes less
//!     pull or push both ends by half of the length that it has too much or too little
//! for each control point:                          Gathered::step
//!     sum up the pulls of the four intervals that it steers
//!     weighted form: step = mean of contacts + mean of bends + length + momentum
//!     block form:    step = solution of three equations of all pulls + momentum
//!     shorten the step to a share of the distance and of the diameter
//! ```
//!
//! A pass only gathers: every interval reads places and writes its own [`Pull`], then every control
//! point reads the pulls of its four intervals. Sums are added up in one order, so every schedule
//! gives the same bits.

use glam::Vec3;

use super::contact::{Approach, Pair, share};
use super::interval::weights;
use super::strand::tag;
use super::{Interval, Listed, MARGIN, NEAR, Place, SHORT, SettlingPlan, bends};

/// The way in which a point's step is made from its pulls.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Form {
    /// Contacts and bends each have a weighted mean. The step is the sum of both means and of the
    /// pulls by length. This form needs few passes to come near rest.
    #[default]
    Weighted,
    /// The step is the best compromise of all pulls, each along its own direction. This form is
    /// slower, but it comes to rest where points would keep swinging in the weighted form.
    Block,
}

/// The settings of a pass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pass {
    /// The form of steps.
    pub form: Form,
    /// The share of their thickness that yarns have in this pass.
    pub growth: f32,
    /// The strength, 0 to 1, of what acts only on the way to rest: soft bends, tension, plates.
    pub ease: f32,
    /// The share of each point's last step that is added to its next. More momentum makes ribs and
    /// garter stitch thicker: garter stitch came to rest 2.8 diameters thick with 0, and 4.3 with
    /// 0.9.
    pub momentum: f32,
}

/// The least radius of curvature of a yarn, in diameters. With half the value, and with twice,
/// `a_settled_repeat_fits_its_copies` is red.
pub const BEND_RADIUS: f32 = 0.6;

/// The factor by which a pass aims for larger radii than [`BEND_RADIUS`], so that settling ends
/// above it. With half its difference to 1, and with twice, `a_settled_repeat_fits_its_copies` is
/// red.
pub const BEND_MARGIN: f32 = 1.02;

/// The stiffness of soft bends, which act below the limit, too, as a share of the stiffness beyond
/// the limit. With half the value, `a_settled_repeat_fits_its_copies` is red; with twice, no test
/// is.
pub const SOFT_BEND: f32 = 0.02;

/// The weight of a contact at a control point, as a multiple of the point's weight in the spline.
/// With half the value, and with twice, `a_settled_repeat_fits_its_copies` is red.
pub const CONTACT: f32 = 1.12;

/// The weight of bends in the weighted form. 0.6 was tried first. With half the value, and with
/// twice, `a_settled_repeat_fits_its_copies` is red.
pub const BEND: f32 = 1.0;

/// The weight of bends in the block form. With half the value, `a_settled_repeat_fits_its_copies`
/// is red; with twice, no test is.
pub const BLOCK_BEND: f32 = 5.0;

/// The largest distance, in chords, of a contact's places on the splines from its places on the
/// chords. With half the value, and with twice, `a_settled_repeat_fits_its_copies` is red.
pub const STRIDE: f32 = 0.6;

/// The share of a point's distance beyond a plate by which the plate moves the point in a pass.
/// With half the value, and with twice, no test is red.
pub const PRESS: f32 = 0.1;

/// The least weight by which the sum of contacts is divided in the weighted form. With half the
/// value, and with twice, no test is red.
pub const CONTACTS_MIN: f32 = 0.64;
/// The least weight by which the sum of bends is divided in the weighted form. With half the value,
/// and with twice, no test is red.
pub const BENDS_MIN: f32 = 0.3;

/// The distance, divided by the sum of both reaches, below which only contacts move the points of
/// two yarns. This bound acts in the weighted form alone. Without it a strong tension can squeeze
/// yarns through one another in spite of the limit of steps. With twice the value,
/// `a_settled_repeat_fits_its_copies` is red; with half, no test is.
pub const CROSSING: f32 = 0.3;
/// The growth of all other pulls with the distance beyond [`CROSSING`]. They have full strength at
/// 0.7. With half the value, `a_settled_repeat_fits_its_copies` is red; with twice, no test is.
pub const CROSSING_SHARE: f32 = 2.5;

/// The longest step, as a share of the least distance to another yarn. With half the value, and
/// with twice, no test is red.
pub const STEP_NEAR: f32 = 0.2;
/// The longest step, as a share of the diameter. With half the value, and with twice, no test is
/// red.
pub const STEP_DIAMETER: f32 = 0.1;

/// The weight, in the block form, with which a point stays in place. With half the value,
/// `starts_come_to_rest` is red; with twice, no test is.
pub const INERTIA: f32 = 0.12;

/// The least number of equal parts of an interval at whose ends bends are measured. An interval
/// with more chords has as many parts as chords. With bends measured at three places, 0.60
/// diameters were reported for a yarn that had a radius of 0.51.
pub const BEND_PARTS: u32 = 8;

/// The pulls of an interval at its four control points.
#[derive(Debug, Clone, Copy)]
pub struct Pull {
    /// The sums of pulls at each of the four points. In the weighted form these are the
    /// displacements by contacts (x, y, z, mm) and the weights of contacts, the same two for bends,
    /// and a zero. In the block form they are all displacements (x, y, z, mm), and the products xx,
    /// xy, xz, yy, yz, zz of the components of their directions, each times its weight.
    pub slots: [[f32; 9]; 4],
    /// A vector along the interval's chord, as long as half of the interval's excess length, mm.
    pub length: Vec3,
    /// The interval's length, mm.
    pub arc: f32,
    /// The least distance to another yarn, mm.
    pub near: f32,
    /// The least distance to another yarn, divided by the sum of both yarns' reaches. It is 1 if
    /// they touch.
    pub clearance: f32,
    /// The least radius of curvature, in the yarn's diameters.
    pub radius: f32,
}

impl Pull {
    /// The pull of an interval before anything is added.
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

    /// Adds the pull between a chord of this interval and a neighbour. The chord is the first of
    /// `pair`, and the neighbour the second.
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

    /// Adds the contact `contact` of the two intervals of `pair`. `tags` are those of the first
    /// interval's place.
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

    /// Adds the pulls of the interval's own bends and length.
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
            // With a weight of length above 1, steps diverge.
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
    /// The step along z by which plates move a point, mm.
    #[must_use]
    #[inline]
    pub fn press(&self, plan: &SettlingPlan, place: &Place) -> f32 {
        let Some(gap) = plan.plates() else { return 0.0 };
        let z = place.at[2] as f32 * plan.scale().unit();
        (PRESS * self.ease * (z.abs() + place.halves.height() - 0.5 * gap).max(0.0)).copysign(-z)
    }
}

/// The pulls of the four intervals that a control point belongs to. They begin one place after the
/// point, at the point, one place before it, and two places before it, in this order.
#[derive(Debug, Clone, Copy)]
pub struct Gathered<'a>(pub [Option<&'a Pull>; 4]);

impl Gathered<'_> {
    /// The step of a control point, mm. `last` is the point's step in the pass before.
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
                // For yarns that are about to cross, only contacts count.
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

/// The solution of three equations with a symmetric positive matrix, by its cofactors.
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

/// Whether the place with these `tags` is a control point that may move.
#[must_use]
#[inline]
pub const fn moves(tags: u32) -> bool {
    tags & (tag::POINT | tag::PINNED) == tag::POINT
}
