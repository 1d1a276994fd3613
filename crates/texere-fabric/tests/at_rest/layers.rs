//! Cloths of several layers at rest.

use std::cmp::Ordering;

use texere_core::crossings::Set;
use texere_core::{Material, Origin, Section};
use texere_fabric::{Drawdown, Thread, Woven, WovenRest};

use crate::surfaces::Surfaces;
use crate::{at_rest, plain, tightest};

/// Number of ends, and of picks.
const THREADS: usize = 24;

/// Diameter of all threads, mm.
const DIAMETER: f64 = 0.2;

fn twill(end: usize, pick: usize) -> bool {
    (end + 64 - pick) % 4 < 2
}

/// Two layers of one weave. Ends and picks belong alternately to the face and to the back, the face
/// first. If `stitched`, some back ends are lifted over a face pick.
fn double(weave: fn(usize, usize) -> bool, stitched: bool) -> Drawdown {
    let up = move |end: usize, pick: usize| match [end % 2, pick % 2] {
        [0, 0] | [1, 1] => weave(end / 2, pick / 2),
        [0, _] => true,
        // A stitch lies where the ends beside it float over the face pick, and where the back end
        // lies over the picks beside the face pick.
        _ => stitched && (end / 2).is_multiple_of(4) && (end / 2 + 64 - pick / 2).is_multiple_of(8),
    };
    Drawdown::from_fn(THREADS, THREADS, up).unwrap()
}

/// Picks belong alternately to the face, a weft-faced twill, and to the back, a warp-faced twill.
fn weft_backed(end: usize, pick: usize) -> bool {
    let step = (end + 64 - pick / 2) % 4;
    if pick.is_multiple_of(2) { step == 0 } else { step != 2 }
}

/// A cloth whose layers have threads every `pitch` diameters.
fn cloth(drawdown: Drawdown, pitch: f64) -> Woven {
    let levels = drawdown.levels().map(|levels| levels.into_iter().map(|level| level.of).fold(1, u8::max));
    let threads = |set: Set, count: usize| {
        let spacing = pitch * DIAMETER / f64::from(levels[set]);
        vec![Thread::new(spacing, (DIAMETER / 2.0) as f32); count]
    };
    let [warp, weft] = [threads(Set::Warp, drawdown.ends()), threads(Set::Weft, drawdown.picks())];
    Woven::new(drawdown, warp, weft, vec![Material::default()], vec![Section::Circle]).unwrap()
}

#[test]
fn layers_lie_on_one_another() {
    let turned = Drawdown::from_fn(THREADS, THREADS, |end, pick| weft_backed(pick, end)).unwrap();
    let backed = Drawdown::from_fn(THREADS, THREADS, weft_backed).unwrap();
    for (name, drawdown, area) in [
        ("double plain", double(plain, false), 0.88),
        ("double twill", double(twill, false), 0.89),
        ("double twill, stitched", double(twill, true), 0.88),
        ("weft-backed", backed, 0.87),
        ("warp-backed", turned, 0.87),
    ] {
        let woven = cloth(drawdown, 2.0);
        let rest = at_rest(&woven);
        let surfaces = Surfaces::new(&rest.yarns);
        let (clearance, folds) = (surfaces.clearance(), tightest(&rest.yarns));
        println!(
            "{name}: {} passes, clearance {:.3} -> {:.3} (by sections {clearance:.3}), bends {folds:.2}, area {:.3} {:.3} ({:.2} {:.2}), {:.2} mm",
            rest.crossings.passes,
            rest.clearance[0],
            rest.clearance[1],
            rest.area.warp,
            rest.area.weft,
            rest.area_least.warp,
            rest.area_least.weft,
            surfaces.thickness(),
        );
        assert!(clearance >= 0.98, "{name}: {clearance}");
        assert!(folds >= 1.0, "{name} folds: {folds}");
        for set in Set::BOTH {
            assert!(rest.area[set] >= area, "{name}: area {:?}", rest.area);
        }
        threads_cross_as_they_are_woven(&woven, &rest);
    }
}

