//! Sections follow the yarn: its stiffness, its twist, its flatness, and the threads beside it.

use texere_core::{Material, Origin, Section, Yarns};
use texere_fabric::{
    COTTON_DENSITY, COTTON_LEAST_AREA, Drawdown, Thread, Verdict, Woven, WovenRest, diameter_mm,
    firmness_from_twist, tex_from_cotton_count, twist_from_turns_per_m,
};

use crate::solid::least_drawn;
use crate::surfaces::Surfaces;
use crate::{at_rest, plain, twill};

/// Cloth of these ends and picks, with the warp on the face where `up` says so.
fn woven(up: impl FnMut(usize, usize) -> bool, warp: Vec<Thread>, weft: Vec<Thread>) -> Woven {
    let drawdown = Drawdown::from_fn(warp.len(), weft.len(), up).unwrap();
    Woven::new(drawdown, warp, weft, vec![Material::default()], vec![Section::Circle]).unwrap()
}

/// Plain weave of 12 ends and picks of cotton, of `tex` and `per_cm`. `change` changes the threads.
fn cotton(tex: f64, per_cm: f64, change: impl Fn(&mut Thread)) -> Woven {
    let mut thread = Thread::new(10.0 / per_cm, (diameter_mm(tex, COTTON_DENSITY) / 2.0) as f32);
    change(&mut thread);
    woven(plain, vec![thread; 12], vec![thread; 12])
}

/// Width over height of the sections, and their area over that of the round yarn, each as the mean
/// over all control points of the ends.
fn shape(cloth: &Woven, yarns: &Yarns) -> [f64; 2] {
    let ends = cloth.warp().len();
    let radius = f64::from(cloth.warp()[0].radius_mm);
    let points: Vec<[f64; 2]> = (0..ends)
        .flat_map(|end| yarns.yarn_points(end).unwrap())
        .map(|at| [at.half_width(), at.half_height()].map(f64::from))
        .collect();
    let mean = |of: &dyn Fn(&[f64; 2]) -> f64| points.iter().map(of).sum::<f64>() / points.len() as f64;
    [mean(&|[wide, high]| wide / high), mean(&|[wide, high]| wide * high / (radius * radius))]
}

/// The rest of a cloth that comes to rest.
fn rested(cloth: &Woven) -> WovenRest {
    let rest = at_rest(cloth);
    assert_eq!(rest.verdict(), Verdict::AtRest, "{:?}", rest.crossings);
    rest
}

/// A stiffer yarn resists flattening as it resists bending. A flat thread has to bend less. If
/// stiffness resisted bending alone, stiff yarn would therefore become a ribbon.
#[test]
fn stiff_yarn_stays_round() {
    let mut before: Option<([f64; 2], f64)> = None;
    for stiffness in [0.1, 1.0, 10.0, 100.0] {
        let cloth = cotton(30.0, 22.0, |thread| thread.stiffness = stiffness);
        let rest = rested(&cloth);
        let ([aspect, area], thickness) =
            (shape(&cloth, &rest.yarns), Surfaces::new(&rest.yarns).thickness());
        println!("stiffness {stiffness}: {aspect:.2} : 1, area {area:.3}, {thickness:.3} mm");
        if let Some(([aspect_before, area_before], thickness_before)) = before {
            assert!(aspect < aspect_before && thickness > thickness_before, "{stiffness}");
            assert!(stiffness < 1.0 || area > area_before - 0.03, "{stiffness}: {area}, {area_before}");
        }
        before = Some(([aspect, area], thickness));
    }
}

