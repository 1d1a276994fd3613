//! Finds passages of yarns through one another, by Gauss's linking integral of windows of yarn
//! before and after settling.
//!
//! A window is a short piece of a yarn, shorter than a loop. If the head of a loop is pulled out of
//! the loop above it, the integral may grow at one leg and fall by as much at the other leg. In a
//! window that holds the whole loop, the two changes would cancel out.

use std::collections::HashMap;
use std::f64::consts::TAU;

use glam::DVec3;

use super::cells::Cells;
use super::check::Place;
use super::curve::Curve;
use super::segments::closest;
use super::{Ends, Start};

/// The change of a window's integral above which a yarn has passed through another. A strand that
/// passes through another one, far from its ends, changes the integral by 1.
pub const CROSSED: f64 = 0.6;

/// Number of intervals of a window to each side of its middle.
const HALF_WINDOW: isize = 3;

/// Number of chords per interval.
const PARTS: usize = 4;

/// Largest distance between two chords whose windows are compared, before or after, as a multiple
/// of the sum of both radii.
const NEAR: f64 = 2.0;

/// The result of [`linking`].
#[derive(Debug, Clone, PartialEq)]
pub struct Linking {
    /// The largest change of the integral of two windows of seven control points.
    pub change: f64,
    /// The middles of these windows, each as the interval that begins there.
    pub at: Option<[Place; 2]>,
}

/// Compares how the yarns of `start` are linked in two shapes. The control points of the first
/// shape are `before`, those of the second are `after`. All copies of the repeat count.
///
/// # Panics
///
/// If `before` or `after` has other yarns or other counts of points than `start`.
#[must_use]
pub fn linking(start: &Start, before: &[Vec<DVec3>], after: &[Vec<DVec3>]) -> Linking {
    let cloths = [before, after].map(|points| Cloth::new(start, points));
    let mut pairs: Vec<_> = cloths.iter().flat_map(|cloth| cloth.near()).collect();
    pairs.sort_unstable();
    pairs.dedup();

    let mut largest = Linking { change: 0.0, at: None };
    for group in pairs.chunk_by(|one, other| one.yarns() == other.yarns()) {
        let mut changes = HashMap::new();
        for pair in group {
            let change = pair.intervals(&cloths[0]).map(|intervals| {
                *changes.entry(intervals).or_insert_with(|| {
                    let [before, after] = [0, 1].map(|cloth| cloths[cloth].integral(intervals));
                    after - before
                })
            });
            let change = change.sum::<f64>().abs();
            if change > largest.change {
                largest = Linking { change, at: Some([pair.one, pair.other]) };
            }
        }
    }
    largest
}

/// Gauss's linking integral of two chains of chords: an integer if both are closed.
#[must_use]
pub fn linking_integral(one: &[DVec3], other: &[DVec3]) -> f64 {
    let chords = |chain: &[DVec3]| chain.windows(2).map(|chord| [chord[0], chord[1]]).collect::<Vec<_>>();
    let others = chords(other);
    chords(one).iter().flat_map(|&one| others.iter().map(move |&other| of_chords(one, other))).sum()
}

/// The integral of two chords: the solid angle of all directions from a point of one to a point of
/// the other, divided by that of the whole sphere (Klenin and Langowski 2000).
///
/// These directions are a quadrangle on the sphere. It is cut into two triangles, whose solid
/// angles come from the formula of Van Oosterom and Strackee (1983). The formula gives the
/// integral's sign, too. It gives 0 for chords in one plane.
fn of_chords(one: [DVec3; 2], other: [DVec3; 2]) -> f64 {
    let [a, b, c, d] = [other[0] - one[0], other[1] - one[0], other[1] - one[1], other[0] - one[1]];
    let triangle = |a: DVec3, b: DVec3, c: DVec3| {
        let [x, y, z] = [a.length(), b.length(), c.length()];
        a.dot(b.cross(c)).atan2(x * y * z + a.dot(b) * z + c.dot(a) * y + b.dot(c) * x)
    };
    (triangle(a, b, c) + triangle(c, d, a)) / TAU
}

/// Two windows, each given by its middle, or two intervals. `image` is the number of repeats by
/// which the second one is moved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
struct Pair {
    one: Place,
    other: Place,
    image: [i32; 2],
}

impl Pair {
    fn yarns(&self) -> [usize; 2] {
        [self.one.yarn, self.other.yarn]
    }

