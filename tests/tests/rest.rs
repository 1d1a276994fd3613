//! Tests of the starts for settling, and of the checks of settled cloth.

use std::f64::consts::TAU;

use glam::{DVec3, dvec3};
use texere_conformance::rest::{
    CROSSED, Chart, Ends, Gauge, Length, Start, StartYarn, Weave, check, linking, linking_integral, starts,
    weft_knit, woven,
};

/// A circle about `centre` as a closed yarn, in the plane of two unit vectors.
fn circle(centre: DVec3, plane: [DVec3; 2], size: f64, count: u32, radius: f64) -> StartYarn {
    let point = |k| {
        let (sin, cos) = (TAU * f64::from(k) / f64::from(count)).sin_cos();
        centre + (plane[0] * cos + plane[1] * sin) * size
    };
    StartYarn { points: (0..count).map(point).collect(), radius, ends: Ends::Closed }
}

/// Two circles, each through the centre of the other. The plane of the second one is turned about
/// their common axis.
fn linked_circles() -> Start {
    start(vec![
        circle(DVec3::ZERO, [DVec3::X, DVec3::Y], 3.0, 48, 1.5),
        circle(DVec3::X * 3.0, [DVec3::X, DVec3::Z], 3.0, 48, 1.0),
    ])
}

fn start(yarns: Vec<StartYarn>) -> Start {
    Start { name: "test".to_owned(), yarns, repeat: [0.0; 2], pinned: Vec::new(), length: Length::Held }
}

/// A straight yarn along y, of 10 mm per repeat.
fn straight(x: f64, z: f64, radius: f64) -> StartYarn {
    let points = (0..5).map(|k| dvec3(x, 2.0 * f64::from(k), z)).collect();
    StartYarn { points, radius, ends: Ends::Repeats([0, 1]) }
}

/// `points`, each moved by `size` in a pseudo-random direction, which is the same on every run.
fn noise(points: &[Vec<DVec3>], size: f64) -> Vec<Vec<DVec3>> {
    let mut seed = 1u64;
    let mut next = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    let mut moved = |point: &DVec3| *point + dvec3(next(), next(), next()).normalize() * size;
    points.iter().map(|yarn| yarn.iter().map(&mut moved).collect()).collect()
}

#[test]
fn circles_have_their_radius_length_and_distance() {
    let start = linked_circles();
    let report = check(&start, &start.points());
    // The nearest places are at the centre of the other circle.
    assert!((report.clearance - 3.0 / 2.5).abs() < 1e-3, "{report:?}");
    assert_eq!(report.nearest.map(|places| places.map(|place| place.yarn)), Some([0, 1]));
    // The spline bends more at its points than between them, by 1 % with 48 of them.
    assert!((report.bend - 1.0).abs() < 0.02, "{report:?}");
    assert_eq!(report.sharpest.yarn, 0);
    assert!((report.thickness - 8.0).abs() < 1e-3, "{report:?}");
    assert_eq!((report.stretch, report.growth), (0.0, 0.0));
}

#[test]
fn lengths_are_against_the_start() {
    let start = linked_circles();
    let mut points = start.points();
    points[1].iter_mut().for_each(|point| *point *= 0.9);
    let report = check(&start, &points);
    assert!((report.stretch + 0.1).abs() < 1e-12 && report.stretched == 1, "{report:?}");
    assert!((report.growth + 0.05).abs() < 1e-12, "{report:?}");
}

#[test]
fn a_yarn_is_near_itself_only_further_along() {
    // Every place of a tight ring is near to others. Two places count only if the yarn between them
    // is at least π/2 diameters long.
    let ring = start(vec![circle(DVec3::ZERO, [DVec3::X, DVec3::Y], 0.6, 24, 0.5)]);
    let report = check(&ring, &ring.points());
    let chord = 1.2 * (TAU / 4.0 / 1.2f64).sin();
    assert!(report.clearance > chord && report.clearance < chord + 0.02, "{report:?}");

    // Two legs that bow towards one another. A spline through points of a parabola is the parabola.
    let leg =
        [[0.0, 0.8], [1.0, 0.5], [2.0, 0.4], [3.0, 0.5], [4.0, 0.8], [5.0, 1.3], [6.3, 1.2], [7.0, 0.0]];
    let mirrored = leg.iter().rev().skip(1).map(|at| dvec3(at[0], -at[1], 0.0));
    let points = leg.iter().map(|at| dvec3(at[0], at[1], 0.0)).chain(mirrored).collect();
    let bow = start(vec![StartYarn { points, radius: 0.5, ends: Ends::Open }]);
    let report = check(&bow, &bow.points());
    assert!((report.clearance - 0.8).abs() < 1e-6, "{report:?}");
}

