//! The energy of yarns by the formulas of `texere_core::relaxation`, in code of its own. Every pair
//! of samples is compared, in every copy of the repeat that may be near, and no lists of near
//! samples are kept.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};
use texere_core::Ends;
use texere_core::relaxation::{RelaxationPlan, RelaxationState};

/// A term that is wrong on purpose.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Broken {
    Nothing,
    /// Only the repeat itself counts, not its copies.
    LostImages,
    HalfBending,
    /// Shells attract one another.
    Attraction,
}

/// How many copies of the repeat, along either axis and to each side, samples are compared with.
const IMAGES: i32 = 5;

struct Sample {
    at: DVec3,
    yarn: usize,
    /// The place along the yarn at rest, and the length that the sample stands for, mm.
    along: f64,
    length: f64,
}

/// The energy of `state`, N mm, for yarns with the share `growth` of their thickness. `press` is
/// the stiffness that presses the cloth flat.
pub(crate) fn energy(
    plan: &RelaxationPlan,
    state: &RelaxationState,
    [growth, press]: [f64; 2],
    broken: Broken,
) -> f64 {
    let mut samples = Vec::new();
    let mut sum = 0.0;
    for interval in plan.intervals() {
        let (yarn, elastic) =
            (&plan.yarns()[interval.yarn as usize], &plan.elastic()[interval.yarn as usize]);
        let Ends::Repeats(shift) = yarn.ends else { panic!("yarns of a knit go on") };
        let point = |number: i64| {
            let round = number.div_euclid(yarn.points.into()) as f64;
            let own = number.rem_euclid(yarn.points.into()) as usize;
            let way = DVec2::new(f64::from(shift[0]), f64::from(shift[1])) * state.repeat * round;
            state.points[yarn.first as usize + own] + way.extend(0.0)
        };
        let [before, start, end, after] = [-1, 0, 1, 2].map(|slot| point(i64::from(interval.number) + slot));
        // Hermite's form: the tangent at a point is half of the way between its neighbours.
        let (from, to) = (0.5 * (end - before), 0.5 * (after - start));
        let curve = |u: f64| {
            let v = 1.0 - u;
            start * ((1.0 + 2.0 * u) * v * v) + from * (u * v * v) + end * (u * u * (3.0 - 2.0 * u))
                - to * (u * u * v)
        };
        let speed = |u: f64| {
            (end - start) * (6.0 * u * (1.0 - u))
                + from * (1.0 - 4.0 * u + 3.0 * u * u)
                + to * (3.0 * u * u - 2.0 * u)
        };
        let acceleration =
            |u: f64| (end - start) * (6.0 - 12.0 * u) + from * (6.0 * u - 4.0) + to * (6.0 * u - 2.0);
        let count = interval.samples;
        let each = interval.length / f64::from(count);
        for part in 0..count {
            let u = (f64::from(part) + 0.5) / f64::from(count);
            let curvature = speed(u).cross(acceleration(u)).length() / speed(u).length().powi(3);
            let bending =
                0.5 * elastic.bending * curvature * curvature * speed(u).length() / f64::from(count);
            sum += if broken == Broken::HalfBending { 0.5 * bending } else { bending };
            sum += 0.5 * press * each * curve(u).z.powi(2);
            let along = interval.along + (f64::from(part) + 0.5) * each;
            samples.push(Sample { at: curve(u), yarn: interval.yarn as usize, along, length: each });
        }
        let aside = 0.5 * 0.6_f64.sqrt();
        let arc = (5.0 * speed(0.5 - aside).length()
            + 8.0 * speed(0.5).length()
            + 5.0 * speed(0.5 + aside).length())
            / 18.0;
        sum += 0.5 * elastic.extension * interval.length * (arc / interval.length - 1.0).powi(2);
    }
    sum + contacts(plan, state, growth, broken, &samples)
}

fn contacts(
    plan: &RelaxationPlan,
    state: &RelaxationState,
    growth: f64,
    broken: Broken,
    samples: &[Sample],
) -> f64 {
    let images = if broken == Broken::LostImages { 0 } else { IMAGES };
    let mut sum = 0.0;
    for x in -images..=images {
        for y in -images..=images {
            let way = (DVec2::new(f64::from(x), f64::from(y)) * state.repeat).extend(0.0);
            for one in samples {
                for other in samples {
                    let [a, b] = [one, other].map(|sample| &plan.elastic()[sample.yarn]);
                    let distance = one.at.distance(other.at + way);
                    if distance >= growth * (a.shell + b.shell) {
                        continue;
                    }
                    let yarn = &plan.yarns()[one.yarn];
                    let Ends::Repeats(shift) = yarn.ends else { panic!("yarns of a knit go on") };
                    let rounds = (-9..=9).find(|rounds| [rounds * shift[0], rounds * shift[1]] == [x, y]);
                    if let (true, Some(rounds)) = (one.yarn == other.yarn, rounds) {
                        let along = other.along + f64::from(rounds) * yarn.length - one.along;
                        if along.abs() < PI * growth * a.shell {
                            continue;
                        }
                    }
                    let depth = growth * (a.shell + b.shell - a.core - b.core);
                    let y = (distance - growth * (a.core + b.core)) / depth;
                    assert!(y > 0.02, "cores of the cases are clear: {y}");
                    let stiffness = 2.0 / (1.0 / a.compression + 1.0 / b.compression);
                    let p = 2.4;
                    let value = y.powf(1.0 - p) - 1.0 - (1.0 - p) * (y - 1.0);
                    let energy = stiffness * depth * depth / (p * (p - 1.0)) * value;
                    let energy = if broken == Broken::Attraction { -energy } else { energy };
                    sum += 0.5 * energy * one.length * other.length;
                }
            }
        }
    }
    sum
}