/// Checks that at every crossing the thread that the drawdown puts on top lies higher, whatever its
/// layer.
fn threads_cross_as_they_are_woven(woven: &Woven, rest: &WovenRest) {
    let path = |yarn: usize| -> Vec<[f64; 3]> {
        let points = rest.yarns.yarn_points(yarn).unwrap();
        points.iter().map(|point| [point.x, point.y, point.z].map(f64::from)).collect()
    };
    let paths: Vec<Vec<[f64; 3]>> = (0..rest.yarns.layout().yarns().len()).map(path).collect();
    let height = |path: &[[f64; 3]], axis: usize, at: f64| {
        let after = path.partition_point(|point| point[axis] < at).clamp(1, path.len() - 1);
        let [one, two] = [path[after - 1], path[after]];
        one[2] + (at - one[axis]) / (two[axis] - one[axis]) * (two[2] - one[2])
    };
    // Threads shift sideways, so the point of a thread that lies nearest to the other thread
    // counts.
    let place = |path: &[[f64; 3]], axis: usize, along: usize, at: f64| {
        let near = path.iter().min_by(|one, two| (one[along] - at).abs().total_cmp(&(two[along] - at).abs()));
        near.unwrap()[axis]
    };
    let middles = woven.middles_mm();
    let ends = woven.drawdown().ends();
    for end in 0..ends {
        assert!(matches!(rest.yarns.layout().yarns()[end].origin, Origin::End(_)));
        for pick in 0..woven.drawdown().picks() {
            let (warp, weft) = (&paths[end], &paths[ends + pick]);
            let x = place(warp, 0, 1, middles.weft[pick]);
            let y = place(weft, 1, 0, middles.warp[end]);
            let over = height(warp, 1, y) - height(weft, 0, x);
            let up = woven.drawdown().up(end, pick);
            assert!((over > 0.0) == up, "end {end}, pick {pick}: {over}, {up}");
        }
    }
}

/// The measure is able to fail: layers that are laid into one plane pierce one another.
#[test]
fn layers_in_one_place_pierce() {
    let clearance = Surfaces::new(&cloth(double(plain, false), 2.0).yarns().unwrap()).clearance();
    assert!(clearance < 0.8, "{clearance}");
}

/// Layers of one weave. `ends` and `picks` are the layers of a repeat of threads, 0 for the face.
fn layered(weave: fn(usize, usize) -> bool, ends: &[usize], picks: &[usize]) -> Drawdown {
    // The number of a thread among those of its layer.
    let own = |layers: &[usize], thread: usize| {
        let same = |number: &usize| layers[number % layers.len()] == layers[thread % layers.len()];
        (0..thread).filter(same).count()
    };
    let up = |end: usize, pick: usize| match ends[end % ends.len()].cmp(&picks[pick % picks.len()]) {
        Ordering::Less => true,
        Ordering::Equal => weave(own(ends, end), own(picks, pick)),
        Ordering::Greater => false,
    };
    Drawdown::from_fn(THREADS, THREADS, up).unwrap()
}

/// In open cloth the threads of one layer lie in the gaps of another. Threads of two layers that
/// would be in one place are pushed apart. Without this push, clearances fell to 0.1 and below.
#[test]
fn layers_rest_at_any_sett() {
    for (name, drawdown) in [
        ("double plain", double(plain, false)),
        ("double twill", double(twill, false)),
        ("double twill, stitched", double(twill, true)),
        ("two face, two back", layered(twill, &[0, 0, 1, 1], &[0, 0, 1, 1])),
        ("picks face, back, back, face", layered(twill, &[0, 1], &[0, 1, 1, 0])),
        ("treble plain", layered(plain, &[0, 1, 2], &[0, 1, 2])),
        ("quadruple plain", layered(plain, &[0, 1, 2, 3], &[0, 1, 2, 3])),
    ] {
        for pitch in [2.6, 3.5, 5.0] {
            let woven = cloth(drawdown.clone(), pitch);
            let rest = at_rest(&woven);
            let surfaces = Surfaces::new(&rest.yarns);
            let (clearance, folds) = (surfaces.clearance(), tightest(&rest.yarns));
            println!("{name} at {pitch}: {clearance:.3}, bends {folds:.2}, area {:?}", rest.area);
            assert!(clearance >= 0.98, "{name} at {pitch}: {clearance}");
            assert!(folds >= 1.0, "{name} at {pitch} folds: {folds}");
            for set in Set::BOTH {
                assert!(rest.area[set] >= 0.87, "{name} at {pitch}: area {:?}", rest.area);
            }
            threads_cross_as_they_are_woven(&woven, &rest);
        }
    }
}

