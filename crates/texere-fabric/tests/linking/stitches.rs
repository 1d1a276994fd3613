//! Linking of knits: dropped stitches, pulled stitches, and knits that are only bent.

use texere_core::{Origin, Section};
use texere_fabric::{Shape, Thread};

use crate::cloths::{cloth, weave};
use crate::knits::{D, Knit, as_it_is, tricot};
use crate::{SEEN, compared, harmless, moved, pairs, stays_linked};

/// Tight and loose jerseys with 8 to 36 control points for each loop. Each comes with the factor by
/// which its control points are refined.
fn jerseys() -> Vec<(Knit, usize)> {
    let mut jerseys: Vec<_> = [3.6, 5.0, 8.0]
        .into_iter()
        .flat_map(|pitch| [1, 2, 3].map(|finer| (Knit::jersey(pitch, 5, 5), finer)))
        .collect();
    jerseys.extend(
        [5.0, 8.0].into_iter().flat_map(|p| [1, 2].map(|finer| (Knit::coarse_jersey(p, 5, 5), finer))),
    );
    jerseys
}

#[test]
fn jerseys_stay_linked() {
    for (knit, finer) in jerseys() {
        let name = format!("{knit:?}, {finer} times finer");
        stays_linked(&name, &knit.yarns(finer, as_it_is), D, 5.0 * knit.wale);
    }
    stays_linked("tricot", &tricot(4, 6, as_it_is), D, 8.0);
}

#[test]
fn what_keeps_apart_takes_no_integral() {
    let threads = [Thread::new(0.5, 0.1); 2];
    let weave = cloth(Shape::Round, weave("2/2"), threads, Section::Circle).yarns().unwrap();
    for yarns in [weave, Knit::jersey(5.0, 5, 5).yarns(1, as_it_is)] {
        for (change, mut to) in harmless(D, 5.0).into_iter().take(5) {
            assert_eq!(compared(&yarns, &moved(&yarns, |_, _, at| to(at))).compared, 0, "{change}");
        }
    }
}

#[test]
fn a_dropped_stitch_is_told() {
    for (knit, finer) in jerseys() {
        let before = knit.yarns(finer, as_it_is);
        let after = knit.yarns(finer, knit.dropped([2, 2]));
        let found = compared(&before, &after);
        assert_eq!(pairs(&found), [[2, 3]], "{knit:?}, {finer} times finer: {found:?}");
        assert!(found.largest > SEEN, "{knit:?}, {finer} times finer: {found:?}");
        let origins = found.worst[0].places.map(|place| before.layout().yarns()[place.yarn].origin);
        assert_eq!(origins, [Origin::Course(3), Origin::Course(4)]);
        let [x, y, _] = found.worst[0].places[0].position;
        assert!((x - 2.5 * f64::from(knit.wale)).abs() < f64::from(knit.wale) / 2.0, "{found:?}");
        assert!((y - 3.76 * f64::from(knit.course)).abs() < f64::from(knit.course), "{found:?}");
    }
}

#[test]
fn a_pulled_stitch_is_told() {
    for (knit, finer) in jerseys() {
        let before = knit.yarns(finer, as_it_is);
        let after = knit.yarns(finer, knit.pulled([2, 2]));
        let found = compared(&before, &after);
        // The loop has left the loop below, the loop above, or both.
        let pairs = pairs(&found);
        assert!(!pairs.is_empty(), "{knit:?}, {finer} times finer: {found:?}");
        assert!(pairs.iter().all(|pair| [[1, 2], [2, 3]].contains(pair)), "{knit:?}, {finer}: {found:?}");
        assert!(found.largest > SEEN, "{knit:?}, {finer} times finer: {found:?}");
    }
}

#[test]
fn stitches_of_warp_knits_are_told() {
    let before = tricot(4, 6, as_it_is);
    let dropped = tricot(4, 6, |place, point, [x, y, z]| {
        [x, y, if place == [1, 2] && point.abs_diff(4) <= 1 { z + 2.4 * D } else { z }]
    });
    let pulled = tricot(4, 6, |place, point, [x, y, z]| {
        if place == [1, 2] && (1..8).contains(&point) { [x, 0.1 * y, -2.0 * D] } else { [x, y, z] }
    });
    for after in [dropped, pulled] {
        let found = compared(&before, &after);
        assert!(pairs(&found).iter().any(|pair| pair.contains(&1)), "{found:?}");
        assert!(found.largest > SEEN, "{found:?}");
    }
}

#[test]
fn cloth_that_turns_over_in_its_plane_stays_linked() {
    // On the straight way to their new positions all yarns pass through one line, so that every
    // integral is worked out.
    let threads = [Thread::new(0.5, 0.1); 2];
    let weave = cloth(Shape::Round, weave("2/2"), threads, Section::Circle).yarns().unwrap();
    for yarns in [weave, Knit::jersey(5.0, 4, 4).yarns(1, as_it_is), tricot(3, 4, as_it_is)] {
        let found = compared(&yarns, &moved(&yarns, |_, _, [x, y, z]| [-x, -y, z]));
        assert_eq!(pairs(&found), [] as [[usize; 2]; 0], "{found:?}");
        assert!(found.compared > 0 && found.largest < 1e-3, "{found:?}");
    }
}
