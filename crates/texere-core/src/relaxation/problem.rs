//! The problem that is relaxed: yarns, what they are made of, and what is held.

use super::Elastic;
use crate::{Boundary, Layout, Yarns};

/// Yarns that are to move until their energy is least.
///
/// ```
/// use texere_core::relaxation::{Elastic, Relaxation, RelaxationPlan};
/// use texere_core::{Boundary, ControlPoint, Ends, Yarn, Yarns};
/// // A wavy thread that goes on in a repeat of 4 mm.
/// let mut yarns = Yarns::builder();
/// let wave = [0.0, 1.0, 0.0, -1.0];
/// let points = [0, 1, 2, 3].map(|at| ControlPoint::new(at as f32, wave[at], 0.0, 0.1));
/// yarns.yarn(Yarn::default(), &points);
/// let yarns = yarns.build()?;
/// let boundary = Boundary::new(yarns.layout(), [4.0, 0.0], vec![Ends::Repeats([1, 0])])?;
/// let yarn = Elastic { bending: 0.01, core: 0.1, shell: 0.2, compression: 0.001, extension: 20.0 };
/// let plan = RelaxationPlan::new(&Relaxation::new(&yarns, &[yarn]).boundary(boundary))?;
/// assert_eq!(plan.intervals().len(), 4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Relaxation<'a> {
    pub(super) yarns: &'a Yarns,
    pub(super) elastic: &'a [Elastic],
    pub(super) boundary: Boundary,
    pub(super) pinned: Vec<u64>,
    pub(super) length: f64,
    pub(super) press: f64,
    pub(super) held: [bool; 2],
    pub(super) steps: u32,
}

impl<'a> Relaxation<'a> {
    /// A relaxation of yarns with free ends, which keep their lengths. `elastic` has one element
    /// per yarn. The half widths and half heights of control points do not count.
    #[must_use]
    pub fn new(yarns: &'a Yarns, elastic: &'a [Elastic]) -> Self {
        let boundary = Boundary::without_repeat(yarns.layout());
        Self {
            yarns,
            elastic,
            boundary,
            pinned: Vec::new(),
            length: 1.0,
            press: 0.0,
            held: [false; 2],
            steps: 1500,
        }
    }

    /// Sets how the cloth goes on at its edges. The cloth may repeat in x, in y or in both.
    #[must_use]
    pub fn boundary(mut self, boundary: Boundary) -> Self {
        self.boundary = boundary;
        self
    }

    /// Sets the control points that stay in place, by their numbers among all control points. In a
    /// repeat whose lengths are free they move with the repeat.
    #[must_use]
    pub fn pinned(mut self, points: Vec<u64>) -> Self {
        self.pinned = points;
        self
    }

    /// Sets the length that yarns get: this multiple, 0.5 to 2, of their length at the start.
    #[must_use]
    pub const fn length(mut self, factor: f64) -> Self {
        self.length = factor;
        self
    }

    /// Sets how strongly the cloth is pressed flat, N/mm²: the force for each mm of yarn and each
    /// mm of its distance from z = 0. It is 0 unless set.
    #[must_use]
    pub const fn press(mut self, stiffness: f64) -> Self {
        self.press = stiffness;
        self
    }

    /// Sets whether the repeat keeps its length along x and along y. A cloth is strained if its
    /// repeat is longer than at rest, and held.
    #[must_use]
    pub const fn held(mut self, axes: [bool; 2]) -> Self {
        self.held = axes;
        self
    }

    /// Sets the largest number of steps at full thickness, 1 to a million.
    #[must_use]
    pub const fn steps(mut self, steps: u32) -> Self {
        self.steps = steps;
        self
    }

    pub(super) fn layout(&self) -> &Layout {
        self.yarns.layout()
    }
}
