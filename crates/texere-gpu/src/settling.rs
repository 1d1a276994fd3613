//! Tables of settling by contacts. They are sent to a device byte for byte, and its results come
//! back in the same way.

use bytemuck::{Pod, Zeroable};
use texere_core::Ends;
use texere_core::settling::{Length, Pass, SettlingPlan, SettlingSeen, SettlingYarn, tag};

/// The number that replaces infinity, which a device may not have. No distance of yarns is as
/// large.
pub(crate) const UNSEEN: f32 = 1e30;

/// The most workgroups that work out the extent of all chords.
pub const EXTENT_GROUPS: u32 = 256;

/// The number of cells that chords may always be sorted into, however few chords there are.
const CELLS: u64 = 64;

/// The constant data of a place that settles.
///
/// **Shape**: four 4-byte values, 16 bytes. A table has one row more than there are places. The
/// `first_chord` of that row is the end of the last interval's chords.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default, Pod, Zeroable)]
pub struct PlaceRow {
    /// Bits of [`tag`].
    pub tags: u32,
    /// Number of the place's yarn.
    pub yarn: u32,
    /// Number of the first chord of the place's interval.
    pub first_chord: u32,
    /// The length that the place's interval is to have at the start, mm.
    pub start_length: f32,
}

const _: () = assert!(size_of::<PlaceRow>() == 16 && std::mem::offset_of!(PlaceRow, start_length) == 12);

/// The numbers of a yarn's places, and how the yarn goes on after its last point.
///
/// **Shape**: eight 4-byte values, 32 bytes.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Pod, Zeroable)]
pub struct StrandRow {
    /// Number of the place of the yarn's first control point.
    pub first: u32,
    /// Number of the yarn's control points.
    pub points: u32,
    /// 0 if the yarn is open, 1 if it is closed or goes on in the next repeat.
    pub goes_on: u32,
    /// Number of repeats along x by which the yarn's next round is moved.
    pub shift_x: i32,
    /// Number of repeats along y by which the yarn's next round is moved.
    pub shift_y: i32,
    /// The yarn's length, in units of [`Spans::along`](texere_core::settling::Spans::along).
    pub length: u32,
    /// Unused, 0. It makes the row a multiple of 16 bytes.
    pub padding: [u32; 2],
}

const _: () = assert!(size_of::<StrandRow>() == 32 && std::mem::offset_of!(StrandRow, length) == 20);

/// The constant data of a chord.
///
/// **Shape**: four 4-byte values, 16 bytes.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default, Pod, Zeroable)]
pub struct ChordRow {
    /// Number of the place of the chord's interval.
    pub place: u32,
    /// The start of the chord along its yarn, in units of
    /// [`Spans::along`](texere_core::settling::Spans::along).
    pub from: u32,
    /// The end of the chord along its yarn, in the same units as `from`.
    pub to: u32,
    /// The largest half width or half height of the chord's interval, mm.
    pub thickest: f32,
}

const _: () = assert!(size_of::<ChordRow>() == 16 && std::mem::offset_of!(ChordRow, thickest) == 12);

/// The parameters of all launches of a pass, or of those that list the neighbours of chords.
///
/// **Shape**: 24 4-byte values, 96 bytes. Uniform buffers need a multiple of 16.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default, Pod, Zeroable)]
pub struct SettlingParams {
    /// Number of places, including those beyond yarns' ends.
    pub places: u32,
    /// Number of chords.
    pub chords: u32,
    /// Number of yarns.
    pub yarns: u32,
    /// Bits: [`SettlingParams::FREE`], [`SettlingParams::PLATES`].
    pub flags: u32,
    /// The unit of places, mm.
    pub unit: f32,
    /// Number of units of places per mm.
    pub per_mm: f32,
    /// The factor `s = (1 - tension) / 2` of the spline's tangents.
    pub s: f32,
    /// The share of their full thickness that yarns have.
    pub growth: f32,
    /// The strength, 0 to 1, of what acts only on the way to rest: soft bends, tension, plates.
    pub ease: f32,
    /// The share of each point's last step that is added to its next.
    pub momentum: f32,
    /// Half of the gap between the plates, mm.
    pub half_gap: f32,
    /// The share by which free lengths are shortened in a pass. It is already multiplied by
    /// [`SettlingParams::ease`].
    pub tension: f32,
    /// The repeat along x, units, 0 if there is none.
    pub period_x: i32,
    /// The repeat along y, units, 0 if there is none.
    pub period_y: i32,
    /// Number of repeats per mm along x, 0 if nothing repeats.
    pub frequency_x: f32,
    /// Number of repeats per mm along y, 0 if nothing repeats.
    pub frequency_y: f32,
    /// The mean diameter of yarns, mm.
    pub diameter: f32,
    /// The unit of lengths along yarns, mm.
    pub along: f32,
    /// The start of the first cell along x, units.
    pub low_x: i32,
    /// The start of the first cell along y, units.
    pub low_y: i32,
    /// The size of a cell along x, units. The last cell also covers the rest.
    pub size_x: u32,
    /// The size of a cell along y, units. The last cell also covers the rest.
    pub size_y: u32,
    /// Number of cells along x.
    pub count_x: u32,
    /// Number of cells along y.
    pub count_y: u32,
}

