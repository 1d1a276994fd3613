//! One repeat of a cloth, and its copies side by side.

use std::ops::Range;

use texere_core::backend::room_for;
use texere_core::{ControlPoint, Ends, Layout, Origin, Yarn, YarnError, Yarns};

use super::Piece;
use super::look::Look;
use crate::FabricError;

/// The fewest wales, and the fewest courses, of a piece that settles, unless the cloth itself has
/// fewer. In a piece of this size, the neighbour of a stitch across the seam between two repeats is
/// another stitch, and not a copy of the stitch itself. With half the value,
/// `run_ins_are_asked_for_and_measured` is red; with twice, `jacquards_displace_single_guides`.
const SETTLED: u32 = 4;

/// Number of control points that are copied between two calls of the function that asks whether to
/// go on. Copying them takes a slow core some 5 ms.
const LOOK_POINTS: usize = 1 << 18;

/// A cloth made of copies of one repeat. The repeat settles once, and is then copied.
///
/// ```
/// use texere_core::{Boundary, ControlPoint, Ends, Yarn, Yarns};
/// use texere_fabric::{Piece, Repeat};
/// // A thread that crosses a repeat of 2 mm along x, and goes on in the next one.
/// let mut yarns = Yarns::builder();
/// yarns.yarn(Yarn::default(), &[0.0, 0.5, 1.0, 1.5].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
/// let yarns = yarns.build()?;
/// let boundary = Boundary::new(yarns.layout(), [2.0, 0.5], vec![Ends::Repeats([1, 0])])?;
/// let repeat = Repeat { piece: Piece::new(yarns, boundary), copies: [3, 2] };
/// // Three copies along x make one yarn. Two such yarns lie half a millimetre apart.
/// let cloth = repeat.placed(&repeat.piece.yarns)?;
/// assert_eq!(cloth.layout().offsets(), [0, 12, 24]);
/// assert_eq!((cloth.points()[11].x, cloth.points()[23].y), (5.5, 0.5));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Repeat {
    /// The yarns of one repeat, and how they go on at its edges.
    pub piece: Piece,
    /// Number of copies along x and along y.
    pub copies: [u32; 2],
}

impl Repeat {
    /// The repeat with another [tension](texere_core::Layout::tension) of the splines through its
    /// control points.
    ///
    /// **Errors**: [`YarnError::Tension`] outside \[0, 1).
    pub fn with_tension(mut self, tension: f32) -> Result<Self, YarnError> {
        self.piece.yarns = self.piece.yarns.with_tension(tension)?;
        Ok(self)
    }

    /// All copies of the repeat, placed side by side. `yarns` are the yarns of [`Repeat::piece`],
    /// settled or not.
    ///
    /// A yarn that goes on from one repeat to the next becomes one yarn through all copies. It is
    /// cut off at the last control point of its last round. The first and the last interval of the
    /// yarn lack the neighbour that bends them in the repeat, and may come nearer to other yarns.
    /// All other yarns are copied one by one. Yarns are ordered by the copy in which they begin:
    /// row by row from below, and from the left within a row. Materials, sections, tension, origins
    /// and sources are those of the repeat.
    ///
    /// **Errors**: [`FabricError::OtherYarns`] for yarns with other numbers of control points than
    /// the piece's, [`FabricError::OutOfMemory`], and [`FabricError::Yarns`] if there is no copy,
    /// or if coordinates would lie too far out.
    pub fn placed(&self, yarns: &Yarns) -> Result<Yarns, FabricError> {
        self.placed_beyond(yarns, [0, 0])
    }

    /// [`Repeat::placed`] with longer yarns: a yarn that is cut off where the copies end goes on
    /// for `beyond` more control points at its beginning and at its end. The yarn within the copies
    /// then bends as in the repeat.
    ///
    /// **Errors**: the errors of [`Repeat::placed`].
    pub fn placed_beyond(&self, yarns: &Yarns, beyond: [u32; 2]) -> Result<Yarns, FabricError> {
        self.placed_as(yarns, beyond, |origin, _| origin, |source, _| source, &mut || Ok(()))
    }

