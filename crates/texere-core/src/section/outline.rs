//! Outlines of sections, point by point.

use super::{PLIES, Section, SectionPoint};
use crate::definitions::Turn;
use crate::turn::atan2_turns;

/// The least distance of the valley between two plies from the axis, as a share of the distance to
/// which a ply reaches.
///
/// Two round plies that just touch leave a valley down to the axis. Real plies press flat against
/// each other, and their loose fibres fill the rest. With half the value, `a_ply_lies_in_a_furrow`
/// is red; with twice, `a_carried_frame_does_not_flip_between_rings`.
pub(super) const VALLEY: f32 = 0.5;

/// Number of points at which the extent and the area of a section are measured. A polygon of 1,024
/// sides lacks 6e-6 of a circle's area.
const MEASURE_POINTS: u32 = 1024;

/// Sine and cosine of `k / count` of a turn.
fn sin_cos_at(k: u32, count: u32) -> (f32, f32) {
    Turn(((u64::from(k) << 32) / u64::from(count)) as u32).sin_cos()
}

impl Section {
    /// The outline of plies that are twisted together, and that nothing presses. The plies are
    /// round and touch, but the valleys between them are no deeper than half way to the axis.
    ///
    /// ```
    /// use texere_core::Section;
    /// assert_eq!(Section::plied(2), Section::Lobed { plies: 2, valley: 0.5 });
    /// // Six round plies leave shallower valleys than two.
    /// let reach = |plies| Section::plied(plies).half_width();
    /// assert!(reach(2) > 1.29 && reach(6) < 1.25);
    /// ```
    #[must_use]
    pub fn plied(plies: u32) -> Self {
        // Two touching round plies whose centres lie `c` from the axis have a valley at c cos(π /
        // plies).
        let (half_sin, half_cos) = sin_cos_at(1, 2 * plies.clamp(PLIES[0], PLIES[1]));
        Self::Lobed { plies, valley: (half_cos / (1.0 + half_sin)).max(VALLEY) }
    }

    /// The outline as `sides` points, counter-clockwise seen against the tangent.
    ///
    /// The outline of a polygon consists of its corners, whatever `sides` is. A plan refuses a
    /// polygon whose number of corners differs from its sides.
    #[must_use]
    pub fn outline(&self, sides: u32) -> Vec<SectionPoint> {
        if let Self::Polygon(corners) = self {
            return polygon(corners);
        }
        let shape = |count: u32| (0..count).map(move |k| point(self, k, count));
        // For equal area, the bare shape is scaled by the square root of π over its area.
        let scale = match self {
            Self::Circle | Self::Ellipse { .. } => 1.0,
            _ => (std::f32::consts::PI / area(shape(MEASURE_POINTS))).sqrt(),
        };
        shape(sides).map(|bare| SectionPoint { x: bare.x * scale, y: bare.y * scale, ..bare }).collect()
    }

    /// Half the width, in radii of the yarn.
    #[must_use]
    pub fn half_width(&self) -> f32 {
        self.outline(MEASURE_POINTS).iter().fold(0.0, |most, point| point.x.abs().max(most))
    }

    /// Half the height, in radii of the yarn. Crossing yarns need this much room.
    #[must_use]
    pub fn half_height(&self) -> f32 {
        self.outline(MEASURE_POINTS).iter().fold(0.0, |most, point| point.y.abs().max(most))
    }
}

/// Point `k` of `count` of a shape, before its area is scaled to that of the unit circle.
fn point(section: &Section, k: u32, count: u32) -> SectionPoint {
    let (sin, cos) = sin_cos_at(k, count);
    match *section {
        Section::Circle => SectionPoint { x: cos, y: sin, normal_x: cos, normal_y: sin },
        Section::Ellipse { aspect } => {
            let (width, height) = (aspect.sqrt(), 1.0 / aspect.sqrt());
            with_normal(width * cos, height * sin, height * cos, width * sin)
        }
        Section::PowerEllipse { aspect, exponent } => {
            let (width, height) = (aspect, 1.0);
            // Within a millionth of an edge the outline's tangent counts as vertical.
            if sin.abs() < 1e-6 {
                return with_normal(width * cos, 0.0, cos, 0.0);
            }
            let rise = sin.abs().powf(exponent);
            let steepness = height * exponent * rise / sin.abs();
            with_normal(width * cos, height * rise.copysign(sin), steepness * cos, width * sin)
        }
        Section::Lenticular { aspect, distortion } => lens(aspect, distortion, k, count),
        Section::Lobed { plies, valley } => lobed(plies, valley, k, count),
        Section::Polygon(_) => SectionPoint::default(),
    }
}

