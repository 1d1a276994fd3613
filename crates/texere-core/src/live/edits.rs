//! Edits of a live mesh: replacing yarns, and moving control points.

use std::ops::Range;
use std::sync::Arc;

use rayon::prelude::*;

use super::{LiveMesh, runs};
use crate::backend::{Edits, PaddedPoints, Plan, SessionError};
use crate::engine::Engine;
use crate::stand::Stand;
use crate::yarns::check_points;
use crate::{ControlPoint, PlanError, Yarn};

impl<E: Engine + ?Sized> LiveMesh<E> {
    /// Replaces control points. The first of `points` is number `first` of the present fabric. The
    /// next [`LiveMesh::update`] makes again all rings that they affect.
    ///
    /// **Errors**: [`SessionError::UploadRange`] past the last control point,
    /// [`SessionError::Yarns`] for an invalid point, [`SessionError::Plan`] if points of a yarn
    /// with given up directions change, and [`SessionError::Backend`].
    pub fn upload(&mut self, first: u64, points: &[ControlPoint]) -> Result<(), SessionError> {
        let (end, total) = (first.saturating_add(points.len() as u64), self.plan.layout().point_count());
        if end > total {
            return Err(SessionError::UploadRange { first, end, points: total });
        }
        let yarns = self.plan.layout().yarns_of(first..end);
        for yarn in yarns.clone() {
            let [own, sent] = self.plan.layout().points_of(yarn, &(first..end));
            check_points(yarn, &points[sent.clone()])?;
            // Given up directions belong to the points that they were given with.
            let given = self.plan.layout().leaning(yarn).filter(|leaning| leaning.given);
            if given.is_some_and(|leaning| leaning.points[own] != points[sent]) {
                let what = "moved, where yarns have up directions of their own";
                return Err(PlanError::OtherPlan { yarn, what }.into());
            }
        }
        self.note_stands(first, points, yarns.clone())?;
        for yarn in yarns {
            let [own, _] = self.plan.layout().points_of(yarn, &(first..end));
            self.note(yarn, self.rings_of(yarn, &own));
        }
        self.traffic.uploaded += self.engine.upload(first, points)?;
        Ok(())
    }

    /// Replaces yarn number `yarn`, counted from 0, by another yarn, which may have more or fewer
    /// control points.
    ///
    /// **Errors**: the errors of [`LiveMesh::set_yarns`].
    pub fn set_yarn(&mut self, yarn: usize, what: Yarn, points: &[ControlPoint]) -> Result<(), SessionError> {
        self.set_yarns(&Edits::from([(yarn, (what, points))]))
    }

    /// Replaces many yarns at once, each by another yarn, which may have more or fewer control
    /// points. The mesh is planned once for all of them.
    ///
    /// ```
    /// use std::sync::Arc;
    /// use texere_core::backend::{Edits, LiveMesh, NullBackend, Plan};
    /// use texere_core::{ControlPoint, Settings, Yarn, Yarns};
    /// # let mut yarns = Yarns::builder();
    /// # for y in 0..3 {
    /// #     yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, y as f32, 0.0, 0.1)));
    /// # }
    /// # let yarns = yarns.build()?;
    /// let plan = Plan::with_room(yarns.layout().clone(), Settings::default(), |_| 16)?; // three yarns of three points
    /// let mut live = LiveMesh::new(&NullBackend::default(), Arc::new(plan))?;
    /// live.upload(0, yarns.points())?;
    ///
    /// // Yarns 0 and 2 get four points.
    /// let line = |y| [0.0, 0.8, 1.2, 2.0].map(|x| ControlPoint::new(x, y, 0.0, 0.1));
    /// let (first, last) = (line(0.0), line(2.0));
    /// let yarn = Yarn::default();
    /// live.set_yarns(&Edits::from([(0, (yarn, &first[..])), (2, (yarn, &last[..]))]))?;
    /// assert_eq!([0, 1, 2].map(|yarn| live.plan().rings(yarn)), [7, 5, 7]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// The new yarns' splines have the tension of the plan's [layout](crate::Layout::tension).
    ///
    /// **Errors**: [`SessionError::NoYarn`], the errors of [`Plan::edited_all`],
    /// [`SessionError::Yarns`] for an invalid point, and [`SessionError::Backend`]. All of these
    /// but the last leave everything unchanged, whichever yarn is refused.
    pub fn set_yarns(&mut self, edits: &Edits<'_>) -> Result<(), SessionError> {
        let yarns = self.plan.layout().yarns().len();
        if let Some((&yarn, _)) = edits.range(yarns..).next() {
            return Err(SessionError::NoYarn { yarn, yarns });
        }
        for (&yarn, (_, points)) in edits {
            check_points(yarn, points)?;
        }
        let plan = self.plan.edited_all(edits)?;
        let numbers: Vec<_> = edits.keys().copied().collect();
        if *plan.layout() != *self.plan.layout() {
            self.replan(&numbers, plan)?;
        }
        numbers.iter().for_each(|&yarn| self.note(yarn, 0..self.plan.rings(yarn)));
        for run in runs(&numbers) {
            let first = self.plan.layout().offsets()[run.start];
            let points: Vec<_> = edits.range(run).flat_map(|(_, (_, points))| *points).copied().collect();
            self.points.upload(&self.plan, first, &points);
            self.traffic.uploaded += self.engine.upload(first, &points)?;
        }
        Ok(())
    }

