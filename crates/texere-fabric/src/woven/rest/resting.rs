//! The yarns of cloth whose crossings are at rest.

use std::cmp::Ordering;
use std::ops::ControlFlow;

use rayon::prelude::*;
use texere_contact::{Report, Watch};
use texere_core::backend::zeroed;
use texere_core::crossings::{CrossingState, CrossingsPlan, Level, Neighbours, Set};
use texere_core::{ControlPoint, Halves, Layout, RADIUS_MIN, Section, Yarns};

use super::path::Station;
use super::problem::{Problem, gaps};
use super::span::Span;
use super::stop::{CHANGE_POINTS, LAYERED_POINTS, Stop};
use super::turn::{TURN_POINTS, Turn};
use crate::woven::selvedge;
use crate::woven::yarns::{Pass, Pen};
use crate::{BySet, FabricError, NO_CROSSING, POINTS_MAX, Thread, Woven, WovenError};

/// A section has lost area if it keeps less than this share of its area. Smaller losses are within
/// the accuracy of a settling. No other value was tried.
const LOST: f32 = 0.99;

/// The area of a section up to which the section counts as solid, as a multiple of its least area.
/// With half its difference to 1, and with twice, `plied_threads_rest_near_single_ones` is red.
const SOLID: f32 = 1.02;

/// A repeat's crossings at rest, mm.
pub(super) struct RestingRepeat {
    repeat: [usize; 2],
    pub(super) rest: Vec<CrossingState>,
    /// Sizes that are drawn at each crossing: half width and half height of the room of the end,
    /// then of the pick. The room is an ellipse that holds the thread's section.
    pub(super) drawn: Vec<[[f32; 2]; 2]>,
    rooms: [Vec<[f32; 2]>; 2],
    /// The least product of half width and half height of each thread's room, mm².
    least: [Vec<f32>; 2],
    /// For each crossing, whether the layer of the end is higher (`Greater`) or lower (`Less`) than
    /// that of the pick. `Equal` where both are of one layer, or where warp and weft have different
    /// numbers of levels.
    layers: Vec<Ordering>,
    /// Number of control points between two crossings if a thread changes sides between them.
    change_points: usize,
    /// Tension of the yarns' splines.
    tension: f32,
}

impl RestingRepeat {
    /// The repeat of `problem` with the crossings `rest`, which are given in the plan's unit.
    pub(super) fn new(
        problem: Problem,
        plan: &CrossingsPlan,
        mut rest: Vec<CrossingState>,
        tension: f32,
    ) -> Self {
        let mm: &mut [f32] = bytemuck::cast_slice_mut(&mut rest);
        mm.iter_mut().for_each(|value| *value *= plan.unit());
        let least = Set::BOTH.map(|set| {
            let rows = plan.rows(set).iter().zip(&problem.least[set as usize]);
            rows.map(|(row, least)| least * (row.radius * plan.unit()).powi(2)).collect::<Vec<f32>>()
        });
        // The penalty for less than the least area gives way a little while crossings settle.
        // Sections that lack area get it back.
        for (number, at) in rest.iter_mut().enumerate() {
            let site = plan.site(number);
            for set in Set::BOTH {
                let lie = at.thread_mut(set);
                let area = lie.half_width * lie.half_height;
                let times = (least[set as usize][site.thread(set)] / area).max(1.0).sqrt();
                lie.half_width *= times;
                lie.half_height *= times;
            }
        }
        let drawn = rest
            .iter()
            .map(|at| Set::BOTH.map(|set| [at.thread(set).half_width, at.thread(set).half_height]));
        let neighbours = || (0..plan.crossings()).map(|number| plan.neighbours(plan.site(number)));
        let is_single = neighbours().all(|at| at.levels == [Level::SINGLE; 2]);
        let change_points = if is_single { CHANGE_POINTS } else { LAYERED_POINTS };
        let layer = |at: &Neighbours| match at.are_apart() {
            true => at.levels[0].number.cmp(&at.levels[1].number),
            false => Ordering::Equal,
        };
        let layers = neighbours().map(layer).collect();
        let (repeat, rooms, drawn) = (problem.repeat, problem.rooms, drawn.collect());
        Self { repeat, drawn, rooms, least, layers, change_points, rest, tension }
    }

