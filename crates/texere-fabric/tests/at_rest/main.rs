//! Commercial cloths at rest. Their surfaces, as drawn, are measured with sections that the test
//! samples itself.

#![allow(clippy::unwrap_used, reason = "a test ends at what it did not expect")]

mod layers;
mod plies;
mod progress;
mod selvedge;
mod setts;
mod shape;
mod solid;
mod stretch;
mod surfaces;

use std::ops::ControlFlow;

use glam::DVec2;
use texere_contact::clearance;
use texere_core::crossings::Set;
use texere_core::settling::Length;
use texere_core::{Material, Section, Settings, Yarns};
use texere_cpu::ParallelBackend;
use texere_fabric::{
    BySet, COTTON_LEAST_AREA, Drawdown, Finish, Relief, Structure, Thread, Verdict, Woven, WovenDesign,
    WovenRest, tex_from_cotton_count,
};

use surfaces::Surfaces;

/// A cloth, its yarns in tex, and its bounds.
struct Cloth {
    name: &'static str,
    woven: Woven,
    tex: [f64; 2],
    /// The least share that is left of the sections' area in warp and in weft.
    area: [f64; 2],
    /// Published crimp of warp and weft, per cent. Measured crimp has to lie within four points of
    /// the published one.
    crimp: [Option<f64>; 2],
}

/// Peirce's diameter of a cotton yarn, mm.
fn diameter(tex: f64) -> f64 {
    0.0373 * tex.sqrt()
}

fn cloth(
    name: &'static str,
    (tex, pitch): ([f64; 2], [f64; 2]),
    [ends, picks]: [usize; 2],
    up: impl FnMut(usize, usize) -> bool,
    area: [f64; 2],
    crimp: [Option<f64>; 2],
) -> Cloth {
    let threads =
        |set: usize, count: usize| vec![Thread::new(pitch[set], diameter(tex[set]) as f32 / 2.0); count];
    let drawdown = Drawdown::from_fn(ends, picks, up).unwrap();
    let (warp, weft) = (threads(0, ends), threads(1, picks));
    let woven = Woven::new(drawdown, warp, weft, vec![Material::default()], vec![Section::Circle]).unwrap();
    Cloth { name, woven, tex, area, crimp }
}

fn twill(end: usize, pick: usize) -> bool {
    !(end + 400 - pick).is_multiple_of(4)
}

fn plain(end: usize, pick: usize) -> bool {
    (end + pick).is_multiple_of(2)
}

fn satin(end: usize, pick: usize) -> bool {
    !(end + 64 - 3 * (pick % 8)).is_multiple_of(8)
}

