//! Chains: the movement of a guide bar, course by course.

use std::fmt;

/// The highest number of a needle space.
pub const SPACE_MAX: i32 = 512;

/// The most courses of a chain.
pub const CHAIN_COURSES: usize = 4096;

/// The most needles that a lap goes round.
pub const NEEDLES_MOST: i32 = 2;

/// The movement of a guide at one course. The guide swings through the needles in space `from`,
/// moves in front of them to space `to`, and swings back. Space n lies between the needles n - 1
/// and n.
///
/// ```
/// use texere_fabric::warp::{Lap, LapKind};
/// let lap = Lap { from: 1, to: 0 };
/// assert_eq!((lap.kind(), lap.needle(), lap.overlap()), (LapKind::Overlap, 0, -1));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Lap {
    /// The needle space before the overlap.
    pub from: i32,
    /// The needle space after the overlap.
    pub to: i32,
}

/// The kind of a lap, by the number of needles that it goes round.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum LapKind {
    /// One needle: the lap makes a loop.
    Overlap,
    /// Two needles: the lap makes a loop on each.
    TwoNeedle,
    /// No needle: the yarn is laid in, and makes no loop.
    Inlay,
}

impl Lap {
    /// The kind of the lap.
    #[must_use]
    pub const fn kind(self) -> LapKind {
        match self.overlap().abs() {
            0 => LapKind::Inlay,
            1 => LapKind::Overlap,
            _ => LapKind::TwoNeedle,
        }
    }

    /// The overlap: the number of needles in front of which the guide passes, positive towards
    /// higher numbers.
    #[must_use]
    pub const fn overlap(self) -> i32 {
        self.to - self.from
    }

    /// The needle with the lowest number that the lap goes round. For an inlay it is the needle
    /// after the inlay's space.
    #[must_use]
    pub const fn needle(self) -> i32 {
        if self.from < self.to { self.from } else { self.to }
    }

    /// The needles that the lap goes round, in the order in which the guide reaches them.
    pub fn needles(self) -> impl Iterator<Item = i32> {
        let (first, count) = (self.needle(), self.overlap().abs());
        let falls = self.overlap() < 0;
        (0..count).map(move |step| first + if falls { count - 1 - step } else { step })
    }
}

impl fmt::Display for Lap {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}-{}", self.from, self.to)
    }
}

/// The chain of a guide bar: its laps, course by course from the first one knitted. After the last
/// lap the chain repeats from the first one.
///
/// A chain is read from notation ([`Chain::parse`]) or known by a name ([`Chain::named`]). It
/// displays as notation:
///
/// ```
/// use texere_fabric::warp::Chain;
/// let tricot = Chain::parse("1-0/1-2//", 1)?;
/// assert_eq!(tricot.to_string(), "1-0/1-2//");
/// // The underlap goes from space 0 to space 1, against the overlap before it: a closed lap.
/// assert_eq!((tricot.underlap(0), tricot.is_open(0)), (1, false));
/// # Ok::<(), texere_fabric::warp::ChainError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Chain {
    laps: Vec<Lap>,
}

impl Chain {
    /// A chain of these laps. `None` for no laps or more than [`CHAIN_COURSES`], for spaces outside
    /// 0 to [`SPACE_MAX`], and for a lap round more than [`NEEDLES_MOST`] needles.
    #[must_use]
    pub fn new(laps: Vec<Lap>) -> Option<Self> {
        let space = 0..=SPACE_MAX;
        let sound = |lap: &Lap| {
            space.contains(&lap.from) && space.contains(&lap.to) && lap.overlap().abs() <= NEEDLES_MOST
        };
        ((1..=CHAIN_COURSES).contains(&laps.len()) && laps.iter().all(sound)).then_some(Self { laps })
    }

    /// The laps, course by course.
    #[must_use]
    pub fn laps(&self) -> &[Lap] {
        &self.laps
    }

    /// Number of courses after which the chain repeats.
    #[must_use]
    pub const fn courses(&self) -> usize {
        self.laps.len()
    }

    /// The lap at a course, counted from 0. The course may lie beyond the chain's end.
    #[must_use]
    pub fn lap(&self, course: usize) -> Lap {
        self.laps[course % self.laps.len()]
    }

    /// The underlap after the lap at `course`: the number of needles behind which the guide passes
    /// on the way to its next lap, positive towards higher numbers.
    #[must_use]
    pub fn underlap(&self, course: usize) -> i32 {
        self.lap(course % self.laps.len() + 1).from - self.lap(course).to
    }

    /// Whether the lap at `course` is open: its underlap goes on in the direction of the overlap,
    /// or there is no underlap. The underlap of a closed lap goes back, and the yarn crosses
    /// itself. An inlay is not open.
    #[must_use]
    pub fn is_open(&self, course: usize) -> bool {
        is_open(self.lap(course), self.underlap(course))
    }
}

/// Whether a lap is open if an underlap of `underlap` needles follows it.
pub(super) const fn is_open(lap: Lap, underlap: i32) -> bool {
    lap.overlap() != 0 && lap.overlap().signum() * underlap >= 0
}

impl fmt::Display for Chain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (course, lap) in self.laps.iter().enumerate() {
            write!(f, "{}{lap}", if course > 0 { "/" } else { "" })?;
        }
        write!(f, "//")
    }
}
