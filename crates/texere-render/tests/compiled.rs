//! Shaders are compiled once. A driver that compiled one at each launch would grow without end.

#![cfg(target_os = "linux")]
#![allow(missing_docs, reason = "a test has no reader of its docs")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use texere_core::{ControlPoint, Pipeline, Settings, Yarn, Yarns};
use texere_render::{Camera, Quality, Renderer};
use texere_wgpu::{Schedule, WgpuBackend};

/// The number of pieces of compiled code in the process that come from no file.
fn pieces() -> usize {
    let maps = std::fs::read_to_string("/proc/self/maps").unwrap();
    maps.lines().filter(|line| line.contains(" r-xp ") && !line.contains('/')).count()
}

fn yarns() -> Yarns {
    let mut yarns = Yarns::builder();
    for end in 0..20 {
        let place =
            |pick: u32| ControlPoint::new(pick as f32, end as f32, ((pick + end) % 2) as f32 * 0.3, 0.2);
        yarns.yarn(Yarn::default(), &(0..20).map(place).collect::<Vec<_>>());
    }
    yarns.build().unwrap()
}

/// This is the only test of its file, because another test in this process would compile shaders of
/// its own meanwhile.
#[test]
fn nothing_is_compiled_twice() {
    let renderer = Renderer::new(WgpuBackend::open(0, Schedule::PerRing).unwrap()).unwrap();
    let yarns = yarns();
    let round = || {
        let mut scene = renderer.scene(&yarns, &Settings::default()).unwrap();
        for size in [[8, 8], [60, 40]] {
            let camera = Camera::face(scene.extent(), size);
            scene.frame(&camera, Quality { supersampling: 1, ..Quality::default() }).unwrap();
        }
        Pipeline::new(&yarns).mesh(renderer.backend()).unwrap();
    };
    (0..3).for_each(|_| round());
    let before = pieces();
    (0..20).for_each(|_| round());
    // When shaders read parameters from uniforms, Mesa's software device compiled 97 pieces more.
    // The allowance is for whatever a driver does once, after a while.
    assert!(pieces() < before + 10, "{before} pieces of compiled code have become {}", pieces());
}
