//! The work of the clearance report is counted, grows with the number of control points, and is
//! bounded for any yarns. Places with far too much yarn are reported as crowds.

use std::f32::consts::TAU;
use std::ops::ControlFlow;

use proptest::prelude::*;
use texere_contact::{
    CLEARANCE_BESIDE, CLEARANCE_PAIRS, Clearance, ContactError, clearance, clearance_with_progress,
};
use texere_core::{ControlPoint, Section, Settings, Yarn, Yarns};
use texere_fabric::{Shape, Thread};

use crate::cloths::{cloth, weave, weaves};
use crate::oracle::round_clearance;

/// The most pairs of control intervals that are compared for each control point, in cloth whose
/// yarns are clear of one another. A small cloth takes the most, because all of it lies in one cell
/// of the search's grid.
const SANE: u64 = 128;

/// Plain cloth of `size` ends and picks, 0.75 mm apart.
fn plain(shape: Shape, size: usize, diameter: f32) -> Yarns {
    let up = weave("plain");
    let drawdown =
        texere_fabric::Drawdown::from_fn(size, size, |end, pick| up.up(end % 2, pick % 2)).unwrap();
    cloth(shape, drawdown, [Thread::new(0.75, diameter / 2.0); 2], Section::Circle).yarns().unwrap()
}

fn yarns(each: impl IntoIterator<Item = (bool, Vec<[f32; 4]>)>) -> Yarns {
    let mut yarns = Yarns::builder();
    for (closed, points) in each {
        let points: Vec<_> = points.iter().map(|[x, y, z, r]| ControlPoint::new(*x, *y, *z, *r)).collect();
        yarns.yarn(Yarn { closed, ..Yarn::default() }, &points);
    }
    yarns.build().unwrap()
}

/// The clearance of `yarns`. Checks that its work is bounded and that its numbers are finite.
fn bounded(yarns: &Yarns) -> Clearance {
    let found = clearance(yarns, &Settings::default()).unwrap();
    let limit = CLEARANCE_PAIRS * yarns.points().len() as u64;
    assert!(found.pairs <= limit, "{} pairs, more than {limit}", found.pairs);
    assert!(found.min >= 0.0 && found.curvature_min >= 0.0, "{found:?}");
    assert!(found.crowd.is_none_or(|crowd| crowd.fill >= 0.0), "{found:?}");
    found
}

#[test]
fn clear_cloth_takes_few_pairs_and_is_no_crowd() {
    for (name, drawdown) in weaves() {
        for shape in [Shape::Round, Shape::Crossing] {
            // Pitches from a little more than the least pitch on.
            for pitch in [1.8, 2.5, 4.0, 6.0] {
                let threads = [Thread::new(pitch * 0.2, 0.1); 2];
                let yarns = cloth(shape, drawdown.clone(), threads, Section::Circle).yarns().unwrap();
                let found = bounded(&yarns);
                assert_eq!(found.crowd, None, "{name}");
                let each = found.pairs / yarns.points().len() as u64;
                assert!(each < SANE, "{name} at {pitch} diameters: {each} pairs a control point");
            }
        }
    }
}

#[test]
fn work_grows_with_the_cloth_however_thick_its_yarns() {
    for diameter in [0.25, 0.75, 1.0, 1.5, 3.0, 25.0, 1000.0] {
        let [small, large] = [40, 80].map(|size| {
            let yarns = plain(Shape::Round, size, diameter);
            (bounded(&yarns), yarns.points().len() as u64)
        });
        let each = large.0.pairs / large.1;
        assert!(each < 2 * SANE, "{diameter} mm: {each} pairs a control point");
        // Four times the cloth takes a little over four times the work, because it has less edge.
        assert!(
            large.0.pairs < 6 * small.0.pairs.max(large.1),
            "{diameter} mm: {} and {}",
            small.0.pairs,
            large.0.pairs
        );
    }
}