    /// Stores control points of some yarns, and notes the yarns whose [`Stand`] changes with them:
    /// yarns that become steep, are no longer steep, or lean in another way.
    fn note_stands(
        &mut self,
        first: u64,
        points: &[ControlPoint],
        yarns: Range<usize>,
    ) -> Result<(), SessionError> {
        self.points.upload(&self.plan, first, points);
        let (plan, padded) = (&self.plan, &self.points);
        let stands = yarns.into_par_iter().filter_map(|yarn| {
            let before = plan.layout().stand(yarn);
            let given = before.leaning.as_ref().is_some_and(|leaning| leaning.given);
            let stand = (!given).then(|| stands_now(plan, padded, yarn))?;
            (stand != before).then_some((yarn, stand))
        });
        let stands: Vec<_> = stands.collect();
        let changed: Vec<_> = stands.iter().map(|(yarn, _)| *yarn).collect();
        if !changed.is_empty() {
            self.replan(&changed, Plan::clone(&self.plan).standing(stands))?;
            changed.into_iter().for_each(|yarn| self.note(yarn, 0..self.plan.rings(yarn)));
        }
        Ok(())
    }

    /// Replaces the present plan by one that differs in `yarns`, which are in order.
    fn replan(&mut self, yarns: &[usize], plan: Plan) -> Result<(), SessionError> {
        let plan = Arc::new(plan);
        for run in runs(yarns) {
            self.engine.replan(plan.clone(), run)?;
        }
        self.plan = plan;
        let mut cut = 0;
        for run in runs(yarns) {
            // Runs may share a chunk, which is cut again only once.
            let chunks = self.chunks_of(run.start).start..self.chunks_of(run.end - 1).end;
            for number in chunks.start.max(cut)..chunks.end {
                self.chunks[number] = self.plan.recut(&self.chunks[number]);
            }
            cut = chunks.end;
        }
        Ok(())
    }

    /// The rings affected by control points `own` of `yarn`, counted from its first. If the plan
    /// needs a scan, the whole yarn is affected, because a change of roll at one place turns all
    /// rings behind it. The whole yarn also counts if it is closed or if attributes are made.
    fn rings_of(&self, yarn: usize, own: &Range<usize>) -> Range<u32> {
        let rings = self.plan.rings(yarn);
        let per_interval = u64::from(self.plan.settings().subdivisions) + 1;
        let (first, end) = (own.start as u64, own.end as u64);
        // A point affects the two intervals before it and the two behind. The ring at the end of
        // the last of them is included.
        let (from, to) = (first.saturating_sub(2) * per_interval, (end + 1).saturating_mul(per_interval) + 1);
        if self.attributes || self.plan.needs_scan() || self.plan.yarn(yarn).closed {
            return 0..rings;
        }
        from.min(u64::from(rings)) as u32..to.min(u64::from(rings)) as u32
    }
}

/// The [`Stand`] of `yarn` with its present control points.
fn stands_now(plan: &Plan, points: &PaddedPoints, yarn: usize) -> Stand {
    let offsets = plan.layout().offsets();
    let count = (offsets[yarn + 1] - offsets[yarn]) as usize;
    Stand::of(&points.yarn(plan, yarn)[1..=count], plan.yarn(yarn).closed, None)
}
