//! Settling of crossings on every device of the registry, against `cpu-serial`: positions of
//! threads, the measures of passes, and whole settlings. A course is here a row of passes: eight of
//! them, or all of one settling.

use std::ops::ControlFlow;
use std::sync::Arc;

use texere_conformance::{CrossingsSabotage, SabotagedCrossings, near_devices};
use texere_core::backend::Schedule;
use texere_core::crossings::{
    CrossingState, CrossingThread, Crossings, CrossingsPass, CrossingsPlan, CrossingsRest, CrossingsSeen,
    CrossingsSettler, Level, Set, settle,
};
use texere_core::{Backend, BackendError, Limits, OutOfMemory};
use texere_cpu::SerialBackend;
use texere_opencl::OpenClBackend;
use texere_wgpu::WgpuBackend;

/// Cloth whose ends are all alike, and whose picks are all alike. In `pitch` and `diameter`, mm,
/// the value of the ends comes before that of the picks.
fn even(
    pitch: [f32; 2],
    diameter: [f32; 2],
    [ends, picks]: [usize; 2],
    up: fn(usize, usize) -> bool,
) -> Crossings {
    let [warp, weft] = [0, 1].map(|set: usize| CrossingThread::new(pitch[set], diameter[set]));
    let ups = (0..ends * picks).map(|number| up(number % ends, number / ends)).collect();
    Crossings::new(ups, vec![warp; ends], vec![weft; picks])
}

/// Uneven threads in a random drawdown.
fn uneven(ends: usize, picks: usize) -> Crossings {
    let mut bits = 7_u32;
    let mut chance = || {
        bits = bits.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (bits >> 8) as f32 / (1 << 23) as f32 - 1.0
    };
    let mut threads = |count: usize, pitch: f32| -> Vec<CrossingThread> {
        let thread = |_| CrossingThread {
            pitch: pitch * (1.0 + 0.2 * chance()),
            diameter: 0.3 * (1.0 + 0.3 * chance()),
            stiffness: 1.0 + 0.5 * chance(),
            firmness: 1.0 + 0.5 * chance(),
            flatness: 1.0 + 0.3 * chance(),
            ..CrossingThread::new(0.0, 0.0)
        };
        (0..count).map(thread).collect()
    };
    let (warp, weft) = (threads(ends, 0.45), threads(picks, 0.5));
    let ups = (0..ends * picks).map(|_| chance() > 0.0).collect();
    Crossings::new(ups, warp, weft).tension(0.7, 1.4).press(2.0)
}

/// Threads that take the levels of their set in turn. With equally many levels of both sets each
/// layer is plain weave; otherwise each level is a twill. In figured cloth the layers change places
/// at every `figure` threads. Figured cloth is more open, so that threads have room to change
/// places.
fn layers([across, along]: [u32; 2], [ends, picks]: [usize; 2], figure: Option<usize>) -> Crossings {
    let threads = |count: usize, levels: u32, spacing: f32| -> Vec<CrossingThread> {
        vec![CrossingThread::new(spacing / levels as f32, 0.2); count]
    };
    let turned = |end: usize, pick: usize| {
        figure.map_or(0, |figure| u32::from(!(end / figure + pick / figure).is_multiple_of(2)))
    };
    let level = |set: usize, of: u32| {
        let level = |number: usize| {
            let [end, pick] = [number % ends, number / ends];
            let number = of - 1 - ([end, pick][set] as u32 + turned(end, pick)) % of;
            Level { number: number as u8, of: of as u8 }
        };
        (0..ends * picks).map(level).collect::<Vec<_>>()
    };
    let open = if figure.is_some() { 1.75 } else { 1.0 };
    let (warp, weft) = (threads(ends, across, open * 0.4), threads(picks, along, open * 0.44));
    let up = |end: usize, pick: usize| {
        let by = turned(end, pick);
        let [one, two] = [(end as u32 + by) % across, (pick as u32 + by) % along];
        match across == along {
            true if one == two => (end / across as usize + pick / along as usize).is_multiple_of(2),
            true => one < two,
            false => (end + 4 - pick / 2 % 4).is_multiple_of(4) != (two == 1),
        }
    };
    let ups = (0..ends * picks).map(|number| up(number % ends, number / ends)).collect();
    Crossings::new(ups, warp, weft).levels(level(0, across), level(1, along))
}

