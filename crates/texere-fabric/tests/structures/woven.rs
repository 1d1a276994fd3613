//! Properties that hold for cloth of any weave and any threads, and refusals.

use proptest::prelude::*;
use texere_core::{ControlPoint, Material, Origin, Section, Settings, YarnError, Yarns};
use texere_fabric::{
    Drawdown, FabricError, FabricWarning, NO_CROSSING, Shape, Thread, ThreadError, Weave, Woven, WovenError,
};

use crate::shape::places;

fn woven(drawdown: Drawdown, warp: Vec<Thread>, weft: Vec<Thread>) -> Result<Woven, FabricError> {
    let sections = vec![Section::Circle, Section::Ellipse { aspect: 2.0 }];
    Woven::new(drawdown, warp, weft, vec![Material::default(); 2], sections)
}

fn threads() -> impl Strategy<Value = Vec<Thread>> {
    let thread = (0.3..2.0f64, 0.015625..0.2f32, 0..2u32, 0..2u32, -5.0..5.0f32).prop_map(
        |(spacing_mm, radius_mm, material, section, twist)| Thread {
            material,
            section,
            twist,
            ..Thread::new(spacing_mm, radius_mm)
        },
    );
    prop::collection::vec(thread, 1..14)
}

/// Cloths with one control point at each crossing. Tests of the other shape are in `shape.rs`.
fn cloths() -> impl Strategy<Value = Woven> {
    (threads(), threads()).prop_flat_map(|(warp, weft)| {
        prop::collection::vec(any::<bool>(), warp.len() * weft.len()).prop_map(move |up| {
            let drawdown =
                Drawdown::from_fn(warp.len(), weft.len(), |end, pick| up[pick * warp.len() + end]).unwrap();
            let mut cloth = woven(drawdown, warp.clone(), weft.clone()).unwrap();
            cloth.set_shape(Shape::Crossing);
            cloth
        })
    })
}

/// The control points of `yarn` that come from crossing `number`.
fn at_crossing(yarns: &Yarns, yarn: usize, number: usize) -> Vec<ControlPoint> {
    let sources = &yarns.sources().unwrap()[yarns.range(yarn).unwrap()];
    let points = yarns.yarn_points(yarn).unwrap();
    points
        .iter()
        .zip(sources)
        .filter(|(_, source)| **source as usize == number)
        .map(|(point, _)| *point)
        .collect()
}

proptest! {
    #[test]
    fn each_end_crosses_each_pick_once_on_the_side_that_the_drawdown_says(cloth in cloths()) {
        let yarns = cloth.yarns().unwrap();
        let ends = cloth.warp().len();
        for (pick, y) in places(cloth.weft()).into_iter().enumerate() {
            for (end, x) in places(cloth.warp()).into_iter().enumerate() {
                let number = pick * ends + end;
                let (warp, weft) = (at_crossing(&yarns, end, number), at_crossing(&yarns, ends + pick, number));
                prop_assert_eq!((warp.len(), weft.len()), (1, 1));
                let (warp, weft) = (warp[0], weft[0]);
                for point in [warp, weft] {
                    prop_assert!((f64::from(point.x) - x).abs() < 1e-5);
                    prop_assert!((f64::from(point.y) - y).abs() < 1e-5);
                }
                let (upper, lower) = if cloth.drawdown().up(end, pick) { (warp, weft) } else { (weft, warp) };
                prop_assert!(upper.z > 0.0 && lower.z < 0.0);
                // The two are far enough apart for both sections. Half the height of an ellipse of
                // aspect 2 is 1/√2 of the yarn's radius, or √2 if twist turns it on edge.
                let height = |thread: &Thread| match (thread.section, thread.twist) {
                    (1, 0.0) => thread.radius_mm * 0.5f32.sqrt(),
                    (1, _) => thread.radius_mm * 2.0f32.sqrt(),
                    _ => thread.radius_mm,
                };
                let room = height(&cloth.warp()[end]) + height(&cloth.weft()[pick]);
                prop_assert!((warp.z - weft.z).abs() > room * 0.9999);
                prop_assert!((warp.z - weft.z).abs() < room * 1.3301);
            }
        }
    }

    #[test]
    fn yarns_are_what_their_threads_are(cloth in cloths()) {
        let yarns = cloth.yarns().unwrap();
        let (ends, picks) = (cloth.warp().len(), cloth.weft().len());
        let [width, height] = cloth.size_mm().map(|size| size as f32);
        prop_assert_eq!(yarns.points().len() as u64, cloth.point_count());
        prop_assert_eq!(yarns.layout().yarns().len(), ends + picks);
        for (number, yarn) in yarns.layout().yarns().iter().enumerate() {
            let points = yarns.yarn_points(number).unwrap();
            let sources = &yarns.sources().unwrap()[yarns.range(number).unwrap()];
            let (first, last) = (points[0], points[points.len() - 1]);
            let (thread, origin, across) = if number < ends {
                prop_assert_eq!((points.len(), first.y), (picks + 2, 0.0));
                prop_assert!((last.y - height).abs() < 1e-5 && points.is_sorted_by(|a, b| a.y < b.y));
                (cloth.warp()[number], Origin::End(number as u32 + 1), points.iter().all(|p| p.x == first.x))
            } else {
                prop_assert_eq!((points.len(), first.x), (ends + 2, 0.0));
                prop_assert!((last.x - width).abs() < 1e-5 && points.is_sorted_by(|a, b| a.x < b.x));
                let pick = number - ends;
                (cloth.weft()[pick], Origin::Pick(pick as u32 + 1), points.iter().all(|p| p.y == first.y))
            };
            prop_assert!(across, "{} is not straight", origin);
            prop_assert_eq!((yarn.origin, yarn.material, yarn.section), (origin, thread.material, thread.section));
            prop_assert_eq!((yarn.closed, yarn.twist), (false, thread.twist));
            let radius = |point: &ControlPoint| point.half_width() / thread.radius_mm;
            prop_assert!(points.iter().all(|point| (radius(point) - 1.0).abs() <= 1.0 / 2048.0));
            prop_assert!(points.iter().all(|point| point.half_width() == point.half_height()));
            prop_assert_eq!((first.z, last.z), (0.0, 0.0));
            let open: Vec<_> = (0..sources.len()).filter(|&k| sources[k] == NO_CROSSING).collect();
            prop_assert_eq!(open, [0, sources.len() - 1]);
        }
    }
}

