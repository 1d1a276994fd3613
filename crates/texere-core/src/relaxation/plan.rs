//! The plan: all tables of a relaxation, made before anything is worked out.

use std::collections::HashMap;
use std::ops::Range;

use glam::{DVec2, DVec3};

use super::error::RelaxationError;
use super::node::{GAUSS, Node, blend};
use super::{Elastic, Relaxation, RelaxationState, even, mirror};
use crate::Ends;
use crate::backend::{filled, room};

/// The largest distance of two samples of a yarn, as a share of the radius of its core. With half
/// of it, the wales of stockinette at rest change by 0.3 %, and the time grows to four times.
const SPACING: f64 = 0.75;

/// The least number of samples of an interval, which bending needs.
const SAMPLES_MIN: usize = 4;

/// The largest number of samples of an interval. Floats of usual knits have up to 12.
const SAMPLES_MAX: usize = 256;

/// The most samples of all yarns.
const ALL_SAMPLES_MAX: u64 = 1 << 28;

/// The share by which an interval and its mirror image may differ in length. With half the value,
/// and with twice, no test is red.
const ALIKE: f64 = 1e-3;

/// A yarn of a relaxation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RelaxationYarn {
    /// The number of the yarn's first control point.
    pub first: u32,
    /// Number of the yarn's control points.
    pub points: u32,
    /// Whether the yarn ends, closes up or goes on in another repeat.
    pub ends: Ends,
    /// The yarn's length at rest, mm: up to where it closes or goes on.
    pub length: f64,
}

/// An interval of a relaxation: the piece of a yarn between two control points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RelaxationInterval {
    /// The number of the yarn.
    pub yarn: u32,
    /// The number of the interval in its yarn.
    pub number: u32,
    /// The interval's length at rest, mm.
    pub length: f64,
    /// The distance along the yarn at rest from its first control point to the interval, mm.
    pub along: f64,
    /// The number of the interval's first sample.
    pub first_sample: u32,
    /// Number of the interval's samples. They lie in the middles of equal parts.
    pub samples: u32,
}

/// The tables of a relaxation, and its state at the start.
#[derive(Debug, Clone)]
pub struct RelaxationPlan {
    yarns: Vec<RelaxationYarn>,
    elastic: Vec<Elastic>,
    intervals: Vec<RelaxationInterval>,
    /// The samples of an interval that has n of them, at index n.
    nodes: Vec<Vec<Node>>,
    gauss: [(Node, f64); 3],
    pinned: Vec<u32>,
    mirror: Option<Vec<u32>>,
    start: RelaxationState,
    pub(super) press: f64,
    pub(super) held: [bool; 2],
    pub(super) steps: u32,
}

impl RelaxationInterval {
    /// The numbers of the interval's samples.
    #[must_use]
    pub const fn sampled(&self) -> Range<usize> {
        self.first_sample as usize..(self.first_sample + self.samples) as usize
    }
}

impl RelaxationPlan {
    /// Checks a relaxation and makes its plan. The control points of a yarn that closes, or goes on
    /// in another repeat, are spread more evenly along its spline, unless one of them is held.
    ///
    /// **Errors**: [`RelaxationError`] for invalid ends, pins, elastic properties or settings, a
    /// yarn of too few control points, an interval without length or with too many samples, and
    /// short memory.
    pub fn new(relaxation: &Relaxation<'_>) -> Result<Self, RelaxationError> {
        check(relaxation)?;
        let layout = relaxation.layout();
        let s = 0.5 * (1.0 - f64::from(layout.tension()));
        let [x, y] = relaxation.boundary.repeat().map(f64::from);
        let points = relaxation.yarns.points().iter().map(|point| point.position().as_dvec3()).collect();
        let start = RelaxationState { points, repeat: DVec2::new(x, y) };
        let mut plan = Self {
            yarns: Vec::with_capacity(layout.yarns().len()),
            elastic: relaxation.elastic.to_vec(),
            intervals: room("intervals", start.points.len())?,
            nodes: vec![Vec::new()],
            gauss: GAUSS.map(|(u, weight)| (Node::new(u, s), weight)),
            pinned: relaxation.pinned.iter().map(|point| *point as u32).collect(),
            mirror: None,
            press: relaxation.press,
            held: relaxation.held,
            steps: relaxation.steps,
            start,
        };
        for (yarn, &ends) in relaxation.boundary.ends().iter().enumerate() {
            let (first, end) = (layout.offsets()[yarn], layout.offsets()[yarn + 1]);
            plan.yarns.push(RelaxationYarn {
                first: first as u32,
                points: (end - first) as u32,
                ends,
                length: 0.0,
            });
            plan.measure(yarn, relaxation.length, s)?;
        }
        let most = plan.intervals.iter().map(|interval| interval.samples).max().unwrap_or(0);
        for count in 1..=most {
            let middle = |part: u32| Node::new((f64::from(part) + 0.5) / f64::from(count), s);
            plan.nodes.push((0..count).map(middle).collect());
        }
        if plan.pinned.is_empty() {
            let images = mirror::find(&plan.start, &plan.thicknesses()?);
            plan.mirror = images.filter(|images| plan.mirrors(images));
        }
        Ok(plan)
    }

