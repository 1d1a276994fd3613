//! Flattened yarns that run up and down: their outlines turn from ring to ring no more than those
//! of round yarns.

use std::f64::consts::{PI, TAU};

use glam::{DVec3, Vec3};
use proptest::prelude::*;
use texere_conformance::cases::{design, small_designs};
use texere_core::definitions::{Basis, Stance};
use texere_core::{ControlPoint, Pipeline, Section, Settings, Topology, Yarn, Yarns};
use texere_cpu::ParallelBackend;

use super::check;
use super::judge::drawn;

/// Width over height of the flattened yarns in this file, unless a test gives another.
const FLATNESS: f32 = 2.0;

fn flattened(point: &ControlPoint, flatness: f32) -> ControlPoint {
    let radius = (point.half_width() * point.half_height()).sqrt();
    point.flattened(radius * flatness.sqrt(), radius / flatness.sqrt())
}

/// `yarns`, flattened.
fn flat(yarns: &Yarns, flatness: f32) -> Yarns {
    let points = yarns.points().iter().map(|point| flattened(point, flatness)).collect();
    Yarns::new(yarns.layout().as_ref().clone(), yarns.materials().to_vec(), points).unwrap()
}

/// A yarn through `places` whose section is a lens. Its `radius`, mm, is that before it is
/// flattened.
fn ribbon(places: &[DVec3], closed: bool, radius: f32) -> Yarns {
    let points: Vec<_> = places
        .iter()
        .map(|place| {
            let [x, y, z] = place.as_vec3().to_array();
            flattened(&ControlPoint::new(x, y, z, radius), FLATNESS)
        })
        .collect();
    let mut yarns = Yarns::builder();
    let section = yarns.section(Section::Lenticular { aspect: 1.5, distortion: 0.2 });
    yarns.yarn(Yarn { closed, section, ..Yarn::default() }, &points);
    yarns.build().unwrap()
}

/// Points of `curve` from 0 to 1, enough that it bends by at most `bend` radians from chord to
/// chord. A closed curve lacks the last point.
fn sampled(curve: impl Fn(f64) -> DVec3, closed: bool, bend: f64) -> Vec<DVec3> {
    let mut count = 8;
    loop {
        let places: Vec<_> = (0..=count).map(|k| curve(f64::from(k) / f64::from(count))).collect();
        let chords: Vec<_> = places.windows(2).map(|ends| ends[1] - ends[0]).collect();
        let smooth = chords.windows(2).all(|chords| chords[0].angle_between(chords[1]) < bend);
        if smooth || count > 4_000 {
            return places[..places.len() - usize::from(closed)].to_vec();
        }
        count += count / 4;
    }
}

/// A binder that goes down through the cloth and comes up again, in round bends. It leans to either
/// side, so that its tangent passes z on both sides. With a `lean` of 0 the tangent passes exactly
/// through z. The binder overhangs by `over` radians.
fn binder(lean: f64, over: f64) -> Vec<DVec3> {
    let way = |t: f64| {
        // The slope goes from straight up to straight down, and a little further either way.
        let slope = (PI / 2.0 + over) * (TAU * t).sin().clamp(-0.9, 0.9) / 0.9;
        DVec3::new(slope.cos(), lean * (3.0 * TAU * t).sin(), slope.sin())
    };
    let steps = 4_000;
    let mut at = DVec3::ZERO;
    let places: Vec<_> = (0..steps)
        .map(|step| {
            let here = at;
            at += way(3.0 * f64::from(step) / f64::from(steps)) * (18.0 / f64::from(steps));
            here
        })
        .collect();
    places.into_iter().step_by(50).collect()
}

/// Checks meshes of `yarns`, and that no triangle of finer meshes faces inwards. Meshes with three
/// sides, or with one ring per control point, are too coarse for the second check: triangles of a
/// turning lens may face anywhere in them.
fn check_flat(name: &str, yarns: &Yarns) {
    check(name, yarns);
    let device = ParallelBackend::open().unwrap();
    for (subdivisions, sides) in [(1, 6), (3, 8), (7, 13)] {
        let settings = Settings { subdivisions, sides, ..Settings::default() };
        let drawn = drawn(&device, yarns, settings);
        assert_eq!(drawn.inwards, 0, "{name}, K {subdivisions}, {sides} sides: {drawn:?}");
    }
}

#[test]
fn flat_binders_are_no_strings_of_beads() {
    for lean in [0.0, 1e-7, 1e-3, 0.05, -0.2] {
        for over in [0.0, 0.1, 0.5] {
            let ribbon = ribbon(&binder(lean, over), false, 0.08);
            check_flat(&format!("binder leaning by {lean}, over by {over}"), &ribbon);
        }
    }
}

/// The path of a guide that laps to and fro: a helix whose turns swing sideways.
#[test]
fn flat_yarns_lap_without_wringing() {
    for (swing, per_turn) in [(0.0, 12), (0.6, 16), (1.5, 24)] {
        for tilt in [0.0, 0.4, PI / 2.0] {
            let (tilt_sin, tilt_cos) = f64::sin_cos(tilt);
            let lapping = |k: u32| {
                let turn = f64::from(k) / f64::from(per_turn);
                let (sin, cos) = (TAU * turn).sin_cos();
                let (x, y, z) = (swing * (PI * turn).sin() + 0.3 * cos, 0.8 * turn, 0.5 * sin);
                DVec3::new(x, y * tilt_cos - z * tilt_sin, y * tilt_sin + z * tilt_cos)
            };
            let places: Vec<_> = (0..6 * per_turn).map(lapping).collect();
            check_flat(&format!("lapping by {swing}, tilted by {tilt}"), &ribbon(&places, false, 0.05));
        }
    }
}

