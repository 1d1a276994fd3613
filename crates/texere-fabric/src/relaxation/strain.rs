//! Tests of strain: a knit is held at a width or a length that it does not have at rest, and the
//! force with which it pulls is measured.

use std::ops::ControlFlow;

use glam::DVec2;
use texere_core::Backend;
use texere_core::relaxation::{Energy, RelaxationState, Relaxed};
use texere_core::settling::Length;

use super::gauge_at;
use super::relaxing::Relaxing;
use crate::settling::tell;
use crate::weft::Gauge;
use crate::{Along, FinishError, Repeat, thickness_mm};

/// The longest way from one state to the next, as a share of the cloth's size at rest. Yarns that
/// are stretched further at once press so hard that the search takes more steps. With half the
/// value, and with twice, no test is red.
const STRIDE: f64 = 0.05;

/// The least and the greatest strain that is measured.
const STRAINS: [f64; 2] = [-0.5, 5.0];

/// The share of a test's progress at which the knit is at rest.
const RESTED: f64 = 0.3;

/// A strained state of a knit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrainState {
    /// The strain along the courses and along the wales, as a share of the cloth's width and height
    /// at rest.
    pub strain: [f64; 2],
    /// The force along the courses and along the wales, N/mm: for each mm of the strained cloth,
    /// measured across the force. The force is nearly 0 along a way that is free.
    pub force: [f64; 2],
    /// Thickness, mm.
    pub thickness_mm: f64,
    /// The energy of one repeat.
    pub energy: Energy,
    /// Whether the forces balance.
    pub balanced: bool,
}

/// A test of strain: a knit at rest, and at several strains.
#[derive(Debug, Clone, PartialEq)]
pub struct StrainTest {
    /// The way along which the knit was strained.
    pub along: Along,
    /// The distances of wales and courses at rest. Its loop length is the one that was asked for.
    pub gauge: Gauge,
    /// The size of one repeat at rest, mm.
    pub repeat_mm: [f64; 2],
    /// The states, by rising strain.
    pub states: Vec<StrainState>,
}

impl StrainTest {
    /// Strain and force per width of each state along the way of the test; along the courses if it
    /// is strained along both.
    fn curve(&self) -> impl Iterator<Item = [f64; 2]> + Clone + '_ {
        let axis = self.along.axis();
        self.states.iter().map(move |state| [state.strain[axis], state.force[axis]])
    }

    /// The energy of a state above that at rest, for each mm² of cloth at rest, N mm/mm².
    #[must_use]
    pub fn stored(&self, state: &StrainState) -> f64 {
        let rest = self.states.iter().find(|state| state.strain == [0.0; 2]);
        let rest = rest.map_or(0.0, |rest| rest.energy.sum());
        (state.energy.sum() - rest) / (self.repeat_mm[0] * self.repeat_mm[1])
    }

    /// The strain along the way of the test at which the force per width first reaches `force`,
    /// N/mm. Between two states the curve is taken as a straight line. In a test along both ways,
    /// strain and force along the courses count. None if the curve does not reach `force`.
    #[must_use]
    pub fn strain_at(&self, force: f64) -> Option<f64> {
        let pairs = self.curve().zip(self.curve().skip(1));
        pairs.into_iter().find_map(|([from, low], [to, high])| {
            let within = low <= force && force <= high && low < high;
            within.then(|| from + (to - from) * (force - low) / (high - low))
        })
    }

    /// The tangent modulus at a strain, N/mm: by how much the force per width grows with the
    /// strain. It is the slope of the parabola through the three nearest states. In a test along
    /// both ways, force and strain along the courses count. None if there are fewer than three
    /// states, or if the strain lies outside of them.
    #[must_use]
    pub fn modulus_at(&self, strain: f64) -> Option<f64> {
        let curve: Vec<[f64; 2]> = self.curve().collect();
        slope(&curve, strain)
    }

    /// Poisson's ratio at a strain: by how much the cloth gets narrower across the strain, as a
    /// share of its size at rest. None for a test along both ways, if there are fewer than three
    /// states, or if the strain lies outside of them.
    #[must_use]
    pub fn poisson_at(&self, strain: f64) -> Option<f64> {
        if self.along == Along::Both {
            return None;
        }
        let axis = self.along.axis();
        let curve: Vec<[f64; 2]> =
            self.states.iter().map(|state| [state.strain[axis], -state.strain[1 - axis]]).collect();
        slope(&curve, strain)
    }
}