const _: () =
    assert!(size_of::<SettlingParams>() == 96 && std::mem::offset_of!(SettlingParams, count_y) == 92);

/// The extent of the chords of one workgroup.
///
/// **Shape**: eight 4-byte values, 32 bytes.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default, Pod, Zeroable)]
pub struct ExtentRow {
    /// The least x of a chord's middle, units.
    pub low_x: i32,
    /// The least y of a chord's middle, units.
    pub low_y: i32,
    /// The largest x of a chord's middle, units.
    pub high_x: i32,
    /// The largest y of a chord's middle, units.
    pub high_y: i32,
    /// The longest chord's squared length, mm².
    pub longest: f32,
    /// Unused.
    pub padding: [u32; 3],
}

const _: () = assert!(size_of::<ExtentRow>() == 32 && std::mem::offset_of!(ExtentRow, longest) == 16);

/// The measures of a pass, of one workgroup or of all together.
///
/// **Shape**: four `f32`, 16 bytes.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default, Pod, Zeroable)]
pub struct SeenRow {
    /// The least distance of two yarns, divided by the sum of their reaches. It is 1e30 if no two
    /// yarns are near one another.
    pub clearance: f32,
    /// The least radius of curvature, in diameters of the yarn. It is 1e30 if no yarn bends.
    pub radius: f32,
    /// The largest difference of an interval's length from the length that it should have, as a
    /// share of the latter.
    pub length: f32,
    /// The longest step of a point, mm.
    pub step: f32,
}

const _: () = assert!(size_of::<SeenRow>() == 16);

impl PlaceRow {
    /// The rows of all places of `plan`, and one more for the end of the last place's chords.
    #[must_use]
    pub fn all(plan: &SettlingPlan) -> Vec<Self> {
        let own = plan.tags().iter().zip(plan.yarns()).zip(plan.chords()).zip(plan.lengths());
        let row =
            |(((&tags, &yarn), &first_chord), &start_length)| Self { tags, yarn, first_chord, start_length };
        let last = Self { first_chord: plan.counts().chords as u32, ..Self::default() };
        own.map(row).chain([last]).collect()
    }
}

impl StrandRow {
    /// The rows of all yarns of `plan`.
    #[must_use]
    pub fn all(plan: &SettlingPlan) -> Vec<Self> {
        let row = |strand: &SettlingYarn| {
            let [shift_x, shift_y] = strand.shift().unwrap_or_default();
            Self {
                first: strand.first,
                points: strand.points,
                goes_on: (strand.ends != Ends::Open).into(),
                shift_x,
                shift_y,
                length: strand.length,
                padding: [0; 2],
            }
        };
        plan.strands().iter().map(row).collect()
    }
}

impl ChordRow {
    /// The rows of all chords of `plan`, in the order of their numbers.
    #[must_use]
    pub fn all(plan: &SettlingPlan) -> Vec<Self> {
        let mut rows = Vec::with_capacity(plan.counts().chords as usize);
        for place in (0..plan.places().len()).filter(|&place| plan.tags()[place] & tag::INTERVAL != 0) {
            let thickest = plan.interval(plan.places(), place).thickest();
            let own = plan.chords()[place] as usize..plan.chords()[place + 1] as usize;
            let row = |&[from, to]: &[u32; 2]| Self { place: place as u32, from, to, thickest };
            rows.extend(plan.along()[own].iter().map(row));
        }
        rows
    }
}

impl SettlingParams {
    /// Bit of [`SettlingParams::flags`]: lengths are free.
    pub const FREE: u32 = 1;
    /// Bit of [`SettlingParams::flags`]: there are plates.
    pub const PLATES: u32 = 2;

