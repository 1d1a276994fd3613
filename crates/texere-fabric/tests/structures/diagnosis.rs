//! Faults are named by thread and crossing, and a cure leaves exactly the faults that it lists.

use std::ops::ControlFlow;

use texere_core::{Material, Origin, Section, Settings};
use texere_cpu::ParallelBackend;
use texere_fabric::{
    BySet, ClothFault, Crossing, Diagnosis, Finish, Relief, Remedy, Shape, Structure, Thread, Weave, Woven,
    WovenDesign,
};

/// Cloth with yarns of 0.3 mm at the given spacings of ends and picks.
fn cloth(weave: &str, [ends, picks]: [f64; 2]) -> Woven {
    let drawdown = Weave::parse(weave).unwrap().drawdown(20, 16).unwrap();
    let (warp, weft) = (vec![Thread::new(ends, 0.15); 20], vec![Thread::new(picks, 0.15); 16]);
    Woven::new(drawdown, warp, weft, vec![Material::default()], vec![Section::Circle]).unwrap()
}

fn diagnose(cloth: &Woven) -> Diagnosis {
    cloth.diagnose(0.985, |_| ControlFlow::Continue(())).unwrap()
}

fn design(cloth: &Woven, relief: Relief) -> WovenDesign {
    WovenDesign::new(cloth.clone(), None, relief).unwrap()
}

#[test]
fn clean_cloth_has_no_faults() {
    let found = diagnose(&cloth("plain", [0.9, 0.9]));
    assert!(found.faults.kinds().is_empty(), "{:?}", found.faults);
    assert!(found.clearance.min >= 0.985 && found.clearance.crowd.is_none());
}

#[test]
fn faults_are_named_by_thread_and_crossing() {
    let jammed = cloth("3/1", [0.4, 0.66]);
    let faults = diagnose(&jammed).faults;
    assert_eq!(
        faults.kinds(),
        [ClothFault::Pierces, ClothFault::Folds, ClothFault::Jams, ClothFault::InsideOut]
    );
    let jams = faults.jams.unwrap();
    assert_eq!((jams.ends, jams.picks, jams.threads[0].thread), (19, 0, Origin::End(2)));
    // A contact of an end and a pick lies at their crossing or at the crossing beside it.
    let contact = faults.pierces[0];
    let [Origin::End(end), Origin::Pick(pick)] = contact.places.map(|place| place.thread) else {
        panic!("{contact:?}")
    };
    let [on_end, on_pick] = contact.places.map(|place| place.crossing.unwrap());
    assert!(on_end.end == end && on_pick.pick == pick, "{contact:?}");
    let BySet { warp: middles_x, weft: middles_y } = jammed.middles_mm();
    let Crossing { end, pick } = on_end;
    let [x, y, _] = contact.middle_mm();
    assert!((x - middles_x[end as usize - 1]).abs() < 0.4 && (y - middles_y[pick as usize - 1]).abs() < 0.66);
}

#[test]
fn a_weft_that_turns_round_is_named_by_its_picks() {
    let mut dense = cloth("plain", [0.45, 0.5]);
    dense.set_selvedge(true);
    let clearance = dense
        .clearance(&dense.yarns().unwrap(), &Settings::default(), |_| ControlFlow::Continue(()))
        .unwrap();
    let picks = clearance.worst.iter().flat_map(|contact| contact.places).filter_map(|place| match place {
        place if matches!(place.thread, Origin::Pick(_)) => Some(place),
        _ => None,
    });
    let middles = &dense.middles_mm().weft;
    let mut others = 0;
    for place in picks {
        let Origin::Pick(pick) = place.thread else { continue };
        others += usize::from(pick > 1);
        let off = (place.position_mm[1] - middles[pick as usize - 1]).abs();
        assert!(off <= 0.25 + 1e-6, "{place:?}");
    }
    assert!(others > 0, "one yarn, but not one name");
}

