//! Linking names the yarns that pass through one another, and no others. This file has rings,
//! weaves and layers. The modules have knits, repeats and refusals.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test ends at what it did not expect")]

#[path = "../cloths/mod.rs"]
mod cloths;
mod knits;
mod limits;
mod repeats;
mod stitches;

use std::collections::BTreeSet;
use std::f32::consts::TAU;

use texere_contact::{LINKING_CHANGE, Linking, linking};
use texere_core::{Boundary, ControlPoint, Origin, Section, Yarn, Yarns};
use texere_fabric::{Shape, Thread, Woven};

use cloths::{cloth, random_bits, weaves};
use knits::D;

/// The largest change of the linking of a pair of windows in cloth that was only bent, stretched or
/// sheared. A window is a piece of a yarn whose linking with pieces of other yarns is compared.
const HARMLESS: f64 = 0.15;

/// The least change of linking by a passage, in the pair of windows that changes most.
const SEEN: f64 = 0.8;

fn yarns_of(lines: &[(bool, Vec<[f32; 3]>)], radius: f32) -> Yarns {
    let mut yarns = Yarns::builder();
    for (closed, line) in lines {
        let points: Vec<_> = line.iter().map(|[x, y, z]| ControlPoint::new(*x, *y, *z, radius)).collect();
        yarns.yarn(Yarn { closed: *closed, ..Yarn::default() }, &points);
    }
    yarns.build().unwrap()
}

/// Moves every control point by `to`, which gets the number of the yarn, the number of the point in
/// the yarn, and its position.
fn moved(yarns: &Yarns, mut to: impl FnMut(usize, usize, [f32; 3]) -> [f32; 3]) -> Yarns {
    let mut after = yarns.clone();
    for yarn in 0..yarns.layout().yarns().len() {
        let mut points = yarns.yarn_points(yarn).unwrap().to_vec();
        for (number, point) in points.iter_mut().enumerate() {
            [point.x, point.y, point.z] = to(yarn, number, [point.x, point.y, point.z]);
        }
        after.set_points(yarn, &points).unwrap();
    }
    after
}

fn compared(before: &Yarns, after: &Yarns) -> Linking {
    linking(before, after, &Boundary::without_repeat(before.layout())).unwrap()
}

/// Pairs of yarns that have passed through one another, according to the report.
fn pairs(found: &Linking) -> Vec<[usize; 2]> {
    let pairs: BTreeSet<_> = found.worst.iter().map(|each| each.places.map(|place| place.yarn)).collect();
    assert_eq!(found.passages == 0, pairs.is_empty());
    // Passages are listed by their change, the largest first, and none twice.
    for (place, passage) in found.worst.iter().enumerate() {
        assert!(!found.worst[..place].contains(passage), "{found:?}");
    }
    assert!(found.worst.is_sorted_by(|one, other| one.change.abs() >= other.change.abs()));
    assert_eq!(found.left_out, 0);
    pairs.into_iter().collect()
}

/// Random numbers from -1 to 1.
fn noise(seed: u64) -> impl FnMut() -> f32 {
    let mut bits = random_bits(seed);
    move || (0..16).fold(0.0, |sum, place| sum + if bits() { 0.5_f32.powi(place) } else { 0.0 }) - 1.0
}

/// A movement: from the position of a control point to its new one.
type Move = Box<dyn FnMut([f32; 3]) -> [f32; 3]>;

/// Movements that do not harm a cloth. `d` is the diameter of its yarns and `size` its extent, mm.
fn harmless(d: f32, size: f32) -> Vec<(&'static str, Move)> {
    let mut noise = noise(7);
    let radius = size / 2.0;
    vec![
        ("nothing", Box::new(|at| at)),
        ("jitter", Box::new(move |at| at.map(|each| each + 0.1 * d * noise()))),
        ("shift", Box::new(|[x, y, z]| [x + 30.0, y - 70.0, z + 5.0])),
        ("stretch", Box::new(|[x, y, z]| [1.25 * x, 0.85 * y, 1.2 * z])),
        ("shear", Box::new(|[x, y, z]| [x + 0.5 * y, y, z])),
        (
            "waves",
            Box::new(move |[x, y, z]| {
                [x, y + d * (x / (4.0 * d)).sin(), z + 2.0 * d * (y / (6.0 * d)).sin()]
            }),
        ),
        ("a quarter turn", Box::new(|[x, y, z]| [-y, x, z])),
        (
            "a roll",
            Box::new(move |[x, y, z]| {
                let (sine, cosine) = (x / radius).sin_cos();
                [(radius + z) * sine, y, (radius + z) * cosine]
            }),
        ),
    ]
}

/// Checks that harmless movements are not taken for passages.
fn stays_linked(name: &str, yarns: &Yarns, d: f32, size: f32) {
    for (change, mut to) in harmless(d, size) {
        let found = compared(yarns, &moved(yarns, |_, _, at| to(at)));
        assert_eq!(pairs(&found), [] as [[usize; 2]; 0], "{name}, {change}: {found:?}");
        assert!(found.largest < HARMLESS, "{name}, {change}: {found:?}");
    }
}

/// A ring of radius 1 round a point, upright or in the plane of x and y.
fn ring(centre: [f32; 3], upright: bool, count: usize) -> (bool, Vec<[f32; 3]>) {
    let point = |k: usize| {
        let (sine, cosine) = (k as f32 / count as f32 * TAU).sin_cos();
        let [x, y, z] = centre;
        if upright { [x + cosine, y, z + sine] } else { [x + cosine, y + sine, z] }
    };
    (true, (0..count).map(point).collect())
}