    /// Ends and picks of the repeat.
    pub(super) const fn repeat(&self) -> [usize; 2] {
        self.repeat
    }

    /// For each set, the share of their cross-section's area that threads keep: the mean over all
    /// crossings, and the least.
    pub(super) fn area(&self, cloth: &Woven) -> BySet<[f64; 2]> {
        BySet { warp: Set::Warp, weft: Set::Weft }.map(|set| {
            let keeps = (0..self.drawn.len()).map(|number| f64::from(self.kept(cloth, number, set).1));
            let add = |[sum, least]: [f64; 2], kept: f64| [sum + kept, least.min(kept)];
            let [sum, least] = keeps.fold([0.0, f64::INFINITY], add);
            [sum / self.drawn.len() as f64, least]
        })
    }

    /// The thread of a set at a crossing of the repeat, and the share of its cross-section's area
    /// that it keeps there.
    fn kept<'a>(&self, cloth: &'a Woven, number: usize, set: Set) -> (&'a Thread, f32) {
        let threads = [cloth.warp(), cloth.weft()][set as usize];
        let thread = [number % self.repeat[0], number / self.repeat[0]][set as usize] % threads.len();
        let ([width, height], radius) = (self.rooms[set as usize][thread], threads[thread].radius_mm);
        let drawn = self.drawn[number][set as usize];
        (&threads[thread], drawn[0] * drawn[1] / (width * height * radius * radius))
    }

    /// Whether a thread with plies has lost area at some crossing, and is as dense there as its
    /// fibres allow.
    pub(super) fn are_plies_solid(&self, cloth: &Woven) -> bool {
        self.threads().any(|(number, set)| {
            let (thread, kept) = self.kept(cloth, number, set);
            let is_plied = matches!(cloth.sections()[thread.section as usize], Section::Lobed { .. });
            is_plied && kept < LOST && self.is_solid_at(number, set)
        })
    }

    /// The least product of half width and half height that a thread of `set` keeps at a crossing
    /// of the repeat, mm².
    pub(super) fn least(&self, number: usize, set: Set) -> f32 {
        self.least[set as usize][[number % self.repeat[0], number / self.repeat[0]][set as usize]]
    }

    /// Whether a thread of the repeat is as dense at some crossing as its fibres allow.
    pub(super) fn is_solid(&self) -> bool {
        self.threads().any(|(number, set)| self.is_solid_at(number, set))
    }

    /// Whether the thread of a set is as dense at a crossing of the repeat as its fibres allow.
    fn is_solid_at(&self, number: usize, set: Set) -> bool {
        let [width, height] = self.drawn[number][set as usize];
        width * height < SOLID * self.least(number, set)
    }

    /// The crossings of the repeat, each once for either of its threads.
    fn threads(&self) -> impl Iterator<Item = (usize, Set)> {
        (0..self.drawn.len()).flat_map(|number| Set::BOTH.map(|set| (number, set)))
    }

    /// Number, within the repeat, of a crossing of the cloth.
    pub(super) const fn number(&self, end: usize, pick: usize) -> usize {
        pick % self.repeat[1] * self.repeat[0] + end % self.repeat[0]
    }

    /// The yarns of a cloth with these crossings, in the order of [`Woven::yarns`].
    pub(super) fn yarns(&self, cloth: &Woven) -> Result<Yarns, FabricError> {
        self.yarns_with_progress(cloth, &mut |_| ControlFlow::Continue(()))
    }

    /// [`RestingRepeat::yarns`] that reports the share of the threads that are placed. `Break` ends
    /// it within a thread.
    pub(super) fn yarns_with_progress(
        &self,
        cloth: &Woven,
        progress: &mut Report<'_>,
    ) -> Result<Yarns, FabricError> {
        let placing = Placing::new(self, cloth);
        let passes = cloth.passes();
        // The points of each pass are counted, and then laid.
        let watch = Watch::new(2 * passes.len() as u64, progress);
        let counts = passes.par_iter().map(|pass| watch.advance(1).map(|()| placing.count(*pass)));
        let counts = counts.collect::<Result<Vec<usize>, _>>()?;
        let (mut table, mut offsets, mut total) = (Vec::new(), Vec::new(), 0);
        for (pass, &count) in passes.iter().zip(&counts) {
            if let Some(yarn) = cloth.yarn(pass) {
                table.push(yarn);
                offsets.push(total);
            }
            total += count as u64;
        }
        offsets.push(total);
        if total > POINTS_MAX {
            let (ends, picks) = (cloth.warp().len(), cloth.weft().len());
            return Err(WovenError::Points { ends, picks, points: total, limit: POINTS_MAX }.into());
        }
        let mut points: Vec<ControlPoint> = zeroed("control points", total)?;
        let mut sources: Vec<u32> = zeroed("sources", total)?;
        let pens = Pen::all(&mut points, &mut sources, counts);
        passes.into_par_iter().zip(pens).try_for_each(|(pass, mut pen)| {
            placing.lay(pass, &mut |point, source| pen.write(point, source));
            watch.advance(1)
        })?;
        let layout = Layout::new(table, offsets, cloth.sections().to_vec())?.with_tension(self.tension)?;
        Ok(Yarns::new(layout, cloth.materials().to_vec(), points)?.with_sources(sources)?)
    }
}