#[test]
fn each_cure_leaves_what_it_says() {
    let jammed = cloth("3/1", [0.4, 0.66]);
    let (found, whole) = (diagnose(&jammed), design(&jammed, Relief::Report));
    let cures = whole.cures(&found, |_| ControlFlow::Continue(()));
    assert!(cures.len() > 2, "{cures:?}");
    for cure in cures {
        let mut changed = jammed.clone();
        match &cure.remedy {
            Remedy::Spacing { spacing_mm, .. } => changed = cloth("3/1", spacing_mm.into_array()),
            Remedy::Relief { relief, .. } => drop(changed.relieve(*relief).unwrap()),
            Remedy::Circle => changed.set_section(Section::Circle).unwrap(),
            Remedy::Flatness(flatness) => changed.set_flatness(*flatness).unwrap(),
            _ => continue,
        }
        assert_eq!(diagnose(&changed).faults.kinds(), cure.leaves, "{:?}", cure.remedy);
    }
    // A design that is already relieved does not get relief as a cure.
    let relieved = design(&jammed, Relief::Flatten);
    let left = relieved.cures(&diagnose(relieved.cloth()), |_| ControlFlow::Continue(()));
    assert!(relieved.is_relieved() && !left.iter().any(|cure| matches!(cure.remedy, Remedy::Relief { .. })));
}

/// Cures of cloth at rest cure the whole cloth once it is at rest, and not only as it is woven.
#[test]
fn cures_at_rest_are_clean_at_rest() {
    let (device, finish, go_on) =
        (ParallelBackend::open().unwrap(), Finish::default(), |_| ControlFlow::Continue(()));
    let rested = |cloth: &Woven| {
        let structure = Structure::Woven(design(cloth, Relief::Report));
        let finished = structure.settle(&finish, 0.0, &device, go_on).unwrap();
        structure.diagnose_finished(&finished, 0.985, go_on).unwrap()
    };
    for (weave, pitch) in [("plain", [0.18, 0.18]), ("3/1", [0.12, 0.3]), ("2/2", [0.11, 0.11])] {
        let dense = cloth(weave, pitch);
        let found = rested(&dense);
        assert!(!found.faults.kinds().is_empty(), "{weave}");
        let mut shares = Vec::new();
        let cures = design(&dense, Relief::Report).cures_at_rest(&found, &finish, 0.0, &device, |share| {
            shares.push(share);
            ControlFlow::Continue(())
        });
        assert!(shares.is_sorted() && shares.iter().all(|share| (0.0..=1.0).contains(share)), "{shares:?}");
        assert_eq!(cures.len(), 2, "{weave}");
        for cure in cures {
            let changed = match cure.remedy {
                Remedy::Spacing { spacing_mm, .. } => cloth(weave, spacing_mm.into_array()),
                Remedy::Diameter { thickest_mm } => {
                    let threads = |set: &[Thread]| -> Vec<Thread> {
                        let thin =
                            |each: &Thread| Thread { radius_mm: (thickest_mm[1] / 2.0) as f32, ..*each };
                        set.iter().map(thin).collect()
                    };
                    let (warp, weft) = (threads(dense.warp()), threads(dense.weft()));
                    let drawdown = dense.drawdown().clone();
                    let sections = vec![Section::Circle];
                    Woven::new(drawdown, warp, weft, vec![Material::default()], sections).unwrap()
                }
                other => panic!("{other:?}"),
            };
            let after = rested(&changed);
            println!("{weave}: {:?} -> {:?}", found.faults.kinds(), cure);
            assert!(after.faults.kinds().is_empty(), "{weave} {:?}: {:?}", cure.remedy, after.faults.kinds());
        }
        let stopped = design(&dense, Relief::Report)
            .cures_at_rest(&found, &finish, 0.0, &device, |_| ControlFlow::Break(()));
        assert!(stopped.is_empty());
    }
}

#[test]
fn the_search_for_cures_stops_when_it_is_asked_to() {
    let mut corners = cloth("3/1", [0.59, 0.59]);
    corners.set_shape(Shape::Crossing);
    let structure = Structure::Woven(design(&corners, Relief::Report));
    let found = structure.diagnose(0.985, |_| ControlFlow::Continue(())).unwrap();
    let mut calls = 0;
    let cures = structure.cures(&found, |_| {
        calls += 1;
        ControlFlow::Break(())
    });
    assert_eq!((calls, cures.len()), (1, 1), "{cures:?}");
    assert_eq!(cures[0].remedy, Remedy::Shape(Shape::Round));
}
