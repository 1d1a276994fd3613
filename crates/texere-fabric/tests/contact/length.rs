//! Lengths of yarns against closed forms and against sums of chords.

use std::f64::consts::TAU;

use texere_contact::{length_mm, lengths_mm};
use texere_core::definitions::Segment;
use texere_core::{ControlPoint, Material, Section, Yarn, Yarns};
use texere_fabric::{Thread, Weave, Woven};

fn one_yarn(closed: bool, points: &[ControlPoint]) -> Yarns {
    let mut yarns = Yarns::builder();
    yarns.yarn(Yarn { closed, ..Yarn::default() }, points);
    yarns.build().unwrap()
}

#[test]
fn a_straight_yarn_is_as_long_as_its_ends_are_apart() {
    // Points are unevenly spaced in the direction (2, 3, 6) / 7, far from the origin.
    let points = [0.0f32, 7.0, 21.0, 35.0, 42.0, 70.0]
        .map(|at| ControlPoint::new(1024.0 + at / 7.0 * 2.0, at / 7.0 * 3.0, at / 7.0 * 6.0, 0.1));
    for tension in [0.0, 0.5, 0.9] {
        let length = length_mm(&one_yarn(false, &points).with_tension(tension).unwrap());
        assert!((length - 70.0).abs() < 1e-9, "tension {tension}: {length}");
    }
}

#[test]
fn a_dense_circle_is_tau_radii_long() {
    // The spline through n points of a circle is off by O(n⁻⁴). Coordinates are rounded to 6e-8 of
    // the radius.
    let circle = |count: usize| -> Vec<_> {
        let angle = |k: usize| TAU * k as f64 / count as f64;
        (0..count)
            .map(|k| {
                ControlPoint::new((5.0 * angle(k).cos()) as f32, (5.0 * angle(k).sin()) as f32, 1.0, 0.1)
            })
            .collect()
    };
    for (count, within) in [(16, 1e-3), (64, 1e-5), (256, 3e-7)] {
        let length = length_mm(&one_yarn(true, &circle(count)));
        assert!((length / (5.0 * TAU) - 1.0).abs() < within, "{count} points: {length}");
    }
}

#[test]
fn a_square_yarn_has_the_length_of_its_chords() {
    // Corners bend sharply within an interval, where an integration rule of few points is least
    // exact. The yarns are open and closed, with two tensions.
    let corners = [[0.0, 0.0, 0.0], [4.0, 0.0, 1.0], [4.0, 4.0, 0.0], [0.0, 4.0, 1.0], [1.0, 1.0, 2.0]]
        .map(|[x, y, z]| ControlPoint::new(x, y, z, 0.1));
    for (closed, tension) in [(false, 0.0f32), (true, 0.0), (false, 0.4), (true, 0.4)] {
        let mut padded = corners.to_vec();
        if closed {
            padded.insert(0, corners[4]);
            padded.extend(&corners[..2]);
        } else {
            padded.insert(0, corners[0].reflected(&corners[1]));
            padded.push(corners[4].reflected(&corners[3]));
        }
        let mut chords = 0.0;
        for window in padded.windows(4) {
            let segment = Segment::new(window.try_into().unwrap(), (1.0 - tension) / 2.0);
            let at = |k: u32| segment.sample(k as f32 / 512.0).offset.as_dvec3();
            chords += (0..512).map(|k| at(k).distance(at(k + 1))).sum::<f64>();
        }
        let length = length_mm(&one_yarn(closed, &corners).with_tension(tension).unwrap());
        assert!(
            (length / chords - 1.0).abs() < 1e-5,
            "closed {closed}, tension {tension}: {length}, {chords}"
        );
    }
}

#[test]
fn crimp_lengthens_the_yarns_of_a_cloth() {
    let thread = Thread::new(0.5, 0.1);
    let drawdown = Weave::parse("plain").unwrap().drawdown(60, 40).unwrap();
    let cloth = Woven::new(
        drawdown,
        vec![thread; 60],
        vec![thread; 40],
        vec![Material::default()],
        vec![Section::Circle],
    )
    .unwrap();
    let yarns = cloth.yarns().unwrap();
    let lengths = lengths_mm(&yarns);
    assert_eq!(lengths.len(), 100);
    assert!((lengths.iter().sum::<f64>() / length_mm(&yarns) - 1.0).abs() < 1e-12);
    // Peirce's approximation h = 4/3 p √c gives the crimp c from the height h of the crimp wave and
    // the pitch p. h is the distance between the centrelines on the two sides, here one diameter.
    let peirce = (0.75f64 * 0.2 / 0.5).powi(2);
    let (warp, weft) = lengths.split_at(60);
    let ends = warp.iter().map(|length| (length, 20.0));
    for (length, cloth_length) in ends.chain(weft.iter().map(|length| (length, 30.0))) {
        let crimp = length / cloth_length - 1.0;
        assert!((crimp / peirce - 1.0).abs() < 0.25, "crimp {crimp}, by Peirce {peirce}");
    }
}

#[test]
fn a_yarn_of_many_intervals_adds_up_over_tasks() {
    // All intervals of a zigzag are alike, except the first and the last. Each further interval
    // adds the same length.
    let zigzag = |count: usize| -> Vec<_> {
        (0..count).map(|k| ControlPoint::new(k as f32, (k % 2) as f32, 0.0, 0.1)).collect()
    };
    let length = |count| length_mm(&one_yarn(false, &zigzag(count)));
    let one = length(102) - length(101);
    assert!((length(10_001) - length(101) - 9900.0 * one).abs() < 1e-6);
}
