//! The path of a yarn before it settles: where the feet, legs and heads of its loops lie, and its
//! underlaps and inlays.
//!
//! ```text
//! for each course of a guide:
//!     lap       a loop on each needle that it goes round (loop_points); an inlay makes none
//!     between   the underlap to the next lap
//! ```
//!
//! [`Cloth::loop_points`] places nine points of a loop: a foot, three of a leg, the head, and the
//! other leg and foot.
//!
//! - **Loops** come through the loops of the course below, from the back to the face (+z). All
//!   loops on one needle come through all loops of the course below, so that the legs of each lie
//!   in front of the heads of all. The order on a needle is by bar from the front, then by guide:
//!   the first loop is the foremost on the face.
//! - **Underlaps** lie on the back. The front bar's underlaps lie furthest back.
//! - **A lap round two needles** makes a loop on each, joined as by an underlap.
//! - **An inlay** makes no loop. Its yarn goes up between two wales. From one space to another it
//!   passes behind the legs and heads of loops, and in front of the underlaps of bars further
//!   forward, which hold it.
//!
//! Yarns need not be clear of one another here, but they have to be linked as in the cloth
//! (`loops_are_drawn_through_those_below`). Settling makes them clear (`warp_knits_come_to_rest`).

use glam::DVec3;
use rayon::prelude::*;
use texere_contact::round_length_mm;
use texere_core::backend::room_for;
use texere_core::{ControlPoint, OutOfMemory};

use super::bar::RACK;
use super::laps::laps;
use super::loops::Loops;
use super::{Bar, LapKind, PlacedLap};
use crate::weft::{Cells, Gauge};

/// Height of a loop from foot to head, in courses, if its bar has no run-in. By trial: single bars
/// in closed and open tricot, pillar, cord and atlas stayed clear. With half the value,
/// `loops_are_drawn_through_those_below` is red; with twice, `a_knit_is_told_as_woven_cloth_is`.
const HEIGHT: f64 = 1.6;

/// Range of heights that a run-in may lead to, in courses. Loops of any of these heights are drawn
/// through the loops of the course below. With half the values, and with twice,
/// `run_ins_are_asked_for_and_measured` is red.
const HEIGHTS: [f64; 2] = [1.45, 1.75];

/// Number of halvings of [`HEIGHTS`]: 16 leave 5 millionths of a course.
const HEIGHT_STEPS: u32 = 16;

/// Half the distance between the feet of a loop, in wales. By trial, as [`HEIGHT`]. With half the
/// value, `plates_press_locknit_flat` is red; with twice, `warp_knits_come_to_rest`.
const FOOT: f64 = 0.14;

/// Height by which a loop begins below its course and ends above it, in courses. By eye. With half
/// the value, `warp_knits_come_to_rest` is red; with twice, `copies_have_names_of_their_own`.
const SLANT: f64 = 0.25;

/// [`SLANT`] for a bar alone on its needles, whose laps are open and stay on one or two needles:
/// pillar and open tricot. By trial, as [`HEIGHT`]. With twice the value,
/// `yarns_of_few_points_a_repeat_have_the_same_numbers_small_and_large` is red; with half, no test
/// is.
const SLANT_STEEP: f64 = 0.05;

/// Width by which each leg of a loop lies further in at its lower end, where it comes through
/// another loop, and further out at its upper end, in diameters. By trial, as [`HEIGHT`]. With half
/// the value, `loops_are_drawn_through_those_below` is red; with twice,
/// `run_ins_are_asked_for_and_measured`.
const BULGE: f64 = 0.9;
/// The largest width that [`BULGE`] may give, in wales. By eye. With half the value, and with
/// twice, no test is red.
const BULGE_MOST: f64 = 0.2;

/// Width by which each loop on a needle is wider or narrower than the next one at the lower ends of
/// its legs, in diameters. By eye. With half the value, and with twice, `plates_press_locknit_flat`
/// is red.
const ASIDE: f64 = 0.8;

/// Length of the pieces of an underlap, in wales. By eye. With half the value,
/// `warp_knits_come_to_rest` is red; with twice, `a_knit_is_told_as_woven_cloth_is`.
const PIECE: f64 = 0.4;

/// Distance of an underlap behind its feet, in diameters. By eye. With half the value,
/// `plates_press_locknit_flat` is red; with twice, no test is.
const UNDERLAP: f64 = 0.6;

