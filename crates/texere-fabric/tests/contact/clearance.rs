//! Threads must not pierce one another: distances between threads by brute force, for each shape.

use texere_core::{ControlPoint, Material, Section};
use texere_fabric::{Crimp, Drawdown, Shape, Thread, Woven};

use crate::cloths::{cloth, jam, random_bits, random_weave, weave, weaves};
use crate::oracle::{pierce, round_clearance};

/// Samples per interval. At a pitch of six diameters they lie at most 0.19 diameters apart. The
/// nearest approach of crossing threads that touch is then at most 0.009 diameters less than the
/// distance of the nearest samples.
const SAMPLES: usize = 32;

#[test]
fn one_point_a_crossing_stays_clear() {
    for (name, drawdown) in weaves() {
        for pitch in [2.0, 2.5, 3.0, 4.0, 6.0] {
            let thread = Thread::new(pitch * 0.2, 0.1);
            let cloth = cloth(Shape::Crossing, drawdown.clone(), [thread; 2], Section::Circle);
            assert_eq!(cloth.warnings(), []);
            let clearance = round_clearance(&cloth.yarns().unwrap(), SAMPLES);
            assert!(clearance >= 0.98, "{name} at {pitch} diameters: {clearance}");
        }
    }
}

#[test]
fn round_threads_stay_clear_with_and_without_selvedge() {
    for (name, drawdown) in weaves() {
        for pitch in [1.74, 1.8, 2.0, 2.5, 4.0, 6.0] {
            let thread = Thread::new(pitch * 0.2, 0.1);
            let mut cloth = cloth(Shape::Round, drawdown.clone(), [thread; 2], Section::Circle);
            assert_eq!(cloth.warnings(), []);
            for selvedge in [false, true] {
                cloth.set_selvedge(selvedge);
                let clearance = round_clearance(&cloth.yarns().unwrap(), SAMPLES);
                assert!(clearance >= 0.99, "{name} at {pitch} diameters, selvedge {selvedge}: {clearance}");
            }
        }
    }
}

#[test]
fn unequal_threads_stay_clear_at_every_crimp() {
    // Picks are 0.6 times as thick as ends. Each pair has the warp's share of the crimp, and the
    // pitch over the least pitch.
    for (share, ratio) in [(0.5f32, 1.01), (0.35, 1.045), (0.65, 1.045), (0.2, 1.17), (0.8, 1.17)] {
        for (name, drawdown) in weaves() {
            let pitch = |share, diameter: f64| (ratio * jam(share) * 0.32).max(diameter);
            let threads = [Thread::new(pitch(1.0 - share, 0.2), 0.1), Thread::new(pitch(share, 0.12), 0.06)];
            let mut cloth = cloth(Shape::Round, drawdown, threads, Section::Circle);
            cloth.set_crimp(Crimp::WarpShare(share)).unwrap();
            assert_eq!(cloth.warnings(), []);
            let clearance = round_clearance(&cloth.yarns().unwrap(), SAMPLES);
            assert!(clearance >= 0.99, "{name}, share {share}: {clearance}");
        }
    }
}

#[test]
fn threads_of_all_sizes_and_spacings_stay_clear() {
    // Thick and thin threads, at close and wide spacings, follow one another at random. All have
    // the room that the thickest need.
    for seed in 1..=3 {
        let mut bits = random_bits(seed + 100);
        let mut threads = || -> Vec<Thread> {
            (0..10)
                .map(|_| Thread::new(if bits() { 0.42 } else { 0.9 }, if bits() { 0.1 } else { 0.05 }))
                .collect()
        };
        let (warp, weft) = (threads(), threads());
        let mut cloth =
            Woven::new(random_weave(seed), warp, weft, vec![Material::default()], vec![Section::Circle])
                .unwrap();
        cloth.set_shape(Shape::Round);
        cloth.set_selvedge(true);
        assert_eq!(cloth.warnings(), []);
        let clearance = round_clearance(&cloth.yarns().unwrap(), SAMPLES);
        assert!(clearance >= 0.99, "{seed}: {clearance}");
    }
}

