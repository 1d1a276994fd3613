//! The problem that is settled: yarns, their boundary, and the conditions of their rest.

use super::Length;
use crate::{Boundary, ControlPoint, Layout, Yarns};

/// Yarns that are to come to rest. At rest they nowhere pierce one another, nowhere fold, and have
/// the lengths that [`Settling::length()`] sets.
///
/// ```
/// use texere_core::settling::{Settling, SettlingPlan};
/// use texere_core::{ControlPoint, Yarn, Yarns};
/// let mut yarns = Yarns::builder();
/// yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.1, 0.2)));
/// yarns.yarn(Yarn::default(), &[-1.0, 0.0, 1.0].map(|y| ControlPoint::new(1.0, y, -0.1, 0.2)));
/// let yarns = yarns.build()?;
/// let plan = SettlingPlan::new(&Settling::new(&yarns))?;
/// assert_eq!(plan.counts().points, 6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Settling<'a> {
    pub(crate) yarns: &'a Yarns,
    pub(crate) boundary: Boundary,
    pub(crate) pinned: Vec<u64>,
    pub(crate) length: Length,
    pub(crate) plates: Option<f32>,
    pub(crate) passes: u32,
}

impl<'a> Settling<'a> {
    /// A settling of yarns that have free ends, keep their length and are not pressed. The
    /// [tension](crate::Layout::tension) of their splines may be 0.99 at most.
    #[must_use]
    pub fn new(yarns: &'a Yarns) -> Self {
        Self {
            yarns,
            boundary: Boundary::without_repeat(yarns.layout()),
            pinned: Vec::new(),
            length: Length::Held,
            plates: None,
            passes: 250,
        }
    }

    /// Sets how the cloth goes on at its edges. The boundary may repeat in x, in y or in both.
    #[must_use]
    pub fn boundary(mut self, boundary: Boundary) -> Self {
        self.boundary = boundary;
        self
    }

    /// Sets the control points that stay in place, by their numbers among all control points.
    #[must_use]
    pub fn pinned(mut self, points: Vec<u64>) -> Self {
        self.pinned = points;
        self
    }

    /// Sets the lengths that settling aims for.
    #[must_use]
    pub const fn length(mut self, length: Length) -> Self {
        self.length = length;
        self
    }

    /// Presses the cloth between two plates `gap` mm apart, at equal distances from z = 0, while
    /// soft bends act.
    #[must_use]
    pub const fn plates(mut self, gap: f32) -> Self {
        self.plates = Some(gap);
        self
    }

    /// Sets the largest number of passes of either form at full thickness, 1 to a million. Before
    /// these come one pass that measures the start, and forty passes in which yarns grow.
    #[must_use]
    pub const fn passes(mut self, passes: u32) -> Self {
        self.passes = passes;
        self
    }

    pub(crate) fn layout(&self) -> &Layout {
        self.yarns.layout()
    }

    pub(crate) fn points(&self) -> &[ControlPoint] {
        self.yarns.points()
    }
}
