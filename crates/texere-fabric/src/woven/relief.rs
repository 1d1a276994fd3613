//! Relief of jammed threads: another share of the crimp, flatter threads, or thinner ones.

use texere_core::{Origin, RADIUS_MAX, RADIUS_MIN};

use super::crimp::{Crimp, SHARE_MIN};
use super::jam::{Gap, ROUNDING, reach};
use super::{BySet, FLATNESS_MAX, Shape, Thread, Woven};
use crate::{FabricError, ThreadError, WovenError};

/// What is done about jammed threads. Threads are jammed if they lie so close together that
/// crossing threads can't pass between them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[non_exhaustive]
pub enum Relief {
    /// Nothing is changed. Jammed threads are only reported.
    #[default]
    Report,
    /// Another share of the crimp, then flatter threads. A thread keeps its area and becomes wider
    /// ([`Thread::flatness`]), as far as the threads beside it allow. Threads that cross it then
    /// rise less.
    Flatten,
    /// Another share of the crimp, then smaller diameters for all threads until no thread is
    /// jammed. Materials keep their tex.
    Shrink,
}

/// How close the threads of one set lie, compared with the least pitch at which crossing threads
/// are not jammed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tightness {
    /// Number of threads whose pitch, the distance to the thread before, is less than the least
    /// pitch.
    pub jammed: usize,
    /// The thread whose pitch is the smallest share of the least pitch that it needs. None if no
    /// thread changes sides between two threads of the set.
    pub tightest: Option<Origin>,
    /// The least pitch that the tightest thread needs, mm.
    pub pitch_min_mm: f64,
    /// The pitch of the tightest thread, mm.
    pub pitch_mm: f64,
}

/// What [`Woven::relieve`] has found and changed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JamReport {
    /// The tightness of both sets before relief.
    pub before: BySet<Tightness>,
    /// The tightness of both sets after relief.
    pub after: BySet<Tightness>,
    /// The warp's share of the crimp, before relief and after.
    pub warp_share: [f32; 2],
    /// Factor by which the width of all threads of a set grew, 1 if it did not. Their height fell
    /// in the same ratio.
    pub widened: BySet<f32>,
    /// Factor by which all diameters were multiplied, 1 if none was.
    pub scaled: f32,
}

/// The pitch that counts as enough, over the pitch at which threads are just not jammed. Threads
/// then stay slightly above 0.99 of touching. In tests of round threads, the least values that were
/// enough were 1.0 at a share of 0.5, 1.04 at 0.35 and 1.15 at 0.2. Ellipses twice as wide as high,
/// measured by their surfaces, needed 1.02 at 0.5 and 1.1 at 0.35.
fn slack(share: f32) -> f32 {
    1.03 + 0.5 * (share - 0.5).abs()
}

/// Step in which factors of widths are tried.
const WIDTH_STEP: f32 = 0.05;
/// Step in which shares of the crimp are tried.
const SHARE_STEP: f32 = 0.025;

/// The largest factor of a thread's width. Its width over height is then four times as large as
/// before.
const WIDENED_MAX: f32 = 2.0;

/// A change of the share of the crimp and of the widths of threads. All threads keep their area.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Change {
    share: f32,
    /// Factors of the widths of ends and of picks.
    widened: [f32; 2],
}

/// The gaps of a set that can be the tightest. A gap has two values: half the sum of the widths of
/// its two threads, and the height of the thickest thread that changes sides between them. Both are
/// divided by the gap's pitch.
struct Needs(Vec<[f32; 2]>);

impl Needs {
    fn new(gaps: &[Gap]) -> Self {
        let mut needs: Vec<[f32; 2]> = gaps
            .iter()
            .map(|gap| [gap.widths, gap.between.unwrap_or(0.0)].map(|size| size / gap.pitch as f32))
            .collect();
        // The gaps whose threads take the largest share of the pitch come first. After a gap, only
        // gaps with thicker threads between can be tighter.
        needs.sort_by(|a, b| b[0].total_cmp(&a[0]).then(b[1].total_cmp(&a[1])));
        let mut thickest = f32::NEG_INFINITY;
        needs.retain(|[_, between]| {
            let more = *between > thickest;
            thickest = thickest.max(*between);
            more
        });
        Self(needs)
    }

