//! A start: the yarns of a cloth before it settles.

use glam::DVec3;

/// The way in which a yarn goes on at its ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ends {
    /// The yarn ends at its first and last point.
    Open,
    /// After the last point the first one follows.
    Closed,
    /// After the last point the first one follows, moved by these numbers of repeats in x and y.
    /// They are not both 0.
    Repeats([i32; 2]),
}

/// The rule of settling for the lengths of yarns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Length {
    /// Each interval keeps its length at the start.
    Held,
    /// Each interval reaches this multiple of its length at the start.
    Given(f64),
    /// Yarns may change their length freely.
    Free,
}

/// A yarn of a start.
#[derive(Debug, Clone, PartialEq)]
pub struct StartYarn {
    /// The yarn's control points in one repeat, mm.
    pub points: Vec<DVec3>,
    /// Half the yarn's diameter, mm.
    pub radius: f64,
    /// The way in which the yarn goes on at its ends.
    pub ends: Ends,
}

/// A cloth before it settles, or one repeat of it.
///
/// Every yarn occurs once. Its images, which are moved by whole repeats in x and y, are yarns of
/// the cloth, too, or the same yarn further along (see [`Ends::Repeats`]).
#[derive(Debug, Clone, PartialEq)]
pub struct Start {
    /// The name of the start, such as `jersey-4.2`.
    pub name: String,
    /// The yarns of the start.
    pub yarns: Vec<StartYarn>,
    /// Size of the repeat in x and y, mm. It is 0 in a direction in which nothing repeats.
    pub repeat: [f64; 2],
    /// Points that do not move: a yarn's number and the point's number in it.
    pub pinned: Vec<(usize, usize)>,
    /// The rule for the yarns' lengths.
    pub length: Length,
}

impl Start {
    /// The control points alone, yarn by yarn. A solver moves these.
    #[must_use]
    pub fn points(&self) -> Vec<Vec<DVec3>> {
        self.yarns.iter().map(|yarn| yarn.points.clone()).collect()
    }

    /// Vector from a point to its image, mm.
    pub(super) fn shift(&self, image: [i32; 2]) -> DVec3 {
        DVec3::new(f64::from(image[0]) * self.repeat[0], f64::from(image[1]) * self.repeat[1], 0.0)
    }
}
