//! A weft-knitted cloth: its stitches, its gauge and its yarns.

use rayon::prelude::*;
use texere_core::backend::room_for;
use texere_core::{Boundary, ControlPoint, Ends, Layout, Material, Origin, Section, Yarn, Yarns};

use super::layers::Layers;
use super::path::Cloth;
use super::pen::YarnPoints;
use super::shape::Shape;
use super::{Cells, Gauge, KnitYarn, Stitches, Strand, WeftError, check};
use crate::reach::Reach;
use crate::settling::{Look, settled_together};
use crate::{FabricError, POINTS_MAX, Piece, Repeat, ThreadError};

/// A weft-knitted cloth: stitches, the distances between them, and a yarn for each carrier.
#[derive(Debug, Clone)]
pub struct Knitted {
    stitches: Stitches,
    gauge: Gauge,
    yarns: Vec<KnitYarn>,
    materials: Vec<Material>,
    sections: Vec<Section>,
    copies: [u32; 2],
    cells: Cells,
    shape: Shape,
}

impl Knitted {
    /// A cloth of `stitches` at the distances of `gauge`. `yarns` has one yarn for each carrier,
    /// and refers to `materials` and `sections` by index. `copies` is the number of repeats along x
    /// and y. It has no effect if the stitches do not repeat.
    ///
    /// **Errors**: [`WeftError::Gauge`] for distances that no cloth has, [`WeftError::Stitches`]
    /// for stitches that no cloth has, no copy, or too many wales or courses,
    /// [`WeftError::Carrier`] for a carrier without a yarn, [`WeftError::KnitRuns`] for yarns that
    /// run too far between loops, [`WeftError::KnitPoints`] and [`WeftError::KnitRepeat`] for too
    /// many control points, [`WeftError::Copies`] for too many copies that settle as one, and
    /// [`ThreadError`] for a yarn's radius, twist, material or section.
    pub fn new(
        stitches: Stitches,
        gauge: Gauge,
        yarns: Vec<KnitYarn>,
        materials: Vec<Material>,
        sections: Vec<Section>,
        copies: [u32; 2],
    ) -> Result<Self, FabricError> {
        check::gauge(&gauge)?;
        check::yarns(&yarns, |number| Origin::Carrier(number + 1), &materials, &sections)?;
        check::stitches(&stitches, yarns.len())?;
        check::size(&stitches, copies)?;
        let tiles = stitches.repeat.map_or([1, 1], |size| settled_together(size, copies));
        check::tiled(tiles, stitches.loops.len() as u64)?;
        let shape = Shape::new(&gauge, thickest(used(&stitches, &yarns), &sections));
        Ok(Self { stitches, gauge, yarns, materials, sections, copies, cells: Cells::Round, shape })
    }

    /// Gives every yarn the same section.
    ///
    /// **Errors**: [`ThreadError::Section`] if the section's numbers are not valid. After an error
    /// the cloth is unchanged.
    pub fn set_section(&mut self, section: Section) -> Result<(), ThreadError> {
        section.validate().map_err(|source| ThreadError::Section { section: 0, source })?;
        self.sections = vec![section];
        self.yarns.iter_mut().for_each(|yarn| yarn.section = 0);
        self.shape = Shape::new(&self.gauge, thickest(used(&self.stitches, &self.yarns), &self.sections));
        Ok(())
    }

    /// Changes the number of control points of each stitch.
    #[must_use]
    pub fn with_cells(mut self, cells: Cells) -> Self {
        self.cells = cells;
        self
    }

    /// The cloth with another gauge, that of its yarns at rest.
    #[must_use]
    pub(crate) fn with_gauge(self, gauge: Gauge) -> Self {
        let shape = Shape::new(&gauge, thickest(used(&self.stitches, &self.yarns), &self.sections));
        Self { gauge, shape, ..self }
    }

    /// The number of control points of each stitch.
    #[must_use]
    pub const fn cells(&self) -> Cells {
        self.cells
    }

    /// The loops, and the order in which each yarn makes them.
    #[must_use]
    pub const fn stitches(&self) -> &Stitches {
        &self.stitches
    }

    /// The distances between wales and between courses, and the length of loops.
    #[must_use]
    pub const fn gauge(&self) -> &Gauge {
        &self.gauge
    }

