//! The course of a settling: how yarns grow, when neighbours are listed again, and when it is done.

use std::ops::ControlFlow;
use std::sync::Arc;

use glam::IVec3;

use super::plan::{OVERSHOOT, SKIN};
use super::{
    BEND_RADIUS, Form, Length, MARGIN, Pass, Place, Settler, SettlingPlan, SettlingSeen, moves, tag,
};
use crate::backend::zeroed;
use crate::{BackendError, ControlPoint};

/// How thick yarns are at first, and in how many steps of how many passes they grow.
const THIN: f32 = 0.25;
const STEPS: u32 = 10;
const STEP_PASSES: u32 = 4;

/// Up to which share of the last stage what eases the way has its full strength, and from which on
/// it has none.
const EASES: [f32; 2] = [0.3, 0.6];

/// How far points are moved at the start, in diameters: symmetrical yarns may balance where they
/// can't stay.
const JITTER: f32 = 0.01;

/// Yarns are clear of one another where their distance over both reaches is that.
const CLEAR: f32 = 0.995;

/// The share of [`BEND_RADIUS`] that bends have to keep.
const BENT: f32 = 0.99;

/// By how much the length of an interval may differ from what it is to be.
const LENGTH: f32 = 0.01;

/// The weighted form has stalled where so many passes have not taken a tenth off what is lacking.
const STALLS: u32 = 20;
const STALLED: f32 = 0.9;

/// What came of a settling.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rest {
    /// Whether everything that is asked of rest is so.
    pub at_rest: bool,
    /// Passes in all, and those of the block form among them.
    pub passes: u32,
    /// The passes of the block form.
    pub block_passes: u32,
    /// How often neighbours were listed.
    pub lists: u32,
    /// Neighbours that were listed last, of all chords.
    pub neighbours: u64,
    /// What was seen at the start.
    pub start: SettlingSeen,
    /// What is seen at the end.
    pub end: SettlingSeen,
}

/// Settles on a device, and leaves there the best places that were seen: by clearance, then by
/// bends, then by length. `watch` sees every pass; where it breaks off, the best until then are
/// left.
///
/// Yarns grow from a quarter of their thickness, and bends are soft at first. The weighted form of
/// the pass goes on until all is at rest or until it stalls; then the block form does, with as many
/// passes at most.
///
/// **Errors**: [`BackendError`] of the device.
pub fn settle(
    plan: &SettlingPlan,
    settler: &mut dyn Settler,
    watch: impl FnMut(&Pass, &SettlingSeen) -> ControlFlow<()>,
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
    /// Whether `watch` has broken off.
    stopped: bool,
    /// The growth at which neighbours were listed last, and how far points have moved at most
    /// since, mm.
    listed: f32,
    moved: f32,
    /// What was lacking when a tenth was last taken off it, and in which pass that was.
    lacked: (f32, u32),
    rest: Rest,
}

