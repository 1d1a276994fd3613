//! Outlines of sections in f64. A polygon keeps its corners. All other outlines are scaled to the
//! area of the unit circle, by closed forms or, for power ellipses, by an integral.

use std::f64::consts::{PI, TAU};

use texere_core::Section;

/// A point of an outline with its outward unit normal, in radii of the yarn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutlinePoint {
    /// Position along the section's side.
    pub x: f64,
    /// Position along the section's up.
    pub y: f64,
    /// Normal along the side.
    pub normal_x: f64,
    /// Normal along up.
    pub normal_y: f64,
}

impl OutlinePoint {
    /// A point from a normal of any length.
    fn new(x: f64, y: f64, normal_x: f64, normal_y: f64) -> Self {
        let length = normal_x.hypot(normal_y);
        Self { x, y, normal_x: normal_x / length, normal_y: normal_y / length }
    }

    fn scaled(self, scale: f64) -> Self {
        Self { x: self.x * scale, y: self.y * scale, ..self }
    }

    /// Distance from the yarn's axis.
    #[must_use]
    pub fn distance(&self) -> f64 {
        self.x.hypot(self.y)
    }
}

/// The outline of `section` as `sides` points, counter-clockwise.
///
/// # Panics
///
/// For a kind of section that the oracle does not have.
#[must_use]
pub fn outline(section: &Section, sides: u32) -> Vec<OutlinePoint> {
    let wide = |value: f32| f64::from(value);
    let (area, shape): (f64, Box<dyn Fn(u32) -> OutlinePoint>) = match section {
        Section::Circle => (PI, Box::new(|k| ellipse(1.0, angle(k, sides)))),
        Section::Ellipse { aspect } => (PI, Box::new(|k| ellipse(wide(*aspect), angle(k, sides)))),
        Section::PowerEllipse { aspect, exponent } => (
            4.0 * wide(*aspect) * sine_power_integral(wide(*exponent) + 1.0),
            Box::new(|k| power_ellipse(wide(*aspect), wide(*exponent), angle(k, sides))),
        ),
        Section::Lenticular { aspect, distortion } => {
            let arcs = [1.0, -1.0].map(|up| Arc::new(wide(*aspect), wide(*distortion), up));
            (arcs[0].area() + arcs[1].area(), Box::new(move |k| lens(&arcs, k, sides)))
        }
        Section::Lobed { plies, valley } => {
            let depth = (1.0 - wide(*valley)) / 2.0;
            // The area is half the integral of the squared distance.
            let area = PI * ((1.0 - depth).powi(2) + depth * depth / 2.0);
            (area, Box::new(move |k| lobed(depth, wide(*plies as f32), angle(k, sides))))
        }
        Section::Polygon(corners) => return polygon(corners),
        unknown => panic!("the oracle does not know {unknown:?}"),
    };
    (0..sides).map(|k| shape(k).scaled((PI / area).sqrt())).collect()
}

fn angle(k: u32, sides: u32) -> f64 {
    TAU * f64::from(k) / f64::from(sides)
}

/// The point (√a cos θ, sin θ / √a) of an ellipse of aspect a.
fn ellipse(aspect: f64, angle: f64) -> OutlinePoint {
    let (width, height) = (aspect.sqrt(), 1.0 / aspect.sqrt());
    OutlinePoint::new(width * angle.cos(), height * angle.sin(), height * angle.cos(), width * angle.sin())
}

/// The point (a cos θ, ±|sin θ|ⁿ) of a power ellipse of aspect a and exponent n. The outline is
/// upright at its two edges.
fn power_ellipse(aspect: f64, exponent: f64, angle: f64) -> OutlinePoint {
    let (sin, cos) = angle.sin_cos();
    if sin.abs() < 1e-9 {
        return OutlinePoint::new(aspect * cos, 0.0, cos, 0.0);
    }
    // The normal is the outline's direction, turned back by a quarter.
    let (across, rise) = (-aspect * sin, exponent * sin.abs().powf(exponent - 1.0) * cos);
    OutlinePoint::new(aspect * cos, sin.signum() * sin.abs().powf(exponent), rise, -across)
}

/// The integral of sinᵖ from 0 to π/2, by the midpoint rule.
fn sine_power_integral(power: f64) -> f64 {
    const PANELS: u32 = 1 << 16;
    let width = PI / 2.0 / f64::from(PANELS);
    (0..PANELS).map(|panel| ((f64::from(panel) + 0.5) * width).sin().powf(power) * width).sum()
}

/// One of the two arcs of a lens, `up` or down, from edge to edge.
struct Arc {
    up: f64,
    edge_height: f64,
    radius: f64,
    /// The angle from the arc's top to its edge, seen from its centre.
    half_angle: f64,
}

impl Arc {
    /// One of the arcs of a lens, which is 2 `aspect` wide and 2 high. The edges of the lens lie
    /// `distortion` above the middle.
    fn new(aspect: f64, distortion: f64, up: f64) -> Self {
        let rise = 1.0 - up * distortion;
        let radius = (aspect * aspect + rise * rise) / (2.0 * rise);
        Self { up, edge_height: distortion, radius, half_angle: aspect.atan2(radius - rise) }
    }