#[test]
fn straight_yarns_are_as_far_apart_as_they_are() {
    let mut pair = start(vec![straight(0.2, 0.0, 0.5), straight(0.8, 0.8, 0.25)]);
    pair.repeat = [0.0, 10.0];
    let apart = check(&pair, &pair.points());
    assert!((apart.clearance - 1.0 / 0.75).abs() < 1e-9, "{apart:?}");
    assert_eq!(apart.bend, f64::INFINITY);

    // The distance across the seam of the repeat does not depend on where the yarns begin.
    for repeats in [0.0, 3.0, -2.0] {
        pair.repeat = [10.0; 2];
        let mut points = pair.points();
        points[1].iter_mut().for_each(|point| point.x = 9.6 + repeats * 10.0);
        let seam = check(&pair, &points);
        assert!((seam.clearance - 1.0 / 0.75).abs() < 1e-9, "{seam:?}");
    }

    // Further apart than the first reach of the search.
    let mut wide = start(vec![straight(1.2, 0.0, 0.5), straight(2.6, 0.0, 0.5)]);
    wide.repeat = [0.0, 10.0];
    assert!((check(&wide, &wide.points()).clearance - 1.4).abs() < 1e-9);

    // A yarn alone meets its own image beside it. Without a repeat along x it meets only itself,
    // further along the yarn.
    let mut alone = start(vec![straight(0.0, 0.0, 0.5)]);
    alone.repeat = [0.7, 10.0];
    assert!((check(&alone, &alone.points()).clearance - 0.7).abs() < 1e-9);
    alone.repeat = [0.0, 10.0];
    let further = check(&alone, &alone.points()).clearance;
    assert!(further > TAU / 4.0 && further < 1.1 * TAU / 4.0, "{further}");
}

#[test]
fn the_integral_of_linked_circles_is_one() {
    let closed = |yarn: &StartYarn| {
        let mut points = yarn.points.clone();
        points.push(points[0]);
        points
    };
    let [one, other] = [0, 1].map(|yarn| closed(&linked_circles().yarns[yarn]));
    let back: Vec<_> = other.iter().rev().copied().collect();
    let integral = linking_integral(&one, &other);
    assert!((integral.abs() - 1.0).abs() < 1e-9, "{integral}");
    assert!((integral + linking_integral(&one, &back)).abs() < 1e-9);
    let away: Vec<_> = other.iter().map(|point| *point + DVec3::Z * 7.0).collect();
    assert!(linking_integral(&one, &away).abs() < 1e-9);
}

