//! Rolls in lanes: `Frame::step` and `Turn` of the core, without their jumps.

use texere_core::{ARCTANGENT, COSINE, Frame, NO_LENGTH, NO_MIRROR, Plan, SINE, TAN_EIGHTH, Turn};

use super::rings::{Rings, Source};
use super::vector::{LANES_MAX, Vector, difference, dot, plus, scale, select};
use crate::rolls::Rolls;

/// The steps along upright rings.
#[derive(Debug)]
pub(super) struct Steps<V> {
    minimizing: bool,
    /// Turns per mm; none where it is zero.
    twist: Option<V>,
    /// The vector of rings before the present one, if there is one.
    before: Option<Traces<V>>,
}

/// What a step needs of the ring where it begins.
#[derive(Debug, Clone, Copy)]
struct Traces<V> {
    offset: [V; 3],
    span: [V; 3],
    tangent: [V; 3],
    side: [V; 3],
}

impl<V: Vector> Steps<V> {
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn new(source: &Source<'_>, yarn: usize) -> Self {
        let twist = source.plan.twist_turns(yarn);
        Self {
            minimizing: source.plan.settings().frame == Frame::RotationMinimizing,
            twist: (twist != 0.0).then(|| V::splat(twist)),
            before: None,
        }
    }

    /// The step to each of the next rings from the one before it. That to the very first means nothing.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn next(&mut self, rings: &Rings<V>) -> V::Whole {
        let here =
            Traces { offset: rings.offset, span: rings.span, tangent: rings.tangent, side: rings.side };
        let before = self.before.replace(here).unwrap_or(here);
        self.between(&before, rings)
    }

    #[cfg_attr(optimized, inline(always))]
    fn between(&self, before: &Traces<V>, rings: &Rings<V>) -> V::Whole {
        let offset = preceding(before.offset, rings.offset);
        let span = preceding(before.span, rings.span);
        // The last ring of an interval is followed by the start of the next one.
        let chord = difference(select(rings.t.is_zero(), span, rings.offset), offset);
        let length_squared = dot(chord, chord);
        let turn =
            if self.minimizing { transport(before, rings, chord, length_squared) } else { V::splat(0.0) };
        match self.twist {
            Some(twist) => from_turns(turn + twist * length_squared.sqrt()),
            None => from_turns(turn),
        }
    }
}

impl<V: Vector> Rings<V> {
    /// These rings with their bases turned by `roll`.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn turned(&self, roll: V::Whole) -> Self {
        let (sin, cos) = sin_cos::<V>(roll);
        let level = V::from_signed(roll).is_zero();
        let (side, up) = (self.side, self.up);
        Self {
            side: select(level, side, plus(scale(side, cos), scale(up, sin))),
            up: select(level, up, difference(scale(up, cos), scale(side, sin))),
            ..*self
        }
    }
}

/// Rolls of a vector of rings of `yarn`, from ring `first` in block `block` on.
#[cfg_attr(optimized, inline(always))]
pub(super) fn rolls<V: Vector>(plan: &Plan, rolls: &Rolls, yarn: usize, first: u32, block: u64) -> V::Whole {
    let place = (plan.ring_offsets()[yarn] + u64::from(first)) as usize;
    let in_block = V::load_whole(bytemuck::cast_slice(&rolls.in_block[place..]));
    let sums = V::add_whole(V::splat_whole(rolls.at_block(block).0), in_block);
    if !plan.yarn(yarn).closed {
        return sums;
    }
    let mut lanes = [0; LANES_MAX];
    V::store_whole(sums, &mut lanes);
    for (roll, ring) in lanes.iter_mut().zip(first..plan.rings(yarn)) {
        *roll = rolls.closed_up(plan, yarn, ring, Turn(*roll)).0;
    }
    V::load_whole(&lanes)
}

/// The vectors of the rings before `here`, the first of which is the last one in `before`.
#[cfg_attr(optimized, inline(always))]
fn preceding<V: Vector>(before: [V; 3], here: [V; 3]) -> [V; 3] {
    [V::preceding(before[0], here[0]), V::preceding(before[1], here[1]), V::preceding(before[2], here[2])]
}