/// Distance in z between the loops on one needle, in diameters. By trial with two bars in locknit,
/// satin, sharkskin and others. The legs of each loop have to lie in front of the heads of all
/// loops. [`Cloth::loop_points`] therefore places legs further forward the more loops there are.
/// With half the value, `plates_press_locknit_flat` is red; with twice,
/// `loops_are_drawn_through_those_below`.
const LAYER: f64 = 0.7;

/// Distance of the feet of the hindmost of several bars behind the middle of the cloth, in
/// diameters. By eye. With half the value, `plates_press_locknit_flat` is red; with twice,
/// `run_ins_are_asked_for_and_measured`.
const BEHIND: f64 = 2.0;
/// Distance of the feet of a single bar behind the middle of the cloth, in diameters. By trial, as
/// [`HEIGHT`]. With half the value, `a_knit_is_told_as_woven_cloth_is` is red; with twice, no test
/// is.
const BEHIND_ALONE: f64 = 2.2;
/// Distance by which the feet of each bar lie further back than those of the next bar behind it, in
/// diameters. By eye. With half the value, `plates_press_locknit_flat` is red; with twice,
/// `run_ins_are_asked_for_and_measured`.
const BAR: f64 = 1.8;

/// Distance by which all feet lie further back for each loop on a needle beyond two, in diameters.
/// Narrow loops have their feet close to their legs, and a spline turns sharply where a short piece
/// meets a long one. By eye. With half the value, and with twice, no test is red.
const CROWDED: f64 = 1.0;

/// Distance by which the feet of a loop lie further back for each loop of the same bar that comes
/// before it on the needle, in diameters. By eye. With half the value, and with twice, no test is
/// red.
const BESIDE: f64 = 0.9;

/// Heights at which an inlay begins to cross wales and has crossed them all, in courses above its
/// own. They lie between the feet of two courses. The inlay rises on its way, because all guides of
/// its bar cross at once. By eye. With half the values, `warp_knits_come_to_rest` is red; with
/// twice, `cut_edges_are_as_clear_as_the_repeat`.
const CROSSES: [f64; 2] = [0.3, 0.8];

/// A yarn of a repeat, as laid: its first lap, its points in mm, and the course of each point,
/// counted from 0.
pub(super) struct Thread {
    pub(super) first: PlacedLap,
    pub(super) points: Vec<DVec3>,
    pub(super) courses: Vec<u32>,
}

/// A repeat whose yarns are to be laid.
pub(super) struct Cloth<'a> {
    bars: &'a [Bar],
    gauge: Gauge,
    cells: Cells,
    /// Number of wales and of courses.
    size: [u32; 2],
    /// Diameter of the thickest yarn, mm.
    diameter: f64,
    /// All laps, and which loops share a needle.
    loops: Loops,
    /// Height of the loops of each bar, in courses.
    heights: Vec<f64>,
}

impl<'a> Cloth<'a> {
    pub(super) fn new(
        bars: &'a [Bar],
        gauge: Gauge,
        diameter: f64,
        size: [u32; 2],
        cells: Cells,
    ) -> Result<Self, OutOfMemory> {
        let mut placed = Vec::new();
        room_for(&mut placed, size[0] as usize * size[1] as usize * bars.len(), "laps")?;
        placed.extend(laps(bars, size[0], size[1]));
        let loops = Loops::new(placed, bars, size)?;
        let mut cloth = Self { bars, gauge, cells, size, diameter, loops, heights: vec![HEIGHT; bars.len()] };
        for (number, bar) in bars.iter().enumerate() {
            if let Some(run_in_mm) = bar.run_in_mm {
                cloth.reach(number, run_in_mm / RACK * f64::from(size[1]))?;
            }
        }
        Ok(cloth)
    }

    /// Sets the height of a bar's loops so that the mean length of its yarns is `length_mm`, or as
    /// near to it as [`HEIGHTS`] allow.
    fn reach(&mut self, bar: usize, length_mm: f64) -> Result<(), OutOfMemory> {
        let [mut low, mut high] = HEIGHTS;
        for _ in 0..HEIGHT_STEPS {
            self.heights[bar] = (low + high) / 2.0;
            let longer = self.mean_length_mm(bar)?.is_some_and(|mean| mean > length_mm);
            *(if longer { &mut high } else { &mut low }) = self.heights[bar];
        }
        Ok(())
    }

