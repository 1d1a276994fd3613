//! Control points of woven cloth of the shape [`Shape::Round`], crossing by crossing, for any share
//! of the crimp, with and without a selvedge.

use proptest::prelude::*;
use texere_core::{Material, Origin, Section, Yarns};
use texere_fabric::{Crimp, Drawdown, NO_CROSSING, Shape, Thread, Weave, Woven};

fn woven(drawdown: Drawdown, warp: Vec<Thread>, weft: Vec<Thread>) -> Woven {
    let mut cloth =
        Woven::new(drawdown, warp, weft, vec![Material::default(); 2], vec![Section::Circle]).unwrap();
    cloth.set_shape(Shape::Round);
    cloth
}

fn cloths() -> impl Strategy<Value = Woven> {
    let threads = || {
        let thread = (0.3..2.0f64, 0.015625..0.2f32, 0..2u32)
            .prop_map(|(spacing, radius, material)| Thread { material, ..Thread::new(spacing, radius) });
        prop::collection::vec(thread, 1..10)
    };
    (threads(), threads(), 0.0625..0.95f32, any::<bool>()).prop_flat_map(|(warp, weft, share, selvedge)| {
        prop::collection::vec(any::<bool>(), warp.len() * weft.len()).prop_map(move |up| {
            let (ends, picks) = (warp.len(), weft.len());
            let drawdown = Drawdown::from_fn(ends, picks, |end, pick| up[pick * ends + end]).unwrap();
            let mut cloth = woven(drawdown, warp.clone(), weft.clone());
            cloth.set_crimp(Crimp::WarpShare(share)).unwrap();
            cloth.set_selvedge(selvedge);
            cloth
        })
    })
}

/// Positions of threads by the definition: in the middle of their columns, which lie side by side.
pub(crate) fn places(threads: &[Thread]) -> Vec<f64> {
    (0..threads.len())
        .map(|own| {
            threads[..own].iter().map(|thread| thread.spacing_mm).sum::<f64>() + threads[own].spacing_mm / 2.0
        })
        .collect()
}

/// Whether a yarn has a control point at the place `at` (x and y, mm) with the height `z`.
fn passes(yarns: &Yarns, yarn: usize, at: [f64; 2], z: f64) -> bool {
    yarns.yarn_points(yarn).unwrap().iter().any(|point| {
        (f64::from(point.x) - at[0]).abs() < 1e-5
            && (f64::from(point.y) - at[1]).abs() < 1e-5
            && (f64::from(point.z) - z).abs() < 1e-6
    })
}

proptest! {
    #[test]
    fn at_each_crossing_the_two_threads_just_touch(cloth in cloths()) {
        let yarns = cloth.yarns().unwrap();
        prop_assert_eq!(yarns.points().len() as u64, cloth.point_count());
        let share = f64::from(cloth.warp_share());
        let yarn_of_pick = |pick: usize| {
            let first = |yarn: &texere_core::Yarn| matches!(yarn.origin, Origin::Pick(n) if n as usize <= pick + 1);
            yarns.layout().yarns().iter().rposition(first).unwrap()
        };
        for (pick, y) in places(cloth.weft()).into_iter().enumerate() {
            for (end, x) in places(cloth.warp()).into_iter().enumerate() {
                let room = f64::from(cloth.warp()[end].radius_mm) + f64::from(cloth.weft()[pick].radius_mm);
                let side = if cloth.drawdown().up(end, pick) { 1.0 } else { -1.0 };
                prop_assert!(passes(&yarns, end, [x, y], side * share * room));
                prop_assert!(passes(&yarns, yarn_of_pick(pick), [x, y], -side * (1.0 - share) * room));
            }
        }
    }

    #[test]
    fn points_are_as_many_as_evenly_spaced_threads_change_sides(cloth in cloths(), spacing in 0.1..5.0f64) {
        let even = |threads: &[Thread]| threads.iter().map(|t| Thread { spacing_mm: spacing, ..*t }).collect();
        let mut even = woven(cloth.drawdown().clone(), even(cloth.warp()), even(cloth.weft()));
        even.set_selvedge(cloth.selvedge());
        let cloth = even;
        let (ends, picks) = (cloth.warp().len(), cloth.weft().len());
        let up = |end, pick| cloth.drawdown().up(end, pick);
        let warp: usize = (0..ends).map(|e| (1..picks).filter(|&p| up(e, p) != up(e, p - 1)).count()).sum();
        let weft: usize = (0..picks).map(|p| (1..ends).filter(|&e| up(e, p) != up(e - 1, p)).count()).sum();
        let alike = |pair: &[Thread]| cloth.selvedge() && pair[0].material == pair[1].material;
        let turns = cloth.weft().windows(2).filter(|pair| alike(pair)).count();
        // A turn of five points takes the place of two cut ends.
        let expected = 2 * ends * picks + 3 * (warp + weft) + 2 * (ends + picks) + 3 * turns;
        prop_assert_eq!(cloth.point_count(), expected as u64);
        prop_assert_eq!(cloth.yarns().unwrap().layout().yarns().len(), ends + picks - turns);
    }

    #[test]
    fn sources_name_the_nearest_crossing_or_the_one_before(cloth in cloths()) {
        let yarns = cloth.yarns().unwrap();
        let (ends, at) = (cloth.warp().len(), [places(cloth.warp()), places(cloth.weft())]);
        for (number, yarn) in yarns.layout().yarns().iter().enumerate() {
            let sources = &yarns.sources().unwrap()[yarns.range(number).unwrap()];
            let mut seen = Vec::new();
            for (point, &source) in yarns.yarn_points(number).unwrap().iter().zip(sources) {
                if source == NO_CROSSING {
                    continue;
                }
                let (end, pick) = (source as usize % ends, source as usize / ends);
                let (dx, dy) = (f64::from(point.x) - at[0][end], f64::from(point.y) - at[1][pick]);
                match yarn.origin {
                    Origin::End(own) => {
                        prop_assert_eq!(end + 1, own as usize);
                        prop_assert!(dx.abs() < 1e-5 && dy.abs() < 2.0);
                    }
                    _ => prop_assert!(dy.abs() < 1e-5 && dx.abs() < 2.0),
                }
                seen.push(source);
            }
            seen.dedup();
            let count = seen.len();
            seen.sort_unstable();
            seen.dedup();
            prop_assert_eq!(seen.len(), count, "a crossing is left and come back to");
        }
    }
}