/// Double reflection from the rings before to `rings`, in turns.
#[cfg_attr(optimized, inline(always))]
fn transport<V: Vector>(before: &Traces<V>, rings: &Rings<V>, chord: [V; 3], length_squared: V) -> V {
    let tangent = preceding(before.tangent, rings.tangent);
    let apart = V::less(V::splat(NO_LENGTH), length_squared);
    let mirror = select(apart, chord, tangent);
    let mirror_squared = V::select(apart, length_squared, V::splat(1.0));
    let side = reflect(preceding(before.side, rings.side), mirror, mirror_squared);
    let second = difference(rings.tangent, reflect(tangent, mirror, mirror_squared));
    let second_squared = dot(second, second);
    let bends = V::less(V::splat(NO_MIRROR), second_squared);
    let side = select(bends, reflect(side, second, second_squared), side);
    atan2_turns(dot(side, rings.up), dot(side, rings.side))
}

/// `v` mirrored in the plane at right angles to `mirror`.
#[cfg_attr(optimized, inline(always))]
fn reflect<V: Vector>(v: [V; 3], mirror: [V; 3], mirror_squared: V) -> [V; 3] {
    let share = V::splat(2.0) * dot(v, mirror) / mirror_squared;
    difference(v, scale(mirror, share))
}

/// `Turn::from_turns`
#[cfg_attr(optimized, inline(always))]
fn from_turns<V: Vector>(turns: V) -> V::Whole {
    let half = V::splat(0.5);
    let wrapped = (turns - (turns + half).floor()).max(half.negate());
    (wrapped * V::splat(Turn::STEPS) + half).floor().to_signed()
}

/// `Turn::sin_cos`
#[cfg_attr(optimized, inline(always))]
fn sin_cos<V: Vector>(turn: V::Whole) -> (V, V) {
    let quarter = V::shift_right::<30>(V::add_whole(turn, V::splat_whole(1 << 29)));
    let rest = V::sub_whole(turn, V::shift_left::<30>(quarter));
    let x = V::from_signed(rest) * V::splat(Turn::RADIANS_PER_STEP);
    let z = x * x;
    let ([s1, s2, s3], [c1, c2, c3]) = (SINE, COSINE);
    let (s1, s2, s3) = (V::splat(s1), V::splat(s2), V::splat(s3));
    let (c1, c2, c3) = (V::splat(c1), V::splat(c2), V::splat(c3));
    let sin = ((s3 * z + s2) * z + s1) * z * x + x;
    let cos = ((c3 * z + c2) * z + c1) * z * z - V::splat(0.5) * z + V::splat(1.0);
    let odd = V::has_bit(quarter, 1);
    let (sin, cos) = (V::select(odd, cos, sin), V::select(odd, sin, cos));
    let below = V::has_bit(quarter, 2);
    let left = V::has_bit(V::add_whole(quarter, V::splat_whole(1)), 2);
    (V::select(below, sin.negate(), sin), V::select(left, cos.negate(), cos))
}

/// `atan2_turns` of the core
#[cfg_attr(optimized, inline(always))]
fn atan2_turns<V: Vector>(y: V, x: V) -> V {
    let (along, across) = (x.abs(), y.abs());
    let steep = V::less(along, across);
    let (low, high) = (V::select(steep, along, across), V::select(steep, across, along));
    let beyond = V::less(V::splat(TAN_EIGHTH) * high, low);
    let numerator = V::select(beyond, low - high, low);
    let denominator = V::select(beyond, low + high, high);
    let eighth = V::select(beyond, V::splat(0.125), V::splat(0.0));
    let q = numerator / denominator;
    let z = q * q;
    let [a1, a3, a5, a7, a9] = ARCTANGENT;
    let series = ((V::splat(a9) * z + V::splat(a7)) * z + V::splat(a5)) * z + V::splat(a3);
    let octant = eighth + (series * z * q + V::splat(a1) * q);
    let quadrant = V::select(steep, V::splat(0.25) - octant, octant);
    let half = V::select(V::less(x, V::splat(0.0)), V::splat(0.5) - quadrant, quadrant);
    let signed = V::select(V::less(y, V::splat(0.0)), half.negate(), half);
    V::select(high.is_zero(), V::splat(0.0), signed)
}