/// An orthogonal weave: picks on three levels, stuffers on two, and binders.
fn orthogonal() -> Crossings {
    let (ends, picks) = (6, 6);
    let up = |end: usize, pick: usize| match end % 3 {
        stuffer @ (0 | 1) => pick % 3 > stuffer,
        _ => (end / 3 + pick / 3).is_multiple_of(2),
    };
    let end = |number: usize| match number % ends % 3 {
        2 => Level::BINDER,
        stuffer => Level { number: 1 - stuffer as u8, of: 2 },
    };
    let pick = |number: usize| Level { number: 2 - (number / ends % 3) as u8, of: 3 };
    let all = 0..ends * picks;
    let ups = all.clone().map(|number| up(number % ends, number / ends)).collect();
    let thread = CrossingThread::new(0.4, 0.2);
    Crossings::new(ups, vec![thread; ends], vec![thread; picks])
        .levels(all.clone().map(end).collect(), all.map(pick).collect())
}

/// Cloths that together have every case that a pass treats differently.
fn cloths() -> Vec<(&'static str, Crossings)> {
    let plain = |end: usize, pick: usize| (end + pick).is_multiple_of(2);
    let twill = |end: usize, pick: usize| !(end + 4 - pick % 4).is_multiple_of(4);
    let satin = |end: usize, pick: usize| !(end + 64 - 3 * (pick % 8)).is_multiple_of(8);
    let half = |end: usize, pick: usize| (end + 4 - pick % 4) % 4 < 2;
    let jacquard = |end: usize, pick: usize| match end < 16 || pick < 16 {
        true => !(end + 64 - 3 * (pick % 8)).is_multiple_of(8),
        false => (end + pick).is_multiple_of(2),
    };
    vec![
        ("plain", even([0.4; 2], [0.2; 2], [2, 2], plain)),
        ("poplin", even([0.191, 0.353], [0.143; 2], [2, 2], plain)),
        ("denim", even([0.353, 0.454], [0.343, 0.287], [4, 4], twill)),
        ("satin of 8", even([0.25; 2], [0.2; 2], [8, 8], satin)),
        ("twill 2/2", even([0.3; 2], [0.2; 2], [4, 4], half)),
        ("Jacquard", even([0.355; 2], [0.203; 2], [32, 32], jacquard)),
        ("double cloth", layers([2, 2], [4, 4], None)),
        ("treble cloth", layers([3, 3], [6, 6], None)),
        ("weft-backed cloth", layers([1, 2], [4, 8], None)),
        ("figured double cloth", layers([2, 2], [16, 16], Some(8))),
        // Where the layers change places, neighbours of a level lie at other distances.
        ("figured treble cloth", layers([3, 3], [18, 18], Some(9))),
        ("orthogonal weave", orthogonal()),
        ("a piece of double cloth", layers([2, 2], [13, 11], None).repeats(false, false)),
        // The open edges of this piece slide for more than three hundred passes. The number of
        // passes until they are still depends on roundings. The piece is therefore compared after
        // 200 passes.
        ("a piece of plain", even([0.2, 0.3], [0.15; 2], [24, 20], plain).repeats(false, false).passes(200)),
        ("uneven", uneven(37, 29)),
        ("uneven, held in place", uneven(37, 29).held()),
        ("twill, held in place", even([0.2, 0.3], [0.15; 2], [4, 4], twill).held()),
        ("uneven, ends repeat", uneven(12, 9).repeats(true, false)),
        ("uneven, picks repeat", uneven(11, 14).repeats(false, true)),
    ]
}

fn plan(problem: &Crossings) -> Arc<CrossingsPlan> {
    Arc::new(CrossingsPlan::new(problem).expect("a plan"))
}

fn read(settler: &mut dyn CrossingsSettler) -> Result<Vec<CrossingState>, BackendError> {
    let mut crossings = vec![CrossingState::default(); settler.plan().crossings()];
    settler.read(&mut crossings)?;
    Ok(crossings)
}

/// The result of eight passes.
#[derive(Debug, Clone, PartialEq)]
struct Course {
    seen: Vec<CrossingsSeen>,
    crossings: Vec<CrossingState>,
}

