//! The lean of each ring of a yarn.

use std::sync::Arc;

use super::Plan;
use crate::definitions::Turn;
use crate::interval::{intervals, neighbours};
use crate::lean::IntervalLean;

impl Plan {
    /// The lean of each ring of `yarn`. Empty for a yarn that does not lean.
    pub(super) fn leans_of(&self, yarn: usize) -> Arc<[Turn]> {
        let Some(leaning) = self.layout.leaning(yarn) else { return Arc::default() };
        let (points, ups, closed) = (&leaning.points, &leaning.ups, self.yarn(yarn).closed);
        let (intervals, per_interval) = (intervals(points, closed), self.sampling.subdivisions() + 1);
        let last = intervals.end - 1;
        let mut rings = Vec::with_capacity(intervals.len() * per_interval as usize + 1);
        for interval in intervals {
            let ends = [interval, (interval + 1) % ups.len()].map(|point| ups[point]);
            let lean = IntervalLean::new(&neighbours(points, closed, interval), ends, self.sampling.s());
            rings.extend((0..per_interval).map(|part| lean.at(part as f32 * self.sampling.step())));
            if interval == last {
                rings.push(if closed { rings[0] } else { lean.at(1.0) });
            }
        }
        rings.into()
    }
}
