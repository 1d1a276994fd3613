//! The plan: all counts and tables of a problem, made on the host before anything is launched.

use super::neighbours::neighbours;
use super::rows::{further, rows};
use super::{
    CrossingState, CrossingThread, Crossings, CrossingsError, Level, Neighbours, Row, Set, Site, ThreadState,
};
use crate::backend::{room, zeroed};
use crate::{BackendError, RADIUS_MAX, RADIUS_MIN};

/// The least number of threads of each set.
const THREADS_MIN: usize = 2;

/// The most crossings of a plan.
const CROSSINGS_MAX: u64 = 1 << 31;

/// The least and the largest pitch of a thread, in units.
const PITCH: [f32; 2] = [0.2, 1000.0];

/// The least and the largest diameter of a thread, in units.
const DIAMETER: [f32; 2] = [0.1, 10.0];

/// The least and the largest stiffness of a thread.
const STIFFNESS: [f32; 2] = [0.01, 100.0];

/// The least and the largest firmness of a thread's section.
const FIRMNESS: [f32; 2] = [0.01, 100.0];

/// The least and the largest flatness of a thread's section.
const FLATNESS: [f32; 2] = [0.1, 10.0];

/// The least and the greatest least area of a thread's section, as a share of its area.
const LEAST_AREA: [f32; 2] = [0.0, 1.0];

/// The factor by which the weft is tauter than the warp. In very dense cloth one set takes most of
/// the crimp, although warp and weft are alike. Without this factor, rounding would choose the set,
/// and devices would disagree. With 1.002, 3/1 twill crimps in the weft at 1.04 times Ashenhurst's
/// sett, and in the warp at setts a little closer or more open
/// (`crimp_and_thickness_follow_the_sett` of texere-fabric). With 1.02, square plain weave has 2 %
/// more crimp in the warp than in the weft (`balanced_plain_weave_is_alike_both_ways`). With half
/// the factor's difference to 1, `mirrored_cloth_rests_mirrored` is red; with twice,
/// `stiff_threads_stay_straight`.
const WEFT_TAUTER: f32 = 1.004;

/// The largest height of a thread above or below the middle of the cloth, in units, for each level
/// of the set with most levels. With half the value, `uneven_cloth_comes_to_rest_whole` is red;
/// with twice, no test is.
const HEIGHT: f32 = 1.5;

/// The share of its radius with which a thread starts. It is the square root of 0.4, so that the
/// thread has 0.4 of its area. With half the value, and with twice,
/// `far_from_its_edges_a_piece_rests_as_a_repeat` is red.
const THIN: f32 = 0.632_455_5;

/// The tables of a problem. Lengths are in the plan's unit, the mean diameter of warp and weft.
///
/// ```
/// use texere_core::crossings::{Crossings, CrossingsPlan, Set, Site, CrossingThread};
/// let thread = CrossingThread::new(0.5, 0.25);
/// let plan = CrossingsPlan::new(&Crossings::new(vec![true, false, false, true], vec![thread; 2], vec![thread; 2]))?;
/// assert_eq!((plan.unit(), plan.rows(Set::Warp)[0].gap), (0.25, 2.0));
/// // Beyond the last end the first one comes again.
/// let last = Site { end: 1, pick: 0 };
/// assert_eq!(plan.beside(last, Set::Weft, 1, 0), Some(Site { end: 0, pick: 0 }));
/// # Ok::<(), texere_core::CrossingsError>(())
/// ```
#[derive(Debug, Clone)]
pub struct CrossingsPlan {
    unit: f32,
    ups: Vec<bool>,
    neighbours: Vec<Neighbours>,
    rows: [Vec<Row>; 2],
    repeats: [bool; 2],
    tension: [f32; 2],
    press: f32,
    passes: u32,
}

