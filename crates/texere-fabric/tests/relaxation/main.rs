//! Knits at rest by their energy: energy and forces against an oracle, proportions of plain jersey,
//! strain against a published simulation, structures that draw in, and refusals.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test ends at what it did not expect")]

mod oracle;
mod strains;

use std::ops::ControlFlow;
use std::sync::Arc;

use glam::{DVec2, DVec3};
use oracle::{Broken, energy};
use texere_core::backend::NullBackend;
use texere_core::relaxation::{
    Elastic, Relaxation, RelaxationPlan, RelaxationSeen, RelaxationState, Relaxed, relax,
};
use texere_core::{
    Backend, BackendError, Boundary, ControlPoint, Ends, Material, RelaxationError, Section, Yarn, Yarns,
};
use texere_cpu::{ParallelBackend, SerialBackend};
use texere_fabric::warp::{Bar, Chain, WarpKnitted};
use texere_fabric::weft::{Beds, Chart, Gauge, KnitYarn, Knitted, Machine};
use texere_fabric::{
    Along, FabricError, Finish, FinishError, Finished, Piece, RelaxedKnit, RestBy, Structure, Verdict,
    elastic_of_radius,
};

const RADIUS: f64 = 0.1;

/// The share of their thickness that yarns have where forces are compared with the oracle. The
/// state was found with yarns of their whole thickness. In thinner yarns, points that are moved a
/// little press no core into another.
const GROWTH: f64 = 0.9;

/// One repeat of a knit with yarns of 0.2 mm.
fn knit(chart: &str, gauge: Gauge) -> Knitted {
    knit_of(chart, gauge, RADIUS)
}

fn knit_of(chart: &str, gauge: Gauge, radius: f64) -> Knitted {
    knit_of_material(chart, gauge, radius, Material::default())
}

fn knit_of_material(chart: &str, gauge: Gauge, radius: f64, material: Material) -> Knitted {
    let beds = if chart.contains('b') { Beds::Two } else { Beds::One };
    let program = Chart::parse(chart, beds).unwrap().program().unwrap();
    let stitches = Machine::default().knit(&program).unwrap().stitches;
    let yarns = vec![KnitYarn::new(radius as f32)];
    let (materials, sections) = (vec![material], vec![Section::Circle]);
    Knitted::new(stitches, gauge, yarns, materials, sections, [1, 1]).unwrap()
}

/// A knit as it is placed. Its loops are `diameters` times as long as the yarn is thick.
fn slack(chart: &str, diameters: f64) -> Knitted {
    let length = 2.0 * RADIUS * diameters;
    let gauge = Gauge { loop_length_mm: Some(length), ..Gauge::new(length / 3.7, length / 5.5) };
    knit(chart, gauge)
}

fn piece(chart: &str) -> Piece {
    knit(chart, Gauge::new(1.1, 0.8)).piece().unwrap()
}

fn warp_piece(chains: &[&str], size: [u32; 2]) -> Piece {
    let bars = chains.iter().map(|chain| Bar::new(Chain::parse(chain, 1).unwrap())).collect();
    let (materials, sections) = (vec![Material::default()], vec![Section::Circle]);
    let yarns = vec![KnitYarn::new(0.05)];
    let gauge = Gauge::new(1.0, 0.75);
    WarpKnitted::new(bars, gauge, size[0], size[1], yarns, materials, sections, [1, 1])
        .unwrap()
        .piece()
        .unwrap()
}

fn elastic_of(piece: &Piece) -> Vec<Elastic> {
    let radius = f64::from(piece.yarns.points()[0].half_width());
    vec![elastic_of_radius(radius); piece.yarns.layout().yarns().len()]
}

fn plan_of(piece: &Piece, elastic: &[Elastic], press: f64) -> Arc<RelaxationPlan> {
    let problem = Relaxation::new(&piece.yarns, elastic).boundary(piece.boundary.clone());
    Arc::new(RelaxationPlan::new(&problem.press(press).steps(5)).unwrap())
}

