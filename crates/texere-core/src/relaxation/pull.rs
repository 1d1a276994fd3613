//! The energy of one interval, and how it grows with the interval's control points.
//!
//! ```text
//! for each interval:                                   RelaxationPull::measure
//!     for each of its samples:                         bend
//!         add the energy of the curvature there
//!     add the energy of the length that it has too much or too little
//!     add the energy of what presses the cloth flat
//!     for each neighbour, and each sample of both:     press
//!         if the distance is less than the shells reach, and the samples do not follow one
//!         another along one yarn:
//!             add the energy of the contact, and the forces on both intervals
//! ```
//!
//! Every pair of intervals is met once, from one side. A pull keeps the forces on the neighbours
//! beside its own, and writes nothing but itself. All forces are added up afterwards in the order
//! of intervals, so the sums do not depend on the number of threads.

use glam::{DMat3, DVec2, DVec3};

use super::elastic::Shells;
use super::near::following;
use super::node::{blend, folded};
use super::{RelaxationInterval, RelaxationNear, RelaxationPlan, RelaxationSamples, RelaxationState};
use crate::backend::room_for;
use crate::{BackendError, Ends};

/// The least square of a velocity, mm², so that no power of it underflows where a spline stands
/// still.
const STILL: f64 = 1e-24;

/// An energy by its terms, N mm.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Energy {
    /// The energy of curvature.
    pub bending: f64,
    /// The energy of lengths that are not those at rest.
    pub length: f64,
    /// The energy of contacts.
    pub contact: f64,
    /// The energy of what presses the cloth flat.
    pub press: f64,
}

impl Energy {
    /// The sum of all terms, N mm.
    #[must_use]
    pub fn sum(&self) -> f64 {
        self.bending + self.length + self.contact + self.press
    }

    pub(super) fn and(self, other: Self) -> Self {
        Self {
            bending: self.bending + other.bending,
            length: self.length + other.length,
            contact: self.contact + other.contact,
            press: self.press + other.press,
        }
    }
}

/// The energy of an interval and of its contacts with neighbours, and how it grows with the control
/// points of both.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RelaxationPull {
    /// The growth of the energy with the repeat's length along x and y, N.
    pub repeat: DVec2,
    /// The energy.
    pub energy: Energy,
    /// How this energy pulls at the interval itself.
    pub own: RelaxationPress,
    /// What the contacts do to the neighbours.
    pub presses: Vec<RelaxationPress>,
    /// The contact forces on the samples of one neighbour.
    forces: Vec<DVec3>,
}

/// How an energy pulls at an interval: its slopes, its contact forces and their stiffness.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RelaxationPress {
    /// The number of the interval.
    pub interval: u32,
    /// By how much the energy grows with each of the interval's four control points, N.
    pub slopes: [DVec3; 4],
    /// The sum of the contact forces on the interval's samples, N.
    pub pressed: f64,
    /// The stiffness of the contacts, N/mm: the sum over the interval's samples, each as if the
    /// other yarns stood still.
    pub stiffness: DMat3,
}

impl Default for RelaxationPress {
    fn default() -> Self {
        // The default of a matrix is not 0.
        let stiffness = DMat3::ZERO;
        Self { interval: 0, slopes: [DVec3::ZERO; 4], pressed: 0.0, stiffness }
    }
}

impl RelaxationPull {
    /// Works out the pull of interval number `number` for yarns with the share `growth` of their
    /// thickness, in place of what was there. `samples` are those of `state`, and `near` are the
    /// neighbours of the interval.
    ///
    /// **Errors**: [`BackendError`] for short memory.
    pub fn measure(
        &mut self,
        plan: &RelaxationPlan,
        state: &RelaxationState,
        growth: f64,
        number: usize,
        samples: &RelaxationSamples,
        near: &[RelaxationNear],
    ) -> Result<(), BackendError> {
        let interval = &plan.intervals()[number];
        let window = plan.points_of(state, interval);
        self.own = RelaxationPress { interval: number as u32, ..RelaxationPress::default() };
        (self.repeat, self.energy) = (DVec2::ZERO, Energy::default());
        self.presses.clear();
        self.bend(plan, interval, &window);
        self.lengthen(plan, interval, &window);
        self.flatten(plan, interval, samples.of(interval));
        for near in near {
            self.press(plan, state, growth, number, samples, near)?;
        }
        self.own.slopes = self.fold(plan, interval, self.own.slopes);
        Ok(())
    }

