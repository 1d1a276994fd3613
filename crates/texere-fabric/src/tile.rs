//! One repeat of a structure amid copies of itself, for maps that tile.

use texere_core::{Origin, Yarns};

use crate::settling::settled_together;
use crate::{FabricError, Repeat, Structure};

/// One repeat of a structure with copies of it on all sides. Cloth within the repeat's area is then
/// as in endless cloth: what leaves the area at one edge comes in at the opposite one.
///
/// ```
/// use texere_core::{Material, Origin, Section};
/// use texere_fabric::{Relief, Structure, Thread, Weave, Woven, WovenDesign};
/// let twill = Weave::parse("2/2")?.drawdown(20, 20)?;
/// let threads = vec![Thread::new(0.5, 0.1); 20];
/// let cloth = Woven::new(twill, threads.clone(), threads, vec![Material::default()], vec![Section::Circle])?;
/// let tile = Structure::Woven(WovenDesign::new(cloth, None, Relief::Report)?).tile()?.unwrap();
/// // Four ends and four picks, half a millimetre each.
/// let [low, size] = tile.area_mm(&tile.structure);
/// assert_eq!(size, [2.0, 2.0]);
/// assert!(low[0] > 2.0 && tile.structure.size_mm()[0] > low[0] + size[0] + 2.0);
/// // End 1 of the tile, and the end that lies beside its last end.
/// let first = (low[0] / 0.5).round() as u32;
/// assert_eq!(tile.origin(Origin::End(first + 1)), Origin::End(1));
/// assert_eq!(tile.origin(Origin::End(first + 5)), Origin::End(1));
/// # Ok::<(), texere_fabric::FabricError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Tile {
    /// The repeat and its copies. Its yarns may be placed or come to rest.
    pub structure: Structure,
    kind: Kind,
}

/// Where the repeat lies.
#[derive(Debug, Clone, Copy)]
enum Kind {
    /// The numbers of ends and of picks before the repeat, and in it.
    Woven { before: [usize; 2], count: [usize; 2] },
    /// The numbers of wales and courses before the repeat, and in it.
    Knit { before: [u32; 2], count: [u32; 2] },
}

impl Structure {
    /// One repeat of the structure amid copies of itself. None for a knit that does not repeat,
    /// and for yarns that no structure made.
    /// Woven cloth in which nothing repeats is its own repeat, and its last threads come to lie
    /// beside its first ones.
    ///
    /// **Errors**: the errors of [`Woven::new`](crate::Woven::new),
    /// [`Knitted::new`](crate::weft::Knitted::new) and
    /// [`WarpKnitted::new`](crate::warp::WarpKnitted::new) if the structure is too large with its
    /// copies.
    pub fn tile(&self) -> Result<Option<Tile>, FabricError> {
        let (structure, kind) = match self {
            Self::Woven(design) => {
                let (cloth, [before, count]) = design.cloth().amid_copies()?;
                (Self::Woven(design.of(cloth)?), Kind::Woven { before, count })
            }
            Self::Yarns(_) => return Ok(None),
            Self::Weft(knit) => match knit.repeat_size() {
                None => return Ok(None),
                Some(size) => {
                    let copies = Copies::of(size, self.cell_mm(), &knit.repeat()?);
                    (Self::Weft(knit.with_copies(copies.all)?), copies.kind())
                }
            },
            Self::Warp(knit) => {
                let copies = Copies::of(knit.repeat_size(), self.cell_mm(), &knit.repeat()?);
                (Self::Warp(knit.with_copies(copies.all)?), copies.kind())
            }
        };
        Ok(Some(Tile { structure, kind }))
    }
}

