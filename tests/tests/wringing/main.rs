//! Tubes are not wrung: beyond the yarn's twist, no ring is turned against the previous one by more
//! than 30 degrees.

mod flat;
mod judge;

use std::f64::consts::{PI, TAU};

use judge::drawn;
use proptest::prelude::*;
use texere_conformance::cases::small_designs;
use texere_core::{ControlPoint, Frame, Settings, Yarn, Yarns};
use texere_cpu::ParallelBackend;

/// The largest turn of a ring against the previous one that is allowed, degrees.
const TURN: f64 = 30.0;

/// Width of a tube half way between two rings that are turned by [`TURN`], as a share of its width
/// on the rings.
const WIDTH: f64 = 0.965_925;

const FRAMES: [Frame; 2] = [Frame::Upright, Frame::RotationMinimizing];

/// Pairs of subdivisions and sides: few rings with few sides, and many.
const DRAWN: [(u32, u32); 5] = [(0, 6), (1, 6), (1, 3), (3, 8), (7, 13)];

/// Checks meshes of `yarns` with all pairs of [`DRAWN`] and with either frame. Returns the largest
/// number of triangles of a mesh that face inwards.
fn check(name: &str, yarns: &Yarns) -> usize {
    let device = ParallelBackend::open().unwrap();
    let mut inwards = 0;
    for (subdivisions, sides) in DRAWN {
        for frame in FRAMES {
            let settings = Settings { subdivisions, sides, frame, ..Settings::default() };
            let drawn = drawn(&device, yarns, settings);
            let case = format!("{name}, {frame:?}, K {subdivisions}, {sides} sides: {drawn:?}");
            assert!(drawn.turn <= TURN, "{case}");
            // A section in a rotation-minimizing frame turns inside the outline of a flattened
            // yarn. Its vertices come nearer to the axis and go away from it, so the width proves
            // nothing.
            let layout = yarns.layout();
            let carried = (0..layout.yarns().len())
                .any(|yarn| frame.of(layout.is_steep(yarn)) == Frame::RotationMinimizing);
            let slides = carried && yarns.points().iter().any(|point| !point.is_round());
            assert!(slides || drawn.width >= WIDTH, "{case}");
            inwards = inwards.max(drawn.inwards);
        }
    }
    inwards
}

/// A yarn of radius 0.1 mm through `places`, a closed one if `closed`.
fn yarn(places: &[[f64; 3]], closed: bool) -> Yarns {
    let points: Vec<_> = places
        .iter()
        .map(|place| {
            let [x, y, z] = place.map(|at| at as f32);
            ControlPoint::new(x, y, z, 0.1)
        })
        .collect();
    let mut yarns = Yarns::builder();
    yarns.yarn(Yarn { closed, ..Yarn::default() }, &points);
    yarns.build().unwrap()
}

#[test]
fn every_design_is_drawn_without_wringing_in_either_frame() {
    for (name, yarns) in small_designs() {
        assert_eq!(check(&name, &yarns), 0, "{name}: triangles face inwards");
    }
}

/// A binder goes straight down through the cloth and comes up again. It leans a little to either
/// side, so that its tangent passes z on both sides, and exactly through it.
#[test]
fn a_binder_that_goes_through_the_cloth_is_no_string_of_beads() {
    for lean in [0.0, 1e-7, 1e-3, 0.05, -0.2] {
        let mut places = Vec::new();
        for turn in 0..6 {
            let (x, down) = (f64::from(turn), turn % 2 == 0);
            for step in 0..8 {
                let z = 1.0 - 0.25 * f64::from(step);
                let side = lean * f64::from(step % 3 - 1);
                places.push([x + side, 0.3 * side, if down { z } else { -z }]);
            }
        }
        check(&format!("binder leaning by {lean}"), &yarn(&places, false));
    }
}

/// Hairpins in planes of every slope, the steepest through z.
#[test]
fn hairpins_through_the_vertical_are_not_wrung() {
    for slope in [0.0, 0.3, 0.8, 1.2, 1.5, PI / 2.0] {
        for aside in [0.0, 0.02, 0.3] {
            let arc = (-8..=8).map(|step| {
                let angle = f64::from(step) / 8.0 * PI * 0.75;
                let (along, across) = (angle.cos(), angle.sin());
                [along * slope.cos() + aside * across, across, along * slope.sin()]
            });
            let arc: Vec<_> = arc.map(|[x, y, z]| [y, x, z]).collect();
            assert_eq!(check(&format!("hairpin, slope {slope}, {aside}"), &yarn(&arc, false)), 0);
        }
    }
}

/// The tangent of a yarn that is closed to an upright circle passes z twice. The frame comes back
/// to itself.
#[test]
fn closed_yarns_that_stand_on_end_are_not_wrung() {
    for aside in [0.0, 1e-6, 0.1] {
        let round: Vec<_> = (0..24)
            .map(|step| {
                let angle = f64::from(step) / 24.0 * TAU;
                [angle.cos(), aside * (2.0 * angle).sin(), angle.sin()]
            })
            .collect();
        assert_eq!(check(&format!("ring, {aside}"), &yarn(&round, true)), 0);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Any open yarn, at tensions from 0 to below 0.9.
    #[test]
    fn no_yarn_is_wrung(
        steps in prop::collection::vec([-1.0..1.0f64, -1.0..1.0, -1.0..1.0], 3..30),
        tension in 0.0..0.9f32,
    ) {
        let mut at = [0.0; 3];
        let places: Vec<_> = steps
            .iter()
            .map(|step| {
                at = [0, 1, 2].map(|axis| at[axis] + step[axis]);
                at
            })
            .collect();
        check("any yarn", &yarn(&places, false).with_tension(tension).unwrap());
    }
}