/// The slope at `x` of the parabola through the three points of a curve that lie nearest.
fn slope(curve: &[[f64; 2]], x: f64) -> Option<f64> {
    let within = curve.first()?[0] - 1e-9 <= x && x <= curve.last()?[0] + 1e-9;
    let middle = (1..curve.len().checked_sub(1)?).min_by(|one, other| {
        let far = |at: &usize| (curve[*at][0] - x).abs();
        far(one).total_cmp(&far(other))
    })?;
    let [[a, at_a], [b, at_b], [c, at_c]] = [curve[middle - 1], curve[middle], curve[middle + 1]];
    let of = |value: f64, own: f64, one: f64, other: f64| {
        value * (2.0 * x - one - other) / ((own - one) * (own - other))
    };
    let slope = of(at_a, a, b, c) + of(at_b, b, a, c) + of(at_c, c, a, b);
    (within && slope.is_finite()).then_some(slope)
}

/// Relaxes one repeat of a knit, then strains it. `strains` rise; the state at rest is added.
pub(crate) fn strain_repeat(
    repeat: &Repeat,
    gauge: &Gauge,
    length: Length,
    (along, strains): (Along, &[f64]),
    backend: &dyn Backend,
    mut progress: impl FnMut(f64) -> ControlFlow<()> + Send,
) -> Result<StrainTest, FinishError> {
    let [low, high] = STRAINS;
    let rise = strains.windows(2).all(|pair| pair[0] < pair[1]);
    if !(rise && strains.iter().all(|strain| (low..=high).contains(strain))) {
        return Err(FinishError::Strains { low, high });
    }
    tell(&mut progress, 0.0)?;
    let mut relaxing = Relaxing::new(&repeat.piece, length, [false; 2], backend)?;
    let rested = relaxing.rest(&mut |made| progress(RESTED * f64::from(made) / f64::from(made + 300)))?;
    let rest = rested.ok_or(FinishError::Passed { strain: 0.0 })?;
    let size = rest.state.repeat;
    let mut states = Vec::with_capacity(strains.len() + 1);
    // Strains below 0 from 0 down, then those above from 0 up.
    let below = strains.iter().rev().filter(|strain| **strain < 0.0);
    let above = strains.iter().filter(|strain| **strain > 0.0);
    let (mut state, mut last) = (rest.state.clone(), 0.0);
    states.push(state_of(&relaxing, &rest, size)?);
    for (number, strain) in below.chain(above).enumerate() {
        if *strain > 0.0 && last < 0.0 {
            (state, last) = (rest.state.clone(), 0.0);
            relaxing.compared.go_back(&state);
        }
        let strides = ((strain - last).abs() / STRIDE).ceil().max(1.0) as u32;
        for stride in 1..=strides {
            let to = last + (strain - last) * f64::from(stride) / f64::from(strides);
            let target = DVec2::select(along.held().into(), size * (1.0 + to), state.repeat);
            let stretched = state.stretched(target / state.repeat);
            let done = number as f64 + f64::from(stride - 1) / f64::from(strides);
            let share = RESTED + (1.0 - RESTED) * done / strains.len() as f64;
            let strained = relaxing.strained(stretched, along.held(), &mut |_| progress(share))?;
            let strained = strained.ok_or(FinishError::Passed { strain: to })?;
            state = strained.state.clone();
            if stride == strides {
                states.push(state_of(&relaxing, &strained, size)?);
            }
        }
        last = *strain;
    }
    states.sort_by(|one, other| one.strain[along.axis()].total_cmp(&other.strain[along.axis()]));
    tell(&mut progress, 1.0)?;
    let gauge = gauge_at(size, gauge, &repeat.piece);
    Ok(StrainTest { along, gauge, repeat_mm: size.to_array(), states })
}

/// The measures of a relaxed state of a repeat whose size at rest is `size`, mm.
fn state_of(relaxing: &Relaxing<'_>, relaxed: &Relaxed, size: DVec2) -> Result<StrainState, FinishError> {
    let RelaxationState { repeat, .. } = &relaxed.state;
    let moved = relaxing.compared.piece_of(&relaxed.state)?;
    Ok(StrainState {
        strain: (*repeat / size - 1.0).to_array(),
        force: [relaxed.pull.x / repeat.y, relaxed.pull.y / repeat.x],
        thickness_mm: thickness_mm(&moved.yarns),
        energy: relaxed.energy,
        balanced: relaxed.at_rest,
    })
}
