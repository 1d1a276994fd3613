//! The factor by which the sections of two yarns have to grow until their surfaces touch, by dense
//! sampling.
//!
//! Sections grow about their centres, so that a yarn lies within the same yarn at any larger ratio.
//! There is therefore one ratio below which no surface has a point in another yarn, and above which
//! some surface has. The search starts above this ratio. Each sample that lies in another yarn
//! lowers the ratio to the one at which the sample first touched that yarn, until no sample lies in
//! another yarn.

use std::f64::consts::TAU;
use std::ops::RangeInclusive;
use std::rc::Rc;

use texere_core::{Pipeline, Section, Settings, Yarns};
use texere_cpu::SerialBackend;

use crate::outline::Outline;
use crate::tube::Tube;

/// The least and the largest ratio that the search can give.
const RATIOS: [f64; 2] = [0.4, 1.15];

/// Number of angles at which a ring is sampled.
const ANGLES: usize = 256;

/// The gauge of a sample is the factor by which the other yarn's section has to grow to reach it.
/// If the gauge exceeds the ratio by less than this constant, yarns may touch between the sample
/// and the next one.
const DOUBT: f64 = 0.005;

/// The factor by which all sections, with their furrows, grow until any two yarns touch: 0.4 to
/// 1.15. It is exact to 5e-4, if `settings` puts rings a twenty-fifth of a diameter apart.
pub(crate) fn surface_ratio(yarns: &Yarns, settings: Settings) -> f64 {
    first_touch(yarns, settings, Outline::of)
}

/// [`surface_ratio`] for the hulls of the sections.
pub(crate) fn hull_ratio(yarns: &Yarns, settings: Settings) -> f64 {
    first_touch(yarns, settings, Outline::hull_of)
}

/// [`surface_ratio`] for sections with the outlines that `outline` makes.
fn first_touch(yarns: &Yarns, settings: Settings, outline: fn(&Section) -> Outline) -> f64 {
    let trajectory = Pipeline::new(yarns).settings(settings).trajectory(&SerialBackend::new()).unwrap();
    let layout = yarns.layout();
    let outlines: Vec<_> = layout.sections().iter().map(|section| Rc::new(outline(section))).collect();
    let tubes = layout.yarns().iter().enumerate().map(|(number, yarn)| {
        Tube::new(trajectory.yarn(number).unwrap(), outlines[yarn.section as usize].clone())
    });
    let mut search = Search { tubes: tubes.collect(), ratio: RATIOS[1] };
    search.sweep(8);
    let mut ratio = f64::INFINITY;
    let mut doubtful = Vec::new();
    while search.ratio < ratio {
        ratio = search.ratio;
        doubtful = search.sweep(1);
    }
    loop {
        let ratio = search.ratio;
        for sample in &mut doubtful {
            search.settle(sample);
        }
        if search.ratio > ratio - 1e-6 {
            return search.ratio;
        }
    }
}

struct Search {
    tubes: Vec<Tube>,
    /// The least ratio of all samples so far.
    ratio: f64,
}

/// A point of one yarn's surface, beside a stretch of another yarn.
#[derive(Clone)]
struct Sample {
    yarns: [usize; 2],
    stretch: RangeInclusive<usize>,
    /// The ring of the other yarn at which the point was last found.
    ring: usize,
    /// Place of the sample along its own yarn, in rings.
    at: f64,
    angle: f64,
}

impl Search {
    /// Tests samples of each yarn against all other yarns: every `step`-th ring, and every
    /// `step`-th angle. Returns the nearest sample of each ring that is in doubt.
    fn sweep(&mut self, step: usize) -> Vec<Sample> {
        let mut doubtful = Vec::new();
        let pairs =
            (0..self.tubes.len()).flat_map(|own| (0..self.tubes.len()).map(move |other| [own, other]));
        for yarns in pairs.filter(|[own, other]| own != other) {
            let [own, other] = yarns.map(|yarn| &self.tubes[yarn]);
            let angles = (0..ANGLES).step_by(step).map(|angle| angle as f64 / ANGLES as f64 * TAU);
            let outline: Vec<_> = angles.map(|angle| (angle, own.outline.point(angle))).collect();
            for at in (0..own.rings()).step_by(step) {
                let at = at as f64;
                let stance = own.stance(at);
                for stretch in other.near(stance.centre, RATIOS[1] * (own.reach + other.reach)) {
                    let mut sample = Sample { yarns, ring: *stretch.start(), stretch, at, angle: 0.0 };
                    let mut nearest = (DOUBT, sample.clone());
                    for &(angle, point) in &outline {
                        sample.angle = angle;
                        let outward = stance.outward(point);
                        let mut excess = |ratio: f64| {
                            let point = stance.centre + outward * ratio;
                            other.gauge(point, &sample.stretch, &mut sample.ring, ratio + DOUBT) - ratio
                        };
                        let over = excess(self.ratio);
                        if over < 0.0 {
                            self.ratio = first_crossing(excess, self.ratio);
                        }
                        if over < nearest.0 {
                            nearest = (over, sample.clone());
                        }
                    }
                    if nearest.0 < DOUBT {
                        doubtful.push(nearest.1);
                    }
                }
            }
        }
        doubtful
    }

    /// The gauge of a sample less `ratio`.
    fn excess(&self, sample: &mut Sample, ratio: f64) -> f64 {
        let [own, other] = sample.yarns.map(|yarn| &self.tubes[yarn]);
        let stance = own.stance(sample.at);
        let point = stance.centre + stance.outward(own.outline.point(sample.angle)) * ratio;
        other.gauge(point, &sample.stretch, &mut sample.ring, ratio + DOUBT) - ratio
    }

    /// Moves a sample to where its surface lies deepest in the other yarn, in steps that begin with
    /// one ring and one angle.
    fn settle(&mut self, sample: &mut Sample) {
        let ratio = self.ratio;
        let last = (self.tubes[sample.yarns[0]].rings() - 1) as f64;
        let mut least = self.excess(sample, ratio);
        let mut step = 1.0;
        while step > 0.01 {
            let steps = [(1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (-1, -1), (1, -1), (-1, 1)];
            let moved = steps.into_iter().find_map(|(along, round)| {
                let mut moved = sample.clone();
                moved.at = (moved.at + step * f64::from(along)).clamp(0.0, last);
                moved.angle += step * f64::from(round) / ANGLES as f64 * TAU;
                let excess = self.excess(&mut moved, ratio);
                (excess < least).then_some((excess, moved))
            });
            match moved {
                Some((excess, moved)) => (least, *sample) = (excess, moved),
                None => step /= 2.0,
            }
        }
        if least < 0.0 {
            self.ratio = first_crossing(|ratio| self.excess(sample, ratio), ratio);
        }
    }
}

/// The ratio at which `excess`, which is below 0 at `above`, becomes 0.
fn first_crossing(mut excess: impl FnMut(f64) -> f64, above: f64) -> f64 {
    let (mut low, mut high) = (RATIOS[0], above);
    while high - low > 1e-7 {
        let middle = (low + high) / 2.0;
        if excess(middle) < 0.0 { high = middle } else { low = middle }
    }
    high
}
