//! Topology of weft knits: the number of times that a yarn goes through the surface that a loop
//! spans.

use std::collections::HashMap;

use glam::DVec3;
use texere_conformance::rest::{Span, piece_curve};
use texere_core::Yarns;
use texere_fabric::Piece;
use texere_fabric::weft::{LoopRef, Step, Stitches};

/// Number of chords per interval of a spline.
const PARTS: usize = 6;

/// A yarn at a needle: its points up to those of the next needle, and the index of the loop's head
/// among them.
struct Stretch {
    points: Vec<DVec3>,
    head: usize,
}

/// Differences of `yarns` from `stitches`. There are none if the legs of each loop go through
/// exactly the loops that it is drawn through, and floats go through no loop.
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
            let span = Span::new(&ring, PARTS);
            for (&other, stretch) in &loops {
                if other == number && repeat == [0, 0] {
                    continue;
                }
                let parent = stitches.parents_of(other).contains(&LoopRef { number, repeat });
                // Neighbours share arcs. The legs begin just beside these arcs.
                let (points, end) = (&stretch.points, stretch.points.len());
                let legs = [&points[PARTS / 2..=stretch.head], &points[stretch.head..end - PARTS / 2]];
                let through = legs.map(|leg| span.through(leg));
                // If loop `number` is drawn through loop `other`, the head of `other` may lie in
                // front of the surface or behind it, depending on how the surface is drawn.
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

/// The stretches of a yarn, one for each needle that it passes. The points of each have a source of
/// their own.
fn stretches(piece: &Piece, yarns: &Yarns, yarn: usize) -> Vec<Stretch> {
    let range = yarns.range(yarn).expect("a yarn");
    let sources = &yarns.sources().expect("sources")[range];
    let curve = piece_curve(piece, yarns, yarn, PARTS);
    let mut cells: Vec<_> = (0..sources.len()).filter(|&k| k == 0 || sources[k] != sources[k - 1]).collect();
    cells.push(sources.len());
    let stretch = |cell: &[usize]| Stretch {
        points: curve[cell[0] * PARTS..=cell[1] * PARTS].to_vec(),
        // A cell has the arc before a loop, one leg, the head, and the other leg, so that the head
        // is in its middle.
        head: (cell[1] - cell[0]) / 2 * PARTS,
    };
    cells.windows(2).map(stretch).collect()
}