    /// The parameters of `plan`, without those of a pass and of cells.
    ///
    /// ```
    /// use texere_core::settling::{Form, Pass};
    /// use texere_core::settling::{Settling, SettlingPlan};
    /// use texere_core::{ControlPoint, Yarn, Yarns};
    /// use texere_gpu::{PlaceRow, SettlingParams};
    /// let mut yarns = Yarns::builder();
    /// yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.25)));
    /// let plan = SettlingPlan::new(&Settling::new(&yarns.build()?))?;
    /// let pass = Pass { form: Form::Weighted, growth: 0.5, ease: 1.0, momentum: 0.8 };
    /// let params = SettlingParams::new(&plan).with_pass(&plan, &pass);
    /// assert_eq!((params.places, params.growth), (6, 0.5)); // three points, and three beyond the ends
    /// assert_eq!(PlaceRow::all(&plan).len(), 7);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn new(plan: &SettlingPlan) -> Self {
        let (counts, spans) = (plan.counts(), plan.spans());
        let free = if let Length::Free { .. } = plan.length() { Self::FREE } else { 0 };
        let [period_x, period_y] = plan.period();
        let [frequency_x, frequency_y] = plan.frequency();
        Self {
            places: counts.places as u32,
            chords: counts.chords as u32,
            yarns: plan.strands().len() as u32,
            flags: free | plan.plates().map_or(0, |_| Self::PLATES),
            unit: plan.scale().unit(),
            per_mm: 1.0 / plan.scale().unit(),
            s: plan.s(),
            half_gap: 0.5 * plan.plates().unwrap_or_default(),
            period_x,
            period_y,
            frequency_x,
            frequency_y,
            diameter: spans.diameter,
            along: spans.along,
            ..Self::default()
        }
    }

    /// These parameters for `pass`, or for listing neighbours at the growth of `pass`.
    #[must_use]
    pub fn with_pass(self, plan: &SettlingPlan, pass: &Pass) -> Self {
        let tension = if let Length::Free { tension } = plan.length() { tension * pass.ease } else { 0.0 };
        let Pass { growth, ease, momentum, .. } = *pass;
        Self { growth, ease, momentum, tension, ..self }
    }

    /// These parameters with the cells that chords are sorted into at `growth`. `rows` give the
    /// extent of all chords. Cells are so large that a chord's neighbours lie in its own cell or in
    /// one beside it. There are no more cells than chords, but up to 64 cells if there are fewer
    /// than 64 chords.
    #[must_use]
    pub fn with_cells(self, plan: &SettlingPlan, growth: f32, rows: &[ExtentRow]) -> Self {
        let fold = |of: fn(&ExtentRow) -> i32, better: fn(i32, i32) -> i32| {
            rows.iter().map(of).reduce(better).unwrap_or_default()
        };
        let low = [fold(|row| row.low_x, i32::min), fold(|row| row.low_y, i32::min)];
        let high = [fold(|row| row.high_x, i32::max), fold(|row| row.high_y, i32::max)];
        let longest = rows.iter().map(|row| row.longest).fold(0.0, f32::max).sqrt();
        // Along an axis that repeats, cells cover the repeat.
        let span = [0, 1].map(|axis| match plan.period()[axis] {
            0 => high[axis].abs_diff(low[axis]).saturating_add(1),
            period => period.unsigned_abs(),
        });
        let mut size = u64::from((plan.cell(growth, longest) / plan.scale().unit()).ceil() as u32).max(1);
        let count = loop {
            let count = span.map(|span| (u64::from(span) / size).max(1));
            if count[0] * count[1] <= plan.counts().chords.max(CELLS) {
                break count.map(|count| count as u32);
            }
            size *= 2;
        };
        let [low_x, low_y] = [0, 1].map(|axis| if plan.period()[axis] > 0 { 0 } else { low[axis] });
        Self {
            low_x,
            low_y,
            size_x: span[0] / count[0],
            size_y: span[1] / count[1],
            count_x: count[0],
            count_y: count[1],
            growth,
            ..self
        }
    }

    /// The number of cells in all.
    #[must_use]
    pub const fn cells(&self) -> u32 {
        self.count_x * self.count_y
    }
}

impl SeenRow {
    /// The measures as the core has them.
    #[must_use]
    pub fn seen(self) -> SettlingSeen {
        let sight = |value: f32| if value < UNSEEN { value } else { f32::INFINITY };
        SettlingSeen {
            step: self.step,
            clearance: sight(self.clearance),
            radius: sight(self.radius),
            length: self.length,
        }
    }
}

/// Whether any yarn of `plan` is flattened anywhere. Plans whose yarns are all round are settled by
/// a faster program.
#[must_use]
pub fn settles_flattened(plan: &SettlingPlan) -> bool {
    plan.places().iter().any(|place| place.halves.width() != place.halves.height())
}

/// Bytes of device memory that a pass of `plan` in the weighted form moves. `neighbours` is the
/// number of neighbours of all chords. Every table counts once, and what is written and read again
/// counts twice. Each neighbour counts with its number and its chord.
#[must_use]
pub fn settling_pass_bytes(plan: &SettlingPlan, neighbours: u64) -> u64 {
    // Bytes of a place: its present and its next position, its row, its length, its last step, and
    // the pulls of its interval (four slots of eight numbers, the vector of its excess length, its
    // arc, the least distance and the clearance). What is read again is included.
    const PLACE: u64 = 3 * 16 + 16 + 2 * 16 + 4 + 2 * 16 + 2 * 4 * (4 * 8 + 6);
    // Bytes of a chord: its row, its start and span, written and read, and the start of its list of
    // neighbours.
    const CHORD: u64 = 16 + 2 * 32 + 4;
    const NEIGHBOUR: u64 = 4 + 32;
    let counts = plan.counts();
    PLACE * counts.places + CHORD * counts.chords + NEIGHBOUR * neighbours
}
