//! Jammed cloth before and after relief.

use texere_core::{Material, Origin, Section};
use texere_fabric::{
    BySet, Crimp, FabricError, Relief, Shape, Thread, ThreadError, Weave, Woven, WovenDesign, WovenError,
};

use crate::oracle::{pierce, round_clearance};

const UNCHANGED: BySet<f32> = BySet { warp: 1.0, weft: 1.0 };

fn cloth(weave: &str, [end, pick]: [Thread; 2], section: Section) -> Woven {
    let drawdown = Weave::parse(weave).unwrap().drawdown(8, 8).unwrap();
    let mut cloth =
        Woven::new(drawdown, vec![end; 8], vec![pick; 8], vec![Material::default()], vec![section]).unwrap();
    cloth.set_shape(Shape::Round);
    cloth
}

/// Cloth of ends and picks 0.2 mm thick, at the given pitches in diameters.
fn dense(weave: &str, ends: f64, picks: f64) -> Woven {
    cloth(weave, [Thread::new(ends * 0.2, 0.1), Thread::new(picks * 0.2, 0.1)], Section::Circle)
}

#[test]
fn the_least_pitch_is_peirces() {
    // Two sets of round threads alike need √3 diameters, whatever the weave. If a pick is 0.6 times
    // as thick as an end, both sets need 1.386 diameters of an end.
    let report = dense("3/1", 3.0, 1.5).relieve(Relief::Report).unwrap();
    for set in report.before.into_array() {
        assert!((set.pitch_min_mm / 0.2 - 3f64.sqrt()).abs() < 1e-6, "{set:?}");
    }
    assert_eq!(report.before.map(|set| set.jammed).into_array(), [0, 7]);
    assert_eq!(report.before.weft.tightest, Some(Origin::Pick(2)));
    assert_eq!((report.before, report.scaled, report.widened), (report.after, 1.0, UNCHANGED));

    let mut unequal = cloth("plain", [Thread::new(0.6, 0.1), Thread::new(0.6, 0.06)], Section::Circle);
    unequal.set_crimp(Crimp::WarpShare(0.5)).unwrap();
    for set in unequal.relieve(Relief::Report).unwrap().before.into_array() {
        assert!((set.pitch_min_mm / 0.2 - 1.3856).abs() < 1e-4, "{set:?}");
    }

    // Ellipses twice as wide as high need 1.3 times their width.
    let ellipse = Section::Ellipse { aspect: 2.0 };
    let report = cloth("plain", [Thread::new(1.0, 0.1); 2], ellipse).relieve(Relief::Report).unwrap();
    assert!((report.before.warp.pitch_min_mm / (0.2 * 2f64.sqrt()) - 1.299).abs() < 1e-3);
}

#[test]
fn nothing_between_two_threads_jams_nothing() {
    // Two pairs of ends and two pairs of picks, 0.35 mm from pair to pair. The threads of a pair
    // touch, which jams nothing, because no thread passes between them.
    let drawdown = Weave::parse("2/2(2+2)").unwrap().drawdown(4, 4).unwrap();
    let set: Vec<_> = [0.05, 0.35, 0.35, 0.05].map(|spacing| Thread::new(spacing, 0.1)).into();
    let mut cloth =
        Woven::new(drawdown, set.clone(), set, vec![Material::default()], vec![Section::Circle]).unwrap();
    assert_eq!(cloth.relieve(Relief::Report).unwrap().before.map(|set| set.jammed).into_array(), [0, 0]);
}

#[test]
fn crimp_goes_where_the_cloth_is_dense() {
    // In cloth with a dense warp the ends bend more, the picks straighten, and no thread changes
    // its size.
    let mut cloth = dense("plain", 1.5, 2.4);
    let (threads, report) = (cloth.clone(), cloth.relieve(Relief::Flatten).unwrap());
    assert_eq!(report.before.map(|set| set.jammed).into_array(), [7, 0]);
    assert_eq!(report.after.map(|set| set.jammed).into_array(), [0, 0]);
    assert!(report.warp_share[1] > 0.6 && report.widened == UNCHANGED && report.scaled == 1.0, "{report:?}");
    assert_eq!((cloth.warp(), cloth.weft(), cloth.warnings().len()), (threads.warp(), threads.weft(), 0));
    assert!(round_clearance(&cloth.yarns().unwrap(), 32) > 0.99);
}

