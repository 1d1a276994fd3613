//! One thread at one crossing, as the terms of the energy see it.

use super::{CrossingState, CrossingsPass, CrossingsPlan, Row, Set, Site, ThreadState};

// The unknowns of a thread, counted from the first of its set.
pub(super) const SHIFT: usize = 0;
pub(super) const HEIGHT: usize = 1;
pub(super) const WIDTH: usize = 2;
pub(super) const THICKNESS: usize = 3;

/// One thread at one crossing.
#[derive(Clone, Copy)]
pub(super) struct Here<'a> {
    pub(super) plan: &'a CrossingsPlan,
    pub(super) pass: &'a CrossingsPass,
    pub(super) all: &'a [CrossingState],
    pub(super) site: Site,
    pub(super) set: Set,
    /// Number of the thread's first unknown.
    pub(super) row: usize,
}

impl Here<'_> {
    pub(super) fn crossing(&self, site: Site) -> &CrossingState {
        &self.all[self.plan.number(site)]
    }

    pub(super) fn thread(&self, site: Site) -> &ThreadState {
        self.crossing(site).thread(self.set)
    }

    pub(super) fn along(&self, steps: i32) -> Option<Site> {
        self.plan.beside(self.site, self.set, steps, 0)
    }

    /// The distance from the crossing at `site` to the next one along the thread.
    pub(super) fn pitch(&self, site: Site) -> f32 {
        self.way(self.set.other(), site, 1)
    }

    /// The distance from the thread of a set at `site` to the thread `steps` after it.
    pub(super) fn way(&self, set: Set, site: Site, steps: i32) -> f32 {
        let rows = self.plan.rows(set);
        let mut way = rows[site.thread(set)].gap;
        for step in 1..steps {
            let next = self.plan.beside(site, set, 0, step);
            way += next.map_or(0.0, |next| rows[next.thread(set)].gap);
        }
        way
    }

    /// The nearest threads of `set` before (-1) and after (1) this crossing, on the level of the
    /// crossing's own thread of `set`. Each comes as the direction, and the distance in threads,
    /// which is 0 if there is no such thread.
    pub(super) fn of_level(&self, set: Set) -> [(i32, i32); 2] {
        let [before, after] = self.plan.neighbours(self.site).beside[set as usize];
        [(-1, i32::from(before)), (1, i32::from(after))]
    }

    /// The slope of the thread from the crossing to the one before or after, whichever is steeper.
    pub(super) fn steepest(&self) -> f32 {
        let slope = |steps: i32| {
            self.along(steps).map_or(0.0, |other| {
                let pitch = self.pitch(if steps < 0 { other } else { self.site });
                ((self.thread(other).height - self.thread(self.site).height) / pitch).abs()
            })
        };
        slope(-1).max(slope(1))
    }

    pub(super) fn thread_row(&self) -> &Row {
        &self.plan.rows(self.set)[self.site.thread(self.set)]
    }
}