/// Cloths with counts and threads per inch as on sale, and cloths of one yarn at pitches of 1.25 to
/// 3 diameters.
///
/// The crimp of two cloths lies outside the published range, so that no crimp is given for them:
/// denim's warp crimps by 24 % (mills: 10 to 14 %), and sateen's warp by 7.8 % (Taylor: 3.2 %).
///
/// Sources of crimp. Poplin: "the warp crimp could be 14 % and the weft crimp only 2 %"
/// (<https://www.textilecalculations.com/calculate-crimp-percentage-of-woven-fabric/>). Sheeting
/// and sateen: J. T. Taylor, "Cotton weaving and designing", 6th edition. By Taylor, crimp in per
/// cent is four times the intersections to the inch, in medium cloths three times, over the weft's
/// count.
fn cloths() -> Vec<Cloth> {
    let cotton = |warp: f64, weft: f64, ends: f64, picks: f64| {
        ([warp, weft].map(tex_from_cotton_count), [25.4 / ends, 25.4 / picks])
    };
    let square = |count: f64, pitch: f64| {
        let tex = tex_from_cotton_count(count);
        ([tex; 2], [diameter(tex) * pitch; 2])
    };
    let five = |end: usize, pick: usize| !(end + 25 - 2 * (pick % 5)).is_multiple_of(5);
    let two = |end: usize, pick: usize| (end + 400 - pick) % 4 < 2;
    let damask =
        |end: usize, pick: usize| if end < 32 || pick < 32 { satin(end, pick) } else { plain(end, pick) };
    let taylor = |picks: f64, share: f64, times: f64, count: f64| Some(picks * share * times / count);
    let none = [None; 2];
    vec![
        cloth("denim", cotton(7.0, 10.0, 72.0, 56.0), [16, 16], twill, [0.76, 0.78], none),
        cloth(
            "poplin",
            cotton(40.0, 40.0, 133.0, 72.0),
            [10, 10],
            plain,
            [0.92, 0.93],
            [Some(14.0), Some(2.0)],
        ),
        cloth(
            "sheeting",
            cotton(20.0, 20.0, 60.0, 60.0),
            [10, 10],
            plain,
            [0.935; 2],
            [taylor(60.0, 1.0, 3.0, 20.0); 2],
        ),
        cloth("drill", cotton(20.0, 16.0, 108.0, 56.0), [16, 16], twill, [0.92, 0.94], none),
        cloth("sateen", cotton(60.0, 60.0, 173.0, 120.0), [15, 15], five, [0.93; 2], none),
        cloth("satin of 8", square(30.0, 1.25), [24, 24], satin, [0.89; 2], none),
        cloth("twill 2/2", square(20.0, 1.5), [16, 16], two, [0.75; 2], none),
        cloth("plain, jam", square(20.0, 3.0_f64.sqrt()), [10, 10], plain, [0.9; 2], none),
        cloth("plain, 2 d", square(20.0, 2.0), [10, 10], plain, [0.93; 2], none),
        cloth("plain, 3 d", square(20.0, 3.0), [10, 10], plain, [0.955; 2], none),
        cloth("Jacquard", square(20.0, 1.75), [64, 64], damask, [0.945; 2], none),
    ]
}

fn at_rest(woven: &Woven) -> WovenRest {
    finished(woven, &Finish::default())
}

fn finished(woven: &Woven, finish: &Finish) -> WovenRest {
    woven.at_rest(finish, 0.0, &ParallelBackend::open().unwrap(), |_| ControlFlow::Continue(())).unwrap()
}

/// The radius of the tightest bend, over the distance by which the thread reaches into it.
fn tightest(yarns: &Yarns) -> f64 {
    clearance(yarns, &Settings::default()).unwrap().curvature_min
}

/// Weight from count, sett and a crimp of 6 %: (ends / count + picks / count) x 1.06 x 23.27
/// (<https://apparel-analysis.blogspot.com/2013/06/how-to-determine-gsm-of-woven-fabric.html>).
fn usual_weight(cloth: &Cloth) -> f64 {
    let sets = [(cloth.woven.warp(), cloth.tex[0]), (cloth.woven.weft(), cloth.tex[1])];
    let heavy =
        |(threads, tex): (&[Thread], f64)| 25.4 / threads[0].spacing_mm / (tex_from_cotton_count(1.0) / tex);
    sets.map(heavy).iter().sum::<f64>() * 1.06 * 23.27
}

