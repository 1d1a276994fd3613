//! Yarns are never squeezed beyond solid fibre, and dense cloth comes to rest.

use std::ops::ControlFlow;

use texere_contact::lengths_mm;
use texere_core::{Material, Origin, Section, Yarns};
use texere_cpu::ParallelBackend;
use texere_fabric::{
    COTTON_LEAST_AREA, Drawdown, Fibre, Finish, PACKING, Structure, Thread, Verdict, Woven, WovenDesign,
    diameter_mm, tex_from_cotton_count,
};

use crate::surfaces::Surfaces;
use crate::{at_rest, chance, cloth, tightest};

/// The least area of any section of a yarn, as drawn, over the area of the round yarn.
pub(crate) fn least_drawn(woven: &Woven, yarns: &Yarns) -> f32 {
    let least = |number: usize| {
        let radius = match yarns.layout().yarns()[number].origin {
            Origin::End(end) => woven.warp()[end as usize - 1].radius_mm,
            Origin::Pick(pick) => woven.weft()[pick as usize - 1].radius_mm,
            _ => f32::NAN,
        };
        let areas = yarns.yarn_points(number).unwrap().iter().map(|at| at.half_width() * at.half_height());
        areas.fold(f32::INFINITY, f32::min) / (radius * radius)
    };
    (0..yarns.layout().yarns().len()).map(least).fold(f32::INFINITY, f32::min)
}

/// Random drawdowns at setts up to twice the usual ones. Half widths and half heights of control
/// points are half floats, whose rounding is 1/2048.
#[test]
fn no_section_is_denser_than_its_fibres() {
    let (mut seed, mut jammed) = (3, 0);
    for number in 0..50 {
        let mut some = |low: f64, high: f64| low + (high - low) * chance(&mut seed);
        let pitch = [some(0.17, 0.5), some(0.17, 0.5)];
        let fibre = Fibre::ALL[number % Fibre::ALL.len()];
        let least_area = fibre.least_area(fibre.yarn_density() * some(0.7, 1.1), PACKING);
        let threads = |pitch: f64| vec![Thread { least_area, ..Thread::new(pitch, 0.1) }; 8];
        let mut bits: Vec<bool> = (0..64).map(|_| some(0.0, 1.0) < 0.5).collect();
        // Every pick and every end changes sides.
        for thread in 0..8 {
            (bits[9 * thread], bits[9 * thread + 1 - 8 * (thread / 7)]) = (true, false);
        }
        let drawdown = Drawdown::from_fn(8, 8, |end, pick| bits[8 * pick + end]).unwrap();
        let look = (vec![Material::default()], vec![Section::Circle]);
        let woven = Woven::new(drawdown, threads(pitch[0]), threads(pitch[1]), look.0, look.1).unwrap();
        let rest = at_rest(&woven);
        let drawn = least_drawn(&woven, &rest.yarns);
        assert!(drawn >= least_area - 2e-3, "{number}: {drawn} of {least_area}, {pitch:?}");
        assert!(rest.verdict() != Verdict::NotAtRest || !rest.solid, "{number}: {pitch:?}");
        jammed += usize::from(rest.verdict() == Verdict::Jammed);
    }
    assert!((5..45).contains(&jammed), "{jammed} jammed");
}

/// Plain weave at twice Ashenhurst's sett: no loom weaves it, and no yarn gives way.
#[test]
fn cloth_beyond_its_sett_is_jammed() {
    let drawdown = Drawdown::from_fn(8, 8, crate::plain).unwrap();
    let threads = vec![Thread::new(0.2, 0.1); 8];
    let look = (vec![Material::default()], vec![Section::Circle]);
    let woven = Woven::new(drawdown, threads.clone(), threads, look.0, look.1).unwrap();
    let rest = at_rest(&woven);
    assert_eq!(rest.verdict(), Verdict::Jammed);
    assert!(rest.clearance[1] < 0.95, "{:?}", rest.clearance);
    assert!(least_drawn(&woven, &rest.yarns) >= COTTON_LEAST_AREA - 2e-3);
    let structure = Structure::Woven(WovenDesign::new(woven, None, texere_fabric::Relief::Report).unwrap());
    let finished = structure
        .settle(&Finish::default(), 0.0, &ParallelBackend::open().unwrap(), |_| ControlFlow::Continue(()))
        .unwrap();
    assert_eq!(finished.verdict().to_string(), "jammed, not at rest");
}

/// 2/2 twill up to 1.14 times Ashenhurst's sett comes to rest without any change by leaps.
#[test]
fn dense_twill_comes_to_rest() {
    let two = |end: usize, pick: usize| (end + 400 - pick) % 4 < 2;
    let tex = tex_from_cotton_count(20.0);
    let mut before: Option<[f64; 2]> = None;
    for sett in (82..=114).step_by(4) {
        let pitch = 1.5 * diameter_mm(tex, 1.0 / 1.1) / (f64::from(sett) / 100.0);
        let found = cloth("2/2", ([tex; 2], [pitch; 2]), [16, 16], two, [0.0; 2], [None; 2]);
        let rest = at_rest(&found.woven);
        let surfaces = Surfaces::new(&rest.yarns);
        let lengths = lengths_mm(&rest.yarns);
        let crimp = lengths.iter().sum::<f64>() / lengths.len() as f64 / (16.0 * pitch) - 1.0;
        let thickness = surfaces.thickness();
        println!(
            "2/2 at {sett} %: {} passes, clearance {:.3}, crimp {:.1} %, {thickness:.3} mm, area {:.3}",
            rest.crossings.passes,
            surfaces.clearance(),
            100.0 * crimp,
            rest.area.warp
        );
        assert!(rest.crossings.at_rest && rest.crossings.passes <= 200, "{sett}: {:?}", rest.crossings);
        assert!(surfaces.clearance() >= 0.98 && tightest(&rest.yarns) >= 1.0, "{sett}");
        assert!(least_drawn(&found.woven, &rest.yarns) >= COTTON_LEAST_AREA - 2e-3, "{sett}");
        if let Some([crimp_before, thickness_before]) = before {
            // Steps are twice as long as those in which a change of a tenth is allowed.
            assert!((crimp / crimp_before - 1.0).abs() < 0.21, "{sett}: crimp {crimp_before} to {crimp}");
            assert!((thickness / thickness_before - 1.0).abs() < 0.21, "{sett}: {thickness}");
        }
        before = Some([crimp, thickness]);
    }
    let [crimp, _] = before.unwrap();
    assert!((0.11..0.14).contains(&crimp), "{crimp}");
}