fn measured(
    device: &dyn Backend,
    plan: &Arc<RelaxationPlan>,
    state: &RelaxationState,
    growth: f64,
) -> RelaxationSeen {
    let mut relaxer = device.relaxer(Arc::clone(plan)).unwrap();
    let seen = relaxer.measure(state, growth, &mut || ControlFlow::Continue(())).unwrap();
    seen.continue_value().unwrap()
}

/// Ten pieces: eight weft knits, a tricot and a locknit. Among the weft knits are loops on both
/// beds, floats, tucks, crossed loops and moved loops.
fn pieces() -> Vec<(&'static str, Piece)> {
    let weft = ["k", "kp", "k\np", "kp\npk", "kt\ntk", "km\nmk", "kk>k\nkkkk", "RRrr\nkkkk"];
    let weft = weft.into_iter().map(|chart| (chart, piece(chart)));
    let tricot = warp_piece(&["1-0/1-2//"], [1, 2]);
    let locknit = warp_piece(&["1-0/2-3//", "1-2/1-0//"], [1, 2]);
    weft.chain([("tricot", tricot), ("locknit", locknit)]).collect()
}

/// A state in which many shells press on one another and no cores touch: yarns that have grown,
/// with every point moved a little, the same in each run.
fn pressed(plan: &Arc<RelaxationPlan>, core: f64) -> RelaxationState {
    let mut state = 0x2545_f491_4f6c_dd1d_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f64 / (1_u64 << 24) as f64 - 0.5
    };
    let mut pressed = relaxed_on(&SerialBackend::new(), plan).state;
    for point in &mut pressed.points {
        *point += DVec3::new(random(), random(), random()) * (0.1 * core);
    }
    pressed
}

#[test]
fn energy_and_forces_are_those_of_the_oracle() {
    for (name, piece) in pieces() {
        let elastic = elastic_of(&piece);
        let press = 0.3 * elastic[0].bending / elastic[0].core.powi(4);
        let plan = plan_of(&piece, &elastic, press);
        let state = pressed(&plan, elastic[0].core);
        let seen = measured(&SerialBackend::new(), &plan, &state, GROWTH);
        assert!(seen.energy.contact > 0.01 * seen.energy.bending, "{name}: {:?}", seen.energy);
        let of = |state: &RelaxationState| energy(&plan, state, [GROWTH, press], Broken::Nothing);
        let (told, found) = (seen.energy.sum(), of(&state));
        assert!((told / found - 1.0).abs() < 1e-9, "{name}: {told} for {found}");
        let most = seen.slopes.iter().map(|slope| slope.length()).fold(0.0, f64::max);
        let step = 1e-5 * elastic[0].core;
        let slope = |change: &dyn Fn(&mut RelaxationState, f64)| {
            let at = |way: f64| {
                let mut moved = state.clone();
                change(&mut moved, way);
                of(&moved)
            };
            (at(step) - at(-step)) / (2.0 * step)
        };
        // Some points, the first and the last of a yarn among them, along all axes.
        for point in [0, 1, state.points.len() / 2, state.points.len() - 1] {
            for axis in 0..3 {
                let found = slope(&|state, way| state.points[point][axis] += way);
                let told = seen.slopes[point][axis];
                assert!((told - found).abs() < 1e-5 * most, "{name}, point {point}: {told} for {found}");
            }
        }
        for axis in 0..2 {
            let found = slope(&|state, way| state.repeat[axis] += way);
            let told = seen.repeat[axis];
            assert!((told - found).abs() < 1e-4 * most, "{name}, repeat {axis}: {told} for {found}");
        }
    }
}