proptest! {
    #[test]
    fn cloth_that_is_turned_over_left_to_right_is_its_mirror_image(cloth in cloths()) {
        let [ends, picks] = [cloth.warp().len(), cloth.weft().len()];
        let mirrored = Drawdown::from_fn(ends, picks, |end, pick| cloth.drawdown().up(ends - 1 - end, pick));
        let warp: Vec<_> = cloth.warp().iter().rev().copied().collect();
        let mut mirrored = woven(mirrored.unwrap(), warp, cloth.weft().to_vec()).unwrap();
        mirrored.set_shape(cloth.shape());
        prop_assert!((mirrored.size_mm()[0] - cloth.size_mm()[0]).abs() < 1e-9);
        let width = cloth.size_mm()[0] as f32;
        let (one, other) = (cloth.yarns().unwrap(), mirrored.yarns().unwrap());
        for end in 0..ends {
            for (a, b) in one.yarn_points(end).unwrap().iter().zip(other.yarn_points(ends - 1 - end).unwrap()) {
                prop_assert!((a.x + b.x - width).abs() < 1e-5 && a.y == b.y, "end {}: {:?} {:?}", end, a, b);
            }
        }
        let [gaps, mut back] = [&cloth, &mirrored].map(|cloth| cloth.pitches().warp);
        back.reverse();
        for (gap, back) in gaps.iter().zip(&back) {
            prop_assert!((gap.pitch_mm - back.pitch_mm).abs() < 1e-12 && gap.beside_mm == back.beside_mm);
        }
    }
}

/// Six columns of 1 mm and six of 2 mm are 18 mm wide together, and all ends lie 1.5 mm apart.
#[test]
fn thick_and_thin_ends_lie_in_the_middle_of_their_columns() {
    let warp: Vec<_> = [Thread::new(1.0, 0.25), Thread::new(2.0, 0.6)].into_iter().cycle().take(12).collect();
    let cloth = woven(plain(12, 2), warp, vec![Thread::new(3.0, 0.15); 2]).unwrap();
    assert_eq!(cloth.size_mm(), [18.0, 6.0]);
    let middles: Vec<_> = (0..12).map(|end| 0.5 + 1.5 * f64::from(end)).collect();
    assert_eq!(cloth.middles_mm().warp, middles);
    assert!(cloth.pitches().warp.iter().all(|gap| gap.pitch_mm == 1.5));
    // Two neighbouring ends need half their diameters together, 0.85 mm, and room for the weft
    // between them.
    assert_eq!(cloth.warnings(), []);
}

