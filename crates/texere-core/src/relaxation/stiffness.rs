//! The stiffness of yarns, each alone: the first guess of how slopes change with a step.

use std::ops::ControlFlow;

use glam::{DMat3, DVec3};

use super::node::{blend, folded};
use super::{RelaxationInterval, RelaxationPlan, RelaxationState};
use crate::backend::{filled, room};
use crate::work_watch::WorkWatch;
use crate::{BackendError, Ends};

/// The share of the mean stiffness of a yarn's control points that is added to each, so that a yarn
/// which touches no other has a stiffness in every direction. With half the value, and with twice,
/// no test is red.
const LEAST: f64 = 1e-4;

/// The stiffness of what holds a pinned point, in mean stiffnesses of the yarn's control points.
/// With half the value, and with twice, no test is red.
const HELD: f64 = 1e6;

/// The least speed of a spline, as a share of its mean speed in the interval. Without this bound, a
/// place where the spline is slower would get nearly all of the stiffness. With half the value, and
/// with twice, no test is red.
const SLOW: f64 = 0.05;

/// The number of intervals or rows between two calls of `watch`.
const PART: usize = 4096;

/// The control points that one interval couples, less 1.
const COUPLED: usize = 3;

/// The stiffness of all yarns at one state, ready to find the step that balances given forces.
///
/// Bending, length and press couple the control points of a yarn. Contacts count as if the other
/// yarn stood still. Terms that could make a stiffness negative are left out, above all the change
/// of contact forces as contacts turn. Every stiffness is therefore positive.
#[derive(Debug)]
pub(super) struct Stiffness {
    yarns: Vec<Envelope>,
    /// The mean stiffness of a control point in one direction, N/mm.
    mean: f64,
}

impl Stiffness {
    /// The stiffness at `state`. `contacts` has the contact stiffness of each interval. Asks
    /// `watch` now and then whether to go on.
    pub(super) fn new(
        plan: &RelaxationPlan,
        state: &RelaxationState,
        contacts: &[DMat3],
        watch: WorkWatch<'_>,
    ) -> Result<ControlFlow<(), Self>, BackendError> {
        let mut yarns = room("stiffnesses of yarns", plan.yarns().len())?;
        for yarn in plan.yarns() {
            yarns.push(Envelope::new(yarn.points as usize, yarn.ends != Ends::Open)?);
        }
        for (number, (interval, contact)) in plan.intervals().iter().zip(contacts).enumerate() {
            if number.is_multiple_of(PART) && watch().is_break() {
                return Ok(ControlFlow::Break(()));
            }
            add(&mut yarns[interval.yarn as usize], plan, state, interval, contact);
        }
        let (mut sum, mut count) = (0.0, 0);
        let mut pinned = plan.pinned().to_vec();
        pinned.sort_unstable();
        let mut pinned = pinned.as_slice();
        for (own, yarn) in plan.yarns().iter().zip(&mut yarns) {
            let mean = yarn.stiffen();
            sum += mean * yarn.rows.len() as f64;
            count += yarn.rows.len();
            let (held, rest) =
                pinned.split_at(pinned.partition_point(|point| *point < own.first + own.points));
            for point in held {
                let point = (point - own.first) as usize;
                yarn.add(point, point, DMat3::from_diagonal(DVec3::splat(HELD * mean)));
            }
            pinned = rest;
            if yarn.factor(LEAST * mean, watch).is_break() {
                return Ok(ControlFlow::Break(()));
            }
        }
        Ok(ControlFlow::Continue(Self { yarns, mean: sum / count.max(1) as f64 }))
    }

    /// The mean stiffness of a control point in one direction, N/mm.
    pub(super) const fn mean(&self) -> f64 {
        self.mean
    }

    /// Replaces the forces at all control points, three numbers each, by the steps that they make.
    pub(super) fn solve(&self, mut forces: &mut [f64]) {
        for yarn in &self.yarns {
            let (own, rest) = forces.split_at_mut(yarn.rows.len());
            yarn.solve(own);
            forces = rest;
        }
    }
}

