//! The path of a thread between two crossings at rest.

use texere_core::crossings::StraightPassage;

use super::ease::ease;
use super::stop::{CHANGE_POINTS, Stop};

/// Distance of a float's control point from a crossing beside a change of sides, in steps. A step
/// is here the way from crossing to crossing, divided by the number of steps of a change of sides.
/// With this point the steps of the spline grow slowly, so that the spline does not swing out. With
/// half the value, `woven_cloth_at_rest_has_the_same_numbers_small_and_large` is red; with twice,
/// `turns_of_uneven_picks_do_not_touch`.
const FLOAT_STEP: f64 = 1.8;

/// Number of parts into which each arc, and the straight line between the arcs, is divided. With
/// half the value, and with twice, `straight_threads_stretch_no_further` is red.
const PARTS: usize = 8;

/// Number of halvings in the search for a slope.
const HALVINGS: usize = 30;

/// A thread at a crossing, mm.
#[derive(Debug, Clone, Copy)]
pub(super) struct Station {
    /// Number of the crossed thread, counted from 0.
    pub(super) number: usize,
    /// Place of the crossed thread along this one.
    pub(super) at: f64,
    /// Half width and half height of the crossed thread.
    pub(super) crossed: [f64; 2],
    /// Height of the crossed thread's middle.
    pub(super) crossed_z: f64,
    /// 1 if this thread lies on top, -1 if it lies below.
    pub(super) side: f64,
    /// Place of this thread across its own direction.
    pub(super) across: f64,
    /// Height of this thread.
    pub(super) z: f64,
    /// Half height of this thread at rest.
    pub(super) half_height: f64,
    /// Half width and half height of this thread that are drawn.
    pub(super) drawn: [f64; 2],
}

impl Station {
    pub(super) fn stop(&self) -> Stop {
        Stop {
            along: self.at,
            across: self.across,
            z: self.z,
            halves: self.drawn,
            crossing: Some(self.number),
        }
    }
}

/// A thread on its way between two crossings.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Passing {
    /// The height of the thread's middle, mm.
    pub(super) z: f64,
    /// How steep the thread is.
    pub(super) slope: f64,
}

/// A change of sides between two crossings. The thread follows an arc round each crossed thread,
/// and the straight line that touches both arcs.
pub(super) struct Change<'a> {
    way: Way<'a>,
    line: [[f64; 2]; LINE],
    /// Whether the thread changes sides before the first crossing, and after the second one.
    turns: [bool; 2],
    /// Length from the first crossing to each point of the line.
    lengths: [f64; LINE],
    /// Number of steps from control point to control point between the two crossings.
    steps: usize,
}

/// Number of points of the line along which lengths are added up. The line has two arcs and a
/// straight piece between them.
const LINE: usize = 3 * PARTS + 1;

