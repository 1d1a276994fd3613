//! Neighbours of all chords.

use glam::{IVec3, Vec3};
use rayon::prelude::*;
use texere_core::BackendError;
use texere_core::settling::{Chord, Interval, Listed, SettlingPlan};

use super::tables::{ChordRow, Fixed, IntervalRow};
use crate::cells::{Cells, countable};

/// Chords that one task lists the neighbours of.
const TASK: usize = 1024;

/// Every chord's neighbours, in the order of their numbers.
#[derive(Debug, Default)]
pub(super) struct Lists {
    /// Where each chord's neighbours begin, and the end of the last one's.
    pub(super) starts: Vec<u32>,
    pub(super) neighbours: Vec<u32>,
    cells: Cells,
}

impl Lists {
    /// Finds the neighbours anew and gives back how many there are.
    pub(super) fn fill(
        &mut self,
        plan: &SettlingPlan,
        fixed: &Fixed,
        intervals: &[IntervalRow],
        chords: &[ChordRow],
        growth: f32,
    ) -> Result<u64, BackendError> {
        let scale = plan.scale();
        let chord = |number: u32| {
            let [[x, y, z, _], [sx, sy, sz, _]] = chords[number as usize].0;
            let at = IVec3::from_array([x, y, z].map(|bits| bits.to_bits().cast_signed()));
            Chord { at, span: Vec3::new(sx, sy, sz) }
        };
        let count = chords.len() as u32;
        let longest = (0..count).into_par_iter().map(|number| chord(number).span.length_squared().sqrt());
        let longest = longest.reduce(|| 0.0, f32::max);
        let middles: Vec<IVec3> =
            (0..count).into_par_iter().map(|number| chord(number).middle(scale)).collect();
        self.cells.fill(plan, &middles, (plan.cell(growth, longest) / scale.unit()).ceil() as i32);
        let known = |number: u32| {
            let place = fixed.owners[number as usize] as usize;
            (chord(number), place, Interval::from_rows(&intervals[place].0))
        };
        let cells = &self.cells;
        let tasks = (0..chords.len().div_ceil(TASK)).into_par_iter().map(|task| {
            let (mut counts, mut neighbours, mut beside) = (Vec::new(), Vec::new(), Vec::new());
            for (number, middle) in (0..).zip(&middles).skip(task * TASK).take(TASK) {
                let (own, place, interval) = known(number);
                let one = Listed::new(plan, number, &own, place, &interval);
                let before = neighbours.len();
                cells.beside(plan, *middle, &mut beside);
                for &other in beside.iter().filter(|other| **other != number) {
                    let (own, place, interval) = known(other);
                    let there = Listed::new(plan, other, &own, place, &interval);
                    if plan.are_neighbours(one, there, growth) {
                        neighbours.push(other);
                    }
                }
                counts.push((neighbours.len() - before) as u32);
            }
            (counts, neighbours)
        });
        let tasks: Vec<_> = tasks.collect();
        let count = tasks.iter().map(|(_, neighbours)| neighbours.len() as u64).sum();
        countable(count)?;
        self.starts.clear();
        self.neighbours.clear();
        let mut start = 0;
        for (counts, neighbours) in tasks {
            for count in counts {
                self.starts.push(start);
                start += count;
            }
            self.neighbours.extend(neighbours);
        }
        self.starts.push(start);
        Ok(count)
    }
}