/// Number of threads beyond either edge that are known, because the repeat goes on there. A thread
/// bends round the next one that it meets beyond the edge. With half the value, and with twice, no
/// test is red.
pub(super) const BEYOND: usize = 8;

/// The places of one set of threads.
struct Threads {
    /// Middles of the threads, and of the threads beyond both edges, mm.
    at: Vec<f64>,
    extent: f64,
}

/// A cloth with its crossings at rest, whose control points are to be placed.
pub(super) struct Placing<'a> {
    pub(super) resting: &'a RestingRepeat,
    cloth: &'a Woven,
    sets: [Threads; 2],
    /// For each crossing of the repeat, how far its end and its pick are pushed up, mm; or empty.
    pushes: Vec<[f64; 2]>,
}

/// A thread: its set, 0 or 1, and its number.
pub(super) type Of = (usize, usize);

impl<'a> Placing<'a> {
    fn new(resting: &'a RestingRepeat, cloth: &'a Woven) -> Self {
        let (middles, size) = (cloth.middles_mm().into_array(), cloth.size_mm());
        let sets = [0, 1].map(|set| {
            let gaps = gaps([cloth.warp(), cloth.weft()][set]);
            let (count, repeat) = (middles[set].len(), resting.repeat[set]);
            let gap = |thread: usize| gaps[thread % repeat % count];
            let mut at = middles[set].clone();
            for beyond in 0..BEYOND {
                at.push(at[at.len() - 1] + gap(count - 1 + beyond));
                at.insert(0, at[0] - gap(BEYOND * repeat - 1 - beyond));
            }
            Threads { at, extent: size[set] }
        });
        let mut placing = Self { resting, cloth, sets, pushes: Vec::new() };
        placing.pushes = placing.pushes();
        placing
    }

    /// A thread at a crossing. `crossed` is the number of the crossed thread, counted from the
    /// first of the [`BEYOND`] threads beyond the edge.
    pub(super) fn station(&self, (set, thread): Of, crossed: usize) -> Station {
        let (other, number) = (1 - set, self.crossing((set, thread), crossed));
        let (rest, drawn) = (&self.resting.rest[number], &self.resting.drawn[number]);
        let [own, under] = if set == 0 { [&rest.warp, &rest.weft] } else { [&rest.weft, &rest.warp] };
        let room = self.resting.rooms[set][thread];
        Station {
            number: crossed.wrapping_sub(BEYOND),
            at: self.sets[other].at[crossed] + f64::from(under.shift),
            crossed: [under.half_width, under.half_height].map(f64::from),
            crossed_z: f64::from(under.height),
            side: if self.up(number) == (set == 0) { 1.0 } else { -1.0 },
            across: self.sets[set].at[thread + BEYOND] + f64::from(own.shift),
            z: f64::from(own.height),
            half_height: f64::from(own.half_height),
            drawn: [0, 1].map(|half| f64::from((drawn[set][half] / room[half]).max(RADIUS_MIN))),
        }
    }