/// A taffeta of filament without twist, with 190 threads to the square inch, covers more than 97 %
/// of its area, so that hardly any light comes through. Hard-twisted yarn stays nearly round in
/// sheeting.
#[test]
fn filament_covers_and_hard_twist_stays_round() {
    let taffeta = |firmness: f32| {
        let radius_mm = (diameter_mm(7.5, 1.0) / 2.0) as f32;
        let thread =
            |per_inch: f64| Thread { stiffness: 0.2, firmness, ..Thread::new(25.4 / per_inch, radius_mm) };
        woven(plain, vec![thread(113.0); 12], vec![thread(77.0); 12])
    };
    // Peirce's cover of both sets together.
    let cover = |cloth: &Woven| {
        let [ends, picks] = Surfaces::new(&rested(cloth).yarns).widths();
        let [ends, picks] = [ends / cloth.warp()[0].spacing_mm, picks / cloth.weft()[0].spacing_mm];
        ends + picks - ends * picks
    };
    let [filament, spun] = [firmness_from_twist(0.0, 0.05), 1.0].map(taffeta).map(|cloth| cover(&cloth));
    println!("taffeta covers {filament:.3}, of spun yarn {spun:.3}");
    assert!(filament > 0.97 && spun < 0.85, "{filament}, {spun}");

    let sheeting = |turns: f64| {
        let cloth = cotton(20.0, 24.0, |thread| {
            thread.firmness = firmness_from_twist(twist_from_turns_per_m(turns), thread.radius_mm);
        });
        shape(&cloth, &rested(&cloth).yarns)[0]
    };
    let [soft, ordinary, voile, crepe] = [300.0, 800.0, 1400.0, 3000.0].map(sheeting);
    println!("sheeting: {soft:.2}, {ordinary:.2}, {voile:.2}, {crepe:.2} : 1");
    assert!(soft > 2.0 && (1.4..2.0).contains(&ordinary), "{soft}, {ordinary}");
    assert!(voile < 1.3 && crepe < 1.1 && crepe > 1.0, "{voile}, {crepe}");
}

/// A yarn that is flat on the bobbin is flatter in the cloth than a round one.
#[test]
fn flatness_is_the_shape_that_a_yarn_wants() {
    let aspect = |flatness: f32| {
        let cloth = cotton(20.0, 24.0, |thread| thread.flatness = flatness);
        shape(&cloth, &rested(&cloth).yarns)[0]
    };
    let [upright, round, flat] = [0.7, 1.0, 2.0].map(aspect);
    assert!(upright < 0.9 * round && flat > 1.5 * round, "{upright}, {round}, {flat}");
}

/// An end of six times the tex is squeezed no further than to solid fibre, and the ends beside it
/// lie further away.
#[test]
fn neighbours_give_way_to_a_thick_end() {
    let thread = |tex: f64| Thread::new(10.0 / 38.0, (diameter_mm(tex, COTTON_DENSITY) / 2.0) as f32);
    let warp: Vec<_> = (0..12).map(|end| thread(if end == 5 { 60.0 } else { 10.0 })).collect();
    let cloth = woven(plain, warp, vec![thread(10.0); 12]);
    let rest = rested(&cloth);
    let surfaces = Surfaces::new(&rest.yarns);
    assert!(surfaces.clearance() >= 0.98, "{}", surfaces.clearance());
    let least = least_drawn(&cloth, &rest.yarns);
    assert!(least >= COTTON_LEAST_AREA - 2e-3, "{least}");
    let place = |end: u32| {
        let yarns = rest.yarns.layout().yarns();
        let number = yarns.iter().position(|yarn| yarn.origin == Origin::End(end + 1)).unwrap();
        let points = rest.yarns.yarn_points(number).unwrap();
        points.iter().map(|at| f64::from(at.x)).sum::<f64>() / points.len() as f64
    };
    let gaps: Vec<f64> = (0..11).map(|end| place(end + 1) - place(end)).collect();
    println!("{gaps:.3?} mm");
    assert!(gaps[4] > 1.05 * gaps[1] && gaps[5] > 1.05 * gaps[1], "{gaps:?}");
}

/// A 2/2 twill.
fn even_twill(end: usize, pick: usize) -> bool {
    (end + 16 - pick) % 4 < 2
}

