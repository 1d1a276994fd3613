//! Rolls in lanes: `Frame::step` and `Turn` of the core, without branches.

use texere_core::Frame;
use texere_core::backend::Plan;
use texere_core::definitions::{ARCTANGENT, COSINE, NO_LENGTH, NO_MIRROR, SINE, TAN_EIGHTH, Turn};

use super::rings::{Rings, Source};
use super::simd::{Floats, Integers, LANES_MAX, Mask, Simd, difference, dot, plus, scale, select};
use crate::rolls::Rolls;

/// The steps along upright rings. A step is the turn of a section from one ring to the next.
#[derive(Debug)]
pub(super) struct Steps<S: Simd> {
    simd: S,
    minimizing: bool,
    /// The twist in turns per mm; none if it is zero.
    twist: Option<S::Floats>,
    /// The vector of rings before the next one; none at the start.
    before: Option<Traces<S>>,
}

/// The values that a step needs of the ring where it begins.
#[derive(Debug, Clone, Copy)]
struct Traces<S: Simd> {
    offset: [S::Floats; 3],
    span: [S::Floats; 3],
    tangent: [S::Floats; 3],
    side: [S::Floats; 3],
}

impl<S: Simd> Steps<S> {
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn new(simd: S, source: &Source<'_>, yarn: usize) -> Self {
        let twist = source.plan.turns_per_mm(yarn);
        Self {
            simd,
            minimizing: source.plan.frame(yarn) == Frame::RotationMinimizing,
            twist: (twist != 0.0).then(|| simd.splat(twist)),
            before: None,
        }
    }

    /// The step to each of the next rings from the ring before it. The step to the very first ring
    /// has no meaning.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn next(&mut self, rings: &Rings<S, false>) -> S::Integers {
        let here =
            Traces { offset: rings.offset, span: rings.span, tangent: rings.tangent, side: rings.side };
        let before = self.before.replace(here).unwrap_or(here);
        self.between(&before, rings)
    }

    #[cfg_attr(optimized, inline(always))]
    fn between(&self, before: &Traces<S>, rings: &Rings<S, false>) -> S::Integers {
        let simd = self.simd;
        let offset = preceding(before.offset, rings.offset);
        let span = preceding(before.span, rings.span);
        // A ring that starts an interval lies at the end of the interval before: at `span`,
        // relative to that interval's start.
        let chord = difference(select(rings.t.is_zero(), span, rings.offset), offset);
        let length_squared = dot(chord, chord);
        let turn = if self.minimizing {
            transport(simd, before, rings, chord, length_squared)
        } else {
            simd.splat(0.0)
        };
        match self.twist {
            Some(twist) => from_turns(simd, turn + twist * length_squared.sqrt()),
            None => from_turns(simd, turn),
        }
    }
}

impl<S: Simd, const FLATTENED: bool> Rings<S, FLATTENED> {
    /// These rings, turned by `roll`. The frames of round rings turn; flattened rings turn inside
    /// their frames.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn turned(&self, simd: S, roll: S::Integers) -> Self {
        let (sin, cos) = sin_cos(simd, roll);
        let round = self.round();
        if FLATTENED && round.bits() == 0 {
            return Self { roll: (sin, cos), ..*self };
        }
        let level = roll.signed_to_floats().is_zero();
        let (side, up) = (self.side, self.up);
        let mut turned = Self {
            side: select(level, side, plus(scale(side, cos), scale(up, sin))),
            up: select(level, up, difference(scale(up, cos), scale(side, sin))),
            roll: (sin, cos),
            ..*self
        };
        if FLATTENED {
            turned.side = select(round, turned.side, side);
            turned.up = select(round, turned.up, up);
        }
        turned
    }
}

/// The rolls of a vector of rings of `yarn`, from ring `first` in block `block` on. `in_block` are
/// the sums of steps inside the block, from there on.
#[cfg_attr(optimized, inline(always))]
pub(super) fn rolls<S: Simd>(
    simd: S,
    plan: &Plan,
    rolls: &Rolls,
    in_block: &[Turn],
    yarn: usize,
    first: u32,
    block: u64,
) -> S::Integers {
    let in_block = simd.load_integers(bytemuck::cast_slice(in_block));
    let sums = simd.splat_integer(rolls.at_block(block).0) + in_block;
    if !plan.yarn(yarn).closed {
        return sums;
    }
    let mut lanes = [0; LANES_MAX];
    sums.store(&mut lanes);
    for (roll, ring) in lanes.iter_mut().zip(first..plan.rings(yarn)) {
        *roll = rolls.closed_up(plan, yarn, ring, Turn(*roll)).0;
    }
    simd.load_integers(&lanes)
}

