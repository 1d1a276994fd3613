//! The search: which intervals meet in a cell, and where two of them come nearest to one another.

use std::cell::OnceCell;
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2};
use std::ops::Range;

use glam::{DVec2, DVec3, UVec3};
use texere_core::Yarns;

use super::approach::{Side, refine};
use super::found::Found;
use super::grid::{Bounds, Grid};
use super::interval::{Chords, Cubic, Intervals, SAGITTA, Span, closest};
use super::passing::Passing;
use super::support::Support;
use super::{CLEARANCE_NEAR, Contact, YarnPlace, curvature};

/// One interval in a cell.
struct Part {
    point: usize,
    yarn: usize,
    bounds: Bounds,
    /// The first cell that its box reaches into.
    cell: UVec3,
    curve: OnceCell<Curve>,
}

/// What is worked out of an interval once it meets another.
struct Curve {
    cubic: Cubic,
    passing: Passing,
    /// How far its surface may lie from the centreline, mm.
    reach: f64,
    chords: OnceCell<Chords>,
}

/// The yarns, and how far their sections reach.
pub(super) struct Probe<'a> {
    intervals: Intervals<'a>,
    supports: Vec<Support>,
}

impl<'a> Probe<'a> {
    pub(super) fn new(yarns: &'a Yarns, tension: f32) -> Self {
        Self {
            intervals: Intervals::new(yarns, tension),
            supports: yarns.layout().sections().iter().map(Support::new).collect(),
        }
    }

    /// All intervals in order, `most` at a time at most.
    pub(super) fn spans(&self, most: usize) -> Vec<Span> {
        self.intervals.spans(most)
    }

    /// The boxes that hold what lies within [`CLEARANCE_NEAR`] of each interval's centreline.
    pub(super) fn boxes(&self, span: &Span) -> impl Iterator<Item = (usize, Bounds)> + use<'_, 'a> {
        let (yarn, margin) = (span.yarn, self.margin(span.yarn));
        span.points.clone().map(move |point| (point, self.intervals.bounds(yarn, point, margin)))
    }

    fn support(&self, yarn: usize) -> &Support {
        &self.supports[self.intervals.yarns.layout().yarns()[yarn].section as usize]
    }

    /// Half of [`CLEARANCE_NEAR`] between two yarns alike, in radii.
    fn margin(&self, yarn: usize) -> f64 {
        CLEARANCE_NEAR * self.support(yarn).extent()
    }

    /// All contacts of intervals that meet in `cells`.
    pub(super) fn search(&self, grid: &Grid, cells: Range<usize>) -> Found {
        let mut found = Found::default();
        let (mut points, mut parts) = (Vec::new(), Vec::new());
        for cell in cells {
            points.clear();
            points.extend(grid.entries(cell));
            points.sort_unstable();
            parts.clear();
            let mut yarn = 0;
            parts.extend(points.iter().map(|&point| {
                yarn = self.intervals.yarn(point, yarn);
                let bounds = self.intervals.bounds(yarn, point, self.margin(yarn));
                Part { point, yarn, bounds, cell: grid.cell(bounds.low), curve: OnceCell::new() }
            }));
            for (second, other) in parts.iter().enumerate() {
                for one in &parts[..second] {
                    // Two may meet in several cells: where what they share begins they count.
                    if one.bounds.meets(&other.bounds) && grid.number(one.cell.max(other.cell)) == cell {
                        self.pair(one, other, &mut found);
                    }
                }
            }
        }
        found
    }