#[test]
fn cloths_of_the_mills_come_to_rest() {
    for cloth in cloths() {
        let Cloth { name, woven, tex, .. } = &cloth;
        let rest = at_rest(woven);
        let surfaces = Surfaces::new(&rest.yarns);
        let (clearance, crimp) = (surfaces.clearance(), surfaces.crimp());
        let sets = [woven.warp(), woven.weft()];
        let spacing = [0, 1].map(|set| sets[set][0].spacing_mm);
        // One repeat in the middle, seen from above.
        let middle = DVec2::from(woven.size_mm()) / 2.0;
        let repeat = DVec2::new(spacing[0] * rest.repeat.warp as f64, spacing[1] * rest.repeat.weft as f64);
        let [ground, weft] = surfaces.seen([middle - repeat / 2.0, middle + repeat / 2.0], 200);
        let widths = surfaces.widths();
        let bare = [0, 1].map(|set| (1.0 - widths[set] / spacing[set]).max(0.0));
        let cover = 1.0 - bare[0] * bare[1];
        let weight: f64 = [0, 1].map(|set| (1.0 + crimp[set]) * tex[set] / spacing[set]).iter().sum();
        println!(
            "{name:10} {:3} passes, clearance {:.3} -> {:.3} (by sections {clearance:.3}) in {}, area {:.3} {:.3} ({:.2} {:.2}), lost {:.3} \
             {:.3}, crimp {:.1} {:.1} %, cover {:.1} % (by widths {:.1} %), weft {:.0} %, {:.2} mm, {weight:.0} g/m2 (usual {:.0})",
            rest.crossings.passes,
            rest.clearance[0],
            rest.clearance[1],
            rest.rounds,
            rest.area.warp,
            rest.area.weft,
            rest.area_least.warp,
            rest.area_least.weft,
            rest.area_lost.warp,
            rest.area_lost.weft,
            crimp[0] * 100.0,
            crimp[1] * 100.0,
            (1.0 - ground) * 100.0,
            cover * 100.0,
            weft * 100.0,
            surfaces.thickness(),
            usual_weight(&cloth),
        );
        assert_eq!(rest.verdict(), Verdict::AtRest, "{name}");
        assert!(clearance >= 0.98, "{name}: clearance {clearance}");
        let least = rest.area_least.into_array().map(|area| area as f32);
        assert!(least.iter().all(|&area| area >= COTTON_LEAST_AREA - 1e-3), "{name}: {least:?}");
        assert!(tightest(&rest.yarns) >= 1.0, "{name} folds: {}", tightest(&rest.yarns));
        // `rest.clearance` counts no contacts above 0.99.
        assert!(
            (rest.clearance[1] - clearance.min(0.99)).abs() < 0.008,
            "{name}: {} and {clearance}",
            rest.clearance[1]
        );
        let areas = rest.area.into_array();
        for set in 0..2 {
            assert!(areas[set] >= cloth.area[set], "{name}: area {:?}", rest.area);
            let off = cloth.crimp[set].map_or(0.0, |published| 100.0 * crimp[set] - published);
            assert!(off.abs() < 4.0, "{name}: crimp {crimp:?}");
        }
        assert!((weight / usual_weight(&cloth) - 1.0).abs() < 0.1, "{name}: {weight} g/m2");
        // The widths of the Jacquard's threads change where its weaves border on one another.
        let even = *name != "Jacquard";
        assert!(!even || (1.0 - ground - cover).abs() < 0.02, "{name}: cover {} and {cover}", 1.0 - ground);
        assert!(ground < 1e-3 || !["denim", "drill"].contains(name), "{ground}");
    }
}

/// Threads without any room keep at least 35 % of the area that they have before they are made
/// thinner, and their clearance is then no worse than before.
#[test]
fn cloth_without_room_is_no_worse() {
    let thread = |pitch: f64| vec![Thread::new(pitch, 0.0837); 8];
    for pitch in [0.042, 0.1] {
        let drawdown = Drawdown::from_fn(8, 8, plain).unwrap();
        let woven = Woven::new(
            drawdown,
            thread(pitch),
            thread(pitch),
            vec![Material::default()],
            vec![Section::Circle],
        );
        let rest = at_rest(&woven.unwrap());
        let [before, after] = rest.clearance;
        assert!(before < 0.98 && after >= before, "{:?}", rest.clearance);
        for set in Set::BOTH {
            let [kept, lost] = [rest.area[set], rest.area_lost[set]];
            assert!(kept >= 0.35 * (kept + lost), "{:?} {:?}", rest.area, rest.area_lost);
        }
    }
}

/// The measure is able to fail: round yarns at a commercial sett pierce one another.
#[test]
fn round_yarns_at_a_mills_sett_pierce() {
    let denim = cloths().swap_remove(0);
    let clearance = Surfaces::new(&denim.woven.yarns().unwrap()).clearance();
    assert!(clearance < 0.85, "{clearance}");
}

fn chance(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 40) as f64 / (1_u64 << 24) as f64
}

