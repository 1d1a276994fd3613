//! A test on control points that finds stretches of yarn along which the frame turns no section
//! from one ring to the next.
//!
//! Most woven threads keep to a plane of constant x, or of constant y, and never turn back in it.
//! The sides of their frames then lie along the x axis, or along the y axis, and the products of
//! sides with chords and tangents are zero. The turn of a rotation minimising frame from ring to
//! ring is therefore zero to the bit.

use texere_core::definitions::NO_LENGTH;

use super::rings::{Source, Stretch};
use super::simd::{Floats, Mask, Simd, difference};
use super::spline::{neighbours, xyz};

/// The least velocity along x or y that counts as going on, as a share of the interval's extent.
/// The extent is the sum, over all axes, of the distances from the interval's start to the three
/// other points. The share is far above the rounding of velocities (some 1e-5), at which a yarn
/// could seem to turn back. It is also far above what counts as standing still or as vertical
/// (1e-6), where frames have rules of their own.
const ONWARD: f32 = 1e-3;

/// The largest extent that is tested, mm. Its square is well within the range of `f32`.
const EXTENT_MAX: f32 = 1e15;

/// Whether the test shows that the frame adds nothing to any turn between the rings of `stretch`.
/// The test does not regard twist.
#[cfg_attr(optimized, inline(always))]
pub(super) fn stays_upright<S: Simd>(simd: S, source: &Source<'_>, stretch: Stretch) -> bool {
    let (plan, points) = (source.plan, source.yarn(stretch.yarn));
    let per_interval = plan.settings().subdivisions + 1;
    let intervals = (plan.rings(stretch.yarn) - 1) / per_interval;
    // An open yarn's last ring belongs to the interval that it ends. A closed yarn's last ring lies
    // where one more interval begins, a copy of the first.
    let last = if plan.yarn(stretch.yarn).closed { intervals } else { intervals - 1 };
    let end = ((stretch.first + stretch.count - 1) / per_interval).min(last) + 1;
    let mut first = stretch.first / per_interval;
    let mut ways = [S::ALL; 4];
    while first < end {
        // Lanes past the end do not count.
        let past = S::ALL << (end - first).min(S::LANES as u32);
        for (way, here) in ways.iter_mut().zip(ways_on(simd, points, first as usize, plan.sampling().s())) {
            *way &= here | past;
        }
        if ways.iter().all(|way| *way != S::ALL) {
            return false;
        }
        first += S::LANES as u32;
    }
    true
}

/// Four masks of the `LANES` intervals from number `first` on: those that go forwards in x at
/// constant y, backwards in x at constant y, forwards in y at constant x, and backwards in y at
/// constant x.
///
/// A cubic's velocity lies between the three values of its Bézier form. The outer two are the
/// velocities at the ends.
#[cfg_attr(optimized, inline(always))]
fn ways_on<S: Simd>(simd: S, points: &[[f32; 4]], first: usize, s: f32) -> [u32; 4] {
    let [before, start, end, after] = neighbours(simd, points, first);
    let (before, start, end, after) = (xyz(before), xyz(start), xyz(end), xyz(after));
    let (a, b, c) = (difference(before, start), difference(end, start), difference(after, start));
    let (s, mut spread, mut ways) = (simd.splat(s), [simd.splat(0.0); 3], [0; 4]);
    for axis in 0..3 {
        spread[axis] = a[axis].abs() + b[axis].abs() + c[axis].abs();
    }
    let extent = spread[0] + spread[1] + spread[2];
    let sound = extent.less(simd.splat(EXTENT_MAX)).bits();
    let least = (extent * simd.splat(ONWARD)).max(simd.splat(10.0 * NO_LENGTH.sqrt()));
    // No closures here: they would not be compiled for the instructions of `simd`.
    for (axis, across) in [(0, 1), (1, 0)] {
        let (at_start, at_end) = ((b[axis] - a[axis]) * s, c[axis] * s);
        let between = b[axis] * simd.splat(3.0) - at_start - at_end;
        let low = at_start.min(at_end).min(between);
        let high = at_start.max(at_end).max(between);
        let flat = sound & spread[across].is_zero().bits();
        ways[2 * axis] = flat & least.less(low).bits();
        ways[2 * axis + 1] = flat & least.less(-high).bits();
    }
    ways
}