    fn curve<'p>(&self, part: &'p Part) -> &'p Curve {
        part.curve.get_or_init(|| {
            let cubic = self.intervals.cubic(part.yarn, part.point);
            let reach = cubic.radius_bound() * self.support(part.yarn).extent();
            Curve { passing: Passing::new(&cubic), reach, cubic, chords: OnceCell::new() }
        })
    }

    /// The contacts of two intervals, `one` before `other`.
    fn pair(&self, one: &Part, other: &Part, found: &mut Found) {
        let [a, b] = [one, other].map(|part| self.curve(part));
        if one.yarn == other.yarn && other.point - one.point < 2 && leads_on(&a.cubic, &b.cubic) {
            return;
        }
        let reach = a.reach + b.reach;
        let within = CLEARANCE_NEAR * reach;
        let [cut, other_cut] = [one, other].map(|part| self.cut(part));
        let supports = [one, other].map(|part| self.support(part.yarn));
        // Of round yarns of even radius the distance of the centrelines alone counts.
        let even = a.cubic.is_even() && b.cubic.is_even();
        let round = supports.iter().all(|support| support.is_circle());
        if even
            && round
            && (a.passing.leaves_to_neighbours(&b.passing, cut, within)
                || b.passing.leaves_to_neighbours(&a.passing, other_cut, within))
        {
            return;
        }
        let straight = [a, b].map(|curve| [curve.cubic.position(0.0), curve.cubic.position(1.0)]);
        let bends = a.cubic.bend() + b.cubic.bend();
        if closest(straight[0], straight[1]).0 > (within + bends).powi(2) {
            return;
        }
        let [one_chords, other_chords] =
            [a, b].map(|curve| curve.chords.get_or_init(|| curve.cubic.chords()));
        let sides = [
            Side { cubic: &a.cubic, support: supports[0], cut },
            Side { cubic: &b.cubic, support: supports[1], cut: other_cut },
        ];
        // Chords may be further from one another than the curves are.
        let within = within + SAGITTA * reach;
        let mut seen: Vec<DVec2> = Vec::new();
        one_chords.approaches(other_chords, within, |s, t| {
            let Some((place, ratio)) = refine(sides[0], sides[1], DVec2::new(s, t)) else { return };
            let again = seen.iter().any(|other| (*other - place).abs().max_element() < 0.01);
            if ratio > CLEARANCE_NEAR || again || self.too_close(one, other, place) {
                return;
            }
            seen.push(place);
            found.add(ratio, || Contact {
                places: [self.place(one, place.x), self.place(other, place.y)],
                ratio,
            });
        });
    }

    /// Whether an interval begins, and whether it ends, where an open yarn is cut off.
    fn cut(&self, part: &Part) -> [bool; 2] {
        let (first, count, closed) = self.intervals.of(part.yarn);
        [!closed && part.point == first, !closed && part.point + 1 == first + count]
    }

    /// Whether two places of one yarn are so close along it that only a fold could make them meet.
    fn too_close(&self, one: &Part, other: &Part, place: DVec2) -> bool {
        if one.yarn != other.yarn {
            return false;
        }
        let (first, count, closed) = self.intervals.of(one.yarn);
        let points = self.intervals.yarns.yarn_points(one.yarn).unwrap_or(&[]);
        let [a, b] = [one, other].map(|part| &self.curve(part).cubic);
        let radii = a.at(place.x).radius[0] + b.at(place.y).radius[0];
        let window = FRAC_PI_2 * radii * self.support(one.yarn).extent();
        // Forward from `from` to `to`, by chords; given up as soon as it is far enough.
        let near = |from: &Part, s: f64, to: &Part, t: f64| {
            let mut left =
                window - self.curve(from).cubic.position(s).distance(self.curve(from).cubic.position(1.0));
            let mut at = (from.point - first + 1) % count.max(1);
            while left > 0.0 && at != to.point - first {
                let next = (at + 1) % points.len();
                left -= f64::from(points[at].position().distance(points[next].position()));
                if next == 0 && !closed {
                    return false;
                }
                at = next;
            }
            left > self.curve(to).cubic.position(0.0).distance(self.curve(to).cubic.position(t))
        };
        near(one, place.x, other, place.y) || (closed && near(other, place.y, one, place.x))
    }

    fn place(&self, part: &Part, t: f64) -> YarnPlace {
        self.place_of(part.yarn, part.point, &self.curve(part).cubic, t)
    }

    fn place_of(&self, yarn: usize, point: usize, cubic: &Cubic, t: f64) -> YarnPlace {
        let (first, count, closed) = self.intervals.of(yarn);
        let interval = point - first;
        let nearer = match (t < 0.5, closed && interval + 1 == count) {
            (true, _) => interval,
            (false, true) => 0,
            (false, false) => interval + 1,
        };
        let source = self.intervals.yarns.sources().and_then(|sources| sources.get(first + nearer)).copied();
        YarnPlace { yarn, interval, t, position: cubic.position(t).to_array(), source }
    }

    /// The tightest bend of the intervals of `span`.
    pub(super) fn tightest(&self, span: &Span) -> (f64, Option<YarnPlace>) {
        let support = self.support(span.yarn);
        let mut best = (f64::INFINITY, None);
        for point in span.points.clone() {
            let cubic = self.intervals.cubic(span.yarn, point);
            if let Some((ratio, t)) = curvature::tightest(&cubic, support, best.0) {
                best = (ratio, Some(self.place_of(span.yarn, point, &cubic, t)));
            }
        }
        best
    }
}

/// Whether an interval and the next one of its yarn lead on so straight that they meet at their common knot alone.
fn leads_on(one: &Cubic, other: &Cubic) -> bool {
    let forward = (other.position(1.0) - one.position(0.0)).normalize_or_zero();
    // Within 45 degrees of one direction, so that any two of its steps add up and none leads back.
    let onward = |step: &DVec3| step.dot(forward) >= FRAC_1_SQRT_2 * step.length();
    one.velocities().iter().chain(&other.velocities()).all(onward)
}
