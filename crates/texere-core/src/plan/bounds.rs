//! Bounds of the mesh, from control points alone.

use std::ops::Range;

use glam::Vec3;

use super::Plan;
use crate::backend::PaddedPoints;
use crate::definitions::Segment;

/// A box along the axes.
///
/// ```
/// use texere_core::Bounds;
/// let one = Bounds { low: [0.0; 3], high: [1.0, 2.0, 3.0] };
/// let both = one.joined(&Bounds { low: [-1.0; 3], high: [0.5; 3] });
/// assert_eq!(both, Bounds { low: [-1.0; 3], high: [1.0, 2.0, 3.0] });
/// assert!(both.holds([0.0, 1.5, -1.0]) && !both.holds([1.5, 0.0, 0.0]));
/// assert!(!Bounds::NOTHING.holds([0.0; 3]));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// The least x, y and z, mm.
    pub low: [f32; 3],
    /// The greatest x, y and z, mm.
    pub high: [f32; 3],
}

/// The factor by which the reach of a section grows for rounding in frames, rolls and products with
/// half widths. Sines and cosines are exact to 1.2e-7, and a tangent within 1e-6 of z counts as z.
const FRAME_SLACK: f32 = 1.0 + 1e-5;

/// The slack for rounding in sums of coordinates, as a share of the largest coordinate. A CPU
/// rounds the sums of vertices in the same way as those of the box. Other devices may be off by a
/// few units in the last place more.
const SUM_SLACK: f32 = 8.0 * f32::EPSILON;

impl Bounds {
    /// The empty box.
    pub const NOTHING: Self = Self { low: [f32::INFINITY; 3], high: [f32::NEG_INFINITY; 3] };

    /// The smallest box that holds both boxes.
    #[must_use]
    pub fn joined(&self, other: &Self) -> Self {
        Self {
            low: std::array::from_fn(|axis| self.low[axis].min(other.low[axis])),
            high: std::array::from_fn(|axis| self.high[axis].max(other.high[axis])),
        }
    }

    /// The box of everything over and under a rectangle, given by its lower left and upper right
    /// corners, mm.
    #[must_use]
    pub const fn rectangle(low: [f32; 2], high: [f32; 2]) -> Self {
        Self { low: [low[0], low[1], f32::NEG_INFINITY], high: [high[0], high[1], f32::INFINITY] }
    }

    /// Whether two boxes have a point in common.
    ///
    /// ```
    /// use texere_core::Bounds;
    /// let unit = Bounds { low: [0.0; 3], high: [1.0; 3] };
    /// assert!(unit.touches(&Bounds::rectangle([1.0, 0.5], [2.0, 2.0])));
    /// assert!(!unit.touches(&Bounds::rectangle([1.5, 0.5], [2.0, 2.0])) && !unit.touches(&Bounds::NOTHING));
    /// ```
    #[must_use]
    pub fn touches(&self, other: &Self) -> bool {
        (0..3).all(|axis| self.low[axis] <= other.high[axis] && other.low[axis] <= self.high[axis])
    }

    /// Whether `point`, mm, lies in the box or on its surface.
    #[must_use]
    pub fn holds(&self, point: [f32; 3]) -> bool {
        (0..3).all(|axis| (self.low[axis]..=self.high[axis]).contains(&point[axis]))
    }
}

