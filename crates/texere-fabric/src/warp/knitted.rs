//! A warp-knitted cloth: its guide bars, its gauge and its yarns.

use glam::DVec3;
use texere_core::backend::room_for;
use texere_core::{Boundary, ControlPoint, Ends, Layout, Material, Origin, Section, Yarn, YarnPlace, Yarns};

use super::laps::laps;
use super::path::{Cloth, Thread};
use super::{Bar, PlacedLap, check};
use crate::settling::{Look, settled_together};
use crate::weft::{self, Cells, Gauge, KnitYarn};
use crate::{FabricError, Piece, Repeat, StitchPlace, ThreadError};

/// A warp-knitted cloth: guide bars, the distances between loops, and yarns.
///
/// All guides of a bar move alike, except the guides of a Jacquard bar. The laps of all bars repeat
/// after some wales and courses. One such repeat settles, and is then copied.
///
/// ```
/// use texere_core::{Material, Section};
/// use texere_fabric::warp::{Bar, Chain, WarpKnitted};
/// use texere_fabric::weft::{Gauge, KnitYarn};
/// // Locknit of 12 wales and 10 courses.
/// let bars = ["1-0/2-3//", "1-2/1-0//"].map(|chain| Chain::parse(chain, 1).map(Bar::new));
/// let bars = bars.into_iter().collect::<Result<_, _>>()?;
/// let (materials, sections) = (vec![Material::default()], vec![Section::Circle]);
/// let yarns = vec![KnitYarn::new(0.05)];
/// let cloth = WarpKnitted::new(bars, Gauge::new(1.0, 0.75), 4, 2, yarns, materials, sections, [3, 5])?;
/// assert_eq!((cloth.size(), cloth.loops()), ([12, 10], 240));
/// assert_eq!(cloth.yarns()?.layout().yarns().len(), 24);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct WarpKnitted {
    bars: Vec<Bar>,
    gauge: Gauge,
    /// Wales and courses of one of the `copies`.
    lapped: [u32; 2],
    /// The numbers of wales and courses after which the patterns of all bars repeat.
    repeat: [u32; 2],
    yarns: Vec<KnitYarn>,
    materials: Vec<Material>,
    sections: Vec<Section>,
    copies: [u32; 2],
    pub(super) cells: Cells,
}

impl WarpKnitted {
    /// A cloth of `bars`, the front bar first, on `wales` and `courses`, at the distances of
    /// `gauge`. `yarns` are the yarns that threadings refer to. Yarns refer to `materials` and
    /// `sections` by index. `copies` is the number of copies along x and y of these wales and
    /// courses. The loop length of the gauge has no effect, because run-ins give the lengths of a
    /// warp knit.
    ///
    /// **Errors**: [`WarpError`](crate::warp::WarpError) for bars that are not valid or make no
    /// loop, for wales and courses in which the bars do not repeat evenly, and for too many laps.
    /// [`WeftError`](crate::weft::WeftError) for distances that no cloth has, no copy, underlaps
    /// that are too long, and too many wales, courses, control points or copies. [`ThreadError`]
    /// for a yarn's radius, twist, material or section.
    #[allow(clippy::too_many_arguments, reason = "each is a fact of its own about the cloth")]
    pub fn new(
        bars: Vec<Bar>,
        gauge: Gauge,
        wales: u32,
        courses: u32,
        yarns: Vec<KnitYarn>,
        materials: Vec<Material>,
        sections: Vec<Section>,
        copies: [u32; 2],
    ) -> Result<Self, FabricError> {
        weft::check::gauge(&gauge)?;
        weft::check::yarns(&yarns, |number| check::first_guide(&bars, number), &materials, &sections)?;
        check::bars(&bars, yarns.len())?;
        let lapped = [wales, courses];
        let repeat = check::repeat(&bars, lapped)?;
        check::size(&bars, repeat, lapped, copies)?;
        Ok(Self { bars, gauge, lapped, repeat, yarns, materials, sections, copies, cells: Cells::Round })
    }

