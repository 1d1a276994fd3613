//! Layers that lie in one another.
//!
//! A thread of the face and a thread of the back do not bend round one another, because their
//! layers lie apart. In open cloth, layers lie in one another: where a thread of the upper layer
//! lies low and a thread of the lower layer lies high, the two would pierce one another. They are
//! pushed apart there, each by half of what they lack.

use rayon::prelude::*;
use texere_core::crossings::ThreadState;

use super::path::Passing;
use super::resting::{BEYOND, Of, Placing};

/// The most rounds of pushes. A push changes the slope of a thread, and moves it at the crossings
/// beside it. With half the value, and with twice, no test is red.
const ROUNDS: usize = 8;

/// Two threads are pushed only if they lack more than this share of the distance that they need.
/// With half the value, and with twice, no test is red.
const LACKING: f64 = 1e-3;

impl Placing<'_> {
    /// For each crossing of the repeat, how far its end and its pick are pushed up, mm. Empty if
    /// all threads belong to one layer.
    pub(super) fn pushes(&self) -> Vec<[f64; 2]> {
        let [ends, picks] = self.resting.repeat();
        let apart: Vec<_> = (0..ends * picks).filter(|&number| !self.binds(number)).collect();
        if apart.is_empty() {
            return Vec::new();
        }
        let mut pushes = vec![[0.0; 2]; ends * picks];
        for _ in 0..ROUNDS {
            let [warp, weft] = [0, 1].map(|set| self.passings(set, &pushes));
            let lacking = |number: usize| {
                let rest = &self.resting.rest[number];
                let need = reach(&rest.warp, weft[number].slope) + reach(&rest.weft, warp[number].slope);
                let rise = warp[number].z - weft[number].z;
                let side = if self.up(number) { 1.0 } else { -1.0 };
                let lacking = need - side * rise;
                (lacking > LACKING * need).then_some((number, 0.5 * side * lacking))
            };
            let lacking: Vec<_> = apart.iter().filter_map(|&number| lacking(number)).collect();
            if lacking.is_empty() {
                break;
            }
            for (number, by) in lacking {
                pushes[number] = [pushes[number][0] + by, pushes[number][1] - by];
            }
        }
        pushes
    }

    /// The paths of a set's threads at the crossings of the repeat that do not bind.
    fn passings(&self, set: usize, pushes: &[[f64; 2]]) -> Vec<Passing> {
        let repeat = self.resting.repeat();
        let of_thread = |thread: usize| {
            let of: Of = (set, thread);
            let met = self.met(of, repeat[1 - set]);
            let mut passings = Vec::new();
            for stops in met.windows(2) {
                let stops = [stops[0], stops[1]];
                let span = self.span(of, stops, stops.map(|stop| self.station(of, stop)), pushes);
                let crossed = (stops[0] + 1).max(BEYOND)..stops[1].min(BEYOND + repeat[1 - set]);
                let passing =
                    |crossed| (self.crossing(of, crossed), span.passing(self.station(of, crossed).at));
                passings.extend(crossed.map(passing));
            }
            passings
        };
        let all: Vec<_> = (0..repeat[set]).into_par_iter().map(of_thread).collect();
        let mut passings = vec![Passing::default(); pushes.len()];
        for (number, passing) in all.into_iter().flatten() {
            passings[number] = passing;
        }
        passings
    }
}

/// How far above the middle of a thread a line passes that has the slope of the crossing thread and
/// just touches the thread.
fn reach(lie: &ThreadState, slope: f64) -> f64 {
    (f64::from(lie.half_width) * slope).hypot(f64::from(lie.half_height))
}