/// Adds the stiffness of one interval to that of its yarn.
fn add(
    yarn: &mut Envelope,
    plan: &RelaxationPlan,
    state: &RelaxationState,
    interval: &RelaxationInterval,
    contact: &DMat3,
) {
    let window = plan.points_of(state, interval);
    let first = plan.yarns()[interval.yarn as usize].first;
    let points = plan.window_of(interval).map(|(point, _)| (point - first) as usize);
    let nodes = plan.nodes(interval);
    let share = 1.0 / nodes.len() as f64;
    let elastic = &plan.elastic()[interval.yarn as usize];
    let press = DMat3::from_diagonal(DVec3::Z * (plan.press * interval.length));
    let by_place = (*contact + press) * share;
    let ends = plan.is_at_end(interval);
    for node in nodes {
        let [position, velocity, acceleration] =
            [node.position, node.velocity, node.acceleration].map(|weights| folded(weights, ends));
        let [along, bent] = [&node.velocity, &node.acceleration].map(|weights| blend(weights, &window));
        let square = along.length_squared().max((SLOW * interval.length).powi(2));
        let scale = elastic.bending * share / (square * square * square.sqrt());
        let [turn, turned] = [along, bent].map(crossed);
        let change = [0, 1, 2, 3].map(|slot| turn * acceleration[slot] - turned * velocity[slot]);
        for (slot, row) in points.into_iter().enumerate() {
            for (other, column) in points.into_iter().enumerate().filter(|(_, column)| *column <= row) {
                let bending = change[slot].transpose() * change[other] * scale;
                yarn.add(row, column, bending + by_place * (position[slot] * position[other]));
            }
        }
    }
    let (_, velocities) = plan.arc(&window);
    let mut growth = [DVec3::ZERO; 4];
    for (velocity, (node, weight)) in velocities.into_iter().zip(plan.gauss()) {
        let weights = folded(node.velocity, ends);
        for (growth, by) in growth.iter_mut().zip(weights) {
            *growth += velocity.normalize_or_zero() * (by * weight);
        }
    }
    let scale = elastic.extension / interval.length;
    for (slot, row) in points.into_iter().enumerate() {
        for (other, column) in points.into_iter().enumerate() {
            let [one, other] = [growth[slot] * scale, growth[other]];
            yarn.add(row, column, DMat3::from_cols(one * other.x, one * other.y, one * other.z));
        }
    }
}

/// The matrix that, times any vector v, gives the cross product of `vector` and v, in this order.
fn crossed(vector: DVec3) -> DMat3 {
    DMat3::from_cols(vector.cross(DVec3::X), vector.cross(DVec3::Y), vector.cross(DVec3::Z))
}

/// A symmetric matrix, or its factor, by rows: each up to the diagonal, from the first column that
/// may not be zero. Cholesky's factor has its zeros in equal places.
///
/// **Source**: Jennings, "A compact storage scheme for the solution of symmetric linear
/// simultaneous equations", Computer Journal 9, 1966.
#[derive(Debug)]
struct Envelope {
    values: Vec<f64>,
    /// For each row the index of its first value, and the column of that value.
    rows: Vec<(usize, usize)>,
}

impl Envelope {
    /// A matrix of zeros for a yarn of `points` control points. The last ones of a yarn that goes
    /// `round` are coupled with its first ones.
    fn new(points: usize, round: bool) -> Result<Self, BackendError> {
        let mut rows = room("rows of a stiffness", 3 * points)?;
        let mut count = 0;
        for row in 0..3 * points {
            let point = row / 3;
            let is_last = round && point + COUPLED >= points;
            let first = if is_last { 0 } else { 3 * point.saturating_sub(COUPLED) };
            rows.push((count, first));
            count += row + 1 - first;
        }
        Ok(Self { values: filled("values of a stiffness", count, 0.0)?, rows })
    }

    /// Adds a block of three rows and columns, which belongs to two control points. What lies above
    /// the diagonal is left out.
    fn add(&mut self, row: usize, column: usize, block: DMat3) {
        if row < column {
            return;
        }
        for down in 0..3 {
            let row = 3 * row + down;
            for across in 0..3 {
                let column = 3 * column + across;
                if column <= row {
                    let (start, first) = self.rows[row];
                    self.values[start + column - first] += block.col(across)[down];
                }
            }
        }
    }

