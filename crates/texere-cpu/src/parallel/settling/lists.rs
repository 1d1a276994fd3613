//! Neighbours of all chords.
//!
//! Chords are sorted by cells, so that the chords of cells side by side in a row also lie side by
//! side in memory. The distance of their middles excludes most pairs. All other pairs are tested as
//! in the core.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU64, Ordering};

use glam::IVec3;
use rayon::prelude::*;
use texere_core::BackendError;
use texere_core::backend::WorkWatch;
use texere_core::settling::{MARGIN, SKIN, SettlingPlan};

use super::chords::{Chords, Images, Nearest};
use super::tables::{ChordRow, Fixed};
use crate::asked::{for_all_threads, in_parts};
use crate::cells::{Extent, Grid};
use crate::parallel::instruction_set::InstructionSet;
use crate::parallel::simd::{
    Floats, Job, LANES_MAX, Mask, Simd, between, bit_cast, dot, first, least, scale, to_floats,
};

/// The number of chords that one task works on.
const TASK: usize = 1024;

/// The neighbours of every chord, sorted by number.
#[derive(Debug, Default)]
pub(super) struct Lists {
    /// The position of each chord's first neighbour in `neighbours`, and at the end the number of
    /// all neighbours.
    pub(super) starts: Vec<u32>,
    /// The neighbours of all chords, and [`LANES_MAX`] entries more.
    pub(super) neighbours: Vec<u32>,
    /// For each chord: its middle (as bits of `i32`), and its reach, mm. Two chords may be
    /// neighbours if the distance of their middles is less than the sum of both reaches.
    middles: Vec<[f32; 4]>,
    /// Each chord's cell and number, with the cell in the high bits, sorted.
    sorted: Vec<u64>,
    /// The columns of `middles` in the order of `sorted`, with [`LANES_MAX`] entries more.
    columns: [Vec<f32>; 4],
    /// The position of each cell's first chord in `sorted`, and at the end the number of all
    /// chords.
    cells: Vec<u32>,
    tasks: Vec<Task>,
}

/// The memory of a task that lists neighbours.
#[derive(Debug, Default)]
struct Task {
    /// The neighbours of the task's chords.
    neighbours: Vec<u32>,
    /// The chords that may be neighbours of the chord at hand.
    near: Vec<u32>,
}

/// The input that lists are made from.
#[derive(Debug, Clone, Copy)]
pub(super) struct Basis<'a> {
    pub(super) set: InstructionSet,
    pub(super) plan: &'a SettlingPlan,
    pub(super) fixed: &'a Fixed,
    pub(super) chords: &'a [ChordRow],
    pub(super) growth: f32,
}

impl Lists {
    /// Lists all neighbours anew, and returns their number. `Break` if `watch` breaks off.
    pub(super) fn fill(
        &mut self,
        basis: Basis<'_>,
        watch: WorkWatch<'_>,
    ) -> Result<ControlFlow<(), u64>, BackendError> {
        let (set, count) = (basis.set, basis.chords.len());
        self.middles.resize(count, [0.0; 4]);
        let tasks = self.middles.par_chunks_mut(TASK).zip(basis.chords.par_chunks(TASK));
        let extents = tasks.map(|(middles, chords)| {
            let mut extent = Extent::NOTHING;
            set.run(MiddleJob { basis, chords, middles, extent: &mut extent });
            extent
        });
        let extent = extents.reduce(|| Extent::NOTHING, Extent::and);
        let grid = Grid::new(basis.plan, basis.growth, &extent);
        self.sort(&grid);
        self.starts.resize(count + 1, 0);
        self.tasks.resize_with(count.div_ceil(TASK), Task::default);
        let Self { starts, middles, sorted, columns, cells, tasks, .. } = self;
        let sorted = Sorted { grid: &grid, middles, sorted, columns, cells };
        let found = AtomicU64::new(0);
        let mut listed: Result<(), BackendError> = Ok(());
        let asked = in_parts(count, for_all_threads(TASK), watch, |part| {
            let rooms = &mut tasks[part.start / TASK..part.end.div_ceil(TASK)];
            let first = (part.start..).step_by(TASK);
            let all: Vec<_> = first.zip(starts[1..][part].chunks_mut(TASK).zip(rooms)).collect();
            let own = all.into_par_iter().map(|(first, (ends, room))| {
                let mut listed = Ok(());
                let found = &found;
                set.run(ListJob { basis, sorted, first, ends, room, found, listed: &mut listed });
                listed
            });
            if listed.is_ok() {
                listed = own.collect();
            }
        });
        if listed.is_err() {
            // The lists made so far are freed, because they fill all the memory that lists may
            // have.
            self.tasks.clear();
        }
        listed?;
        if asked.is_break() {
            return Ok(ControlFlow::Break(()));
        }
        self.gather().map(ControlFlow::Continue)
    }

