//! The energy once more, in double precision and as one sum, and its slopes by differences.

use texere_core::crossings::{
    AREA_GAIN, AREA_LOSS, ASPECT, BEND, Crossing, CrossingsPass, CrossingsPlan, MARGIN, PRESS, SHAPE,
    SIDEWAYS_BEND, SIDEWAYS_TENSION, SMOOTH, Set, Site, TENSION,
};

use crate::chance;

/// Contact, passage, neighbours, neighbours half way, shoulders.
pub(crate) const KINDS: usize = 5;

/// A crossing near a start, but thicker and with some disorder.
pub(crate) fn stirred(crossing: &Crossing, seed: &mut u64) -> Crossing {
    let mut all: [f32; 8] = bytemuck::cast(*crossing);
    for set in 0..2 {
        all[4 * set] += 0.08 * chance(seed);
        all[4 * set + 1] += 0.15 * chance(seed);
        all[4 * set + 2] *= 2.4 + 0.4 * chance(seed);
        all[4 * set + 3] *= 1.1 + 0.2 * chance(seed);
    }
    bytemuck::cast(all)
}

/// The room of a passage and the slope that leaves most, by trying all of them.
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
        let mut sum = self.kept_apart(side * (warp[1] - weft[1]) - warp[3] - weft[3], 0, kinds);
        for set in Set::BOTH {
            sum += self.of(site, set, kinds);
        }
        sum
    }

    fn of(&self, site: Site, set: Set, kinds: &mut [u32; KINDS]) -> f64 {
        let plan = self.plan;
        let row = plan.rows(set)[site.thread(set)];
        let radius = f64::from(row.radius);
        let d = 2.0 * radius;
        let here = self.lie(site, set);
        let (wide, thick) = (here[2] / radius, here[3] / radius);
        let gain = wide * thick - f64::from(self.pass.area);
        let mut sum = f64::from(SHAPE) * (wide - f64::from(ASPECT) * thick).powi(2)
            + f64::from(if gain < 0.0 { AREA_LOSS } else { AREA_GAIN }) * gain * gain
            + f64::from(PRESS * plan.press()) * d * d * here[1].powi(2);
        let pitch = |site: Site| f64::from(plan.rows(set.other())[site.thread(set.other())].gap);
        let [before, after, beside, opposite] =
            [[-1, 0], [1, 0], [0, 1], [1, 1]].map(|[along, across]| plan.beside(site, set, along, across));
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
            sum += taut * (f64::from(TENSION) * step(1) + f64::from(SIDEWAYS_TENSION) * step(0));
            sum += f64::from(SMOOTH) / (radius * radius) * (step(2) + step(3));
            let side = plan.side(site, set);
            if side != plan.side(after, set) {
                let [one, two] = [site, after].map(|site| self.lie(site, set.other()));
                let (across, rise) = (pitch(site) + two[0] - one[0], f64::from(side) * (two[1] - one[1]));
                let room = room(across, rise, [[one[2], one[3]], [two[2], two[3]]], here[3] + next[3]).0;
                sum += self.kept_apart(room, 1, kinds);
            } else {
                let side = f64::from(side);
                let [one, two] = [site, after].map(|site| self.lie(site, set.other()));
                let slope = side * (next[1] - here[1]) / (pitch(site) + two[0] - one[0]);
                let (own, under) = if slope > 0.0 { (next, two) } else { (here, one) };
                let need = (under[2] * slope).hypot(under[3]) + own[3] * 1.0_f64.hypot(slope);
                sum += self.kept_apart(side * (own[1] - under[1]) - need, 4, kinds);
            }
        }
        if let Some(beside) = beside {
            let other = self.lie(beside, set);
            let gap = f64::from(row.gap);
            sum += self.kept_apart(gap + other[0] - here[0] - here[2] - other[2], 2, kinds);
            if let (Some(after), Some(opposite)) = (after, opposite) {
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

fn values(crossings: &[Crossing]) -> Vec<[f64; 8]> {
    crossings.iter().map(|crossing| bytemuck::cast::<_, [f32; 8]>(*crossing).map(f64::from)).collect()
}

/// The energy of all crossings; `kinds` counts contacts.
pub(crate) fn energy(
    plan: &CrossingsPlan,
    pass: &CrossingsPass,
    crossings: &[Crossing],
    kinds: &mut [u32; KINDS],
) -> f64 {
    Sum { plan, pass, values: &values(crossings) }.whole(kinds)
}

/// The slopes of the energy in the unknowns of one crossing, by differences.
pub(crate) fn gradient(
    plan: &CrossingsPlan,
    pass: &CrossingsPass,
    crossings: &[Crossing],
    number: usize,
    kinds: &mut [u32; KINDS],
) -> [f64; 8] {
    const STEP: f64 = 1e-6;
    std::array::from_fn(|unknown| {
        let mut moved = |by: f64| {
            let mut values = values(crossings);
            values[number][unknown] += by;
            Sum { plan, pass, values: &values }.whole(kinds)
        };
        (moved(STEP) - moved(-STEP)) / (2.0 * STEP)
    })
}
