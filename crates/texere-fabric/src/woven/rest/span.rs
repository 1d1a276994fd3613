//! The way of a thread between two crossings at which it bends.

use std::f64::consts::FRAC_PI_2;

use super::path::{Change, Passing, Station, float};
use super::stop::Stop;

/// The way of a thread between two crossings at which it bends.
#[derive(Debug)]
pub(super) struct Span {
    one: Station,
    two: Station,
    /// The crossings between the two, which the thread passes without a bend, and how far it is
    /// pushed up at each, mm. If the thread stays on its side, the `z` of each of these stations
    /// lies on the straight line between `one` and `two`, plus the push.
    passed: Vec<(Station, f64)>,
    /// Number of control points of a change of sides.
    points: usize,
}

impl Span {
    /// The way between two crossings. `passed` are the crossings between them, in order, and how
    /// far the thread is pushed up at each, mm. A change of sides has `points` control points.
    pub(super) fn new([one, two]: [Station; 2], mut passed: Vec<(Station, f64)>, points: usize) -> Self {
        if one.side == two.side {
            for (station, by) in &mut passed {
                let share = (station.at - one.at) / (two.at - one.at);
                station.z = one.z + share * (two.z - one.z) + *by;
            }
        }
        Self { one, two, passed, points }
    }

    /// The pairs of neighbouring stations of a thread that stays on its side.
    fn pairs(&self) -> impl Iterator<Item = [&Station; 2]> {
        let stations = || self.passed.iter().map(|(station, _)| station);
        std::iter::once(&self.one).chain(stations()).zip(stations().chain([&self.two])).map(Into::into)
    }

    /// Whether a place lies between the first crossing and the place `along`.
    fn is_before(&self, place: f64, along: f64) -> bool {
        (place - self.one.at) * (along - place) > 0.0
    }

    /// The neighbouring stations that the place `along` lies between.
    fn pair_at(&self, along: f64) -> [&Station; 2] {
        let mut pairs = self.pairs();
        pairs.find(|[_, to]| !self.is_before(to.at, along)).unwrap_or([&self.one, &self.two])
    }

    /// The change of sides between the two crossings. `turns` says whether the thread also changes
    /// sides before the first, and after the second.
    fn change(&self, turns: [bool; 2]) -> Change<'_> {
        Change::new(&self.one, &self.two, turns, self.points)
    }

    /// Calls `stop` with the control points between the two crossings. `changes` says whether the
    /// thread changes sides before the first and after the second.
    pub(super) fn stops(&self, changes: [bool; 2], stop: &mut impl FnMut(Stop)) {
        if self.one.side != self.two.side {
            self.change(changes).points().for_each(|at| stop(self.push(at)));
            return;
        }
        let last = self.passed.len();
        for (number, [from, to]) in self.pairs().enumerate() {
            let beside = [changes[0] && number == 0, changes[1] && number == last];
            float(from, to, beside, self.points).for_each(&mut *stop);
            if number < last {
                stop(to.stop());
            }
        }
    }

    /// Calls `stop` with the control points from the first crossing to the place `edge`, where the
    /// thread is cut off. `changes` says whether the thread changes sides before the first
    /// crossing.
    pub(super) fn until(&self, edge: f64, changes: bool, stop: &mut impl FnMut(Stop)) {
        if self.one.side != self.two.side {
            self.change([changes, false]).until(edge).for_each(|at| stop(self.push(at)));
            return;
        }
        self.stops([changes, false], &mut |at| {
            if self.is_before(at.along, edge) {
                stop(at);
            }
        });
        let pair = self.pair_at(edge);
        stop(pair[0].stop().towards(&pair[1].stop(), edge));
    }

    /// The path of the thread at `along`.
    pub(super) fn passing(&self, along: f64) -> Passing {
        if self.one.side != self.two.side {
            let way = self.change([false; 2]).passing(along);
            return Passing { z: way.z + self.pushed_at(along), ..way };
        }
        let pair = self.pair_at(along);
        let [run, rise] = [pair[1].at - pair[0].at, pair[1].z - pair[0].z];
        Passing { z: pair[0].z + (along - pair[0].at) / run * rise, slope: (rise / run).abs() }
    }

    /// A control point of a change of sides, pushed.
    fn push(&self, stop: Stop) -> Stop {
        Stop { z: stop.z + self.pushed_at(stop.along), ..stop }
    }

    /// How far a thread that changes sides is pushed up at `along`, mm. A push fades to both sides,
    /// and is 0 at the nearer of the two crossings.
    fn pushed_at(&self, along: f64) -> f64 {
        let at = |(station, by): &(Station, f64)| {
            let reach = (station.at - self.one.at).abs().min((self.two.at - station.at).abs());
            let share = ((along - station.at) / reach).abs();
            if share < 1.0 { by * (FRAC_PI_2 * share).cos().powi(2) } else { 0.0 }
        };
        self.passed.iter().map(at).sum()
    }
}
