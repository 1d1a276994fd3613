//! Threads must not pierce one another: centrelines at least 0.98 diameters apart, by brute force on finely sampled
//! splines.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test ends at what it did not expect")]

use texere_core::{ControlPoint, Material, Section, Segment, Yarns};
use texere_fabric::{Drawdown, Thread, Weave, Woven};

/// Diameter of all threads, mm.
const DIAMETER: f32 = 0.2;

/// Samples of an interval. At the widest pitch tested they lie 1/12 of a diameter apart, which hides 1e-3 of a diameter
/// of a nearest approach at most.
const SAMPLES: usize = 48;

/// Samples of one control interval and the ball that holds them.
struct Stretch {
    yarn: usize,
    samples: Vec<[f32; 3]>,
    middle: [f32; 3],
    reach: f32,
}

fn distance(a: &[f32; 3], b: &[f32; 3]) -> f32 {
    (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f32>().sqrt()
}

fn stretches(yarns: &Yarns) -> Vec<Stretch> {
    let mut stretches = Vec::new();
    for yarn in 0..yarns.layout().yarns().len() {
        let inner = yarns.yarn_points(yarn).unwrap();
        let mut points: Vec<ControlPoint> = vec![inner[0].reflected(&inner[1])];
        points.extend(inner);
        points.push(inner[inner.len() - 1].reflected(&inner[inner.len() - 2]));
        for window in points.windows(4) {
            let segment = Segment::new(window.try_into().unwrap(), 0.5);
            let samples: Vec<_> =
                (0..=SAMPLES).map(|k| segment.sample(k as f32 / SAMPLES as f32).centre.to_array()).collect();
            let middle = samples[SAMPLES / 2];
            let reach = samples.iter().map(|sample| distance(sample, &middle)).fold(0.0, f32::max);
            stretches.push(Stretch { yarn, samples, middle, reach });
        }
    }
    stretches
}

/// The least distance between the centrelines of two different yarns, in diameters.
fn clearance(yarns: &Yarns) -> f32 {
    let stretches = stretches(yarns);
    let mut least = 2.0 * DIAMETER;
    for (number, one) in stretches.iter().enumerate() {
        for other in stretches[number..].iter().filter(|other| other.yarn != one.yarn) {
            if distance(&one.middle, &other.middle) - one.reach - other.reach < least {
                for a in &one.samples {
                    for b in &other.samples {
                        least = least.min(distance(a, b));
                    }
                }
            }
        }
    }
    least / DIAMETER
}

fn cloth(drawdown: Drawdown, pitch: f64) -> Yarns {
    let thread = Thread::new(pitch * f64::from(DIAMETER), DIAMETER / 2.0);
    let (warp, weft) = (vec![thread; drawdown.ends()], vec![thread; drawdown.picks()]);
    let woven = Woven::new(drawdown, warp, weft, vec![Material::default()], vec![Section::Circle]).unwrap();
    assert_eq!(woven.warnings(), []);
    woven.yarns().unwrap()
}

#[track_caller]
fn stays_clear(name: &str, drawdown: &Drawdown) {
    for pitch in [2.0, 2.5, 3.0, 4.0, 6.0] {
        let clearance = clearance(&cloth(drawdown.clone(), pitch));
        assert!(clearance >= 0.98, "{name} at {pitch} diameters: {clearance}");
    }
}

#[test]
fn named_weaves_stay_clear() {
    for weave in ["plain", "3/1", "2/2", "2/2(2+2)", "satin 5", "satin 8(3)", "sateen 8(3)"] {
        stays_clear(weave, &Weave::parse(weave).unwrap().drawdown(10, 10).unwrap());
    }
}

#[test]
fn random_weaves_stay_clear() {
    for seed in 1..=4u64 {
        // Knuth's multiplicative congruential generator; its high bits are random enough for a weave.
        let mut state = seed;
        let drawdown = Drawdown::from_fn(10, 10, |_, _| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            state >> 63 == 1
        });
        stays_clear(&format!("random weave {seed}"), &drawdown.unwrap());
    }
}

#[test]
fn flat_cloth_would_be_found_out() {
    // The measure must see what it is there to see: halve every height, and threads pierce.
    let mut yarns = cloth(Weave::parse("3/1").unwrap().drawdown(10, 10).unwrap(), 3.0);
    for yarn in 0..yarns.layout().yarns().len() {
        let flat: Vec<_> =
            yarns.yarn_points(yarn).unwrap().iter().map(|p| ControlPoint { z: p.z / 2.0, ..*p }).collect();
        yarns.set_points(yarn, &flat).unwrap();
    }
    assert!(clearance(&yarns) < 0.6);
}
