//! Guide bars: the chain, the threading, and the displacements of single guides.

use super::{Chain, Lap};

/// Number of courses in a rack, the unit in which run-ins are given.
pub(super) const RACK: f64 = 480.0;

/// A guide bar: its chain, its threading, and its displacements if it is a Jacquard bar.
///
/// ```
/// use texere_fabric::warp::{Bar, Chain, Threading};
/// let bar = Bar { threading: Threading::of(vec![Some(0), None]), ..Bar::new(Chain::parse("1-0/1-2//", 1)?) };
/// assert_eq!([0, 1, 2].map(|guide| bar.threading.yarn(guide)), [Some(0), None, Some(0)]);
/// # Ok::<(), texere_fabric::warp::ChainError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Bar {
    /// The movement of the bar, course by course.
    pub chain: Chain,
    /// The yarn of each guide.
    pub threading: Threading,
    /// Needles by which the whole bar is moved towards the high numbers. For guide 0, space 0 of
    /// the chain is space `offset` of the cloth.
    pub offset: i32,
    /// Run-in: length of yarn for a rack of 480 courses, mm. With `None` it follows from the laps.
    pub run_in_mm: Option<f64>,
    /// Displacements of single guides, for a Jacquard bar.
    pub jacquard: Option<Displacements>,
}

impl Bar {
    /// A bar with this chain, whose guides all hold the first yarn.
    #[must_use]
    pub fn new(chain: Chain) -> Self {
        Self { chain, threading: Threading::full(0), offset: 0, run_in_mm: None, jacquard: None }
    }

    /// The lap of a guide at a course, in spaces of the cloth. For a chain with `a-b` and no
    /// offset, guide g goes from space g + a to space g + b. Spaces beyond the range of an `i32`
    /// are clamped to it.
    #[must_use]
    pub fn lap(&self, guide: u32, course: u32) -> Lap {
        let lap = self.chain.lap(course as usize);
        let [from, to] = match &self.jacquard {
            Some(jacquard) => jacquard.shifts(guide, course).map(i64::from),
            None => [0, 0],
        };
        let at = i64::from(guide) + i64::from(self.offset);
        let space = |own: i32, shift: i64| {
            (at + i64::from(own) + shift).clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32
        };
        Lap { from: space(lap.from, from), to: space(lap.to, to) }
    }

    /// The laps of the chain as each colour of the Jacquard displaces them, with their courses.
    pub(super) fn displaced(&self) -> impl Iterator<Item = (usize, Lap)> + '_ {
        let colours = self.jacquard.iter().flat_map(|jacquard| &jacquard.palette);
        colours.flat_map(|shifts| shifts.iter().enumerate()).map(|(course, shifts)| {
            let (lap, [from, to]) = (self.chain.lap(course), shifts.map(i32::from));
            (course, Lap { from: lap.from + from, to: lap.to + to })
        })
    }
}

/// The yarns that the guides of a bar hold. The threading repeats from guide 0 on.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Threading {
    guides: Vec<Option<u32>>,
}

impl Threading {
    /// A threading in which every guide holds the same yarn. `yarn` is an index into the cloth's
    /// yarns.
    #[must_use]
    pub fn full(yarn: u32) -> Self {
        Self { guides: vec![Some(yarn)] }
    }

    /// A threading with the yarn of each guide, or `None` for an empty guide. An empty list counts
    /// as one empty guide.
    #[must_use]
    pub fn of(guides: Vec<Option<u32>>) -> Self {
        Self { guides: if guides.is_empty() { vec![None] } else { guides } }
    }

    /// Number of guides after which the threading repeats.
    #[must_use]
    pub const fn period(&self) -> usize {
        self.guides.len()
    }

    /// The guides of one period.
    #[must_use]
    pub fn guides(&self) -> &[Option<u32>] {
        &self.guides
    }

    /// The yarn of a guide.
    #[must_use]
    pub fn yarn(&self, guide: u32) -> Option<u32> {
        self.guides[guide as usize % self.guides.len()]
    }
}

/// The displacements of a Jacquard bar's guides: an image whose colours stand for displacements.
///
/// Each cell of the image stands for one guide and one round of the bar's chain. x counts guides
/// from guide 0, and y counts rounds from the first one knitted. A cell holds the number of a
/// colour. A colour has two numbers, each 0 or 1, for every course of the chain: the needles by
/// which the beginning and the end of the lap are moved towards the high numbers. The image repeats
/// beyond its edges.
///
/// ```
/// use texere_fabric::warp::{Bar, Chain, Displacements};
/// // Three colours for the chain 1-0/1-2. Colour 0 leaves the chain as it is. Colour 1 displaces
/// // the second lap (1-0/2-3, thick), and colour 2 the first lap (2-1/1-2, a mesh).
/// let palette = vec![vec![[0, 0], [0, 0]], vec![[0, 0], [1, 1]], vec![[1, 1], [0, 0]]];
/// let jacquard = Displacements::new([3, 1], palette, |guide, _| guide as u8).unwrap();
/// let bar = Bar { jacquard: Some(jacquard), ..Bar::new(Chain::parse("1-0/1-2//", 1)?) };
/// let laps = |guide| [0, 1].map(|course| bar.lap(guide, course).to_string());
/// assert_eq!([0, 1, 2].map(laps), [["1-0", "1-2"], ["2-1", "3-4"], ["4-3", "3-4"]]);
/// # Ok::<(), texere_fabric::warp::ChainError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Displacements {
    size: [u32; 2],
    palette: Vec<Vec<[u8; 2]>>,
    cells: Vec<u8>,
}

impl Displacements {
    /// An image of `size` guides and rounds of the chain. `palette[colour][course]` has the
    /// displacements of the beginning and the end of the lap, and `colour` gives the colour of a
    /// cell by guide and round.
    ///
    /// `None` for a palette without colours, for an image without cells or with more cells than a
    /// `u32` counts, for colours without courses or with different numbers of courses, for
    /// displacements above 1, and for colours that the palette lacks.
    #[must_use]
    pub fn new(
        size: [u32; 2],
        palette: Vec<Vec<[u8; 2]>>,
        mut colour: impl FnMut(u32, u32) -> u8,
    ) -> Option<Self> {
        let courses = palette.first()?.len();
        let sound = |colour: &Vec<[u8; 2]>| {
            colour.len() == courses && colour.iter().flatten().all(|shift| *shift <= 1)
        };
        if courses == 0 || !palette.iter().all(sound) || size.contains(&0) {
            return None;
        }
        size[0].checked_mul(size[1])?;
        let cells: Vec<u8> =
            (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y))).map(|(x, y)| colour(x, y)).collect();
        let known = cells.iter().all(|colour| usize::from(*colour) < palette.len());
        known.then_some(Self { size, palette, cells })
    }

    /// Width of the image in guides, and its height in rounds of the chain.
    #[must_use]
    pub const fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The number of courses for which one row of the image counts: the laps of the chain.
    #[must_use]
    pub fn courses(&self) -> usize {
        self.palette[0].len()
    }

    /// The colour of a guide at a course.
    #[must_use]
    pub fn colour(&self, guide: u32, course: u32) -> u8 {
        let [width, height] = self.size;
        let row = course / self.courses() as u32 % height;
        self.cells[(row * width + guide % width) as usize]
    }

    /// Displacements of the beginning and the end of a guide's lap at a course, in needles.
    #[must_use]
    pub fn shifts(&self, guide: u32, course: u32) -> [u8; 2] {
        let colour = &self.palette[usize::from(self.colour(guide, course))];
        colour[course as usize % colour.len()]
    }
}