    /// Mean length of a bar's yarns in the repeat, mm; `None` for a bar without yarns.
    fn mean_length_mm(&self, bar: usize) -> Result<Option<f64>, OutOfMemory> {
        let height = f64::from(self.size[1]) * self.gauge.course_mm;
        let own = (0..self.loops.placed.len()).step_by(self.size[1] as usize);
        let own: Vec<_> = own.filter(|lap| self.loops.placed[*lap].bar as usize == bar).collect();
        let length = |lap: &usize| {
            let point = |at: DVec3| ControlPoint::new(at.x as f32, at.y as f32, at.z as f32, 1.0);
            let thread = self.thread(*lap)?.points;
            let mut points = Vec::new();
            room_for(&mut points, thread.len(), "points of a yarn")?;
            points.extend(thread.into_iter().map(point));
            Ok::<_, OutOfMemory>(round_length_mm(&points, [0.0, height], 0.0))
        };
        let lengths = own.par_iter().map(length).collect::<Result<Vec<_>, _>>()?;
        Ok((!own.is_empty()).then(|| lengths.iter().sum::<f64>() / own.len() as f64))
    }

    /// Lays the yarns of all threaded guides.
    ///
    /// **Errors**: [`OutOfMemory`].
    pub(super) fn lay(&self) -> Result<Vec<Thread>, OutOfMemory> {
        let courses = self.size[1] as usize;
        (0..self.loops.placed.len() / courses)
            .into_par_iter()
            .map(|yarn| self.thread(yarn * courses))
            .collect()
    }

    /// Lays the yarn whose first lap has the number `first`.
    fn thread(&self, first: usize) -> Result<Thread, OutOfMemory> {
        let laps = first..first + self.size[1] as usize;
        let mut placed: Vec<Vec<DVec3>> = Vec::new();
        room_for(&mut placed, laps.len(), "laps of a yarn")?;
        placed.extend(laps.map(|lap| self.lap(lap)));
        let on = DVec3::Y * f64::from(self.size[1]) * self.gauge.course_mm;
        let (mut points, mut courses) = (Vec::new(), Vec::new());
        for (course, own) in (0..).zip(&placed) {
            room_for(&mut points, own.len(), "points of a yarn")?;
            points.extend(own);
            let next = placed.get(course as usize + 1).map_or_else(|| placed[0][0] + on, |next| next[0]);
            let behind = match self.loops.placed[first + course as usize].kind() {
                LapKind::Inlay => 0.0,
                LapKind::Overlap | LapKind::TwoNeedle => UNDERLAP * self.diameter,
            };
            if let Some(last) = own.last() {
                let between = self.between(*last, next, behind);
                room_for(&mut points, between.len(), "points of a yarn")?;
                points.extend(between);
            }
            let more = points.len() - courses.len();
            room_for(&mut courses, more, "courses of a yarn's points")?;
            courses.resize(points.len(), course);
        }
        Ok(Thread { first: self.loops.placed[first], points, courses })
    }

    /// The points of an underlap between its two ends, mm. The points divide it into pieces about
    /// as long as those of a loop, because a spline turns sharply where a long piece follows a
    /// short one. They lie further back than the ends by `behind`, because other yarns of the same
    /// bar have their feet at the depth of the ends.
    fn between(&self, from: DVec3, to: DVec3, behind: f64) -> impl ExactSizeIterator<Item = DVec3> + use<> {
        let parts = match self.cells {
            Cells::Round => (from.distance(to) / (PIECE * self.gauge.wale_mm)).round().max(1.0),
            Cells::Even => 1.0,
        };
        (1..parts as usize).map(move |part| from.lerp(to, part as f64 / parts) - DVec3::Z * behind)
    }

    /// The points of one lap without its underlap, mm. An inlay has a point in its space, and one
    /// at each wale that it crosses on the way to the next lap.
    fn lap(&self, number: usize) -> Vec<DVec3> {
        let placed = &self.loops.placed[number];
        if placed.kind() == LapKind::Inlay {
            return self.inlay(placed);
        }
        let mut points: Vec<DVec3> = Vec::new();
        for (part, needle) in placed.lap.needles().enumerate() {
            let own = self.loop_points(number, part, needle);
            if let Some(last) = points.last().copied() {
                points.extend(self.between(last, own[0], UNDERLAP * self.diameter));
            }
            points.extend(own);
        }
        points
    }

