//! Linking in repeats, whose yarns come near copies of their neighbours and go on beyond the edge.

use texere_contact::{LINKING_CHANGE, Linking, linking};
use texere_core::{Boundary, Ends, Yarns};

use crate::knits::{D, Knit, as_it_is};
use crate::{HARMLESS, SEEN, moved, noise, pairs, yarns_of};

/// The linking of a jersey's repeat of 4 wales and `courses` courses after the movement `to`. If
/// `above` is set, the jersey repeats along y, too.
fn repeated(courses: usize, above: bool, to: impl FnOnce(&Knit) -> Yarns) -> Linking {
    let knit = Knit::jersey(5.0, 4, courses);
    let before = knit.repeat(as_it_is);
    let height = if above { courses as f32 * knit.course } else { 0.0 };
    let ends = vec![Ends::Repeats([1, 0]); courses];
    let boundary = Boundary::new(before.layout(), [4.0 * knit.wale, height], ends).unwrap();
    linking(&before, &to(&knit), &boundary).unwrap()
}

#[test]
fn yarns_meet_over_the_edge_of_a_repeat() {
    // Loops of the last course are held by loops of the first course's copy above.
    let dropped = |knit: &Knit| knit.repeat(knit.dropped([2, 1]));
    let found = repeated(3, true, dropped);
    assert_eq!(pairs(&found), [[0, 2]], "{found:?}");
    assert!(found.largest > SEEN, "{found:?}");
    // Both places lie beside one another, the second one in the right copy of its yarn.
    let [one, other] = found.worst[0].places.map(|place| place.position);
    assert!((0..3).all(|axis| (one[axis] - other[axis]).abs() < 0.5), "{found:?}");
    assert_eq!(pairs(&repeated(3, false, dropped)), [] as [[usize; 2]; 0]);

    // The loops of a repeat of one course are held by a copy of the same course.
    assert_eq!(pairs(&repeated(1, true, |knit| knit.repeat(knit.dropped([0, 2])))), [[0, 0]]);
    assert_eq!(pairs(&repeated(1, true, |knit| knit.repeat(knit.pulled([0, 2])))), [[0, 0]]);

    // Windows of loops beside the left or the right edge go on in the next round of the yarn.
    for wale in [0, 3] {
        let found = repeated(3, true, |knit| knit.repeat(knit.dropped([0, wale])));
        assert_eq!(pairs(&found), [[0, 1]], "{found:?}");
        assert!(found.largest > SEEN, "{found:?}");
        let alone = repeated(3, true, |knit| knit.repeat(knit.dropped([0, 1])));
        assert!((found.largest - alone.largest).abs() < 1e-3, "{found:?}, {alone:?}");
        assert_eq!(found.passages, alone.passages, "{found:?}, {alone:?}");
    }
}

#[test]
fn a_repeat_that_is_moved_across_its_own_edge_stays_linked() {
    for courses in [1, 2, 3] {
        for [x, y] in [[0.0, 0.0], [0.7, 0.4], [5.0, -3.0], [-0.31, 11.0]] {
            let found = repeated(courses, true, |knit| {
                moved(&knit.repeat(as_it_is), |_, _, at| [at[0] + x, at[1] + y, at[2]])
            });
            assert_eq!((found.passages, found.left_out), (0, 0), "{found:?}");
            let mut noise = noise(3);
            let found = repeated(courses, true, |knit| {
                moved(&knit.repeat(as_it_is), |_, _, at| at.map(|each| each + 0.1 * D * noise()))
            });
            assert!(found.largest < HARMLESS, "{found:?}");
        }
    }
}

#[test]
fn each_passage_counts_once_wherever_the_edge_lies() {
    let knit = Knit::jersey(5.0, 6, 4);
    let shifted = |yarns: &Yarns, [x, y]: [f32; 2]| moved(yarns, |_, _, at| [at[0] + x, at[1] + y, at[2]]);
    let before = knit.repeat(as_it_is);
    let mut noise = noise(5);
    let after = moved(&before, |_, _, at| at.map(|each| each + 1.5 * D * noise()));
    let repeat = [6.0 * knit.wale, 4.0 * knit.course];
    let boundary = Boundary::new(before.layout(), repeat, vec![Ends::Repeats([1, 0]); 4]).unwrap();
    let counts = [[0.0, 0.0], [0.25, 0.0], [0.5, 0.5], [1.75, 1.0], [0.0, 1.5], [-7.5, 3.25]].map(|shift| {
        let [before, after] = [&before, &after].map(|yarns| shifted(yarns, shift));
        let found = linking(&before, &after, &boundary).unwrap();
        pairs(&found);
        (found.compared, found.passages)
    });
    assert!(counts[0].1 > 10, "{counts:?}");
    assert!(counts.iter().all(|count| *count == counts[0]), "{counts:?}");
}

/// Plain weave of two ends and two picks that repeats on all sides, with one control point at each
/// crossing. If `flips` is set, end 1 lies on the other side of pick 2.
fn weave_repeat(flips: bool) -> Yarns {
    let pitch = 2.5 * D;
    let height = |end: usize, pick: usize| {
        let up = (end + pick).is_multiple_of(2);
        if flips && (end, pick) == (0, 1) {
            1.5 * D
        } else if up {
            D / 2.0
        } else {
            -D / 2.0
        }
    };
    let place = |thread: usize| (thread as f32 + 0.5) * pitch;
    let ends = (0..2).map(|end| (0..2).map(|pick| [place(end), place(pick), height(end, pick)]).collect());
    let picks = (0..2).map(|pick| {
        let down = |end: usize| if (end + pick).is_multiple_of(2) { -D / 2.0 } else { D / 2.0 };
        (0..2).map(|end| [place(end), place(pick), down(end)]).collect()
    });
    let lines: Vec<_> = ends.chain(picks).map(|line| (false, line)).collect();
    yarns_of(&lines, D / 2.0)
}

#[test]
fn the_smallest_repeat_of_a_weave_is_compared() {
    let (before, after) = (weave_repeat(false), weave_repeat(true));
    let ends = [[0, 1], [0, 1], [1, 0], [1, 0]].map(Ends::Repeats).to_vec();
    let boundary = Boundary::new(before.layout(), [5.0 * D; 2], ends).unwrap();
    let found = linking(&before, &after, &boundary).unwrap();
    assert_eq!(pairs(&found), [[0, 3]], "{found:?}");
    // A window goes several times round so small a repeat, and the end is flipped in each round.
    assert!(found.largest > LINKING_CHANGE, "{found:?}");
    let same = linking(&before, &before, &boundary).unwrap();
    assert_eq!((same.passages, same.largest), (0, 0.0));
}
