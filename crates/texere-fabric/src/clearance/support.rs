//! How far a section reaches in each direction.

use glam::{DVec2, DVec3};
use texere_core::Section;

/// Directions in which a section that is no circle is measured: between two of them its reach is off by 2e-5.
const DIRECTIONS: usize = 512;

/// A section's support function: the furthest point of its outline (of its hull, where it is not convex) in any
/// direction, in radii of the yarn.
#[derive(Debug, Clone)]
pub(super) enum Support {
    Circle,
    Table { furthest: Vec<DVec2>, extent: f64, area: f64 },
}

impl Support {
    pub(super) fn new(section: &Section) -> Self {
        if *section == Section::Circle {
            return Self::Circle;
        }
        let outline: Vec<DVec2> = section
            .outline(DIRECTIONS as u32)
            .iter()
            .map(|point| DVec2::new(f64::from(point.x), f64::from(point.y)))
            .collect();
        let furthest = (0..DIRECTIONS).map(|k| {
            let direction = DVec2::from_angle(k as f64 / DIRECTIONS as f64 * std::f64::consts::TAU);
            outline
                .iter()
                .copied()
                .max_by(|a, b| a.dot(direction).total_cmp(&b.dot(direction)))
                .unwrap_or_default()
        });
        let extent = outline.iter().map(|point| point.length()).fold(0.0, f64::max);
        let next = outline.iter().cycle().skip(1);
        let area = outline.iter().zip(next).map(|(point, next)| point.perp_dot(*next) / 2.0).sum();
        Self::Table { furthest: furthest.collect(), extent, area }
    }

    pub(super) const fn is_circle(&self) -> bool {
        matches!(self, Self::Circle)
    }

    /// The furthest that the section reaches in any direction.
    pub(super) const fn extent(&self) -> f64 {
        match self {
            Self::Circle => 1.0,
            Self::Table { extent, .. } => *extent,
        }
    }

    /// The section's area, in squared radii of the yarn.
    pub(super) const fn area(&self) -> f64 {
        match self {
            Self::Circle => std::f64::consts::PI,
            Self::Table { area, .. } => *area,
        }
    }

    /// The section's furthest point in `direction` where a yarn has the upright frame `[side, up]` and half width and half
    /// height `sizes`: from the centre, mm.
    pub(super) fn furthest(&self, [side, up]: [DVec3; 2], sizes: DVec2, direction: DVec3) -> DVec3 {
        // What flattening does to the points it does to directions the other way round.
        let across = DVec2::new(direction.dot(side), direction.dot(up)) * sizes;
        let point = match self {
            Self::Circle => across.normalize_or_zero(),
            Self::Table { furthest, .. } => {
                let turns = across.to_angle() / std::f64::consts::TAU;
                let nearest = (turns.rem_euclid(1.0) * DIRECTIONS as f64).round() as usize % DIRECTIONS;
                furthest[nearest]
            }
        };
        side * (point.x * sizes.x) + up * (point.y * sizes.y)
    }
}

/// The frame in which a section stands upright: side = z × t, and up.
pub(super) fn upright(tangent: DVec3) -> [DVec3; 2] {
    let side = DVec3::Z.cross(tangent);
    // Where the tangent is within 1e-6 of z, the side is +y.
    let side = if side.length_squared() > 1e-12 { side.normalize() } else { DVec3::Y };
    [side, tangent.cross(side)]
}
