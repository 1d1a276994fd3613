//! The plan: all counts and tables of a settling, made on the host before anything is launched.

use glam::DVec3;

use super::check::{check, limited, mean_diameter, scale, thickest};
use super::length::FREE_MOST;
use super::strand::{BEYOND, SettlingYarn, tag};
use super::{Interval, Length, MARGIN, Place, Scale, Settling, SettlingError};
use crate::backend::zeroed;
use crate::definitions::tangent_factor;
use crate::{BackendError, Ends};

/// The least number of chords of an interval.
const CHORDS_MIN: u32 = 2;

/// The largest mean length of an interval's chords, as a share of the smaller diameter at its ends.
/// With half the value, and with twice,
/// `yarns_that_can_t_be_cut_into_intervals_or_chords_are_refused` is red.
const CHORD_MOST: f32 = 0.6;

/// The most chords of an interval.
const CHORDS_MAX: f32 = 4096.0;

/// The number of chords that yarns may have in addition to [`CHORDS_A_POINT`] for each control
/// point.
const CHORDS_FREE: u64 = 1 << 16;

/// The number of chords that yarns may have for each control point. Usual cloth has 3 to 10 per
/// point, and cables of 12 over 12 loops have 34. Loops with a metre of yarn as thin as 0.1 mm have
/// 1,390, and a settling of 16 such loops took a minute.
const CHORDS_A_POINT: u64 = 256;

/// The number of neighbours that may be listed in addition to [`NEIGHBOURS_A_CHORD`] for each
/// chord.
const NEIGHBOURS_FREE: u64 = 1 << 20;

/// The number of neighbours that may be listed for each chord. Usual cloth has 1 to 6 per chord,
/// and cables of 12 over 12 loops have 32. Cables of 20 over 20, which do not come to rest, have
/// 60. Underlaps over 511 needles of a cloth of four wales have 1,457.
const NEIGHBOURS_A_CHORD: u64 = 32;

/// The margin of the lists of neighbours, in mean diameters. Chords that are further than this from
/// touching are not listed. With half the value, and with twice, no test is red.
pub const SKIN: f32 = 0.2;

/// The most that a chord moves, divided by the longest move of its interval's control points. A
/// place of the spline is a sum of control points, and the sizes of their weights add up to at most
/// 1.25, in the middle of an interval at tension 0.
pub(super) const OVERSHOOT: f32 = 1.25;

/// The counts of a settling.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct SettlingCounts {
    /// Number of control points.
    pub points: u64,
    /// Number of places: those of control points and those beyond yarns' ends.
    pub places: u64,
    /// Number of chords.
    pub chords: u64,
}

/// The counts, tables and places of a settling. Slices have [`SettlingCounts::places`] elements
/// unless their docs state another number.
#[derive(Debug, Clone)]
pub struct SettlingPlan {
    pub(crate) scale: Scale,
    pub(crate) s: f32,
    pub(crate) length: Length,
    pub(crate) plates: Option<f32>,
    pub(crate) passes: u32,
    pub(crate) spans: Spans,
    strands: Vec<SettlingYarn>,
    period: [i32; 2],
    frequency: [f32; 2],
    counts: SettlingCounts,
    tags: Vec<u32>,
    yarns: Vec<u32>,
    chords: Vec<u32>,
    lengths: Vec<f32>,
    along: Vec<[u32; 2]>,
    places: Vec<Place>,
}

/// Lengths that all passes need, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spans {
    /// The mean of the yarns' diameters at all control points.
    pub diameter: f32,
    /// The largest half width or half height of any control point.
    pub thickest: f32,
    /// The unit of [`SettlingPlan::along`], mm.
    pub along: f32,
    /// The length of the longest chord, by the lengths that intervals are to have.
    pub longest_chord: f32,
}

