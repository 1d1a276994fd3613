//! The course of a settling: the growth of yarns, the renewal of the lists of neighbours, and the
//! end.

use std::ops::ControlFlow;
use std::sync::Arc;

use glam::IVec3;

use super::plan::{OVERSHOOT, SKIN};
use super::{
    BEND_RADIUS, Form, Length, MARGIN, Pass, Place, Settler, SettlingPlan, SettlingSeen, moves, tag,
};
use crate::backend::zeroed;
use crate::{BackendError, ControlPoint};

/// The share of their thickness that yarns have at first. With twice the value,
/// `a_settled_repeat_fits_its_copies` is red; with half, no test is.
const THIN: f32 = 0.25;

/// The number of steps in which yarns grow to their full thickness.
const STEPS: u32 = 10;

/// The number of passes of each step of growth. With half the value, and with twice,
/// `a_settled_repeat_fits_its_copies` is red.
const STEP_PASSES: u32 = 4;

/// The shares of the passes at full thickness up to which [`Pass::ease`] is 1, and from which on it
/// is 0. With half the values, `rib_has_the_loop_length_and_thickness_of_the_books` is red; with
/// twice, `a_settled_repeat_fits_its_copies`.
const EASES: [f32; 2] = [0.3, 0.6];

/// The largest random move of a point along each axis at the start, in diameters. Without these
/// moves, symmetric yarns could balance at places that are not at rest. With half the value, and
/// with twice, `a_settled_repeat_fits_its_copies` is red.
const JITTER: f32 = 0.01;

/// The distance, divided by the sum of both reaches, from which on yarns count as clear. With twice
/// its difference to 1, `whole_settlings_end_in_the_same_bits` is red; with half, no test is.
const CLEAR: f32 = 0.995;

/// The least radius of curvature at rest, as a share of [`BEND_RADIUS`]. With half its difference
/// to 1, and with twice, no test is red.
const BENT: f32 = 0.99;

/// The largest difference at rest between an interval's length and the length that it aims for, as
/// a share of the length that it aims for. With half the value, and with twice, no test is red.
const LENGTH: f32 = 0.01;

/// The number of passes in which the [lack](Run::lack) must fall to [`STALLED`] of what it was. If
/// it falls less, the weighted form has stalled. With half the value, and with twice, no test is
/// red.
const STALLS: u32 = 20;

/// The share to which the lack must fall within [`STALLS`] passes. With half the value,
/// `a_settled_repeat_fits_its_copies` is red; with twice, no test is.
const STALLED: f32 = 0.9;

/// The result of a settling.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rest {
    /// Whether all conditions of rest are met.
    pub at_rest: bool,
    /// Number of all passes, including those of the block form.
    pub passes: u32,
    /// Number of passes of the block form.
    pub block_passes: u32,
    /// The number of times that neighbours were listed.
    pub lists: u32,
    /// The number of neighbours of all chords in the last lists.
    pub neighbours: u64,
    /// The measures at the start.
    pub start: SettlingSeen,
    /// The measures at the end.
    pub end: SettlingSeen,
}

/// Settles yarns on a device, and leaves the best places there. The best are those with the best
/// clearance, then the best bends, then the best lengths. If `watch` breaks off, the best places so
/// far are left. `watch` is called with the measures of every pass after the pass, and without
/// measures while a pass is being made.
///
/// Yarns grow from a quarter of their thickness, and bends are soft at first. Passes of the
/// weighted form are made until the yarns are at rest, the form stalls, or the plan allows no more.
/// If the yarns are not at rest then, passes of the block form follow, at most as many as there may
/// be of the weighted form at full thickness.
///
/// **Errors**: [`BackendError`] of the device.
pub fn settle(
    plan: &SettlingPlan,
    settler: &mut dyn Settler,
    watch: impl FnMut(&Pass, Option<&SettlingSeen>) -> ControlFlow<()>,
) -> Result<Rest, BackendError> {
    Run {
        plan,
        settler,
        watch,
        stopped: false,
        listed: 0.0,
        moved: f32::INFINITY,
        lacked: (f32::INFINITY, 0),
        rest: Rest::NOTHING,
    }
    .whole()
}

struct Run<'a, W> {
    plan: &'a SettlingPlan,
    settler: &'a mut dyn Settler,
    watch: W,
    /// Whether `watch` has broken off after a pass.
    stopped: bool,
    /// The growth at which neighbours were listed last.
    listed: f32,
    /// The sum of the longest steps since neighbours were listed last, mm.
    moved: f32,
    /// The lack when it last fell by a tenth, and the number of that pass.
    lacked: (f32, u32),
    rest: Rest,
}

