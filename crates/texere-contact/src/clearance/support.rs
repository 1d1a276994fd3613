//! Reach of a section in each direction, and its outline.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};
use texere_core::Section;

/// Number of directions in which a section that is not a circle is measured. Between two of them
/// the reach is off by 2e-5. With half the value, and with twice, no test is red.
const DIRECTIONS: usize = 512;

/// Number of angles at which a section's outline is measured. Between two of them the outline is
/// off by 1e-5, and by 1e-3 at a lens's two corners. With half the value, and with twice, no test
/// is red.
const ANGLES: usize = 2048;

/// A section's support function: the furthest point of its outline in any direction, in radii of
/// the yarn. If the outline is not convex, its hull counts.
#[derive(Debug, Clone)]
pub(super) enum Support {
    Circle,
    Table {
        furthest: Vec<DVec2>,
        /// Points of the outline, or the corners of a polygon.
        outline: Vec<DVec2>,
        /// Distance of the outline from the centre, angle by angle. Empty for a polygon, whose
        /// corners may be narrower than the steps.
        radii: Vec<f64>,
        smooth: bool,
        extent: f64,
        inner: f64,
        area: f64,
    },
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
            let direction = DVec2::from_angle(k as f64 / DIRECTIONS as f64 * TAU);
            outline
                .iter()
                .copied()
                .max_by(|a, b| a.dot(direction).total_cmp(&b.dot(direction)))
                .unwrap_or_default()
        });
        let extent = outline.iter().map(|point| point.length()).fold(0.0, f64::max);
        let next = outline.iter().cycle().skip(1);
        let area = outline.iter().zip(next).map(|(point, next)| point.perp_dot(*next) / 2.0).sum();
        let fine: Vec<DVec2> = section
            .outline(ANGLES as u32)
            .iter()
            .map(|point| DVec2::new(point.x.into(), point.y.into()))
            .collect();
        let smooth = matches!(section, Section::Ellipse { .. });
        let radii = if matches!(section, Section::Polygon(_)) { Vec::new() } else { radii(&fine) };
        let mut table = Self::Table {
            furthest: furthest.collect(),
            radii,
            outline: fine,
            smooth,
            extent,
            inner: 0.0,
            area,
        };
        let growths = (0..DIRECTIONS)
            .map(|k| table.growth_at(DVec2::from_angle(k as f64 / DIRECTIONS as f64 * TAU)))
            .fold(0.0, f64::max);
        if let Self::Table { inner, .. } = &mut table {
            *inner = 1.0 / growths;
        }
        table
    }

    /// Whether the outline has neither lobes nor corners.
    pub(super) const fn is_smooth(&self) -> bool {
        match self {
            Self::Circle => true,
            Self::Table { smooth, .. } => *smooth,
        }
    }

    /// Number of corners of a polygon, 0 for other sections.
    pub(super) fn corners(&self) -> usize {
        match self {
            Self::Table { radii, outline, .. } if radii.is_empty() => outline.len(),
            _ => 0,
        }
    }

    /// The point of the outline at `share` of the way round it.
    pub(super) fn point(&self, share: f64) -> DVec2 {
        match self {
            Self::Circle => DVec2::from_angle(share * TAU),
            Self::Table { outline, .. } => {
                let place = share.rem_euclid(1.0) * outline.len() as f64;
                let before = (place as usize).min(outline.len() - 1);
                outline[before].lerp(outline[(before + 1) % outline.len()], place - before as f64)
            }
        }
    }

    /// The factor by which the section grows until its outline meets `point`. If the ray from the
    /// centre through `point` meets the outline more than once, the outermost place counts.
    pub(super) fn growth_at(&self, point: DVec2) -> f64 {
        match self {
            Self::Circle => point.length(),
            Self::Table { radii, outline, .. } if radii.is_empty() => {
                let edges = outline.iter().zip(outline.iter().cycle().skip(1));
                let reach =
                    edges.filter_map(|(start, end)| along_ray(point, *start, *end)).fold(0.0, f64::max);
                1.0 / reach
            }
            Self::Table { radii, .. } => {
                let place = (point.to_angle() / TAU).rem_euclid(1.0) * ANGLES as f64;
                let before = (place as usize).min(ANGLES - 1);
                let share = place - before as f64;
                point.length() / (radii[before] * (1.0 - share) + radii[(before + 1) % ANGLES] * share)
            }
        }
    }

    pub(super) const fn is_circle(&self) -> bool {
        matches!(self, Self::Circle)
    }

    /// The section's greatest reach, over all directions.
    pub(super) const fn extent(&self) -> f64 {
        match self {
            Self::Circle => 1.0,
            Self::Table { extent, .. } => *extent,
        }
    }

    /// The outline's least distance from the centre.
    pub(super) const fn inner(&self) -> f64 {
        match self {
            Self::Circle => 1.0,
            Self::Table { inner, .. } => *inner,
        }
    }

    /// The section's area, in squared radii of the yarn.
    pub(super) const fn area(&self) -> f64 {
        match self {
            Self::Circle => std::f64::consts::PI,
            Self::Table { area, .. } => *area,
        }
    }

    /// The section's furthest point in `direction`, from the centre, mm. The yarn is flattened
    /// along `[side, up]`, to half width and half height `sizes`.
    pub(super) fn furthest(&self, [side, up]: [DVec3; 2], sizes: DVec2, direction: DVec3) -> DVec3 {
        // A point p of the section lies at side p.x sizes.x + up p.y sizes.y. Its reach in
        // `direction` is therefore the dot product of p and `across`.
        let across = DVec2::new(direction.dot(side), direction.dot(up)) * sizes;
        let point = match self {
            Self::Circle => across.normalize_or_zero(),
            Self::Table { furthest, .. } => {
                let turns = across.to_angle() / TAU;
                let nearest = (turns.rem_euclid(1.0) * DIRECTIONS as f64).round() as usize % DIRECTIONS;
                furthest[nearest]
            }
        };
        side * (point.x * sizes.x) + up * (point.y * sizes.y)
    }
}