    fn inlay(&self, placed: &PlacedLap) -> Vec<DVec3> {
        let Gauge { wale_mm, course_mm, .. } = self.gauge;
        let behind = self.behind(placed.bar as usize) * self.diameter;
        let at = |space: f64, above: f64| {
            DVec3::new(space * wale_mm, (f64::from(placed.course) + above) * course_mm, -behind)
        };
        let space = f64::from(placed.lap.to);
        let hand = f64::from(placed.underlap.signum());
        let count = placed.underlap.unsigned_abs();
        let wales = (0..count).map(|wale| {
            let passed = f64::from(wale) + 0.5;
            let [first, last] = CROSSES;
            at(space + hand * passed, first + (last - first) * passed / f64::from(count))
        });
        std::iter::once(at(space, 0.0)).chain(wales).collect()
    }

    /// Distance of a bar's feet and inlays behind the middle of the cloth, in diameters.
    fn behind(&self, bar: usize) -> f64 {
        match self.bars.len() - 1 {
            0 => BEHIND_ALONE,
            last => {
                BEHIND + CROWDED * f64::from(self.loops.most.saturating_sub(2)) + BAR * (last - bar) as f64
            }
        }
    }

    /// The nine points of one loop, mm: from the foot at which the yarn comes in to the foot at
    /// which it goes out. `part` is 0, or 1 for the second loop of a lap round two needles.
    ///
    /// The points are symmetrical about the needle: feet [`FOOT`] wales to each side, legs a
    /// quarter of a wale, heads in the middle. The points are then shifted, so that loops on one
    /// needle do not lie in one another.
    fn loop_points(&self, number: usize, part: usize, needle: i32) -> [DVec3; 9] {
        let (placed, share) = (&self.loops.placed[number], self.loops.share(number, part));
        let (Gauge { wale_mm, course_mm, .. }, diameter) = (self.gauge, self.diameter);
        let apart = f64::from(self.loops.most - 1);
        // The legs of each loop lie in front of the heads of all loops. This takes more depth than
        // the distance between the loops on a needle.
        let (forward, tilt) = if apart > 0.0 { (0.65 + 0.35 * apart, 0.3) } else { (0.9, 0.0) };
        let front_most = share.front_most();
        let layer = LAYER * front_most;
        let behind = self.behind(placed.bar as usize) + BESIDE * f64::from(share.own_rank);
        let slant = if self.loops.steep[placed.bar as usize] { SLANT_STEEP } else { SLANT };
        let bulge = (BULGE * diameter).min(BULGE_MOST * wale_mm);
        // Loops of bars that lap alike would lie in one another, and are shifted sideways. If bars
        // lap differently, a loop that is further forward at its legs is further back at its feet.
        // Its legs begin wider or narrower, so that yarns pass beside one another on the way.
        let (beside, aside) = if self.loops.alike[placed.bar as usize] {
            (front_most, 0.0)
        } else {
            (share.own_middle(), ASIDE * diameter)
        };

        // Loops of one bar are equally wide. Each lies beside the next one all the way except at
        // the head, where the two cross once.
        let wider = front_most + share.own_middle();
        let height = self.heights[placed.bar as usize];
        let side = f64::from(placed.lap.overlap().signum());
        let middle = (f64::from(needle) + 0.5) * wale_mm + beside * diameter;
        let course = f64::from(placed.course) * course_mm;
        let place = |x: f64, y: f64, z: f64| DVec3::new(x, course + y * course_mm, z * diameter);
        let leg = |hand: f64| {
            let at =
                |wider: f64, y: f64, z: f64| place(middle + hand * (wale_mm / 4.0 + wider), y, z + layer);
            [
                at(wider * aside - bulge, (height - 1.0) / 2.0, tilt),
                at(0.0, height / 2.0, forward),
                at(bulge, (height + 1.0) / 2.0, -tilt),
            ]
        };
        let foot = |hand: f64, up: f64| {
            place(middle + hand * (FOOT * wale_mm + wider * diameter), up * slant, -behind)
        };
        let ([in_low, in_mid, in_high], [out_low, out_mid, out_high]) = (leg(-side), leg(side));
        let head = place(middle - beside * diameter, height, layer - forward);
        [foot(-side, -1.0), in_low, in_mid, in_high, head, out_high, out_mid, out_low, foot(side, 1.0)]
    }
}