    /// Adds the energy of bending: `B/2 ∫ |c|² / |x'|⁵ du`, where c is the cross product of both
    /// derivatives x' and x'' by u.
    fn bend(&mut self, plan: &RelaxationPlan, interval: &RelaxationInterval, window: &[DVec3; 4]) {
        let nodes = plan.nodes(interval);
        let weight = plan.elastic()[interval.yarn as usize].bending / nodes.len() as f64;
        for node in nodes {
            let (velocity, acceleration) = (blend(&node.velocity, window), blend(&node.acceleration, window));
            let cross = velocity.cross(acceleration);
            let square = velocity.length_squared().max(STILL);
            let scale = weight / (square * square * square.sqrt());
            self.energy.bending += 0.5 * scale * cross.length_squared();
            let by_acceleration = cross.cross(velocity) * scale;
            let by_velocity = acceleration.cross(cross) * scale
                - velocity * (2.5 * scale * cross.length_squared() / square);
            self.add(&node.velocity, by_velocity);
            self.add(&node.acceleration, by_acceleration);
        }
    }

    /// Adds the energy of the interval's length.
    fn lengthen(&mut self, plan: &RelaxationPlan, interval: &RelaxationInterval, window: &[DVec3; 4]) {
        let (arc, velocities) = plan.arc(window);
        let strain = arc / interval.length - 1.0;
        let force = plan.elastic()[interval.yarn as usize].extension * strain;
        self.energy.length += 0.5 * force * strain * interval.length;
        for (velocity, (node, weight)) in velocities.into_iter().zip(plan.gauss()) {
            self.add(&node.velocity, velocity.normalize_or_zero() * (force * weight));
        }
    }

    /// Adds the energy of what presses the cloth flat: that of springs between the yarn and z = 0.
    fn flatten(&mut self, plan: &RelaxationPlan, interval: &RelaxationInterval, own: &[DVec3]) {
        let stiffness = plan.press * interval.length / f64::from(interval.samples);
        for (at, node) in own.iter().zip(plan.nodes(interval)) {
            self.energy.press += 0.5 * stiffness * at.z * at.z;
            self.add(&node.position, DVec3::Z * (stiffness * at.z));
        }
    }

