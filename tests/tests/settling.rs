//! Yarns come to rest: every start of the list on the `cpu` backend, by independent checks; and all
//! schedules of the CPU give the same bits.

use std::ops::ControlFlow;
use std::sync::Arc;

use glam::DVec3;
use texere_conformance::rest::{
    CROSSED, Chart, Ends, Gauge, Length, Start, StartYarn, Weave, check, lace, linking, random_misses,
    settle_start, settling_plan, starts, weft_knit, woven,
};
use texere_core::backend::NullBackend;
use texere_core::settling::{
    Chord, Form, Listed, Pass, Place, Settler, Settling, SettlingPlan, SettlingSeen, settle, settled, tag,
};
use texere_core::{Backend, Boundary, BoundaryError, ControlPoint, SettlingError, Yarn, Yarns};
use texere_cpu::{ParallelBackend, SerialBackend};

fn cpu() -> ParallelBackend {
    ParallelBackend::open().expect("the CPU")
}

/// Faults of a settled start, by an independent check of splines, distances and linking in f64.
fn lacking(start: &Start) -> Option<String> {
    let (rest, points) = settle_start(start, &cpu(), |_, _| {});
    let report = check(start, &points);
    let linked = linking(start, &start.points(), &points);
    let length = match start.length {
        Length::Held => report.stretch.abs(),
        Length::Given(factor) => ((1.0 + report.stretch) / factor - 1.0).abs(),
        Length::Free => 0.0,
    };
    for &(yarn, point) in &start.pinned {
        let moved = points[yarn][point].distance(start.yarns[yarn].points[point]);
        assert!(moved < 1e-4, "{}: a pinned point moved {moved} mm", start.name);
    }
    // The ends of an open piece of jammed weave are held, so that its bends can't open.
    let bend = if start.name == "plain-1.8-piece" { 0.5 } else { 0.58 };
    let lacks = report.clearance < 0.98 || report.bend < bend || length > 0.01 || linked.change > CROSSED;
    lacks.then(|| format!("{}: {rest:?} {report:?} {linked:?}", start.name))
}