#[test]
fn rings_that_come_apart_are_told() {
    for count in [8, 12, 16] {
        let rings = |x: f32| yarns_of(&[ring([0.0; 3], false, count), ring([x, 0.0, 0.0], true, count)], 0.1);
        let (linked, still_linked, apart) = (rings(1.0), rings(0.8), rings(2.4));
        let found = compared(&linked, &apart);
        assert_eq!(pairs(&found), [[0, 1]], "{count} points: {found:?}");
        let back = compared(&apart, &linked);
        assert_eq!(pairs(&back), [[0, 1]]);
        assert!((back.worst[0].change + found.worst[0].change).abs() < 0.3, "{found:?}, {back:?}");
        assert_eq!(pairs(&compared(&linked, &still_linked)), [] as [[usize; 2]; 0]);
        stays_linked("rings", &linked, 0.2, 4.0);
    }
}

#[test]
fn weaves_stay_linked() {
    for (name, drawdown) in weaves() {
        for shape in [Shape::Round, Shape::Crossing] {
            for pitch in [1.8, 4.0] {
                let threads = [Thread::new(pitch * 0.2, 0.1); 2];
                let cloth = cloth(shape, drawdown.clone(), threads, Section::Circle);
                stays_linked(&name, &cloth.yarns().unwrap(), 0.2, 10.0 * pitch as f32 * 0.2);
            }
        }
    }
}

/// The cloth's yarns as they are, and with an end moved to the other side of a pick.
fn flipped(cloth: &Woven, end: usize, pick: usize) -> [Yarns; 2] {
    let before = cloth.yarns().unwrap();
    let crossing = (pick * cloth.drawdown().ends() + end) as u32;
    let first = before.range(end).unwrap().start;
    let sources = before.sources().unwrap().to_vec();
    let after = moved(&before, |yarn, point, [x, y, z]| {
        let flips = yarn == end && sources[first + point] == crossing;
        [x, y, if flips { -3.0 * z } else { z }]
    });
    [before, after]
}

#[test]
fn a_flipped_end_is_told() {
    for (name, drawdown) in weaves() {
        for shape in [Shape::Round, Shape::Crossing] {
            for pitch in [1.8, 2.5, 4.0, 8.0] {
                let threads = [Thread::new(pitch * 0.2, 0.1); 2];
                let cloth = cloth(shape, drawdown.clone(), threads, Section::Circle);
                // One crossing in the middle of the cloth, and two at its edges.
                for (end, pick) in [(4, 5), (0, 6), (7, 0)] {
                    let [before, after] = flipped(&cloth, end, pick);
                    let found = compared(&before, &after);
                    let whole = format!("{name}, {shape:?}, {pitch} d, {end}, {pick}: {found:?}");
                    assert_eq!(pairs(&found), [[end, 10 + pick]], "{whole}");
                    // At an edge, half of each window is missing.
                    let at_edge = end == 0 || pick == 0;
                    assert!(found.largest > if at_edge { LINKING_CHANGE } else { SEEN }, "{whole}");
                    let origins =
                        found.worst[0].places.map(|place| before.layout().yarns()[place.yarn].origin);
                    assert_eq!(origins, [Origin::End(end as u32 + 1), Origin::Pick(pick as u32 + 1)]);
                    let at = found.worst[0].places[0].position;
                    let centre = (pick as f64 + 0.5) * pitch * 0.2;
                    assert!((at[1] - centre).abs() < pitch * 0.2, "{whole}");
                }
            }
        }
    }
}

/// Two layers of plain weave, each of eight ends and eight picks. If `stitched`, some ends of the
/// lower layer rise over picks of the upper one.
fn layers(stitched: bool) -> Yarns {
    let pitch = 2.5 * D;
    let place = |thread: usize| (thread as f32 + 0.5) * pitch;
    let mut lines = Vec::new();
    for layer in [-1.0, 1.0] {
        for end in 0..8 {
            let height = |pick: usize| {
                let own = layer * D + if (end + pick).is_multiple_of(2) { D / 2.0 } else { -D / 2.0 };
                // Ends of the lower layer lie beside those of the upper one.
                if stitched && layer < 0.0 && stitches(end, pick) { 2.2 * D } else { own }
            };
            let x = place(end) + if layer < 0.0 { pitch / 2.0 } else { 0.0 };
            lines.push((false, (0..8).map(|pick| [x, place(pick), height(pick)]).collect()));
        }
        for pick in 0..8 {
            let height =
                |end: usize| layer * D + if (end + pick).is_multiple_of(2) { -D / 2.0 } else { D / 2.0 };
            let y = place(pick);
            lines.push((false, (0..8).map(|end| [place(end), y, height(end)]).collect()));
        }
    }
    yarns_of(&lines, D / 2.0)
}

/// Whether an end of the lower layer binds a pick of the upper one.
fn stitches(end: usize, pick: usize) -> bool {
    [(1, 3), (4, 6), (6, 2)].contains(&(end, pick))
}

#[test]
fn layers_that_lose_their_stitches_are_told() {
    let (before, after) = (layers(true), layers(false));
    let found = compared(&before, &after);
    // Ends of the lower layer are yarns 0 to 7, picks of the upper layer yarns 24 to 31.
    assert_eq!(pairs(&found), [[1, 27], [4, 30], [6, 26]], "{found:?}");
    assert!(found.largest > SEEN, "{found:?}");
    stays_linked("layers", &before, D, 8.0 * 2.5 * D);
}