#[test]
fn yarns_thicker_than_several_pitches_are_told_with_place_and_thickness() {
    for shape in [Shape::Round, Shape::Crossing] {
        // Threads twice and four times as thick as the pitch, and far thicker.
        for diameter in [1.5f32, 3.0, 1000.0] {
            let yarns = plain(shape, 24, diameter);
            let found = bounded(&yarns);
            let crowd = found.crowd.unwrap_or_else(|| panic!("{diameter} mm is no crowd"));
            assert!(crowd.fill > 1.0 && crowd.intervals > 256, "{crowd:?}");
            assert!((crowd.thickness_mm / f64::from(diameter) - 1.0).abs() < 1e-6, "{crowd:?}");
            let points = yarns.yarn_points(crowd.place.yarn).unwrap();
            let place = points[crowd.place.interval].position().as_dvec3().to_array();
            assert_eq!(crowd.place.position, place);
            assert!(crowd.place.source.is_some());
            // More yarn in the same room gives a lower ratio.
            assert!(found.min <= crowd.fill.sqrt().recip());
        }
    }
}

#[test]
fn a_crowd_is_nearer_somewhere_than_its_fill_says() {
    for diameter in [1.4, 1.8, 2.5, 6.0] {
        let yarns = plain(Shape::Crossing, 14, diameter);
        let found = bounded(&yarns);
        let crowd = found.crowd.unwrap();
        let brute = round_clearance(&yarns, 12);
        assert!(brute < crowd.fill.sqrt().recip(), "{diameter} mm: {brute}, but {crowd:?}");
    }
}

#[test]
fn one_crowd_does_not_hide_the_rest() {
    let yarn = |x: f32, y: f32, along: [f32; 2]| {
        let at = |t: f32| [x + along[0] * t, y + along[1] * t, 0.0, 0.125];
        (false, (0..4).map(|k| at(k as f32)).collect::<Vec<_>>())
    };
    // A hundred yarns lie in one place, and far away two yarns whose ratio is three quarters.
    let crowded = (0..100).map(|k| yarn(0.0, 0.001 * k as f32, [0.1, 0.0]));
    let pair = [yarn(50.0, 50.0, [1.0, 0.0]), yarn(50.0, 50.1875, [1.0, 0.0])];
    let found = bounded(&yarns(crowded.chain(pair)));
    assert!(found.crowd.is_some_and(|crowd| crowd.place.yarn < 100 && crowd.fill > 1.0), "{found:?}");
    assert!((found.worst[0].ratio - 0.75).abs() < 1e-4, "{:?}", found.worst[0]);
    assert_eq!(found.worst[0].places.map(|place| place.yarn), [100, 101]);
}

#[test]
fn a_fine_cloth_within_a_coarse_one_is_measured_like_each_of_them() {
    let scaled = |size: usize, scale: f32| -> Vec<(bool, Vec<[f32; 4]>)> {
        let yarns = plain(Shape::Round, size, 0.25);
        let whole =
            |point: &ControlPoint| [point.x, point.y, point.z, point.half_width()].map(|each| each * scale);
        let points = |yarn| (false, yarns.yarn_points(yarn).unwrap().iter().map(whole).collect());
        (0..yarns.layout().yarns().len()).map(points).collect()
    };
    let (fine, coarse) = (scaled(60, 1e-3), scaled(30, 1.0));
    // The fine cloth lies between the threads of the coarse one.
    let moved = |(closed, points): &(bool, Vec<[f32; 4]>)| {
        (*closed, points.iter().map(|[x, y, z, r]| [x + 0.75 - 0.02, y + 0.75 - 0.02, *z, *r]).collect())
    };
    let fine: Vec<_> = fine.iter().map(moved).collect();
    let alone = [&fine, &coarse].map(|each| bounded(&yarns(each.iter().cloned())));
    let both = bounded(&yarns(fine.iter().chain(&coarse).cloned()));
    assert_eq!(both.crowd, None);
    assert_eq!(both.contacts, alone[0].contacts + alone[1].contacts);
    assert!((both.min - alone[0].min.min(alone[1].min)).abs() < 1e-9);
}

