//! Boundaries: the ends of yarns, and the repeat of a cloth that goes on beyond its control points.

mod error;

use crate::{COORDINATE_LIMIT, Layout};

pub use self::error::BoundaryError;

/// The continuation of a yarn after its last control point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Ends {
    /// The yarn does not go on: it is cut off at both ends.
    #[default]
    Open,
    /// The yarn goes on at its first control point: it is a ring.
    Closed,
    /// The yarn goes on at a copy of its first control point that is moved by this number of whole
    /// repeats along x and along y. It goes on in this way without end in both directions.
    Repeats([i32; 2]),
}

impl Ends {
    /// The number of control intervals of a yarn of `points` control points. An open yarn has none
    /// after its last point.
    ///
    /// ```
    /// use texere_core::Ends;
    /// assert_eq!([Ends::Open, Ends::Closed, Ends::Repeats([1, 0])].map(|ends| ends.intervals(12)), [11, 12, 12]);
    /// ```
    #[must_use]
    pub const fn intervals(self, points: usize) -> usize {
        match self {
            Self::Open => points.saturating_sub(1),
            Self::Closed | Self::Repeats(_) => points,
        }
    }
}

/// The boundary of a piece of cloth: the repeat's size, and the ends of each yarn.
///
/// In a repeat the cloth is endless: every yarn has copies, moved by whole repeats along each axis
/// that has a period. Control points may lie anywhere, even beyond the repeat's edge. A repeating
/// yarn goes on from its last control point to the moved copy of its first.
///
/// ```
/// use texere_core::{Boundary, ControlPoint, Ends, Yarn, Yarns};
/// // A thread that crosses a repeat of 2 mm along x in four points, and goes on in the next one.
/// let mut yarns = Yarns::builder();
/// yarns.yarn(Yarn::default(), &[0.0, 0.5, 1.0, 1.5].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
/// let yarns = yarns.build()?;
/// let boundary = Boundary::new(yarns.layout(), [2.0, 0.0], vec![Ends::Repeats([1, 0])])?;
/// assert_eq!(boundary.onward_mm(0), [2.0, 0.0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Boundary {
    repeat: [f32; 2],
    ends: Vec<Ends>,
}

impl Boundary {
    /// A boundary for the yarns of `layout`, with a repeat of `repeat` mm along x and y (0 for
    /// none) and the `ends` of each yarn.
    ///
    /// **Errors**: [`BoundaryError::Repeat`] for a repeat that is negative, beyond
    /// [`COORDINATE_LIMIT`] or not a number, and the errors of [`Boundary::check`].
    pub fn new(layout: &Layout, repeat: [f32; 2], ends: Vec<Ends>) -> Result<Self, BoundaryError> {
        for (axis, length) in ['x', 'y'].into_iter().zip(repeat) {
            if !(0.0..=COORDINATE_LIMIT).contains(&length) {
                return Err(BoundaryError::Repeat { axis, length, limit: COORDINATE_LIMIT });
            }
        }
        let boundary = Self { repeat, ends };
        boundary.check(layout)?;
        Ok(boundary)
    }

    /// A boundary without a repeat. Each yarn is closed or open as in `layout`.
    ///
    /// ```
    /// use texere_core::{Boundary, ControlPoint, Ends, Yarn, Yarns};
    /// # let mut yarns = Yarns::builder();
    /// # yarns.yarn(Yarn::default(), &[0.0, 1.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
    /// # let yarns = yarns.build()?;
    /// assert_eq!(Boundary::without_repeat(yarns.layout()).ends(), [Ends::Open]); // one open yarn
    /// # Ok::<(), texere_core::YarnError>(())
    /// ```
    #[must_use]
    pub fn without_repeat(layout: &Layout) -> Self {
        let ends = layout.yarns().iter().map(|yarn| if yarn.closed { Ends::Closed } else { Ends::Open });
        Self { repeat: [0.0; 2], ends: ends.collect() }
    }

    /// Checks that the boundary fits the yarns of `layout`.
    ///
    /// **Errors**: [`BoundaryError`] for a number of ends that differs from that of the yarns, a
    /// yarn that is closed in only one of boundary and layout, a yarn that goes on along an axis
    /// without a period, and a yarn that goes on by 0 repeats along both axes.
    pub fn check(&self, layout: &Layout) -> Result<(), BoundaryError> {
        if self.ends.len() != layout.yarns().len() {
            return Err(BoundaryError::EndsCount { ends: self.ends.len(), yarns: layout.yarns().len() });
        }
        for (yarn, (&ends, each)) in self.ends.iter().zip(layout.yarns()).enumerate() {
            if each.closed != (ends == Ends::Closed) {
                return Err(BoundaryError::Closed { yarn, closed: each.closed });
            }
            if let Ends::Repeats(repeats) = ends {
                for (axis, (count, length)) in
                    ['x', 'y'].into_iter().zip(repeats.into_iter().zip(self.repeat))
                {
                    if count != 0 && length == 0.0 {
                        return Err(BoundaryError::NoRepeat { yarn, axis });
                    }
                }
                if repeats == [0; 2] {
                    return Err(BoundaryError::NoWayOn { yarn });
                }
            }
        }
        Ok(())
    }

    /// The repeat's length along x and y, mm, 0 for none.
    #[must_use]
    pub const fn repeat(&self) -> [f32; 2] {
        self.repeat
    }

    /// The ends of each yarn.
    #[must_use]
    pub fn ends(&self) -> &[Ends] {
        &self.ends
    }

    /// A repeating yarn goes on at a copy of its first control point. This is how far that copy is
    /// moved along x and y, mm. It is 0 for a yarn that does not repeat.
    ///
    /// **Panics** past the last yarn.
    #[must_use]
    pub fn onward_mm(&self, yarn: usize) -> [f64; 2] {
        match self.ends[yarn] {
            Ends::Open | Ends::Closed => [0.0; 2],
            Ends::Repeats(repeats) => {
                [0, 1].map(|axis| f64::from(repeats[axis]) * f64::from(self.repeat[axis]))
            }
        }
    }
}