/// A yarn whose second interval curls so far that the two ends of the interval touch one another.
#[test]
fn an_interval_may_touch_itself() {
    let mut yarns = Yarns::builder();
    let at = [[14.0, -16.0, -0.6], [10.0, 0.0, 0.0], [10.5, 0.0, 0.8], [6.0, -10.0, 1.4]];
    yarns.yarn(Yarn::default(), &at.map(|[x, y, z]| ControlPoint::new(x, y, z, 0.1)));
    let yarns = yarns.build().unwrap();
    let boundary = Boundary::new(yarns.layout(), [24.0, 60.0], vec![Ends::Repeats([1, 0])]).unwrap();
    let elastic = [Elastic { bending: 0.01, core: 0.2, shell: 0.6, compression: 0.1, extension: 1.0 }];
    // Without a pinned point, the plan would spread the yarn's points evenly.
    let problem = Relaxation::new(&yarns, &elastic).boundary(boundary).pinned(vec![0]);
    let plan = Arc::new(RelaxationPlan::new(&problem).unwrap());
    let seen = measured(&SerialBackend::new(), &plan, plan.start(), 1.0);
    let found = energy(&plan, plan.start(), [1.0, 0.0], Broken::Nothing);
    let contacts = seen.energy.contact / seen.energy.sum();
    assert!(contacts > 0.01, "{:?}", seen.energy);
    assert!((seen.energy.sum() / found - 1.0).abs() < 1e-9, "{:?} for {found}", seen.energy);
}

/// The oracle can tell: with a term that is wrong it no longer agrees.
#[test]
fn broken_terms_are_found() {
    let piece = piece("k");
    let elastic = elastic_of(&piece);
    let plan = plan_of(&piece, &elastic, 0.0);
    let state = pressed(&plan, elastic[0].core);
    let seen = measured(&SerialBackend::new(), &plan, &state, GROWTH);
    let off = |broken| (energy(&plan, &state, [GROWTH, 0.0], broken) / seen.energy.sum() - 1.0).abs();
    assert!(off(Broken::Nothing) < 1e-9);
    for broken in [Broken::LostImages, Broken::HalfBending, Broken::Attraction] {
        assert!(off(broken) > 1e-2, "{}", off(broken));
    }
}

#[test]
fn all_cores_give_the_bits_of_one() {
    for (name, piece) in pieces() {
        let elastic = elastic_of(&piece);
        let plan = plan_of(&piece, &elastic, 0.001);
        let state = pressed(&plan, elastic[0].core);
        let serial = measured(&SerialBackend::new(), &plan, &state, 1.0);
        let parallel = measured(&ParallelBackend::open().unwrap(), &plan, &state, 1.0);
        assert_eq!(serial, parallel, "{name}");
    }
}

fn relaxed_on(device: &dyn Backend, plan: &Arc<RelaxationPlan>) -> Relaxed {
    let mut relaxer = device.relaxer(Arc::clone(plan)).unwrap();
    let relaxed = relax(plan, relaxer.as_mut(), |_| ControlFlow::Continue(())).unwrap();
    relaxed.continue_value().unwrap()
}

/// `piece` with a further control point in the middle of each interval of its spline.
fn refined(piece: &Piece) -> Piece {
    let Piece { yarns, boundary, .. } = piece;
    let (mut table, mut finer) = (Yarns::builder(), Vec::new());
    for (yarn, ends) in boundary.ends().iter().enumerate() {
        let own = yarns.yarn_points(yarn).unwrap();
        let onward = boundary.onward_mm(yarn);
        let at = |number: i64| {
            let round = number.div_euclid(own.len() as i64) as f64;
            let point = own[number.rem_euclid(own.len() as i64) as usize].position().as_dvec3();
            point + DVec3::new(onward[0], onward[1], 0.0) * round
        };
        let halves = own[0].half_width();
        let point = |at: DVec3| ControlPoint::new(at.x as f32, at.y as f32, at.z as f32, halves);
        let points: Vec<ControlPoint> = (0..own.len() as i64)
            .flat_map(|number| {
                let [before, start, end, after] = [-1, 0, 1, 2].map(|slot| at(number + slot));
                [point(start), point(0.5625 * (start + end) - 0.0625 * (before + after))]
            })
            .collect();
        table.yarn(Yarn::default(), &points);
        finer.push(*ends);
    }
    let yarns = table.build().unwrap();
    let boundary = Boundary::new(yarns.layout(), boundary.repeat(), finer).unwrap();
    Piece::new(yarns, boundary)
}

