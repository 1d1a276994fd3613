//! Which loops are drawn through which: how often a yarn goes through the surface that a loop spans.

use std::collections::HashMap;

use glam::DVec3;
use texere_core::{Ends, Yarns};
use texere_fabric::Piece;
use texere_fabric::weft::{LoopRef, Step, Stitches};

/// Chords of an interval of a spline.
const PARTS: usize = 6;

/// What a yarn does at a needle: its points, as far as to the next needle's, and where the head of its loop is among them.
struct Stretch {
    points: Vec<DVec3>,
    head: usize,
}

/// What is not as the stitches say: none if each loop's legs go through just those loops that it is drawn through.
pub(crate) fn faults(stitches: &Stitches, piece: &Piece, yarns: &Yarns) -> Vec<String> {
    let [right, up] = piece.boundary.repeat().map(f64::from);
    let shift = |repeat: [i32; 2]| DVec3::new(right * f64::from(repeat[0]), up * f64::from(repeat[1]), 0.0);
    let (mut loops, mut floats) = (HashMap::new(), Vec::new());
    for (number, strand) in stitches.strands.iter().enumerate() {
        let stretches = stretches(piece, yarns, number);
        assert_eq!(stretches.len(), strand.steps.len(), "cells of strand {number}");
        for (stretch, step) in stretches.into_iter().zip(&strand.steps) {
            match *step {
                Step::Loop { number, .. } => drop(loops.insert(number, stretch)),
                Step::Float { .. } => floats.push(stretch),
            }
        }
    }
    let mut faults = Vec::new();
    let images = || (-1..=1).flat_map(|x| (-2..=2).map(move |y| [x, y]));
    for (&number, ring) in &loops {
        for repeat in images() {
            let ring: Vec<_> = ring.points.iter().map(|point| *point + shift(repeat)).collect();
            let span = Span::new(&ring);
            for (&other, stretch) in &loops {
                if other == number && repeat == [0, 0] {
                    continue;
                }
                let parent = stitches.parents_of(other).contains(&LoopRef { number, repeat });
                // Arcs are common to neighbours: they begin just beside them.
                let (points, end) = (&stretch.points, stretch.points.len());
                let legs = [&points[PARTS / 2..=stretch.head], &points[stretch.head..end - PARTS / 2]];
                let through = legs.map(|leg| span.through(leg));
                // Whether the head of a parent lies in front of the surface or behind is a matter of how that is drawn.
                let child = stitches.parents_of(number).iter().any(|above| above.number == other);
                let sound = if parent {
                    through[0].abs() == 1 && through[1] == -through[0]
                } else {
                    through == [0, 0] || child && through[0] == -through[1]
                };
                if !sound {
                    let says = if parent { "is drawn through" } else { "has nothing to do with" };
                    faults.push(format!("loop {other} {says} {number} {repeat:?}: {through:?}"));
                }
            }
            for (index, stretch) in floats.iter().enumerate() {
                let through = span.through(&stretch.points[PARTS / 2..stretch.points.len() - PARTS / 2]);
                if through != 0 {
                    faults.push(format!("float {index} goes through loop {number} {repeat:?}"));
                }
            }
        }
    }
    faults
}

/// A yarn, needle by needle: each has a source of its own.
fn stretches(piece: &Piece, yarns: &Yarns, yarn: usize) -> Vec<Stretch> {
    let points: Vec<_> =
        yarns.yarn_points(yarn).expect("a yarn").iter().map(|point| point.position().as_dvec3()).collect();
    let range = yarns.range(yarn).expect("a yarn");
    let sources = &yarns.sources().expect("sources")[range];
    let count = points.len() as isize;
    let Ends::Repeats(_) = piece.boundary.ends()[yarn] else { panic!("a yarn that goes on") };
    let [x, y] = piece.boundary.onward_mm(yarn);
    let at = |number: isize| {
        points[number.rem_euclid(count) as usize] + DVec3::new(x, y, 0.0) * number.div_euclid(count) as f64
    };
    let sample = |number: usize| {
        let (interval, t) = ((number / PARTS) as isize, (number % PARTS) as f64 / PARTS as f64);
        let [a, b, c, d] = [-1, 0, 1, 2].map(|step| at(interval + step));
        let [t2, t3] = [t * t, t * t * t];
        0.5 * (2.0 * b + (c - a) * t + (2.0 * a - 5.0 * b + 4.0 * c - d) * t2 + (3.0 * (b - c) + d - a) * t3)
    };
    let mut cells: Vec<_> = (0..points.len()).filter(|&k| k == 0 || sources[k] != sources[k - 1]).collect();
    cells.push(points.len());
    let stretch = |cell: &[usize]| Stretch {
        points: (cell[0] * PARTS..=cell[1] * PARTS).map(sample).collect(),
        // The arc before a loop, one leg, the head, the other leg.
        head: (cell[1] - cell[0]) / 2 * PARTS,
    };
    cells.windows(2).map(stretch).collect()
}

/// A surface over a loop: triangles from a place between its feet, from which all of it is seen.
struct Span<'a> {
    ring: &'a [DVec3],
    middle: DVec3,
    low: DVec3,
    high: DVec3,
}

impl<'a> Span<'a> {
    fn new(ring: &'a [DVec3]) -> Self {
        let fold = |fold: fn(DVec3, DVec3) -> DVec3| ring.iter().copied().reduce(fold).expect("points");
        let last = ring.len() - 1;
        let feet = [1, 2].map(|point| ring[point * PARTS] + ring[last - point * PARTS]);
        let middle = (feet[0] + feet[1]) / 4.0;
        Self { ring, middle, low: fold(DVec3::min), high: fold(DVec3::max) }
    }

    /// How often a chain goes through, those that come back taken off.
    fn through(&self, chain: &[DVec3]) -> i32 {
        let mut count = 0;
        for chord in chain.windows(2) {
            let (from, to) = (chord[0], chord[1]);
            if from.max(to).cmplt(self.low).any() || from.min(to).cmpgt(self.high).any() {
                continue;
            }
            for (k, &one) in self.ring.iter().enumerate() {
                let other = self.ring[(k + 1) % self.ring.len()];
                let sides = [from, to].map(|point| volume(self.middle, one, other, point) > 0.0);
                let corners = [[self.middle, one], [one, other], [other, self.middle]];
                let inside = corners.map(|[one, other]| volume(from, to, one, other) > 0.0);
                if sides[0] != sides[1] && inside.iter().all(|side| *side == inside[0]) {
                    count += if sides[0] { 1 } else { -1 };
                }
            }
        }
        count
    }
}

/// Six times the volume of a tetrahedron, with its sign.
fn volume(a: DVec3, b: DVec3, c: DVec3, d: DVec3) -> f64 {
    (b - a).cross(c - a).dot(d - a)
}