#[test]
fn doubled_ends_and_picks_just_touch() {
    // Two pairs in one shed each, a diameter from thread to thread.
    let set: Vec<_> = [0.02, 0.38, 0.38, 0.02].map(|spacing| Thread::new(spacing, 0.1)).into();
    let drawdown = texere_fabric::Weave::parse("2/2(2+2)").unwrap().drawdown(4, 4).unwrap();
    let mut cloth =
        Woven::new(drawdown, set.clone(), set, vec![Material::default()], vec![Section::Circle]).unwrap();
    cloth.set_shape(Shape::Round);
    assert_eq!(cloth.warnings(), []);
    let clearance = round_clearance(&cloth.yarns().unwrap(), SAMPLES);
    assert!((0.995..=1.0 + 1e-6).contains(&clearance), "{clearance}");
}

#[test]
fn threads_that_are_cut_off_close_to_their_last_crossing_stay_clear() {
    // Thin threads in narrow columns at all four edges, thick ones in wide columns between them.
    for (thin, thick) in [(0.04, 0.1), (0.1, 0.1), (0.05, 0.3)] {
        let wide = vec![Thread::new(7.0 * thick, thick as f32); 6];
        let narrow = vec![Thread::new(1.5 * thin, thin as f32)];
        let set = [narrow.clone(), wide, narrow].concat();
        for name in ["plain", "3/1", "1/3", "2/2(2+2)"] {
            let drawdown = texere_fabric::Weave::parse(name).unwrap().drawdown(8, 8).unwrap();
            let sections = vec![Section::Circle];
            let cloth =
                Woven::new(drawdown, set.clone(), set.clone(), vec![Material::default()], sections).unwrap();
            let clearance = round_clearance(&cloth.yarns().unwrap(), SAMPLES);
            assert!(clearance >= 0.985, "{name} {thin} {thick}: {clearance}");
        }
    }
}

#[test]
fn flat_threads_stay_clear_by_their_surfaces() {
    // (warp's share, pitch over the least one) for ellipses twice as wide as high.
    for (share, ratio) in [(0.5f32, 1.02), (0.35, 1.06)] {
        for (name, drawdown) in [("plain", weave("plain")), ("random", random_weave(1))] {
            let drawdown = Drawdown::from_fn(5, 5, |end, pick| drawdown.up(end, pick)).unwrap();
            let (width, height) = (0.2 * 2f64.sqrt(), 0.2 / 2f64.sqrt());
            let pitch = |share| (ratio * jam(share) * (width + height)).max(width);
            let threads = [Thread::new(pitch(1.0 - share), 0.1), Thread::new(pitch(share), 0.1)];
            let mut cloth = cloth(Shape::Round, drawdown, threads, Section::Ellipse { aspect: 2.0 });
            cloth.set_crimp(Crimp::WarpShare(share)).unwrap();
            assert_eq!(cloth.warnings(), []);
            let yarns = cloth.yarns().unwrap();
            assert!(!pierce(&yarns, 10, 32, 0.99), "{name}, share {share}");
            assert!(pierce(&yarns, 10, 32, 1.03), "{name}, share {share}: the measure is blind");
        }
    }
}

#[test]
fn flat_cloth_would_be_found_out() {
    // The measure is able to fail: at half of every height threads pierce.
    let thread = Thread::new(0.6, 0.1);
    let mut yarns = cloth(Shape::Crossing, weave("3/1"), [thread; 2], Section::Circle).yarns().unwrap();
    for yarn in 0..yarns.layout().yarns().len() {
        let flat: Vec<_> =
            yarns.yarn_points(yarn).unwrap().iter().map(|p| ControlPoint { z: p.z / 2.0, ..*p }).collect();
        yarns.set_points(yarn, &flat).unwrap();
    }
    assert!(round_clearance(&yarns, SAMPLES) < 0.6);
}