/// The largest difference of any unknown, in mean diameters.
fn apart(one: &[CrossingState], other: &[CrossingState]) -> f32 {
    one.iter().zip(other).map(|(one, other)| one.difference(other)).fold(0.0, f32::max)
}

/// Runs eight passes from number `first` of the course on: three together, one alone, and four
/// together.
fn eight_passes(
    settler: &mut dyn CrossingsSettler,
    begin: &[CrossingState],
    first: u32,
) -> Result<Course, BackendError> {
    settler.upload(begin)?;
    let passes: Vec<CrossingsPass> = (first..first + 8).map(CrossingsPass::of).collect();
    let mut seen = Vec::new();
    let mut note = |_: &CrossingsPass, found: Option<CrossingsSeen>| {
        seen.extend(found);
        ControlFlow::Continue(())
    };
    for passes in [&passes[..3], &passes[3..4], &passes[4..]] {
        assert!(settler.passes(passes, &mut note)?.is_continue());
    }
    Ok(Course { seen, crossings: read(settler)? })
}

/// Tolerance of an unknown, in mean diameters.
const OFF: f32 = 1e-4;

/// The rounding of an unknown, in mean diameters.
const ROUNDING: f32 = 5e-7;

/// The number of a pass, and the crossings before it: at the start of the course, when threads are
/// thin, and when they have almost grown.
fn beginnings(plan: &Arc<CrossingsPlan>) -> [(u32, Vec<CrossingState>); 2] {
    let thin = plan.start().expect("crossings");
    let mut serial = SerialBackend::new().crossings_settler(Arc::clone(plan)).expect("a settler");
    serial.upload(&thin).expect("an upload");
    for number in 0..46 {
        serial.pass(&CrossingsPass::of(number)).expect("a pass");
    }
    [(0, thin), (46, read(serial.as_mut()).expect("crossings"))]
}

fn reference(plan: &Arc<CrossingsPlan>, begin: &[CrossingState], first: u32) -> Course {
    let mut serial = SerialBackend::new().crossings_settler(Arc::clone(plan)).expect("a settler");
    eight_passes(serial.as_mut(), begin, first).expect("a course")
}

/// The larger difference of the measures of two passes, of the step or of the clearance.
fn seen_apart(one: &CrossingsSeen, other: &CrossingsSeen) -> f32 {
    (one.step - other.step).abs().max((one.clearance - other.clearance).abs())
}

/// Tolerance of a course. Threads that only just touch, or that can take either of two slopes,
/// amplify a rounding. The tolerance is ten times the change of the reference's own course when it
/// begins up to two roundings off, and [`OFF`] at least.
fn certain(plan: &Arc<CrossingsPlan>, begin: &[CrossingState], first: u32, expected: &Course) -> f32 {
    let mut beside = begin.to_vec();
    for (number, value) in bytemuck::cast_slice_mut::<_, f32>(&mut beside).iter_mut().enumerate() {
        *value += ROUNDING * ((number * 7 % 5) as f32 - 2.0);
    }
    let other = reference(plan, &beside, first);
    let seen = expected.seen.iter().zip(&other.seen).map(|(one, other)| seen_apart(one, other));
    OFF.max(10.0 * seen.fold(apart(&expected.crossings, &other.crossings), f32::max))
}

/// Errors of a course against the reference's course: values that are off by more than `most`.
fn faults(found: &Course, expected: &Course, most: f32) -> Vec<String> {
    let mut faults = Vec::new();
    for (pass, (found, expected)) in found.seen.iter().zip(&expected.seen).enumerate() {
        let off = seen_apart(found, expected);
        if off > most || off.is_nan() {
            faults.push(format!("seen by pass {pass}: {found:?}, not {expected:?}"));
        }
    }
    let furthest = apart(&found.crossings, &expected.crossings);
    if furthest > most || found.seen.len() != expected.seen.len() {
        faults.push(format!("a thread is {furthest} diameters off after {} passes", found.seen.len()));
    }
    faults
}