    /// The largest pitch that a gap needs, over the gap's pitch. `share` is the share of the crimp
    /// of the threads between. `own` and `crossing` are the factors of the widths of the set and of
    /// the crossing set.
    fn worst(&self, share: f32, own: f32, crossing: f32) -> f32 {
        let needed = |[widths, between]: &[f32; 2]| {
            let beside = widths * own;
            let passing = slack(share) * reach(share) * (beside + between / crossing);
            if *between > 0.0 { passing.max(beside) } else { beside }
        };
        self.0.iter().map(needed).fold(0.0, f32::max)
    }
}

impl Woven {
    /// Makes room for jammed threads, as `relief` says, and reports the threads before and after.
    ///
    /// First the warp's share of the crimp changes, between 20 and 80 %, and no more than it must.
    /// A share that was given as [`Crimp::WarpShare`] stays. The share comes first because it
    /// changes no thread's size. In real cloth, too, a dense set bends more, and the threads that
    /// cross it straighten. Threads that are still jammed are then flattened or thinned.
    ///
    /// Flattening changes the set that passes between the jammed threads. A wider thread needs more
    /// room beside it, so that relief of one set may jam the other. Threads that can't be relieved
    /// stay jammed, and are reported. All threads of a set are flattened alike, because finishing
    /// can't single out threads. Their sections stay inside the flattened outline, also where they
    /// turn with the twist.
    ///
    /// A pitch counts as enough from 1.03 times the least pitch, if both sets have half of the
    /// crimp, to 1.18 times, if one has a fifth. With less the spline does not keep the threads
    /// clear of one another. The least pitch is that of [`Shape::Round`], whatever the cloth's own
    /// shape.
    ///
    /// **Errors**: [`ThreadError::Radius`] or [`WovenError::Half`] if a radius, a half width or a
    /// half height would be less than [`RADIUS_MIN`] or more than [`RADIUS_MAX`]. After an error
    /// the cloth is unchanged.
    ///
    /// ```
    /// use texere_core::{Material, Section};
    /// use texere_fabric::{BySet, Relief, Thread, Weave, Woven};
    /// // Denim: ends 1.3 diameters apart.
    /// let twill = Weave::parse("3/1")?.drawdown(20, 20)?;
    /// let (warp, weft) = (vec![Thread::new(0.39, 0.15); 20], vec![Thread::new(0.66, 0.15); 20]);
    /// let mut cloth = Woven::new(twill, warp, weft, vec![Material::default()], vec![Section::Circle])?;
    /// let report = cloth.relieve(Relief::Flatten)?;
    /// assert_eq!(report.before.map(|set| set.jammed), BySet { warp: 19, weft: 0 });
    /// assert_eq!(report.after.map(|set| set.jammed), BySet { warp: 0, weft: 0 });
    /// assert!(report.warp_share[1] > report.warp_share[0]);
    /// # Ok::<(), texere_fabric::FabricError>(())
    /// ```
    pub fn relieve(&mut self, relief: Relief) -> Result<JamReport, FabricError> {
        let [warp, weft] = self.gaps();
        let share = self.warp_share();
        let before = tightness(&warp, &weft, share);
        let now = Change { share, widened: [1.0; 2] };
        let needs = [Needs::new(&warp), Needs::new(&weft)];
        let worst = |change: &Change| {
            let [ends, picks] = change.widened;
            let warp = needs[0].worst(1.0 - change.share, ends, picks);
            warp.max(needs[1].worst(change.share, picks, ends))
        };

        let (mut change, mut scaled) = (now, 1.0);
        if relief != Relief::Report && worst(&now) > 1.0 {
            change = best(&self.shares(share), &[1.0], &[1.0], now, worst);
            let left = worst(&change);
            if relief == Relief::Shrink && left > 1.0 {
                // The factor is a little smaller, so that rounding does not leave too little room.
                scaled = (1.0 - ROUNDING as f32) / left;
            } else if relief == Relief::Flatten && left > 1.0 {
                let [ends, picks] = [self.warp(), self.weft()].map(Self::widths);
                change = best(&self.shares(share), &ends, &picks, now, worst);
            }
        }
        self.apply(change, scaled)?;

        let [warp, weft] = self.gaps();
        let after = tightness(&warp, &weft, self.warp_share());
        Ok(JamReport {
            before,
            after,
            warp_share: [share, change.share],
            widened: BySet::of(change.widened),
            scaled,
        })
    }

