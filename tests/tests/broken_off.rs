//! The CPU's settlers can be broken off while a pass or a list of neighbours is being made.

use std::ops::ControlFlow;
use std::sync::Arc;

use texere_core::backend::WorkWatch;
use texere_core::crossings::{self, CrossingThread, Crossings, CrossingsPass, CrossingsPlan};
use texere_core::settling::{self, Form, Pass, Place, Settler, Settling, SettlingPlan, tag};
use texere_core::{Backend, ControlPoint, Yarn, Yarns};
use texere_cpu::{ParallelBackend, SerialBackend};

fn devices() -> [Box<dyn Backend>; 2] {
    [Box::new(SerialBackend::new()), Box::new(ParallelBackend::open().expect("the CPU"))]
}

/// The number of the CPU's threads. Cloths grow with it, so that every thread has several tasks.
fn threads() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// Rows of two zigzag yarns, one above the other and closer than they may be. Each yarn has 1024
/// control points.
fn zigzags(rows: usize) -> Arc<SettlingPlan> {
    let mut yarns = Yarns::builder();
    for (row, z) in (0..rows).flat_map(|row| [(row, 0.0), (row, 0.3)]) {
        let point =
            |number: usize| ControlPoint::new(number as f32, row as f32 + 0.2 * (number % 2) as f32, z, 0.2);
        yarns.yarn(Yarn::default(), &(0..1024).map(point).collect::<Vec<_>>());
    }
    let yarns = yarns.build().expect("yarns");
    Arc::new(SettlingPlan::new(&Settling::new(&yarns)).expect("a plan"))
}

/// Plain weave of `ends` ends and a hundred picks.
fn plain(ends: usize) -> Arc<CrossingsPlan> {
    let thread = CrossingThread::new(0.45, 0.3);
    let ups = (0..ends * 100).map(|number| (number / ends + number % ends).is_multiple_of(2)).collect();
    Arc::new(CrossingsPlan::new(&Crossings::new(ups, vec![thread; ends], vec![thread; 100])).expect("a plan"))
}

fn places(plan: &SettlingPlan) -> Vec<Place> {
    let all = plan.places().iter().zip(plan.tags());
    all.filter(|(_, tags)| *tags & tag::POINT != 0).map(|(place, _)| *place).collect()
}

/// The pass that these tests make.
const PASS: Pass = Pass { form: Form::Weighted, growth: 1.0, ease: 0.5, momentum: 0.8 };

/// The number of times that `work` asks whether to go on. The answer to question number `last`, if
/// any, is `Break`.
fn questions(last: Option<usize>, work: impl FnOnce(WorkWatch<'_>) -> bool) -> usize {
    let mut asked = 0;
    let broken = work(&mut || {
        asked += 1;
        if last == Some(asked) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert_eq!(broken, last.is_some(), "{last:?} of {asked}");
    asked
}

fn list(settler: &mut dyn Settler, last: Option<usize>) -> usize {
    questions(last, |watch| settler.list_watched(1.0, watch).expect("a list").is_break())
}

fn pass(settler: &mut dyn Settler, last: Option<usize>) -> usize {
    questions(last, |watch| settler.pass_watched(&PASS, watch).expect("a pass").is_break())
}

/// A list or a pass of a settling ends at the question that breaks it off, and then no point has
/// moved. The number of questions grows with the cloth.
#[test]
fn settlings_are_broken_off_within_a_pass() {
    for device in devices() {
        let asked = [1, 4].map(|times| {
            let plan = zigzags(16 * times * threads());
            let mut settler = device.settler(Arc::clone(&plan)).expect("a settler");
            settler.upload(&places(&plan)).expect("an upload");
            let lists = list(settler.as_mut(), None);
            let passes = pass(settler.as_mut(), None);
            if times == 1 {
                settler.upload(&places(&plan)).expect("an upload");
                for last in [1, lists / 2, lists] {
                    assert_eq!(list(settler.as_mut(), Some(last)), last);
                }
                list(settler.as_mut(), None);
                for last in [1, 2, passes / 2, passes] {
                    assert_eq!(pass(settler.as_mut(), Some(last)), last);
                }
                let mut found = places(&plan);
                settler.read(&mut found).expect("places");
                assert!(found == places(&plan), "points have moved");
            }
            [lists, passes]
        });
        let [few, many] = asked;
        assert!(few[0] >= 2 && few[1] >= 3, "{few:?}");
        assert!(many[0] >= 3 * few[0] && many[1] >= 3 * few[1], "{asked:?}");
    }
}

/// A settling whose caller breaks off in the middle of a pass leaves the best places so far.
#[test]
fn settlings_that_are_broken_off_leave_the_places_that_they_kept() {
    for device in devices() {
        let plan = zigzags(16 * threads());
        for last in [1, 2, 30, 200] {
            let mut settler = device.settler(Arc::clone(&plan)).expect("a settler");
            let (mut within, mut whole) = (0, 0);
            let rest = settling::settle(&plan, settler.as_mut(), |_, seen| {
                whole += u32::from(seen.is_some());
                within += u32::from(seen.is_none());
                if within == last { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            });
            let rest = rest.expect("a settling");
            assert_eq!((within, rest.passes, rest.at_rest), (last, whole, false));
            let mut found = places(&plan);
            settler.read(&mut found).expect("places");
            assert!(found == places(&plan), "{last}: yarns that grow are not kept");
        }
    }
}

/// A pass of crossings ends at the question that breaks it off. The number of questions grows with
/// the cloth.
#[test]
fn crossings_are_broken_off_within_a_pass() {
    for device in devices() {
        let asked = [1, 4].map(|times| {
            let plan = plain(400 * times * threads());
            let mut settler = device.crossings_settler(Arc::clone(&plan)).expect("a settler");
            let mut passes = |last| {
                settler.upload(&plan.start().expect("a start")).expect("an upload");
                let pass = CrossingsPass::of(0);
                questions(last, |watch| settler.pass_watched(&pass, watch).expect("a pass").is_break())
            };
            let all = passes(None);
            for last in [1, 2, all / 2, all] {
                assert_eq!(passes(Some(last)), last);
            }
            all
        });
        assert!(asked[0] >= 2 && asked[1] >= 3 * asked[0], "{asked:?}");
        let plan = plain(100);
        let mut settler = device.crossings_settler(Arc::clone(&plan)).expect("a settler");
        let rest = crossings::settle(&plan, settler.as_mut(), |_, _| ControlFlow::Break(()));
        assert_eq!(rest.expect("rest").passes, 0);
    }
}
