//! Where the yarns of a warp knit go before they settle.
//!
//! A loop comes through the loops of the course below from the back to the face (+z), and all that
//! goes from needle to needle, the underlap, lies on the back. All loops on one needle come through
//! all of the course below: the legs of any lie in front of the heads of any. The first of them, by
//! bars from the front and then by guides, is the foremost on the face; underlaps of the front bar
//! are the hindmost on the back.
//!
//! A lap round two needles makes a loop on each, and goes from one to the other as an underlap
//! does. A yarn that is laid in makes no loop. It goes up between two wales, and from one space to
//! another behind the legs and heads of loops and in front of the underlaps of the bars before its
//! own: these hold it.

use glam::DVec3;
use rayon::prelude::*;
use texere_contact::round_length_mm;
use texere_core::backend::room_for;
use texere_core::{ControlPoint, OutOfMemory};

use super::bar::RACK;
use super::laps::laps;
use super::loops::Loops;
use super::{Bar, Laid, LapKind};
use crate::weft::{Cells, Gauge};

/// Height of a loop from foot to head, in courses, where its bar has no run-in.
const HEIGHT: f64 = 1.6;

/// Heights that a run-in may lead to: a loop of any of them goes through loops of any other.
const HEIGHTS: [f64; 2] = [1.45, 1.75];

/// Steps in which a height is found, each half as large as the one before.
const HEIGHT_STEPS: u32 = 16;

/// Half the distance of a loop's feet, in wales.
const FOOT: f64 = 0.14;

/// How far a loop begins below and ends above its course, in courses.
const SLANT: f64 = 0.25;

/// The same for a bar alone on its needles whose laps are open and that stays on one or two of
/// them.
const SLANT_STEEP: f64 = 0.05;

/// By how much a loop is narrower below, where it comes through another, and wider above, in
/// diameters either way; and the most of that in wales.
const BULGE: f64 = 0.9;
const BULGE_MOST: f64 = 0.2;

/// By how much loops on one needle are each wider than the next one where their legs begin, in
/// diameters.
const ASIDE: f64 = 0.8;

/// The length of an underlap's pieces, in wales.
const PIECE: f64 = 0.4;

/// How far behind its feet an underlap lies, in diameters.
const UNDERLAP: f64 = 0.6;

/// How far the loops on one needle are apart, in diameters.
const LAYER: f64 = 0.7;

/// How far behind the middle the feet lie, and how much further those of each bar further forward,
/// in diameters. With one bar there is nothing to lie behind.
const BEHIND: f64 = 2.0;
const BEHIND_ALONE: f64 = 2.2;
const BAR: f64 = 1.8;

/// How much further behind all feet lie for each loop that a needle has beyond two, in diameters:
/// narrow loops have their feet close to their legs, and a spline turns sharply where a short piece
/// meets a long one.
const CROWDED: f64 = 1.0;

/// The same for guides of one bar that share a needle.
const BESIDE: f64 = 0.9;

/// From where to where an inlay crosses wales, in courses above its own: between the feet of two
/// courses. It rises on its way, for all guides of its bar cross at once.
const CROSSES: [f64; 2] = [0.3, 0.8];

/// A yarn of a repeat that is laid: its first lap, its points, mm, and the course of each, from 0.
pub(super) struct Thread {
    pub(super) first: Laid,
    pub(super) points: Vec<DVec3>,
    pub(super) courses: Vec<u32>,
}