/// Three ends of hard yarn and one of soft yarn, so dense that the hard ones would crowd beside the
/// soft one, and picks would pierce them where they change sides between two of them. The cloth
/// rests clear if its threads stay in their places.
#[test]
fn dense_cloth_of_hard_and_soft_ends_is_clear() {
    let radius = (diameter_mm(tex_from_cotton_count(7.0), COTTON_DENSITY) / 2.0) as f32;
    let firmness = firmness_from_twist(twist_from_turns_per_m(500.0), radius);
    let soft = |pitch: f64| Thread::new(pitch, 0.15);
    let pitch = |per_inch: f64| 25.4 / per_inch;
    let ends = |per_inch: f64| {
        let hard = Thread { firmness, ..Thread::new(pitch(per_inch), radius) };
        (0..16).map(|end| if end % 4 == 3 { soft(pitch(per_inch)) } else { hard }).collect()
    };
    for (name, up, per_inch) in
        [("2/2", &even_twill as &dyn Fn(usize, usize) -> bool, 56.0), ("3/1", &twill, 60.0)]
    {
        let cloth = woven(up, ends(per_inch), vec![soft(0.45); 16]);
        let rest = rested(&cloth);
        let clearance = Surfaces::new(&rest.yarns).clearance();
        println!("{name}: {clearance:.4}");
        assert!(clearance >= 0.985, "{name}: {clearance}");
        assert!(least_drawn(&cloth, &rest.yarns) >= COTTON_LEAST_AREA - 2e-3, "{name}");
    }
}

/// Yarns that differ in their names alone rest as one yarn does, also in cloth without room.
#[test]
fn colors_do_not_change_how_cloth_rests() {
    let thread = Thread::new(0.3, 0.15);
    let other = Thread { material: 1, section: 1, ..thread };
    let points = |threads: [Thread; 2]| {
        let threads: Vec<Thread> = threads.into_iter().cycle().take(8).collect();
        let drawdown = Drawdown::from_fn(8, 8, even_twill).unwrap();
        let (materials, sections) = (vec![Material::default(); 2], vec![Section::Circle; 2]);
        let cloth = Woven::new(drawdown, threads.clone(), threads, materials, sections).unwrap();
        let rest = at_rest(&cloth);
        assert_ne!(rest.verdict(), Verdict::AtRest);
        rest.yarns.points().to_vec()
    };
    assert_eq!(points([thread, thread]), points([thread, other]));
}

/// Two ends that work as one close up, because the picks are taut where they change sides. So do
/// the picks of a hopsack.
#[test]
fn threads_that_work_as_one_close_up() {
    let (warp, weft) = (tex_from_cotton_count(40.0), tex_from_cotton_count(20.0));
    let threads = |tex: f64, pitch: f64, count: usize| {
        vec![Thread::new(pitch, (diameter_mm(tex, COTTON_DENSITY) / 2.0) as f32); count]
    };
    let hopsack = |end: usize, pick: usize| (end % 4 < 2) == (pick % 4 < 2);
    let oxford = |end: usize, pick: usize| (end % 4 < 2) == pick.is_multiple_of(2);
    for (name, up, sets) in [
        ("oxford", &oxford as &dyn Fn(usize, usize) -> bool, [(warp, 0.254), (weft, 0.508)]),
        ("hopsack", &hopsack, [(weft, 0.4), (weft, 0.4)]),
    ] {
        let [ends, picks] = sets.map(|(tex, pitch)| threads(tex, pitch, 12));
        let cloth = woven(up, ends, picks);
        let rest = rested(&cloth);
        assert!(Surfaces::new(&rest.yarns).clearance() >= 0.98, "{name}");
        // The place of a thread, and how far the next thread is from it.
        let place = |number: usize| {
            let points = rest.yarns.yarn_points(number).unwrap();
            let along = points.iter().map(|at| if number < 12 { at.x } else { at.y });
            f64::from(along.sum::<f32>()) / points.len() as f64
        };
        let gap = |first: usize| place(first + 1) - place(first);
        let [pair, apart] = [gap(4), gap(5)];
        println!("{name}: ends {pair:.3} and {apart:.3} mm apart");
        assert!(apart > 1.5 * pair && (pair + apart - 2.0 * sets[0].1).abs() < 0.01, "{pair} {apart}");
        let [pair, apart] = [gap(16), gap(17)];
        if name == "hopsack" {
            assert!(apart > 1.5 * pair, "picks {pair} {apart}");
        } else {
            assert!((pair - apart).abs() < 0.01, "picks {pair} {apart}");
        }
    }
}
