//! Edited plans, in which some yarns are replaced. Also the conditions for edits, and the
//! [`Stand`]s of the new yarns.

use std::sync::Arc;

use rayon::prelude::*;

use super::Plan;
use crate::backend::Edits;
use crate::stand::Stand;
use crate::{ControlPoint, PlanError, TWIST_LIMIT, Yarn};

impl Plan {
    /// This plan with `what` and `points` as yarn number `yarn`. The points decide whether the yarn
    /// is [steep](crate::Layout::is_steep) and how it [leans](Plan::leans). All offsets stay, so
    /// both plans own one another's chunks. Chunks that hold part of the yarn are out of date.
    ///
    /// **Errors**: [`PlanError::NoRoom`] for more points than there is [room](Plan::with_room) for,
    /// [`PlanError::TooFewPoints`], and [`PlanError::OtherPlan`] for changes that need a new plan:
    /// an open yarn that becomes closed or the other way round, any edit of a yarn whose up
    /// directions are given, a section that the layout lacks, a twist beyond [`TWIST_LIMIT`], or a
    /// twist if no yarn's rolls are scanned.
    ///
    /// **Panics** past the last yarn.
    pub fn edited(&self, yarn: usize, what: Yarn, points: &[ControlPoint]) -> Result<Self, PlanError> {
        self.edited_all(&Edits::from([(yarn, (what, points))]))
    }

    /// Edits many yarns at once, in the time of one new plan. Each edit is checked against this
    /// plan. A twist is refused if this plan scans no yarn's rolls, even if another edit makes a
    /// yarn steep.
    ///
    /// ```
    /// use texere_core::backend::{Edits, Plan};
    /// use texere_core::{ControlPoint, Settings, Yarn, Yarns};
    /// # let mut yarns = Yarns::builder();
    /// # for y in 0..3 {
    /// #     yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, y as f32, 0.0, 0.1)));
    /// # }
    /// # let yarns = yarns.build()?;
    /// let plan = Plan::with_room(yarns.layout().clone(), Settings::default(), |_| 10)?; // three yarns of three points
    /// let points: Vec<_> = (0..7).map(|x| ControlPoint::new(x as f32, 0.0, 0.0, 0.1)).collect();
    /// let edits = Edits::from([(0, (*plan.yarn(0), &points[..])), (2, (*plan.yarn(2), &points[..2]))]);
    /// let edited = plan.edited_all(&edits)?;
    /// assert_eq!([0, 1, 2].map(|yarn| edited.rings(yarn)), [13, 5, 3]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// **Errors** and **panics**: those of [`Plan::edited`], for the first yarn that is refused.
    pub fn edited_all(&self, edits: &Edits<'_>) -> Result<Self, PlanError> {
        for (&yarn, (what, points)) in edits {
            self.check_edit(yarn, what, points.len() as u64)?;
        }
        let mut plan = self.clone();
        Arc::make_mut(&mut plan.layout).edit(edits);
        plan.counts = plan.count();
        let stand = |(&yarn, (what, points)): (&usize, &(Yarn, &[ControlPoint]))| {
            (yarn, Stand::of(points, what.closed, None))
        };
        let stands: Vec<_> = edits.par_iter().map(stand).collect();
        Ok(plan.standing(stands))
    }

    /// This plan with new [`Stand`]s for some yarns, each with the yarn's number.
    pub(crate) fn standing(mut self, stands: impl IntoIterator<Item = (usize, Stand)>) -> Self {
        for (yarn, stand) in stands {
            let leans = stand.leaning.is_some();
            Arc::make_mut(&mut self.layout).set_stand(yarn, stand);
            if leans {
                self.leans.insert(yarn, self.leans_of(yarn));
            } else {
                self.leans.remove(&yarn);
            }
            // A yarn that has become steep may be the first whose rolls are scanned.
            self.needs_scan |= self.turns(yarn);
        }
        self
    }

    /// Checks whether [`Plan::edited`] accepts `what` with `points` control points as yarn number
    /// `yarn`. No plan is made.
    ///
    /// **Errors** and **panics**: those of [`Plan::edited`].
    pub fn check_edit(&self, yarn: usize, what: &Yarn, points: u64) -> Result<(), PlanError> {
        let before = self.yarn(yarn);
        let room = self.offsets.room(yarn, before.closed);
        if points > room {
            return Err(PlanError::NoRoom { yarn, points, room });
        }
        if points < what.points_least() {
            return Err(PlanError::TooFewPoints { yarn, points, least: what.points_least() });
        }
        if self.layout.leaning(yarn).is_some_and(|leaning| leaning.given) {
            return Err(PlanError::OtherPlan {
                yarn,
                what: "edited, where yarns have up directions of their own",
            });
        }
        let turns = !self.settings.frame.is_level(what.twist);
        for (holds, what) in [
            (what.closed == before.closed, "closed or opened"),
            ((what.section as usize) < self.layout.sections().len(), "of a section that the plan lacks"),
            ((-TWIST_LIMIT..=TWIST_LIMIT).contains(&what.twist), "so twisted"),
            (self.needs_scan || !turns, "twisted, where no other yarn is"),
        ] {
            if !holds {
                return Err(PlanError::OtherPlan { yarn, what });
            }
        }
        Ok(())
    }
}
