//! Settling on every device of the registry, against `cpu-serial`: positions, the measures of
//! passes, neighbours, and whole settlings. A course is here a row of eight passes.

use std::sync::Arc;

use glam::DVec3;
use texere_conformance::rest::{
    Ends, Length, Start, StartYarn, Weave, check, settle_start, settling_plan, starts, woven,
};
use texere_conformance::{SabotagedSettler, SettlingSabotage, near_devices};
use texere_core::backend::Schedule;
use texere_core::settling::{Form, Pass, Place, Rest, Settler, Settling, SettlingPlan, SettlingSeen, tag};
use texere_core::{Backend, BackendError, Boundary, ControlPoint, Limits, OutOfMemory, Yarn, Yarns};
use texere_cpu::{ParallelBackend, SerialBackend};
use texere_opencl::OpenClBackend;

/// A repeat of plain weave as placed, with flattened yarns, pressed by plates.
fn flattened_plain() -> SettlingPlan {
    let start = woven("plain", Weave { size: 4, step: 1, order: 2, pitch: 2.2 }, Length::Free);
    let mut yarns = Yarns::builder();
    for yarn in &start.yarns {
        let radius = yarn.radius as f32;
        let point = |at: &DVec3| {
            ControlPoint::new(at.x as f32, at.y as f32, at.z as f32, radius)
                .flattened(radius * 1.3, radius * 0.7)
        };
        yarns.yarn(Yarn::default(), &yarn.points.iter().map(point).collect::<Vec<_>>());
    }
    let yarns = yarns.build().expect("yarns");
    let ends = start.yarns.iter().map(|yarn| match yarn.ends {
        Ends::Repeats(shift) => texere_core::Ends::Repeats(shift),
        Ends::Open | Ends::Closed => panic!("a repeat"),
    });
    let boundary = Boundary::new(yarns.layout(), start.repeat.map(|repeat| repeat as f32), ends.collect());
    let settling = Settling::new(&yarns).boundary(boundary.expect("a boundary")).plates(0.3);
    SettlingPlan::new(&settling).expect("a plan")
}

/// Two closed yarns that are linked.
fn linked_rings() -> SettlingPlan {
    let mut rings = Yarns::builder();
    for ring in 0..2 {
        let point = |k: usize| {
            let (sin, cos) = (k as f32 * std::f32::consts::TAU / 12.0).sin_cos();
            let [y, z] = if ring == 0 { [sin, 0.0] } else { [0.0, sin] };
            ControlPoint::new(ring as f32 + cos, y, z, 0.3)
        };
        rings.yarn(Yarn { closed: true, ..Yarn::default() }, &(0..12).map(point).collect::<Vec<_>>());
    }
    SettlingPlan::new(&Settling::new(&rings.build().expect("yarns"))).expect("a plan")
}

/// Plans that together have every case that a pass treats differently.
fn plans() -> Vec<(String, Arc<SettlingPlan>)> {
    let mut plans: Vec<_> =
        starts().into_iter().map(|start| (start.name.clone(), settling_plan(&start))).collect();
    plans.push(("flattened, pressed".into(), Arc::new(flattened_plain())));
    plans.push(("linked rings".into(), Arc::new(linked_rings())));
    plans
}

/// A start of the list.
fn start(name: &str) -> Start {
    starts().into_iter().find(|start| start.name == name).expect("a start")
}

/// The positions of all control points at the start, in order.
fn places(plan: &SettlingPlan) -> Vec<Place> {
    let all = plan.places().iter().zip(plan.tags());
    all.filter(|(_, tags)| **tags & tag::POINT != 0).map(|(place, _)| *place).collect()
}

/// The start positions, each moved by up to a hundredth of a diameter along each axis, as in a
/// settling before yarns begin to grow. Without this, rounding alone decides where symmetrical
/// yarns go. In addition, `units` are added or subtracted in a pattern.
fn begin(plan: &SettlingPlan, units: i32) -> Vec<Place> {
    let far = 0.01 * plan.spans().diameter / plan.scale().unit();
    let (mut bits, mut all) = (1_u32, places(plan));
    let tags = plan.tags().iter().filter(|tags| **tags & tag::POINT != 0);
    for (number, (place, tags)) in all.iter_mut().zip(tags).enumerate() {
        for axis in 0..3 {
            bits = bits.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            if tags & tag::PINNED == 0 {
                let chance = (bits >> 8) as f32 / (1 << 23) as f32 - 1.0;
                place.at[axis] += (chance * far) as i32 + units * ((number + axis) % 3) as i32 - units;
            }
        }
    }
    all
}

/// The result of eight passes.
#[derive(Debug, PartialEq)]
struct Course {
    /// Number of neighbours in each list.
    neighbours: Vec<u64>,
    seen: Vec<SettlingSeen>,
    places: Vec<Place>,
}

