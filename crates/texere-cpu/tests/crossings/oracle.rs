//! The energy, worked out again in double precision and as one sum. Its slopes are differences of
//! that sum.

use texere_core::crossings::{
    AREA_GAIN, AREA_LOSS, BEND, CrossingState, CrossingsPass, CrossingsPlan, MARGIN, NEAR, PRESS,
    SIDEWAYS_BEND, SIDEWAYS_TENSION, SMOOTH, SOLID, STEEPER, Set, Site, TENSION, TOUCH,
};

use crate::chance;

/// The number of kinds of contact: at a crossing, passage, neighbours, neighbours half way,
/// shoulder. Layers have three more: at a crossing of two levels, passage or shoulder past threads
/// of other levels, neighbours of two levels.
pub(crate) const KINDS: usize = 8;

/// A crossing before the first pass, with random changes. Its heights are multiplied by `flat`, and
/// its half widths by about `wide`.
pub(crate) fn stirred(crossing: &CrossingState, [flat, wide]: [f32; 2], seed: &mut u64) -> CrossingState {
    let mut all: [f32; 8] = bytemuck::cast(*crossing);
    for set in 0..2 {
        all[4 * set] += 0.08 * chance(seed);
        all[4 * set + 1] = flat * all[4 * set + 1] + 0.15 * chance(seed);
        all[4 * set + 2] *= wide + 0.4 * chance(seed);
        all[4 * set + 3] *= 1.1 + 0.2 * chance(seed);
    }
    bytemuck::cast(all)
}

/// The room of a passage, and the slope at which it is largest, found by trying all slopes.
pub(crate) fn room(across: f64, rise: f64, halves: [[f64; 2]; 2], thread: f64) -> (f64, f64) {
    let at = |slope: f64| {
        let (s, c) = slope.sin_cos();
        across * s + rise * c
            - (halves[0][0] * s).hypot(halves[0][1] * c)
            - (halves[1][0] * s).hypot(halves[1][1] * c)
            - thread
    };
    let right = std::f64::consts::FRAC_PI_2;
    let tried = (0..=900).map(|part| f64::from(part) / 900.0 * right);
    let coarse = tried.fold(0.0, |best, slope| if at(slope) > at(best) { slope } else { best });
    let [mut low, mut high] = [(coarse - right / 900.0).max(0.0), (coarse + right / 900.0).min(right)];
    for _ in 0..80 {
        let [a, b] = [low + (high - low) / 3.0, high - (high - low) / 3.0];
        if at(a) < at(b) { low = a } else { high = b }
    }
    let best = f64::midpoint(low, high);
    (at(best), best)
}

struct Sum<'a> {
    plan: &'a CrossingsPlan,
    pass: &'a CrossingsPass,
    values: &'a [[f64; 8]],
    /// The values from which the slopes at contacts are taken. They stay fixed while `values` are
    /// changed.
    found: &'a [[f64; 8]],
}

