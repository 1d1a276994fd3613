//! Poison: the values that fill memory before a stage runs.

use texere_core::Vertex;
use texere_core::definitions::{Ring, Turn};

/// A NaN that no arithmetic gives. Memory that still holds it was never written.
const POISON: f32 = f32::from_bits(0x7fc0_bad1);

/// A vertex that was never written.
pub(crate) const POISONED_VERTEX: Vertex = Vertex { position: [POISON; 3], normal: [POISON; 3] };

/// A ring that was never written.
pub(crate) const POISONED_RING: Ring = Ring {
    centre: [POISON; 3],
    half_width: POISON,
    tangent: [POISON; 3],
    roll: Turn(0x7fc0_bad1),
    half_height: POISON,
    width_growth: POISON,
    height_growth: POISON,
    lean: Turn(0x7fc0_bad1),
};

/// An index that was never written. No chunk has as many vertices as this.
pub(crate) const POISONED_INDEX: u32 = u32::MAX;

/// Whether `value` is poison.
pub(crate) fn is_poison(value: f32) -> bool {
    value.to_bits() == POISON.to_bits()
}
