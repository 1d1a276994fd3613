//! Cloth of plied yarns beside cloth of single yarns of equal tex.

use std::ops::ControlFlow;

use texere_contact::lengths_mm;
use texere_core::crossings::Set;
use texere_core::{Material, Section};
use texere_cpu::ParallelBackend;
use texere_fabric::{
    COTTON_LEAST_AREA, Drawdown, Finish, Measures, Stretch, Thread, Verdict, Woven, twist_from_turns_per_m,
};

use crate::surfaces::Surfaces;
use crate::{at_rest, diameter, plain, twill};

/// Cotton cloth of 12 ends and 12 picks with this twist and `section`. `ends` and `picks` are each
/// the tex and the number of threads a centimetre. Sections keep the least area of cotton yarn.
fn cotton(
    up: impl FnMut(usize, usize) -> bool,
    [ends, picks]: [(f64, f64); 2],
    turns_per_m: f64,
    section: Section,
) -> Woven {
    let threads = |(tex, per_cm): (f64, f64)| {
        let thread = Thread::new(10.0 / per_cm, diameter(tex) as f32 / 2.0);
        let twist = twist_from_turns_per_m(turns_per_m);
        vec![Thread { twist, least_area: COTTON_LEAST_AREA, ..thread }; 12]
    };
    let drawdown = Drawdown::from_fn(12, 12, up).unwrap();
    Woven::new(drawdown, threads(ends), threads(picks), vec![Material::default()], vec![section]).unwrap()
}

/// Sheeting, duck and denim, from open to so dense that single yarns are as dense as fibres allow.
/// If plies stayed round, yarns of two and three plies would crimp by up to three times as much as
/// single yarns, pierce one another and fold.
#[test]
fn plied_threads_rest_near_single_ones() {
    let plain: fn(usize, usize) -> bool = plain;
    let cloths = [
        ("open sheeting", plain, [(30.0, 16.0); 2], 650.0, 0.85),
        ("sheeting", plain, [(28.0, 23.0), (32.0, 23.0)], 700.0, 0.85),
        ("duck", plain, [(110.0, 20.0), (125.0, 14.0)], 330.0, 0.95),
        ("denim", twill, [(84.0, 28.35), (59.0, 22.05)], 500.0, 1.0),
    ];
    for (name, up, sets, turns, valley) in cloths {
        let crimps = |section: Section| {
            let rest = at_rest(&cotton(up, sets, turns, section));
            assert_eq!(rest.verdict(), Verdict::AtRest, "{name}");
            (Surfaces::new(&rest.yarns).crimp().map(|crimp| 100.0 * crimp), rest)
        };
        let (single, of_single) = crimps(Section::Circle);
        assert_eq!(of_single.valley, None);
        for plies in [2, 3] {
            let (plied, rest) = crimps(Section::plied(plies));
            println!("{name}, {plies} plies: crimp {plied:.1?} %, single {single:.1?} %, {:?}", rest.valley);
            assert_eq!(rest.valley, Some(valley), "{name}");
            for (plied, single) in plied.into_iter().zip(single) {
                assert!((plied - single).abs() < 0.25 * single + 0.3, "{name}: {plied} %, {single} %");
            }
        }
    }
}

/// In clear cloth, plies are pressed beyond the first valley, 0.85, only if a plied thread has lost
/// area and is as dense as its fibres allow. In open cloth, plied threads that are solid from the
/// start lose no area. Solid threads without plies do not count.
#[test]
fn open_cloth_of_solid_threads_keeps_its_plies() {
    let open = cotton(plain, [(30.0, 12.0); 2], 650.0, Section::plied(2));
    let solid = |thread: &Thread| Thread { least_area: 1.0, ..*thread };
    let [warp, weft] = [open.warp(), open.weft()].map(|threads| threads.iter().map(solid).collect());
    let cloth = open.with_threads(warp, weft, open.materials().to_vec(), open.sections().to_vec());
    assert_eq!(at_rest(&cloth.unwrap()).valley, Some(0.85));

    let weft = open.weft().iter().map(|thread| Thread { section: 1, ..solid(thread) }).collect();
    let sections = vec![Section::plied(2), Section::Circle];
    let cloth = open.with_threads(open.warp().to_vec(), weft, open.materials().to_vec(), sections);
    let rest = at_rest(&cloth.unwrap());
    assert_eq!(rest.valley, Some(0.85));
    assert_eq!(rest.yarns.layout().sections()[1], Section::Circle);
}

/// Plied threads that are pressed until they are round cover as much as single threads.
#[test]
fn pressed_threads_cover_as_they_are_drawn() {
    let covered = |section: Section| {
        let cloth = cotton(twill, [(84.0, 28.35), (59.0, 22.05)], 500.0, section);
        let rest = at_rest(&cloth);
        Measures::new(&cloth, &rest.yarns).unwrap().cover.unwrap().fraction
    };
    assert_eq!(covered(Section::plied(2)), covered(Section::Circle));
}

/// Plies that a design presses already are pressed no less.
#[test]
fn valleys_are_filled_and_never_dug() {
    let section = Section::Lobed { plies: 2, valley: 0.9 };
    let rest = at_rest(&cotton(plain, [(30.0, 16.0); 2], 650.0, section.clone()));
    assert_eq!(rest.yarns.layout().sections(), [section]);
    assert_eq!(rest.valley, Some(0.9));
    let rest = at_rest(&cotton(plain, [(30.0, 16.0); 2], 650.0, Section::plied(2)));
    assert_eq!(rest.yarns.layout().sections(), [Section::Lobed { plies: 2, valley: 0.85 }]);
}

/// Plied threads keep their lengths in a stretch, as others do.
#[test]
fn plied_threads_keep_their_length() {
    let cloth = cotton(plain, [(30.0, 20.0); 2], 650.0, Section::plied(2));
    let (device, pull) = (ParallelBackend::open().unwrap(), Stretch { along: Set::Warp, by: 1.02 });
    let go_on = |_| ControlFlow::Continue(());
    let (pulled, finish) = cloth.stretched(&Finish::default(), pull, 0.0, &device, go_on).unwrap();
    assert_eq!(pulled.sections(), cloth.sections());
    let pulled = pulled.at_rest(&finish, 0.0, &device, go_on).unwrap();
    let [before, after] = [&at_rest(&cloth), &pulled].map(|rest| lengths_mm(&rest.yarns));
    for (before, after) in before.iter().zip(&after) {
        assert!((after / before - 1.0).abs() < 3e-3, "{before} mm became {after} mm");
    }
}