fn plain(ends: usize, picks: usize) -> Drawdown {
    Weave::parse("plain").unwrap().drawdown(ends, picks).unwrap()
}

const THREAD: Thread = Thread::new(1.0, 0.2);

#[test]
fn the_papers_cloth_has_the_papers_count() {
    // 300 ends have 150 + 2 control points each, and 150 picks have 300 + 2 each.
    let mut cloth = woven(plain(300, 150), vec![THREAD; 300], vec![THREAD; 150]).unwrap();
    cloth.set_shape(Shape::Crossing);
    assert_eq!(cloth.point_count(), 300 * 152 + 150 * 302);
    assert_eq!(cloth.yarns().unwrap().layout().offsets()[300], 300 * 152);
}

#[test]
fn what_is_wrong_with_a_thread_is_named() {
    let with = |change: fn(&mut Thread)| {
        let mut weft = vec![THREAD; 3];
        change(&mut weft[1]);
        woven(plain(2, 3), vec![THREAD; 2], weft).unwrap_err()
    };
    let thread = Origin::Pick(2);
    for spacing in [0.0, -1.0, f64::INFINITY, 1e-7, 1e7] {
        let mut weft = vec![THREAD; 3];
        weft[1].spacing_mm = spacing;
        let error = woven(plain(2, 3), vec![THREAD; 2], weft).unwrap_err();
        assert!(
            matches!(error, FabricError::Woven(WovenError::Spacing { thread: t, spacing_mm, .. }) if t == thread && spacing_mm == spacing)
        );
    }
    let error = with(|thread| thread.spacing_mm = f64::NAN);
    assert_eq!(error.to_string(), "spacing of pick 2 is NaN mm, outside 0.000001 to 1000000 mm");
    assert!(
        matches!(with(|t| t.radius_mm = f32::NAN), FabricError::Thread(ThreadError::Radius { thread: t, .. }) if t == thread)
    );
    assert!(
        matches!(with(|t| t.radius_mm = 0.0), FabricError::Thread(ThreadError::Radius { thread: t, .. }) if t == thread)
    );
    assert!(
        matches!(with(|t| t.twist = f32::NAN), FabricError::Thread(ThreadError::Twist { thread: t, .. }) if t == thread)
    );
    assert!(
        matches!(with(|t| t.stiffness = 0.0), FabricError::Woven(WovenError::Stiffness { thread: t, .. }) if t == thread)
    );
    let missing = with(|t| t.material = 2);
    assert_eq!(
        missing,
        FabricError::Thread(ThreadError::UnknownMaterial { thread, material: 2, materials: 2 })
    );
    let missing = with(|t| t.section = u32::MAX);
    assert_eq!(
        missing,
        FabricError::Thread(ThreadError::UnknownSection { thread, section: u32::MAX, sections: 2 })
    );
}

#[test]
fn what_is_wrong_with_the_whole_is_named() {
    let error = woven(plain(2, 3), vec![THREAD; 3], vec![THREAD; 3]).unwrap_err();
    assert_eq!(error, FabricError::Woven(WovenError::ThreadCount { set: "end", threads: 3, planned: 2 }));
    let error = woven(plain(2, 3), vec![THREAD; 2], vec![]).unwrap_err();
    assert_eq!(error, FabricError::Woven(WovenError::ThreadCount { set: "pick", threads: 0, planned: 3 }));

    let wide = Thread { spacing_mm: 1e6, ..THREAD };
    let error = woven(plain(2000, 1), vec![wide; 2000], vec![THREAD]).unwrap_err();
    assert!(matches!(error, FabricError::Woven(WovenError::Extent { set: "ends", extent_mm: 2e9, .. })));

    let sections = vec![Section::Circle, Section::Ellipse { aspect: f32::NAN }];
    let error = Woven::new(plain(1, 1), vec![THREAD], vec![THREAD], vec![Material::default()], sections);
    assert!(matches!(error, Err(FabricError::Thread(ThreadError::Section { section: 1, .. }))));

    // 2^32 crossings are allowed in a drawdown, but a cloth of them would have twice as many
    // control points.
    let (ends, picks) = (65_536, 65_536);
    let error = woven(Drawdown::new(ends, picks).unwrap(), vec![THREAD; ends], vec![THREAD; picks]);
    assert!(
        matches!(error, Err(FabricError::Woven(WovenError::Points { points, .. })) if points == 2 * (65_536 * 65_536 + 2 * 65_536))
    );
}