impl SettlingPlan {
    /// Checks a settling and makes its plan.
    ///
    /// **Errors**: [`SettlingError`] for invalid ends, repeats, pins or settings, a yarn of too few
    /// control points or too long for its thickness, a cloth that is too large, and short memory.
    pub fn new(settling: &Settling<'_>) -> Result<Self, SettlingError> {
        let (layout, points) = (settling.layout(), settling.points());
        let yarns = layout.yarns().len();
        check(settling)?;
        let places = layout.point_count() + yarns as u64 * (BEYOND[0] + BEYOND[1]);
        limited("places", places, u64::from(u32::MAX >> 1))?;
        let scale = scale(settling)?;
        let period = settling.boundary.repeat().map(|repeat| scale.units(DVec3::splat(repeat.into())).x);
        let mut strands: Vec<SettlingYarn> = Vec::with_capacity(yarns);
        for (yarn, &ends) in settling.boundary.ends().iter().enumerate() {
            let (start, end) = (layout.offsets()[yarn], layout.offsets()[yarn + 1]);
            let first = (start + yarn as u64 * (BEYOND[0] + BEYOND[1]) + BEYOND[0]) as u32;
            strands.push(SettlingYarn { first, points: (end - start) as u32, ends, length: 0 });
        }
        let s = tangent_factor(layout.tension());
        let spans = Spans {
            diameter: mean_diameter(points),
            thickest: thickest(points),
            along: 0.0,
            longest_chord: 0.0,
        };
        let mut plan = Self {
            scale,
            s,
            length: settling.length,
            plates: settling.plates,
            passes: settling.passes,
            spans,
            strands,
            period,
            frequency: period.map(
                |period| {
                    if period > 0 { 1.0 / (period as f32 * scale.unit()) } else { 0.0 }
                },
            ),
            counts: SettlingCounts { points: layout.point_count(), places, chords: 0 },
            tags: zeroed("what places are", places)?,
            yarns: zeroed("the yarns of places", places)?,
            chords: zeroed("the chords of places", places + 1)?,
            lengths: zeroed("the lengths of intervals", places)?,
            along: Vec::new(),
            places: Vec::new(),
        };
        let mut padded = zeroed("places", places)?;
        plan.pad(points.iter().map(|point| scale.place(point)), &mut padded);
        plan.places = padded;
        plan.tag(layout.offsets(), &settling.pinned);
        plan.measure(settling.length)?;
        plan.check_repeat(settling.boundary.repeat())?;
        Ok(plan)
    }

    /// The counts of the settling.
    #[must_use]
    pub const fn counts(&self) -> SettlingCounts {
        self.counts
    }

    /// Checks that this number of neighbours of all chords may be listed. The limit is several
    /// times what usual cloth has.
    ///
    /// **Errors**: [`BackendError::Crowded`].
    pub fn allow_neighbours(&self, neighbours: u64) -> Result<(), BackendError> {
        let chords = self.counts.chords;
        let limit = (NEIGHBOURS_FREE + NEIGHBOURS_A_CHORD * chords).min(u64::from(u32::MAX));
        if neighbours > limit { Err(BackendError::Crowded { chords, limit }) } else { Ok(()) }
    }

    /// The scale of places.
    #[must_use]
    pub const fn scale(&self) -> &Scale {
        &self.scale
    }

    /// The factor `(1 - tension) / 2` of the spline's tangents.
    #[must_use]
    pub const fn s(&self) -> f32 {
        self.s
    }

    /// The lengths that settling aims for.
    #[must_use]
    pub const fn length(&self) -> Length {
        self.length
    }

    /// The distance of the plates, mm, if there are any.
    #[must_use]
    pub const fn plates(&self) -> Option<f32> {
        self.plates
    }

    /// Lengths that all passes need.
    #[must_use]
    pub const fn spans(&self) -> Spans {
        self.spans
    }

    /// The repeat in x and y, units, 0 for none.
    #[must_use]
    pub const fn period(&self) -> [i32; 2] {
        self.period
    }

    /// Number of repeats per mm along x and y, 0 if nothing repeats.
    #[must_use]
    pub const fn frequency(&self) -> [f32; 2] {
        self.frequency
    }

    /// The places of each yarn. There is one element per yarn.
    #[must_use]
    pub fn strands(&self) -> &[SettlingYarn] {
        &self.strands
    }

    /// The tags of each place: bits of [`tag`].
    #[must_use]
    pub fn tags(&self) -> &[u32] {
        &self.tags
    }

    /// The yarn that each place belongs to.
    #[must_use]
    pub fn yarns(&self) -> &[u32] {
        &self.yarns
    }