#[test]
fn a_long_float_beside_a_close_pitch_is_stepped_through() {
    // An end with empty room beside it, 5.2 mm to both neighbours, among ends 0.4 mm apart. The
    // spline's parameter runs evenly over all intervals, long or short. If an interval were more
    // than five times as long as its neighbour, the thread would turn back on itself.
    let (close, far) = (Thread::new(0.4, 0.1), Thread::new(10.0, 0.1));
    let warp = vec![close, close, far, close, close];
    let up = [true, false, false, true, true];
    let cloth = woven(Drawdown::from_fn(5, 1, |end, _| up[end]).unwrap(), warp, vec![close]);
    let yarns = cloth.yarns().unwrap();
    let points = yarns.yarn_points(5).unwrap();
    let steps: Vec<f32> = points.windows(2).map(|pair| pair[1].x - pair[0].x).collect();
    assert!(
        steps.windows(2).all(|pair| pair[0] > 0.0 && pair[0] < 5.0 * pair[1] && pair[1] < 5.0 * pair[0]),
        "{steps:?}"
    );
    assert_eq!(yarns.points().len() as u64, cloth.point_count());
}

#[test]
fn floats_lie_flat() {
    let thread = Thread::new(0.5, 0.1);
    let twill = Weave::parse("3/1").unwrap().drawdown(8, 8).unwrap();
    let yarns = woven(twill, vec![thread; 8], vec![thread; 8]).yarns().unwrap();
    let highest = yarns.points().iter().fold(0.0f32, |most, point| most.max(point.z.abs()));
    assert_eq!(highest, 0.1);
}

#[test]
fn the_weft_turns_outside_the_edge_ends() {
    let thread = Thread::new(0.5, 0.1);
    let red = Thread { material: 1, ..thread };
    let weft = vec![thread, thread, thread, red, red, thread];
    let mut cloth = woven(Weave::parse("plain").unwrap().drawdown(4, 6).unwrap(), vec![thread; 4], weft);
    cloth.set_selvedge(true);
    let yarns = cloth.yarns().unwrap();
    let origins: Vec<_> =
        yarns.layout().yarns()[4..].iter().map(|yarn| (yarn.origin, yarn.material)).collect();
    assert_eq!(origins, [(Origin::Pick(1), 0), (Origin::Pick(4), 1), (Origin::Pick(6), 0)]);
    // Pick 1 starts at the left. The turn to pick 2 is at the right, beyond the edge end (1.75) and
    // both radii. Its radius is half a pitch.
    let points = yarns.yarn_points(4).unwrap();
    assert_eq!((points[0].x, points[0].y), (0.0, 0.25));
    let rightmost = points.iter().fold(0.0f32, |most, point| most.max(point.x));
    assert!((rightmost - (1.75 + 0.2 + 0.25)).abs() < 1e-6, "{rightmost}");
    let leftmost = points.iter().fold(9.0f32, |least, point| least.min(point.x));
    assert!((leftmost - (0.25 - 0.2 - 0.25)).abs() < 1e-6, "{leftmost}");
    // Pick 4 has an even number, and runs to the left.
    assert_eq!(yarns.yarn_points(5).unwrap()[0].x, 2.0);
}

#[test]
fn a_share_that_is_not_sound_changes_nothing() {
    let thread = Thread::new(0.5, 0.1);
    let mut cloth = woven(Drawdown::new(2, 2).unwrap(), vec![thread; 2], vec![thread; 2]);
    let before = cloth.clone();
    assert!(cloth.set_crimp(Crimp::WarpShare(1.5)).is_err());
    assert_eq!(cloth, before);
}
