//! A guide bar: its chain, which guides hold which yarn, and by how much single ones are displaced.

use super::{Chain, Lap};

/// Courses of a rack.
pub(super) const RACK: f64 = 480.0;

/// A guide bar.
///
/// ```
/// use texere_fabric::warp::{Bar, Chain, Threading};
/// let bar = Bar { threading: Threading::of(vec![Some(0), None]), ..Bar::new(Chain::parse("1-0/1-2//", 1)?) };
/// assert_eq!([0, 1, 2].map(|guide| bar.threading.yarn(guide)), [Some(0), None, Some(0)]);
/// # Ok::<(), texere_fabric::warp::ChainError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Bar {
    /// How it laps.
    pub chain: Chain,
    /// Which of its guides hold which yarn.
    pub threading: Threading,
    /// Needles by which the whole bar stands further to the high numbers: space 0 of the chain is
    /// that of guide 0 moved by so many.
    pub offset: i32,
    /// Length of yarn for a rack of 480 courses, mm; `None` where the bar finds its own.
    pub run_in_mm: Option<f64>,
    /// Where single guides are displaced: the bar is a Jacquard bar.
    pub jacquard: Option<Displacements>,
}

impl Bar {
    /// A bar that laps so, all its guides threaded with the first yarn.
    #[must_use]
    pub fn new(chain: Chain) -> Self {
        Self { chain, threading: Threading::full(0), offset: 0, run_in_mm: None, jacquard: None }
    }

    /// The lap of a guide at a course, in spaces of the cloth: guide g of a bar without offset,
    /// whose chain says `a-b`, goes from space g + a to space g + b. Spaces that an `i32` can't
    /// count are the last that it can.
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

    /// The laps that its Jacquard's colours make of its chain's, with their courses.
    pub(super) fn displaced(&self) -> impl Iterator<Item = (usize, Lap)> + '_ {
        let colours = self.jacquard.iter().flat_map(|jacquard| &jacquard.palette);
        colours.flat_map(|shifts| shifts.iter().enumerate()).map(|(course, shifts)| {
            let (lap, [from, to]) = (self.chain.lap(course), shifts.map(i32::from));
            (course, Lap { from: lap.from + from, to: lap.to + to })
        })
    }
}

/// Which guides of a bar hold which yarn, over and over again from guide 0.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Threading {
    guides: Vec<Option<u32>>,
}

impl Threading {
    /// Every guide holds the same yarn, by its number among the cloth's yarns.
    #[must_use]
    pub fn full(yarn: u32) -> Self {
        Self { guides: vec![Some(yarn)] }
    }

    /// The yarn of each guide, or `None` for one that is empty. No guides at all are one that is
    /// empty.
    #[must_use]
    pub fn of(guides: Vec<Option<u32>>) -> Self {
        Self { guides: if guides.is_empty() { vec![None] } else { guides } }
    }

    /// Guides until the threading begins again.
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

/// By how many needles the guides of a Jacquard bar are displaced, from an image whose colours say
/// it.
///
/// Each cell of the image is a guide, x from guide 0 on, and one round of the bar's chain, y from
/// the first one knitted. It has the number of a colour, and each colour has, for every course of
/// the chain, the needles by which the lap begins and ends further to the high numbers: 0 or 1.
/// Beyond its edges the image begins again.
///
/// ```
/// use texere_fabric::warp::{Bar, Chain, Displacements};
/// // On 1-0/1-2: as it is, its second lap displaced (1-0/2-3, thick), its first one (2-1/1-2, a mesh).
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
    /// An image of so many guides and rounds of the chain, with the colour of each cell.
    /// `palette[colour][course]` is what the lap's beginning and its end are displaced by. `None`
    /// for an image without cells or with more than a `u32` counts, for colours of no courses or of
    /// different numbers of them, shifts above 1, and cells of a colour that the palette does not
    /// have.
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

    /// Guides and rounds of the chain after which the image begins again.
    #[must_use]
    pub const fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Courses for each row of the image.
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

    /// By how many needles the beginning and the end of a guide's lap at a course are displaced.
    #[must_use]
    pub fn shifts(&self, guide: u32, course: u32) -> [u8; 2] {
        let colour = &self.palette[usize::from(self.colour(guide, course))];
        colour[course as usize % colour.len()]
    }
}
