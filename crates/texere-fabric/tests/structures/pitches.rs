//! Threads stay clear at all pitches from the least one on, by the clearance report. Below it they
//! are reported as jammed, and flattening helps some of them.
//!
//! `contact/contacts.rs` compares the report with brute force. `contact/clearance.rs` measures some
//! of these cloths by brute force.

use texere_contact::clearance;
use texere_core::{Section, Settings};
use texere_fabric::{Crimp, Drawdown, FabricWarning, Relief, Shape, Thread, Weave};

use crate::cloths::{cloth, jam, weaves};

/// The largest pitch, in diameters of the thicker threads.
const FURTHEST: f64 = 6.0;

/// Radii of an end and a pick, mm, and the half width and half height of their section in radii.
struct Pair {
    radius: [f32; 2],
    section: Section,
    half: [f64; 2],
}

const EQUAL: Pair = Pair { radius: [0.1, 0.1], section: Section::Circle, half: [1.0; 2] };
const UNEQUAL: Pair = Pair { radius: [0.1, 0.06], section: Section::Circle, half: [1.0; 2] };
const FLAT: Pair = Pair {
    radius: [0.1, 0.1],
    section: Section::Ellipse { aspect: 2.0 },
    half: [std::f64::consts::SQRT_2, std::f64::consts::FRAC_1_SQRT_2],
};

impl Pair {
    /// Spacings of ends and picks: `ratio` times the least pitch, which follows from the other
    /// set's share of the crimp. Threads of one set lie no closer than side by side.
    fn threads(&self, share: f32, ratio: f64) -> [Thread; 2] {
        let [wide, high] = self.half;
        let radius = self.radius.map(f64::from);
        let least = |own: usize, share| jam(share) * 2.0 * (wide * radius[own] + high * radius[1 - own]);
        [(0, 1.0 - share), (1, share)].map(|(own, share)| {
            Thread::new((ratio * least(own, share)).max(2.0 * wide * radius[own]), self.radius[own])
        })
    }

    /// The least clearance of `drawdown` at this share and ratio. None if a pitch is beyond
    /// [`FURTHEST`].
    fn clearance(&self, drawdown: &Drawdown, share: f32, ratio: f64) -> Option<f64> {
        let threads = self.threads(share, ratio);
        let furthest = FURTHEST * 2.0 * f64::from(self.radius[0]);
        if threads.iter().any(|thread| thread.spacing_mm > furthest) {
            return None;
        }
        let mut cloth = cloth(Shape::Round, drawdown.clone(), threads, self.section.clone());
        cloth.set_crimp(Crimp::WarpShare(share)).unwrap();
        assert_eq!(cloth.warnings(), []);
        Some(clearance(&cloth.yarns().unwrap(), &Settings::default()).unwrap().min)
    }
}

/// Checks that threads stay clear at pitches from `least` times the least pitch on, in growing
/// steps.
fn stays_clear(pair: &Pair, share: f32, least: f64) {
    for (name, drawdown) in weaves() {
        for growth in [1.0, 1.03, 1.06, 1.1, 1.15, 1.2, 1.3, 1.45, 1.6, 1.8, 2.1, 2.5, 3.0, 3.5] {
            let ratio = least * growth;
            if let Some(found) = pair.clearance(&drawdown, share, ratio) {
                assert!(found >= 0.99, "{name}, share {share}, {ratio} of the least pitch: {found}");
            }
        }
    }
}

#[test]
fn round_threads_alike_stay_clear_from_the_least_pitch_on() {
    for (name, drawdown) in weaves() {
        // Pitches from 1.74 diameters, which is a little more than the least pitch.
        for step in (174..=600).step_by(6) {
            let pitch = f64::from(step) / 100.0;
            let thread = Thread::new(pitch * 0.2, 0.1);
            let cloth = cloth(Shape::Round, drawdown.clone(), [thread; 2], Section::Circle);
            assert_eq!(cloth.warnings(), []);
            let found = clearance(&cloth.yarns().unwrap(), &Settings::default()).unwrap();
            assert!(found.min >= 0.99, "{name} at {pitch} diameters: {}", found.min);
            assert!(pitch < 1.98 || found.curvature_min >= 1.0, "{name} at {pitch} diameters folds");
        }
    }
}

