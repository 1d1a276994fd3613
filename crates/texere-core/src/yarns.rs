//! The yarns of a fabric: flat control points, offsets, and what belongs to each yarn.

mod error;

use std::collections::BTreeMap;
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use glam::Vec3;
use rayon::prelude::*;

use crate::backend::Edits;
use crate::lean::Leaning;
use crate::stand::Stand;
use crate::{COORDINATE_LIMIT, ControlPoint, HAIRINESS_LIMIT, Material, RADIUS_MAX, RADIUS_MIN, Section};

pub use self::error::YarnError;

/// Where in the structure a yarn comes from, counted from 1 as weavers and knitters do.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[non_exhaustive]
pub enum Origin {
    /// Not said.
    #[default]
    Unknown,
    /// A warp yarn: the end's number from the left.
    End(u32),
    /// A weft yarn: the pick's number from the first one woven.
    Pick(u32),
    /// A weft-knitted yarn: the first course that it knits, counted in the repeat, so that copies
    /// of a course share a number.
    Course(u32),
    /// A weft-knitted yarn: its carrier.
    Carrier(u32),
    /// A warp-knitted yarn.
    Guide {
        /// Guide bar, 1 in front.
        bar: u32,
        /// Guide within the bar.
        guide: u32,
    },
}

impl fmt::Display for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown => write!(f, "yarn"),
            Self::End(end) => write!(f, "end {end}"),
            Self::Pick(pick) => write!(f, "pick {pick}"),
            Self::Course(course) => write!(f, "course {course}"),
            Self::Carrier(carrier) => write!(f, "carrier {carrier}"),
            Self::Guide { bar, guide } => write!(f, "guide bar {bar}, guide {guide}"),
        }
    }
}

/// What belongs to one yarn beside its control points.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Yarn {
    /// Index into the materials.
    pub material: u32,
    /// Index into the sections.
    pub section: u32,
    /// Whether the last control point joins up with the first.
    pub closed: bool,
    /// Twist, rad per mm along the yarn; positive is Z twist (right-handed).
    pub twist: f32,
    /// Where the yarn comes from.
    pub origin: Origin,
}

impl Yarn {
    /// The fewest control points that make a yarn.
    pub(crate) const fn points_least(&self) -> u64 {
        if self.closed { 3 } else { 2 }
    }
}

/// The steepest twist that is taken, rad/mm: 159,000 turns per metre, thirty times the hardest
/// sewing thread.
pub const TWIST_LIMIT: f32 = 1e3;

/// Everything about the yarns that decides counts and offsets, and how their splines run between
/// control points: all but positions and colours.
#[derive(Debug, Clone, PartialEq)]
pub struct Layout {
    offsets: Vec<u64>,
    yarns: Vec<Yarn>,
    sections: Vec<Section>,
    /// Which yarns run too steeply for upright frames.
    steep: Vec<bool>,
    /// How yarns lean that do, by their numbers.
    leaning: BTreeMap<usize, Arc<Leaning>>,
    /// Tension of the splines through the control points.
    tension: f32,
}

impl Layout {
    /// A layout of `yarns`, `offsets` (where each yarn's control points start, and their total
    /// last) and `sections`. The [tension](Layout::tension) of their splines is 0.
    ///
    /// **Errors**: [`YarnError`] for offsets that are not increasing prefix sums, a yarn of fewer
    /// than two control points (three when closed), an unknown section, a twist that is not finite
    /// or beyond [`TWIST_LIMIT`], a section with invalid parameters.
    pub fn new(yarns: Vec<Yarn>, offsets: Vec<u64>, sections: Vec<Section>) -> Result<Self, YarnError> {
        if yarns.is_empty() {
            return Err(YarnError::NoYarns);
        }
        if offsets.len() != yarns.len() + 1 {
            return Err(YarnError::OffsetCount { offsets: offsets.len(), yarns: yarns.len() });
        }
        if offsets[0] != 0 {
            return Err(YarnError::OffsetOrder { yarn: 0, start: 0, end: offsets[0] });
        }
        for (section, shape) in sections.iter().enumerate() {
            shape.validate().map_err(|source| YarnError::Section { section, source })?;
        }
        for (index, yarn) in yarns.iter().enumerate() {
            let (start, end) = (offsets[index], offsets[index + 1]);
            if end < start {
                return Err(YarnError::OffsetOrder { yarn: index, start, end });
            }
            let (points, least) = (end - start, yarn.points_least());
            if points < least {
                return Err(YarnError::TooFewPoints { yarn: index, points, least, closed: yarn.closed });
            }
            if yarn.section as usize >= sections.len() {
                return Err(YarnError::UnknownSection {
                    yarn: index,
                    section: yarn.section,
                    sections: sections.len(),
                });
            }
            if !(-TWIST_LIMIT..=TWIST_LIMIT).contains(&yarn.twist) {
                return Err(YarnError::Twist { yarn: index, twist: yarn.twist, limit: TWIST_LIMIT });
            }
        }
        let steep = vec![false; yarns.len()];
        Ok(Self { offsets, yarns, sections, steep, leaning: BTreeMap::new(), tension: 0.0 })
    }