/// The vectors of the rings just before the rings of `here`. The first one is the last of `before`.
#[cfg_attr(optimized, inline(always))]
fn preceding<F: Floats>(before: [F; 3], here: [F; 3]) -> [F; 3] {
    [here[0].shift_in(before[0]), here[1].shift_in(before[1]), here[2].shift_in(before[2])]
}

/// How far double reflection turns the frame from the rings of `before` to `rings`, in turns.
#[cfg_attr(optimized, inline(always))]
fn transport<S: Simd>(
    simd: S,
    before: &Traces<S>,
    rings: &Rings<S, false>,
    chord: [S::Floats; 3],
    length_squared: S::Floats,
) -> S::Floats {
    let tangent = preceding(before.tangent, rings.tangent);
    let apart = simd.splat(NO_LENGTH).less(length_squared);
    let mirror = select(apart, chord, tangent);
    let mirror_squared = apart.select(length_squared, simd.splat(1.0));
    let side = reflect(simd, preceding(before.side, rings.side), mirror, mirror_squared);
    let second = difference(rings.tangent, reflect(simd, tangent, mirror, mirror_squared));
    let second_squared = dot(second, second);
    let bends = simd.splat(NO_MIRROR).less(second_squared);
    let side = select(bends, reflect(simd, side, second, second_squared), side);
    atan2_turns(simd, dot(side, rings.up), dot(side, rings.side))
}

/// `v` mirrored in the plane at right angles to `mirror`.
#[cfg_attr(optimized, inline(always))]
fn reflect<S: Simd>(
    simd: S,
    v: [S::Floats; 3],
    mirror: [S::Floats; 3],
    mirror_squared: S::Floats,
) -> [S::Floats; 3] {
    let share = simd.splat(2.0) * dot(v, mirror) / mirror_squared;
    difference(v, scale(mirror, share))
}

/// `Turn::from_turns`
#[cfg_attr(optimized, inline(always))]
fn from_turns<S: Simd>(simd: S, turns: S::Floats) -> S::Integers {
    let half = simd.splat(0.5);
    let wrapped = (turns - (turns + half).floor()).max(-half);
    (wrapped * simd.splat(Turn::STEPS) + half).floor().to_signed()
}

/// `Turn::sin_cos`
#[cfg_attr(optimized, inline(always))]
fn sin_cos<S: Simd>(simd: S, turn: S::Integers) -> (S::Floats, S::Floats) {
    let quarter = (turn + simd.splat_integer(1 << 29)).shift_right::<30>();
    let rest = turn - quarter.shift_left::<30>();
    let x = rest.signed_to_floats() * simd.splat(Turn::RADIANS_PER_STEP);
    let z = x * x;
    let ([s1, s2, s3], [c1, c2, c3]) = (SINE, COSINE);
    let (s1, s2, s3) = (simd.splat(s1), simd.splat(s2), simd.splat(s3));
    let (c1, c2, c3) = (simd.splat(c1), simd.splat(c2), simd.splat(c3));
    let sin = ((s3 * z + s2) * z + s1) * z * x + x;
    let cos = ((c3 * z + c2) * z + c1) * z * z - simd.splat(0.5) * z + simd.splat(1.0);
    let odd = quarter.has_bit(1);
    let (sin, cos) = (odd.select(cos, sin), odd.select(sin, cos));
    let below = quarter.has_bit(2);
    let left = (quarter + simd.splat_integer(1)).has_bit(2);
    (below.select(-sin, sin), left.select(-cos, cos))
}

/// `atan2_turns` of the core
#[cfg_attr(optimized, inline(always))]
fn atan2_turns<S: Simd>(simd: S, y: S::Floats, x: S::Floats) -> S::Floats {
    let (along, across) = (x.abs(), y.abs());
    let steep = along.less(across);
    let (low, high) = (steep.select(along, across), steep.select(across, along));
    let beyond = (simd.splat(TAN_EIGHTH) * high).less(low);
    let numerator = beyond.select(low - high, low);
    let denominator = beyond.select(low + high, high);
    let eighth = beyond.select(simd.splat(0.125), simd.splat(0.0));
    let q = numerator / denominator;
    let z = q * q;
    let [a1, a3, a5, a7, a9] = ARCTANGENT;
    let series = ((simd.splat(a9) * z + simd.splat(a7)) * z + simd.splat(a5)) * z + simd.splat(a3);
    let octant = eighth + (series * z * q + simd.splat(a1) * q);
    let quadrant = steep.select(simd.splat(0.25) - octant, octant);
    let half = x.less(simd.splat(0.0)).select(simd.splat(0.5) - quadrant, quadrant);
    let signed = y.less(simd.splat(0.0)).select(-half, half);
    high.is_zero().select(simd.splat(0.0), signed)
}