/// Two layers of one weave that change places from square to square. Each square is `size` threads
/// wide. For layers that change places, the corners of squares are harder than a straight outline.
fn figured(weave: fn(usize, usize) -> bool, size: usize) -> Drawdown {
    let up = |end: usize, pick: usize| {
        let turned = !(end / size + pick / size).is_multiple_of(2);
        let [face_end, face_pick] = [end, pick].map(|thread| thread.is_multiple_of(2) != turned);
        if face_end == face_pick { weave(end / 2, pick / 2) } else { face_end }
    };
    Drawdown::from_fn(2 * size, 2 * size, up).unwrap()
}

#[test]
fn layers_change_places() {
    for (name, drawdown, pitches) in
        [("plain", figured(plain, 24), &[2.6, 3.5][..]), ("twill", figured(twill, 24), &[3.5])]
    {
        for &pitch in pitches {
            let woven = cloth(drawdown.clone(), pitch);
            let rest = at_rest(&woven);
            let surfaces = Surfaces::new(&rest.yarns);
            let (clearance, folds) = (surfaces.clearance(), tightest(&rest.yarns));
            println!(
                "{name} at {pitch}: {} passes, clearance {:.3} -> {clearance:.3}, bends {folds:.2}, area {:.3} {:.3} ({:.2} {:.2}), {:.2} mm",
                rest.crossings.passes,
                rest.clearance[0],
                rest.area.warp,
                rest.area.weft,
                rest.area_least.warp,
                rest.area_least.weft,
                surfaces.thickness(),
            );
            assert!(clearance >= 0.98, "{name} at {pitch}: {clearance}");
            assert!(folds >= 1.0, "{name} at {pitch} folds: {folds}");
            // If threads of both layers lay side by side, as in single cloth, they would lose more
            // of their area.
            for set in Set::BOTH {
                assert!(rest.area[set] >= 0.9, "{name} at {pitch}: area {:?}", rest.area);
            }
            threads_cross_as_they_are_woven(&woven, &rest);
        }
    }
}

/// An orthogonal weave: picks in columns of three, two levels of stuffers that lie straight between
/// them, and thin binders from the face to the back.
#[test]
fn stuffers_lie_straight() {
    let up = |end: usize, pick: usize| match end % 3 {
        stuffer @ (0 | 1) => pick % 3 > stuffer,
        _ => (end / 3 + pick / 3).is_multiple_of(2),
    };
    let ends = (0..12).map(|end| Thread::new(1.0, if end % 3 < 2 { 0.2 } else { 0.1 })).collect();
    let woven = Woven::new(
        Drawdown::from_fn(12, 12, up).unwrap(),
        ends,
        vec![Thread::new(1.0, 0.2); 12],
        vec![Material::default()],
        vec![Section::Circle],
    )
    .unwrap();
    let rest = at_rest(&woven);
    let clearance = Surfaces::new(&rest.yarns).clearance();
    assert!(clearance >= 0.98, "{clearance}");
    threads_cross_as_they_are_woven(&woven, &rest);
    // For each end, its mean height and its crimp.
    let ends: Vec<[f64; 2]> = (0..12)
        .map(|end| {
            let points = rest.yarns.yarn_points(end).unwrap();
            let mean = points.iter().map(|point| f64::from(point.z)).sum::<f64>() / points.len() as f64;
            let steps = points.windows(2).map(|pair| {
                [pair[1].x - pair[0].x, pair[1].y - pair[0].y, pair[1].z - pair[0].z].map(f64::from)
            });
            let length: f64 = steps.map(|[x, y, z]| x.hypot(y).hypot(z)).sum();
            [mean, length / woven.size_mm()[1] - 1.0]
        })
        .collect();
    println!("{clearance:.3}, {ends:.3?}");
    for column in ends.chunks(3) {
        let [[upper, crimp], [lower, other], _] = column else { unreachable!("three ends a column") };
        assert!(upper - lower > 0.1, "{column:?}");
        assert!(crimp.max(*other) < 0.02, "{column:?}");
    }
}