impl Sum<'_> {
    fn lie(&self, site: Site, set: Set) -> [f64; 4] {
        let values = self.values[self.plan.number(site)];
        let first = if set == Set::Warp { 0 } else { 4 };
        [values[first], values[first + 1], values[first + 2], values[first + 3]]
    }

    fn kept_apart(&self, room: f64, kind: usize, kinds: &mut [u32; KINDS]) -> f64 {
        let room = room - f64::from(MARGIN);
        if room >= 0.0 {
            return 0.0;
        }
        kinds[kind] += 1;
        f64::from(self.pass.penalty) * room * room
    }

    fn at(&self, site: Site, kinds: &mut [u32; KINDS]) -> f64 {
        let [warp, weft] = Set::BOTH.map(|set| self.lie(site, set));
        let side = f64::from(self.plan.side(site, Set::Warp));
        let apart = side * (warp[1] - weft[1]);
        // Where both sets have equally many levels, each level is a layer.
        let [end, pick] = self.plan.neighbours(site).levels;
        let is_layered = end.of == pick.of && end.of > 0;
        let mut sum = if is_layered && end != pick {
            let [along_warp, along_weft] = Set::BOTH.map(|set| f64::from(STEEPER) * self.slope(site, set));
            let need = (warp[2] * along_weft).hypot(warp[3]) + (weft[2] * along_warp).hypot(weft[3]);
            self.kept_apart(apart - need, 5, kinds)
        } else {
            let room = apart - warp[3] - weft[3];
            let gap = (room - f64::from(MARGIN)).max(0.0);
            let pull = if is_layered { f64::from(TOUCH) } else { 0.0 };
            self.kept_apart(room, 0, kinds) + pull * gap * gap
        };
        for set in Set::BOTH {
            sum += self.of(site, set);
            sum += self.beside(site, set, kinds);
            let steps = i32::from(self.plan.neighbours(site).beside[set.other() as usize][1]);
            sum += self.between(site, set, 1, [1, 4], kinds);
            if steps > 1 {
                sum += self.between(site, set, steps, [6, 6], kinds);
            }
        }
        sum
    }

    /// The steeper of a thread's slopes before and after a crossing.
    fn slope(&self, site: Site, set: Set) -> f64 {
        let height = |site: Site| self.found[self.plan.number(site)][if set == Set::Warp { 1 } else { 5 }];
        let slope = |steps: i32| {
            let other = self.plan.beside(site, set, steps, 0)?;
            let way =
                if steps < 0 { self.way(other, set.other(), 1) } else { self.way(site, set.other(), 1) };
            Some(((height(other) - height(site)) / way).abs())
        };
        [-1, 1].into_iter().filter_map(slope).fold(0.0, f64::max)
    }

    /// The distance from the thread of a set at `site` to the thread `steps` further on.
    fn way(&self, site: Site, set: Set, steps: i32) -> f64 {
        let rows = self.plan.rows(set);
        let from = site.thread(set);
        (0..steps as usize).map(|step| f64::from(rows[(from + step) % rows.len()].gap)).sum()
    }

    /// The energy of a thread at a crossing and on its way to the next crossing, without contacts.
    fn of(&self, site: Site, set: Set) -> f64 {
        let plan = self.plan;
        let row = plan.rows(set)[site.thread(set)];
        let radius = f64::from(row.radius);
        let d = 2.0 * radius;
        let here = self.lie(site, set);
        let (wide, thick) = (here[2] / radius, here[3] / radius);
        let gain = wide * thick - f64::from(self.pass.area);
        let least = f64::from(row.least_area * self.pass.area + MARGIN);
        let lacking = (wide * thick - least).min(0.0);
        let mut sum = f64::from(row.shape) * (wide - f64::from(row.aspect) * thick).powi(2)
            + f64::from(if gain < 0.0 { AREA_LOSS } else { AREA_GAIN }) * gain * gain
            + f64::from(SOLID * self.pass.penalty) * lacking * lacking
            + f64::from(PRESS * plan.press()) * d * d * here[1].powi(2);
        let pitch = |site: Site| self.way(site, set.other(), 1);
        let [before, after] = [-1, 1].map(|along| plan.beside(site, set, along, 0));
        if let (Some(before), Some(after)) = (before, after) {
            let mean = f64::midpoint(pitch(before), pitch(site));
            let stiff = f64::from(row.stiffness) * d.powi(4) / mean.powi(3);
            let (before, after) = (self.lie(before, set), self.lie(after, set));
            let bend = |of: usize| (before[of] - 2.0 * here[of] + after[of]).powi(2);
            sum += stiff * (f64::from(BEND) * bend(1) + f64::from(SIDEWAYS_BEND) * bend(0));
        }
        if let Some(after) = after {
            let taut = f64::from(plan.tension(set)) * d * d / pitch(site);
            let next = self.lie(after, set);
            let step = |of: usize| (here[of] - next[of]).powi(2);
            let [from, to] = [site, after].map(|site| self.lie(site, set.other())[0]);
            let longer = (pitch(site) + to - from) / pitch(site);
            sum += taut * (f64::from(TENSION) * step(1) / longer + f64::from(SIDEWAYS_TENSION) * step(0));
            sum += f64::from(SMOOTH) / (radius * radius) * (step(2) + step(3));
        }
        sum
    }

    /// The energy of the passage or of the shoulder between a crossing and the crossing `steps`
    /// further along a thread.
    fn between(&self, site: Site, set: Set, steps: i32, kind: [usize; 2], kinds: &mut [u32; KINDS]) -> f64 {
        let Some(after) = self.plan.beside(site, set, steps, 0) else { return 0.0 };
        let way = self.way(site, set.other(), steps);
        let (here, next) = (self.lie(site, set), self.lie(after, set));
        let side = self.plan.side(site, set);
        let [one, two] = [site, after].map(|site| self.lie(site, set.other()));
        if side != self.plan.side(after, set) {
            let (across, rise) = (way + two[0] - one[0], f64::from(side) * (two[1] - one[1]));
            let room = room(across, rise, [[one[2], one[3]], [two[2], two[3]]], here[3] + next[3]).0;
            return self.kept_apart(room, kind[0], kinds);
        }
        let side = f64::from(side);
        if (next[1] - here[1]).abs() < f64::from(NEAR) {
            return 0.0;
        }
        let slope = side * (next[1] - here[1]) / (way + two[0] - one[0]);
        let (own, under) = if slope > 0.0 { (next, two) } else { (here, one) };
        let need = (under[2] * slope).hypot(under[3]) + own[3] * 1.0_f64.hypot(slope);
        self.kept_apart(side * (own[1] - under[1]) - need, kind[1], kinds)
    }

    /// The energy of contacts between a thread and those after it: the next one of its level, and
    /// the very next one if that is of another level.
    fn beside(&self, site: Site, set: Set, kinds: &mut [u32; KINDS]) -> f64 {
        let of_level_at = |site: Site| i32::from(self.plan.neighbours(site).beside[set as usize][1]);
        let of_level = of_level_at(site);
        let here = self.lie(site, set);
        let mut sum = 0.0;
        for (steps, is_level) in [(of_level, true), (1, false)] {
            if steps == 0 || !is_level && of_level == 1 {
                continue;
            }
            let Some(beside) = self.plan.beside(site, set, 0, steps) else { continue };
            let other = self.lie(beside, set);
            let gap = self.way(site, set, steps);
            let apart = gap + other[0] - here[0];
            let wide = here[2] + other[2];
            sum += if is_level {
                self.kept_apart(apart - wide, 2, kinds)
            } else {
                let clearance = (apart / wide).hypot((other[1] - here[1]) / (here[3] + other[3]));
                self.kept_apart((clearance - 1.0) * wide, 7, kinds)
            };
            let [after, opposite] = [0, steps].map(|across| self.plan.beside(site, set, 1, across));
            // Threads of one level with others between them touch half way only if they are
            // neighbours at both crossings.
            let are_neighbours = |after: Site| steps == 1 || of_level_at(after) == steps;
            if let (Some(after), Some(opposite)) = (after.filter(|&after| are_neighbours(after)), opposite) {
                let (next, opposite) = (self.lie(after, set), self.lie(opposite, set));
                let half = |of: usize| 0.5 * (other[of] + opposite[of] - here[of] - next[of]);
                let both = |of: usize| 0.5 * (other[of] + opposite[of] + here[of] + next[of]);
                let clearance = ((gap + half(0)) / both(2)).hypot(half(1) / both(3));
                sum += self.kept_apart((clearance - 1.0) * both(2), 3, kinds);
            }
        }
        sum
    }

    fn whole(&self, kinds: &mut [u32; KINDS]) -> f64 {
        (0..self.plan.crossings()).map(|number| self.at(self.plan.site(number), kinds)).sum()
    }
}