    /// The number of the first chord of each place's interval, and the number of all chords last.
    /// There is one value more than there are places.
    #[must_use]
    pub fn chords(&self) -> &[u32] {
        &self.chords
    }

    /// The length that each interval is to have, mm.
    #[must_use]
    pub fn lengths(&self) -> &[f32] {
        &self.lengths
    }

    /// The start and the end of each chord along its yarn, in units of [`Spans::along`]. There is
    /// one element per chord.
    #[must_use]
    pub fn along(&self) -> &[[u32; 2]] {
        &self.along
    }

    /// The places at the start.
    #[must_use]
    pub fn places(&self) -> &[Place] {
        &self.places
    }

    /// Writes `points`, the places of control points, to `places`, with the places beyond yarns'
    /// ends between them.
    pub fn pad(&self, points: impl IntoIterator<Item = Place>, places: &mut [Place]) {
        let mut points = points.into_iter();
        for strand in &self.strands {
            for (place, point) in
                places[strand.first as usize..][..strand.points as usize].iter_mut().zip(&mut points)
            {
                *place = point;
            }
            self.renew_ends(strand, places);
        }
    }

    /// Writes only the places of control points to `points`, from `places` as [`SettlingPlan::pad`]
    /// writes them.
    pub fn unpad(&self, places: &[Place], points: &mut [Place]) {
        let mut own = points;
        for strand in &self.strands {
            let (these, others) = own.split_at_mut(strand.points as usize);
            these.copy_from_slice(&places[strand.first as usize..][..these.len()]);
            own = others;
        }
    }

    /// Renews the places beyond a yarn's ends.
    pub fn renew_ends(&self, strand: &SettlingYarn, places: &mut [Place]) {
        let (first, count) = (strand.first as usize, strand.points as usize);
        let last = first + count - 1;
        if let Some(shift) = strand.shift() {
            let shift = glam::IVec3::new(shift[0] * self.period[0], shift[1] * self.period[1], 0);
            places[first - 1] = places[last].moved(-shift);
            places[last + 1] = places[first].moved(shift);
            places[last + 2] = places[first + 1].moved(shift);
        } else {
            places[first - 1] = places[first].reflected(places[first + 1]);
            places[last + 1] = places[last].reflected(places[last - 1]);
            places[last + 2] = places[last + 1];
        }
    }

    /// The interval that begins at place number `place`.
    #[must_use]
    #[inline]
    pub fn interval(&self, places: &[Place], place: usize) -> Interval {
        let window = [places[place - 1], places[place], places[place + 1], places[place + 2]];
        Interval::new(&window, &self.scale, self.s)
    }

    /// The weights of an interval's four control points without virtual ends. The weight of a
    /// virtual end goes to the two control points that the virtual end is computed from.
    #[must_use]
    #[inline]
    pub fn folded(tags: u32, mut weights: [f32; 4]) -> [f32; 4] {
        if tags & tag::OPENS != 0 {
            weights[1] += 2.0 * weights[0];
            weights[2] -= weights[0];
            weights[0] = 0.0;
        }
        if tags & tag::ENDS != 0 {
            weights[2] += 2.0 * weights[3];
            weights[1] -= weights[3];
            weights[3] = 0.0;
        }
        weights
    }

    fn tag(&mut self, offsets: &[u64], pinned: &[u64]) {
        for (yarn, strand) in self.strands.iter().enumerate() {
            let first = strand.first as usize;
            let all = first - BEYOND[0] as usize..first + strand.points as usize + BEYOND[1] as usize;
            self.yarns[all].fill(yarn as u32);
            self.tags[first..][..strand.points as usize].fill(tag::POINT);
            for place in first..first + strand.intervals() as usize {
                self.tags[place] |= tag::INTERVAL;
            }
            if strand.ends == Ends::Open {
                self.tags[first] |= tag::OPENS;
                self.tags[first + strand.points as usize - 2] |= tag::ENDS;
            }
        }
        for &point in pinned {
            let yarn = offsets.partition_point(|&start| start <= point) - 1;
            let before = yarn as u64 * (BEYOND[0] + BEYOND[1]) + BEYOND[0];
            self.tags[(point + before) as usize] |= tag::PINNED;
        }
    }