    /// A row from its first column on, and that column.
    fn row(&self, row: usize) -> (&[f64], usize) {
        let (start, first) = self.rows[row];
        (&self.values[start..=start + row - first], first)
    }

    /// Adds the least stiffness to the diagonal. Returns the diagonal's mean.
    fn stiffen(&mut self) -> f64 {
        let diagonal = |(row, &(start, first)): (usize, &(usize, usize))| start + row - first;
        let sum: f64 = self.rows.iter().enumerate().map(|row| self.values[diagonal(row)]).sum();
        let mean = sum / self.rows.len() as f64;
        for row in self.rows.iter().enumerate() {
            self.values[diagonal(row)] += LEAST * mean;
        }
        mean
    }

    /// Replaces the matrix by its factor. Pivots that rounding has made less than `least` become
    /// `least`.
    fn factor(&mut self, least: f64, watch: WorkWatch<'_>) -> ControlFlow<()> {
        for row in 0..self.rows.len() {
            if row.is_multiple_of(PART) {
                watch()?;
            }
            let (start, first) = self.rows[row];
            let (before, own) = self.values.split_at_mut(start);
            for column in first..=row {
                let (other, from) = self.rows[column];
                let shared = first.max(from);
                let above = if column == row {
                    &own[shared - first..row - first]
                } else {
                    &before[other + shared - from..other + column - from]
                };
                let sum: f64 = own[shared - first..column - first]
                    .iter()
                    .zip(above)
                    .map(|(own, above)| own * above)
                    .sum();
                let rest = own[column - first] - sum;
                own[column - first] =
                    if column == row { rest.max(least).sqrt() } else { rest / before[other + column - from] };
            }
        }
        ControlFlow::Continue(())
    }

    /// Replaces the right side by the solution.
    fn solve(&self, side: &mut [f64]) {
        for row in 0..self.rows.len() {
            let (own, first) = self.row(row);
            let sum: f64 = own.iter().zip(&side[first..row]).map(|(own, side)| own * side).sum();
            side[row] = (side[row] - sum) / own[row - first];
        }
        for row in (0..self.rows.len()).rev() {
            let (own, first) = self.row(row);
            side[row] /= own[row - first];
            let solved = side[row];
            for (side, own) in side[first..row].iter_mut().zip(own) {
                *side -= own * solved;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A step times the matrix gives the forces, for yarns that go round and for open ones, also
    /// where the first and the last points of a round are the same.
    #[test]
    fn a_step_balances_its_forces() {
        for (points, round) in [(3, true), (5, true), (20, true), (2, false), (9, false)] {
            let mut state = 1_u64;
            let mut random = || {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                (state >> 40) as f64 / (1_u64 << 24) as f64 - 0.5
            };
            let mut envelope = Envelope::new(points, round).unwrap();
            let mut dense = vec![vec![0.0; 3 * points]; 3 * points];
            for interval in 0..if round { points } else { points - 1 } {
                let window = [-1, 0, 1, 2].map(|slot| {
                    let (at, count) = (interval as i64 + slot, points as i64);
                    (if round { at.rem_euclid(count) } else { at.clamp(0, count - 1) }) as usize
                });
                let change = [0; 4].map(|_| DMat3::from_cols_array(&[0; 9].map(|_| random())));
                for (slot, row) in window.into_iter().enumerate() {
                    for (other, column) in window.into_iter().enumerate() {
                        let block = change[slot].transpose() * change[other];
                        envelope.add(row, column, block);
                        for at in 0..9 {
                            dense[3 * row + at % 3][3 * column + at / 3] += block.col(at / 3)[at % 3];
                        }
                    }
                }
            }
            let mean = envelope.stiffen();
            assert!(envelope.factor(LEAST * mean, &mut || ControlFlow::Continue(())).is_continue());
            let forces: Vec<f64> = (0..3 * points).map(|_| random()).collect();
            let mut step = forces.clone();
            envelope.solve(&mut step);
            for (row, force) in forces.iter().enumerate() {
                let own: f64 = dense[row].iter().zip(&step).map(|(value, step)| value * step).sum();
                let found = own + LEAST * mean * step[row];
                assert!((found - force).abs() < 1e-8, "{points} points, row {row}: {found} for {force}");
            }
        }
    }
}
