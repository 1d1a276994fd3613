//! Distances between yarns by brute force. Only pairs that are far apart are skipped.

#![allow(dead_code, reason = "no test needs all of it")]
#![allow(clippy::unwrap_used, reason = "a test ends at what it did not expect")]

use glam::{DVec2, DVec3};
use texere_core::definitions::Segment;
use texere_core::{ControlPoint, Section, Yarns};

/// The spline at one place of a yarn.
#[derive(Clone, Copy)]
pub(crate) struct Place {
    pub(crate) centre: DVec3,
    pub(crate) tangent: DVec3,
    /// Half width and half height.
    pub(crate) halves: DVec2,
}

impl Place {
    /// The upright frame: side = z × t, up = t × side.
    fn frame(&self) -> (DVec3, DVec3) {
        let side = DVec3::Z.cross(self.tangent).normalize();
        (side, self.tangent.cross(side))
    }
}

/// The samples of one control interval, and a ball around them.
pub(crate) struct Stretch {
    pub(crate) yarn: usize,
    pub(crate) places: Vec<Place>,
    segment: Segment,
    middle: DVec3,
    reach: f64,
}

/// All control intervals of all yarns, in `samples` steps each.
pub(crate) fn stretches(yarns: &Yarns, samples: usize) -> Vec<Stretch> {
    let mut stretches = Vec::new();
    for (yarn, what) in yarns.layout().yarns().iter().enumerate() {
        let inner = yarns.yarn_points(yarn).unwrap();
        let count = inner.len();
        let mut points: Vec<ControlPoint> = inner.to_vec();
        if what.closed {
            points.insert(0, inner[count - 1]);
            points.extend(&inner[..2]);
        } else {
            points.insert(0, inner[0].reflected(&inner[1]));
            points.push(inner[count - 1].reflected(&inner[count - 2]));
        }
        for window in points.windows(4) {
            let segment = Segment::new(window.try_into().unwrap(), 0.5);
            let places: Vec<_> = (0..=samples)
                .map(|k| {
                    let sample = segment.sample(k as f32 / samples as f32);
                    Place {
                        centre: sample.centre.as_dvec3(),
                        tangent: sample.tangent.as_dvec3().normalize(),
                        halves: DVec2::new(sample.half_width.into(), sample.half_height.into()),
                    }
                })
                .collect();
            let middle = places[samples / 2].centre;
            let reach = places.iter().map(|place| place.centre.distance(middle)).fold(0.0, f64::max);
            stretches.push(Stretch { yarn, places, segment, middle, reach });
        }
    }
    stretches
}

fn near<'a>(
    stretches: &'a [Stretch],
    within: f64,
) -> impl Iterator<Item = (&'a Stretch, &'a Stretch)> + use<'a> {
    stretches.iter().enumerate().flat_map(move |(number, one)| {
        let others = stretches[number + 1..].iter().filter(move |other| other.yarn != one.yarn);
        others
            .filter(move |other| one.middle.distance(other.middle) < one.reach + other.reach + within)
            .map(move |other| (one, other))
    })
}

/// The least distance between the centrelines of two round yarns over the sum of their radii; 2 at
/// most.
pub(crate) fn round_clearance(yarns: &Yarns, samples: usize) -> f64 {
    let thickest = yarns
        .points()
        .iter()
        .fold(0.0f32, |most, point| most.max(point.half_width()).max(point.half_height()));
    let mut least = 2.0f64;
    let stretches = stretches(yarns, samples);
    for (one, other) in near(&stretches, 4.0 * f64::from(thickest)) {
        for a in &one.places {
            for b in &other.places {
                least = least.min(a.centre.distance(b.centre) / (a.halves.x + b.halves.x));
            }
        }
    }
    least
}

