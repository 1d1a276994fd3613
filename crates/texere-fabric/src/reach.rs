//! How far sections reach from the centreline, as they lie and as twist turns them.

use texere_core::{Section, SectionPoint};

/// Number of points of the outline at which a section is measured. With half the value, and with
/// twice, no test is red.
const POINTS: u32 = 1024;

/// The relative error of sizes computed in `f32`.
const ROUNDING: f32 = 1e-5;

/// Reach of a section from the centreline, in units of the yarn's half width and half height.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Reach {
    /// Reach to either side, untwisted.
    pub(crate) width: f32,
    /// Reach down and reach up, untwisted.
    pub(crate) heights: [f32; 2],
    /// Reach in the furthest direction. Twist turns this direction to every side.
    pub(crate) furthest: f32,
    /// The factor by which the ellipse of this width and height has to grow to hold the section. It
    /// is 1 unless corners of the section lie outside that ellipse.
    boxiness: f32,
}

impl Reach {
    pub(crate) fn new(section: &Section) -> Self {
        let outline = section.outline(POINTS);
        let most = |size: &dyn Fn(&SectionPoint) -> f32| outline.iter().map(size).fold(0.0, f32::max);
        let width = most(&|point| point.x.abs());
        let heights = [most(&|point| -point.y), most(&|point| point.y)];
        let height = heights[0].max(heights[1]);
        // Rounding must not make an ellipse boxy, nor a circle wider than it is.
        let above = |size: f32, least: f32| if size > least * (1.0 + ROUNDING) { size } else { least };
        Self {
            width,
            heights,
            furthest: above(most(&|point| point.x.hypot(point.y)), width.max(height)),
            boxiness: above(most(&|point| (point.x / width).hypot(point.y / height)), 1.0),
        }
    }

    /// Half width and half height of the room that crossing threads leave for the section. The room
    /// is an ellipse or, for a twisted section, the circle in which the section turns.
    pub(crate) fn room(&self, twist: f32) -> [f32; 2] {
        if twist != 0.0 {
            return [self.furthest; 2];
        }
        [self.width, self.heights[0].max(self.heights[1])].map(|half| half * self.boxiness)
    }
}

/// Mean reach of a section over all directions. It is the perimeter of the section's convex hull,
/// divided by 2π (Cauchy 1832).
pub(crate) fn mean_reach(section: &Section) -> f32 {
    let outline = section.outline(POINTS);
    let reach = |k: u32| {
        let (sin, cos) = (f64::from(k) / f64::from(POINTS) * std::f64::consts::TAU).sin_cos();
        let along = |point: &SectionPoint| f64::from(point.x) * cos + f64::from(point.y) * sin;
        outline.iter().map(along).fold(0.0, f64::max)
    };
    ((0..POINTS).map(reach).sum::<f64>() / f64::from(POINTS)) as f32
}
