//! The checks of a section's parameters.

use super::outline::{VALLEY, cross, doubled_area};
use super::{PLIES, SIDES_MAX, SIDES_MIN, Section, SectionError};

/// The largest coordinate of a corner, in radii of the yarn.
const CORNER_LIMIT: f32 = 100.0;

impl Section {
    /// Checks the shape's parameters.
    ///
    /// **Errors**: [`SectionError`] for a number outside its limits, and for a polygon that has too
    /// few or too many corners, repeats a corner, meets itself or runs clockwise.
    pub fn validate(&self) -> Result<(), SectionError> {
        let within = |field, value: f32, low: f32, high: f32| {
            if (low..=high).contains(&value) {
                Ok(())
            } else {
                Err(SectionError::OutOfRange { field, value, low, high })
            }
        };
        match self {
            Self::Circle => Ok(()),
            Self::Ellipse { aspect } => within("aspect", *aspect, 0.05, 20.0),
            Self::Lenticular { aspect, distortion } => {
                within("aspect", *aspect, 0.05, 20.0)?;
                within("distortion", *distortion, -0.9, 0.9)
            }
            Self::PowerEllipse { aspect, exponent } => {
                within("aspect", *aspect, 0.05, 20.0)?;
                within("exponent", *exponent, 0.1, 4.0)
            }
            Self::Lobed { plies, valley } => {
                let [fewest, most] = PLIES.map(|plies| plies as f32);
                within("plies", *plies as f32, fewest, most)?;
                within("valley", *valley, VALLEY, 1.0)
            }
            Self::Polygon(corners) => polygon(corners),
        }
    }
}

/// Checks the corners of a polygon: their number and their coordinates, and that the outline
/// nowhere meets itself and runs counter-clockwise.
fn polygon(corners: &[[f32; 2]]) -> Result<(), SectionError> {
    let count = corners.len();
    if !(SIDES_MIN as usize..=SIDES_MAX as usize).contains(&count) {
        return Err(SectionError::Corners { corners: count, low: SIDES_MIN, high: SIDES_MAX });
    }
    for value in corners.iter().flatten() {
        if !(-CORNER_LIMIT..=CORNER_LIMIT).contains(value) {
            return Err(SectionError::OutOfRange {
                field: "corner",
                value: *value,
                low: -CORNER_LIMIT,
                high: CORNER_LIMIT,
            });
        }
    }
    // Repeated corners are found before edges are compared, because the two edges beside a repeated
    // corner meet in it.
    if let Some(corner) = (0..count).find(|&corner| corners[corner] == corners[(corner + 1) % count]) {
        return Err(SectionError::RepeatedCorner { corner });
    }
    for first in 0..count {
        let next = (first + 1) % count;
        for second in first + 1..count {
            let after = (second + 1) % count;
            let apart = next != second && after != first;
            if apart && intersect(corners[first], corners[next], corners[second], corners[after]) {
                return Err(SectionError::SelfIntersecting { first, second });
            }
            // If two edges share a corner and overlap, the outline turns back on itself.
            if next == second && folds(corners[first], corners[next], corners[after]) {
                return Err(SectionError::SelfIntersecting { first, second });
            }
        }
    }
    if folds(corners[count - 1], corners[0], corners[1]) {
        return Err(SectionError::SelfIntersecting { first: count - 1, second: 0 });
    }
    if doubled_area(corners) <= 0.0 {
        return Err(SectionError::Clockwise);
    }
    Ok(())
}

fn side_of(a: [f32; 2], b: [f32; 2], point: [f32; 2]) -> f64 {
    cross([b[0] - a[0], b[1] - a[1]], [point[0] - a[0], point[1] - a[1]])
}

/// Whether segments a-b and c-d touch or cross.
fn intersect(a: [f32; 2], b: [f32; 2], c: [f32; 2], d: [f32; 2]) -> bool {
    let between = |a: [f32; 2], b: [f32; 2], p: [f32; 2]| {
        side_of(a, b, p) == 0.0
            && (a[0].min(b[0])..=a[0].max(b[0])).contains(&p[0])
            && (a[1].min(b[1])..=a[1].max(b[1])).contains(&p[1])
    };
    let crossing = side_of(a, b, c) * side_of(a, b, d) < 0.0 && side_of(c, d, a) * side_of(c, d, b) < 0.0;
    crossing || between(a, b, c) || between(a, b, d) || between(c, d, a) || between(c, d, b)
}

/// Whether the path a-b-c turns straight back at b.
fn folds(a: [f32; 2], b: [f32; 2], c: [f32; 2]) -> bool {
    let (back, on) = ([a[0] - b[0], a[1] - b[1]], [c[0] - b[0], c[1] - b[1]]);
    cross(back, on) == 0.0 && back[0] * on[0] + back[1] * on[1] > 0.0
}