impl CrossingsPlan {
    /// Checks a problem and makes its plan.
    ///
    /// **Errors**: [`CrossingsError`] for a drawdown or levels that don't fit, fewer than two
    /// threads of a set, more than 2³¹ crossings, values out of range or not finite, and short
    /// memory.
    pub fn new(problem: &Crossings) -> Result<Self, CrossingsError> {
        let [ends, picks] = [0, 1].map(|set| problem.threads[set].len());
        for (what, count) in [("end", ends), ("pick", picks)] {
            if count < THREADS_MIN {
                return Err(CrossingsError::TooFew { what, count, least: THREADS_MIN });
            }
        }
        if ends.checked_mul(picks) != Some(problem.ups.len()) {
            return Err(CrossingsError::Drawdown { ups: problem.ups.len(), ends, picks });
        }
        let count = problem.ups.len() as u64;
        if count > CROSSINGS_MAX {
            return Err(CrossingsError::TooMany { what: "crossings", count, limit: CROSSINGS_MAX });
        }
        setting("tension of the warp", problem.tension[0], [0.0, 10.0])?;
        setting("tension of the weft", problem.tension[1], [0.0, 10.0])?;
        setting("press", problem.press, [0.0, 10.0])?;
        setting("passes", problem.passes as f32, [1.0, 1e6])?;
        for (set, threads) in ["warp", "weft"].into_iter().zip(&problem.threads) {
            each(set, "diameter", threads, |thread| thread.diameter, [2.0 * RADIUS_MIN, 2.0 * RADIUS_MAX])?;
            each(set, "stiffness", threads, |thread| thread.stiffness, STIFFNESS)?;
            each(set, "firmness", threads, |thread| thread.firmness, FIRMNESS)?;
            each(set, "flatness", threads, |thread| thread.flatness, FLATNESS)?;
            each(set, "least area", threads, |thread| thread.least_area, LEAST_AREA)?;
        }
        let mean = |threads: &[CrossingThread]| {
            threads.iter().map(|thread| f64::from(thread.diameter)).sum::<f64>() / threads.len() as f64
        };
        let unit = (f64::midpoint(mean(&problem.threads[0]), mean(&problem.threads[1]))) as f32;
        for (set, threads) in ["warp", "weft"].into_iter().zip(&problem.threads) {
            each(set, "diameter", threads, |thread| thread.diameter, DIAMETER.map(|limit| limit * unit))?;
            each(set, "pitch", threads, |thread| thread.pitch, PITCH.map(|limit| limit * unit))?;
        }
        let neighbours = neighbours(problem)?;
        let levels = f32::from(neighbours.iter().flat_map(|at| at.levels).map(|at| at.of).fold(1, u8::max));
        // If the stiffest thread is stiffer than cotton, all stiffnesses are divided by its
        // stiffness, so that penalties stay the strongest terms. Tension and press are divided by
        // the same number, because they have less effect on stiffer threads.
        let stiffest = problem.threads.iter().flatten().map(|thread| thread.stiffness).fold(1.0, f32::max);
        let row = |set: usize| rows(&problem.threads[set], unit, stiffest, HEIGHT * levels, problem.held);
        Ok(Self {
            unit,
            ups: copied("the drawdown", &problem.ups)?,
            neighbours,
            rows: [row(0)?, row(1)?],
            repeats: problem.repeats,
            tension: [problem.tension[0], WEFT_TAUTER * problem.tension[1]].map(|tension| tension / stiffest),
            press: problem.press / levels.powi(2) / stiffest,
            passes: problem.passes,
        })
    }

    /// The number of crossings.
    #[must_use]
    pub const fn crossings(&self) -> usize {
        self.ups.len()
    }

    /// The bytes that a settler holds besides the plan: three states of each crossing. They are the
    /// present state, the state that this pass reads, and the state that the next pass reads.
    #[must_use]
    pub const fn settler_bytes(&self) -> u64 {
        3 * size_of::<CrossingState>() as u64 * self.ups.len() as u64
    }

    /// The unit of all lengths, mm.
    #[must_use]
    pub const fn unit(&self) -> f32 {
        self.unit
    }

    /// The rows of a set's threads.
    #[must_use]
    pub fn rows(&self, set: Set) -> &[Row] {
        match set {
            Set::Warp => &self.rows[0],
            Set::Weft => &self.rows[1],
        }
    }

    /// Whether the first end follows the last end, and whether the first pick follows the last
    /// pick.
    #[must_use]
    pub const fn repeats(&self) -> [bool; 2] {
        self.repeats
    }

    /// How the two threads of a crossing lie among the threads of their sets.
    ///
    /// **Panics** past the last crossing.
    #[must_use]
    pub fn neighbours(&self, site: Site) -> &Neighbours {
        &self.neighbours[self.number(site)]
    }

    /// The tension of a set's threads: about 1 for relaxed cloth, and less if any thread of the
    /// cloth is stiffer than cotton.
    #[must_use]
    pub const fn tension(&self, set: Set) -> f32 {
        match set {
            Set::Warp => self.tension[0],
            Set::Weft => self.tension[1],
        }
    }