/// The yarn of Singal et al. with a core of this radius, mm.
fn acrylic(core: f64) -> Elastic {
    Elastic { bending: 0.045, core, shell: 0.74, compression: 0.0006, extension: 100.0 }
}

/// The length of a loop in the stockinette of Singal et al., mm.
const LOOP: f64 = 11.28;

/// A loop of stockinette, a wale of which is `wale` mm wide.
fn stockinette(wale: f64) -> Piece {
    let program = Chart::parse("k", Beds::One).unwrap().program().unwrap();
    let stitches = Machine::default().knit(&program).unwrap().stitches;
    let (materials, sections) = (vec![Material::default()], vec![Section::Circle]);
    let gauge = Gauge::new(wale, LOOP / 5.5);
    let yarns = vec![KnitYarn::new(0.325)];
    refined(&Knitted::new(stitches, gauge, yarns, materials, sections, [1, 1]).unwrap().piece().unwrap())
}

/// The height of a course is compared for four widths of a wale. The published simulation is that
/// of stockinette with a core of 0.300 mm in Singal, Dimitriyev et al., Nature Communications 15,
/// 2622 (2024).
#[test]
fn stockinette_follows_a_published_simulation_under_strain() {
    let elastic = [acrylic(0.3)];
    let mut pulls = Vec::new();
    for (wale, course) in [(2.8, 2.128), (3.25, 1.974), (4.06, 1.708), (5.05, 1.401)] {
        let piece = stockinette(wale);
        let problem = Relaxation::new(&piece.yarns, &elastic)
            .boundary(piece.boundary.clone())
            .length(LOOP / piece.length_mm())
            .held([true, false]);
        let plan = Arc::new(RelaxationPlan::new(&problem).unwrap());
        let relaxed = relaxed_on(&ParallelBackend::open().unwrap(), &plan);
        assert!(relaxed.at_rest && relaxed.state.repeat.x == f64::from(wale as f32), "{relaxed:?}");
        let off = relaxed.state.repeat.y / course - 1.0;
        println!("a wale of {wale} mm: {:.3} mm, published {course}", relaxed.state.repeat.y);
        assert!(off.abs() < 0.021, "a wale of {wale} mm: {} for {course}", relaxed.state.repeat.y);
        pulls.push(relaxed.pull.x / relaxed.state.repeat.y);
    }
    // The wider the cloth is held, the more it pulls. Held narrower than at rest, it pushes.
    assert!(pulls.is_sorted() && pulls[0] < 0.0 && pulls[1] > 0.0, "{pulls:?}");
}

/// Munden measured wales and courses per mm in relaxed jersey. Wales per mm times the length of a
/// loop in mm are 3.8 to 4.2, and courses per mm times that length are 5.0 to 5.5. The search for
/// rest uses no such constant.
#[test]
fn jersey_has_its_proportions() {
    let piece = stockinette(3.0);
    let elastic = [acrylic(0.325)];
    let problem = Relaxation::new(&piece.yarns, &elastic)
        .boundary(piece.boundary.clone())
        .length(LOOP / piece.length_mm());
    let relaxed = relaxed_on(&SerialBackend::new(), &Arc::new(RelaxationPlan::new(&problem).unwrap()));
    let [wales, courses] = (DVec2::splat(LOOP) / relaxed.state.repeat).to_array();
    println!("at rest: {wales:.2}, {courses:.2}");
    assert!(relaxed.at_rest, "{relaxed:?}");
    assert!((3.8..4.2).contains(&wales) && (5.0..5.6).contains(&courses), "{wales} {courses}");

    // Yarn of which only the radius is known counts as cotton. Loops of 24.4, 20.6 and 17.9
    // diameters have a tightness of 11, 13 and 15. Tightness is the root of the yarn's tex over the
    // length of a loop in cm.
    for diameters in [24.4, 20.6, 17.9] {
        let rest = at_rest(&Structure::Weft(slack("k", diameters)));
        let [wales, courses] =
            [rest.gauge.wale_mm, rest.gauge.course_mm].map(|mm| 2.0 * RADIUS * diameters / mm);
        println!("loops of {diameters} diameters: {wales:.2}, {courses:.2}");
        assert!((3.8..4.2).contains(&wales) && (5.0..5.6).contains(&courses), "{wales} {courses}");
    }
}

