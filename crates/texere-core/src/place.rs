//! Places on yarns.

use glam::DVec3;

use crate::definitions::{Segment, tangent_factor};
use crate::interval::neighbours;
use crate::{ControlPoint, Yarns};

/// A place on a yarn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct YarnPlace {
    /// Number of the yarn, counted from 0.
    pub yarn: usize,
    /// Number of the control interval, counted from 0 within the yarn. It is the number of the
    /// control point at the interval's start.
    pub interval: usize,
    /// The parameter within the interval, from 0 to 1.
    pub t: f64,
    /// The point of the centreline, mm.
    pub position: [f64; 3],
    /// The [source](Yarns::with_sources) of the nearer of the interval's control points, if the
    /// yarns have sources.
    pub source: Option<u32>,
}

impl YarnPlace {
    /// The place at `t`, from 0 to 1, of control interval `interval` of yarn number `yarn`. The
    /// numbers may be those of a picked triangle, for example. `None` if there is no such yarn or
    /// interval, or `t` is outside its range.
    ///
    /// ```
    /// use texere_core::{ControlPoint, Yarn, YarnPlace, Yarns};
    /// let mut yarns = Yarns::builder();
    /// yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
    /// let yarns = yarns.build()?;
    /// let place = YarnPlace::at(&yarns, 0, 1, 0.25);
    /// assert_eq!(place.map(|place| place.position), Some([1.25, 0.0, 0.0]));
    /// assert!(YarnPlace::at(&yarns, 0, 2, 0.0).is_none());
    /// # Ok::<(), texere_core::YarnError>(())
    /// ```
    #[must_use]
    pub fn at(yarns: &Yarns, yarn: usize, interval: usize, t: f64) -> Option<Self> {
        let (points, range) = (yarns.yarn_points(yarn)?, yarns.range(yarn)?);
        let closed = yarns.layout().yarns()[yarn].closed;
        let intervals = if closed { points.len() } else { points.len() - 1 };
        if interval >= intervals || !(0.0..=1.0).contains(&t) {
            return None;
        }
        let segment = Segment::new(&neighbours(points, closed, interval), tangent_factor(yarns.tension()));
        let position = segment.sample(t as f32).centre.to_array().map(f64::from);
        let nearer = (interval + usize::from(t > 0.5)) % points.len();
        let source = yarns.sources().and_then(|sources| sources.get(range.start + nearer).copied());
        Some(Self { yarn, interval, t, position, source })
    }

    /// The place on yarn number `yarn` that is nearest to `position`, mm, such as a point on its
    /// surface that a picture shows. The search treats the yarn as straight between control points.
    /// `None` if there is no such yarn.
    ///
    /// ```
    /// use texere_core::{ControlPoint, Yarn, YarnPlace, Yarns};
    /// let mut yarns = Yarns::builder();
    /// yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
    /// let yarns = yarns.build()?;
    /// let place = YarnPlace::nearest(&yarns, 0, [1.25, 0.0, 0.1]);
    /// assert_eq!(place.map(|place| (place.interval, place.t)), Some((1, 0.25)));
    /// # Ok::<(), texere_core::YarnError>(())
    /// ```
    #[must_use]
    pub fn nearest(yarns: &Yarns, yarn: usize, position: [f64; 3]) -> Option<Self> {
        let points = yarns.yarn_points(yarn)?;
        let closing = if yarns.layout().yarns()[yarn].closed { points.first() } else { None };
        let place = |point: &ControlPoint| point.position().as_dvec3();
        let wanted = DVec3::from(position);
        let mut nearest = (f64::INFINITY, 0, 0.0);
        for (interval, (start, end)) in points.iter().zip(points[1..].iter().chain(closing)).enumerate() {
            let (start, end) = (place(start), place(end));
            let way = end - start;
            let t = ((wanted - start).dot(way) / way.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
            let distance = wanted.distance_squared(start + way * t);
            if distance < nearest.0 {
                nearest = (distance, interval, t);
            }
        }
        let (_, interval, t) = nearest;
        Self::at(yarns, yarn, interval, t)
    }
}