#[test]
fn every_design_is_drawn_without_wringing_when_its_yarns_are_flat() {
    for (name, yarns) in small_designs() {
        check_flat(&name, &flat(&yarns, FLATNESS));
        check(&name, &flat(&yarns, 3.0));
    }
}

/// Upright rings with any number of points, and a ribbon that goes straight up.
#[test]
fn flat_rings_on_end_are_not_wrung() {
    for count in [12, 13, 24, 40] {
        for aside in [0.0, 1e-6, 0.1] {
            let ring = |k: u32| {
                let (sin, cos) = (TAU * f64::from(k) / f64::from(count)).sin_cos();
                DVec3::new(cos, aside * 2.0 * sin * cos, sin)
            };
            let places: Vec<_> = (0..count).map(ring).collect();
            check_flat(&format!("ring of {count}, {aside}"), &ribbon(&places, true, 0.1));
        }
    }
    let up: Vec<_> = (0..6).map(|k| DVec3::Z * f64::from(k)).collect();
    check_flat("straight up", &ribbon(&up, false, 0.1));
}

/// A flat yarn follows the upright frame where that frame turns slowly, whatever the yarn does
/// elsewhere.
#[test]
fn a_flat_yarn_stands_upright_where_it_lies_flat() {
    // The yarn runs along x, down, along x, up and along x again.
    let corners = [
        [0.0, 0.0, 0.0],
        [8.0, 0.0, 0.0],
        [8.0, 0.3, -6.0],
        [16.0, 0.3, -6.0],
        [16.0, 0.0, 0.0],
        [24.0, 0.0, 0.0],
    ];
    let corners = corners.map(DVec3::from_array);
    let places: Vec<_> = corners
        .windows(2)
        .flat_map(|ends| (0..12).map(move |k| ends[0].lerp(ends[1], f64::from(k) / 12.0)))
        .collect();
    let ribbon = ribbon(&places, false, 0.1);
    let ups = ribbon.layout().ups(0).expect("it is too steep to stand upright");
    let mut upright = 0;
    for (number, up) in ups.iter().enumerate().skip(1).take(places.len() - 2) {
        let tangent = (places[number + 1] - places[number - 1]).normalize();
        let (before, after) = (places[number - 1], places[(number + 3).min(places.len() - 1)]);
        if (after - before).normalize().z.abs() < 0.05 && tangent.z.abs() < 0.05 {
            let own = Basis::upright(tangent.as_vec3()).up;
            // An outline that is turned over equals itself.
            assert!(own.dot(*up).abs() > 0.999, "point {number}: {up} for {own}");
            upright += 1;
        }
    }
    assert!(upright > 20, "{upright}");
    assert!(ribbon.ups().is_none(), "nobody gave it any");
}

/// Flat threads of woven cloth are not steep and do not lean. Meshes of up to six untwisted threads
/// of each cloth follow the upright frame to the bit.
#[test]
fn flat_threads_of_woven_cloth_have_no_ups() {
    let device = ParallelBackend::open().unwrap();
    for name in ["plain.toml", "poplin.toml", "satin.toml", "denim.toml", "double-cloth.toml", "damask.toml"]
    {
        let woven = flat(&design(name).structure.yarns().unwrap(), FLATNESS);
        assert!(!woven.layout().leans(), "{name}");
        let yarns = 0..woven.layout().yarns().len();
        assert!(!yarns.clone().any(|yarn| woven.layout().is_steep(yarn)), "{name}");
        let untwisted = yarns.filter(|yarn| woven.layout().yarns()[*yarn].twist == 0.0).take(6);
        let untwisted: Vec<_> = untwisted.collect();
        if untwisted.is_empty() {
            continue;
        }
        let woven = woven.only(untwisted).unwrap();
        let settings = Settings { topology: Topology::None, ..Settings::default() };
        let pipeline = || Pipeline::new(&woven).settings(settings);
        let (mesh, rings) = (pipeline().mesh(&device).unwrap(), pipeline().trajectory(&device).unwrap());
        let mut vertices = mesh.vertices.chunks_exact(settings.sides as usize);
        for (yarn, what) in woven.layout().yarns().iter().enumerate() {
            let outline = mesh.plan.outline(what.section as usize);
            for ring in rings.yarn(yarn).unwrap() {
                let upright = Stance::Flattened {
                    basis: Basis::upright(Vec3::from_array(ring.tangent)),
                    sin: 0.0,
                    cos: 1.0,
                };
                let wanted: Vec<_> = outline.iter().map(|point| ring.vertex(&upright, point)).collect();
                assert!(vertices.next().unwrap() == &wanted[..], "{name}, yarn {yarn}");
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Any smooth curve, open or closed.
    #[test]
    fn no_flat_yarn_is_wrung(
        waves in prop::collection::vec((1..4_u8, -1.0..1.0f64, -1.0..1.0f64, -1.0..1.0f64, 0.0..TAU), 2..5),
        along in prop::array::uniform3(-6.0..6.0f64),
        closed: bool,
        tension in 0.0..0.5f32,
    ) {
        let curve = |t: f64| {
            let straight = if closed { DVec3::ZERO } else { DVec3::from_array(along) * t };
            waves.iter().fold(straight, |at, (times, x, y, z, phase)| {
                let angle = TAU * f64::from(*times) * t;
                at + DVec3::new(x * angle.cos(), y * (angle + phase).sin(), z * (angle + 2.0 * phase).cos())
            })
        };
        let ribbon = ribbon(&sampled(curve, closed, 0.5), closed, 0.02);
        check("any flat yarn", &ribbon.with_tension(tension).unwrap());
    }
}