    /// The layout with splines of another tension.
    ///
    /// **Errors**: [`YarnError::Tension`] outside \[0, 1).
    pub fn with_tension(self, tension: f32) -> Result<Self, YarnError> {
        check_tension(tension)?;
        Ok(Self { tension, ..self })
    }

    /// Tension of the splines through the control points (the paper's u), in \[0, 1): 0 is the
    /// Catmull-Rom spline, and towards 1 yarns run straight from point to point.
    #[must_use]
    pub const fn tension(&self) -> f32 {
        self.tension
    }

    /// Makes yarns others, each of another number of control points.
    pub(crate) fn edit(&mut self, edits: &Edits<'_>) {
        let mut start = 0;
        for yarn in 0..self.yarns.len() {
            let end = self.offsets[yarn + 1];
            let mut points = end - start;
            if let Some((what, own)) = edits.get(&yarn) {
                (self.yarns[yarn], points) = (*what, own.len() as u64);
            }
            self.offsets[yarn + 1] = self.offsets[yarn] + points;
            start = end;
        }
    }

    /// How `yarn` stands.
    pub(crate) fn stand(&self, yarn: usize) -> Stand {
        Stand { steep: self.steep[yarn], leaning: self.leaning.get(&yarn).cloned() }
    }

    pub(crate) fn set_stand(&mut self, yarn: usize, Stand { steep, leaning }: Stand) {
        self.steep[yarn] = steep;
        match leaning {
            Some(leaning) => self.leaning.insert(yarn, leaning),
            None => self.leaning.remove(&yarn),
        };
    }

    /// Where each yarn's control points start, and their total last (the paper's Ωτ): yarns + 1
    /// values.
    #[must_use]
    pub fn offsets(&self) -> &[u64] {
        &self.offsets
    }

    /// The yarns that a range of control points belongs to. Points past the last are left out.
    #[must_use]
    pub fn yarns_of(&self, points: Range<u64>) -> Range<usize> {
        let end = points.end.min(self.point_count());
        if points.start >= end {
            return 0..0;
        }
        let yarns_before = |end: u64| self.offsets.partition_point(|&start| start < end);
        yarns_before(points.start + 1) - 1..yarns_before(end)
    }

    /// Where a range of control points meets one of [its yarns](Layout::yarns_of): counted from the
    /// yarn's first point, and from the range's first.
    ///
    /// **Panics** past the last yarn, and for a yarn that the range does not touch.
    #[must_use]
    pub fn points_of(&self, yarn: usize, points: &Range<u64>) -> [Range<usize>; 2] {
        let (start, end) = (self.offsets[yarn], self.offsets[yarn + 1]);
        let (from, to) = (start.max(points.start), end.min(points.end));
        [start, points.start].map(|first| (from - first) as usize..(to - first) as usize)
    }

    /// The yarns.
    #[must_use]
    pub fn yarns(&self) -> &[Yarn] {
        &self.yarns
    }

    /// The sections that yarns refer to.
    #[must_use]
    pub fn sections(&self) -> &[Section] {
        &self.sections
    }

    /// How many corners the first polygon among the sections has, if any is one: tubes of a polygon
    /// have as many [sides](crate::Settings::sides).
    #[must_use]
    pub fn corners(&self) -> Option<u32> {
        self.sections.iter().find_map(|section| match section {
            Section::Polygon(corners) => Some(corners.len() as u32),
            _ => None,
        })
    }

    /// Whether `yarn` runs so steeply somewhere that an upright frame would turn about it by more
    /// than [`UPRIGHT_TURN`](crate::definitions::UPRIGHT_TURN) within a control interval.
    /// [`Yarns::new`] finds it out; a layout without control points has no steep yarns. A flattened
    /// yarn gets [ups](Layout::ups) instead, and is steep only where ups turn over from one control
    /// point to the next.
    ///
    /// **Panics** past the last yarn.
    #[must_use]
    pub fn is_steep(&self, yarn: usize) -> bool {
        self.steep[yarn]
    }

