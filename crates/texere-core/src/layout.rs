//! The layout of yarns: the data of each yarn, and its range of control points.

use std::collections::BTreeMap;
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use glam::Vec3;

use crate::lean::Leaning;
use crate::stand::Stand;
use crate::{ControlPoint, Section, YarnError};

/// A yarn's origin in the structure, counted from 1 as weavers and knitters do.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[non_exhaustive]
pub enum Origin {
    /// Unknown.
    #[default]
    Unknown,
    /// A warp yarn: the end's number from the left.
    End(u32),
    /// A weft yarn: the pick's number from the first one woven.
    Pick(u32),
    /// A weft-knitted yarn: the number of the first course that it knits. Courses are counted
    /// within the repeat, so that copies of a course share a number.
    Course(u32),
    /// A weft-knitted yarn: the number of its carrier.
    Carrier(u32),
    /// A warp-knitted yarn: the numbers of its guide bar and its guide.
    Guide {
        /// Number of the guide bar, 1 in front.
        bar: u32,
        /// Number of the guide within the bar.
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

/// The data of one yarn apart from its control points.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Yarn {
    /// Index into the materials.
    pub material: u32,
    /// Index into the sections.
    pub section: u32,
    /// Whether the last control point is joined to the first.
    pub closed: bool,
    /// Twist, rad per mm along the yarn. Positive is Z twist (right-handed).
    pub twist: f32,
    /// The yarn's origin in the structure.
    pub origin: Origin,
}

impl Yarn {
    /// The least number of control points that the yarn needs.
    pub(crate) const fn points_least(&self) -> u64 {
        if self.closed { 3 } else { 2 }
    }
}

/// The largest twist that is accepted, rad/mm: 159,000 turns per metre, thirty times the hardest
/// sewing thread.
pub const TWIST_LIMIT: f32 = 1e3;

/// Edits of yarns. The key is a yarn's number, counted from 0, and the value its new data and
/// control points.
pub type Edits<'a> = BTreeMap<usize, (Yarn, &'a [ControlPoint])>;

/// The data of yarns on which counts and offsets depend, with the yarns' up directions and the
/// tension of their splines. Positions and materials are in [`Yarns`](crate::Yarns).
#[derive(Debug, Clone, PartialEq)]
pub struct Layout {
    offsets: Vec<u64>,
    yarns: Vec<Yarn>,
    sections: Vec<Section>,
    /// Whether each yarn runs too steeply for upright frames.
    steep: Vec<bool>,
    /// The up directions of the yarns that lean, by the yarns' numbers.
    leaning: BTreeMap<usize, Arc<Leaning>>,
    /// The tension of the splines through the control points.
    tension: f32,
}

impl Layout {
    /// A layout of `yarns`, `offsets` and `sections`. `offsets` holds the start of each yarn's
    /// control points, and the number of all control points last. The [tension](Layout::tension) of
    /// the splines is 0.
    ///
    /// **Errors**: [`YarnError`] for no yarns, a number of offsets that is not one more than that
    /// of yarns, offsets that do not start at 0 or that fall, a yarn of fewer than two control
    /// points (three when closed), an unknown section, a twist that is not finite or beyond
    /// [`TWIST_LIMIT`], and a section with invalid parameters.
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

    /// This layout with splines of another tension.
    ///
    /// **Errors**: [`YarnError::Tension`] outside \[0, 1).
    pub fn with_tension(self, tension: f32) -> Result<Self, YarnError> {
        check_tension(tension)?;
        Ok(Self { tension, ..self })
    }

    /// This layout with one section for all yarns.
    ///
    /// **Errors**: [`YarnError::Section`] for a section with invalid parameters.
    pub fn with_section(mut self, section: Section) -> Result<Self, YarnError> {
        section.validate().map_err(|source| YarnError::Section { section: 0, source })?;
        self.yarns.iter_mut().for_each(|yarn| yarn.section = 0);
        self.sections = vec![section];
        Ok(self)
    }

    /// The tension of the splines through the control points (the paper's u), in \[0, 1). 0 gives
    /// the Catmull-Rom spline. Towards 1, yarns run straight from point to point.
    #[must_use]
    pub const fn tension(&self) -> f32 {
        self.tension
    }

    /// Applies edits, which may change numbers of control points.
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

    /// Whether and how `yarn` is steep or leans.
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

    /// The start of each yarn's control points, and the number of all control points last (the
    /// paper's Ωτ). There is one value more than there are yarns.
    #[must_use]
    pub fn offsets(&self) -> &[u64] {
        &self.offsets
    }

    /// The yarns that own a range of control points. Points past the last are ignored.
    #[must_use]
    pub fn yarns_of(&self, points: Range<u64>) -> Range<usize> {
        let end = points.end.min(self.point_count());
        if points.start >= end {
            return 0..0;
        }
        let yarns_before = |end: u64| self.offsets.partition_point(|&start| start < end);
        yarns_before(points.start + 1) - 1..yarns_before(end)
    }

    /// The part of a range of control points that belongs to one of [its yarns](Layout::yarns_of),
    /// as two ranges: counted from the yarn's first point, and counted from the first point of
    /// `points`.
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

    /// The number of corners of the first polygon among the sections, if there is one. Tubes with a
    /// polygon section need as many [sides](crate::Settings::sides).
    #[must_use]
    pub fn corners(&self) -> Option<u32> {
        self.sections.iter().find_map(|section| match section {
            Section::Polygon(corners) => Some(corners.len() as u32),
            _ => None,
        })
    }

    /// Whether `yarn` runs so steeply somewhere that an upright frame would turn about it by more
    /// than 4 degrees within a control interval. If so, it has the rotation minimising frame
    /// instead. [`Yarns::new`](crate::Yarns::new) works out which yarns are steep. A layout without
    /// control points has no steep yarns. A flattened yarn gets [ups](Layout::ups) instead, and is
    /// steep only if its ups turn over from one control point to the next.
    ///
    /// **Panics** past the last yarn.
    #[must_use]
    pub fn is_steep(&self, yarn: usize) -> bool {
        self.steep[yarn]
    }

    /// Whether any yarn has [up directions](Layout::ups).
    #[must_use]
    pub fn leans(&self) -> bool {
        !self.leaning.is_empty()
    }

    /// The up directions, or *ups*, of the control points of `yarn`, unit vectors. They are
    /// [given](crate::Yarns::with_ups), or worked out for a flattened yarn that is vertical at a
    /// control point, or whose upright frame would turn about the yarn by more than 15 degrees
    /// within a control interval. Ups that are worked out follow the upright frame where it turns
    /// slowly. Near the vertical they are carried along the yarn. `None` for a yarn that stands
    /// upright, for a round yarn without given ups, and past the last yarn.
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

    /// The up directions of `yarn`, with the control points that they belong to.
    pub(crate) fn leaning(&self, yarn: usize) -> Option<&Leaning> {
        self.leaning.get(&yarn).map(|leaning| &**leaning)
    }

    /// The up directions of the yarns that lean, by the yarns' numbers.
    pub(crate) const fn all_leaning(&self) -> &BTreeMap<usize, Arc<Leaning>> {
        &self.leaning
    }

    /// The number of control points of all yarns.
    #[must_use]
    pub fn point_count(&self) -> u64 {
        self.offsets.last().copied().unwrap_or(0)
    }
}

/// Checks a tension of splines.
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