#[test]
fn devices_move_crossings_as_the_reference_does() {
    let mut failed = Vec::new();
    for (name, problem) in cloths() {
        let plan = plan(&problem);
        for (first, begin) in beginnings(&plan) {
            let expected = reference(&plan, &begin, first);
            assert!(apart(&expected.crossings, &begin) > OFF, "{name}: nothing moved");
            let most = certain(&plan, &begin, first, &expected);
            for device in near_devices() {
                let mut settler = device.crossings_settler(Arc::clone(&plan)).expect("a settler");
                let found = eight_passes(settler.as_mut(), &begin, first).expect("a course");
                let here = format!("{}: {name}, from pass {first}", device.info().name);
                println!("{here}: {:.1e} of {most:.1e}", apart(&found.crossings, &expected.crossings));
                failed.extend(faults(&found, &expected, most).iter().map(|fault| format!("{here}: {fault}")));
                // The settler is used again, after other passes.
                let again = eight_passes(settler.as_mut(), &begin, first).expect("a course");
                if bytemuck::cast_slice::<_, u8>(&again.crossings)
                    != bytemuck::cast_slice::<_, u8>(&found.crossings)
                    || again.seen != found.seen
                {
                    failed.push(format!("{here}: another end the second time"));
                }
            }
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

/// The comparison can fail: each broken settler is caught, and a correct one is not.
#[test]
fn broken_settlers_are_caught() {
    let problem = uneven(7, 6);
    let plan = plan(&problem);
    for (first, begin) in beginnings(&plan) {
        let expected = reference(&plan, &begin, first);
        let found = |sabotage| {
            let mut settler = SabotagedCrossings::new(sabotage, &problem).expect("a settler");
            faults(&eight_passes(&mut settler, &begin, first).expect("a course"), &expected, OFF)
        };
        assert_eq!(found(CrossingsSabotage::None), [""; 0]);
        for sabotage in CrossingsSabotage::ALL {
            let found = found(sabotage);
            assert!(found.iter().any(|fault| fault.starts_with("a thread is ")), "{sabotage:?}: {found:?}");
        }
    }
}

/// For each set, the means of half widths, of half heights, of areas as shares of the round
/// thread's, and of distances from the middle height.
fn means(plan: &CrossingsPlan, crossings: &[CrossingState]) -> Vec<f32> {
    let mean = |of: &dyn Fn(usize) -> f32| (0..crossings.len()).map(of).sum::<f32>() / crossings.len() as f32;
    let each = Set::BOTH.into_iter().flat_map(|set| {
        let lie = move |number: usize| crossings[number].thread(set);
        let radius = move |number: usize| plan.rows(set)[plan.site(number).thread(set)].radius;
        [
            mean(&move |number| lie(number).half_width),
            mean(&move |number| lie(number).half_height),
            mean(&move |number| lie(number).half_width * lie(number).half_height / radius(number).powi(2)),
            mean(&move |number| lie(number).height.abs()),
        ]
    });
    each.collect()
}

/// Crossings without the mean shift of each set, because a repeat may lie a little further on.
fn centred(crossings: &[CrossingState]) -> Vec<CrossingState> {
    let mean = |set: Set| {
        crossings.iter().map(|crossing| crossing.thread(set).shift).sum::<f32>() / crossings.len() as f32
    };
    let [warp, weft] = Set::BOTH.map(mean);
    let centre = |mut crossing: CrossingState| {
        crossing.warp.shift -= warp;
        crossing.weft.shift -= weft;
        crossing
    };
    crossings.iter().copied().map(centre).collect()
}

fn rest(device: &dyn Backend, plan: &Arc<CrossingsPlan>) -> (CrossingsRest, Vec<CrossingState>) {
    let mut settler = device.crossings_settler(Arc::clone(plan)).expect("a settler");
    let rest = settle(plan, settler.as_mut(), |_, _| ControlFlow::Continue(())).expect("rest");
    (rest, read(settler.as_mut()).expect("crossings"))
}

/// Whole courses end alike on every device: at rest or not, after about as many passes, with the
/// same clearance and mean sizes. Threads of cloth at rest also lie in the same places.
#[test]
fn cloths_come_to_the_same_rest_on_every_device() {
    let (mut failed, mut at_rest) = (Vec::new(), 0);
    for (name, problem) in cloths() {
        let plan = plan(&problem);
        let (expected, crossings) = rest(&SerialBackend::new(), &plan);
        at_rest += usize::from(expected.at_rest);
        for device in near_devices() {
            let (found, read) = rest(device.as_ref(), &plan);
            let measures = [means(&plan, &read), means(&plan, &crossings)];
            let both = measures[0].iter().zip(&measures[1]);
            let off = both.map(|(one, other)| (one - other).abs()).fold(0.0, f32::max);
            let furthest = apart(&centred(&read), &centred(&crossings));
            let device = &device.info().name;
            println!("{device}: {name}: {off:.1e}, {furthest:.1e}, {found:?}, {expected:?}");
            // Threads that still move by a ten-thousandth a pass after 400 passes do not lie in one
            // place on all devices.
            let most = if expected.at_rest { 1e-3 } else { 1e-2 };
            if found.at_rest != expected.at_rest
                || found.passes.abs_diff(expected.passes) > 10
                || (found.seen.clearance - expected.seen.clearance).abs() > 1e-3
                || off > most
                || expected.at_rest && furthest > 1e-3
            {
                failed.push(format!("{device}: {name}: {off} off, {found:?}, not {expected:?}"));
            }
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
    assert!(at_rest >= 4, "{at_rest} come to rest");
}

/// A settling counts as many passes as the problem allows, and only one if the caller breaks off
/// after the first.
#[test]
fn passes_end_where_they_should() {
    let problem = even([0.4; 2], [0.2; 2], [2, 2], |end, pick| (end + pick).is_multiple_of(2));
    for passes in [1, 7, 23] {
        let plan = plan(&problem.clone().passes(passes));
        for device in near_devices() {
            let mut settler = device.crossings_settler(Arc::clone(&plan)).expect("a settler");
            let mut watched = 0;
            let rest = settle(&plan, settler.as_mut(), |_, seen| {
                watched += u32::from(seen.is_some());
                ControlFlow::Continue(())
            });
            assert_eq!((watched, rest.expect("rest").passes), (passes, passes), "{}", device.info().name);
            let broken_off = settle(&plan, settler.as_mut(), |_, seen| {
                if seen.is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            });
            assert_eq!(broken_off.expect("rest").passes, 1, "{}", device.info().name);
        }
    }
}

/// A device with little memory, in each buffer or in all, gives the same result, or an error that
/// names what is too large.
#[test]
fn small_memories_do_the_same_or_are_refused_by_name() {
    type Held = fn(Limits) -> Option<Box<dyn Backend>>;
    let opencl: Held = |limits| {
        let device = OpenClBackend::open(0, Schedule::PerRing).ok()?;
        Some(Box::new(device.with_limits(limits)))
    };
    let wgpu: Held = |limits| {
        let device = WgpuBackend::open(0, Schedule::PerRing).ok()?;
        Some(Box::new(device.with_limits(limits)))
    };
    let plan = plan(&uneven(37, 29));
    let begin = plan.start().expect("crossings");
    for held in [opencl, wgpu] {
        let Some(device) = held(Limits::NONE) else { continue };
        let course = |device: &dyn Backend| {
            let mut settler = device.crossings_settler(Arc::clone(&plan))?;
            eight_passes(settler.as_mut(), &begin, 0)
        };
        let whole = course(device.as_ref()).expect("a course");
        let refused = |limits: Limits| match course(held(limits).expect("opened before").as_ref()) {
            Ok(found) => {
                assert!(found == whole, "another end");
                None
            }
            Err(BackendError::OutOfMemory(OutOfMemory { what, .. })) => Some(what),
            Err(error) => panic!("{error}"),
        };
        let each: Vec<_> = (7..17)
            .filter_map(|power| refused(Limits { binding_bytes: 1 << power, ..Limits::NONE }))
            .collect();
        assert_eq!((each.first(), each.last()), (Some(&"the thread table"), Some(&"crossings")), "{each:?}");
        let all = |memory_bytes| refused(Limits { memory_bytes, ..Limits::NONE });
        assert_eq!(all(plan.settler_bytes()), Some("crossings as others will find them"));
        // The tables of threads and crossings take less than 8 KiB.
        assert_eq!(all(plan.settler_bytes() + 8192), None);
    }
}