fn values(crossings: &[CrossingState]) -> Vec<[f64; 8]> {
    crossings.iter().map(|crossing| bytemuck::cast::<_, [f32; 8]>(*crossing).map(f64::from)).collect()
}

/// The energy of all crossings. `kinds` counts the contacts of each kind.
pub(crate) fn energy(
    plan: &CrossingsPlan,
    pass: &CrossingsPass,
    crossings: &[CrossingState],
    kinds: &mut [u32; KINDS],
) -> f64 {
    let values = values(crossings);
    Sum { plan, pass, values: &values, found: &values }.whole(kinds)
}

/// The slopes of the energy in the eight unknowns of one crossing, by differences.
pub(crate) fn gradient(
    plan: &CrossingsPlan,
    pass: &CrossingsPass,
    crossings: &[CrossingState],
    number: usize,
    kinds: &mut [u32; KINDS],
) -> [f64; 8] {
    const STEP: f64 = 1e-6;
    let found = values(crossings);
    std::array::from_fn(|unknown| {
        let mut moved = |by: f64| {
            let mut values = values(crossings);
            values[number][unknown] += by;
            Sum { plan, pass, values: &values, found: &found }.whole(kinds)
        };
        (moved(STEP) - moved(-STEP)) / (2.0 * STEP)
    })
}