/// Every start: its clearance, the least radius of curvature and the thickness, both in diameters.
///
/// Jersey, warp knits of one bar, and weaves are as clear as their models promise. In rib, garter,
/// tuck, miss and lace, the lower half of a loop lies on the side to which the loop itself is
/// drawn, and the upper half on the side to which the next loop is drawn. Loops on one needle lie
/// in layers. These starts are clearer than they would be with loops that are all equal, which
/// would pierce to 0.4. The two bars of a warp knit always pierce one another at the start.
const LISTED: [(&str, f64, f64, f64); 39] = [
    ("jersey-4.2", 0.995, 0.715, 2.27),
    ("jersey-5", 1.003, 0.956, 2.22),
    ("jersey-6", 0.999, 0.968, 2.18),
    ("jersey-8", 0.995, 1.247, 2.16),
    ("jersey-3.6", 0.786, 0.528, 2.27),
    ("rib-4.4", 0.725, 0.509, 2.35),
    ("rib-5", 0.721, 0.685, 2.31),
    ("rib-6", 0.714, 0.968, 2.27),
    ("garter-4.4", 0.777, 0.402, 2.15),
    ("garter-5", 0.813, 0.513, 2.13),
    ("tuck-5", 0.893, 0.634, 3.35),
    ("miss-5", 0.900, 0.634, 2.28),
    ("lace-4x4", 0.447, 0.541, 3.34),
    ("random-12x12", 0.900, 0.634, 2.28),
    ("jersey-5-piece", 0.997, 0.956, 2.24),
    ("tricot-0.13", 1.111, 0.452, 4.78),
    ("open-tricot-0.13", 1.121, 0.447, 4.78),
    ("pillar-0.13", 1.121, 0.279, 4.70),
    ("cord-0.13", 1.111, 0.500, 4.74),
    ("open-atlas-0.13", 1.111, 0.543, 4.78),
    ("one-bar-satin-0.13", 0.952, 0.576, 4.74),
    ("counter-tricot-0.08", 0.194, 0.718, 6.88),
    ("counter-tricot-0.1", 0.193, 0.642, 6.88),
    ("counter-tricot-0.13", 0.190, 0.611, 6.88),
    ("locknit-0.08", 0.201, 0.785, 6.85),
    ("locknit-0.1", 0.198, 0.664, 6.85),
    ("reverse-locknit-0.08", 0.196, 0.718, 6.88),
    ("reverse-locknit-0.1", 0.194, 0.642, 6.88),
    ("sharkskin-0.08", 0.193, 0.718, 6.88),
    ("sharkskin-0.1", 0.192, 0.642, 6.88),
    ("satin-0.08", 0.192, 0.772, 6.85),
    ("satin-0.1", 0.191, 0.665, 6.85),
    ("queenscord-0.08", 0.150, 0.649, 6.76),
    ("queenscord-0.1", 0.159, 0.573, 6.76),
    ("parallel-tricot-0.08", 0.215, 0.718, 6.88),
    ("parallel-tricot-0.1", 0.148, 0.642, 6.88),
    ("plain-1.8", 1.000, 0.374, 2.00),
    ("plain-1.8-piece", 0.999, 0.240, 2.01),
    ("satin-8-1.3", 0.790, 0.205, 2.01),
];

#[test]
fn starts_are_as_they_are_listed() {
    let starts = starts();
    assert_eq!(starts.len(), LISTED.len());
    for (start, (name, clearance, bend, thickness)) in starts.iter().zip(LISTED) {
        assert_eq!(start.name, name);
        let report = check(start, &start.points());
        let diameter = 2.0 * start.yarns[0].radius;
        for (what, is, listed) in [
            ("clearance", report.clearance, clearance),
            ("bend", report.bend, bend),
            ("thickness", report.thickness / diameter, thickness),
        ] {
            assert!(
                (is - listed).abs() < if what == "thickness" { 0.006 } else { 0.0006 },
                "{name}: {what} {is}, listed {listed}: {report:?}"
            );
        }
        assert!(start.pinned.iter().all(|&(yarn, point)| point < start.yarns[yarn].points.len()), "{name}");
    }
}

#[test]
fn a_jitter_is_no_crossing() {
    for start in [jersey(), plain()] {
        let points = start.points();
        assert_eq!(linking(&start, &points, &points).change, 0.0);
        for size in [0.01, 0.1] {
            let found = linking(&start, &points, &noise(&points, size));
            assert!(found.change > 0.0 && found.change < 0.3, "{}: {found:?}", start.name);
        }
    }
}

fn jersey() -> Start {
    weft_knit("jersey", &Chart::new(&["kkk"; 3]), Gauge::new(5.0), Length::Held)
}

fn plain() -> Start {
    woven("plain", Weave { size: 4, step: 1, order: 2, pitch: 1.8 }, Length::Held)
}

#[test]
fn a_pulled_stitch_is_a_crossing() {
    let start = jersey();
    for loop_at in 0..9 {
        let (course, wale) = (loop_at / 3, loop_at % 3);
        let mut pulled = start.points();
        // The upper legs and the head of a loop move below the feet of the loop drawn through it.
        for point in &mut pulled[course][12 * wale + 4..12 * wale + 9] {
            point.y -= 0.6 * (point.y - 3.75 * course as f64);
        }
        for [before, after] in [[&start.points(), &pulled], [&pulled, &start.points()]] {
            let found = linking(&start, before, after);
            assert!(found.change > CROSSED, "{found:?}");
            assert!(found.at.unwrap().iter().any(|place| place.yarn == course), "{found:?}");
        }
    }
}