    /// Adds the intervals of yarn number `yarn`. Its lengths at rest are `factor` times its lengths
    /// at the start. `s` is that of [`Node::new`].
    fn measure(&mut self, yarn: usize, factor: f64, s: f64) -> Result<(), RelaxationError> {
        let RelaxationYarn { points, ends, .. } = self.yarns[yarn];
        let first = self.intervals.len();
        let mut first_sample = self.samples() as u64;
        let none = RelaxationInterval {
            yarn: yarn as u32,
            number: 0,
            length: 0.0,
            along: 0.0,
            first_sample: 0,
            samples: 0,
        };
        let numbers = 0..ends.intervals(points as usize) as u32;
        self.intervals.extend(numbers.map(|number| RelaxationInterval { number, ..none }));
        let spacing = SPACING * self.elastic[yarn].core;
        let most = SAMPLES_MAX as f64 * spacing;
        let mut along = 0.0;
        for (number, length) in self.lengths(yarn, first, s).into_iter().enumerate() {
            let length = factor * length;
            if !(length > 0.0 && length <= most) {
                let (point, core) = (number as u64, self.elastic[yarn].core);
                return Err(RelaxationError::Interval { yarn, point, length, core, most });
            }
            let samples = ((length / spacing).ceil() as usize).max(SAMPLES_MIN) as u32;
            if first_sample > ALL_SAMPLES_MAX {
                let limit = ALL_SAMPLES_MAX;
                return Err(RelaxationError::TooMany { what: "samples", count: first_sample, limit });
            }
            let interval = &mut self.intervals[first + number];
            (interval.length, interval.along) = (length, along);
            (interval.first_sample, interval.samples) = (first_sample as u32, samples);
            along += length;
            first_sample += u64::from(samples);
        }
        self.yarns[yarn].length = along;
        Ok(())
    }

    /// The lengths of the intervals of yarn number `yarn` at the start, mm. `first` is the number
    /// of its first interval. If the yarn closes, or goes on in another repeat, and none of its
    /// points is held, its points are first spread evenly.
    fn lengths(&mut self, yarn: usize, first: usize, s: f64) -> Vec<f64> {
        let RelaxationYarn { first: point, points, ends, .. } = self.yarns[yarn];
        let own = point as usize..(point + points) as usize;
        let way = (self.shift(yarn as u32) * self.start.repeat).extend(0.0);
        let intervals = &self.intervals[first..];
        let window = |number: i64| {
            let count = intervals.len() as i64;
            let round = number.div_euclid(count) as f64;
            let interval = &intervals[number.rem_euclid(count) as usize];
            self.points_of(&self.start, interval).map(|point| point + way * round)
        };
        let lengths: Vec<f64> =
            (0..intervals.len() as i64).map(|number| self.arc(&window(number)).0).collect();
        let sound = lengths.iter().all(|length| *length > 0.0 && length.is_finite());
        let is_held = || self.pinned.iter().any(|point| own.contains(&(*point as usize)));
        if ends == Ends::Open || !sound || is_held() {
            return lengths;
        }
        let even = even::averaged(&lengths);
        let places = even::spread(s, &lengths, &even, window);
        self.start.points[own].copy_from_slice(&places);
        even
    }

