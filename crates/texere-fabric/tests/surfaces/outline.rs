//! The outline of a section, as its distance from the centre by angle.

use std::f64::consts::TAU;

use glam::DVec2;
use texere_core::Section;

/// Number of corners of the outline from which the table is made.
const CORNERS: u32 = 4096;

/// Number of angles in the table.
const ANGLES: usize = 4096;

/// Distance of a star-shaped outline from its centre at each of [`ANGLES`] angles, in radii of the
/// yarn.
pub(crate) struct Outline {
    radii: Vec<f64>,
    /// The largest distance.
    pub(crate) greatest: f64,
}

impl Outline {
    /// The outline of the section with its furrows.
    pub(crate) fn of(section: &Section) -> Self {
        Self::new(&corners(section))
    }

    /// The hull of the section: the outline that a taut thread around it takes.
    pub(crate) fn hull_of(section: &Section) -> Self {
        let mut corners = corners(section);
        // The furthest corner is on the hull. From there on, a corner is dropped if it does not lie
        // outside the line from the corner before it to the next one.
        let (furthest, _) =
            corners.iter().enumerate().max_by(|a, b| a.1.length().total_cmp(&b.1.length())).unwrap();
        corners.rotate_left(furthest);
        corners.push(corners[0]);
        let mut hull: Vec<DVec2> = Vec::new();
        for corner in corners {
            while let [.., before, last] = hull[..]
                && (last - before).perp_dot(corner - last) <= 0.0
            {
                hull.pop();
            }
            hull.push(corner);
        }
        hull.pop();
        Self::new(&hull)
    }

    /// An outline from `corners`, counter-clockwise around the centre.
    fn new(corners: &[DVec2]) -> Self {
        let mut side = 0;
        let radii: Vec<f64> = (0..ANGLES)
            .map(|step| {
                let direction = DVec2::from_angle(step as f64 / ANGLES as f64 * TAU);
                loop {
                    let (from, to) = (corners[side % corners.len()], corners[(side + 1) % corners.len()]);
                    let between = from.perp_dot(direction) >= 0.0 && direction.perp_dot(to) > 0.0;
                    if between {
                        break from.perp_dot(to - from) / direction.perp_dot(to - from);
                    }
                    side += 1;
                    assert!(side < 3 * corners.len(), "not star-shaped");
                }
            })
            .collect();
        let greatest = radii.iter().copied().fold(0.0, f64::max);
        Self { radii, greatest }
    }

    /// Distance of the outline from the centre at `angle`, counted from the section's side.
    pub(crate) fn radius(&self, angle: f64) -> f64 {
        let at = angle.rem_euclid(TAU) / TAU * ANGLES as f64;
        let (step, share) = (at as usize, at.fract());
        let (low, high) = (self.radii[step % ANGLES], self.radii[(step + 1) % ANGLES]);
        low + share * (high - low)
    }

    /// The point of the outline at `angle`.
    pub(crate) fn point(&self, angle: f64) -> DVec2 {
        DVec2::from_angle(angle) * self.radius(angle)
    }

    /// The factor by which the outline has to grow to reach `point`.
    pub(crate) fn gauge(&self, point: DVec2) -> f64 {
        point.length() / self.radius(point.y.atan2(point.x))
    }
}

fn corners(section: &Section) -> Vec<DVec2> {
    section.outline(CORNERS).iter().map(|point| DVec2::new(point.x.into(), point.y.into())).collect()
}