    /// Whether any yarn has [up directions](Layout::ups) that it stands by.
    #[must_use]
    pub fn leans(&self) -> bool {
        !self.leaning.is_empty()
    }

    /// The up directions that the control points of `yarn` stand by, of length 1: [their
    /// own](Yarns::with_ups), or those that a flattened yarn gets whose upright frame would turn
    /// about it by more than 15 degrees within a control interval. These hold to the upright frame
    /// where that turns slowly, and are carried along near the vertical. None of a yarn that stands
    /// upright, or that is round and has no own ones, and past the last yarn.
    ///
    /// ```
    /// use texere_core::{ControlPoint, Yarn, Yarns};
    /// // A ribbon that goes along x, then down and a little back: its height turns along, from z to x.
    /// let mut yarns = Yarns::builder();
    /// let places = [[0.0, 0.0], [1.0, 0.0], [2.0, -0.2], [2.5, -1.0], [2.4, -2.0], [2.3, -3.0]];
    /// yarns.yarn(Yarn::default(), &places.map(|[x, z]| ControlPoint::new(x, 0.0, z, 0.1).flattened(0.2, 0.05)));
    /// let yarns = yarns.build()?;
    /// let ups = yarns.layout().ups(0).unwrap_or_default();
    /// assert!(ups[0].z > 0.99 && ups[5].x > 0.99);
    /// # Ok::<(), texere_core::YarnError>(())
    /// ```
    #[must_use]
    pub fn ups(&self, yarn: usize) -> Option<&[Vec3]> {
        self.leaning(yarn).map(|leaning| &leaning.ups[..])
    }

    /// Those of `yarn`, with their points.
    pub(crate) fn leaning(&self, yarn: usize) -> Option<&Leaning> {
        self.leaning.get(&yarn).map(|leaning| &**leaning)
    }

    /// How yarns lean that do, by their numbers.
    pub(crate) const fn all_leaning(&self) -> &BTreeMap<usize, Arc<Leaning>> {
        &self.leaning
    }

    /// Control points of all yarns together.
    #[must_use]
    pub fn point_count(&self) -> u64 {
        self.offsets.last().copied().unwrap_or(0)
    }
}

/// The yarns of a fabric, checked: the input of every pipeline.
///
/// ```
/// use texere_core::{ControlPoint, Material, Origin, Section, Yarn, Yarns};
/// let mut yarns = Yarns::builder();
/// let cotton = yarns.material(Material::default());
/// let round = yarns.section(Section::Circle);
/// let points = [0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1));
/// yarns.yarn(Yarn { material: cotton, section: round, origin: Origin::Pick(1), ..Yarn::default() }, &points);
/// let yarns = yarns.build()?;
/// assert_eq!(yarns.layout().offsets(), [0, 3]);
/// # Ok::<(), texere_core::YarnError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Yarns {
    layout: Arc<Layout>,
    materials: Arc<[Material]>,
    points: Vec<ControlPoint>,
    ups: Option<Vec<Vec3>>,
    sources: Option<Vec<u32>>,
}

impl Yarns {
    /// Starts an empty set of yarns.
    #[must_use]
    pub fn builder() -> YarnsBuilder {
        YarnsBuilder::default()
    }

    /// Yarns of a layout, its materials and its control points (as many as the layout says, yarn
    /// after yarn).
    ///
    /// **Errors**: [`YarnError`] for a wrong number of points or materials, a hairiness outside
    /// \[0, [`HAIRINESS_LIMIT`]\], and for the first control point that is not finite, lies beyond
    /// [`COORDINATE_LIMIT`], or whose half width or half height is outside \[[`RADIUS_MIN`],
    /// [`RADIUS_MAX`]\].
    pub fn new(
        mut layout: Layout,
        materials: Vec<Material>,
        points: Vec<ControlPoint>,
    ) -> Result<Self, YarnError> {
        if points.len() as u64 != layout.point_count() {
            return Err(YarnError::PointCount { points: points.len() as u64, planned: layout.point_count() });
        }
        check_materials(&layout, &materials)?;
        let yarns = layout.offsets.par_windows(2).zip(&layout.yarns).enumerate();
        let stands = yarns.map(|(number, (bounds, yarn))| {
            let own = &points[bounds[0] as usize..bounds[1] as usize];
            check_points(number, own).map(|()| Stand::of(own, yarn.closed, None))
        });
        // Of several errors the first counts.
        let stands: Vec<_> = stands.collect();
        for (yarn, stand) in stands.into_iter().enumerate() {
            layout.set_stand(yarn, stand?);
        }
        Ok(Self { layout: Arc::new(layout), materials: materials.into(), points, ups: None, sources: None })
    }