    /// Whether the end lies on top at a crossing of the repeat.
    pub(super) fn up(&self, number: usize) -> bool {
        let (end, pick) = (number % self.resting.repeat[0], number / self.resting.repeat[0]);
        self.cloth.drawdown().up(end % self.cloth.warp().len(), pick % self.cloth.weft().len())
    }

    /// The thread of a pass, whether the pass is cut off at its beginning and at its end, whether
    /// it runs against the order of the threads that it crosses, and the number of those threads.
    fn order(&self, pass: Pass) -> (Of, [bool; 2], bool, usize) {
        match pass {
            Pass::End(end) => ((0, end), [true; 2], false, self.cloth.weft().len()),
            Pass::Pick(pick, cut) => {
                let back = selvedge::runs_left(pick, self.cloth.selvedge());
                ((1, pick), cut, back, self.cloth.warp().len())
            }
        }
    }

    /// The number, within the repeat, of the crossing of a thread and a crossed one.
    pub(super) fn crossing(&self, (set, thread): Of, crossed: usize) -> usize {
        let repeat = self.resting.repeat[1 - set];
        let within = (crossed + BEYOND * (repeat - 1)) % repeat;
        if set == 0 { self.resting.number(thread, within) } else { self.resting.number(within, thread) }
    }

    /// Whether the two threads of a crossing of the repeat bend round one another. They do not if
    /// they belong to different layers and the thread of the higher layer lies on top.
    pub(super) fn binds(&self, number: usize) -> bool {
        match self.resting.layers[number] {
            Ordering::Equal => true,
            apart => self.up(number) != apart.is_gt(),
        }
    }

    /// The crossed threads that a thread bends round, with the next one beyond either edge.
    pub(super) fn met(&self, of: Of, count: usize) -> Vec<usize> {
        let meets = |crossed: &usize| self.binds(self.crossing(of, *crossed));
        let before = (0..BEYOND).rev().find(meets).unwrap_or(BEYOND - 1);
        let after = (BEYOND + count..count + 2 * BEYOND).find(meets).unwrap_or(BEYOND + count);
        let met = (BEYOND..BEYOND + count).filter(meets);
        [before].into_iter().chain(met).chain([after]).collect()
    }

    fn count(&self, pass: Pass) -> usize {
        let (of, cut, back, count) = self.order(pass);
        let met = self.met(of, count);
        let mut points = met.len() - 2 + if pass.turns() { TURN_POINTS } else { 0 };
        let sides: Vec<f64> = met.iter().map(|&crossed| self.station(of, crossed).side).collect();
        let turns = if back { [!cut[1], !cut[0]] } else { cut.map(|cut| !cut) };
        for (step, (near, stops)) in sides.windows(4).zip(met[1..].windows(2)).enumerate() {
            let [mut before, changes, mut after] = [0, 1, 2].map(|at| near[at] != near[at + 1]);
            before |= turns[0] && step == 0;
            after |= turns[1] && step + 4 == met.len();
            points += if changes {
                self.resting.change_points
            } else {
                stops[1] - stops[0] - 1 + usize::from(before) + usize::from(after)
            };
        }
        for last in [false, true] {
            if cut[usize::from(last)] {
                self.leave(of, last != back, &met, &mut |_| points += 1);
            }
        }
        points
    }