impl<W: FnMut(&Pass, Option<&SettlingSeen>) -> ControlFlow<()>> Run<'_, W> {
    fn whole(mut self) -> Result<Rest, BackendError> {
        let places: Vec<Place> = own_places(self.plan).map(|(place, _)| *place).collect();
        self.settler.upload(&places)?;
        // The first pass measures the yarns as they are. These places are the result if no pass
        // finds better ones.
        let first = Pass { form: Form::Weighted, growth: 1.0, ease: 0.0, momentum: 0.0 };
        let ControlFlow::Continue(start) = self.pass(&first)? else { return self.ended() };
        self.settler.keep()?;
        (self.rest.start, self.rest.end) = (start, start);
        self.rest.at_rest = self.is_rest(&start);
        if self.rest.at_rest || self.stopped {
            return self.ended();
        }
        self.settler.upload(&jittered(self.plan))?;
        self.moved = f32::INFINITY;
        let passes = self.plan.passes;
        for number in 0..GROWING + passes {
            let pass = weighted(number, passes);
            let ControlFlow::Continue(seen) = self.pass(&pass)? else { return self.ended() };
            if pass.ease == 0.0 && self.weigh(&seen)? || self.stopped {
                return self.ended();
            }
            if pass.ease == 0.0 && self.has_stalled(&seen, number) {
                break;
            }
        }
        for _ in 0..passes {
            let pass = Pass { form: Form::Block, growth: 1.0, ease: 0.0, momentum: 0.8 };
            let ControlFlow::Continue(seen) = self.pass(&pass)? else { break };
            self.rest.block_passes += 1;
            if self.weigh(&seen)? || self.stopped {
                break;
            }
        }
        self.ended()
    }

    /// Makes a pass. If neighbours may be missing from the lists, they are listed again first.
    /// `Break` if `watch` has broken off before the pass was whole.
    fn pass(&mut self, pass: &Pass) -> Result<ControlFlow<(), SettlingSeen>, BackendError> {
        let mut within = || (self.watch)(pass, None);
        let spans = self.plan.spans();
        let grown = 2.0 * MARGIN * spans.thickest * (pass.growth - self.listed).max(0.0);
        if 2.0 * OVERSHOOT * self.moved + grown > SKIN * spans.diameter {
            let ControlFlow::Continue(neighbours) = self.settler.list_watched(pass.growth, &mut within)?
            else {
                return Ok(ControlFlow::Break(()));
            };
            self.rest.neighbours = neighbours;
            (self.listed, self.moved) = (pass.growth, 0.0);
            self.rest.lists += 1;
        }
        let ControlFlow::Continue(seen) = self.settler.pass_watched(pass, &mut within)? else {
            return Ok(ControlFlow::Break(()));
        };
        self.moved += seen.step;
        self.rest.passes += 1;
        self.stopped = (self.watch)(pass, Some(&seen)).is_break();
        Ok(ControlFlow::Continue(seen))
    }

    /// Keeps the places if they are the best so far, and returns whether they are at rest.
    fn weigh(&mut self, seen: &SettlingSeen) -> Result<bool, BackendError> {
        self.rest.at_rest = self.is_rest(seen);
        // Free lengths do not count in the comparison.
        let asked =
            |seen: &SettlingSeen| if self.holds() { *seen } else { SettlingSeen { length: 0.0, ..*seen } };
        if self.rest.at_rest || asked(seen).is_better_than(&asked(&self.rest.end)) {
            self.settler.keep()?;
            self.rest.end = *seen;
        }
        Ok(self.rest.at_rest)
    }

    /// Whether the lack has fallen by less than a tenth in the last [`STALLS`] passes.
    fn has_stalled(&mut self, seen: &SettlingSeen, number: u32) -> bool {
        let lack = self.lack(seen);
        if lack < STALLED * self.lacked.0 {
            self.lacked = (lack, number);
        }
        number - self.lacked.1 >= STALLS
    }

    fn is_rest(&self, seen: &SettlingSeen) -> bool {
        self.lack(seen) <= 0.0
    }

    /// What the yarns lack to be at rest: the largest of the shares by which clearance, radius of
    /// curvature and lengths miss their bounds. At rest it is 0 or less.
    fn lack(&self, seen: &SettlingSeen) -> f32 {
        seen.lack().max(if self.holds() { seen.length - LENGTH } else { f32::NEG_INFINITY })
    }

    /// Whether lengths are held or given.
    const fn holds(&self) -> bool {
        !matches!(self.plan.length, Length::Free { .. })
    }

    fn ended(self) -> Result<Rest, BackendError> {
        self.settler.recall()?;
        Ok(self.rest)
    }
}

/// The number of passes until yarns have their full thickness.
const GROWING: u32 = STEPS * STEP_PASSES;