    /// Adds where each control point comes from (a crossing, a stitch, a source line): one `u32`
    /// per control point.
    ///
    /// **Errors**: [`YarnError::SourceCount`] when their number differs from that of the control
    /// points.
    pub fn with_sources(mut self, sources: Vec<u32>) -> Result<Self, YarnError> {
        if sources.len() != self.points.len() {
            return Err(YarnError::SourceCount { sources: sources.len(), points: self.points.len() });
        }
        self.sources = Some(sources);
        Ok(self)
    }

    /// The yarns with splines of another [tension](Layout::tension) through their control points,
    /// which stay where they are.
    ///
    /// ```
    /// use texere_core::{ControlPoint, Yarn, Yarns};
    /// # let mut yarns = Yarns::builder();
    /// # let points = [0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1));
    /// # yarns.yarn(Yarn::default(), &points);
    /// # let yarns = yarns.build()?;
    /// assert_eq!(yarns.tension(), 0.0);
    /// let taut = yarns.with_tension(0.3)?;
    /// assert_eq!(taut.tension(), 0.3);
    /// assert!(taut.with_tension(1.0).is_err());
    /// # Ok::<(), texere_core::YarnError>(())
    /// ```
    ///
    /// **Errors**: [`YarnError::Tension`] outside \[0, 1).
    pub fn with_tension(mut self, tension: f32) -> Result<Self, YarnError> {
        check_tension(tension)?;
        if tension.to_bits() != self.tension().to_bits() {
            Arc::make_mut(&mut self.layout).tension = tension;
        }
        Ok(self)
    }

    /// Gives each control point an up direction: where the yarn's height points there, instead of
    /// along z. A cloth that was bent out of its plane has them along its surface's normals, as
    /// [`Yarns::mapped`] gives them. What of it lies along the yarn does not count. Between two
    /// points they go over into one another ([`up_between`](crate::definitions::up_between)).
    ///
    /// ```
    /// use texere_core::{ControlPoint, Yarn, Yarns};
    /// // A ribbon along x that stands on edge: its height points along y.
    /// let mut yarns = Yarns::builder();
    /// let ribbon = [0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1).flattened(0.5, 0.125));
    /// yarns.yarn(Yarn::default(), &ribbon);
    /// let yarns = yarns.build()?.with_ups(vec![[0.0, 1.0, 0.0]; 3])?;
    /// assert_eq!(yarns.ups().map(<[_]>::len), Some(3));
    /// # Ok::<(), texere_core::YarnError>(())
    /// ```
    ///
    /// **Errors**: [`YarnError::UpCount`] for another number than that of the control points,
    /// [`YarnError::Up`] for one that has no direction.
    pub fn with_ups(mut self, ups: Vec<[f32; 3]>) -> Result<Self, YarnError> {
        if ups.len() != self.points.len() {
            return Err(YarnError::UpCount { ups: ups.len(), points: self.points.len() });
        }
        let unit = |(point, up): (usize, &[f32; 3])| {
            let up = Vec3::from_array(*up);
            // One of length 1 but for rounding stays as it is, so that ups which were read are the
            // same to the bit when they are given again.
            let unit = |up: Vec3| {
                let is_unit = (up.length_squared() - 1.0).abs() <= 8.0 * f32::EPSILON;
                if is_unit { Some(up) } else { up.try_normalize() }
            };
            // Once more, for the square of a very short one has few digits, and so its length is
            // only about 1 at first.
            unit(up).and_then(unit).ok_or_else(|| {
                let yarn = self.layout.offsets.partition_point(|&start| start <= point as u64) - 1;
                YarnError::Up { yarn, point: point - self.layout.offsets[yarn] as usize, up: up.to_array() }
            })
        };
        let ups = ups.iter().enumerate().map(unit).collect::<Result<Vec<_>, _>>()?;
        let layout = Arc::make_mut(&mut self.layout);
        let yarns = layout.offsets.par_windows(2).zip(&layout.yarns);
        let stands = yarns.map(|(bounds, yarn)| {
            let own = bounds[0] as usize..bounds[1] as usize;
            Stand::of(&self.points[own.clone()], yarn.closed, Some(&ups[own]))
        });
        let stands: Vec<_> = stands.collect();
        for (yarn, stand) in stands.into_iter().enumerate() {
            layout.set_stand(yarn, stand);
        }
        self.ups = Some(ups);
        Ok(self)
    }