    /// The warp's shares that are tried: `share` and, if the share was not given, all others.
    fn shares(&self, share: f32) -> Vec<f32> {
        let steps = ((1.0 - 2.0 * SHARE_MIN) / SHARE_STEP).round() as u32;
        match self.crimp() {
            Crimp::WarpShare(_) => vec![share],
            Crimp::Stiffness => {
                let others = (0..=steps).map(|step| SHARE_MIN + step as f32 * SHARE_STEP);
                std::iter::once(share).chain(others).collect()
            }
        }
    }

    /// The factors of a set's widths that are tried.
    fn widths(set: &[Thread]) -> Vec<f32> {
        let steps = ((WIDENED_MAX - 1.0) / WIDTH_STEP).round() as u32;
        let flattest = set.iter().map(|thread| thread.flatness).fold(0.0, f32::max);
        let fits = |factor: &f32| flattest * factor * factor <= FLATNESS_MAX;
        let factors = (1..=steps).map(|step| 1.0 + step as f32 * WIDTH_STEP).filter(fits);
        std::iter::once(1.0).chain(factors).collect()
    }

    fn apply(&mut self, change: Change, scaled: f32) -> Result<(), FabricError> {
        let ends = (1..).map(Origin::End).zip(&self.warp).map(|thread| (thread, change.widened[0]));
        let picks = (1..).map(Origin::Pick).zip(&self.weft).map(|thread| (thread, change.widened[1]));
        let (low, high) = (RADIUS_MIN, RADIUS_MAX);
        for ((thread, each), wider) in ends.chain(picks) {
            let radius_mm = each.radius_mm * scaled;
            if radius_mm < RADIUS_MIN {
                return Err(ThreadError::Radius { thread, radius_mm, low, high }.into());
            }
            let [half_width, half_height] = each.halves_mm();
            let halves = [("width", half_width * scaled * wider), ("height", half_height * scaled / wider)];
            if let Some((side, half_mm)) = halves.into_iter().find(|(_, half)| !(low..=high).contains(half)) {
                return Err(WovenError::Half { thread, side, half_mm, low, high }.into());
            }
        }
        if change.share != self.warp_share() {
            self.crimp = Crimp::WarpShare(change.share);
        }
        for (threads, factor) in [&mut self.warp, &mut self.weft].into_iter().zip(change.widened) {
            threads.iter_mut().for_each(|thread| thread.flatness *= factor * factor);
        }
        for thread in self.warp.iter_mut().chain(&mut self.weft) {
            thread.radius_mm *= scaled;
        }
        Ok(())
    }
}

/// The smallest change with which nothing is jammed or, if there is none, the change with which the
/// cloth is least jammed. If several changes relieve the cloth equally, the one that widens threads
/// least is taken. If several widen threads equally, the one that changes the share least is taken.
fn best(shares: &[f32], ends: &[f32], picks: &[f32], now: Change, worst: impl Fn(&Change) -> f32) -> Change {
    let cost = |change: &Change| {
        let excess = (worst(change) - 1.0).max(0.0);
        let widened = change.widened[0] * change.widened[1];
        (excess, widened, (change.share - now.share).abs())
    };
    let mut found = (cost(&now), now);
    for &share in shares {
        for &end in ends {
            for &pick in picks {
                let change = Change { share, widened: [end, pick] };
                let cost = cost(&change);
                if cost < found.0 {
                    found = (cost, change);
                }
            }
        }
    }
    found.1
}

/// Tightness of ends and picks. `share` is the warp's share of the crimp.
fn tightness(warp: &[Gap], weft: &[Gap], share: f32) -> BySet<Tightness> {
    let set = |gaps: &[Gap], share: f32, origin: fn(u32) -> Origin| {
        let mut found = Tightness { jammed: 0, tightest: None, pitch_min_mm: 0.0, pitch_mm: 0.0 };
        for gap in gaps.iter().filter(|gap| gap.between.is_some()) {
            let needed = gap.needed(Shape::Round, share);
            found.jammed += usize::from(needed > gap.pitch * (1.0 + ROUNDING));
            if found.tightest.is_none() || needed * found.pitch_mm > found.pitch_min_mm * gap.pitch {
                (found.pitch_min_mm, found.pitch_mm) = (needed, gap.pitch);
                found.tightest = Some(origin(gap.thread));
            }
        }
        found
    };
    BySet { warp: set(warp, 1.0 - share, Origin::End), weft: set(weft, share, Origin::Pick) }
}