    /// The yarn of each carrier, by the carrier's index.
    #[must_use]
    pub fn carriers(&self) -> &[KnitYarn] {
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

    /// Copies of the repeat along x and y; \[1, 1\] for a cloth that does not repeat.
    #[must_use]
    pub fn copies(&self) -> [u32; 2] {
        if self.stitches.repeat.is_some() { self.copies } else { [1, 1] }
    }

    /// Wales and courses of the smallest repeat. None for a cloth that does not repeat.
    pub(crate) const fn repeat_size(&self) -> Option<[u32; 2]> {
        self.stitches.repeat
    }

    /// The cloth with another number of copies of its repeat along x and y.
    ///
    /// **Errors**: the errors of [`Knitted::new`] for too many copies.
    pub(crate) fn with_copies(&self, copies: [u32; 2]) -> Result<Self, FabricError> {
        let Self { stitches, gauge, yarns, materials, sections, .. } = self.clone();
        Ok(Self::new(stitches, gauge, yarns, materials, sections, copies)?.with_cells(self.cells))
    }

    /// Number of wales and of courses in the whole cloth.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        match self.stitches.repeat {
            Some(repeat) => [0, 1].map(|axis| repeat[axis] * self.copies[axis]),
            None => {
                let (left, right) = extent(&self.stitches);
                let courses = self.stitches.loops.iter().map(|stitch| stitch.course + 1).max();
                // Needles of a bed that is racked by half a needle add no wale.
                [(right - left).floor() as u32 + 1, courses.unwrap_or(0)]
            }
        }
    }

    /// Width and height of the cloth, mm: wales and courses times their distances. The heads of the
    /// last course reach beyond this area.
    #[must_use]
    pub fn size_mm(&self) -> [f64; 2] {
        let [wales, courses] = self.size().map(f64::from);
        [wales * self.gauge.wale_mm, courses * self.gauge.course_mm]
    }

    /// The yarns of the whole cloth, as placed before settling.
    ///
    /// The middle of the first wale is half a wale from x = 0. The feet of the first course are at
    /// y = 0. A yarn that goes on from repeat to repeat has the origin [`Origin::Course`]; a yarn
    /// that a carrier brings in and takes out has [`Origin::Carrier`]. The source of a control
    /// point is the source of the operation that made its stitch or float.
    ///
    /// **Errors**: [`FabricError::OutOfMemory`], [`WeftError::KnitPoints`], [`FabricError::Yarns`]
    /// for yarns that [`Yarns`] refuses, and [`FabricError::Boundary`] for a repeat that is too
    /// long.
    pub fn yarns(&self) -> Result<Yarns, FabricError> {
        let repeat = self.repeat()?;
        self.placed(&repeat, &repeat.piece.yarns, &mut || Ok(()))
    }

    /// The yarns of all copies of a repeat. `yarns` are the repeat's yarns, settled or not. A yarn
    /// that goes on from repeat to repeat is cut three control points beyond the cloth at both
    /// ends, unless the cloth has [`Cells::Even`]. The third point lies in a leg, which runs
    /// straight there. The cut end therefore bends as it does in the repeat, and touches nothing.
    pub(crate) fn placed(
        &self,
        repeat: &Repeat,
        yarns: &Yarns,
        look: Look<'_>,
    ) -> Result<Yarns, FabricError> {
        repeat.placed_as(yarns, self.beyond(), |origin, _| origin, |source, _| source, look)
    }

    /// Number of control points by which a repeat's yarns go on beyond all copies, at their
    /// beginning and at their end.
    pub(super) const fn beyond(&self) -> [u32; 2] {
        match self.cells {
            Cells::Round => [3, 3],
            Cells::Even => [0, 0],
        }
    }

    /// One repeat of the cloth, with its boundary and its pinned points. If the stitches do not
    /// repeat, it is the whole cloth. See [`Knitted::repeat`].
    ///
    /// **Errors**: the errors of [`Knitted::yarns`].
    pub fn piece(&self) -> Result<Piece, FabricError> {
        Ok(self.repeat()?.piece)
    }

    /// The piece of cloth that settles, and the number of its copies in the whole cloth.
    ///
    /// A cloth that repeats settles as one repeat that goes on at all its edges. Several small
    /// repeats form one piece. A cloth that does not repeat settles as a whole. Some of its points
    /// are pinned: the ends of its yarns, the arcs between loops of its first course, and the heads
    /// of loops that hang on needles when the program ends.
    ///
    /// **Errors**: the errors of [`Knitted::yarns`].
    pub fn repeat(&self) -> Result<Repeat, FabricError> {
        let Some(size) = self.stitches.repeat else {
            return Ok(Repeat { piece: self.piece_of(&self.stitches)?, copies: [1, 1] });
        };
        let tiles = settled_together(size, self.copies);
        let copies = [0, 1].map(|axis| self.copies[axis] / tiles[axis]);
        Ok(Repeat { piece: self.piece_of(&self.stitches.tiled(tiles))?, copies })
    }

    /// One repeat of the cloth as the stitches give it, with the number of its copies. None for a
    /// cloth that does not repeat.
    pub(super) fn smallest_repeat(&self) -> Result<Option<Repeat>, FabricError> {
        if self.stitches.repeat.is_none() {
            return Ok(None);
        }
        Ok(Some(Repeat { piece: self.piece_of(&self.stitches)?, copies: self.copies }))
    }

    fn piece_of(&self, stitches: &Stitches) -> Result<Piece, FabricError> {
        let layers = Layers::new(stitches)?;
        let left = if stitches.repeat.is_some() { 0.0 } else { extent(stitches).0 };
        let cloth = Cloth { stitches, layers: &layers, shape: &self.shape, left, kind: self.cells };
        let placed: Vec<YarnPoints> = (0..stitches.strands.len())
            .into_par_iter()
            .map(|strand| cloth.lay(strand))
            .collect::<Result<_, _>>()?;
        let total = placed.iter().map(|placed| placed.points.len()).sum();
        let (mut table, mut offsets, mut ends) = (Vec::new(), vec![0], Vec::new());
        let (mut points, mut sources, mut pinned) = (Vec::new(), Vec::new(), Vec::new());
        room_for(&mut points, total, "control points")?;
        room_for(&mut sources, total, "sources")?;
        for (strand, placed) in stitches.strands.iter().zip(placed) {
            if placed.points.is_empty() {
                continue;
            }
            let yarn = &self.yarns[strand.carrier as usize];
            let origin = match strand.onward {
                Some(_) => Origin::Course(first_course(stitches, strand) + 1),
                None => Origin::Carrier(strand.carrier + 1),
            };
            let KnitYarn { radius_mm, material, section, twist } = *yarn;
            table.push(Yarn { material, section, closed: false, twist, origin });
            ends.push(strand.onward.map_or(Ends::Open, Ends::Repeats));
            pinned.extend(placed.pinned.iter().map(|pin| pin + points.len() as u64));
            let point =
                |at: &glam::DVec3| ControlPoint::new(at.x as f32, at.y as f32, at.z as f32, radius_mm);
            points.extend(placed.points.iter().map(point));
            sources.extend(placed.sources);
            offsets.push(points.len() as u64);
        }
        if points.len() as u64 > POINTS_MAX {
            return Err(WeftError::KnitPoints { points: points.len() as u64, limit: POINTS_MAX }.into());
        }
        let layout = Layout::new(table, offsets, self.sections.clone())?;
        let yarns = Yarns::new(layout, self.materials.clone(), points)?.with_sources(sources)?;
        let size = stitches.repeat.unwrap_or([0, 0]).map(f64::from);
        let size = [size[0] * self.gauge.wale_mm, size[1] * self.gauge.course_mm].map(|mm| mm as f32);
        let boundary = Boundary::new(yarns.layout(), size, ends)?;
        Ok(Piece { yarns, boundary, pinned })
    }
}

