//! The sampling of the spline: its tension, and the positions of rings on it.

use crate::definitions::{Sample, Segment, tangent_factor};
use crate::{ArcLength, ControlPoint, Layout, PlanError};

/// The tension of the spline and the number of points inserted between control points (the paper's
/// u and K).
///
/// ```
/// use texere_core::definitions::Sampling;
/// use texere_core::{ControlPoint, Yarn, Yarns};
/// # let mut yarns = Yarns::builder();
/// # yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
/// # let yarns = yarns.build()?;
/// let sampling = Sampling::new(yarns.layout(), 1)?;
/// assert_eq!(sampling.rings(152, false), 303);
/// assert_eq!(sampling.rings(152, true), 305);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sampling {
    tension: f32,
    subdivisions: u32,
    s: f32,
    step: f32,
}

/// The most points that may be inserted between two control points. With a thousand between control
/// points a millimetre apart, rings are only a micrometre apart.
pub(crate) const SUBDIVISIONS_MAX: u32 = 1023;

impl Default for Sampling {
    /// The sampling of the paper: Catmull-Rom (tension 0), one inserted point.
    fn default() -> Self {
        Self { tension: 0.0, subdivisions: 1, s: 0.5, step: 0.5 }
    }
}

impl Sampling {
    /// The sampling of the yarns of `layout`, whose [tension](Layout::tension) is u. `subdivisions`
    /// is K, from 0 to 1023.
    ///
    /// **Errors**: [`PlanError::Subdivisions`] for more than 1023.
    pub fn new(layout: &Layout, subdivisions: u32) -> Result<Self, PlanError> {
        let tension = layout.tension();
        if subdivisions > SUBDIVISIONS_MAX {
            return Err(PlanError::Subdivisions { subdivisions, limit: SUBDIVISIONS_MAX });
        }
        let s = tangent_factor(tension);
        Ok(Self { tension, subdivisions, s, step: 1.0 / (subdivisions as f32 + 1.0) })
    }

    /// The tension u.
    #[must_use]
    pub const fn tension(&self) -> f32 {
        self.tension
    }

    /// The number K of points inserted between two control points.
    #[must_use]
    pub const fn subdivisions(&self) -> u32 {
        self.subdivisions
    }

    /// `s = (1 - u) / 2`, the factor in the spline (the paper's equation 2).
    #[must_use]
    #[inline]
    pub const fn s(&self) -> f32 {
        self.s
    }

    /// `1 / (K + 1)` as `f32`. Ring k of an interval lies at t = k times this value, with one
    /// rounding on every device.
    #[must_use]
    #[inline]
    pub const fn step(&self) -> f32 {
        self.step
    }

    /// The number of rings of a yarn of `points` control points: `(points - 1)(K + 1) + 1` if open,
    /// `points (K + 1) + 1` if closed.
    #[must_use]
    pub const fn rings(&self, points: u64, closed: bool) -> u64 {
        let intervals = if closed { points } else { points - 1 };
        intervals * (self.subdivisions as u64 + 1) + 1
    }

    /// The spline at ring `ring` of a yarn, whose *padded* control points start at `padded[0]`.
    ///
    /// `rings` is the yarn's ring count. Ring `j (K + 1) + k` lies at t = k / (K + 1) of interval
    /// j. The last ring of an open yarn lies at t = 1 of its last interval.
    #[must_use]
    #[inline]
    pub fn sample(&self, padded: &[ControlPoint], ring: u32, rings: u32, closed: bool) -> RingSample {
        let per_interval = self.subdivisions + 1;
        let (mut interval, step) = ((ring / per_interval) as usize, ring % per_interval);
        let mut t = step as f32 * self.step;
        if ring + 1 == rings && !closed {
            interval -= 1;
            t = 1.0;
        }
        let window = [padded[interval], padded[interval + 1], padded[interval + 2], padded[interval + 3]];
        let segment = Segment::new(&window, self.s);
        RingSample {
            sample: segment.sample(t),
            span: segment.span(),
            ends_interval: step + 1 == per_interval,
        }
    }

    /// The length of the spline from ring `ring` to the next. `ring` must not be the yarn's last.
    /// `padded` is as in [`Sampling::sample`].
    #[must_use]
    #[inline]
    pub fn step_length(&self, padded: &[ControlPoint], ring: u32) -> ArcLength {
        let per_interval = self.subdivisions + 1;
        let (interval, part) = ((ring / per_interval) as usize, ring % per_interval);
        let window = [padded[interval], padded[interval + 1], padded[interval + 2], padded[interval + 3]];
        // The interval's end is 1 itself, because the last multiple of the step may differ from 1
        // in the last bit.
        let end = if part + 1 == per_interval { 1.0 } else { (part + 1) as f32 * self.step };
        ArcLength::from_mm(Segment::new(&window, self.s).length(part as f32 * self.step, end))
    }
}

/// The spline at a ring, with the data for the step to the next ring.
#[derive(Debug, Clone, Copy)]
pub struct RingSample {
    /// The spline at the ring.
    pub sample: Sample,
    /// The interval's end relative to its start, mm.
    pub span: glam::Vec3,
    /// Whether the next ring is the first of the next interval.
    pub ends_interval: bool,
}

impl RingSample {
    /// The vector from this ring's centre to the next one's, mm. It is made from offsets within the
    /// interval, so it keeps its digits far from the origin.
    #[must_use]
    #[inline]
    pub fn chord_to(&self, next: &Self) -> glam::Vec3 {
        let end = if self.ends_interval { self.span } else { next.sample.offset };
        end - self.sample.offset
    }
}