fn at_rest(structure: &Structure) -> RelaxedKnit {
    let finish = Finish { by: RestBy::Energy, ..Finish::default() };
    let device = ParallelBackend::open().unwrap();
    let finished = structure.settle(&finish, 0.0, &device, |_| ControlFlow::Continue(())).unwrap();
    let Finished::Relaxed(relaxed) = finished else { panic!("a knit at rest by its energy") };
    relaxed
}

fn thickness(rest: &RelaxedKnit) -> f64 {
    texere_fabric::thickness_mm(&rest.yarns) / (2.0 * RADIUS)
}

/// The gauge of jersey at rest follows from the length of its loops, and does not depend on the
/// gauge with which the loops are placed.
#[test]
fn jersey_forgets_the_gauge_of_its_needles() {
    let length = 2.0 * RADIUS * 24.4;
    let from = |wale: f64, course: f64| {
        let gauge = Gauge { loop_length_mm: Some(length), ..Gauge::new(length / wale, length / course) };
        at_rest(&Structure::Weft(knit("k", gauge))).gauge
    };
    let (wide, narrow) = (from(3.5, 5.9), from(4.4, 5.0));
    for [one, other] in [[wide.wale_mm, narrow.wale_mm], [wide.course_mm, narrow.course_mm]] {
        assert!((one / other - 1.0).abs() < 0.01, "{wide:?} {narrow:?}");
    }
}

/// A knit that is held along its courses keeps its width, and gets as high as a test of strain says
/// of the knit that is stretched to this width. Held along both, it keeps its size.
#[test]
fn a_held_knit_keeps_its_gauge() {
    let length = 2.0 * RADIUS * 20.0;
    let free = at_rest(&Structure::Weft(slack("k", 20.0))).gauge;
    let wide = Gauge { loop_length_mm: Some(length), ..Gauge::new(1.15 * free.wale_mm, free.course_mm) };
    let structure = Structure::Weft(knit("k", wide));
    let device = ParallelBackend::open().unwrap();
    let on = |_| ControlFlow::Continue(());
    let held = |along: Along| {
        let finish = Finish { by: RestBy::Energy, hold: Some(along), ..Finish::default() };
        let finished = structure.settle(&finish, 0.0, &device, on).unwrap();
        let Finished::Relaxed(relaxed) = finished else { panic!("a knit at rest by its energy") };
        assert!(relaxed.balanced && relaxed.is_linked(), "{relaxed:?}");
        relaxed.gauge
    };
    let kept = |own: f64, gauge: f64| (own / gauge - 1.0).abs() < 1e-6;
    let (courses, wales, both) = (held(Along::Courses), held(Along::Wales), held(Along::Both));
    assert!(kept(courses.wale_mm, wide.wale_mm) && !kept(courses.course_mm, wide.course_mm), "{courses:?}");
    assert!(kept(wales.course_mm, wide.course_mm) && !kept(wales.wale_mm, wide.wale_mm), "{wales:?}");
    assert!(kept(both.wale_mm, wide.wale_mm) && kept(both.course_mm, wide.course_mm), "{both:?}");
    let strains = (Along::Courses, &[0.15][..]);
    let test = structure.strain_test(&Finish::default(), 0.0, strains, &device, on).unwrap();
    let stretched = free.course_mm * (1.0 + test.states[1].strain[1]);
    assert!((courses.course_mm / stretched - 1.0).abs() < 0.01, "{courses:?}, stretched {stretched}");
}