/// The settings of pass number `number` of the weighted form, if `passes` are made at full
/// thickness.
fn weighted(number: u32, passes: u32) -> Pass {
    let step = (number / STEP_PASSES).min(STEPS);
    let growth = THIN + (1.0 - THIN) * (step as f32 / STEPS as f32);
    let share = number.saturating_sub(GROWING) as f32 / passes as f32;
    let ease = ((EASES[1] - share) / (EASES[1] - EASES[0])).clamp(0.0, 1.0);
    Pass { form: Form::Weighted, growth, ease, momentum: 0.8 }
}

/// The places of all control points, with their tags.
fn own_places(plan: &SettlingPlan) -> impl Iterator<Item = (&Place, u32)> {
    let all = plan.places().iter().zip(plan.tags().iter().copied());
    all.filter(|(_, tags)| tags & tag::POINT != 0)
}

/// The places of all control points, each but the pinned ones moved a little in its own random
/// direction.
fn jittered(plan: &SettlingPlan) -> Vec<Place> {
    let scale = plan.scale();
    let moved = own_places(plan).zip(0_u32..).map(|((place, tags), number)| {
        if !moves(tags) {
            return *place;
        }
        let far = JITTER * (place.halves.width() + place.halves.height()) / scale.unit();
        let at = [0, 1, 2].map(|axis| (hash(3 * number + axis) * far) as i32);
        place.moved(IVec3::from_array(at))
    });
    moved.collect()
}

/// A pseudo-random number from -1 to 1 (Wellons 2018, lowbias32).
fn hash(seed: u32) -> f32 {
    let mut bits = seed.wrapping_add(0x9e37_79b9);
    bits = (bits ^ (bits >> 16)).wrapping_mul(0x7feb_352d);
    bits = (bits ^ (bits >> 15)).wrapping_mul(0x846c_a68b);
    bits ^= bits >> 16;
    (bits >> 8) as f32 / (1 << 23) as f32 - 1.0
}

/// The control points at the present places. `points` are the control points that the plan was made
/// of. A point that has not moved is returned unchanged.
///
/// **Errors**: [`BackendError`] of the device.
pub fn settled(
    plan: &SettlingPlan,
    settler: &mut dyn Settler,
    points: &[ControlPoint],
) -> Result<Vec<ControlPoint>, BackendError> {
    let mut places = vec![Place::default(); plan.counts().points as usize];
    settler.read(&mut places)?;
    let starts = own_places(plan).map(|(place, _)| place);
    let now = places.iter().zip(starts).zip(points);
    Ok(now.map(|((now, start), point)| if now == start { *point } else { plan.scale().point(now) }).collect())
}

/// The control points at the present places, all converted by
/// [`Scale::point`](super::Scale::point).
///
/// **Errors**: [`BackendError`] of the device.
pub(crate) fn points_of(settler: &mut dyn Settler) -> Result<Vec<ControlPoint>, BackendError> {
    let plan = Arc::clone(settler.plan());
    let mut places: Vec<Place> = zeroed("control points at rest", plan.counts().points)?;
    settler.read(&mut places)?;
    Ok(places.iter().map(|place| plan.scale().point(place)).collect())
}

impl Rest {
    const NOTHING: Self = Self {
        at_rest: false,
        passes: 0,
        block_passes: 0,
        lists: 0,
        neighbours: 0,
        start: SettlingSeen::NOTHING,
        end: SettlingSeen::NOTHING,
    };
}

impl SettlingSeen {
    /// Whether these measures are better than `other` ones. They are compared by clearance in steps
    /// of 0.001, then by the radius of curvature in steps of 0.002 diameters, then by length in
    /// steps of 0.0005, and last by what they lack to be at rest. A clearance of 0.985, a radius of
    /// 0.585 diameters and a length that is off by 1 % are enough. Better values do not count in
    /// the first three comparisons.
    #[must_use]
    pub fn is_better_than(&self, other: &Self) -> bool {
        self.rank() > other.rank()
    }

    fn rank(&self) -> [f32; 4] {
        let steps = |value: f32, enough: f32, step: f32| (value.min(enough) / step).floor();
        [
            steps(self.clearance, 0.985, 0.001),
            steps(self.radius, 0.585, 0.002),
            steps(-self.length, -LENGTH, 0.0005),
            -self.lack(),
        ]
    }

    /// The larger of the shares by which clearance and radius of curvature miss their bounds.
    fn lack(&self) -> f32 {
        (CLEAR - self.clearance).max(BENT - self.radius / BEND_RADIUS)
    }

    /// The measures before any pass.
    pub const NOTHING: Self =
        Self { step: 0.0, clearance: f32::INFINITY, radius: f32::INFINITY, length: 0.0 };

    /// The measures of two passes, or of two parts of a pass, together.
    #[must_use]
    #[inline]
    pub const fn and(self, other: Self) -> Self {
        Self {
            step: self.step.max(other.step),
            clearance: self.clearance.min(other.clearance),
            radius: self.radius.min(other.radius),
            length: self.length.max(other.length),
        }
    }
}