/// Point `k` of `count` of two arcs from edge to edge. The first half of the points lies on the
/// upper arc, and the second on the lower.
fn lens(aspect: f32, distortion: f32, k: u32, count: u32) -> SectionPoint {
    let half_width = aspect;
    let along = (2 * k) as f32 / count as f32;
    // At the edges, where the two arcs meet, the normal points straight out.
    if k == 0 {
        return with_normal(half_width, distortion, 1.0, 0.0);
    }
    if 2 * k == count {
        return with_normal(-half_width, distortion, -1.0, 0.0);
    }
    let (up, along) = if along < 1.0 { (1.0, along) } else { (-1.0, 2.0 - along) };
    let rise = 1.0 - up * distortion;
    let radius = (half_width * half_width + rise * rise) / (2.0 * rise);
    let half_angle = atan2_turns(half_width, radius - rise);
    let (sin, cos) = Turn::from_turns(half_angle * (1.0 - 2.0 * along)).sin_cos();
    with_normal(radius * sin, distortion + up * (radius * cos - (radius - rise)), sin, up * cos)
}

/// Point `k` of `count` of the curve with the radius `1 - depth (1 - cos(plies θ))`. The curve
/// touches the unit circle at each ply, and reaches the valley between two plies.
fn lobed(plies: u32, valley: f32, k: u32, count: u32) -> SectionPoint {
    let (sin, cos) = sin_cos_at(k, count);
    let turn = ((u64::from(k) << 32) / u64::from(count)) as u32;
    let (lobe_sin, lobe_cos) = Turn(turn.wrapping_mul(plies)).sin_cos();
    let depth = (1.0 - valley) / 2.0;
    let distance = 1.0 - depth * (1.0 - lobe_cos);
    let change = -depth * plies as f32 * lobe_sin;
    with_normal(distance * cos, distance * sin, distance * cos + change * sin, distance * sin - change * cos)
}

/// A point with a normal that is given with any length.
fn with_normal(x: f32, y: f32, normal_x: f32, normal_y: f32) -> SectionPoint {
    let inverse = 1.0 / (normal_x * normal_x + normal_y * normal_y).sqrt();
    SectionPoint { x, y, normal_x: normal_x * inverse, normal_y: normal_y * inverse }
}

/// The area inside an outline, by the shoelace formula.
fn area(outline: impl Iterator<Item = SectionPoint>) -> f32 {
    let points: Vec<_> = outline.map(|point| [point.x, point.y]).collect();
    (doubled_area(&points) / 2.0) as f32
}

/// Twice the signed area of a polygon, positive if the corners run counter-clockwise.
pub(super) fn doubled_area(corners: &[[f32; 2]]) -> f64 {
    corners.iter().zip(corners.iter().cycle().skip(1)).map(|(a, b)| cross(*a, *b)).sum()
}

pub(super) fn cross(a: [f32; 2], b: [f32; 2]) -> f64 {
    f64::from(a[0]) * f64::from(b[1]) - f64::from(a[1]) * f64::from(b[0])
}

fn polygon(corners: &[[f32; 2]]) -> Vec<SectionPoint> {
    let count = corners.len();
    (0..count)
        .map(|k| {
            let [before, here, after] = [k + count - 1, k, k + 1].map(|corner| corners[corner % count]);
            // The normal has the direction of the sum of the outward normals of both edges at this
            // corner.
            let edge = |from: [f32; 2], to: [f32; 2]| {
                let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
                let inverse = 1.0 / (dx * dx + dy * dy).sqrt();
                (dy * inverse, -dx * inverse)
            };
            let ((ax, ay), (bx, by)) = (edge(before, here), edge(here, after));
            with_normal(here[0], here[1], ax + bx, ay + by)
        })
        .collect()
}