#[test]
fn a_figure_in_twill_stays_clear_with_one_point_a_crossing() {
    // A small version of figure 7a of the paper that texere implements (README.md): a figure of
    // warp-faced twill on weft-faced twill, with three diameters from thread to thread.
    let [figure, ground] = ["3/1", "1/3"].map(|name| Weave::parse(name).unwrap());
    let inside = |end: usize, pick: usize| (end as f64 - 50.0).hypot(pick as f64 - 40.0) < 30.0;
    let up = |end, pick| if inside(end, pick) { figure.up(end, pick) } else { ground.up(end, pick) };
    let drawdown = Drawdown::from_fn(100, 80, up).unwrap();
    let cloth = cloth(Shape::Crossing, drawdown, [Thread::new(0.75, 0.125); 2], Section::Circle);
    let found = clearance(&cloth.yarns().unwrap(), &Settings::default()).unwrap();
    assert!(found.min >= 0.985 && found.curvature_min > 1.0, "{} and {}", found.min, found.curvature_min);
}

#[test]
fn crimp_splits_stay_clear() {
    for (share, least) in [(0.35, 1.04), (0.65, 1.04), (0.2, 1.15), (0.8, 1.15)] {
        stays_clear(&EQUAL, share, least);
    }
}

#[test]
fn unequal_threads_stay_clear() {
    for (share, least) in [(0.5, 1.0), (0.35, 1.04), (0.65, 1.04), (0.2, 1.15), (0.8, 1.15)] {
        stays_clear(&UNEQUAL, share, least);
    }
}

#[test]
fn ellipses_stay_clear_by_their_surfaces() {
    for (share, least) in [(0.5, 1.02), (0.35, 1.1), (0.65, 1.1)] {
        stays_clear(&FLAT, share, least);
    }
}

#[test]
fn below_the_least_pitch_threads_pierce_and_are_told_of() {
    for (name, drawdown) in weaves() {
        for pitch in [1.3, 1.5, 1.65] {
            let threads = [Thread::new(pitch * 0.2, 0.1), Thread::new(0.8, 0.1)];
            let mut cloth = cloth(Shape::Round, drawdown.clone(), threads, Section::Circle);
            cloth.set_crimp(Crimp::WarpShare(0.5)).unwrap();
            let jammed = |warning: &FabricWarning| matches!(warning, FabricWarning::Jammed { pitch_mm, .. } if *pitch_mm == pitch * 0.2);
            assert!(cloth.warnings().iter().any(jammed), "{name} at {pitch} diameters");
            let report = cloth.relieve(Relief::Report).unwrap();
            assert!(report.before.warp.jammed > 0 && report.before.weft.jammed == 0, "{name}: {report:?}");
            let found = clearance(&cloth.yarns().unwrap(), &Settings::default()).unwrap();
            assert!(pitch > 1.5 || found.min < 0.99, "{name} at {pitch} diameters: {}", found.min);
        }
    }
}

#[test]
fn flattening_cures_what_it_can() {
    for (name, drawdown) in weaves() {
        for (ends, picks) in [(1.5, 2.4), (1.4, 3.0), (1.3, 2.2), (1.7, 1.7)] {
            let threads = [ends, picks].map(|pitch: f64| Thread::new(pitch * 0.2, 0.1));
            let mut cloth = cloth(Shape::Round, drawdown.clone(), threads, Section::Circle);
            let report = cloth.relieve(Relief::Flatten).unwrap();
            let after = clearance(&cloth.yarns().unwrap(), &Settings::default()).unwrap().min;
            let jammed = report.after.map(|set| set.jammed).into_array();
            if jammed == [0, 0] {
                assert!(after >= 0.99, "{name}, ends {ends}, picks {picks}: {after}");
            } else {
                assert!(!cloth.warnings().is_empty(), "{name}, ends {ends}, picks {picks}: {after}");
            }
        }
    }
}