#[test]
fn flattening_keeps_the_area_and_clears_the_surfaces() {
    // A share of the crimp that is given stays. Picks have to become flatter to pass between the
    // ends.
    let mut cloth = dense("plain", 1.6, 3.0);
    cloth.set_crimp(Crimp::WarpShare(0.5)).unwrap();
    let report = cloth.relieve(Relief::Flatten).unwrap();
    assert_eq!(report.before.map(|set| set.jammed).into_array(), [7, 0]);
    assert_eq!(report.after.map(|set| set.jammed).into_array(), [0, 0]);
    assert_eq!((report.warp_share, report.widened.warp, report.scaled), ([0.5; 2], 1.0, 1.0));
    let [half_width, half_height] = cloth.weft()[0].halves_mm();
    assert!(report.widened.weft > 1.1, "{report:?}");
    assert!((half_width / (0.1 * report.widened.weft) - 1.0).abs() < 1e-3, "{half_width}, {report:?}");
    assert!((half_width * half_height - 0.01).abs() < 1e-6);
    assert_eq!(cloth.sections(), [Section::Circle]);
    assert_eq!((cloth.warnings().len(), cloth.weft()[0].radius_mm), (0, 0.1));
    assert!(!pierce(&cloth.yarns().unwrap(), 8, 24, 0.985));
}

#[test]
fn what_can_not_be_flattened_is_told() {
    let mut cloth = dense("plain", 1.2, 1.2);
    let report = cloth.relieve(Relief::Flatten).unwrap();
    assert_eq!(report.after.map(|set| set.jammed).into_array().into_iter().max(), Some(7));
}

/// Threads of two plies are flattened, and their section stays as it is.
#[test]
fn plies_are_flattened_as_they_are() {
    let plies = Section::plied(2);
    let mut lobed = cloth_of(plies.clone());
    let report = lobed.relieve(Relief::Flatten).unwrap();
    assert!(report.widened != UNCHANGED, "{report:?}");
    assert_eq!(lobed.sections(), [plies]);
}

fn cloth_of(section: Section) -> Woven {
    cloth("plain", [Thread::new(0.24, 0.1), Thread::new(0.6, 0.1)], section)
}

#[test]
fn shrinking_makes_everything_fit() {
    for (ends, picks) in [(1.2, 1.2), (0.5, 3.0), (1.6, 1.6)] {
        let mut cloth = dense("3/1", ends, picks);
        let report = cloth.relieve(Relief::Shrink).unwrap();
        assert_eq!(report.after.map(|set| set.jammed).into_array(), [0, 0], "{ends}, {picks}");
        assert!(report.scaled < 1.0 && cloth.warnings().is_empty(), "{report:?}");
        assert!((cloth.warp()[3].radius_mm / 0.1 - report.scaled).abs() < 1e-6);
        let clearance = round_clearance(&cloth.yarns().unwrap(), 32);
        assert!((0.99..1.1).contains(&clearance), "{ends}, {picks}: {clearance}");
        // A second relief changes nothing.
        assert_eq!(cloth.relieve(Relief::Shrink).unwrap().scaled, 1.0);
    }
}

#[test]
fn threads_too_thin_to_shrink_are_left_alone() {
    let mut cloth = cloth("plain", [Thread::new(1e-6, 1.0), Thread::new(1.0, 1e-4)], Section::Circle);
    let before = cloth.clone();
    let error = cloth.relieve(Relief::Shrink).unwrap_err();
    assert!(
        matches!(error, FabricError::Thread(ThreadError::Radius { thread: Origin::End(1), .. })),
        "{error}"
    );
    assert_eq!(cloth, before);
}

/// Other lifts jam other threads. After a change of a lift, relief starts from the cloth that was
/// given. A lift and a colour that the cloth does not have are refused.
#[test]
fn a_design_with_another_lift_is_one_that_was_given_so() {
    let given = dense("plain", 1.2, 1.2);
    let mut edited = WovenDesign::new(given.clone(), None, Relief::Shrink).unwrap();
    edited.set_lift(3, 5, !given.drawdown().up(3, 5)).unwrap();
    let mut drawdown = given.drawdown().clone();
    drawdown.set(3, 5, !given.drawdown().up(3, 5)).unwrap();
    let set = |threads: &[Thread]| threads.to_vec();
    let mut fresh = Woven::new(
        drawdown,
        set(given.warp()),
        set(given.weft()),
        vec![Material::default()],
        vec![Section::Circle],
    )
    .unwrap();
    fresh.set_shape(Shape::Round);
    let fresh = WovenDesign::new(fresh, None, Relief::Shrink).unwrap();
    assert!(fresh.is_relieved() && fresh.cloth() != edited.as_given());
    assert_eq!(edited.cloth(), fresh.cloth());
    assert_eq!(edited.as_given(), fresh.as_given());

    let before = edited.cloth().clone();
    let error = edited.set_lift(8, 0, true).unwrap_err();
    assert_eq!(error, FabricError::Woven(WovenError::NoCrossing { end: 9, pick: 1, ends: 8, picks: 8 }));
    edited.set_color(0, [1, 2, 3]).unwrap();
    assert_eq!(edited.cloth().materials()[0].srgb, [1, 2, 3]);
    assert_eq!(edited.as_given().materials()[0].srgb, [1, 2, 3]);
    let error = edited.set_color(1, [1, 2, 3]).unwrap_err();
    assert_eq!(error, WovenError::NoMaterial { material: 1, materials: 1 });
    assert_eq!(edited.cloth().yarns().unwrap().points(), before.yarns().unwrap().points());
}
