//! Settling with settings that the list of starts lacks. Results are measured by the surfaces of
//! meshes.

use std::ops::ControlFlow;
use std::sync::Arc;

use texere_conformance::rest::{Chart, Gauge, Length as Asked, Start, Weave, check, weft_knit, woven_piece};
use texere_contact::{Clearance, clearance};
use texere_core::settling::{Length, Rest, Settling, SettlingPlan, settle, settled};
use texere_core::{Backend, Boundary, ControlPoint, Ends, Settings, SettlingError, Yarn, Yarns};
use texere_cpu::ParallelBackend;

/// The yarns of a start with their boundary. Yarn number `yarn` has the half width and the half
/// height `halves(yarn)`, mm.
fn cloth(start: &Start, halves: impl Fn(usize) -> [f32; 2]) -> (Yarns, Boundary) {
    let mut yarns = Yarns::builder();
    for (number, yarn) in start.yarns.iter().enumerate() {
        let [width, height] = halves(number);
        let points = yarn.points.iter().map(|at| {
            ControlPoint::new(at.x as f32, at.y as f32, at.z as f32, width).flattened(width, height)
        });
        yarns.yarn(Yarn::default(), &points.collect::<Vec<_>>());
    }
    let yarns = yarns.build().expect("yarns");
    let ends = start.yarns.iter().map(|yarn| match yarn.ends {
        texere_conformance::rest::Ends::Repeats(shift) => Ends::Repeats(shift),
        texere_conformance::rest::Ends::Closed => Ends::Closed,
        texere_conformance::rest::Ends::Open => Ends::Open,
    });
    let repeat = start.repeat.map(|repeat| repeat as f32);
    let boundary = Boundary::new(yarns.layout(), repeat, ends.collect()).expect("a boundary");
    (yarns, boundary)
}

/// The result of settling, and the clearance of the surfaces.
fn at_rest(yarns: &Yarns, settling: &Settling<'_>) -> (Rest, Yarns, Clearance) {
    let plan = Arc::new(SettlingPlan::new(settling).expect("a plan"));
    let mut settler =
        ParallelBackend::open().expect("the CPU").settler(Arc::clone(&plan)).expect("a settler");
    let rest = settle(&plan, settler.as_mut(), |_, _| ControlFlow::Continue(())).expect("a settling");
    let points = settled(&plan, settler.as_mut(), yarns.points()).expect("points");
    let mut moved = yarns.clone();
    for (yarn, pair) in yarns.layout().offsets().windows(2).enumerate() {
        moved.set_points(yarn, &points[pair[0] as usize..pair[1] as usize]).expect("its points");
    }
    let found = clearance(&moved, &Settings::default()).expect("a clearance");
    (rest, moved, found)
}

const FREE: Length = Length::Free { tension: 0.0 };

/// A piece of plain weave of six ends and six picks, with this pitch in mm.
fn plain(pitch: f64) -> Start {
    woven_piece("plain", Weave { size: 6, step: 1, order: 2, pitch }, Asked::Free)
}

#[test]
fn flattened_yarns_come_to_rest() {
    let (yarns, boundary) = cloth(&plain(2.2), |_| [0.65, 0.52]);
    let before = clearance(&yarns, &Settings::default()).expect("a clearance").min;
    let (rest, _, found) = at_rest(&yarns, &Settling::new(&yarns).boundary(boundary).length(FREE));
    assert!(found.min >= 0.98 && found.min > before, "{rest:?}, {before} before, {}", found.min);
}

#[test]
fn yarns_of_two_thicknesses_come_to_rest() {
    let (yarns, boundary) = cloth(&plain(1.8), |yarn| if yarn < 6 { [0.6; 2] } else { [0.45; 2] });
    let before = clearance(&yarns, &Settings::default()).expect("a clearance").min;
    assert!(before < 0.98, "they pierce at the start: {before}");
    let (rest, _, found) = at_rest(&yarns, &Settling::new(&yarns).boundary(boundary).length(FREE));
    assert!(found.min >= 0.98, "{rest:?}, {}", found.min);
}

/// Splines of different tensions run differently between control points. Yarns may be clear with
/// one tension and not with another.
#[test]
fn yarns_rest_by_the_spline_that_they_are_drawn_with() {
    let (yarns, boundary) = cloth(&plain(1.9), |_| [0.52; 2]);
    let yarns = yarns.with_tension(0.4).expect("a tension");
    let settling = Settling::new(&yarns).boundary(boundary).length(FREE);
    let (rest, moved, found) = at_rest(&yarns, &settling);
    assert!(found.min >= 0.98, "{rest:?}, {}", found.min);
    let other = clearance(&moved.with_tension(0.0).expect("a tension"), &Settings::default())
        .expect("a clearance")
        .min;
    assert!((other - found.min).abs() > 1e-3, "{other} with either");
}

/// Tension draws in the yarn of a knit, and leaves its loops clear of one another.
#[test]
fn tension_draws_yarn_in() {
    let start = weft_knit("rib", &Chart::new(&["kpkp"; 4]), Gauge::new(5.0), Asked::Free);
    let radius = start.yarns[0].radius as f32;
    let (yarns, boundary) = cloth(&start, |_| [radius; 2]);
    let drawn = |tension| {
        let settling = Settling::new(&yarns).boundary(boundary.clone()).length(Length::Free { tension });
        let (rest, moved, _) = at_rest(&yarns, &settling);
        let mut points = moved.points().iter().map(|point| point.position().as_dvec3());
        let each = start.yarns.iter().map(|yarn| points.by_ref().take(yarn.points.len()).collect());
        let report = check(&start, &each.collect::<Vec<_>>());
        assert!(report.clearance >= 0.98, "{rest:?}, {report:?}");
        report.stretch
    };
    let (slack, taut) = (drawn(0.0), drawn(0.01));
    assert!(taut < slack - 0.01, "{taut} longer than at the start under tension, {slack} without");
}

#[test]
fn yarns_that_can_t_be_cut_into_intervals_or_chords_are_refused() {
    let mut yarns = Yarns::builder();
    yarns.yarn(Yarn::default(), &[0.0, 1.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
    let yarns = yarns.build().expect("yarns");
    let on = Boundary::new(yarns.layout(), [2.0, 0.0], vec![Ends::Repeats([1, 0])]).expect("a boundary");
    let refused = SettlingPlan::new(&Settling::new(&yarns).boundary(on)).err();
    assert_eq!(refused, Some(SettlingError::TooFewPoints { yarn: 0, points: 2, least: 3 }));

    let mut long = Yarns::builder();
    long.yarn(Yarn::default(), &[0.0, 100.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.01)));
    let long = long.build().expect("yarns");
    let refused = SettlingPlan::new(&Settling::new(&long)).err();
    let Some(SettlingError::LongInterval { yarn: 0, axis: 'x', chords, limit: 4096 }) = refused else {
        panic!("{refused:?}")
    };
    // 100 mm in chords of 0.6 times 0.02 mm.
    assert!((8_330..8_340).contains(&chords), "{chords}");
    // 40 mm from point to point are short enough, but not for this many points.
    let mut slack = Yarns::builder();
    let points: Vec<_> =
        (0..40).map(|point| ControlPoint::new(40.0 * point as f32, 0.0, 0.0, 0.01)).collect();
    slack.yarn(Yarn::default(), &points);
    let slack = slack.build().expect("yarns");
    let refused = SettlingPlan::new(&Settling::new(&slack)).err();
    let limit = (1 << 16) + 256 * 40;
    assert!(
        matches!(refused, Some(SettlingError::LongYarns { points: 40, limit: most, .. }) if most == limit)
    );
}
