//! The measures that a weaver would take of crossings at rest, from their ellipses alone.

use texere_core::crossings::{CrossingState, CrossingsPlan, Set, Site};

use crate::oracle::room;

/// Crimp in per cent, area as a share of the yarn's, thickness in mm, weight in g/m².
pub(crate) struct Measures {
    /// The least factor by which ellipses have to grow until two of them touch: 1 if they touch
    /// already, less if they overlap.
    pub(crate) clearance: f64,
    pub(crate) area: [f64; 2],
    pub(crate) least_area: [f64; 2],
    pub(crate) crimp: [f64; 2],
    /// The share of the cloth through which the ground is seen from above, per cent.
    pub(crate) ground: f64,
    /// The share of the weft in the face, per cent.
    pub(crate) weft_on_face: f64,
    pub(crate) thickness: f64,
    pub(crate) weight: f64,
}

fn lie(plan: &CrossingsPlan, all: &[CrossingState], site: Site, set: Set) -> [f64; 4] {
    let lie = all[plan.number(site)].thread(set);
    [lie.shift, lie.height, lie.half_width, lie.half_height].map(f64::from)
}

pub(crate) fn further(plan: &CrossingsPlan, site: Site, set: Set, along: i32, across: i32) -> Site {
    plan.beside(site, set, along, across).unwrap()
}

/// The length of a taut thread between two crossings: arcs beside both ellipses, and a straight
/// between them.
fn length(plan: &CrossingsPlan, all: &[CrossingState], site: Site, set: Set) -> f64 {
    let next = further(plan, site, set, 1, 0);
    let crossed = set.other();
    let pitch = f64::from(plan.rows(crossed)[site.thread(crossed)].gap);
    let [here, there] = [site, next].map(|site| lie(plan, all, site, set));
    let [one, two] = [site, next].map(|site| lie(plan, all, site, crossed));
    let across = pitch + two[0] - one[0];
    let side = f64::from(plan.side(site, set));
    if side == f64::from(plan.side(next, set)) {
        return across.hypot(there[1] - here[1]) - two[0] + one[0];
    }
    let rise = side * (two[1] - one[1]);
    // The thread may run above the ellipses that it crosses, without touching them. Their half
    // heights are therefore taken from the thread's height: the distance of the middles, less the
    // thread's own half height.
    let halves =
        [[one[2], (here[1] - one[1]).abs() - here[3]], [two[2], (there[1] - two[1]).abs() - there[3]]];
    let thread = here[3] + there[3];
    let left = |slope: f64| {
        let (s, c) = slope.sin_cos();
        across * s + rise * c - halves.iter().map(|[a, b]| (a * s).hypot(b * c)).sum::<f64>() - thread
    };
    let (most, best) = room(across, rise, halves, thread);
    let mut slope = if left(0.0) < 0.0 { best } else { 0.0 };
    if most > 0.0 && left(0.0) < 0.0 {
        let [mut low, mut high] = [0.0, best];
        for _ in 0..50 {
            let middle = f64::midpoint(low, high);
            if left(middle) < 0.0 { low = middle } else { high = middle }
        }
        slope = high;
    }
    let (s, c) = slope.sin_cos();
    let straight = across * c
        - rise * s
        - s * c * halves.iter().map(|[a, b]| (a * a - b * b) / (a * s).hypot(b * c)).sum::<f64>();
    let parts = 100;
    let arcs: f64 = (0..parts)
        .map(|part| {
            let (s, c) = (slope * (f64::from(part) + 0.5) / f64::from(parts)).sin_cos();
            let bends =
                halves.iter().map(|[a, b]| (a * b).powi(2) / (a * s).hypot(b * c).powi(3)).sum::<f64>();
            (bends + thread) * slope / f64::from(parts)
        })
        .sum();
    straight.max(0.0) + arcs - two[0] + one[0]
}

/// The factor by which two upright ellipses, `x` and `z` apart, have to grow until they touch.
/// Points of one are tried against the other.
fn outlines(x: f64, z: f64, [a, b]: [f64; 2], [c, d]: [f64; 2]) -> f64 {
    let inside = |growth: f64| {
        (0..360).any(|part| {
            let (s, cos) = (f64::from(part).to_radians()).sin_cos();
            ((growth * a * cos - x) / (growth * c)).hypot((growth * b * s - z) / (growth * d)) < 1.0
        })
    };
    let [mut low, mut high] = [0.2, 8.0];
    for _ in 0..40 {
        let middle = f64::midpoint(low, high);
        if inside(middle) { high = middle } else { low = middle }
    }
    high
}