/// Cloth of random threads and crossings, in which nothing repeats, becomes clear and does not
/// fold. Every thread runs from edge to edge and never turns back.
#[test]
fn uneven_cloth_comes_to_rest_whole() {
    let mut seed = 11;
    let mut threads = |count: usize| -> Vec<Thread> {
        let thread = |_| {
            Thread::new(
                0.42 * (0.95 + 0.1 * chance(&mut seed)),
                (0.1 * (0.9 + 0.2 * chance(&mut seed))) as f32,
            )
        };
        (0..count).map(thread).collect()
    };
    let (warp, weft) = (threads(14), threads(12));
    let drawdown = Drawdown::from_fn(14, 12, |_, _| chance(&mut seed) > 0.5).unwrap();
    let woven = Woven::new(drawdown, warp, weft, vec![Material::default()], vec![Section::Circle]).unwrap();
    let rest = at_rest(&woven);
    assert_eq!(rest.repeat, BySet { warp: 14, weft: 12 });
    let clearance = Surfaces::new(&rest.yarns).clearance();
    assert!(tightest(&rest.yarns) >= 1.0);
    println!("uneven: {:?} (by sections {clearance:.3}), area {:?}", rest.clearance, rest.area);
    assert!(clearance >= 0.98, "{clearance}");
    let [width, height] = woven.size_mm();
    for yarn in 0..26 {
        let points = rest.yarns.yarn_points(yarn).unwrap();
        let [first, last] = [points[0], points[points.len() - 1]];
        let [from, to, end] =
            if yarn < 14 { [first.y, last.y, height as f32] } else { [first.x, last.x, width as f32] };
        assert!(from.abs() < 1e-6 && (to - end).abs() < 1e-5, "yarn {yarn}: {from} to {to}, {end}");
        let along = |two: &[texere_core::ControlPoint]| {
            if yarn < 14 { two[1].y - two[0].y } else { two[1].x - two[0].x }
        };
        assert!(points.windows(2).all(|two| along(two) > 0.0), "yarn {yarn} turns back");
    }
}

/// A woven structure comes to rest by its crossings, and is measured by its yarns at rest. Settings
/// that only knits have are refused.
#[test]
fn a_woven_structure_comes_to_rest() {
    let cotton = Material { tex: Some(tex_from_cotton_count(20.0) as f32), ..Material::default() };
    let sheeting = cloths().swap_remove(2).woven;
    let threads = |set: &[Thread]| set.to_vec();
    let sheeting = Woven::new(
        sheeting.drawdown().clone(),
        threads(sheeting.warp()),
        threads(sheeting.weft()),
        vec![cotton],
        vec![Section::Circle],
    )
    .unwrap();
    let structure = Structure::Woven(WovenDesign::new(sheeting.clone(), None, Relief::Report).unwrap());
    let device = ParallelBackend::open().unwrap();
    let mut shares = vec![0.0];
    let settle = |finish: &Finish, shares: &mut Vec<f64>| {
        structure.settle(finish, 0.0, &device, |done| {
            shares.push(done);
            ControlFlow::Continue(())
        })
    };
    let finished = settle(&Finish::default(), &mut shares).unwrap();
    assert!(shares.is_sorted() && shares.last() == Some(&1.0), "{shares:?}");
    assert!(finished.is_at_rest());
    assert_eq!(finished.yarns().points(), at_rest(&sheeting).yarns.points());
    let measures = structure.measures(finished.yarns()).unwrap();
    let surfaces = Surfaces::new(finished.yarns());
    let (widths, crimp) = (surfaces.widths(), surfaces.crimp());
    let (fractions, own) =
        (measures.cover.unwrap().fraction.into_array(), measures.crimp.unwrap().into_array());
    for set in 0..2 {
        let [fraction, waves] = [fractions[set], own[set]];
        assert!((fraction * 25.4 / 60.0 / widths[set] - 1.0).abs() < 0.02, "{fraction} {widths:?}");
        assert!((waves - crimp[set]).abs() < 0.005, "{waves} {crimp:?}");
    }
    // As woven, threads are round, and cover less.
    let woven = structure.measures(&structure.yarns().unwrap()).unwrap();
    assert!(measures.cover.unwrap().cloth > woven.cover.unwrap().cloth + 0.05);
    for (finish, asked) in [
        (Finish { length: Some(Length::Held), ..Finish::default() }, "a length"),
        (Finish { press_mm: Some(0.2), ..Finish::default() }, "a press"),
        (Finish { record: true, ..Finish::default() }, "a course"),
    ] {
        let refused = settle(&finish, &mut Vec::new()).unwrap_err().to_string();
        assert!(refused.contains(asked), "{refused}");
    }
}