impl Tile {
    /// The repeat's lower left corner (x, y), and its width and height, mm. `structure` is
    /// [`Tile::structure`], stretched ([`Structure::stretch`]) or not.
    #[must_use]
    pub fn area_mm(&self, structure: &Structure) -> [[f64; 2]; 2] {
        match (self.kind, structure) {
            (Kind::Woven { before, count }, Structure::Woven(design)) => {
                let sets = [design.cloth().warp(), design.cloth().weft()];
                let room = |set: usize, first: usize, count: usize| {
                    sets[set].iter().skip(first).take(count).map(|thread| thread.spacing_mm).sum::<f64>()
                };
                [
                    [0, 1].map(|set| room(set, 0, before[set])),
                    [0, 1].map(|set| room(set, before[set], count[set])),
                ]
            }
            (Kind::Woven { .. }, _) => [[0.0; 2], structure.size_mm()],
            (Kind::Knit { before, count }, _) => {
                let cell = structure.cell_mm();
                [before, count].map(|numbers| [0, 1].map(|axis| cell[axis] * f64::from(numbers[axis])))
            }
        }
    }

    /// The origin of a yarn, with the number of its end, pick or guide counted within the repeat,
    /// from 1. A yarn and its copies have one origin.
    #[must_use]
    pub fn origin(&self, origin: Origin) -> Origin {
        let within = |number: u32, before: u64, count: u64| {
            let ahead = count - before % count.max(1);
            ((u64::from(number.max(1)) - 1 + ahead) % count.max(1) + 1) as u32
        };
        match (self.kind, origin) {
            (Kind::Woven { before, count }, Origin::End(end)) => {
                Origin::End(within(end, before[0] as u64, count[0] as u64))
            }
            (Kind::Woven { before, count }, Origin::Pick(pick)) => {
                Origin::Pick(within(pick, before[1] as u64, count[1] as u64))
            }
            (Kind::Knit { before, count }, Origin::Guide { bar, guide }) => {
                Origin::Guide { bar, guide: within(guide, before[0].into(), count[0].into()) }
            }
            (_, other) => other,
        }
    }
}

impl Structure {
    /// Distances of wales and of courses, mm; in woven cloth the mean distances of threads.
    fn cell_mm(&self) -> [f64; 2] {
        let cells = match self {
            Self::Woven(design) => [design.cloth().warp().len(), design.cloth().weft().len()],
            Self::Weft(knit) => knit.size().map(|number| number as usize),
            Self::Warp(knit) => knit.size().map(|number| number as usize),
            Self::Yarns(_) => [1, 1],
        };
        let size = self.size_mm();
        [0, 1].map(|axis| size[axis] / cells[axis].max(1) as f64)
    }
}

/// Copies of a knit's smallest repeat. Some of them settle as one piece. On each side of this piece
/// lie pieces of the same size: all whose yarns reach into this piece, and one more.
#[derive(Debug, Clone, Copy)]
struct Copies {
    before: [u32; 2],
    count: [u32; 2],
    /// Copies of the smallest repeat in all.
    all: [u32; 2],
}

impl Copies {
    /// The copies of a repeat of `size` wales and courses, each `cell` mm. `repeat` is the piece
    /// that settles.
    fn of(size: [u32; 2], cell: [f64; 2], repeat: &Repeat) -> Self {
        // The least number that all numbers from 1 to 16 divide. `settled_together` tries these
        // numbers.
        const MANY: u32 = 720_720;
        let tiles = settled_together(size, [MANY; 2]);
        let count = [0, 1].map(|axis| size[axis] * tiles[axis]);
        let beyond = overhang(&repeat.piece.yarns, repeat.piece.boundary.repeat());
        // One piece is added, because a yarn that is cut off bends differently at its end.
        let sides = [0, 1]
            .map(|axis| 1 + (f64::from(beyond[axis]) / (cell[axis] * f64::from(count[axis]))).ceil() as u32);
        Self {
            before: [0, 1].map(|axis| count[axis] * sides[axis]),
            count,
            all: [0, 1].map(|axis| tiles[axis] * (1 + 2 * sides[axis])),
        }
    }

    const fn kind(self) -> Kind {
        Kind::Knit { before: self.before, count: self.count }
    }
}

/// How far the yarns of a piece reach out of the area from 0 to `size` along x and y, mm, with half
/// their thickness.
fn overhang(yarns: &Yarns, size: [f32; 2]) -> [f32; 2] {
    yarns.points().iter().fold([0.0; 2], |most: [f32; 2], point| {
        let half = point.half_width().max(point.half_height());
        let at = [point.x, point.y];
        [0, 1].map(|axis| most[axis].max(half - at[axis]).max(at[axis] + half - size[axis]))
    })
}