/// Distance from the centre to the outermost place of an outline at each of [`ANGLES`] angles.
fn radii(outline: &[DVec2]) -> Vec<f64> {
    let mut radii = vec![0.0_f64; ANGLES];
    for k in 0..outline.len() {
        let (start, end) = (outline[k], outline[(k + 1) % outline.len()]);
        // The rays that the edge spans, whether it goes clockwise or not.
        let turn = start.angle_to(end);
        let (from, span) = (if turn < 0.0 { end } else { start }.to_angle(), turn.abs());
        let first = (from / TAU * ANGLES as f64).ceil() as i64;
        let last = ((from + span) / TAU * ANGLES as f64).floor() as i64;
        for ray in first..=last {
            let towards = DVec2::from_angle(ray as f64 / ANGLES as f64 * TAU);
            let (edge, across) = (end - start, towards.perp_dot(end - start));
            let reach = if across == 0.0 { start.length() } else { start.perp_dot(edge) / across };
            let radius = &mut radii[ray.rem_euclid(ANGLES as i64) as usize];
            *radius = radius.max(reach);
        }
    }
    radii
}

/// The multiple of `ray` at which an edge meets the ray, or none if it does not.
fn along_ray(ray: DVec2, start: DVec2, end: DVec2) -> Option<f64> {
    let (before, after) = (ray.perp_dot(start), ray.perp_dot(end));
    let crosses = (before <= 0.0) != (after <= 0.0);
    crosses.then(|| start.perp_dot(end - start) / ray.perp_dot(end - start)).filter(|along| *along > 0.0)
}

/// Side and up of the frame in which a section stands upright: side = z × t, up = t × side.
pub(super) fn upright(tangent: DVec3) -> [DVec3; 2] {
    let side = DVec3::Z.cross(tangent);
    // If the tangent is within 1e-6 of z, the side is +y.
    let side = if side.length_squared() > 1e-12 { side.normalize() } else { DVec3::Y };
    [side, tangent.cross(side)]
}
