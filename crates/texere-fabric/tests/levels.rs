//! Levels of threads: threads that lie above other threads of their own set.

#![allow(clippy::unwrap_used, reason = "a test ends at what it did not expect")]

use texere_fabric::{Drawdown, Weave};

/// Weaves whose threads all lie side by side.
const SINGLE: [&str; 14] = [
    "plain",
    "2/1",
    "3/1",
    "1/3",
    "2/2",
    "2/2(2)",
    "3/3",
    "satin 5(2)",
    "sateen 5(2)",
    "satin 8(3)",
    "sateen 16(3)",
    "herringbone 2/2(16)",
    "crepe",
    "honeycomb",
];

fn highest(drawdown: &Drawdown) -> [u32; 2] {
    drawdown.levels().map(|levels| levels.into_iter().max().unwrap()).into_array()
}

#[test]
fn threads_of_most_weaves_lie_side_by_side() {
    for notation in SINGLE {
        let weave = Weave::parse(notation).unwrap();
        // First a whole number of repeats, then a number that is not whole.
        for [ends, picks] in [[64, 64], [61, 67]] {
            assert_eq!(highest(&weave.drawdown(ends, picks).unwrap()), [0; 2], "{notation}");
        }
    }
    // Stripes of satin beside plain weave, sixteen ends each.
    let stripes = Drawdown::from_fn(64, 64, |end, pick| {
        if end % 32 < 16 {
            (end + pick).is_multiple_of(2)
        } else {
            !(end + 64 - 3 * (pick % 8)).is_multiple_of(8)
        }
    });
    assert_eq!(highest(&stripes.unwrap()), [0; 2]);
}

fn chance(seed: &mut u64) -> usize {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 33) as usize
}

#[test]
fn threads_without_any_order_lie_side_by_side() {
    let mut seed = 5;
    for _ in 0..300 {
        let [ends, picks] = [24 + chance(&mut seed) % 40, 24 + chance(&mut seed) % 40];
        let cloth = Drawdown::from_fn(ends, picks, |_, _| chance(&mut seed).is_multiple_of(2)).unwrap();
        assert_eq!(highest(&cloth), [0; 2], "{ends} x {picks}");
    }
}

/// Threads are given levels, and each level is a weave of its own. [`Drawdown::levels`] finds the
/// same levels.
#[test]
fn layers_are_found_in_any_order() {
    let weaves: [fn(usize, usize) -> bool; 3] = [
        |end, pick| (end + pick).is_multiple_of(2),
        |end, pick| (end + 640 - pick) % 4 < 2,
        |end, pick| !(end + 640 - 3 * (pick % 8)).is_multiple_of(8),
    ];
    // Levels of a repeat's threads: alternating, two or three on the face for one on the back, in
    // pairs, and three layers.
    for order in [&[1, 0][..], &[0, 1], &[1, 1, 0], &[1, 1, 1, 0], &[1, 1, 0, 0], &[2, 1, 0], &[0, 2, 1]] {
        for weave in weaves {
            let layer = |thread: usize| order[thread % order.len()];
            let within = |thread: usize| (0..thread).filter(|&before| layer(before) == layer(thread)).count();
            let places: Vec<usize> = (0..96).map(within).collect();
            let cloth = Drawdown::from_fn(96, 96, |end, pick| match layer(end).cmp(&layer(pick)) {
                std::cmp::Ordering::Equal => weave(places[end], places[pick]),
                apart => apart.is_gt(),
            })
            .unwrap();
            let expected: Vec<u32> = (0..96).map(layer).collect();
            assert_eq!(cloth.levels().into_array(), [expected.clone(), expected], "{order:?}");
        }
    }
}

/// Stitches of the back over the face do not count. One set may have levels without the other.
#[test]
fn stitched_and_backed_cloths_have_levels() {
    let double = |end: usize, pick: usize| match [end % 2, pick % 2] {
        [0, 0] | [1, 1] => (end / 2 + pick / 2).is_multiple_of(2),
        [0, _] => true,
        _ => end % 16 == 5 && pick % 16 == 4,
    };
    assert_eq!(highest(&Drawdown::from_fn(48, 48, double).unwrap()), [1; 2]);
    let backed = |end: usize, pick: usize| {
        let step = (end + 64 - pick / 2) % 4;
        if pick.is_multiple_of(2) { step == 0 } else { step != 2 }
    };
    assert_eq!(highest(&Drawdown::from_fn(32, 32, backed).unwrap()), [0, 1]);
    assert_eq!(highest(&Drawdown::from_fn(32, 32, |end, pick| backed(pick, end)).unwrap()), [1, 0]);
}