/// [`round_clearance`], refined: for each pair of intervals, the nearest samples are moved to the
/// place where the intervals are nearest.
pub(crate) fn refined_clearance(yarns: &Yarns, samples: usize) -> f64 {
    let thickest = yarns
        .points()
        .iter()
        .fold(0.0f32, |most, point| most.max(point.half_width()).max(point.half_height()));
    let stretches = stretches(yarns, samples);
    let ratio = |one: &Stretch, other: &Stretch, [s, t]: [f64; 2]| {
        let [a, b] = [(one, s), (other, t)].map(|(stretch, at)| stretch.segment.sample(at as f32));
        let apart = a.centre.as_dvec3().distance(b.centre.as_dvec3());
        apart / (f64::from(a.half_width) + f64::from(b.half_width))
    };
    let mut least = 2.0f64;
    for (one, other) in near(&stretches, 4.0 * f64::from(thickest)) {
        let mut best = (f64::INFINITY, [0.0; 2]);
        for (i, a) in one.places.iter().enumerate() {
            for (j, b) in other.places.iter().enumerate() {
                let found = a.centre.distance(b.centre) / (a.halves.x + b.halves.x);
                if found < best.0 {
                    best = (found, [i, j].map(|k| k as f64 / samples as f64));
                }
            }
        }
        // Compass search: the places move to the best of the places around them, in smaller and
        // smaller steps.
        let mut step = 1.0 / samples as f64;
        while best.0 < 2.0 && step > 1e-6 {
            let before = best.0;
            let [s, t] = best.1;
            for (along, across) in [(1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (-1, -1), (1, -1), (-1, 1)] {
                let place =
                    [(s, along), (t, across)].map(|(at, way)| (at + step * f64::from(way)).clamp(0.0, 1.0));
                let found = ratio(one, other, place);
                if found < best.0 {
                    best = (found, place);
                }
            }
            if best.0 == before {
                step /= 2.0;
            }
        }
        least = least.min(best.0);
    }
    least
}

/// Whether any two yarns pierce one another when their sections are scaled by `scale`: whether a
/// point of one surface lies inside the other yarn. Intervals have `samples` steps, and sections
/// have `sides` points.
pub(crate) fn pierce(yarns: &Yarns, samples: usize, sides: u32, scale: f64) -> bool {
    let sections = yarns.layout().sections();
    let outlines: Vec<Vec<DVec2>> = sections
        .iter()
        .map(|section| {
            section
                .outline(sides)
                .iter()
                .map(|p| DVec2::new(f64::from(p.x), f64::from(p.y)) * scale)
                .collect()
        })
        .collect();
    let outline = |yarn: usize| &outlines[yarns.layout().yarns()[yarn].section as usize];
    let widest = outlines.iter().flatten().map(|point| point.length()).fold(0.0, f64::max);
    let thickest = yarns
        .points()
        .iter()
        .fold(0.0f32, |most, point| most.max(point.half_width()).max(point.half_height()));
    let stretches = stretches(yarns, samples);
    near(&stretches, 2.0 * widest * f64::from(thickest)).any(|(one, other)| {
        [(one, other), (other, one)].into_iter().any(|(surface, body)| {
            surface.places.iter().any(|place| {
                let (side, up) = place.frame();
                outline(surface.yarn).iter().any(|point| {
                    let point = *point * place.halves;
                    let point = place.centre + point.x * side + point.y * up;
                    body.places.windows(2).any(|pair| inside(point, pair, outline(body.yarn)))
                })
            })
        })
    })
}

/// Whether `point` lies inside a tube between two of its places.
fn inside(point: DVec3, pair: &[Place], outline: &[DVec2]) -> bool {
    let along = [0, 1].map(|k| (point - pair[k].centre).dot(pair[k].tangent));
    if along[0] < 0.0 || along[1] > 0.0 {
        return false;
    }
    let share = along[0] / (along[0] - along[1]).max(1e-12);
    let centre = pair[0].centre.lerp(pair[1].centre, share);
    let tangent = pair[0].tangent.lerp(pair[1].tangent, share);
    let place = Place { centre, tangent, halves: pair[0].halves.lerp(pair[1].halves, share) };
    let (side, up) = place.frame();
    let offset = point - centre;
    let at = DVec2::new(offset.dot(side), offset.dot(up)) / place.halves;
    // Outlines are convex: a point inside lies to the left of every edge.
    outline.iter().zip(outline.iter().cycle().skip(1)).all(|(a, b)| (*b - *a).perp_dot(at - *a) > 0.0)
}

/// The scale of all sections at which the first two yarns touch, to 1/256 of the range from `low`
/// to `high`.
pub(crate) fn surface_clearance(
    yarns: &Yarns,
    samples: usize,
    sides: u32,
    [mut low, mut high]: [f64; 2],
) -> f64 {
    for _ in 0..8 {
        let middle = f64::midpoint(low, high);
        if pierce(yarns, samples, sides, middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    low
}

/// An elliptical section with this width over height.
pub(crate) fn ellipse(aspect: f32) -> Section {
    Section::Ellipse { aspect }
}