    /// The laps of all threaded guides, bar by bar, guide by guide and course by course. The laps
    /// are those of one copy, [`WarpKnitted::lapped_size`], and repeat beyond its edges.
    ///
    /// ```
    /// use texere_core::{Material, Section};
    /// use texere_fabric::warp::{Bar, Chain, WarpKnitted};
    /// use texere_fabric::weft::{Gauge, KnitYarn};
    /// let bars = vec![Bar::new(Chain::parse("1-0/1-2//", 1)?)];
    /// let (materials, sections) = (vec![Material::default()], vec![Section::Circle]);
    /// let yarns = vec![KnitYarn::new(0.05)];
    /// let cloth = WarpKnitted::new(bars, Gauge::new(1.0, 0.75), 4, 2, yarns, materials, sections, [1, 1])?;
    /// let laps: Vec<_> = cloth.laps().map(|placed| (placed.guide, placed.course, placed.lap.needle())).collect();
    /// assert_eq!(laps[..4], [(0, 0, 0), (0, 1, 1), (1, 0, 1), (1, 1, 2)]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn laps(&self) -> impl Iterator<Item = PlacedLap> + '_ {
        let [wales, courses] = self.lapped_size();
        laps(self.bars(), wales, courses)
    }

    /// Gives every yarn the same section.
    ///
    /// **Errors**: [`ThreadError::Section`] if the section's numbers are not valid. After an error
    /// the cloth is unchanged.
    pub fn set_section(&mut self, section: Section) -> Result<(), ThreadError> {
        section.validate().map_err(|source| ThreadError::Section { section: 0, source })?;
        self.sections = vec![section];
        self.yarns.iter_mut().for_each(|yarn| yarn.section = 0);
        Ok(())
    }

    /// Changes the number of control points of each lap. [`Cells::Even`] has 9 for each loop and
    /// none for underlaps. Plain repeats come to rest with [`Cells::Even`], too. A Jacquard may
    /// not, because its underlaps turn too sharply.
    #[must_use]
    pub fn with_cells(mut self, cells: Cells) -> Self {
        self.cells = cells;
        self
    }

    /// The number of control points of each lap.
    #[must_use]
    pub const fn cells(&self) -> Cells {
        self.cells
    }

    /// The guide bars, the front one first.
    #[must_use]
    pub fn bars(&self) -> &[Bar] {
        &self.bars
    }

    /// The distances between wales and between courses.
    #[must_use]
    pub const fn gauge(&self) -> &Gauge {
        &self.gauge
    }

    /// The yarns that guides hold.
    #[must_use]
    pub fn guide_yarns(&self) -> &[KnitYarn] {
        &self.yarns
    }

    /// The materials that yarns refer to.
    #[must_use]
    pub fn materials(&self) -> &[Material] {
        &self.materials
    }

    /// The sections that yarns refer to.
    #[must_use]
    pub fn sections(&self) -> &[Section] {
        &self.sections
    }

    /// Copies along x and y.
    #[must_use]
    pub const fn copies(&self) -> [u32; 2] {
        self.copies
    }

    /// Wales and courses of one of the [`WarpKnitted::copies`].
    #[must_use]
    pub const fn lapped_size(&self) -> [u32; 2] {
        self.lapped
    }

    /// The numbers of wales and courses after which the patterns of all bars repeat.
    pub(crate) const fn repeat_size(&self) -> [u32; 2] {
        self.repeat
    }

    /// One smallest repeat of the cloth, copied `copies` times along x and y.
    ///
    /// **Errors**: the errors of [`WarpKnitted::new`] for too many copies.
    pub(crate) fn with_copies(&self, copies: [u32; 2]) -> Result<Self, FabricError> {
        let Self { bars, gauge, yarns, materials, sections, .. } = self.clone();
        let [wales, courses] = self.repeat;
        let cloth = Self::new(bars, gauge, wales, courses, yarns, materials, sections, copies)?;
        Ok(Self { cells: self.cells, ..cloth })
    }

    /// Number of wales and of courses in the whole cloth.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        [0, 1].map(|axis| self.lapped[axis] * self.copies[axis])
    }

    /// Width and height of the cloth, mm: wales and courses times their distances. Guides at the
    /// edges may lap beyond this area.
    #[must_use]
    pub fn size_mm(&self) -> [f64; 2] {
        self.mm(self.size())
    }

    /// Number of loops in the whole cloth. A lap round two needles makes two.
    #[must_use]
    pub fn loops(&self) -> u64 {
        let [across, along] = [0, 1].map(|axis| u64::from(self.size()[axis] / self.repeat[axis]));
        let loops = |placed: PlacedLap| u64::from(placed.lap.overlap().unsigned_abs());
        laps(&self.bars, self.repeat[0], self.repeat[1]).map(loops).sum::<u64>() * across * along
    }

    /// The yarns of the whole cloth, as placed before settling. They are ordered by the copies of
    /// [`WarpKnitted::repeat`] from the left, in each copy by bar, and in each bar from the left.
    ///
    /// Needle 0 is half a wale from x = 0. The feet of the first course are at y = 0. Origins are
    /// [`Origin::Guide`], with bars and guides counted from 1. The source of a control point is the
    /// course of its lap, counted from 1.
    ///
    /// **Errors**: [`FabricError::OutOfMemory`], [`FabricError::Yarns`] for yarns that [`Yarns`]
    /// refuses, and [`FabricError::Boundary`] for a repeat that is too long.
    pub fn yarns(&self) -> Result<Yarns, FabricError> {
        let repeat = self.repeat()?;
        self.placed(&repeat, &repeat.piece.yarns, &mut || Ok(()))
    }

    /// The yarns of all copies of a repeat. `yarns` are the repeat's yarns, settled or not. Origins
    /// and sources count guides and courses of the whole cloth.
    pub(crate) fn placed(
        &self,
        repeat: &Repeat,
        yarns: &Yarns,
        look: Look<'_>,
    ) -> Result<Yarns, FabricError> {
        let [wales, courses] = [0, 1].map(|axis| self.size()[axis] / repeat.copies[axis]);
        let origin = |origin, [x, _]: [i64; 2]| match origin {
            Origin::Guide { bar, guide } => Origin::Guide { bar, guide: guide + x as u32 * wales },
            other => other,
        };
        let last = i64::from(self.size()[1]);
        let source =
            |own: u32, [_, y]: [i64; 2]| (i64::from(own) + y * i64::from(courses)).clamp(1, last) as u32;
        self.ended(repeat.placed_as(yarns, self.beyond(), origin, source, look)?)
    }

    /// One repeat of the cloth, with its boundary. See [`WarpKnitted::repeat`].
    ///
    /// **Errors**: the errors of [`WarpKnitted::yarns`].
    pub fn piece(&self) -> Result<Piece, FabricError> {
        Ok(self.repeat()?.piece)
    }

    /// The piece of cloth that settles, and the number of its copies in the whole cloth. The piece
    /// has the wales and courses after which the patterns of all bars repeat. Several small repeats
    /// form one piece. The pattern of a Jacquard bar repeats with its image.
    ///
    /// **Errors**: the errors of [`WarpKnitted::yarns`].
    pub fn repeat(&self) -> Result<Repeat, FabricError> {
        let repeats = [0, 1].map(|axis| self.size()[axis] / self.repeat[axis]);
        let tiles = settled_together(self.repeat, repeats);
        let size = [0, 1].map(|axis| self.repeat[axis] * tiles[axis]);
        Ok(Repeat { piece: self.piece_of(size)?, copies: [0, 1].map(|axis| repeats[axis] / tiles[axis]) })
    }

    /// One repeat of the cloth as the bars give it, with the number of its copies.
    pub(super) fn smallest_repeat(&self) -> Result<Repeat, FabricError> {
        let copies = [0, 1].map(|axis| self.size()[axis] / self.repeat[axis]);
        Ok(Repeat { piece: self.piece_of(self.repeat)?, copies })
    }

    /// The cloth with the gauge of its `yarns` at rest. Bars without a run-in get that of their
    /// yarns.
    #[must_use]
    pub(crate) fn at_rest(self, gauge: Gauge, yarns: &Yarns) -> Self {
        let mut cloth = Self { gauge, ..self };
        let run_ins = cloth.run_ins(yarns);
        for (bar, run_in) in cloth.bars.iter_mut().zip(run_ins).filter(|(_, run_in)| run_in.reached_mm > 0.0)
        {
            bar.run_in_mm.get_or_insert(run_in.reached_mm);
        }
        cloth
    }

    /// The stitch at a place on one of the cloth's yarns. The source of the place gives the course,
    /// and its x gives the wale.
    pub(crate) fn stitch_at(&self, place: &YarnPlace) -> Option<StitchPlace> {
        let wale = (place.position[0] / self.gauge.wale_mm).clamp(0.0, f64::from(self.size()[0].max(1) - 1));
        Some(StitchPlace { wale: wale as u32 + 1, course: place.source? })
    }

    fn piece_of(&self, size: [u32; 2]) -> Result<Piece, FabricError> {
        let cloth = Cloth::new(&self.bars, self.gauge, self.thickest(), size, self.cells)?;
        let threads = cloth.lay()?;
        let total = threads.iter().map(|thread| thread.points.len()).sum();
        let (mut table, mut offsets, mut points, mut sources) = (Vec::new(), vec![0], Vec::new(), Vec::new());
        room_for(&mut points, total, "control points")?;
        room_for(&mut sources, total, "sources")?;
        for Thread { first, points: own, courses } in threads {
            let KnitYarn { radius_mm, material, section, twist } = self.yarns[first.yarn as usize];
            let origin = Origin::Guide { bar: first.bar + 1, guide: first.guide + 1 };
            table.push(Yarn { material, section, closed: false, twist, origin });
            let point = |at: DVec3| ControlPoint::new(at.x as f32, at.y as f32, at.z as f32, radius_mm);
            points.extend(own.into_iter().map(point));
            sources.extend(courses.into_iter().map(|course| course + 1));
            offsets.push(points.len() as u64);
        }
        let ends = vec![Ends::Repeats([0, 1]); table.len()];
        let layout = Layout::new(table, offsets, self.sections.clone())?;
        let yarns = Yarns::new(layout, self.materials.clone(), points)?.with_sources(sources)?;
        let boundary = Boundary::new(yarns.layout(), self.mm(size).map(|mm| mm as f32), ends)?;
        Ok(Piece::new(yarns, boundary))
    }

    /// Diameter of the thickest yarn that a guide holds, mm.
    fn thickest(&self) -> f64 {
        let held = self.bars.iter().flat_map(|bar| bar.threading.guides()).flatten();
        let yarns = held.map(|yarn| self.yarns[*yarn as usize]);
        weft::knitted::thickest(yarns, &self.sections)
    }

    fn mm(&self, [wales, courses]: [u32; 2]) -> [f64; 2] {
        [f64::from(wales) * self.gauge.wale_mm, f64::from(courses) * self.gauge.course_mm]
    }
}