fn clearance(plan: &CrossingsPlan, all: &[CrossingState], site: Site, set: Set) -> f64 {
    let [next, beside, opposite] =
        [[1, 0], [0, 1], [1, 1]].map(|[along, across]| further(plan, site, set, along, across));
    let at = |site| lie(plan, all, site, set);
    let (here, after, beside, opposite) = (at(site), at(next), at(beside), at(opposite));
    let gap = f64::from(plan.rows(set)[site.thread(set)].gap);
    let halves = |lie: [f64; 4]| [lie[2], lie[3]];
    let mean = |one: [f64; 4], other: [f64; 4]| -> [f64; 4] {
        std::array::from_fn(|of| f64::midpoint(one[of], other[of]))
    };
    let mut least = outlines(gap + beside[0] - here[0], beside[1] - here[1], halves(here), halves(beside));
    let (one, two) = (mean(here, after), mean(beside, opposite));
    least = least.min(outlines(gap + two[0] - one[0], two[1] - one[1], halves(one), halves(two)));
    let over = lie(plan, all, site, set.other());
    least = least.min((here[1] - over[1]).abs() / (here[3] + over[3]));
    let side = f64::from(plan.side(site, set));
    if side != f64::from(plan.side(next, set)) {
        let two = lie(plan, all, next, set.other());
        let pitch = f64::from(plan.rows(set.other())[site.thread(set.other())].gap);
        let (across, rise) = (pitch + two[0] - over[0], side * (two[1] - over[1]));
        let [mut low, mut high] = [0.2, 8.0];
        for _ in 0..40 {
            let growth = f64::midpoint(low, high);
            let grown = [halves(over), halves(two)].map(|half| half.map(|half| half * growth));
            if room(across, rise, grown, growth * (here[3] + after[3])).0 < 0.0 {
                high = growth
            } else {
                low = growth
            }
        }
        least = least.min(high);
    }
    least
}

/// Measures a repeat. `tex` has the tex of the warp's yarns and of the weft's.
pub(crate) fn measures(plan: &CrossingsPlan, all: &[CrossingState], tex: [f64; 2]) -> Measures {
    let count = all.len() as f64;
    let unit = f64::from(plan.unit());
    let mut found = Measures {
        clearance: f64::INFINITY,
        area: [0.0; 2],
        least_area: [f64::INFINITY; 2],
        crimp: [0.0; 2],
        ground: 0.0,
        weft_on_face: 0.0,
        thickness: 0.0,
        weight: 0.0,
    };
    let mut lengths = [0.0; 2];
    let [mut low, mut high] = [f64::INFINITY, f64::NEG_INFINITY];
    for number in 0..all.len() {
        let site = plan.site(number);
        for (index, set) in Set::BOTH.into_iter().enumerate() {
            let at = lie(plan, all, site, set);
            let area = at[2] * at[3] / f64::from(plan.rows(set)[site.thread(set)].radius).powi(2);
            found.area[index] += area / count;
            found.least_area[index] = found.least_area[index].min(area);
            (low, high) = (low.min(at[1] - at[3]), high.max(at[1] + at[3]));
            lengths[index] += length(plan, all, site, set);
            found.clearance = found.clearance.min(clearance(plan, all, site, set));
        }
        let cover = Set::BOTH.map(|set| {
            (2.0 * lie(plan, all, site, set)[2] / f64::from(plan.rows(set)[site.thread(set)].gap)).min(1.0)
        });
        found.ground += 100.0 * (1.0 - cover[0]) * (1.0 - cover[1]) / count;
        let weft = if plan.side(site, Set::Warp) > 0.0 { cover[1] * (1.0 - cover[0]) } else { cover[1] };
        found.weft_on_face += 100.0 * weft / count;
    }
    for (index, set) in Set::BOTH.into_iter().enumerate() {
        let across: f64 = plan.rows(set.other()).iter().map(|row| f64::from(row.gap)).sum();
        let own: f64 = plan.rows(set).iter().map(|row| f64::from(row.gap)).sum();
        let threads = plan.rows(set).len() as f64;
        let taken = lengths[index] / (threads * across);
        found.crimp[index] = 100.0 * (taken - 1.0);
        // tex is g/km: the threads per mm times the length of each.
        found.weight += threads / (own * unit) * taken * tex[index];
    }
    found.thickness = (high - low) * unit;
    found
}
