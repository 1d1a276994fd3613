//! The place on a yarn that is nearest to a point.

use glam::DVec3;
use proptest::prelude::*;
use texere_core::{ControlPoint, Yarn, YarnPlace, Yarns};

/// Two yarns, of which the second goes through `points`.
fn yarns(points: &[[f32; 3]], closed: bool) -> Yarns {
    let control = |points: &[[f32; 3]]| -> Vec<_> {
        points.iter().map(|[x, y, z]| ControlPoint::new(*x, *y, *z, 0.1)).collect()
    };
    let mut yarns = Yarns::builder();
    yarns.yarn(Yarn::default(), &control(&[[0.0; 3], [1.0; 3]]));
    yarns.yarn(Yarn { closed, ..Yarn::default() }, &control(points));
    yarns.build().unwrap()
}

proptest! {
    /// No point of the straight lines between control points is nearer than the place that is
    /// found.
    #[test]
    fn no_place_is_nearer(
        points in prop::collection::vec(prop::array::uniform3(-9.0f32..9.0), 3..9),
        wanted in prop::array::uniform3(-12.0f64..12.0),
        closed: bool,
    ) {
        let place = YarnPlace::nearest(&yarns(&points, closed), 1, wanted).unwrap();
        let at = |number: usize| DVec3::from(points[number % points.len()].map(f64::from));
        let off = |interval: usize, t: f64| {
            at(interval).lerp(at(interval + 1), t).distance(DVec3::from(wanted))
        };
        let found = off(place.interval, place.t);
        for interval in 0..points.len() - usize::from(!closed) {
            for step in 0..=50 {
                let other = off(interval, f64::from(step) / 50.0);
                prop_assert!(found <= other + 1e-9, "{place:?} is {found} off, {other} is at {interval} {step}");
            }
        }
    }
}

#[test]
fn a_place_is_found_where_points_coincide_and_none_on_a_yarn_that_is_not_there() {
    let yarns = yarns(&[[1.0; 3], [1.0; 3], [2.0; 3]], false);
    let place = YarnPlace::nearest(&yarns, 1, [1.5; 3]).unwrap();
    assert_eq!((place.interval, place.t), (1, 0.5));
    assert!(YarnPlace::nearest(&yarns, 2, [0.0; 3]).is_none());
}