    /// The radius of the core at each control point, mm.
    fn thicknesses(&self) -> Result<Vec<f64>, RelaxationError> {
        let mut thicknesses = filled("cores", self.start.points.len(), 0.0)?;
        for (yarn, elastic) in self.yarns.iter().zip(&self.elastic) {
            thicknesses[yarn.first as usize..][..yarn.points as usize].fill(elastic.core);
        }
        Ok(thicknesses)
    }

    /// Whether the image of every interval is an interval of an equal yarn.
    fn mirrors(&self, images: &[u32]) -> bool {
        let ends = |interval: &RelaxationInterval| {
            let [_, (start, _), (end, _), _] = self.window_of(interval);
            [start.min(end), start.max(end)]
        };
        let all: HashMap<[u32; 2], &RelaxationInterval> =
            self.intervals.iter().map(|interval| (ends(interval), interval)).collect();
        self.intervals.iter().all(|interval| {
            let [one, other] = ends(interval).map(|point| images[point as usize]);
            all.get(&[one.min(other), one.max(other)]).is_some_and(|image| {
                let [own, other] = [interval, image].map(|interval| self.elastic[interval.yarn as usize]);
                own == other && (interval.length / image.length - 1.0).abs() < ALIKE
            })
        })
    }

    /// The yarns.
    #[must_use]
    pub fn yarns(&self) -> &[RelaxationYarn] {
        &self.yarns
    }

    /// The elastic properties of each yarn.
    #[must_use]
    pub fn elastic(&self) -> &[Elastic] {
        &self.elastic
    }

    /// The intervals of all yarns, one yarn after the other.
    #[must_use]
    pub fn intervals(&self) -> &[RelaxationInterval] {
        &self.intervals
    }

    /// Number of samples of all intervals.
    #[must_use]
    pub fn samples(&self) -> usize {
        self.intervals.last().map_or(0, |last| last.sampled().end)
    }

    /// The numbers of the control points that are held.
    #[must_use]
    pub fn pinned(&self) -> &[u32] {
        &self.pinned
    }

    /// For each control point the number of its mirror image, if the yarns at the start are equal
    /// to their mirror image in x.
    #[must_use]
    pub fn mirror(&self) -> Option<&[u32]> {
        self.mirror.as_deref()
    }

    /// The state at the start, after control points have been spread as [`RelaxationPlan::new`]
    /// says.
    #[must_use]
    pub const fn start(&self) -> &RelaxationState {
        &self.start
    }

    pub(super) fn nodes(&self, interval: &RelaxationInterval) -> &[Node] {
        &self.nodes[interval.samples as usize]
    }

    pub(super) const fn gauss(&self) -> &[(Node, f64); 3] {
        &self.gauss
    }

    /// The numbers of an interval's four control points. A point beyond an end of an open yarn has
    /// the number of the yarn's point at that end.
    #[must_use]
    pub fn window(&self, interval: usize) -> [u32; 4] {
        self.window_of(&self.intervals[interval]).map(|(point, _)| point)
    }

    /// An interval's four control points by number, each with the number of rounds that the yarn
    /// has made to get there.
    pub(super) fn window_of(&self, interval: &RelaxationInterval) -> [(u32, i32); 4] {
        let RelaxationYarn { first, points, ends, .. } = self.yarns[interval.yarn as usize];
        let count = i64::from(points);
        [-1, 0, 1, 2].map(|slot| {
            let at = i64::from(interval.number) + slot;
            match ends {
                Ends::Open => (first + at.clamp(0, count - 1) as u32, 0),
                Ends::Closed | Ends::Repeats(_) => {
                    (first + at.rem_euclid(count) as u32, at.div_euclid(count) as i32)
                }
            }
        })
    }

    /// The number of repeats along x and y by which a yarn's next round is moved.
    pub(super) fn shift(&self, yarn: u32) -> DVec2 {
        match self.yarns[yarn as usize].ends {
            Ends::Open | Ends::Closed => DVec2::ZERO,
            Ends::Repeats([x, y]) => DVec2::new(f64::from(x), f64::from(y)),
        }
    }