#[test]
fn starts_come_to_rest() {
    let failed: Vec<_> = starts().iter().filter_map(lacking).collect();
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

/// Large cloths with many moving points: a knit of random misses, and lace whose repeats settle
/// together. The worst points decide whether a cloth is at rest.
#[test]
fn large_cloths_come_to_rest() {
    let failed: Vec<_> = [random_misses(30, 1), lace(25)].iter().filter_map(lacking).collect();
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

/// A repeat of plain weave as placed, with flattened yarns.
fn flattened_plain(pitch: f64) -> (Start, Yarns) {
    let start = woven("plain", Weave { size: 4, step: 1, order: 2, pitch }, Length::Free);
    let mut yarns = Yarns::builder();
    for yarn in &start.yarns {
        let point = |at: &DVec3| {
            let radius = yarn.radius as f32;
            ControlPoint::new(at.x as f32, at.y as f32, at.z as f32, radius)
                .flattened(radius * 1.3, radius * 0.7)
        };
        yarns.yarn(Yarn::default(), &yarn.points.iter().map(point).collect::<Vec<_>>());
    }
    (start, yarns.build().expect("yarns"))
}

/// Plans that together have every case that a pass treats differently.
fn plans() -> Vec<(&'static str, Arc<SettlingPlan>)> {
    let mut plans: Vec<_> = starts()
        .iter()
        .filter_map(|start| {
            let names =
                ["jersey-3.6", "tuck-5", "lace-4x4", "jersey-5-piece", "queenscord-0.1", "plain-1.8-piece"];
            let name = names.into_iter().find(|name| *name == start.name)?;
            Some((name, settling_plan(start)))
        })
        .collect();
    assert_eq!(plans.len(), 6, "starts by name");
    let (start, yarns) = flattened_plain(2.2);
    let ends = start.yarns.iter().map(|yarn| match yarn.ends {
        Ends::Repeats(shift) => texere_core::Ends::Repeats(shift),
        Ends::Open | Ends::Closed => panic!("a repeat"),
    });
    let boundary = Boundary::new(yarns.layout(), start.repeat.map(|repeat| repeat as f32), ends.collect());
    let settling = Settling::new(&yarns).boundary(boundary.expect("a boundary")).plates(0.3);
    plans.push(("flattened, pressed", Arc::new(SettlingPlan::new(&settling).expect("a plan"))));
    let mut rings = Yarns::builder();
    for ring in 0..2 {
        let point = |k: usize| {
            let (sin, cos) = (k as f32 * std::f32::consts::TAU / 12.0).sin_cos();
            let (x, far) = (ring as f32 + cos, sin);
            let [y, z] = if ring == 0 { [far, 0.0] } else { [0.0, far] };
            ControlPoint::new(x, y, z, 0.3)
        };
        rings.yarn(Yarn { closed: true, ..Yarn::default() }, &(0..12).map(point).collect::<Vec<_>>());
    }
    let rings = rings.build().expect("yarns");
    plans.push(("linked rings", Arc::new(SettlingPlan::new(&Settling::new(&rings)).expect("a plan"))));
    plans
}

/// The positions of all control points at the start, in order.
fn places(plan: &SettlingPlan) -> Vec<Place> {
    let all = plan.places().iter().zip(plan.tags());
    all.filter(|(_, tags)| **tags & tag::POINT != 0).map(|(place, _)| *place).collect()
}

/// Eight passes of either form, in which neighbours are listed twice. The result has the measures
/// of each pass, and the positions after it.
fn eight_passes(
    plan: &SettlingPlan,
    settler: &mut dyn Settler,
    form: Form,
) -> Vec<(SettlingSeen, Vec<Place>)> {
    let mut now = places(plan);
    settler.upload(&now).expect("an upload");
    let mut all = Vec::new();
    for number in 0..8 {
        let growth = if number < 4 { 0.8 } else { 1.0 };
        if number % 4 == 0 {
            settler.list(growth).expect("a list");
        }
        let seen = settler.pass(&Pass { form, growth, ease: 0.5, momentum: 0.8 }).expect("a pass");
        settler.read(&mut now).expect("places");
        all.push((seen, now.clone()));
    }
    all
}

#[test]
fn all_schedules_of_the_cpu_give_the_same_bits() {
    for (name, plan) in plans() {
        for form in [Form::Weighted, Form::Block] {
            let mut serial = SerialBackend::new().settler(Arc::clone(&plan)).expect("a settler");
            let reference = eight_passes(&plan, serial.as_mut(), form);
            assert!(reference[7].1 != places(&plan), "{name}: nothing moved");
            assert!(eight_passes(&plan, serial.as_mut(), form) == reference, "{name}: again");
            for backend in ParallelBackend::each() {
                let mut settler = backend.settler(Arc::clone(&plan)).expect("a settler");
                let found = eight_passes(&plan, settler.as_mut(), form);
                for (pass, (found, expected)) in found.iter().zip(&reference).enumerate() {
                    let device = &backend.info().name;
                    assert_eq!(found.0, expected.0, "{name}, {form:?}, {device}: seen by pass {pass}");
                    assert!(found.1 == expected.1, "{name}, {form:?}, {device}: places after pass {pass}");
                }
            }
        }
    }
}

/// A whole settling on `cpu` ends in the bits of one on `cpu-serial`: the same report and the same
/// points.
#[test]
fn whole_settlings_end_in_the_same_bits() {
    let start = weft_knit("jersey", &Chart::new(&["kk"; 2]), Gauge::new(4.2), Length::Held);
    let plan = settling_plan(&start);
    let end = |device: &dyn Backend| {
        let mut settler = device.settler(Arc::clone(&plan)).expect("a settler");
        let rest = settle(&plan, settler.as_mut(), |_, _| ControlFlow::Continue(())).expect("a settling");
        let yarns = texere_conformance::rest::yarns(&start);
        (rest, settled(&plan, settler.as_mut(), yarns.points()).expect("points"))
    };
    let reference = end(&SerialBackend::new());
    assert!(reference.0.at_rest && reference.0.passes > 100, "{:?}", reference.0);
    assert_eq!(end(&cpu()), reference);
}

/// Cloth ten metres from the origin comes to rest as at the origin. Its coordinates are exact in
/// both places.
#[test]
fn a_cloth_far_out_rests_as_one_at_the_origin() {
    let at = |far: DVec3| {
        let mut start = weft_knit("jersey", &Chart::new(&["kk"; 2]), Gauge::new(4.2), Length::Held);
        let fine = 1024.0;
        start.repeat = start.repeat.map(|repeat| (64.0 * repeat * fine).round() / fine);
        for yarn in &mut start.yarns {
            yarn.radius *= 64.0;
            for point in &mut yarn.points {
                *point = (*point * 64.0 * fine).round() / fine + far;
            }
        }
        settle_start(&start, &cpu(), |_, _| {})
    };
    let far = DVec3::new(10_240.0, -9_216.0, 0.0);
    let ((here, near), (there, moved)) = (at(DVec3::ZERO), at(far));
    assert_eq!(here, there);
    for (one, other) in near.iter().flatten().zip(moved.iter().flatten()) {
        let apart = (*other - far).distance(*one);
        assert!(apart <= 1e-3, "{apart} mm: more than coordinates are rounded there");
    }
}

/// A weave that is too dense for round yarns can't come to rest. Settling does not make it worse.
#[test]
fn what_comes_back_is_no_worse_than_what_came_in() {
    for pitch in [1.2, 1.5] {
        let start = woven("jammed", Weave { size: 4, step: 1, order: 2, pitch }, Length::Held);
        let (rest, points) = settle_start(&start, &cpu(), |_, _| {});
        assert!(!rest.at_rest, "{pitch}: {rest:?}");
        let (before, after) = (check(&start, &start.points()), check(&start, &points));
        assert!(after.clearance > before.clearance.min(0.98) - 0.002, "{pitch}: {before:?} {after:?}");
        let linked = linking(&start, &start.points(), &points);
        assert!(linked.change < CROSSED, "{pitch}: {linked:?}");
    }
}

/// Returned positions are those of the report, and cloth that was at rest comes back unchanged.
#[test]
fn a_report_is_of_what_comes_back() {
    for name in ["jersey-3.6", "jersey-5", "plain-1.8", "rib-4.4"] {
        let start = starts().into_iter().find(|start| start.name == name).expect("a start");
        let plan = settling_plan(&start);
        let mut settler = cpu().settler(Arc::clone(&plan)).expect("a settler");
        let rest = settle(&plan, settler.as_mut(), |_, _| ControlFlow::Continue(())).expect("a settling");
        let mut end = places(&plan);
        settler.read(&mut end).expect("places");
        let mut fresh = SerialBackend::new().settler(Arc::clone(&plan)).expect("a settler");
        fresh.upload(&end).expect("an upload");
        fresh.list(1.0).expect("a list");
        let pass = Pass { form: Form::Weighted, growth: 1.0, ease: 0.0, momentum: 0.0 };
        let seen = fresh.pass(&pass).expect("a pass");
        assert_eq!((seen.clearance, seen.radius), (rest.end.clearance, rest.end.radius), "{name}");
        assert_eq!(end == places(&plan), rest.passes == 1, "{name}: {rest:?}");
        let yarns = texere_conformance::rest::yarns(&start);
        let points = settled(&plan, settler.as_mut(), yarns.points()).expect("points");
        assert_eq!(points == yarns.points(), rest.passes == 1, "{name}: {rest:?}");
    }
}

/// Settling may be stopped at any time. It makes no further pass, and leaves the best positions
/// that it has reported.
#[test]
fn who_watches_may_break_off() {
    let start = starts().into_iter().find(|start| start.name == "jersey-3.6").expect("a start");
    let plan = settling_plan(&start);
    // Stops in the first pass, in growth, in ease, and in the block form.
    for last in [1, 20, 60, 330] {
        let mut settler = cpu().settler(Arc::clone(&plan)).expect("a settler");
        let (mut calls, mut best) = (0, SettlingSeen::NOTHING);
        let rest = settle(&plan, settler.as_mut(), |pass, seen| {
            let Some(seen) = seen else { return ControlFlow::Continue(()) };
            calls += 1;
            if calls == 1 || pass.ease == 0.0 && seen.is_better_than(&best) {
                best = *seen;
            }
            if calls == last { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        let rest = rest.expect("a settling");
        assert_eq!((calls, rest.passes, rest.at_rest), (last, last, false));
        assert_eq!((rest.block_passes > 0, rest.end), (last == 330, best));
        let mut end = places(&plan);
        settler.read(&mut end).expect("places");
        assert_eq!(end == places(&plan), rest.end == rest.start, "{rest:?}");
    }
}

/// Lists hold as many neighbours as a comparison of all pairs finds: in small repeats, in open
/// pieces of few cells, and in pieces of many cells.
#[test]
fn lists_are_complete() {
    let mut plans = plans();
    for seed in 0..12 {
        plans.push(("strewn", Arc::new(strewn(3.0 + 0.3 * seed as f32, seed))));
    }
    for (name, plan) in plans {
        for growth in [0.25, 0.7, 1.0] {
            let intervals: Vec<_> = (0..plan.places().len())
                .map(|place| {
                    let begins = plan.tags()[place] & tag::INTERVAL != 0;
                    begins.then(|| plan.interval(plan.places(), place))
                })
                .collect();
            let chords: Vec<_> = intervals
                .iter()
                .enumerate()
                .filter_map(|(place, interval)| Some((place, (*interval)?)))
                .flat_map(|(place, interval)| {
                    let pieces = plan.chords()[place + 1] - plan.chords()[place];
                    let scale = *plan.scale();
                    (0..pieces).map(move |piece| {
                        (place, piece, pieces, interval, Chord::new(&interval, piece, pieces, &scale))
                    })
                })
                .collect();
            let listed = |number: usize| {
                let (place, piece, pieces, interval, chord) = &chords[number];
                Listed { chord, interval, place: *place, piece: *piece, pieces: *pieces }
            };
            let mut count = 0;
            for one in 0..chords.len() {
                for other in (0..chords.len()).filter(|other| *other != one) {
                    count += u64::from(plan.are_neighbours(listed(one), listed(other), growth));
                }
            }
            let devices: [Arc<dyn Backend>; 2] = [Arc::new(SerialBackend::new()), Arc::new(cpu())];
            for device in devices {
                let mut settler = device.settler(Arc::clone(&plan)).expect("a settler");
                settler.upload(&places(&plan)).expect("an upload");
                let found = settler.list(growth).expect("a list");
                assert_eq!(found, count, "{name} at {growth}: {}", device.info().name);
            }
        }
    }
}

/// Short yarns scattered over a field of `width` by 4 mm, all at one height.
fn strewn(width: f32, seed: u32) -> SettlingPlan {
    let mut bits = seed;
    let mut next = || {
        bits = bits.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (bits >> 8) as f32 / (1 << 24) as f32
    };
    let mut yarns = Yarns::builder();
    for _ in 0..60 {
        let (x, y, angle) = (width * next(), 4.0 * next(), std::f32::consts::TAU * next());
        let end = [x + 0.8 * angle.cos(), y + 0.8 * angle.sin()];
        yarns.yarn(Yarn::default(), &[[x, y], end].map(|[x, y]| ControlPoint::new(x, y, 0.0, 0.5)));
    }
    SettlingPlan::new(&Settling::new(&yarns.build().expect("yarns"))).expect("a plan")
}

/// Plates press a knit flat and leave its yarns clear of one another.
#[test]
fn plates_press() {
    let start = weft_knit("rib", &Chart::new(&["kpkp"; 4]), Gauge::new(5.0), Length::Free);
    let yarns = texere_conformance::rest::yarns(&start);
    let ends: Vec<_> = start.yarns.iter().map(|_| texere_core::Ends::Repeats([1, 0])).collect();
    let repeat = start.repeat.map(|repeat| repeat as f32);
    let boundary = Boundary::new(yarns.layout(), repeat, ends).expect("a boundary");
    let free = texere_core::settling::Length::Free { tension: 0.0 };
    let diameter = 2.0 * start.yarns[0].radius;
    let settled_between = |gap: Option<f32>| {
        let settling = Settling::new(&yarns).boundary(boundary.clone()).length(free);
        let settling = if let Some(gap) = gap { settling.plates(gap) } else { settling };
        let plan = Arc::new(SettlingPlan::new(&settling).expect("a plan"));
        let mut settler = cpu().settler(Arc::clone(&plan)).expect("a settler");
        settle(&plan, settler.as_mut(), |_, _| ControlFlow::Continue(())).expect("a settling");
        let points = settled(&plan, settler.as_mut(), yarns.points()).expect("points");
        let mut points = points.iter().map(|point| point.position().as_dvec3());
        let all: Vec<Vec<_>> =
            start.yarns.iter().map(|yarn| points.by_ref().take(yarn.points.len()).collect()).collect();
        check(&start, &all)
    };
    let (free, pressed) = (settled_between(None), settled_between(Some(2.0 * diameter as f32)));
    assert!(pressed.thickness < free.thickness - 0.05 * diameter, "{free:?} {pressed:?}");
    assert!(pressed.clearance > 0.98, "{pressed:?}");
}

#[test]
fn unsound_problems_are_refused_by_name() {
    let straight = |y: f32| [0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, y, 0.0, 0.1));
    let mut yarns = Yarns::builder();
    yarns.yarn(Yarn::default(), &straight(0.0));
    yarns.yarn(Yarn::default(), &straight(1.0));
    let yarns = yarns.build().expect("yarns");
    let refused = |settling: Settling<'_>| match SettlingPlan::new(&settling) {
        Ok(plan) => panic!("taken: {:?}", plan.counts()),
        Err(error) => error.to_string(),
    };
    let goes_on = texere_core::Ends::Repeats([1, 0]);
    let short = Boundary::new(yarns.layout(), [0.5, 0.0], vec![goes_on; 2]).expect("a boundary");
    let message = refused(Settling::new(&yarns).boundary(short));
    assert!(message.starts_with("a repeat of 0.5 mm along x is too short for yarns of 0.19995"), "{message}");
    assert_eq!(
        refused(Settling::new(&yarns).pinned(vec![5, 6])),
        "control point 6 can't be pinned, there are 6"
    );
    assert_eq!(
        refused(Settling::new(&yarns.clone().with_tension(0.995).expect("a tension"))),
        "the spline's tension is 0.995, not between 0 and 0.99"
    );
    let length = texere_core::settling::Length::Given(f32::NAN);
    assert_eq!(refused(Settling::new(&yarns).length(length)), "the length is NaN, not between 0.5 and 2");
    for passes in [0, u32::MAX] {
        let message = refused(Settling::new(&yarns).passes(passes));
        assert!(message.starts_with("the number of passes is "), "{message}");
    }
    let far = Boundary::new(yarns.layout(), [2.0, 0.0], vec![texere_core::Ends::Repeats([i32::MIN, 0]); 2]);
    let message = refused(Settling::new(&yarns).boundary(far.expect("a boundary")));
    assert!(message.starts_with("a cloth of 4"), "{message}");
    let mut one = Yarns::builder();
    one.yarn(Yarn::default(), &straight(0.0));
    let one = one.build().expect("yarns");
    let other = Boundary::without_repeat(one.layout());
    let wrong = SettlingPlan::new(&Settling::new(&yarns).boundary(other));
    let counts = BoundaryError::EndsCount { ends: 1, yarns: 2 };
    assert_eq!(wrong.err(), Some(SettlingError::Boundary(counts)));
    let mut wide = Yarns::builder();
    wide.yarn(Yarn::default(), &[-9e8, 9e8].map(|x| ControlPoint::new(x, 0.0, 0.0, 1e-3)));
    let wide = wide.build().expect("yarns");
    let message = refused(Settling::new(&wide));
    assert!(message.starts_with("a cloth of 9"), "{message}");
}

#[test]
fn a_backend_without_settling_says_so() {
    let start = Start {
        name: "two".into(),
        yarns: vec![StartYarn { points: vec![DVec3::ZERO, DVec3::X], radius: 0.1, ends: Ends::Open }],
        repeat: [0.0; 2],
        pinned: Vec::new(),
        length: Length::Held,
    };
    let error = NullBackend::default().settler(settling_plan(&start)).expect_err("no settler");
    assert_eq!(error.to_string(), "null can't settle yarns");
}
