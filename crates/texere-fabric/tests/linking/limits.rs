//! Refusals, the most work that linking takes, and results that depend neither on the number of
//! processor threads nor on the size of the cloth.

use std::ops::ControlFlow;

use proptest::prelude::*;
use texere_contact::{ContactError, linking, linking_with_progress};
use texere_core::{Boundary, BoundaryError, ControlPoint, Ends, Yarn, YarnError, Yarns};

use crate::knits::{D, Knit, as_it_is};
use crate::{compared, moved, noise, yarns_of};

#[test]
fn the_same_is_found_whatever_the_threads() {
    let knit = Knit::jersey(5.0, 12, 12);
    let before = knit.yarns(1, as_it_is);
    let mut noise = noise(11);
    let after = moved(&before, |_, _, at| at.map(|each| each + 0.8 * D * noise()));
    let [alone, together] = [1, 4].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| compared(&before, &after))
    });
    assert!(alone.passages > 100, "{alone:?}");
    assert_eq!(alone, together);
}

#[test]
fn work_is_bounded_and_told_and_can_be_stopped() {
    // Fifteen hundred intervals lie in one place, and all of them move.
    let line = |sign: f32| {
        let point =
            |k: u32| [sign * (k % 7) as f32, sign * (k % 5) as f32, (k % 3) as f32].map(|each| each * 1e-3);
        yarns_of(&[(false, (0..1500).map(point).collect())], 0.1)
    };
    let (before, after) = (line(1.0), line(-1.0));
    let boundary = Boundary::without_repeat(before.layout());
    let shares = std::sync::Mutex::new(Vec::new());
    let found = linking_with_progress(&before, &after, &boundary, |share| {
        shares.lock().unwrap().push(share);
        ControlFlow::Continue(())
    });
    assert!(found.unwrap().left_out > 0);
    let shares = shares.into_inner().unwrap();
    assert!(shares.len() > 5 && shares.last() == Some(&1.0) && shares.is_sorted(), "{shares:?}");
    let mut calls = 0;
    let stopped = linking_with_progress(&before, &after, &boundary, |_| {
        calls += 1;
        if calls < 3 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    assert_eq!((stopped, calls), (Err(ContactError::Cancelled), 3));
}

#[test]
fn other_yarns_and_other_boundaries_are_refused() {
    let knit = Knit::jersey(5.0, 3, 3);
    let before = knit.yarns(1, as_it_is);
    let boundary = Boundary::without_repeat(before.layout());
    let refused = |after: &Yarns, boundary: &Boundary| linking(&before, after, boundary).unwrap_err();
    assert_eq!(refused(&knit.yarns(2, as_it_is), &boundary), ContactError::OtherLayout { yarn: 0 });
    let fewer = Knit::jersey(5.0, 3, 2).yarns(1, as_it_is);
    assert_eq!(refused(&fewer, &boundary), ContactError::OtherLayout { yarn: 2 });
    let other = Boundary::without_repeat(fewer.layout());
    assert_eq!(
        refused(&before, &other),
        ContactError::Boundary(BoundaryError::EndsCount { ends: 2, yarns: 3 })
    );
    let taut = before.clone().with_tension(0.3).unwrap();
    let other = YarnError::OtherTension { given: 0.3, tension: 0.0 };
    assert_eq!(refused(&taut, &boundary), ContactError::Yarns(other));
    // All copies of a repeat of a millionth of a millimetre would lie in one place.
    let tiny = Boundary::new(before.layout(), [1e-6; 2], vec![Ends::Repeats([1, 0]); 3]).unwrap();
    let after = moved(&before, |yarn, _, [x, y, z]| [x, y, z + yarn as f32]);
    assert!(matches!(refused(&after, &tiny), ContactError::LinkingSize { .. }));
}

#[test]
fn far_from_the_origin_and_in_tiny_yarns_nothing_overflows() {
    for (scale, shift) in [(1e-3, 0.0), (1.0, 1e6), (1.0, 1e9), (1e3, -9e8)] {
        let place = |[x, y, z]: [f32; 3]| [x * scale + shift, y * scale, z * scale - shift];
        let lines = |z: f32| {
            let line = [-4.0, -2.0, 0.0, 2.0, 4.0];
            let lines = [line.map(|x| place([x, 0.0, 0.0])), line.map(|y| place([0.5, y, z]))];
            yarns_of(&lines.map(|line| (false, line.to_vec())), 0.25 * scale)
        };
        let found = compared(&lines(0.5), &lines(-0.5));
        assert!(
            found.largest.is_finite() && (shift != 0.0 || found.passages > 0),
            "{scale}, {shift}: {found:?}"
        );
    }
}

/// Numbers at the limits that yarns allow, and between them.
fn extreme() -> impl Strategy<Value = f32> {
    prop_oneof![Just(0.0f32), Just(1e9), Just(-1e9), Just(1e-6), -1.0..1.0f32, -1.0..1.0f32, -1e6..1e6f32]
}

fn places() -> impl Strategy<Value = Vec<[f32; 4]>> {
    let half = prop_oneof![Just(1e-4f32), Just(3e4), 0.0078125..1.0f32];
    prop::collection::vec(
        (extreme(), extreme(), extreme(), half).prop_map(|(x, y, z, r)| [x, y, z, r]),
        3..20,
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn any_shapes_of_any_yarns_end(
        each in prop::collection::vec((0..4_u8, places(), places()), 1..6),
        repeat in prop::array::uniform2(prop_oneof![Just(1e-6f32), Just(1e9), 0.125..3.0f32]),
    ) {
        let [before, after] = [false, true].map(|after| {
            let mut yarns = Yarns::builder();
            for (kind, one, other) in &each {
                let places = one.iter().zip(other.iter().cycle()).map(|(one, other)| if after { other } else { one });
                let points: Vec<_> = places.map(|[x, y, z, r]| ControlPoint::new(*x, *y, *z, *r)).collect();
                yarns.yarn(Yarn { closed: *kind == 1, ..Yarn::default() }, &points);
            }
            yarns.build().unwrap()
        });
        let ends = each.iter().map(|(kind, ..)| match kind {
            0 => Ends::Open,
            1 => Ends::Closed,
            2 => Ends::Repeats([1, 0]),
            _ => Ends::Repeats([-3, 2]),
        });
        let boundary = Boundary::new(before.layout(), repeat, ends.collect()).unwrap();
        match linking(&before, &after, &boundary) {
            Ok(found) => prop_assert!(found.largest.is_finite() && found.worst.len() as u64 <= found.passages),
            Err(error) => prop_assert!(matches!(error, ContactError::LinkingSize { .. }), "{error}"),
        }
    }
}