    /// The places of an interval's four control points, with virtual ends (the paper's equations 3
    /// and 4).
    pub(super) fn points_of(&self, state: &RelaxationState, interval: &RelaxationInterval) -> [DVec3; 4] {
        let way = (self.shift(interval.yarn) * state.repeat).extend(0.0);
        let mut points = self
            .window_of(interval)
            .map(|(point, round)| state.points[point as usize] + way * f64::from(round));
        let [opens, ends] = self.is_at_end(interval);
        if opens {
            points[0] = points[1] * 2.0 - points[2];
        }
        if ends {
            points[3] = points[2] * 2.0 - points[1];
        }
        points
    }

    /// Whether an interval is the first, and whether it is the last, of an open yarn.
    pub(super) fn is_at_end(&self, interval: &RelaxationInterval) -> [bool; 2] {
        let yarn = &self.yarns[interval.yarn as usize];
        [0, yarn.points - 2].map(|end| yarn.ends == Ends::Open && interval.number == end)
    }

    /// The length of an interval, mm, and the velocities at the nodes of Gauss's rule, mm.
    pub(super) fn arc(&self, window: &[DVec3; 4]) -> (f64, [DVec3; 3]) {
        let velocities = self.gauss.map(|(node, _)| blend(&node.velocity, window));
        let arc =
            velocities.iter().zip(&self.gauss).map(|(velocity, (_, weight))| velocity.length() * weight);
        (arc.sum(), velocities)
    }

    /// Writes the positions of an interval's samples to `positions`, mm.
    pub fn sample(&self, state: &RelaxationState, interval: &RelaxationInterval, positions: &mut [DVec3]) {
        let window = self.points_of(state, interval);
        for (position, node) in positions.iter_mut().zip(self.nodes(interval)) {
            *position = blend(&node.position, &window);
        }
    }
}

fn check(relaxation: &Relaxation<'_>) -> Result<(), RelaxationError> {
    let layout = relaxation.layout();
    let within = |setting, value: f64, low: f64, high: f64| {
        let sound = (low..=high).contains(&value);
        if sound { Ok(()) } else { Err(RelaxationError::Setting { setting, value, low, high }) }
    };
    within("the length", relaxation.length, 0.5, 2.0)?;
    within("the stiffness of the press", relaxation.press, 0.0, 1e30)?;
    within("the number of steps", relaxation.steps.into(), 1.0, 1e6)?;
    relaxation.boundary.check(layout)?;
    let (given, yarns) = (relaxation.elastic.len(), layout.yarns().len());
    if given != yarns {
        return Err(RelaxationError::ElasticCount { given, yarns });
    }
    for (yarn, elastic) in relaxation.elastic.iter().enumerate() {
        let Elastic { bending, core, shell, compression, extension } = *elastic;
        let all = [
            ("a bending stiffness", bending),
            ("a core", core),
            ("a compression stiffness", compression),
            ("an extension stiffness", extension),
        ];
        let allowed = "positive and finite";
        if let Some((property, value)) =
            all.into_iter().find(|(_, value)| !(*value > 0.0 && value.is_finite()))
        {
            return Err(RelaxationError::Elastic { yarn, property, value, allowed });
        }
        if !(shell > core && shell.is_finite()) {
            let allowed = "finite and more than the core";
            return Err(RelaxationError::Elastic { yarn, property: "a shell", value: shell, allowed });
        }
    }
    for (yarn, &ends) in relaxation.boundary.ends().iter().enumerate() {
        let points = layout.offsets()[yarn + 1] - layout.offsets()[yarn];
        let least = if ends == Ends::Open { 2 } else { 3 };
        if points < least {
            return Err(RelaxationError::TooFewPoints { yarn, points, least });
        }
    }
    let points = layout.point_count();
    let limit = u64::from(u32::MAX >> 1);
    if points > limit {
        return Err(RelaxationError::TooMany { what: "control points", count: points, limit });
    }
    match relaxation.pinned.iter().find(|&&point| point >= points) {
        Some(&point) => Err(RelaxationError::Pinned { point, points }),
        None => Ok(()),
    }
}