/// Rib draws in until the wales of its face lie side by side, and garter stitch shortens.
#[test]
fn rib_draws_in() {
    let jersey = at_rest(&Structure::Weft(slack("k", 20.0)));
    let rib = at_rest(&Structure::Weft(slack("kp", 20.0)));
    let garter = at_rest(&Structure::Weft(slack("k\np", 20.0)));
    for rest in [&jersey, &rib, &garter] {
        assert!(rest.balanced && rest.is_linked() && rest.clearance.min > 1.0, "{rest:?}");
    }
    let wale = |rest: &RelaxedKnit| rest.gauge.wale_mm / (2.0 * RADIUS);
    assert!((2.4..3.7).contains(&wale(&rib)) && wale(&rib) < 0.72 * wale(&jersey), "{}", wale(&rib));
    assert!(garter.gauge.course_mm < 0.85 * jersey.gauge.course_mm, "{:?}", garter.gauge);
    // The loops of a rib lie on two levels.
    assert!((2.2..3.2).contains(&thickness(&jersey)), "{}", thickness(&jersey));
    assert!((4.0..5.7).contains(&thickness(&rib)), "{}", thickness(&rib));
}

/// The structure gets the gauge that its yarns have at rest, so that measures of the cloth are
/// right.
#[test]
fn the_gauge_follows() {
    let structure = Structure::Weft(slack("k", 18.0));
    let finish = Finish { by: RestBy::Energy, ..Finish::default() };
    let device = SerialBackend::new();
    let mut shares = Vec::new();
    let finished = structure
        .settle(&finish, 0.0, &device, |share| {
            shares.push(share);
            ControlFlow::Continue(())
        })
        .unwrap();
    assert!(shares.is_sorted() && shares[0] == 0.0 && shares.last() == Some(&1.0), "{shares:?}");
    assert_eq!(finished.verdict(), Verdict::AtRest);
    let Finished::Relaxed(rest) = &finished else { panic!("a knit at rest by its energy") };
    let [width, height] = structure.clone().at_rest_as(&finished).size_mm();
    assert_eq!([width, height], [rest.gauge.wale_mm, rest.gauge.course_mm]);
    assert!(structure.size_mm() != [width, height]);
    // The structure with this gauge comes to rest with the same gauge again.
    let again = at_rest(&structure.clone().at_rest_as(&finished)).gauge;
    assert!((again.wale_mm / rest.gauge.wale_mm - 1.0).abs() < 0.01, "{again:?} {:?}", rest.gauge);
    // The control points agree with the gauge: a loop further on, the yarn lies a wale to the side.
    let points = rest.yarns.points();
    let wale = f64::from(points[12].x - points[0].x).abs();
    assert!((wale / rest.gauge.wale_mm - 1.0).abs() < 1e-4, "{wale} {:?}", rest.gauge);
}

/// A yarn that is held at both ends, and longer than their distance, bends into one arch, as an
/// elastica does: it turns to one side everywhere.
#[test]
fn what_is_held_stays() {
    let mut table = Yarns::builder();
    let heights = [0.0, 0.9, 1.1, 0.4, -0.2, 0.3, 1.0, 1.3, 0.0];
    let points: Vec<ControlPoint> =
        heights.iter().zip(0_u8..).map(|(y, x)| ControlPoint::new(f32::from(x), *y, 0.0, 0.05)).collect();
    table.yarn(Yarn::default(), &points);
    let yarns = table.build().unwrap();
    let elastic = [elastic_of_radius(0.05)];
    let plan = Arc::new(RelaxationPlan::new(&Relaxation::new(&yarns, &elastic).pinned(vec![8, 0])).unwrap());
    let relaxed = relaxed_on(&SerialBackend::new(), &plan);
    assert!(relaxed.at_rest, "{relaxed:?}");
    let places = &relaxed.state.points;
    assert_eq!([places[0], places[8]], [0.0, 8.0].map(|x| DVec3::new(x, 0.0, 0.0)));
    for three in places.windows(3) {
        assert!((three[1] - three[0]).cross(three[2] - three[1]).z < 0.0, "{places:?}");
    }
    assert!((2.0..3.0).contains(&places[4].y), "{places:?}");
}