    /// Area of the segment of the circle.
    fn area(&self) -> f64 {
        self.radius * self.radius * (self.half_angle - self.half_angle.sin() * self.half_angle.cos())
    }

    /// The point at `along`, from 0 at the right edge to 1 at the left.
    fn at(&self, along: f64) -> OutlinePoint {
        let (sin, cos) = (self.half_angle * (1.0 - 2.0 * along)).sin_cos();
        let height = self.radius * (cos - self.half_angle.cos());
        OutlinePoint::new(self.radius * sin, self.edge_height + self.up * height, sin, self.up * cos)
    }
}

/// Point `k` of a lens. The upper arc has the first half of the points, and the lower arc the
/// second half. Where both arcs meet, the normal points straight out.
fn lens([upper, lower]: &[Arc; 2], k: u32, sides: u32) -> OutlinePoint {
    let along = 2.0 * f64::from(k) / f64::from(sides);
    let point = if 2 * k < sides { upper.at(along) } else { lower.at(2.0 - along) };
    if k == 0 || 2 * k == sides {
        return OutlinePoint::new(point.x, upper.edge_height, point.x.signum(), 0.0);
    }
    point
}

/// The point at the angle θ of the outline of p plies. The point's distance from the axis is
/// `1 - depth (1 - cos pθ)`.
fn lobed(depth: f64, plies: f64, angle: f64) -> OutlinePoint {
    let distance = 1.0 - depth * (1.0 - (plies * angle).cos());
    let change = -depth * plies * (plies * angle).sin();
    let (sin, cos) = angle.sin_cos();
    // The normal is the outline's direction, turned back by a quarter.
    let direction = (change * cos - distance * sin, change * sin + distance * cos);
    OutlinePoint::new(distance * cos, distance * sin, direction.1, -direction.0)
}

/// The outline with the caller's corners. The normal of a corner halves the angle between the
/// normals of its edges.
fn polygon(corners: &[[f32; 2]]) -> Vec<OutlinePoint> {
    let count = corners.len();
    let at = |k: usize| corners[k % count].map(f64::from);
    let edge_normal = |k: usize| {
        let ([x, y], [next_x, next_y]) = (at(k), at(k + 1));
        let length = (next_x - x).hypot(next_y - y);
        [(next_y - y) / length, (x - next_x) / length]
    };
    (0..count)
        .map(|k| {
            let ([x, y], [ax, ay], [bx, by]) = (at(k), edge_normal(k + count - 1), edge_normal(k));
            OutlinePoint::new(x, y, ax + bx, ay + by)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shapes() -> Vec<Section> {
        let mut shapes = vec![Section::Circle];
        for aspect in [0.3, 1.0, 2.5] {
            shapes.push(Section::Ellipse { aspect });
            shapes.extend([0.4, 1.0, 2.0].map(|exponent| Section::PowerEllipse { aspect, exponent }));
            shapes.extend([-0.6, 0.0, 0.3].map(|distortion| Section::Lenticular { aspect, distortion }));
        }
        shapes.extend((2..=12).map(Section::plied));
        shapes.extend([0.5, 0.8, 1.0].map(|valley| Section::Lobed { plies: 3, valley }));
        shapes
    }

    /// If p round plies touch, the valley is at cos(π/p) / (1 + sin(π/p)) of a ply's outermost
    /// distance.
    #[test]
    fn plies_that_nothing_presses_are_round_and_touch() {
        for plies in 2..=12 {
            let part = PI / f64::from(plies);
            let valley = (part.cos() / (1.0 + part.sin())).max(0.5);
            let Section::Lobed { plies: same, valley: own } = Section::plied(plies) else {
                panic!("{plies} plies have no lobes");
            };
            assert!(
                same == plies && (f64::from(own) - valley).abs() < 1e-6,
                "{plies} plies: {own}, {valley}"
            );
        }
    }

    /// Compares the closed forms with polygons of many corners.
    #[test]
    fn every_outline_encloses_the_unit_circles_area() {
        for shape in shapes() {
            let points = outline(&shape, 20_000);
            let area: f64 = (0..points.len())
                .map(|k| {
                    let (a, b) = (&points[k], &points[(k + 1) % points.len()]);
                    (a.x * b.y - a.y * b.x) / 2.0
                })
                .sum();
            assert!((area - PI).abs() < 2e-5, "{shape:?} encloses {area}");
        }
    }

    /// Away from edges, a normal is at right angles to the line from the point before to the point
    /// after.
    #[test]
    fn normals_stand_across_the_outline() {
        for shape in shapes() {
            let points = outline(&shape, 20_000);
            let smooth = (1..points.len() - 1).filter(|k| k % 10_000 > 20 && k % 10_000 < 9_980);
            for k in smooth {
                let (a, b, at) = (&points[k - 1], &points[k + 1], &points[k]);
                let (x, y) = (b.x - a.x, b.y - a.y);
                let cosine = (x * at.normal_x + y * at.normal_y) / x.hypot(y);
                assert!(cosine.abs() < 1e-2, "{shape:?}, point {k}: {cosine}");
                assert!(y * at.normal_x - x * at.normal_y > 0.0, "{shape:?}, point {k} looks inward");
            }
        }
    }
}