    /// Sorts chords by their cells.
    fn sort(&mut self, grid: &Grid) {
        let Self { middles, sorted, columns, cells, .. } = self;
        sorted.resize(middles.len(), 0);
        let all = sorted.par_iter_mut().with_min_len(TASK).zip(&*middles).enumerate();
        all.for_each(|(number, (key, middle))| *key = u64::from(grid.cell(at(middle))) << 32 | number as u64);
        sorted.par_sort_unstable();
        for (axis, column) in columns.iter_mut().enumerate() {
            column.resize(sorted.len() + LANES_MAX, 0.0);
            let all = column.par_iter_mut().with_min_len(TASK).zip(&*sorted);
            all.for_each(|(value, key)| *value = middles[*key as u32 as usize][axis]);
        }
        cells.resize(grid.cells() + 1, 0);
        cells.par_chunks_mut(TASK).enumerate().for_each(|(task, starts)| {
            let first = (task * TASK) as u64;
            let mut start = sorted.partition_point(|key| key >> 32 < first);
            for (cell, to) in (first..).zip(starts) {
                while sorted.get(start).is_some_and(|key| key >> 32 < cell) {
                    start += 1;
                }
                *to = start as u32;
            }
        });
    }

    /// Joins the lists of all tasks.
    fn gather(&mut self) -> Result<u64, BackendError> {
        let count = self.tasks.iter().map(|task| task.neighbours.len() as u64).sum();
        self.neighbours.resize(count as usize + LANES_MAX, 0);
        let (mut left, mut start) = (self.neighbours.as_mut_slice(), 0);
        let parts: Vec<_> = self
            .tasks
            .iter()
            .map(|Task { neighbours, .. }| {
                let before = start;
                start += neighbours.len() as u32;
                (before, neighbours, left.split_off_mut(..neighbours.len()).unwrap_or_default())
            })
            .collect();
        let all = self.starts[1..].par_chunks_mut(TASK).zip(parts);
        all.for_each(|(ends, (before, neighbours, to))| {
            ends.iter_mut().for_each(|end| *end += before);
            to.copy_from_slice(neighbours);
        });
        Ok(count)
    }
}

/// The middle of a chord, from its row of `middles`.
fn at([x, y, z, _]: &[f32; 4]) -> IVec3 {
    IVec3::new(x.to_bits().cast_signed(), y.to_bits().cast_signed(), z.to_bits().cast_signed())
}

/// Works out the middles of a task's chords.
struct MiddleJob<'a> {
    basis: Basis<'a>,
    chords: &'a [ChordRow],
    middles: &'a mut [[f32; 4]],
    extent: &'a mut Extent,
}

impl Job for MiddleJob<'_> {
    #[cfg_attr(optimized, inline(always))]
    fn run<S: Simd>(self, simd: S) {
        let Self { basis: Basis { plan, growth, .. }, chords, middles, extent } = self;
        let (unit, spans) = (plan.scale().unit(), plan.spans());
        let mut longest = simd.splat(0.0);
        for (chords, middles) in chords.chunks(S::LANES).zip(middles.chunks_mut(S::LANES)) {
            let mut numbers = [0; LANES_MAX];
            for (lane, number) in numbers.iter_mut().enumerate() {
                *number = lane.min(chords.len() - 1) as u32;
            }
            let own = Chords::<S>::new(simd, chords, &numbers);
            let length = dot(own.span, own.span).sqrt();
            longest = longest.max(length);
            // The reach of a chord is its share of the distance that `are_neighbours` allows, and
            // half its own length. A thousandth and one unit are added, which is more than rounding
            // takes away.
            let reach = simd.splat(MARGIN * growth) * own.thickest + simd.splat(0.5 * SKIN * spans.diameter);
            let reach = (reach + simd.splat(0.5) * length) * simd.splat(1.001) + simd.splat(unit);
            let [x, y, z] = bit_cast(own.middle(simd, unit));
            let mut made = [[0.0; 4]; LANES_MAX];
            simd.scatter([x, y, z, reach], made.as_flattened_mut(), 4);
            middles.copy_from_slice(&made[..middles.len()]);
            for middle in middles {
                *extent = extent.with(at(middle), 0.0);
            }
        }
        extent.longest = -least::<S>(-longest);
    }
}

/// Chords sorted by cells.
#[derive(Debug, Clone, Copy)]
struct Sorted<'a> {
    grid: &'a Grid,
    middles: &'a [[f32; 4]],
    sorted: &'a [u64],
    columns: &'a [Vec<f32>; 4],
    cells: &'a [u32],
}