#[test]
fn what_can_not_rest_is_refused() {
    let finish = Finish { by: RestBy::Energy, ..Finish::default() };
    let knit = Structure::Weft(slack("k", 18.0));
    let settle = |structure: &Structure, device: &dyn Backend| {
        structure.settle(&finish, 0.0, device, |_| ControlFlow::Continue(()))
    };
    let refused = settle(&knit, &NullBackend::default());
    assert!(matches!(refused, Err(FinishError::Backend(BackendError::NoRelaxation { .. }))), "{refused:?}");
    let refused = settle(&Structure::Yarns(piece("k")), &SerialBackend::new());
    assert!(matches!(refused, Err(FinishError::NoEnergy { .. })), "{refused:?}");
    for asked in 0..4 {
        let mut looks = 0;
        let cancelled = knit.settle(&finish, 0.0, &SerialBackend::new(), |_| {
            looks += 1;
            if looks > asked * 40 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        assert!(matches!(cancelled, Err(FinishError::Fabric(FabricError::Cancelled))), "{cancelled:?}");
        assert_eq!(looks, asked * 40 + 1);
    }
}

#[test]
fn plans_refuse_what_no_yarn_has() {
    let piece = piece("k");
    let sound = elastic_of(&piece);
    let plan = |elastic: &[Elastic]| {
        let problem = Relaxation::new(&piece.yarns, elastic).boundary(piece.boundary.clone());
        RelaxationPlan::new(&problem).map(|_| ())
    };
    assert_eq!(plan(&sound), Ok(()));
    assert_eq!(plan(&[]), Err(RelaxationError::ElasticCount { given: 0, yarns: 1 }));
    for (property, wrong) in [
        ("a bending stiffness", Elastic { bending: f64::NAN, ..sound[0] }),
        ("a core", Elastic { core: 0.0, ..sound[0] }),
        ("a shell", Elastic { shell: 0.5 * sound[0].core, ..sound[0] }),
        ("a compression stiffness", Elastic { compression: f64::INFINITY, ..sound[0] }),
        ("an extension stiffness", Elastic { extension: -1.0, ..sound[0] }),
    ] {
        let refused = plan(&[wrong]);
        let Err(RelaxationError::Elastic { property: named, .. }) = refused else { panic!("{refused:?}") };
        assert_eq!(named, property);
    }
    let thin = Elastic { core: 1e-5, ..sound[0] };
    assert!(matches!(plan(&[thin]), Err(RelaxationError::Interval { yarn: 0, .. })));
    let problem = || Relaxation::new(&piece.yarns, &sound).boundary(piece.boundary.clone());
    let refused = RelaxationPlan::new(&problem().length(3.0)).map(|_| ());
    assert!(matches!(refused, Err(RelaxationError::Setting { setting: "the length", .. })), "{refused:?}");
    let refused = RelaxationPlan::new(&problem().pinned(vec![12])).map(|_| ());
    assert_eq!(refused, Err(RelaxationError::Pinned { point: 12, points: 12 }));
    let mut short = Yarns::builder();
    short.yarn(Yarn::default(), &[0.0, 1.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
    let short = short.build().unwrap();
    let boundary = Boundary::new(short.layout(), [2.0, 0.0], vec![Ends::Repeats([1, 0])]).unwrap();
    let refused = RelaxationPlan::new(&Relaxation::new(&short, &sound).boundary(boundary)).map(|_| ());
    assert_eq!(refused, Err(RelaxationError::TooFewPoints { yarn: 0, points: 2, least: 3 }));
}