    /// The strength of the press: 1 for relaxed cloth of one level, and less if any thread is
    /// stiffer than cotton. Cloth of several levels is as many times as high, so its press is
    /// divided by the square of the number of levels. If it were pressed as hard as cloth of one
    /// level, four layers would pierce one another (`layers_rest_at_any_sett` of texere-fabric).
    #[must_use]
    pub const fn press(&self) -> f32 {
        self.press
    }

    /// The largest number of passes.
    #[must_use]
    pub const fn passes(&self) -> u32 {
        self.passes
    }

    /// The number of a crossing. Crossings are numbered pick after pick, and end after end in each
    /// pick.
    #[must_use]
    pub fn number(&self, site: Site) -> usize {
        site.pick * self.rows[0].len() + site.end
    }

    /// The crossing with this number.
    #[must_use]
    pub fn site(&self, number: usize) -> Site {
        let ends = self.rows[0].len();
        Site { end: number % ends, pick: number / ends }
    }

    /// The side on which a set's thread lies at a crossing: 1 on the face, -1 on the back.
    ///
    /// **Panics** past the last crossing.
    #[must_use]
    pub fn side(&self, site: Site, set: Set) -> f32 {
        if self.ups[self.number(site)] == (set == Set::Warp) { 1.0 } else { -1.0 }
    }

    /// The crossing `along` crossings further on along a thread of `set`, and `across` threads of
    /// `set` to the side. `None` beyond an edge.
    #[must_use]
    pub fn beside(&self, site: Site, set: Set, along: i32, across: i32) -> Option<Site> {
        let [ends, picks] = match set {
            Set::Warp => [across, along],
            Set::Weft => [along, across],
        };
        let end = further(site.end, ends, self.rows[0].len(), self.repeats[0])?;
        let pick = further(site.pick, picks, self.rows[1].len(), self.repeats[1])?;
        Some(Site { end, pick })
    }

    /// All crossings before the first pass: thin round threads at the heights of their levels. If
    /// the two threads of a crossing would pierce one another at these heights, or lie on the wrong
    /// sides, they touch instead, one on top of the other.
    ///
    /// **Errors**: [`BackendError::OutOfMemory`].
    pub fn start(&self) -> Result<Vec<CrossingState>, BackendError> {
        let mut all = zeroed("crossings", self.ups.len() as u64)?;
        for (number, crossing) in all.iter_mut().enumerate() {
            let site = self.site(number);
            let rows = Set::BOTH.map(|set| self.rows(set)[site.thread(set)]);
            let radii = rows.map(|row| THIN * row.radius);
            let [warp, weft] = self.neighbours[number].levels.map(Level::start);
            let touching = self.side(site, Set::Warp) * (radii[0] + radii[1]);
            let is_parted = (warp - weft) * touching >= touching * touching;
            let heights = if is_parted {
                [warp, weft]
            } else {
                let middle = 0.5 * (warp + weft);
                [middle + 0.5 * touching, middle - 0.5 * touching]
            };
            let lie = |set: Set, radius: f32| ThreadState {
                shift: 0.0,
                height: heights[set as usize],
                half_width: radius,
                half_height: radius,
            };
            *crossing = CrossingState { warp: lie(Set::Warp, radii[0]), weft: lie(Set::Weft, radii[1]) };
        }
        Ok(all)
    }
}

fn copied<T: Copy>(what: &'static str, from: &[T]) -> Result<Vec<T>, CrossingsError> {
    let mut all = room(what, from.len())?;
    all.extend_from_slice(from);
    Ok(all)
}

fn setting(setting: &'static str, value: f32, [low, high]: [f32; 2]) -> Result<(), CrossingsError> {
    if (low..=high).contains(&value) {
        return Ok(());
    }
    Err(CrossingsError::Setting { setting, value, low, high })
}

fn each(
    set: &'static str,
    setting: &'static str,
    threads: &[CrossingThread],
    value: impl Fn(&CrossingThread) -> f32,
    [low, high]: [f32; 2],
) -> Result<(), CrossingsError> {
    let wrong = |thread: &CrossingThread| !(low..=high).contains(&value(thread));
    match threads.iter().position(wrong) {
        None => Ok(()),
        Some(thread) => {
            let value = value(&threads[thread]);
            Err(CrossingsError::Thread { set, thread, setting, value, low, high })
        }
    }
}