#[test]
fn cloth_at_the_edge_of_what_is_taken_gives_sound_yarns() {
    for (spacing_mm, radius_mm) in [(1e-6, 1e-4), (1e6, 3e4), (1e-6, 3e4), (1e6, 1e-4)] {
        let thread = Thread::new(spacing_mm, radius_mm);
        let mut cloth = woven(plain(5, 4), vec![thread; 5], vec![thread; 4]).unwrap();
        for (shape, selvedge) in [(Shape::Crossing, false), (Shape::Round, false), (Shape::Round, true)] {
            cloth.set_shape(shape);
            cloth.set_selvedge(selvedge);
            assert!(!matches!(cloth.yarns(), Err(FabricError::Yarns(YarnError::NotFinite { .. }))));
            assert!(cloth.yarns().is_ok(), "spacing {spacing_mm} mm, radius {radius_mm} mm");
        }
    }
}

#[test]
fn threads_in_one_place_give_sound_yarns() {
    // A kilometre from the edge, a nanometre is lost in single precision, so that ends 2 to 5 lie
    // at the same place.
    let mut warp = vec![Thread::new(1e-6, 0.1); 6];
    (warp[0].spacing_mm, warp[5].spacing_mm) = (1e6, 1e6);
    let weft = vec![Thread::new(1.0, 0.1); 3];
    for up in [0, 1] {
        let drawdown = Drawdown::from_fn(6, 3, |end, pick| (end / 2 + pick) % 2 == up).unwrap();
        let mut cloth = woven(drawdown, warp.clone(), weft.clone()).unwrap();
        cloth.set_shape(Shape::Round);
        let yarns = cloth.yarns().unwrap();
        assert_eq!(yarns.points().len() as u64, cloth.point_count());
        assert!(texere_contact::clearance(&yarns, &Settings::default()).is_ok());
    }
}

#[test]
fn a_section_that_is_not_sound_changes_nothing() {
    let mut cloth = woven(plain(2, 2), vec![THREAD; 2], vec![Thread { section: 1, ..THREAD }; 2]).unwrap();
    let before = cloth.clone();
    assert!(cloth.set_section(Section::Ellipse { aspect: 0.0 }).is_err());
    assert_eq!(cloth, before);
    cloth.set_section(Section::plied(3)).unwrap();
    assert_eq!(cloth.sections(), [Section::plied(3)]);
    assert!(cloth.yarns().is_ok());
}

#[test]
fn threads_that_just_fit_are_not_warned_of() {
    // The threads are spaced by twice their thickness, a little more than the closest at which
    // crossing threads pass.
    let thread = Thread::new(0.3, 0.075);
    assert_eq!(woven(plain(6, 6), vec![thread; 6], vec![thread; 6]).unwrap().warnings(), []);
}

#[test]
fn one_warning_stands_for_all_threads_alike() {
    let mut warp = vec![Thread::new(1.0, 0.1); 1000];
    for (end, radius) in [(99, 0.95), (100, 0.1), (500, 1.5)] {
        warp[end].radius_mm = radius;
    }
    let warnings = woven(plain(1000, 5), warp, vec![Thread::new(10.0, 0.1); 5]).unwrap().warnings();
    let crowded: Vec<_> =
        warnings.iter().filter(|warning| matches!(warning, FabricWarning::Crowded { .. })).collect();
    // End 100 and end 501 each pierce the ends on both sides. Each pair counts for its second
    // thread.
    assert_eq!(crowded.len(), 1);
    assert_eq!(
        crowded[0].to_string(),
        "threads pierce their neighbours: end 100 and 3 more; worst is end 501, which needs 1.6000 mm and has 1.0000 mm"
    );

    // Wide sections lie flat, and pierce their neighbours at a spacing at which round ones do not.
    let flat = Thread { section: 1, ..Thread::new(1.0, 0.4) };
    let warnings = woven(plain(4, 4), vec![flat; 4], vec![Thread::new(10.0, 0.1); 4]).unwrap().warnings();
    assert!(
        matches!(warnings[0], FabricWarning::Crowded { count: 3, first: Origin::End(2), .. }),
        "{warnings:?}"
    );

    // Most real cloth is denser than cloth of round threads can be.
    let denim = Thread::new(0.3, 0.1);
    let warnings = woven(plain(4, 4), vec![denim; 4], vec![Thread::new(0.6, 0.1); 4]).unwrap().warnings();
    assert_eq!(warnings.len(), 1);
    assert!(matches!(
        warnings[0],
        FabricWarning::Jammed { count: 3, first: Origin::End(2), worst: Origin::End(2), .. }
    ));
}
