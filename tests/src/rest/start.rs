//! A start: where the yarns of a cloth are before it settles.

use glam::DVec3;

/// How a yarn goes on at its ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ends {
    /// It ends there.
    Open,
    /// After its last point comes its first.
    Closed,
    /// After its last point comes its first, moved by so many repeats in x and in y. They are not
    /// both 0.
    Repeats([i32; 2]),
}

/// What settling does to the lengths of yarns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Length {
    /// Each interval keeps the length that it has at the start.
    Held,
    /// Each yarn reaches so many times the length that it has at the start.
    Given(f64),
    /// Yarns find their own length.
    Free,
}

/// A yarn of a start.
#[derive(Debug, Clone, PartialEq)]
pub struct StartYarn {
    /// Its control points, mm; of one repeat.
    pub points: Vec<DVec3>,
    /// Half its diameter, mm.
    pub radius: f64,
    /// How it goes on.
    pub ends: Ends,
}

/// A cloth before it settles, or one repeat of it.
///
/// Every yarn comes once. Its images, moved by whole repeats in x and y, are yarns of the cloth,
/// too, or the same yarn further along (see [`Ends::Repeats`]).
#[derive(Debug, Clone, PartialEq)]
pub struct Start {
    /// Its name, as in `jersey-4.2`.
    pub name: String,
    /// Its yarns.
    pub yarns: Vec<StartYarn>,
    /// Size of the repeat in x and y, mm; 0 in a direction in which nothing repeats.
    pub repeat: [f64; 2],
    /// Points that do not move: a yarn's number and the point's number in it.
    pub pinned: Vec<(usize, usize)>,
    /// What becomes of the yarns' lengths.
    pub length: Length,
}

impl Start {
    /// The control points alone, yarn by yarn: what a solver moves.
    #[must_use]
    pub fn points(&self) -> Vec<Vec<DVec3>> {
        self.yarns.iter().map(|yarn| yarn.points.clone()).collect()
    }

    /// How far an image lies from what it is an image of, mm.
    pub(super) fn shift(&self, image: [i32; 2]) -> DVec3 {
        DVec3::new(f64::from(image[0]) * self.repeat[0], f64::from(image[1]) * self.repeat[1], 0.0)
    }
}