/// The yarn of each strand.
fn used<'a>(stitches: &'a Stitches, yarns: &'a [KnitYarn]) -> impl Iterator<Item = KnitYarn> + 'a {
    stitches.strands.iter().map(|strand| yarns[strand.carrier as usize])
}

/// Diameter of the thickest of `yarns`, mm.
pub(crate) fn thickest(yarns: impl Iterator<Item = KnitYarn>, sections: &[Section]) -> f64 {
    let half = |yarn: KnitYarn| {
        let [width, height] = Reach::new(&sections[yarn.section as usize]).room(yarn.twist);
        yarn.radius_mm * width.max(height)
    };
    2.0 * f64::from(yarns.map(half).fold(0.0, f32::max))
}

/// The places of the leftmost and of the rightmost needle that any yarn comes to, in wales.
pub(super) fn extent(stitches: &Stitches) -> (f32, f32) {
    let steps = stitches.strands.iter().flat_map(|strand| &strand.steps);
    let places =
        stitches.loops.iter().map(|stitch| stitch.at).chain(steps.map(|step| stitches.visit(step).at));
    places.fold((f32::INFINITY, f32::NEG_INFINITY), |(left, right), at| (left.min(at), right.max(at)))
}

pub(super) fn first_course(stitches: &Stitches, strand: &Strand) -> u32 {
    strand.steps.first().map_or(0, |step| stitches.visit(step).course)
}