/// A repeat whose yarns are laid.
pub(super) struct Cloth<'a> {
    bars: &'a [Bar],
    gauge: Gauge,
    cells: Cells,
    /// Wales and courses.
    size: [u32; 2],
    /// Diameter of the thickest yarn, mm.
    diameter: f64,
    /// Which loops share a needle.
    loops: Loops,
    /// Height of each bar's loops, in courses.
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
        let mut laid = Vec::new();
        room_for(&mut laid, size[0] as usize * size[1] as usize * bars.len(), "laps")?;
        laid.extend(laps(bars, size[0], size[1]));
        let loops = Loops::new(laid, bars, size)?;
        let mut cloth = Self { bars, gauge, cells, size, diameter, loops, heights: vec![HEIGHT; bars.len()] };
        for (number, bar) in bars.iter().enumerate() {
            if let Some(run_in_mm) = bar.run_in_mm {
                cloth.reach(number, run_in_mm / RACK * f64::from(size[1]))?;
            }
        }
        Ok(cloth)
    }

    /// Gives a bar's loops the height at which its yarns are of that length in the mean, mm, or the
    /// nearest height to it.
    fn reach(&mut self, bar: usize, length_mm: f64) -> Result<(), OutOfMemory> {
        let [mut low, mut high] = HEIGHTS;
        for _ in 0..HEIGHT_STEPS {
            self.heights[bar] = (low + high) / 2.0;
            let longer = self.mean_length_mm(bar)?.is_some_and(|mean| mean > length_mm);
            *(if longer { &mut high } else { &mut low }) = self.heights[bar];
        }
        Ok(())
    }

    /// Mean length of the yarns of a bar, mm; `None` of a bar without yarns.
    fn mean_length_mm(&self, bar: usize) -> Result<Option<f64>, OutOfMemory> {
        let height = f64::from(self.size[1]) * self.gauge.course_mm;
        let own = (0..self.loops.laid.len()).step_by(self.size[1] as usize);
        let own: Vec<_> = own.filter(|lap| self.loops.laid[*lap].bar as usize == bar).collect();
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

    /// The yarns of all guides that are threaded.
    ///
    /// **Errors**: [`OutOfMemory`].
    pub(super) fn lay(&self) -> Result<Vec<Thread>, OutOfMemory> {
        let courses = self.size[1] as usize;
        (0..self.loops.laid.len() / courses).into_par_iter().map(|yarn| self.thread(yarn * courses)).collect()
    }

    /// The yarn whose first lap has that number.
    fn thread(&self, first: usize) -> Result<Thread, OutOfMemory> {
        let laps = first..first + self.size[1] as usize;
        let mut laid: Vec<Vec<DVec3>> = Vec::new();
        room_for(&mut laid, laps.len(), "laps of a yarn")?;
        laid.extend(laps.map(|lap| self.lap(lap)));
        let on = DVec3::Y * f64::from(self.size[1]) * self.gauge.course_mm;
        let (mut points, mut courses) = (Vec::new(), Vec::new());
        for (course, own) in (0..).zip(&laid) {
            room_for(&mut points, own.len(), "points of a yarn")?;
            points.extend(own);
            let next = laid.get(course as usize + 1).map_or_else(|| laid[0][0] + on, |next| next[0]);
            let behind = match self.loops.laid[first + course as usize].kind() {
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
        Ok(Thread { first: self.loops.laid[first], points, courses })
    }

    /// Points of an underlap, so that none of its pieces is much longer than those of a loop: a
    /// spline turns sharply where a long piece follows a short one. They lie `behind` the feet,
    /// which other yarns of the same bar have between them.
    fn between(&self, from: DVec3, to: DVec3, behind: f64) -> impl ExactSizeIterator<Item = DVec3> + use<> {
        let parts = match self.cells {
            Cells::Round => (from.distance(to) / (PIECE * self.gauge.wale_mm)).round().max(1.0),
            Cells::Even => 1.0,
        };
        (1..parts as usize).map(move |part| from.lerp(to, part as f64 / parts) - DVec3::Z * behind)
    }

    /// The points of one lap, its underlap left out; of an inlay with those at the wales that it
    /// crosses.
    fn lap(&self, number: usize) -> Vec<DVec3> {
        let laid = &self.loops.laid[number];
        if laid.kind() == LapKind::Inlay {
            return self.inlay(laid);
        }
        let mut points: Vec<DVec3> = Vec::new();
        for (part, needle) in laid.lap.needles().enumerate() {
            let own = self.loop_points(number, part, needle);
            if let Some(last) = points.last().copied() {
                points.extend(self.between(last, own[0], UNDERLAP * self.diameter));
            }
            points.extend(own);
        }
        points
    }

    fn inlay(&self, laid: &Laid) -> Vec<DVec3> {
        let Gauge { wale_mm, course_mm, .. } = self.gauge;
        let behind = self.behind(laid.bar as usize) * self.diameter;
        let at = |space: f64, above: f64| {
            DVec3::new(space * wale_mm, (f64::from(laid.course) + above) * course_mm, -behind)
        };
        let space = f64::from(laid.lap.to);
        let hand = f64::from(laid.underlap.signum());
        let count = laid.underlap.unsigned_abs();
        let wales = (0..count).map(|wale| {
            let passed = f64::from(wale) + 0.5;
            let [first, last] = CROSSES;
            at(space + hand * passed, first + (last - first) * passed / f64::from(count))
        });
        std::iter::once(at(space, 0.0)).chain(wales).collect()
    }

    /// How far behind the middle a bar's feet and inlays lie, in diameters.
    fn behind(&self, bar: usize) -> f64 {
        match self.bars.len() - 1 {
            0 => BEHIND_ALONE,
            last => {
                BEHIND + CROWDED * f64::from(self.loops.most.saturating_sub(2)) + BAR * (last - bar) as f64
            }
        }
    }

    /// One loop, from the foot at which the yarn comes in to the one at which it goes out.
    fn loop_points(&self, number: usize, part: usize, needle: i32) -> [DVec3; 9] {
        let (laid, share) = (&self.loops.laid[number], self.loops.share(number, part));
        let (Gauge { wale_mm, course_mm, .. }, diameter) = (self.gauge, self.diameter);
        let apart = f64::from(self.loops.most - 1);
        // Legs of any in front of heads of any, which takes more than the loops on a needle are
        // apart.
        let (forward, tilt) = if apart > 0.0 { (0.65 + 0.35 * apart, 0.3) } else { (0.9, 0.0) };
        let front_most = share.front_most();
        let layer = LAYER * front_most;
        let behind = self.behind(laid.bar as usize) + BESIDE * f64::from(share.own_rank);
        let slant = if self.loops.steep[laid.bar as usize] { SLANT_STEEP } else { SLANT };
        let bulge = (BULGE * diameter).min(BULGE_MOST * wale_mm);
        // Loops that lap alike would lie in one another. Of others, what is further to the front at
        // the legs is further back at the feet: on the way yarns pass beside one another.
        let (beside, aside) = if self.loops.alike[laid.bar as usize] {
            (front_most, 0.0)
        } else {
            (share.own_middle(), ASIDE * diameter)
        };

        // Those of one bar are all as wide: each lies beside the next one all the way but at the
        // head, where they cross once.
        let wider = front_most + share.own_middle();
        let height = self.heights[laid.bar as usize];
        let side = f64::from(laid.lap.overlap().signum());
        let middle = (f64::from(needle) + 0.5) * wale_mm + beside * diameter;
        let course = f64::from(laid.course) * course_mm;
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