impl Course {
    /// The largest distance between positions of two courses, in mean diameters.
    fn apart(&self, plan: &SettlingPlan, other: &Self) -> f64 {
        let apart = |(here, there): (&Place, &Place)| {
            let way = here.units().as_dvec3() - there.units().as_dvec3();
            way.length() * f64::from(plan.scale().unit() / plan.spans().diameter)
        };
        self.places.iter().zip(&other.places).map(apart).fold(0.0, f64::max)
    }
}

/// Eight passes of `form`, in which neighbours are listed twice. In the weighted form the ease is
/// 0.5, half of its value while the yarns of a settling grow. In the block form it is 0, as in a
/// settling.
fn eight_passes(settler: &mut dyn Settler, form: Form, begin: &[Place]) -> Result<Course, BackendError> {
    let mut course = Course { neighbours: Vec::new(), seen: Vec::new(), places: begin.to_vec() };
    settler.upload(begin)?;
    for number in 0..8 {
        let growth = if number < 4 { 0.8 } else { 1.0 };
        if number % 4 == 0 {
            course.neighbours.push(settler.list(growth)?);
        }
        let ease = if form == Form::Weighted { 0.5 } else { 0.0 };
        course.seen.push(settler.pass(&Pass { form, growth, ease, momentum: 0.8 })?);
    }
    settler.read(&mut course.places)?;
    Ok(course)
}

/// Tolerance of positions, in mean diameters.
const OFF: f64 = 1e-4;

/// The result of `cpu-serial` for a plan, and the largest change of that result if positions begin
/// up to three units off, a few millionths of a diameter. The change may be large, because parallel
/// yarns that pierce one another, such as the underlaps of two guide bars, have no single nearest
/// place. A contact that only just touches may also count one pass sooner or later.
struct Reference {
    course: Course,
    own: f64,
}

impl Reference {
    fn new(plan: &Arc<SettlingPlan>, form: Form) -> Self {
        let mut serial = SerialBackend::new().settler(Arc::clone(plan)).expect("a settler");
        let course = eight_passes(serial.as_mut(), form, &begin(plan, 0)).expect("a course");
        // `cpu` gives the same bits as `cpu-serial`, sooner.
        let mut cpu = ParallelBackend::open().expect("the CPU").settler(Arc::clone(plan)).expect("a settler");
        let mut apart = |units| {
            let other = eight_passes(cpu.as_mut(), form, &begin(plan, units)).expect("a course");
            course.apart(plan, &other)
        };
        let own = [1, -1, 2, -2, 3, -3].map(&mut apart).into_iter().fold(0.0, f64::max);
        Self { own, course }
    }

    /// Whether rounding does not change where yarns go.
    fn is_certain(&self) -> bool {
        self.own < OFF / 2.0
    }
}

fn near(one: f32, other: f32) -> bool {
    one == other || (one - other).abs() <= 1e-3 * one.abs().max(other.abs())
}

/// Errors of a device's course against the reference's.
fn faults(plan: &SettlingPlan, found: &Course, reference: &Reference) -> Vec<String> {
    let (mut faults, expected) = (Vec::new(), &reference.course);
    if reference.is_certain() && found.neighbours != expected.neighbours {
        faults.push(format!("neighbours: {:?}, not {:?}", found.neighbours, expected.neighbours));
    }
    for (pass, (found, expected)) in found.seen.iter().zip(&expected.seen).enumerate() {
        let both = [
            [found.step, expected.step],
            [found.clearance, expected.clearance],
            [found.radius, expected.radius],
            // With the addend, shares of length that are mere rounding count as equal.
            [found.length + 1e-3, expected.length + 1e-3],
        ];
        if reference.is_certain() && both.iter().any(|[found, expected]| !near(*found, *expected)) {
            faults.push(format!("seen by pass {pass}: {found:?}, not {expected:?}"));
        }
    }
    let furthest = found.apart(plan, expected);
    let most = if reference.is_certain() { OFF } else { 10.0 * reference.own };
    if furthest > most {
        faults.push(format!("a place is {furthest} diameters off; by a change of units {}", reference.own));
    }
    if found.places.iter().zip(&expected.places).any(|(found, expected)| found.halves != expected.halves) {
        faults.push("a thickness has changed".into());
    }
    faults
}