impl Plan {
    /// A box that holds every vertex of the mesh. `points` must have been made for this plan and
    /// [uploaded](PaddedPoints::upload). For a cloth that is edited, a `Picker` of texere-cpu keeps
    /// such boxes.
    ///
    /// **Panics** if `points` holds fewer points than the plan.
    ///
    /// ```
    /// use texere_core::backend::{PaddedPoints, Plan};
    /// use texere_core::{ControlPoint, Settings, Yarn, Yarns};
    /// # let mut yarns = Yarns::builder();
    /// # for y in 0..2 {
    /// #     yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, y as f32, 0.0, 0.125)));
    /// # }
    /// # let yarns = yarns.build()?;
    /// // Two yarns of radius 0.125 mm from x = 0 to x = 2, at y = 0 and y = 1. Their sections are
    /// // squares with a corner on top.
    /// let plan = Plan::new(yarns.layout().clone(), Settings { sides: 4, ..Settings::default() })?;
    /// let mut points = PaddedPoints::new(&plan)?;
    /// points.upload(&plan, 0, yarns.points());
    /// let near = |mm: f32, exact: f32| (mm - exact).abs() < 1e-4;
    /// let cloth = plan.bounds(&points);
    /// assert!(near(cloth.low[1], -0.125) && near(cloth.high[1], 1.125) && near(cloth.high[2], 0.125));
    /// let first_half = plan.part_bounds(&points, 1, 0..3);
    /// assert!(near(first_half.low[1], 0.875) && near(first_half.high[0], 1.125));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn bounds(&self, points: &PaddedPoints) -> Bounds {
        let yarns = 0..self.layout().yarns().len();
        yarns.fold(Bounds::NOTHING, |all, yarn| all.joined(&self.yarn_bounds(points, yarn)))
    }

    /// A box that holds every vertex of `yarn`, caps included.
    ///
    /// **Panics** past the last yarn.
    #[must_use]
    pub fn yarn_bounds(&self, points: &PaddedPoints, yarn: usize) -> Bounds {
        self.part_bounds(points, yarn, 0..self.rings(yarn))
    }

    /// A box that holds the vertices of some rings of `yarn`, and therefore all triangles between
    /// them. It is [`Bounds::NOTHING`] for no rings. Rings past the last are ignored.
    ///
    /// The box is that of the spline's Bézier hull, widened on all sides. Along x and y it is
    /// widened by the larger of half width and half height, times the section's furthest reach.
    /// Along z it is widened by the half height, times the section's reach along its up. If the
    /// yarn turns, the half height is multiplied by the furthest reach instead. If the yarn leans,
    /// the box is widened along z by as much as along x and y.
    ///
    /// **Panics** past the last yarn.
    #[must_use]
    pub fn part_bounds(&self, points: &PaddedPoints, yarn: usize, rings: Range<u32>) -> Bounds {
        let padded = points.yarn(self, yarn);
        let [level, upright] = self.reach(yarn);
        self.stretches(yarn, rings).fold(Bounds::NOTHING, |all, (interval, from, to)| {
            let window = [padded[interval], padded[interval + 1], padded[interval + 2], padded[interval + 3]];
            let hull = Segment::new(&window, self.sampling().s()).hull(from, to);
            // The side of an upright frame is level, so a section reaches along z by its height
            // alone.
            let level = level * hull.half_width.max(hull.half_height);
            let rising = if self.leans(yarn).is_some() { level } else { upright * hull.half_height };
            let reach = Vec3::new(level, level, rising) * FRAME_SLACK;
            let (low, high) = (hull.low - reach, hull.high + reach);
            let slack = Vec3::splat(low.abs().max(high.abs()).max_element() * SUM_SLACK);
            let [low, high] = [low - slack, high + slack].map(|corner| corner.to_array());
            all.joined(&Bounds { low, high })
        })
    }

    /// The furthest reach of the section of `yarn` from its centre, in half widths or half heights.
    /// The first value is the reach in any direction. The second is the reach along the frame's up,
    /// or again in any direction if the yarn turns.
    pub(crate) fn reach(&self, yarn: usize) -> [f32; 2] {
        let outline = self.outline(self.yarn(yarn).section as usize);
        let most = |reach: fn(f32, f32) -> f32| {
            outline.iter().map(|point| reach(point.x, point.y)).fold(0.0f32, f32::max)
        };
        let any = most(f32::hypot);
        let turns = self.turns(yarn);
        [any, if turns { any } else { most(|_, y| y.abs()) }]
    }

    /// The intervals that contain `rings` of `yarn`, each with the parameters of its first and its
    /// last such ring.
    fn stretches(&self, yarn: usize, rings: Range<u32>) -> impl Iterator<Item = (usize, f32, f32)> {
        let (per_interval, step) = (self.settings().subdivisions + 1, self.sampling().step());
        let all = self.rings(yarn);
        let end = rings.end.min(all);
        let last = end.saturating_sub(1);
        let at = move |ring: u32| (ring / per_interval, (ring % per_interval) as f32 * step);
        let (mut first, mut last) = (at(rings.start), at(last));
        // A ring at a control point also ends the interval before it. An open yarn has no interval
        // behind its last ring.
        if last.1 == 0.0 && (last.0 > first.0 || (end == all && !self.yarn(yarn).closed)) {
            last = (last.0 - 1, 1.0);
        }
        if first.0 > last.0 {
            first = last;
        }
        let intervals = if rings.start < end { first.0..last.0 + 1 } else { 0..0 };
        intervals.map(move |interval| {
            let from = if interval == first.0 { first.1 } else { 0.0 };
            let to = if interval == last.0 { last.1 } else { 1.0 };
            (interval as usize, from, to)
        })
    }
}