    /// All pairs of an interval of the first window and one of the second.
    fn intervals(&self, cloth: &Cloth<'_>) -> impl Iterator<Item = Self> {
        let [first, second] = [self.one, self.other].map(|middle| {
            let steps = -HALF_WINDOW..HALF_WINDOW;
            steps.filter_map(|step| cloth.interval(middle, step)).collect::<Vec<_>>()
        });
        first.into_iter().flat_map(move |(one, beyond)| {
            let second = second.clone();
            second.into_iter().map(move |(other, further)| {
                let image = [0, 1].map(|axis| self.image[axis] + further[axis] - beyond[axis]);
                Self { one, other, image }
            })
        })
    }
}

/// All yarns as chords.
struct Cloth<'a> {
    start: &'a Start,
    /// The chords of each interval, yarn by yarn.
    chains: Vec<Vec<[DVec3; PARTS + 1]>>,
}

impl<'a> Cloth<'a> {
    fn new(start: &'a Start, points: &[Vec<DVec3>]) -> Self {
        assert_eq!(points.len(), start.yarns.len(), "{}: yarns", start.name);
        let chain = |yarn| {
            let pieces = Curve::new(start, yarn, &points[yarn]).pieces().collect::<Vec<_>>();
            pieces.iter().map(|piece| std::array::from_fn(|k| piece.at(k as f64 / PARTS as f64))).collect()
        };
        Self { start, chains: (0..points.len()).map(chain).collect() }
    }

    /// The interval `step` intervals after `place`. The result is its place within the repeat, and
    /// the number of repeats by which it lies beyond that place. None beyond the ends of an open
    /// yarn.
    fn interval(&self, place: Place, step: isize) -> Option<(Place, [i32; 2])> {
        let count = self.chains[place.yarn].len() as isize;
        let at = place.interval as isize + step;
        let interval = Place { interval: at.rem_euclid(count) as usize, ..place };
        let times = at.div_euclid(count) as i32;
        match self.start.yarns[place.yarn].ends {
            Ends::Open => (times == 0).then_some((interval, [0; 2])),
            Ends::Closed => Some((interval, [0; 2])),
            Ends::Repeats(repeats) => Some((interval, repeats.map(|repeats| times * repeats))),
        }
    }

    /// The integral of two intervals.
    fn integral(&self, Pair { one, other, image }: Pair) -> f64 {
        let shift = self.start.shift(image);
        let first = &self.chains[one.yarn][one.interval];
        linking_integral(first, &self.chains[other.yarn][other.interval].map(|point| point + shift))
    }

    /// All pairs of windows that have chords near one another at their middles and don't overlap.
    fn near(&self) -> Vec<Pair> {
        let start = self.start;
        // All chords, each behind the number of a control point at one of its ends.
        let mut chords = Vec::new();
        for (yarn, chain) in self.chains.iter().enumerate() {
            for (interval, points) in chain.iter().enumerate() {
                for part in 0..PARTS {
                    let middle = self.interval(Place { yarn, interval }, isize::from(part >= PARTS / 2));
                    let middle = middle.unwrap_or((Place { yarn, interval }, [0; 2]));
                    chords.push((middle, [points[part], points[part + 1]]));
                }
            }
        }
        let thickest = start.yarns.iter().map(|yarn| yarn.radius).fold(0.0, f64::max);
        let longest = chords.iter().map(|(_, [from, to])| from.distance(*to)).fold(0.0, f64::max);
        let middles: Vec<_> = chords.iter().map(|(_, [from, to])| (*from + *to) / 2.0).collect();
        let mut pairs = Vec::new();
        let cells = Cells::new(&middles, start.repeat, NEAR * 2.0 * thickest + longest);
        cells.each_pair(|one, other, image| {
            let (((one, beyond), first), ((other, further), second)) = (chords[one], chords[other]);
            let shift = start.shift(image);
            let second = second.map(|point| point + shift);
            let (s, t) = closest(first, second);
            let way = first[0].lerp(first[1], s).distance(second[0].lerp(second[1], t));
            if way < NEAR * (start.yarns[one.yarn].radius + start.yarns[other.yarn].radius) {
                let image = [0, 1].map(|axis| image[axis] + further[axis] - beyond[axis]);
                let pair = Pair { one, other, image };
                if !self.overlap(pair) {
                    pairs.push(pair);
                }
            }
        });
        pairs.sort_unstable();
        pairs.dedup();
        pairs
    }

    /// Whether both windows are of one yarn and share an interval or an end. At the edge of a
    /// repeat, one of the two copies of a shared end is moved by the repeat. Rounding leaves a tiny
    /// gap between the copies, and the direction of this gap would decide the integral.
    fn overlap(&self, pair: Pair) -> bool {
        let steps = -2 * HALF_WINDOW..=2 * HALF_WINDOW;
        pair.one.yarn == pair.other.yarn
            && steps.into_iter().any(|step| self.interval(pair.one, step) == Some((pair.other, pair.image)))
    }
}
