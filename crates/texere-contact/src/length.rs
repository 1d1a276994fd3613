//! Lengths of yarns: the arc length of the spline.

use std::ops::Range;

use rayon::prelude::*;
use texere_core::definitions::{neighbours, tangent_factor};
use texere_core::{ControlPoint, Yarns};

/// Distances from the middle and weights of the ten-point Gauss-Legendre rule on \[0, 1\], whose
/// points lie in pairs (Abramowitz and Stegun, table 25.4).
///
/// The speed of a crimped yarn is far from a polynomial where the yarn turns. On yarns of dense
/// plain cloth, a rule of five points is off by 6e-5 at tension 0 and by 4e-4 at tension 0.8. A
/// rule of ten points is off by 5e-8 and 1.4e-5.
const RULE: [(f64, f64); 5] = [
    (0.074_437_169_490_815_61, 0.147_762_112_357_376_4),
    (0.216_697_697_064_623_6, 0.134_633_359_654_998_26),
    (0.339_704_784_149_512_2, 0.109_543_181_257_991),
    (0.432_531_683_344_492_27, 0.074_725_674_575_290_2),
    (0.486_953_264_258_585_87, 0.033_335_672_154_344_07),
];

/// Number of intervals that one task adds up, in a fraction of a millisecond. The order of
/// summation is fixed, so that the result does not depend on the number of threads.
const TASK: usize = 4096;

/// Length of each yarn, mm, in the yarns' order.
///
/// ```
/// use texere_core::{ControlPoint, Yarn, Yarns};
/// let mut yarns = Yarns::builder();
/// yarns.yarn(Yarn::default(), &[0.0, 1.0, 3.0].map(|x| ControlPoint::new(x, 4.0, 0.0, 0.1)));
/// let lengths = texere_contact::lengths_mm(&yarns.build()?);
/// assert!((lengths[0] - 3.0).abs() < 1e-12);
/// # Ok::<(), texere_core::YarnError>(())
/// ```
#[must_use]
pub fn lengths_mm(yarns: &Yarns) -> Vec<f64> {
    let s = tangent_factor(yarns.tension());
    let layout = yarns.layout();
    (0..layout.yarns().len())
        .into_par_iter()
        .map(|yarn| yarn_length(yarns.yarn_points(yarn).unwrap_or(&[]), layout.yarns()[yarn].closed, s))
        .collect()
}

/// Length of all yarns together, mm: the sum of [`lengths_mm`].
#[must_use]
pub fn length_mm(yarns: &Yarns) -> f64 {
    lengths_mm(yarns).iter().sum()
}

/// Length of one round of a yarn that repeats, mm: through its control points and on to the first
/// point of the next round. The next round lies `shift` (x and y, mm) further on.
pub fn round_length_mm(points: &[ControlPoint], shift: [f64; 2], tension: f32) -> f64 {
    let s = tangent_factor(tension);
    let count = points.len() as isize;
    let at = |number: isize| {
        let [x, y, z] = position(points[number.rem_euclid(count) as usize]);
        let rounds = number.div_euclid(count) as f64;
        [x + rounds * shift[0], y + rounds * shift[1], z]
    };
    (0..count).map(|first| interval_length([-1, 0, 1, 2].map(|step| at(first + step)), s)).sum()
}

/// Length of a part of an open yarn, mm: the intervals between the control points of the range
/// `part`. The curve at the ends of the range also depends on the control points beside the range.
pub fn part_length_mm(points: &[ControlPoint], part: Range<usize>, tension: f32) -> f64 {
    let s = tangent_factor(tension);
    let last = part.end.min(points.len()).saturating_sub(1);
    (part.start..last).map(|first| interval_length(neighbours(points, false, first).map(position), s)).sum()
}

fn position(point: ControlPoint) -> [f64; 3] {
    point.position().to_array().map(f64::from)
}

fn yarn_length(points: &[ControlPoint], closed: bool, s: f64) -> f64 {
    let count = points.len();
    let intervals = if closed { count } else { count.saturating_sub(1) };
    let sums: Vec<f64> = (0..intervals.div_ceil(TASK))
        .into_par_iter()
        .map(|task| {
            let interval = |first| interval_length(neighbours(points, closed, first).map(position), s);
            (task * TASK..intervals.min((task + 1) * TASK)).map(interval).sum()
        })
        .collect();
    sums.iter().sum()
}

/// Integral of the speed over one interval of the cardinal spline.
fn interval_length([before, start, end, after]: [[f64; 3]; 4], s: f64) -> f64 {
    // Velocity c1 + c2 t + c3 t², from differences to the interval's start.
    let terms: [[f64; 3]; 3] = std::array::from_fn(|k| {
        let (a, b, c) = (before[k] - start[k], end[k] - start[k], after[k] - start[k]);
        [
            (b - a) * s,
            2.0 * (a * (2.0 * s) + b * (3.0 - 2.0 * s) - c * s),
            3.0 * ((c - a) * s + b * (s - 2.0)),
        ]
    });
    let speed = |t: f64| {
        let [x, y, z] = terms.map(|[c1, c2, c3]| c1 + (c2 + c3 * t) * t);
        (x * x + y * y + z * z).sqrt()
    };
    RULE.iter().map(|&(aside, weight)| weight * (speed(0.5 - aside) + speed(0.5 + aside))).sum()
}