    /// The up direction of each control point, of length 1, where they have [their
    /// own](Yarns::with_ups).
    #[must_use]
    pub fn ups(&self) -> Option<&[Vec3]> {
        self.ups.as_deref()
    }

    /// Counts, offsets, sections, and each yarn's own data.
    #[must_use]
    pub fn layout(&self) -> &Arc<Layout> {
        &self.layout
    }

    /// Tension of the splines through the control points: see [`Layout::tension`].
    #[must_use]
    pub fn tension(&self) -> f32 {
        self.layout.tension
    }

    /// The materials that yarns refer to.
    #[must_use]
    pub fn materials(&self) -> &Arc<[Material]> {
        &self.materials
    }

    /// All control points, yarn after yarn (the paper's τ).
    #[must_use]
    pub fn points(&self) -> &[ControlPoint] {
        &self.points
    }

    /// Where each control point comes from, if the structure gave it.
    #[must_use]
    pub fn sources(&self) -> Option<&[u32]> {
        self.sources.as_deref()
    }

    /// The place of a yarn's control points among all, or `None` past the last yarn.
    #[must_use]
    pub fn range(&self, yarn: usize) -> Option<Range<usize>> {
        let (first, end) = (self.layout.offsets.get(yarn)?, self.layout.offsets.get(yarn + 1)?);
        Some(*first as usize..*end as usize)
    }

    /// A yarn's control points, or `None` past the last yarn.
    #[must_use]
    pub fn yarn_points(&self, yarn: usize) -> Option<&[ControlPoint]> {
        self.points.get(self.range(yarn)?)
    }

    /// Moves one yarn: replaces its control points by as many others.
    ///
    /// **Errors**: [`YarnError`] for an unknown yarn, another number of points, or an invalid
    /// point; the yarns are then as they were.
    pub fn set_points(&mut self, yarn: usize, points: &[ControlPoint]) -> Result<(), YarnError> {
        let range =
            self.range(yarn).ok_or(YarnError::UnknownYarn { yarn, yarns: self.layout.yarns.len() })?;
        if range.len() != points.len() {
            return Err(YarnError::PointCount { points: points.len() as u64, planned: range.len() as u64 });
        }
        check_points(yarn, points)?;
        let ups = self.ups().map(|ups| &ups[range.clone()]);
        let stand = Stand::of(points, self.layout.yarns[yarn].closed, ups);
        if stand != self.layout.stand(yarn) {
            Arc::make_mut(&mut self.layout).set_stand(yarn, stand);
        }
        self.points[range].copy_from_slice(points);
        Ok(())
    }

    /// Replaces the materials: a change of colour that leaves all geometry as it is.
    ///
    /// **Errors**: [`YarnError::UnknownMaterial`] when a yarn refers to one that is missing,
    /// [`YarnError::Hairiness`].
    pub fn set_materials(&mut self, materials: Vec<Material>) -> Result<(), YarnError> {
        check_materials(&self.layout, &materials)?;
        self.materials = materials.into();
        Ok(())
    }
}

fn check_materials(layout: &Layout, materials: &[Material]) -> Result<(), YarnError> {
    for (yarn, each) in layout.yarns.iter().enumerate() {
        if each.material as usize >= materials.len() {
            return Err(YarnError::UnknownMaterial {
                yarn,
                material: each.material,
                materials: materials.len(),
            });
        }
    }
    materials.iter().enumerate().try_for_each(|(material, each)| check_material(material, each))
}

/// Checks material number `material`, whose number is only said in errors.
///
/// **Errors**: [`YarnError::Hairiness`] outside \[0, [`HAIRINESS_LIMIT`]\].
///
/// ```
/// use texere_core::{Material, check_material};
/// assert!(check_material(0, &Material::default()).is_ok());
/// assert!(check_material(0, &Material { hairiness: f32::NAN, ..Material::default() }).is_err());
/// ```
pub fn check_material(material: usize, &Material { hairiness, .. }: &Material) -> Result<(), YarnError> {
    if !(0.0..=HAIRINESS_LIMIT).contains(&hairiness) {
        return Err(YarnError::Hairiness { material, hairiness, limit: HAIRINESS_LIMIT });
    }
    Ok(())
}