#[test]
fn straight_yarns_of_two_points_meet_as_often_as_they_cross() {
    // A layer of 700 threads lies on a layer of 800. Each crossing is a contact, and no thread is
    // near the thread beside it.
    let wefts = (0..700).map(|k| (false, vec![[0.0, k as f32, 0.0, 0.125], [800.0, k as f32, 0.0, 0.125]]));
    let warps =
        (0..800).map(|k| (false, vec![[k as f32, 0.0, 0.2375, 0.125], [k as f32, 700.0, 0.2375, 0.125]]));
    let found = bounded(&yarns(wefts.chain(warps)));
    assert_eq!((found.crowd, found.contacts), (None, 700 * 800));
    assert!((found.min - 0.95).abs() < 1e-6);
    // More threads lie side by side than a thread is compared with. They are a crowd, too.
    let many = (0..2 * CLEARANCE_BESIDE).map(|k| {
        let at = k as f32 * 0.01;
        (false, vec![[at, at, at, 0.001], [at + 99.0, at + 100.0, at + 101.0, 0.001]])
    });
    let found = bounded(&yarns(many));
    assert!(found.crowd.is_some_and(|crowd| crowd.fill < 1.0), "{:?}", found.crowd);
}

#[test]
fn a_yarn_coiled_on_itself_ends() {
    // 100,000 turns in one place, of a usual yarn and of the thinnest possible one.
    for radius in [0.1, 1e-4] {
        let turn = |k: usize| ((k as f32 * TAU / 8.0).cos(), (k as f32 * TAU / 8.0).sin());
        let coil = (0..800_000).map(|k| (turn(k % 8).0, turn(k % 8).1)).map(|(x, y)| [x, y, 0.0, radius]);
        let found = bounded(&yarns([(false, coil.collect())]));
        assert!(found.crowd.is_some(), "{found:?}");
    }
}

#[test]
fn points_in_one_place_end() {
    // Too many points lie in one place for a walk along the yarn from each point to each other one,
    // and 500 more lie in lines beside them.
    for count in [200, 300, 1000, 1500, 200_000] {
        let still = std::iter::repeat_n([1.0, 1.0, 1.0, 0.1], count);
        let beside = (0..250).map(|k| [1.0 + 1e-3 * k as f32, 1.0, 1.0, 0.1]);
        let around = (0..250).map(|k| [1.0, 1.0 + 1e-3 * k as f32, 1.0, 0.1]);
        for closed in [false, true] {
            bounded(&yarns([(closed, beside.clone().chain(still.clone()).chain(around.clone()).collect())]));
        }
    }
}

