//! Levels of threads: threads that lie above other threads of their own set.

use texere_core::crossings::Level;
use texere_fabric::{Drawdown, Weave};

/// Weaves whose threads all lie side by side.
const SINGLE: [&str; 21] = [
    "plain",
    "2/1",
    "3/1",
    "1/3",
    "2/2",
    "2/2(2)",
    "3/3",
    "4/4",
    "5/3",
    "5/5",
    "8/8",
    "hopsack 2",
    "hopsack 3",
    "hopsack 4",
    "satin 5(2)",
    "sateen 5(2)",
    "satin 8(3)",
    "sateen 16(3)",
    "herringbone 2/2(16)",
    "crepe",
    "honeycomb",
];

/// Whether the warp is up at a crossing of an end and a pick.
type Weaving = fn(usize, usize) -> bool;

/// The numbers of levels of ends and of picks.
fn counts(drawdown: &Drawdown) -> [u8; 2] {
    drawdown.levels().map(|levels| levels.into_iter().map(|level| level.of).max().unwrap()).into_array()
}

/// The level of each thread, in cloth whose threads keep their level everywhere.
fn of_threads(drawdown: &Drawdown) -> [Vec<Level>; 2] {
    let [warp, weft] = drawdown.levels().into_array();
    let ends = drawdown.ends();
    for (number, [end, pick]) in warp.iter().zip(&weft).map(|(end, pick)| [end, pick]).enumerate() {
        assert_eq!([*end, *pick], [warp[number % ends], weft[number / ends * ends]]);
    }
    [warp[..ends].to_vec(), weft.into_iter().step_by(ends).collect()]
}

