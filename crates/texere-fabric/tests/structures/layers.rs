//! Layers of cloth against all sets of threads that can be lifted off the rest.

use texere_fabric::{Drawdown, Weave};

/// Whether the ends and picks of two masks can be lifted off all other threads.
fn lifts_off(cloth: &Drawdown, [ends, picks]: [usize; 2]) -> bool {
    let inside = |mask: usize, thread: usize| mask >> thread & 1 == 1;
    (0..cloth.ends()).all(|end| {
        (0..cloth.picks()).all(|pick| match (inside(ends, end), inside(picks, pick)) {
            (true, false) => cloth.up(end, pick),
            (false, true) => !cloth.up(end, pick),
            _ => true,
        })
    })
}

/// Ends and picks of each layer.
fn sizes(cloth: &Drawdown) -> Vec<[usize; 2]> {
    cloth.layers().into_iter().map(|layer| layer.into_array()).collect()
}

/// The number of ends and of picks in each set of threads that can be lifted off.
fn lifted(cloth: &Drawdown) -> Vec<[usize; 2]> {
    let masks =
        (0..1 << cloth.ends()).flat_map(|ends| (0..1 << cloth.picks()).map(move |picks| [ends, picks]));
    let sizes = masks
        .filter(|masks| lifts_off(cloth, *masks))
        .map(|masks: [usize; 2]| masks.map(|mask| mask.count_ones() as usize));
    sizes.collect()
}

#[test]
fn layers_are_what_can_be_lifted_off() {
    let (mut seed, mut apart) = (7_u64, 0);
    for round in 0..1000 {
        let mut chance = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 33) as usize
        };
        let [ends, picks] = [2 + chance() % 4, 2 + chance() % 4];
        // Two of three drawdowns are made of up to three layers, so that many fall apart.
        let heights: Vec<usize> = (0..ends + picks).map(|_| chance() % 3).collect();
        let cloth = Drawdown::from_fn(ends, picks, |end, pick| {
            let [warp, weft] = [heights[end], heights[ends + pick]];
            if warp == weft || round % 3 == 0 { chance() % 2 == 0 } else { warp > weft }
        })
        .unwrap();
        let (layers, all) = (sizes(&cloth), lifted(&cloth));
        let sum =
            |upto: usize| [0, 1].map(|set| layers[..upto].iter().map(|layer| layer[set]).sum::<usize>());
        assert_eq!(sum(layers.len()), [ends, picks]);
        for upto in 1..layers.len() {
            assert!(all.contains(&sum(upto)), "{layers:?} {all:?}");
        }
        // Any other set that can be lifted off is a number of whole layers and a part of the next
        // layer, which has only ends or only picks. Ends and picks of one layer hang together.
        for size in &all {
            let within = |upto: usize| {
                let layer = layers[upto];
                let left = [0, 1].map(|set| size[set].checked_sub(sum(upto)[set]));
                let part = |set: usize| left[set].is_some_and(|left| left <= layer[set]);
                part(0) && part(1) && (layer.contains(&0) || left == [Some(0); 2])
            };
            let whole = *size == [ends, picks];
            assert!(whole || (0..layers.len()).any(within), "{size:?} of {layers:?}");
        }
        apart += usize::from(layers.len() > 1);
    }
    assert!((300..950).contains(&apart), "{apart}");
}

#[test]
fn weaves_hang_together_and_double_cloth_does_not() {
    for weave in ["plain", "3/1", "satin 8(3)", "honeycomb", "2/2(2+2)", "crepe"] {
        assert_eq!(sizes(&Weave::parse(weave).unwrap().drawdown(24, 24).unwrap()), [[24, 24]], "{weave}");
    }
    let plain = |end: usize, pick: usize| (end + pick).is_multiple_of(2);
    let mut double = Drawdown::from_fn(24, 36, |end, pick| match (end % 2, pick % 3) {
        (0, 0 | 1) => plain(end / 2, pick - pick / 3),
        (1, 2) => plain(end / 2, pick / 3),
        (face, _) => face == 0,
    })
    .unwrap();
    assert_eq!(sizes(&double), [[12, 24], [12, 12]]);
    // One back end that is lifted over a face pick stitches the layers together.
    double.set(1, 0, true).unwrap();
    assert_eq!(sizes(&double), [[24, 36]]);
    // A pick that no end passes over lies loose on the cloth.
    let loose = Drawdown::from_fn(6, 6, |end, pick| pick != 2 && plain(end, pick)).unwrap();
    assert_eq!(sizes(&loose), [[0, 1], [6, 5]]);
}