#[test]
fn progress_is_told_and_heard() {
    let yarns = plain(Shape::Round, 60, 0.25);
    let mut told = vec![0.0];
    let found = clearance_with_progress(&yarns, &Settings::default(), |done| {
        told.push(done);
        ControlFlow::Continue(())
    })
    .unwrap();
    assert_eq!(found, clearance(&yarns, &Settings::default()).unwrap());
    assert!(told.is_sorted() && told.len() > 10 && told.last() == Some(&1.0), "{told:?}");
    // Progress comes in small steps, because a user would otherwise believe that the program hangs.
    assert!(told.windows(2).all(|pair| pair[1] - pair[0] < 0.3), "{told:?}");
    let mut last = 0.0;
    let stopped = clearance_with_progress(&yarns, &Settings::default(), |done| {
        last = done;
        if done > 0.3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert_eq!(stopped, Err(ContactError::Cancelled));
    assert!(last < 0.7, "{last}");
}

/// Numbers at the limits that yarns allow, and between them.
fn extreme() -> impl Strategy<Value = f32> {
    prop_oneof![Just(0.0f32), Just(1e9), Just(-1e9), Just(1e-6), -1.0..1.0f32, -1e6..1e6f32]
}

fn thick() -> impl Strategy<Value = f32> {
    prop_oneof![Just(1e-4f32), Just(3e4), 0.0078125..1.0f32]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn any_yarns_end(each in prop::collection::vec(
        (any::<bool>(), prop::collection::vec(([extreme(), extreme(), extreme()], thick()), 3..6), 1..150usize),
        1..4,
    )) {
        // Many copies of each yarn in the same place.
        let each = each.into_iter().flat_map(|(closed, points, times)| {
            let points: Vec<_> = points.into_iter().map(|([x, y, z], r)| [x, y, z, r]).collect();
            std::iter::repeat_n((closed, points), times)
        });
        bounded(&yarns(each));
    }

}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(10))]

    #[test]
    fn what_is_swept_is_what_is_compared_pair_by_pair(
        ends in prop::collection::vec([[0.0..10.0f32, 0.0..10.0f32, 0.0..10.0f32], [0.0..10.0f32, 0.0..10.0f32, 0.0..10.0f32]], 300..400),
    ) {
        let found = bounded(&straight(&ends));
        prop_assert_eq!(found.crowd, None);
        let mut contacts = 0;
        let mut least = f64::INFINITY;
        for (number, one) in ends.iter().enumerate() {
            for other in &ends[..number] {
                let ratio = segments_apart(one, other) / touching();
                prop_assume!((ratio - 1.1).abs() > 1e-4);
                contacts += u64::from(ratio < 1.1);
                least = least.min(ratio);
            }
        }
        prop_assert_eq!(found.contacts, contacts);
        prop_assert!((found.min - least).abs() < 1e-4 || least > 1.1, "{} but {least}", found.min);
    }
}

/// Two lines 1.10019 times 0.04 mm apart. The distance is 1.09995 times two radii of 0.02 mm, once
/// these are rounded to half floats.
#[test]
fn a_radius_counts_as_the_points_hold_it() {
    let pair = [
        [[7.736433, 1.4837996, 3.1835973], [8.196987, 7.347082, 5.476392]],
        [[6.670672, 0.5881269, 4.740809], [9.216752, 5.974591, 2.9803324]],
    ];
    let apart = segments_apart(&pair[0], &pair[1]);
    assert!(apart > 1.1 * 0.04 && apart < 1.1 * touching(), "{apart}");
    let found = bounded(&straight(&pair));
    assert_eq!(found.contacts, 1);
    assert!((found.min - apart / touching()).abs() < 1e-5, "{}", found.min);
}

/// Thin straight yarns, whose contacts lie where their middle lines are nearest.
fn straight(ends: &[[[f32; 3]; 2]]) -> Yarns {
    yarns(ends.iter().map(|ends| (false, ends.iter().map(|[x, y, z]| [*x, *y, *z, THIN]).collect())))
}

/// The radius of [`straight`] yarns, mm. Points round it to a half float, which changes it by 2
/// parts in 10,000.
const THIN: f32 = 0.02;

/// Distance between the middle lines of two touching [`straight`] yarns, mm, by the radii that
/// points have after rounding.
fn touching() -> f64 {
    2.0 * f64::from(ControlPoint::new(0.0, 0.0, 0.0, THIN).half_width())
}

/// Least distance between two straight lines of finite length. The distance is convex along one of
/// the lines, so that a search by thirds gives its minimum.
fn segments_apart(one: &[[f32; 3]; 2], other: &[[f32; 3]; 2]) -> f64 {
    let [a, b] = one.map(|point| glam::Vec3::from(point).as_dvec3());
    let [p, q] = other.map(|point| glam::Vec3::from(point).as_dvec3());
    let apart = |t: f64| {
        let place = a.lerp(b, t);
        let along = ((place - p).dot(q - p) / (q - p).length_squared()).clamp(0.0, 1.0);
        place.distance(p.lerp(q, along))
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..40 {
        let (left, right) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if apart(left) < apart(right) { high = right } else { low = left }
    }
    apart((low + high) / 2.0)
}