    /// Works out the lengths of intervals, their chords, and the positions of chords along yarns.
    fn measure(&mut self, length: Length) -> Result<(), SettlingError> {
        let thinnest = self.places.iter().zip(&self.tags).filter(|(_, tags)| **tags & tag::POINT != 0);
        let thinnest = thinnest
            .map(|(place, _)| 2.0 * place.halves.width().min(place.halves.height()))
            .fold(f32::INFINITY, f32::min);
        let factor = if let Length::Given(factor) = length { factor } else { 1.0 };
        // The largest length that an interval may get, as a multiple of its length at the start.
        let most = if let Length::Free { .. } = length { FREE_MOST } else { factor };
        let mut chords = 0_u64;
        for place in 0..self.places.len() {
            self.chords[place] = chords as u32;
            if self.tags[place] & tag::INTERVAL != 0 {
                let (arc, along) = self.interval(&self.places, place).arc();
                self.lengths[place] = arc * factor;
                let ends = [self.places[place].halves, self.places[place + 1].halves];
                let thickness = ends.map(|halves| 2.0 * halves.width().min(halves.height()));
                let pieces = (arc * most / (CHORD_MOST * thickness[0].min(thickness[1]))).ceil();
                if pieces > CHORDS_MAX {
                    let (yarn, chords) = (self.yarns[place] as usize, pieces as u64);
                    let axis = if along.y.abs() > along.x.abs() { 'y' } else { 'x' };
                    return Err(SettlingError::LongInterval { yarn, axis, chords, limit: CHORDS_MAX as u64 });
                }
                chords += u64::from((pieces as u32).max(CHORDS_MIN));
            }
        }
        let points = self.counts.points;
        let limit = CHORDS_FREE + CHORDS_A_POINT * points;
        if chords > limit {
            return Err(SettlingError::LongYarns { points, chords, limit });
        }
        limited("chords", chords, u64::from(u32::MAX >> 1))?;
        self.chords[self.places.len()] = chords as u32;
        self.counts.chords = chords;
        let own = |strand: &SettlingYarn| strand.first as usize..(strand.first + strand.intervals()) as usize;
        let whole =
            |strand: &SettlingYarn| self.lengths[own(strand)].iter().map(|&arc| f64::from(arc)).sum::<f64>();
        let longest = self.strands.iter().map(whole).fold(0.0, f64::max);
        let unit = (f64::from(thinnest) / 1024.0).max(longest / f64::from(1 << 29));
        self.spans.along = unit as f32;
        self.along = zeroed("where chords lie along yarns", chords)?;
        let units = |length: f64| (length / unit).round() as u32;
        for yarn in 0..self.strands.len() {
            let mut sum = 0.0;
            for place in own(&self.strands[yarn]) {
                let interval = self.interval(&self.places, place);
                let (first, pieces) = (self.chords[place], self.chords[place + 1] - self.chords[place]);
                for piece in 0..pieces {
                    let [from, to] = [piece, piece + 1].map(|piece| piece as f32 / pieces as f32);
                    let arc = f64::from(interval.arc_between(from, to) * factor);
                    self.spans.longest_chord = self.spans.longest_chord.max(arc as f32);
                    self.along[(first + piece) as usize] = [units(sum), units(sum + arc)];
                    sum += arc;
                }
            }
            self.strands[yarn].length = units(sum);
        }
        Ok(())
    }

    /// Checks that the repeat is long enough for no chord to meet two images of another chord.
    fn check_repeat(&self, repeat: [f32; 2]) -> Result<(), SettlingError> {
        let least = self.least_repeat();
        for (axis, repeat) in ['x', 'y'].into_iter().zip(repeat) {
            if repeat > 0.0 && repeat < least {
                let diameter = 2.0 * self.spans.thickest;
                return Err(SettlingError::ShortRepeat { axis, repeat, diameter, least });
            }
        }
        Ok(())
    }

    /// The shortest repeat that is accepted, mm. The middles of two neighbouring chords are then
    /// nearer to one another than half the repeat.
    #[must_use]
    fn least_repeat(&self) -> f32 {
        let Spans { diameter, thickest, longest_chord, .. } = self.spans;
        2.0 * (2.0 * MARGIN * thickest + SKIN * diameter + OVERSHOOT * longest_chord)
    }
}
