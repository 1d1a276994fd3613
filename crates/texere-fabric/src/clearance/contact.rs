//! Contacts of yarns: where they are, how near they come, and how many are looked for.

use glam::DVec3;
use texere_core::{ControlPoint, Segment, Yarns};

use super::neighbours;
use crate::grid;

/// Contacts further apart than this factor are not looked for.
pub const CLEARANCE_NEAR: f64 = 1.1;

/// How exact a ratio is: yarns at 0.999 of touching count as touching.
///
/// Of yarns with plies, corners or twisted flat sections a touch may stay unseen that is nearer by up to 0.003; where
/// such a yarn bends as sharply as it is thick and meets itself there, more than that. Of their ratios below 0.25 no smaller one is
/// looked for. Where a section reaches four times as far as its control points lie apart it counts by its hull, untwisted.
///
/// Of two approaches side by side on one pair of sharply bent intervals of flattened yarns the nearer may stay unseen.
pub const CLEARANCE_ACCURACY: f64 = 1e-3;

/// The most contacts that are listed one by one.
pub const CONTACTS_LISTED: usize = 100;

/// The most control intervals that one is compared with in a cell of the search, beside each other on one plane through it.
///
/// Yarns that are clear of one another come that close where a radius has some 250 control points, or where a thousand
/// straight yarns of two points lie side by side.
pub const CLEARANCE_BESIDE: usize = 1024;

/// The most pairs of control intervals that are looked at for each control point: an interval lies in 6 cells on average
/// at most, and is compared with [`CLEARANCE_BESIDE`] in each. Of cloth it is 20 to 60.
pub const CLEARANCE_PAIRS: u64 = grid::ENTRIES * CLEARANCE_BESIDE as u64;

/// Width of a bin of the histogram.
pub const CLEARANCE_BIN: f64 = 0.01;

/// One place of a yarn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct YarnPlace {
    /// The yarn, from 0.
    pub yarn: usize,
    /// The control interval: the number of the control point that it starts from, from 0 within the yarn.
    pub interval: usize,
    /// Where in the interval, from 0 to 1.
    pub t: f64,
    /// The centreline there, mm.
    pub position: [f64; 3],
    /// The source of the nearer of the interval's control points, if the yarns have sources.
    pub source: Option<u32>,
}

impl YarnPlace {
    /// The place at `t`, from 0 to 1, of control interval `interval` of yarn number `yarn`, such as a picked triangle has it. `tension` is that of the
    /// yarns' splines. None where there is no such yarn or interval, and for a `t` that is none.
    ///
    /// ```
    /// use texere_core::{ControlPoint, Yarn, Yarns};
    /// use texere_fabric::YarnPlace;
    /// let mut yarns = Yarns::builder();
    /// yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
    /// let yarns = yarns.build()?;
    /// let place = YarnPlace::at(&yarns, 0, 1, 0.25, 0.0);
    /// assert_eq!(place.map(|place| place.position), Some([1.25, 0.0, 0.0]));
    /// assert!(YarnPlace::at(&yarns, 0, 2, 0.0, 0.0).is_none());
    /// # Ok::<(), texere_core::YarnError>(())
    /// ```
    #[must_use]
    pub fn at(yarns: &Yarns, yarn: usize, interval: usize, t: f64, tension: f32) -> Option<Self> {
        let (points, range) = (yarns.yarn_points(yarn)?, yarns.range(yarn)?);
        let closed = yarns.layout().yarns()[yarn].closed;
        let intervals = if closed { points.len() } else { points.len() - 1 };
        if interval >= intervals || !(0.0..=1.0).contains(&t) {
            return None;
        }
        let segment = Segment::new(&neighbours(points, closed, interval), (1.0 - tension) / 2.0);
        let position = segment.sample(t as f32).centre.to_array().map(f64::from);
        let nearer = (interval + usize::from(t > 0.5)) % points.len();
        let source = yarns.sources().and_then(|sources| sources.get(range.start + nearer).copied());
        Some(Self { yarn, interval, t, position, source })
    }

    /// The place of yarn number `yarn` that is nearest to `position`, mm, such as a point on its surface that a picture shows. It is found between the
    /// yarn's control points as if they were joined by straight lines. `tension` is that of the yarns' splines. None where there is no such yarn.
    ///
    /// ```
    /// use texere_core::{ControlPoint, Yarn, Yarns};
    /// use texere_fabric::YarnPlace;
    /// let mut yarns = Yarns::builder();
    /// yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
    /// let yarns = yarns.build()?;
    /// let place = YarnPlace::nearest(&yarns, 0, [1.25, 0.0, 0.1], 0.0);
    /// assert_eq!(place.map(|place| (place.interval, place.t)), Some((1, 0.25)));
    /// # Ok::<(), texere_core::YarnError>(())
    /// ```
    #[must_use]
    pub fn nearest(yarns: &Yarns, yarn: usize, position: [f64; 3], tension: f32) -> Option<Self> {
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
        Self::at(yarns, yarn, interval, t, tension)
    }
}

/// Where two yarns, or two parts of one, are nearer to one another than anywhere close by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// The two places, the lower yarn first.
    pub places: [YarnPlace; 2],
    /// The factor by which both sections could grow until their surfaces touch: 1 where they just do, less where they pierce. Of
    /// round yarns it is the distance of the centrelines over the sum of the radii. A section counts with all that lies between
    /// its centre and its outline.
    pub ratio: f64,
}