    /// [`Repeat::placed_beyond`] with other origins and sources for each copy. `origin` and
    /// `source` get an origin or a source of the repeat, and the place of the copy in repeats along
    /// x and y. They return the origin or the source in the copy. `look` is called after about
    /// every [`LOOK_POINTS`] control points.
    pub(crate) fn placed_as(
        &self,
        yarns: &Yarns,
        beyond: [u32; 2],
        origin: impl Fn(Origin, [i64; 2]) -> Origin,
        source: impl Fn(u32, [i64; 2]) -> u32,
        look: Look<'_>,
    ) -> Result<Yarns, FabricError> {
        let (layout, boundary) = (yarns.layout(), &self.piece.boundary);
        if layout.offsets() != self.piece.yarns.layout().offsets() {
            let planned = self.piece.yarns.layout().point_count();
            return Err(FabricError::OtherYarns { points: layout.point_count(), planned });
        }
        let copies = u64::from(self.copies[0]) * u64::from(self.copies[1]);
        let ends = (u64::from(beyond[0]) + u64::from(beyond[1])) * layout.yarns().len() as u64;
        let total = usize::try_from(u128::from(copies) * u128::from(layout.point_count() + ends));
        let total = total.unwrap_or(usize::MAX);
        let (mut table, mut offsets) = (Vec::new(), vec![0]);
        let (mut points, mut sources, mut looked) = (Vec::new(), Vec::new(), 0);
        room_for(&mut points, total, "control points")?;
        if yarns.sources().is_some() {
            room_for(&mut sources, total, "sources")?;
        }
        for (cell, yarn) in
            self.cells().flat_map(|cell| (0..layout.yarns().len()).map(move |yarn| (cell, yarn)))
        {
            let onward = match boundary.ends()[yarn] {
                Ends::Open | Ends::Closed => None,
                Ends::Repeats(onward) => Some(onward.map(i64::from)),
            };
            if onward.is_some_and(|onward| self.holds([cell[0] - onward[0], cell[1] - onward[1]])) {
                // The yarn has begun in another copy, and this copy is a later round of it.
                continue;
            }
            let next = |cell: &[i64; 2]| onward.map(|onward| [cell[0] + onward[0], cell[1] + onward[1]]);
            if points.len() >= looked + LOOK_POINTS {
                look()?;
                looked = points.len();
            }
            let range = yarns.range(yarn).unwrap_or_default();
            let mut lay = |round: [i64; 2], part: Range<usize>| {
                let [x, y] = [0, 1].map(|axis| round[axis] as f64 * f64::from(boundary.repeat()[axis]));
                points.extend(yarns.points()[part.clone()].iter().map(|point| {
                    let at = |own: f32, moved: f64| (f64::from(own) + moved) as f32;
                    ControlPoint { x: at(point.x, x), y: at(point.y, y), ..*point }
                }));
                if let Some(all) = yarns.sources() {
                    sources.extend(all[part].iter().map(|own| source(*own, round)));
                }
            };
            let ([mut before, mut beyond], length) =
                (beyond.map(|points| points as usize), range.len().max(1));
            if let Some(onward) = onward {
                for rounds in (1..=before.div_ceil(length)).rev() {
                    let own = before - (rounds - 1) * length;
                    let round = [0, 1].map(|axis| cell[axis] - rounds as i64 * onward[axis]);
                    lay(round, range.end - own..range.end);
                    before -= own;
                }
            }
            let mut last = cell;
            for round in std::iter::successors(Some(cell), next).take_while(|cell| self.holds(*cell)) {
                lay(round, range.clone());
                last = round;
            }
            while let Some(after) = next(&last).filter(|_| beyond > 0) {
                let own = beyond.min(length);
                lay(after, range.start..range.start + own);
                (last, beyond) = (after, beyond - own);
            }
            let own = layout.yarns()[yarn];
            table.push(Yarn { origin: origin(own.origin, cell), ..own });
            offsets.push(points.len() as u64);
        }
        look()?;
        let placed =
            Layout::new(table, offsets, layout.sections().to_vec())?.with_tension(layout.tension())?;
        let placed = Yarns::new(placed, yarns.materials().to_vec(), points)?;
        Ok(if yarns.sources().is_some() { placed.with_sources(sources)? } else { placed })
    }

    /// The places of all copies, in repeats along x and y.
    fn cells(&self) -> impl Iterator<Item = [i64; 2]> {
        let [across, along] = self.copies.map(i64::from);
        (0..along).flat_map(move |y| (0..across).map(move |x| [x, y]))
    }

    fn holds(&self, cell: [i64; 2]) -> bool {
        cell.iter().zip(self.copies).all(|(at, copies)| (0..i64::from(copies)).contains(at))
    }
}

/// Number of repeats of a knit that settle together along x and along y. One repeat has `size`
/// wales and courses, and there are `copies` of it.
pub(crate) fn settled_together(size: [u32; 2], copies: [u32; 2]) -> [u32; 2] {
    [0, 1].map(|axis| tiles(size[axis], copies[axis]))
}

/// The smallest number of repeats along one axis that divides `copies`, and that has at least
/// [`SETTLED`] wales or courses in all. One repeat has `size` of them. If no number up to 16 fits,
/// the result is `copies`.
fn tiles(size: u32, copies: u32) -> u32 {
    let divides = |tiles: &u32| copies.is_multiple_of(*tiles) && tiles.saturating_mul(size) >= SETTLED;
    (1..=copies.min(SETTLED * SETTLED)).find(divides).unwrap_or(copies)
}