impl Sorted<'_> {
    /// Writes the chords that may be neighbours of a chord to `near`, and returns their number.
    /// `own` is that chord's row of `middles`.
    #[cfg_attr(optimized, inline(always))]
    fn near<S: Simd>(&self, simd: S, images: &Images<S>, own: &[f32; 4], near: &mut Vec<u32>) -> usize {
        let zero = [simd.splat(0.0); 3];
        let here = at(own);
        let [x, y, z] = here.to_array().map(i32::cast_unsigned);
        let from = [simd.splat_integer(x), simd.splat_integer(y), simd.splat_integer(z)];
        let reach = simd.splat(own[3]);
        let [xs, ys, zs, reaches] = self.columns;
        let mut count = 0;
        for cells in self.grid.beside(self.grid.cell(here)) {
            let (start, end) = (self.cells[cells.start as usize], self.cells[cells.end as usize]);
            let (start, end) = (start as usize, end as usize);
            if near.len() < count + (end - start) + LANES_MAX {
                near.resize(2 * (count + (end - start) + LANES_MAX), 0);
            }
            for k in (start..end).step_by(S::LANES) {
                let to = [simd.load(&xs[k..]), simd.load(&ys[k..]), simd.load(&zs[k..])];
                let to = [to[0].to_bits(), to[1].to_bits(), to[2].to_bits()];
                let (way, _) = images.nearest(between(from, to), zero);
                let way = scale(to_floats(way), images.unit);
                let most = reach + simd.load(&reaches[k..]);
                let mut may = dot(way, way).less(most * most).bits() & first::<S>(end - k);
                while may != 0 {
                    near[count] = self.sorted[k + may.trailing_zeros() as usize] as u32;
                    count += 1;
                    may &= may - 1;
                }
            }
        }
        count
    }
}

/// Lists the neighbours of a task's chords.
struct ListJob<'a> {
    basis: Basis<'a>,
    sorted: Sorted<'a>,
    /// The number of the task's first chord.
    first: usize,
    /// For each chord, the number of neighbours that the task has listed once it has listed this
    /// chord's.
    ends: &'a mut [u32],
    room: &'a mut Task,
    /// The number of neighbours that all tasks have listed so far.
    found: &'a AtomicU64,
    /// An error if more neighbours were listed than are allowed.
    listed: &'a mut Result<(), BackendError>,
}

impl Job for ListJob<'_> {
    #[cfg_attr(optimized, inline(always))]
    fn run<S: Simd>(self, simd: S) {
        let Self { basis, sorted, first: start, ends, room, found: all, listed } = self;
        let Basis { plan, fixed, chords, growth, .. } = basis;
        let Task { neighbours, near } = room;
        let images = Images::new(simd, plan);
        let (grown, skin) = (simd.splat(MARGIN * growth), simd.splat(SKIN * plan.spans().diameter));
        // The yarn of the chord at hand, and the chords of that yarn.
        let (mut yarn, mut own) = (0, 0..0);
        neighbours.clear();
        for (number, end) in (start as u32..).zip(ends) {
            if number >= own.end {
                yarn = plan.yarns()[fixed.owners[number as usize] as usize];
                let strand = &plan.strands()[yarn as usize];
                let [from, to] = [strand.first, strand.first + strand.intervals()];
                own = plan.chords()[from as usize]..plan.chords()[to as usize];
            }
            let count = sorted.near(simd, &images, &sorted.middles[number as usize], near);
            let one = Chords::<S>::splat(simd, &chords[number as usize]);
            let before = neighbours.len();
            for k in (0..count).step_by(S::LANES) {
                let others = &near[k..][..S::LANES];
                let other = Chords::<S>::new(simd, chords, others);
                let Nearest { apart, image, .. } = Nearest::new(simd, &images, &one, &other);
                // The distance that the core's `SettlingPlan::are_neighbours` allows.
                let thickness = one.thickest + other.thickest;
                let within = grown * thickness + skin;
                let mut found = dot(apart, apart).less(within * within).bits() & first::<S>(count - k);
                let mut lanes = [[0.0; LANES_MAX]; 3];
                image[0].store(&mut lanes[0]);
                image[1].store(&mut lanes[1]);
                thickness.store(&mut lanes[2]);
                while found != 0 {
                    let lane = found.trailing_zeros() as usize;
                    found &= found - 1;
                    let other = others[lane];
                    let image = [-(lanes[0][lane] as i32), -(lanes[1][lane] as i32)];
                    let leads_on = own.contains(&other)
                        && (other == number || plan.leads_on(yarn, [number, other], image, lanes[2][lane]));
                    if !leads_on {
                        neighbours.push(other);
                    }
                }
            }
            neighbours[before..].sort_unstable();
            *end = neighbours.len() as u32;
            let own = (neighbours.len() - before) as u64;
            *listed = plan.allow_neighbours(all.fetch_add(own, Ordering::Relaxed) + own);
            if listed.is_err() {
                return;
            }
        }
    }
}