impl<'a> Change<'a> {
    /// The change of sides with `points` control points between both crossings. `turns` says
    /// whether the thread changes sides before the first crossing, and after the second one.
    pub(super) fn new(one: &'a Station, two: &'a Station, turns: [bool; 2], points: usize) -> Self {
        let way = Way::new(one, two);
        let line = way.line(turns);
        let mut lengths = [0.0; LINE];
        for (at, pair) in line.windows(2).enumerate() {
            lengths[at + 1] = lengths[at] + (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1]);
        }
        Self { way, line, turns, lengths, steps: points + 1 }
    }

    fn whole(&self) -> f64 {
        self.lengths[LINE - 1]
    }

    /// All points between the two crossings, evenly spaced except where the thread would bend too
    /// tightly.
    pub(super) fn points(&self) -> impl Iterator<Item = Stop> {
        let step = self.whole() / self.steps as f64;
        let mut stops: [Stop; CHANGE_POINTS + 2] = std::array::from_fn(|point| self.at(step * point as f64));
        ease(&mut stops[..=self.steps], self.turns);
        stops.into_iter().take(self.steps).skip(1)
    }

    /// The path of the thread at `along`.
    pub(super) fn passing(&self, along: f64) -> Passing {
        let [one, _] = self.way.stations;
        let x = (along - one.at).abs();
        let part = self.line.partition_point(|point| point[0] < x).clamp(1, LINE - 1);
        let [[from, before], [to, after]] = [self.line[part - 1], self.line[part]];
        let [run, rise] = [(to - from).max(f64::MIN_POSITIVE), after - before];
        let share = ((x - from) / run).clamp(0.0, 1.0);
        Passing { z: one.crossed_z + one.side * (before + share * rise), slope: (rise / run).abs() }
    }

    /// The points from the first crossing to the place where the thread is cut off, at `edge`. They
    /// are about as far apart as in a whole change.
    pub(super) fn until(&self, edge: f64) -> impl Iterator<Item = Stop> {
        let [one, _] = self.way.stations;
        let x = (edge - one.at).abs();
        let part = self.line.iter().position(|point| point[0] > x).unwrap_or(LINE - 1).max(1);
        let [[from, _], [to, _]] = [self.line[part - 1], self.line[part]];
        let share = ((x - from) / (to - from).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        let length = self.lengths[part - 1] + share * (self.lengths[part] - self.lengths[part - 1]);
        let steps = (self.steps as f64 * length / self.whole()).round().max(1.0) as usize;
        (1..=steps).map(move |step| {
            let stop = self.at(length * step as f64 / steps as f64);
            if step < steps {
                Stop { crossing: Some(one.number), ..stop }
            } else {
                Stop { along: edge, crossing: None, ..stop }
            }
        })
    }

    /// The place at `length` from the first crossing.
    fn at(&self, length: f64) -> Stop {
        let [one, two] = self.way.stations;
        let part = self.lengths.partition_point(|&to| to < length).clamp(1, LINE - 1);
        let [from, to] = [self.lengths[part - 1], self.lengths[part]];
        let share = (length - from) / (to - from).max(f64::MIN_POSITIVE);
        let [before, after] = [self.line[part - 1], self.line[part]];
        let [x, y] = [0, 1].map(|axis| before[axis] + share * (after[axis] - before[axis]));
        // Near each crossing the thread lies as it does there. A thread that went straight from
        // place to place would pierce the crossed thread at a corner: with 2/2 twill at
        // Ashenhurst's sett, clearance was 0.984, and is 0.99 (`cloths_of_the_mills_come_to_rest`).
        let gone = 1.0 - fading(x / self.way.across);
        let mix = |from: f64, to: f64| from + gone * (to - from);
        Stop {
            along: one.at + (two.at - one.at).signum() * x,
            across: mix(one.across, two.across),
            z: one.crossed_z + one.side * y,
            halves: [0, 1].map(|half| mix(one.drawn[half], two.drawn[half])),
            crossing: Some(if 2.0 * length <= self.whole() * (1.0 + 1e-9) { one.number } else { two.number }),
        }
    }
}

/// The points between two crossings of a thread that lies on the same side of both and changes
/// sides before the first or after the second, as `changes` says.
pub(super) fn float(
    one: &Station,
    two: &Station,
    changes: [bool; 2],
    points: usize,
) -> impl Iterator<Item = Stop> {
    let step = FLOAT_STEP / (points + 1) as f64;
    let at = |share: f64, station: &Station| {
        let along = one.at + share * (two.at - one.at);
        Stop { crossing: Some(station.number), ..one.stop().towards(&two.stop(), along) }
    };
    let points = [(step, one), (1.0 - step, two)].map(|(share, station)| at(share, station));
    points.into_iter().zip(changes).filter_map(|(point, changes)| changes.then_some(point))
}

/// The way from one crossed thread to the next, in coordinates whose origin is the middle of the
/// first crossed thread, and in which the thread begins on top.
struct Way<'a> {
    stations: [&'a Station; 2],
    across: f64,
    rise: f64,
    /// The straight line's slope downwards, radians.
    slope: f64,
}

impl<'a> Way<'a> {
    fn new(one: &'a Station, two: &'a Station) -> Self {
        let (across, rise) = ((two.at - one.at).abs(), one.side * (two.crossed_z - one.crossed_z));
        let mut way = Self { stations: [one, two], across, rise, slope: 0.0 };
        way.slope = way.touching();
        way
    }

    /// The room that is left between both crossed threads, across a line of this slope, once the
    /// thread itself has its place.
    fn room(&self, slope: f64) -> f64 {
        let (s, c) = slope.sin_cos();
        let [one, two] =
            self.stations.map(|at| (at.crossed[0] * s).hypot(at.crossed[1] * c) + at.half_height);
        self.across * s + self.rise * c - one - two
    }