#[test]
fn threads_of_most_weaves_lie_side_by_side() {
    for notation in SINGLE {
        let weave = Weave::parse(notation).unwrap();
        // First a whole number of repeats, then a number that is not whole.
        for [ends, picks] in [[480, 480], [61, 67]] {
            assert_eq!(counts(&weave.drawdown(ends, picks).unwrap()), [1; 2], "{notation}");
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
    assert_eq!(counts(&stripes.unwrap()), [1; 2]);
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
        assert_eq!(counts(&cloth), [1; 2], "{ends} x {picks}");
    }
}

/// Threads are given levels, and each level is a weave of its own. [`Drawdown::levels`] finds the
/// same levels.
#[test]
fn layers_are_found_in_any_order() {
    let weaves: [Weaving; 3] = [
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
            let of = order.iter().max().unwrap() + 1;
            let level = |thread: usize| Level { number: layer(thread) as u8, of: of as u8 };
            let expected: Vec<Level> = (0..96).map(level).collect();
            assert_eq!(of_threads(&cloth), [expected.clone(), expected], "{order:?}");
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
    assert_eq!(counts(&Drawdown::from_fn(48, 48, double).unwrap()), [2; 2]);
    let backed = |end: usize, pick: usize| {
        let step = (end + 64 - pick / 2) % 4;
        if pick.is_multiple_of(2) { step == 0 } else { step != 2 }
    };
    assert_eq!(counts(&Drawdown::from_fn(32, 32, backed).unwrap()), [1, 2]);
    assert_eq!(counts(&Drawdown::from_fn(32, 32, |end, pick| backed(pick, end)).unwrap()), [2, 1]);
}

/// In a staircase each thread lies above the next one. A staircase of more threads than a set may
/// have levels counts as one level.
#[test]
fn a_staircase_has_one_level() {
    for count in [12, 300] {
        let stairs = Drawdown::from_fn(count, count, |end, pick| end > pick).unwrap();
        assert_eq!(counts(&stairs), [1; 2], "{count}");
    }
}

/// An orthogonal weave: picks in columns of three, stuffers that lie straight between them, and
/// binders that pass from the face to the back between the columns.
fn orthogonal(end: usize, pick: usize) -> bool {
    // The picks of a column are woven from the top one down.
    let depth = pick % 3;
    match end % 3 {
        0 => depth > 0,
        1 => depth > 1,
        _ => (end / 3 + pick / 3).is_multiple_of(2),
    }
}

#[test]
fn stuffers_lie_on_levels_and_binders_pass_them() {
    let [warp, weft] = of_threads(&Drawdown::from_fn(24, 24, orthogonal).unwrap());
    let stuffer = |number| Level { number, of: 2 };
    let expected = [stuffer(1), stuffer(0), Level::BINDER];
    assert_eq!(warp, expected.into_iter().cycle().take(24).collect::<Vec<_>>());
    let expected = [2, 1, 0].map(|number| Level { number, of: 3 });
    assert_eq!(weft, expected.into_iter().cycle().take(24).collect::<Vec<_>>());
}

/// Discs in a ground of twice their width, where the layers of a double plain cloth change places.
/// Most threads lie in one layer nearly everywhere.
#[test]
fn small_figures_are_found() {
    let turned = |end: usize, pick: usize| {
        let [x, y] = [end, pick].map(|thread| (thread % 64) as f64 - 31.5);
        x.hypot(y) < 16.0
    };
    let cloth = |end: usize, pick: usize| match end % 2 == pick % 2 {
        true => (end / 2 + pick / 2).is_multiple_of(2),
        false => end.is_multiple_of(2) != turned(end, pick),
    };
    let drawdown = Drawdown::from_fn(128, 128, cloth).unwrap();
    let [warp, weft] = drawdown.levels().into_array();
    let mut seen = [0, 0, 0];
    for number in 0..128 * 128 {
        let [end, pick] = [number % 128, number / 128];
        let level =
            |thread: usize| Level { number: (thread.is_multiple_of(2) != turned(end, pick)).into(), of: 2 };
        let is_single = [warp[number], weft[number]] == [Level::SINGLE; 2];
        let is_right = [warp[number], weft[number]] == [level(end), level(pick)];
        seen[if is_single { 0 } else { 1 + usize::from(is_right) }] += 1;
    }
    println!("{seen:?} crossings that are single, wrong, right");
    assert!(seen[1] < 128 && seen[0] < 128 * 128 / 3, "{seen:?}");
}

/// The layers of a figured double cloth change places along a figure's outline. Both layers are of
/// one weave. The figure's squares are `size` threads wide.
fn figured(weave: Weaving, size: usize) -> impl Fn(usize, usize) -> (bool, bool) {
    move |end, pick| {
        let turned = !(end / size + pick / size).is_multiple_of(2);
        let [end_of_face, pick_of_face] = [end, pick].map(|thread| thread.is_multiple_of(2) != turned);
        let up = if end_of_face == pick_of_face { weave(end / 2, pick / 2) } else { end_of_face };
        (up, turned)
    }
}

#[test]
fn layers_that_change_places_are_found_by_place() {
    let weaves: [Weaving; 3] = [
        |end, pick| (end + pick).is_multiple_of(2),
        |end, pick| (end + 640 - pick) % 4 < 2,
        |end, pick| !(end + 640 - 2 * (pick % 5)).is_multiple_of(5),
    ];
    for (name, weave) in ["plain", "2/2", "satin"].into_iter().zip(weaves) {
        for size in [20, 40, 60] {
            let (cloth, count) = (figured(weave, size), 4 * size);
            let drawdown = Drawdown::from_fn(count, count, |end, pick| cloth(end, pick).0).unwrap();
            let [warp, weft] = drawdown.levels().into_array();
            // Within three threads of the outline, the cloth counts as single.
            let is_near = |thread: usize| thread % size < 3 || thread % size >= size - 3;
            let wrong = (0..count * count).filter(|&number| {
                let [end, pick] = [number % count, number / count];
                let turned = cloth(end, pick).1;
                let level = |thread: usize| match is_near(end) || is_near(pick) {
                    true => Level::SINGLE,
                    false => Level { number: (thread.is_multiple_of(2) != turned).into(), of: 2 },
                };
                [warp[number], weft[number]] != [level(end), level(pick)]
            });
            // By the weave alone, the outline may seem to lie a thread further on.
            let (wrong, outline) = (wrong.count(), count * count / size);
            println!("{name}, {size}: {wrong} of {} crossings, {outline} at the outline", count * count);
            assert!(wrong <= outline, "{name}, {size}: {wrong}");
        }
    }
}
