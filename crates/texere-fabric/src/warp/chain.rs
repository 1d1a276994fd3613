//! Where a guide moves, course by course.

use std::fmt;

/// The highest number of a needle space.
pub const SPACE_MAX: i32 = 512;

/// The most courses of a chain.
pub const CHAIN_COURSES: usize = 4096;

/// The most needles that one lap goes round.
pub const NEEDLES_MOST: i32 = 2;

/// What a guide does at one course: it swings through the needles in space `from`, moves in front
/// of them to space `to`, and swings back. Space n lies between the needles n - 1 and n.
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
    /// The needle space after it.
    pub to: i32,
}

/// How many needles a lap goes round.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum LapKind {
    /// One: it makes a loop.
    Overlap,
    /// Two: it makes a loop on each.
    TwoNeedle,
    /// None: the yarn is laid in, and makes no loop.
    Inlay,
}

impl Lap {
    /// How many needles it goes round.
    #[must_use]
    pub const fn kind(self) -> LapKind {
        match self.overlap().abs() {
            0 => LapKind::Inlay,
            1 => LapKind::Overlap,
            _ => LapKind::TwoNeedle,
        }
    }

    /// By how many needles it moves in front of them; towards higher numbers positive.
    #[must_use]
    pub const fn overlap(self) -> i32 {
        self.to - self.from
    }

    /// The first needle that it goes round, seen from the low numbers; of an inlay, the needle
    /// after its space.
    #[must_use]
    pub const fn needle(self) -> i32 {
        if self.from < self.to { self.from } else { self.to }
    }

    /// The needles that it goes round, in the order in which it does.
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

/// The laps of a guide bar, course by course from the first one knitted, over and over again.
///
/// It is read from notation ([`Chain::parse`]) or known by name ([`Chain::named`]), and gives its
/// notation back:
///
/// ```
/// use texere_fabric::warp::Chain;
/// let tricot = Chain::parse("1-0/1-2//", 1)?;
/// assert_eq!(tricot.to_string(), "1-0/1-2//");
/// // From space 0 to space 1, against the overlap before it: a closed lap.
/// assert_eq!((tricot.underlap(0), tricot.is_open(0)), (1, false));
/// # Ok::<(), texere_fabric::warp::ChainError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Chain {
    laps: Vec<Lap>,
}

impl Chain {
    /// A chain of these laps, if there is one at least and [`CHAIN_COURSES`] at most, their spaces
    /// are numbered from 0 to [`SPACE_MAX`], and each goes round [`NEEDLES_MOST`] needles at most.
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

    /// Courses until the chain begins again.
    #[must_use]
    pub const fn courses(&self) -> usize {
        self.laps.len()
    }

    /// The lap at a course from 0, however far the chain has gone round.
    #[must_use]
    pub fn lap(&self, course: usize) -> Lap {
        self.laps[course % self.laps.len()]
    }

    /// By how many needles the guide moves behind them after its lap at `course`, to that at the
    /// next one; towards higher numbers positive.
    #[must_use]
    pub fn underlap(&self, course: usize) -> i32 {
        self.lap(course % self.laps.len() + 1).from - self.lap(course).to
    }

    /// Whether the lap at `course` is open: the underlap after it goes on in the direction of its
    /// overlap, or there is none. After a closed one it goes back, and the yarn crosses itself. An
    /// inlay is neither, and is none that is open.
    #[must_use]
    pub fn is_open(&self, course: usize) -> bool {
        is_open(self.lap(course), self.underlap(course))
    }
}

/// Whether a lap is open with an underlap of so many needles after it.
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