    /// The least slope at which the thread has room or, if there is none, the slope at which it
    /// lacks the least room.
    fn touching(&self) -> f64 {
        let [one, two] = self.stations;
        let halves = [one, two].map(|at| at.crossed.map(|half| half as f32));
        let thread = (one.half_height + two.half_height) as f32;
        let [c, s] = StraightPassage::new(self.across as f32, self.rise as f32, halves, thread).slope;
        let best = f64::from(s).atan2(f64::from(c));
        if self.room(best) <= 0.0 {
            return best;
        }
        let [mut low, mut high] = [0.0, best];
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(low, high);
            if self.room(middle) < 0.0 { low = middle } else { high = middle }
        }
        high
    }

    /// The points of the arc round the first crossed thread, of the straight line, and of the arc
    /// round the second one. `turns` says whether the thread changes sides before the first
    /// crossing, and after the second one.
    fn line(&self, turns: [bool; 2]) -> [[f64; 2]; LINE] {
        let first = |part: usize| self.arc(self.stations[0], 1.0, part as f64 / PARTS as f64);
        // The second arc is computed like the first one, and turned by half a turn.
        let second = |part: usize| {
            let [x, y] = self.arc(self.stations[1], -1.0, (PARTS - part) as f64 / PARTS as f64);
            [self.across - x, self.rise - y]
        };
        let [from, to] = [first(PARTS), second(0)];
        let half = self.across / 2.0;
        let ends = [from[0], self.across - to[0]].map(|end| (end / half).clamp(0.0, 1.0));
        let lifts = self.lifts();
        std::array::from_fn(|at| {
            let (part, share) = (at % PARTS, (at % PARTS) as f64 / PARTS as f64);
            let ([x, y], angles) = match at / PARTS {
                0 => (first(part), [share, 1.0]),
                1 => ([0, 1].map(|axis| from[axis] + share * (to[axis] - from[axis])), [1.0; 2]),
                _ => (second(at - 2 * PARTS), [1.0, (3 * PARTS - at) as f64 / PARTS as f64]),
            };
            let lift = |end: usize| {
                let gone = [x, self.across - x][end] / half;
                // A thread that turns beyond the crossing, too, is level there. Otherwise it would
                // have an edge: the picks of denim would bend at 0.9 of their radius.
                let turned = if turns[end] { fading(angles[end]) } else { 1.0 - angles[end] };
                lifts[end] * (ends[end] * turned + (1.0 - ends[end]) * fading(gone))
            };
            let (s, c) = (self.slope * angles[0].min(angles[1])).sin_cos();
            let away = lift(0) - lift(1);
            [x + away * s, y + away * c]
        })
    }

    /// A place on the arc round a crossed thread, relative to that thread's middle. `share` is the
    /// share of the way from the crossing to the straight line. `sign` is 1 for the first crossed
    /// thread and -1 for the second one.
    fn arc(&self, at: &Station, sign: f64, share: f64) -> [f64; 2] {
        let (s, c) = (share * self.slope).sin_cos();
        let [a, b] = at.crossed;
        let reach = (a * s).hypot(b * c);
        let x = a * a * s / reach;
        // The thread grows or shrinks on its way to the other crossing.
        let gone = ((x + at.half_height * s) / self.across).clamp(0.0, 1.0);
        let [one, two] = self.stations.map(|at| at.half_height);
        let half_height = if sign > 0.0 { one + gone * (two - one) } else { two + gone * (one - two) };
        [x + half_height * s, b * b * c / reach + half_height * c]
    }

    /// For both crossings, the gap between the thread and the crossed thread, mm. Other threads may
    /// hold the two apart.
    fn lifts(&self) -> [f64; 2] {
        self.stations.map(|at| at.side * (at.z - at.crossed_z) - at.crossed[1] - at.half_height)
    }
}

/// The share of what a thread has at one place that is left on its way to another. `share` is the
/// part of the way that the thread has gone.
fn fading(share: f64) -> f64 {
    let left = (1.0 - share).clamp(0.0, 1.0);
    left * left * (3.0 - 2.0 * left)
}