#[test]
fn devices_settle_as_the_reference_does() {
    let devices = near_devices();
    let (mut failed, mut certain) = (Vec::new(), 0);
    for (name, plan) in plans() {
        for form in [Form::Weighted, Form::Block] {
            let (reference, begin) = (Reference::new(&plan, form), begin(&plan, 0));
            assert!(reference.course.places != begin, "{name}: nothing moved");
            certain += usize::from(reference.is_certain());
            for device in devices {
                let mut settler = device.settler(Arc::clone(&plan)).expect("a settler");
                let found = eight_passes(settler.as_mut(), form, &begin).expect("a course");
                let here = format!("{}: {name}, {form:?}", device.info().name);
                for fault in faults(&plan, &found, &reference) {
                    failed.push(format!("{here}: {fault}"));
                }
                // The settler is used again, after other passes.
                let again = eight_passes(settler.as_mut(), form, &begin).expect("a course");
                if again != found {
                    failed.push(format!("{here}: another end the second time"));
                }
            }
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
    assert!(certain >= 40, "{certain} of 82 are held to {OFF} diameters");
}

/// The comparison can fail: each broken settler is caught in either form, and a correct one is not.
#[test]
fn broken_settlers_are_caught() {
    let plan = settling_plan(&start("tuck-5"));
    for form in [Form::Weighted, Form::Block] {
        let reference = Reference::new(&plan, form);
        assert!(reference.is_certain());
        let found = |sabotage| {
            let mut settler = SabotagedSettler::new(sabotage, Arc::clone(&plan));
            let course = eight_passes(&mut settler, form, &begin(&plan, 0)).expect("a course");
            faults(&plan, &course, &reference)
        };
        assert_eq!(found(SettlingSabotage::None), [""; 0]);
        for sabotage in SettlingSabotage::ALL {
            let found = found(sabotage);
            let why = match sabotage {
                SettlingSabotage::StaleList => "neighbours: ",
                _ => "a place is ",
            };
            assert!(found.iter().any(|fault| fault.starts_with(why)), "{form:?}: {sabotage:?}: {found:?}");
        }
    }
}

/// Yarns in one place are refused before their pairs fill the memory, equally on every device.
#[test]
fn yarns_too_thick_on_one_another_are_refused() {
    let mut yarns = Yarns::builder();
    for yarn in 0..600 {
        let y = yarn as f32 * 1e-4;
        yarns.yarn(Yarn::default(), &[0.0, 0.5, 1.0].map(|x| ControlPoint::new(x, y, 0.0, 0.1)));
    }
    let yarns = yarns.build().expect("yarns");
    let plan = Arc::new(SettlingPlan::new(&Settling::new(&yarns)).expect("a plan"));
    let chords = plan.counts().chords;
    let cpus: [Arc<dyn Backend>; 2] =
        [Arc::new(SerialBackend::new()), Arc::new(ParallelBackend::open().expect("the CPU"))];
    for backend in cpus.iter().chain(near_devices()) {
        let mut settler = backend.settler(Arc::clone(&plan)).expect("a settler");
        let mut places = vec![Place::default(); plan.counts().points as usize];
        plan.unpad(plan.places(), &mut places);
        settler.upload(&places).expect("places");
        let refused = settler.list(1.0).expect_err("too many pairs");
        let BackendError::Crowded { chords: own, limit } = refused else { panic!("{refused}") };
        assert_eq!((own, limit), (chords, (1 << 20) + 32 * chords), "{}", backend.info().name);
    }
}

/// A device with little memory, in each buffer or in all, gives the same result, or an error that
/// names what is too large.
#[test]
fn small_memories_settle_the_same_or_are_refused_by_name() {
    let Ok(device) = OpenClBackend::open(0, Schedule::PerRing) else { return };
    let plan = settling_plan(&start("jersey-5-piece"));
    let settler = |device: &OpenClBackend| device.settler(Arc::clone(&plan));
    let course =
        |device: &OpenClBackend| eight_passes(settler(device)?.as_mut(), Form::Weighted, &begin(&plan, 0));
    let whole = course(&device).expect("a course");
    let held = |limits| OpenClBackend::open(0, Schedule::PerRing).expect("opened before").with_limits(limits);
    let in_each = |binding_bytes| Limits { binding_bytes, ..Limits::NONE };
    let in_all = |memory_bytes| Limits { memory_bytes, ..Limits::NONE };
    let refused = |device: &OpenClBackend| match course(device) {
        Ok(found) => {
            assert!(found == whole, "another end");
            None
        }
        Err(BackendError::OutOfMemory(OutOfMemory { what, .. })) => Some(what),
        Err(error) => panic!("{error}"),
    };
    // Limits from 1 kB to 32 MB.
    let each: Vec<_> = (10..26).filter_map(|power| refused(&held(in_each(1 << power)))).collect();
    assert_eq!(
        (each.first(), each.last()),
        (Some(&"the place table"), Some(&"pulls of intervals")),
        "{each:?}"
    );
    // The least memory with which a settler opens. It leaves none for lists.
    let (mut too_little, mut enough) = (0, 1 << 25);
    while enough - too_little > 16 {
        let middle = u64::midpoint(too_little, enough);
        *if settler(&held(in_all(middle))).is_ok() { &mut enough } else { &mut too_little } = middle;
    }
    assert_eq!(refused(&held(in_all(enough))), Some("neighbours of chords"));
    assert_eq!(refused(&held(in_all(1 << 25))), None);
}

/// Kept positions come back, and passes from there on are the same again.
#[test]
fn what_was_kept_comes_back() {
    let plan = settling_plan(&start("jersey-3.6"));
    let begin = places(&plan);
    for device in near_devices() {
        let name = device.info().name.clone();
        let mut settler = device.settler(Arc::clone(&plan)).expect("a settler");
        settler.upload(&begin).expect("an upload");
        settler.recall().expect("nothing to recall");
        let mut read = vec![Place::default(); begin.len()];
        settler.read(&mut read).expect("places");
        assert!(read == begin, "{name}: an upload comes back as it was");
        settler.list(1.0).expect("a list");
        let pass = Pass { form: Form::Weighted, growth: 1.0, ease: 0.0, momentum: 0.8 };
        let first = settler.pass(&pass).expect("a pass");
        settler.keep().expect("places");
        let second = settler.pass(&pass).expect("a pass");
        assert!(second != first, "{name}: {second:?}");
        settler.recall().expect("places");
        settler.read(&mut read).expect("places");
        assert!(read == begin, "{name}: a pass keeps what it saw, not what it made");
        settler.list(1.0).expect("a list");
        assert_eq!(settler.pass(&pass).expect("a pass"), first, "{name}: steps are forgotten");
    }
}

/// Two-bar warp knits. Their underlaps lie along one another, and their places along one another
/// are arbitrary.
const TWO_BARS: [&str; 7] =
    ["counter-", "locknit", "reverse-", "sharkskin", "satin-0", "queenscord", "parallel-"];

/// Whether the yarns of a start have a single way to rest. They do if the weighted form suffices
/// and the start is no warp knit of two bars. Cloths that need the block form are so dense that
/// yarns buckle to one side or the other.
fn has_one_rest(start: &Start, rest: &Rest) -> bool {
    rest.block_passes == 0 && !TWO_BARS.iter().any(|name| start.name.starts_with(name))
}

/// Every start comes to rest on every device, by a check that shares no code with settling. If its
/// yarns have a single way to rest, they end where those of `cpu` do.
#[test]
fn starts_come_to_rest_on_every_device() {
    let cpu = ParallelBackend::open().expect("the CPU");
    let (mut failed, mut held) = (Vec::new(), 0);
    for start in starts() {
        let (at_rest, reference) = settle_start(&start, &cpu, |_, _| {});
        // The ends of an open piece of jammed weave are held, so that its bends can't open.
        let bend = if start.name == "plain-1.8-piece" { 0.5 } else { 0.58 };
        let one_rest = has_one_rest(&start, &at_rest);
        held += usize::from(one_rest);
        for device in near_devices() {
            let (rest, points) = settle_start(&start, device.as_ref(), |_, _| {});
            let report = check(&start, &points);
            let near = |(one, other): (&DVec3, &DVec3)| one.distance(*other) < 0.02 * start.yarns[0].radius;
            let places = reference.iter().flatten().zip(points.iter().flatten());
            let apart = places.clone().filter(|places| !near(*places)).count();
            let elsewhere = one_rest && 1000 * apart > places.count();
            if report.clearance < 0.98 || report.bend < bend || elsewhere {
                let (device, start) = (&device.info().name, &start.name);
                failed.push(format!("{device}: {start}: {apart} elsewhere, {rest:?} {report:?}"));
            }
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
    assert_eq!(held, 20, "starts with one way to rest");
}

/// Yarns that meet nowhere have no neighbours, and passes measure no distance.
#[test]
fn a_lone_yarn_sees_nothing() {
    let yarn =
        StartYarn { points: vec![DVec3::ZERO, DVec3::X, DVec3::X * 2.0], radius: 0.1, ends: Ends::Open };
    let start = Start {
        name: "one".into(),
        yarns: vec![yarn],
        repeat: [0.0; 2],
        pinned: Vec::new(),
        length: Length::Held,
    };
    let plan = settling_plan(&start);
    for device in near_devices() {
        let mut settler = device.settler(Arc::clone(&plan)).expect("a settler");
        let course = eight_passes(settler.as_mut(), Form::Block, &places(&plan)).expect("a course");
        let name = &device.info().name;
        assert_eq!(course.neighbours, [0, 0], "{name}");
        assert_eq!(
            (course.seen[7].clearance, course.seen[7].radius),
            (f32::INFINITY, f32::INFINITY),
            "{name}"
        );
        assert!(course.places == places(&plan), "{name}: nothing pulls");
    }
}