    /// Adds the contacts with one neighbour.
    fn press(
        &mut self,
        plan: &RelaxationPlan,
        state: &RelaxationState,
        growth: f64,
        number: usize,
        samples: &RelaxationSamples,
        near: &RelaxationNear,
    ) -> Result<(), BackendError> {
        let [interval, other] = [number, near.interval as usize].map(|number| &plan.intervals()[number]);
        let yarns = [interval, other].map(|interval| &plan.elastic()[interval.yarn as usize]);
        let shells = Shells::new(yarns, growth);
        let image = DVec2::new(f64::from(near.image[0]), f64::from(near.image[1]));
        let way = (image * state.repeat).extend(0.0);
        let reach = shells.reach();
        let [own, mut ball] = [number, near.interval as usize].map(|number| samples.balls()[number]);
        ball.middle += way;
        if !own.touches(&ball, reach) {
            return Ok(());
        }
        let window = following(yarns[0], growth);
        let within = (reach + ball.radius).powi(2);
        let yarn = &plan.yarns()[interval.yarn as usize];
        // A closed yarn also follows itself the other way round.
        let turn = if yarn.ends == Ends::Closed { yarn.length } else { f64::INFINITY };
        let parts = [interval, other].map(|interval| interval.length / f64::from(interval.samples));
        // An interval that touches itself meets each pair of its samples twice.
        let is_own = near.interval as usize == number && near.image == [0; 2];
        let lengths = if is_own { 0.5 } else { 1.0 } * parts[0] * parts[1];
        let (mut all, mut stiffness, mut touched) = (DVec3::ZERO, DMat3::ZERO, false);
        self.forces.clear();
        room_for(&mut self.forces, other.samples as usize, "forces of contacts")?;
        self.forces.resize(other.samples as usize, DVec3::ZERO);
        for ((own, at), node) in samples.of(interval).iter().enumerate().zip(plan.nodes(interval)) {
            if at.distance_squared(ball.middle) >= within {
                continue;
            }
            let (mut force, at) = (DVec3::ZERO, *at - way);
            // The distance along the yarn from this sample to the other's first.
            let along = near.along + 0.5 * (parts[1] - parts[0]) - own as f64 * parts[0];
            for (number, place) in samples.of(other).iter().enumerate() {
                let apart = at - *place;
                let square = apart.length_squared();
                if square >= reach * reach {
                    continue;
                }
                let along = (along + number as f64 * parts[1]).abs();
                if along < window || turn - along < window {
                    continue;
                }
                let distance = square.sqrt();
                let [energy, slope, change] = shells.energy(distance);
                self.energy.contact += energy * lengths;
                let way = apart.normalize_or_zero();
                let pushed = way * (slope * lengths);
                force += pushed;
                self.forces[number] -= pushed;
                stiffness += outer(way, change * lengths);
                touched = true;
            }
            self.own.pressed += force.length();
            self.add(&node.position, force);
            all += force;
        }
        self.repeat -= all.truncate() * image;
        self.own.stiffness += stiffness;
        if touched { self.keep(plan, near, stiffness) } else { Ok(()) }
    }

    /// Keeps what the contacts with a neighbour do to it: its forces, and their `stiffness`.
    fn keep(
        &mut self,
        plan: &RelaxationPlan,
        near: &RelaxationNear,
        stiffness: DMat3,
    ) -> Result<(), BackendError> {
        let other = &plan.intervals()[near.interval as usize];
        let (mut slopes, mut pressed) = ([DVec3::ZERO; 4], 0.0);
        for (force, node) in self.forces.iter().zip(plan.nodes(other)) {
            pressed += force.length();
            for (slope, weight) in slopes.iter_mut().zip(node.position) {
                *slope += *force * weight;
            }
        }
        slopes = self.fold(plan, other, slopes);
        room_for(&mut self.presses, 1, "contacts of intervals")?;
        self.presses.push(RelaxationPress { interval: near.interval, slopes, pressed, stiffness });
        Ok(())
    }

    fn add(&mut self, weights: &[f64; 4], slope: DVec3) {
        for (sum, weight) in self.own.slopes.iter_mut().zip(weights) {
            *sum += slope * *weight;
        }
    }

    /// The slopes at an interval's control points. The slopes of virtual ends are moved to the
    /// points that these ends are computed from. Points in other rounds of the yarn move with the
    /// repeat, so their slopes are added to the growth of the energy with the repeat, too.
    fn fold(
        &mut self,
        plan: &RelaxationPlan,
        interval: &RelaxationInterval,
        slopes: [DVec3; 4],
    ) -> [DVec3; 4] {
        let slopes = folded(slopes, plan.is_at_end(interval));
        let shift = plan.shift(interval.yarn);
        for ((_, round), slope) in plan.window_of(interval).into_iter().zip(slopes) {
            self.repeat += slope.truncate() * shift * f64::from(round);
        }
        slopes
    }
}

/// The matrix of a spring of stiffness `factor` along `way`.
fn outer(way: DVec3, factor: f64) -> DMat3 {
    let scaled = way * factor;
    DMat3::from_cols(scaled * way.x, scaled * way.y, scaled * way.z)
}