/// A tuck lies between the held loop and the loop that is drawn through both. A float behind the
/// held loop is free.
#[test]
fn tucks_and_held_loops_are_drawn_through_and_floats_are_not() {
    let course = 3.75;
    let tuck = weft_knit("tuck", &Chart::new(&["kkk", "ktk", "kkk"]), Gauge::new(5.0), Length::Held);
    // The second wale has a held loop with two more points, and a tuck with two fewer.
    for (yarn, upper) in [(0, 15..24), (1, 14..21)] {
        let mut pulled = tuck.points();
        for point in &mut pulled[yarn][upper] {
            point.y -= 0.6 * (point.y - course * yarn as f64);
        }
        let found = linking(&tuck, &tuck.points(), &pulled);
        assert!(found.change > CROSSED, "{yarn}: {found:?}");
        let yarns = found.at.unwrap().map(|place| place.yarn);
        assert_eq!((yarns[0].min(yarns[1]), yarns[0].max(yarns[1])), (yarn, 2), "{found:?}");
    }

    let miss = weft_knit("miss", &Chart::new(&["kkk", "kmk", "kkk"]), Gauge::new(5.0), Length::Held);
    for (back, crosses) in [(-2.0, false), (3.0, true)] {
        let mut moved = miss.points();
        moved[1][13..15].iter_mut().for_each(|point| point.z += back);
        let found = linking(&miss, &miss.points(), &moved);
        assert_eq!(found.change > CROSSED, crosses, "{found:?}");
    }
}

/// The moved loop hangs with its neighbour in the loop of the next course. The next loop on the
/// empty needle goes through nothing.
#[test]
fn lace_hangs_together() {
    let lace = weft_knit("lace", &Chart::new(&[">kk", "kkk", "kkk"]), Gauge::new(5.0), Length::Held);
    for (what, wale, back) in
        [("the moved loop", 0, DVec3::new(-5.0, 0.0, 1.0)), ("its neighbour", 1, DVec3::ZERO)]
    {
        let mut pulled = lace.points();
        for point in &mut pulled[0][12 * wale + 4..12 * wale + 9] {
            *point = DVec3 { y: 0.4 * point.y, ..*point + back };
        }
        let found = linking(&lace, &lace.points(), &pulled);
        assert!(found.change > CROSSED, "{what}: {found:?}");
        assert!(found.at.unwrap().iter().any(|place| place.yarn == 1), "{what}: {found:?}");
    }

    // The loop on the empty needle is an arch whose left foot can be lifted out of the cloth to the
    // face. The foot of a loop that goes through another one can't be lifted. The right foot of the
    // arch lies behind the moved loop.
    for (course, crosses) in [(1, false), (2, true)] {
        let mut lifted = lace.points();
        lifted[course][1..3].iter_mut().for_each(|foot| foot.z += 4.0);
        let found = linking(&lace, &lace.points(), &lifted);
        assert_eq!(found.change > CROSSED, crosses, "{course}: {found:?}");
    }
}

/// In every warp knit of the list whose yarn is 0.1 mm thick or more, a loop of each bar is drawn
/// through others.
#[test]
fn warp_loops_are_drawn_through() {
    let is_tested = |start: &Start| start.repeat == [4.0, 3.0] && start.yarns[0].radius > 0.045;
    let warp_knits: Vec<_> = starts().into_iter().filter(is_tested).collect();
    assert_eq!(warp_knits.len(), 14);
    for start in warp_knits {
        for bar in 0..start.yarns.len() / 4 {
            let mut pulled = start.points();
            let yarn = &mut pulled[4 * bar + 1];
            // The head of the second course, 1.6 courses of 0.75 mm above its foot.
            let is_head = |point: &DVec3| (point.y - 0.75 - 1.2).abs() < 1e-9;
            let head = yarn.iter().position(is_head).expect("a head");
            for point in &mut yarn[head - 2..=head + 2] {
                point.y -= 0.5 * (point.y - 0.75);
            }
            let found = linking(&start, &start.points(), &pulled);
            assert!(found.change > CROSSED, "{}, bar {bar}: {found:?}", start.name);
        }
    }
}

#[test]
fn a_flipped_end_is_a_crossing() {
    let start = plain();
    let crossings: Vec<_> = (0..16).filter(|point| start.yarns[1].points[*point].z == 0.5).collect();
    assert_eq!(crossings.len(), 2);
    for crossing in crossings {
        let mut flipped = start.points();
        for step in [15, 0, 1] {
            flipped[1][(crossing + step) % 16].z -= 2.0;
        }
        let found = linking(&start, &start.points(), &flipped);
        assert!(found.change > CROSSED, "{found:?}");
    }
}