/// Checks the tension of yarns' splines.
///
/// **Errors**: [`YarnError::Tension`] outside \[0, 1).
///
/// ```
/// use texere_core::check_tension;
/// assert!(check_tension(0.5).is_ok());
/// assert!(check_tension(f32::NAN).is_err());
/// ```
pub fn check_tension(tension: f32) -> Result<(), YarnError> {
    if (0.0..1.0).contains(&tension) { Ok(()) } else { Err(YarnError::Tension { tension }) }
}

/// Checks the control points of yarn number `yarn`, whose number is only said in errors.
///
/// **Errors**: those of [`Yarns::new`] for the first point that is not sound.
///
/// ```
/// use texere_core::{ControlPoint, check_points};
/// assert!(check_points(0, &[ControlPoint::new(1.0, 2.0, 3.0, 0.1)]).is_ok());
/// assert!(check_points(0, &[ControlPoint::new(f32::NAN, 2.0, 3.0, 0.1)]).is_err());
/// ```
pub fn check_points(yarn: usize, points: &[ControlPoint]) -> Result<(), YarnError> {
    // All points at once, without a branch; the invalid one is looked for only if there is one.
    let within = |value: f32, low: f32, high: f32| (value >= low) & (value <= high);
    let sound = points.iter().fold(true, |sound, point| {
        let placed = [point.x, point.y, point.z].map(|at| within(at, -COORDINATE_LIMIT, COORDINATE_LIMIT));
        sound & placed[0] & placed[1] & placed[2] & point.halves.within_limits()
    });
    if sound {
        return Ok(());
    }
    for (point, each) in points.iter().enumerate() {
        for (field, value) in [("x", each.x), ("y", each.y), ("z", each.z)] {
            if !value.is_finite() {
                return Err(YarnError::NotFinite { yarn, point, field, value });
            }
            if value.abs() > COORDINATE_LIMIT {
                return Err(YarnError::TooFar { yarn, point, field, value, limit: COORDINATE_LIMIT });
            }
        }
        for (field, size) in [("half width", each.half_width()), ("half height", each.half_height())] {
            if size.is_nan() {
                return Err(YarnError::NotFinite { yarn, point, field, value: size });
            }
            let (low, high) = (RADIUS_MIN, RADIUS_MAX);
            if !(low..=high).contains(&size) {
                return Err(YarnError::Size { yarn, point, field, size, low, high });
            }
        }
    }
    Ok(())
}

/// Collects yarns one by one; [`YarnsBuilder::build`] checks them all.
#[derive(Debug, Clone, Default)]
pub struct YarnsBuilder {
    offsets: Vec<u64>,
    yarns: Vec<Yarn>,
    sections: Vec<Section>,
    materials: Vec<Material>,
    points: Vec<ControlPoint>,
    tension: f32,
}

impl YarnsBuilder {
    /// Adds a material and gives its index.
    pub fn material(&mut self, material: Material) -> u32 {
        self.materials.push(material);
        self.materials.len() as u32 - 1
    }

    /// Adds a section and gives its index.
    pub fn section(&mut self, section: Section) -> u32 {
        self.sections.push(section);
        self.sections.len() as u32 - 1
    }

    /// Adds a yarn.
    pub fn yarn(&mut self, yarn: Yarn, points: &[ControlPoint]) -> &mut Self {
        if self.offsets.is_empty() {
            self.offsets.push(0);
        }
        self.yarns.push(yarn);
        self.points.extend_from_slice(points);
        self.offsets.push(self.points.len() as u64);
        self
    }

    /// Sets the [tension](Layout::tension) of all yarns' splines, in \[0, 1): 0 where it is not
    /// set.
    pub const fn tension(&mut self, tension: f32) -> &mut Self {
        self.tension = tension;
        self
    }

    /// Checks everything and gives the yarns. Where no section was added there is the circle, where
    /// no material undyed yarn.
    ///
    /// **Errors**: those of [`Layout::new`], [`Layout::with_tension`] and [`Yarns::new`].
    pub fn build(mut self) -> Result<Yarns, YarnError> {
        if self.sections.is_empty() {
            self.sections.push(Section::Circle);
        }
        if self.materials.is_empty() {
            self.materials.push(Material::default());
        }
        let layout = Layout::new(self.yarns, self.offsets, self.sections)?.with_tension(self.tension)?;
        Yarns::new(layout, self.materials, self.points)
    }
}