    /// Calls `write` with each control point of a pass and its source.
    fn lay(&self, pass: Pass, write: &mut impl FnMut(ControlPoint, u32)) {
        let (of, cut, back, count) = self.order(pass);
        let ends = self.cloth.warp().len();
        let mut stop = |stop: Stop| {
            let [along, across, z] = [stop.along, stop.across, stop.z].map(|value| value as f32);
            let [x, y] = if of.0 == 0 { [across, along] } else { [along, across] };
            let halves = stop.halves.map(|half| half as f32);
            let source = stop.crossing.map_or(NO_CROSSING, |crossed| {
                (if of.0 == 0 { crossed * ends + of.1 } else { of.1 * ends + crossed }) as u32
            });
            write(ControlPoint { x, y, z, halves: Halves::new(halves[0], halves[1]) }, source);
        };
        if let (Pass::Pick(pick, _), true) = (pass, pass.turns()) {
            self.turn(pick).stops().for_each(&mut stop);
        }
        let met = self.met(of, count);
        if cut[0] {
            let mut lead = Vec::new();
            self.leave(of, back, &met, &mut |point| lead.push(point));
            lead.into_iter().rev().for_each(&mut stop);
        }
        let last = met.len() - 1;
        let crossed = |step: usize| met[if back { last - step } else { step }];
        let station = |step: usize| self.station(of, crossed(step));
        let [mut before, mut here] = [0, 1].map(station);
        for step in 1..last - 1 {
            stop(here.stop());
            let next = station(step + 1);
            let mut changes = [before.side != here.side, station(step + 2).side != next.side];
            if here.side == next.side {
                // A float leads into a turn as it leads into a change of sides.
                changes[0] |= step == 1 && !cut[0];
                changes[1] |= step == last - 2 && !cut[1];
            }
            self.span(of, [crossed(step), crossed(step + 1)], [here, next], &self.pushes)
                .stops(changes, &mut stop);
            (before, here) = (here, next);
        }
        stop(here.stop());
        if cut[1] {
            self.leave(of, !back, &met, &mut stop);
        }
    }

    /// Calls `stop` with the points from a thread's outermost crossing to the place where the
    /// thread is cut off. `upper` says at which edge this is: at the last crossed threads if it is
    /// set, and at the first crossed threads if not.
    fn leave(&self, of: Of, upper: bool, met: &[usize], stop: &mut impl FnMut(Stop)) {
        let last = met.len() - 1;
        let steps = if upper { [last - 2, last - 1, last] } else { [2, 1, 0] };
        let [inner, here, beyond] = steps.map(|step| self.station(of, met[step]));
        let edge = if upper { self.sets[1 - of.0].extent } else { 0.0 };
        let span = self.span(of, [met[steps[1]], met[steps[2]]], [here, beyond], &self.pushes);
        span.until(edge, inner.side != here.side, stop);
    }

    /// The way of a thread from a crossed thread that it bends round to the next one, with its
    /// `stations` at the two. `pushes` are those of all crossings of the repeat, or none.
    pub(super) fn span(
        &self,
        of: Of,
        [from, to]: [usize; 2],
        stations: [Station; 2],
        pushes: &[[f64; 2]],
    ) -> Span {
        let passed = |crossed| {
            let by = pushes.get(self.crossing(of, crossed)).map_or(0.0, |by| by[of.0]);
            (self.station(of, crossed), by)
        };
        let mut passed: Vec<_> = (from.min(to) + 1..from.max(to)).map(passed).collect();
        if from > to {
            passed.reverse();
        }
        Span::new(stations, passed, self.resting.change_points)
    }

    /// The turn from the pick before to `pick`.
    fn turn(&self, pick: usize) -> Turn {
        let right = selvedge::runs_left(pick, self.cloth.selvedge());
        let (crossed, outwards) =
            if right { (BEYOND + self.cloth.warp().len() - 1, 1.0) } else { (BEYOND, -1.0) };
        let at = |pick: usize| self.station((1, pick), crossed);
        // The picks beside these two belong to the neighbouring turns at this edge. Each turn has
        // half of the gap to them.
        let gap = |below: usize| at(below + 1).across - at(below).across;
        let before = pick.checked_sub(2).map(gap);
        let after = (pick + 1 < self.cloth.weft().len()).then(|| gap(pick));
        let beside = before.into_iter().chain(after).fold(f64::INFINITY, f64::min);
        Turn::new([at(pick - 1), at(pick)], outwards, (gap(pick - 1) + beside) / 2.0)
    }
}