impl<W: FnMut(&Pass, &SettlingSeen) -> ControlFlow<()>> Run<'_, W> {
    fn whole(mut self) -> Result<Rest, BackendError> {
        let places: Vec<Place> = own_places(self.plan).map(|(place, _)| *place).collect();
        self.settler.upload(&places)?;
        // As they are, to come back to if nothing better is found.
        let start = self.pass(&Pass { form: Form::Weighted, growth: 1.0, ease: 0.0, momentum: 0.0 })?;
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
            let seen = self.pass(&pass)?;
            if pass.ease == 0.0 && self.weigh(&seen)? || self.stopped {
                return self.ended();
            }
            if pass.ease == 0.0 && self.has_stalled(&seen, number) {
                break;
            }
        }
        for _ in 0..passes {
            let seen = self.pass(&Pass { form: Form::Block, growth: 1.0, ease: 0.0, momentum: 0.8 })?;
            self.rest.block_passes += 1;
            if self.weigh(&seen)? || self.stopped {
                break;
            }
        }
        self.ended()
    }

    /// Makes a pass, with neighbours listed anew where some may be missing.
    fn pass(&mut self, pass: &Pass) -> Result<SettlingSeen, BackendError> {
        let spans = self.plan.spans();
        let grown = 2.0 * MARGIN * spans.thickest * (pass.growth - self.listed).max(0.0);
        if 2.0 * OVERSHOOT * self.moved + grown > SKIN * spans.diameter {
            self.rest.neighbours = self.settler.list(pass.growth)?;
            (self.listed, self.moved) = (pass.growth, 0.0);
            self.rest.lists += 1;
        }
        let seen = self.settler.pass(pass)?;
        self.moved += seen.step;
        self.rest.passes += 1;
        self.stopped = (self.watch)(pass, &seen).is_break();
        Ok(seen)
    }

    /// Keeps what was seen if it is the best so far, and says whether it is at rest.
    fn weigh(&mut self, seen: &SettlingSeen) -> Result<bool, BackendError> {
        self.rest.at_rest = self.is_rest(seen);
        // Where lengths are free nothing is asked of them.
        let asked =
            |seen: &SettlingSeen| if self.holds() { *seen } else { SettlingSeen { length: 0.0, ..*seen } };
        if self.rest.at_rest || asked(seen).is_better_than(&asked(&self.rest.end)) {
            self.settler.keep()?;
            self.rest.end = *seen;
        }
        Ok(self.rest.at_rest)
    }

    /// Whether what is lacking has hardly become less in the last passes.
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

    /// How much is lacking to rest: the largest share of all that is asked.
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

/// Passes until yarns have their full thickness.
const GROWING: u32 = STEPS * STEP_PASSES;

/// What pass `number` is made with, where `passes` are made at full thickness.
fn weighted(number: u32, passes: u32) -> Pass {
    let step = (number / STEP_PASSES).min(STEPS);
    let growth = THIN + (1.0 - THIN) * (step as f32 / STEPS as f32);
    let share = number.saturating_sub(GROWING) as f32 / passes as f32;
    let ease = ((EASES[1] - share) / (EASES[1] - EASES[0])).clamp(0.0, 1.0);
    Pass { form: Form::Weighted, growth, ease, momentum: 0.8 }
}

/// The places of control points, and what they are.
fn own_places(plan: &SettlingPlan) -> impl Iterator<Item = (&Place, u32)> {
    let all = plan.places().iter().zip(plan.tags().iter().copied());
    all.filter(|(_, tags)| tags & tag::POINT != 0)
}

/// The places of all control points, each moved a little in a direction of its own.
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

/// A number from -1 to 1 that looks like chance, from `seed` (Wellons 2018, lowbias32).
fn hash(seed: u32) -> f32 {
    let mut bits = seed.wrapping_add(0x9e37_79b9);
    bits = (bits ^ (bits >> 16)).wrapping_mul(0x7feb_352d);
    bits = (bits ^ (bits >> 15)).wrapping_mul(0x846c_a68b);
    bits ^= bits >> 16;
    (bits >> 8) as f32 / (1 << 23) as f32 - 1.0
}

/// The control points where everything lies now. `points` are those that the plan was made of: one
/// that has not moved is the same.
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

/// The control points where everything lies now, all by [`Scale::point`](super::Scale::point).
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
    /// Whether it is better: by clearance in thousandths, where that is the same by the radius of
    /// curvature in steps of 0.002 diameters, then by length in steps of 0.0005, and last by what
    /// is lacking to rest. A clearance of 0.985 is enough, as are a radius of 0.585 diameters and a
    /// length that is off by 1 %: what is more does not count.
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

    /// How much is lacking to clear yarns and bends that are not too tight: the larger share.
    fn lack(&self) -> f32 {
        (CLEAR - self.clearance).max(BENT - self.radius / BEND_RADIUS)
    }

    /// Nothing yet.
    pub const NOTHING: Self =
        Self { step: 0.0, clearance: f32::INFINITY, radius: f32::INFINITY, length: 0.0 };

    /// What both have seen.
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