/// Stiff threads stay straight, and threads that cross them crimp. If both sets are equally stiff,
/// they have the same crimp.
#[test]
fn stiff_threads_stay_straight() {
    let sheeting = cloths().swap_remove(2).woven;
    let crimp = |stiffness: [f32; 2]| {
        let stiff = |set: &[Thread], stiffness: f32| {
            set.iter().map(|thread| Thread { stiffness, ..*thread }).collect()
        };
        let (warp, weft) = (stiff(sheeting.warp(), stiffness[0]), stiff(sheeting.weft(), stiffness[1]));
        let (materials, sections) = (sheeting.materials().to_vec(), sheeting.sections().to_vec());
        let cloth = Woven::new(sheeting.drawdown().clone(), warp, weft, materials, sections);
        let surfaces = Surfaces::new(&at_rest(&cloth.unwrap()).yarns);
        assert!(surfaces.clearance() >= 0.98);
        surfaces.crimp()
    };
    let (even, stiff_warp, stiff) = (crimp([1.0; 2]), crimp([4.0, 1.0]), crimp([4.0; 2]));
    println!("crimp of sheeting {even:?}, with a stiff warp {stiff_warp:?}, all stiff {stiff:?}");
    assert!(stiff_warp[0] < 0.5 * even[0] && stiff_warp[1] > 1.5 * even[1], "{even:?} {stiff_warp:?}");
    // The weft is tauter by 0.4 %.
    assert!((stiff[0] / stiff[1] - 1.0).abs() < 3e-3, "{stiff:?}");
}

/// A taut set straightens, and the other set takes its crimp. A calender makes the cloth thinner,
/// and is refused above its limit.
#[test]
fn a_finish_is_felt() {
    let sheeting = cloths().swap_remove(2).woven;
    let of = |finish: Finish| {
        let rest = finished(&sheeting, &finish);
        let surfaces = Surfaces::new(&rest.yarns);
        assert!(surfaces.clearance() >= 0.98);
        (surfaces.crimp(), surfaces.thickness())
    };
    let (relaxed, thick) = of(Finish::default());
    let (taut, _) = of(Finish { taut: BySet { warp: 8.0, weft: 1.0 }, ..Finish::default() });
    let (slack, _) = of(Finish { taut: BySet { warp: 1.0, weft: 8.0 }, ..Finish::default() });
    assert!((relaxed[0] / relaxed[1] - 1.0).abs() < 0.05, "{relaxed:?}");
    assert!(taut[0] < 0.7 * relaxed[0] && taut[1] > 1.2 * relaxed[1], "{taut:?} {relaxed:?}");
    assert!((taut[0] / slack[1] - 1.0).abs() < 0.05, "{taut:?} {slack:?}");
    let (_, thin) = of(Finish { calender: 10.0, ..Finish::default() });
    println!("relaxed {relaxed:?}, taut warp {taut:?}, {thick:.3} mm, calendered {thin:.3} mm");
    assert!(thin < 0.95 * thick, "{thin} {thick}");
    let refused = sheeting.at_rest(
        &Finish { calender: 11.0, ..Finish::default() },
        0.0,
        &ParallelBackend::open().unwrap(),
        |_| ControlFlow::Continue(()),
    );
    assert!(refused.unwrap_err().to_string().contains("press is 11"));
}

/// With a selvedge the weft is one yarn, and its turns stay clear of the edge ends.
#[test]
fn a_selvedge_holds() {
    let mut woven = cloths().swap_remove(2).woven;
    woven.set_selvedge(true);
    let rest = at_rest(&woven);
    assert_eq!(rest.yarns.layout().yarns().len(), 11);
    let clearance = Surfaces::new(&rest.yarns).clearance();
    println!("selvedge: {:?} (by sections {clearance:.3})", rest.clearance);
    assert!(clearance >= 0.98, "{clearance}");
}
