//! Jacquards with any figure come to rest: loops of guides that share a needle lie side by side
//! from the start.

use std::ops::ControlFlow;

use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use texere_contact::CLEAR;
use texere_core::{Material, Section};
use texere_cpu::ParallelBackend;
use texere_fabric::Finish;
use texere_fabric::warp::{Bar, Chain, Displacements, WarpKnitted};
use texere_fabric::weft::{Gauge, KnitYarn};

use super::fault;
use super::topology::faults;

/// The diameters with which figures settle here, in wales: the paper's, and a larger one.
const DIAMETERS: [f64; 2] = [0.08, 0.1];

/// The least radius of curvature without a fold, in diameters. A tube closes up on the inside of a
/// bend whose radius is half its thickness; the head of a loop whose legs touch is such a bend. Not
/// every figure reaches the radius at which settling aims, because settling makes a limited number
/// of passes, and returns the best of them by clearance, then by bends. Random figures end between
/// 0.57 and 0.62.
const FOLD: f64 = 0.5;

/// The least clearance of any figure at its cut edges. The first and the last interval of a yarn
/// that is cut off lack the neighbour that bends them in the repeat. Of 670 random figures of two
/// diameters, one had 0.966 there, and all others more than 0.99.
const CUT: f64 = 0.95;

/// The bars of the paper's figure 7c: JB1, with a figure of thin, thick and open places, in front
/// of GB2.
fn cloth(size: [u32; 2], diameter: f64, colour: impl FnMut(u32, u32) -> u8) -> WarpKnitted {
    let palette = vec![vec![[0, 0], [0, 0]], vec![[0, 0], [1, 1]], vec![[1, 1], [0, 0]]];
    let bar = |chain| Bar::new(Chain::parse(chain, 1).expect("a chain"));
    let jacquard = Some(Displacements::new(size, palette, colour).expect("an image"));
    let bars = vec![Bar { jacquard, ..bar("1-0/1-2") }, bar("1-2/1-0")];
    let yarns = vec![KnitYarn::new(diameter as f32 / 2.0)];
    let (materials, sections) = (vec![Material::default()], vec![Section::Circle]);
    let [wales, courses] = [size[0], 2 * size[1]];
    let gauge = Gauge::new(1.0, 0.75);
    WarpKnitted::new(bars, gauge, wales, courses, yarns, materials, sections, [1, 1]).expect("a cloth")
}

/// Every edge that a figure can have: each colour of a row between every two colours, beside equal
/// and unequal colours in the rows above and below.
#[test]
fn every_colour_rests_between_all_others() {
    // The sequence is cyclic, and has every run of three colours once (de Bruijn, 1946).
    let colours = b"000100201101202102211121222";
    let row = |wale: u32| colours[wale as usize % colours.len()] - b'0';
    let size = [colours.len() as u32, 3];
    for diameter in DIAMETERS {
        let cloth = cloth(size, diameter, |wale, course| row(wale + 7 * course));
        assert_eq!(fault("every run of three colours", &cloth, diameter, FOLD), None);
    }
}

/// The least clearance of the whole cloth at rest, with its cut edges.
fn clear(cloth: &WarpKnitted) -> f64 {
    let device = ParallelBackend::open().expect("the CPU");
    let settled = cloth.settle(&Finish::default(), 0.0, &device, |_| ControlFlow::Continue(()));
    settled.expect("a settling").clearance.min
}

/// Several figures are clear up to their cut edges, although loops of neighbouring guides share
/// needles there.
#[test]
fn figures_are_as_clear_where_they_are_cut_off() {
    // Four of some 150 random figures. In the first, the bends of the legs above the cloth differ
    // most. In the second, an upper end came nearest to a neighbour. In the other two, a lower end
    // did.
    let random = [
        [1_u8, 1, 2, 1, 0, 0, 0, 0, 2, 0, 0, 1, 0, 2, 0, 0, 2, 2],
        [2, 0, 1, 2, 1, 0, 0, 1, 1, 0, 2, 2, 1, 2, 1, 2, 2, 0],
        [1, 2, 2, 1, 2, 0, 1, 0, 0, 1, 1, 2, 1, 1, 0, 1, 0, 2],
        [2, 2, 1, 0, 2, 1, 2, 1, 1, 1, 0, 0, 1, 1, 0, 1, 0, 2],
    ];
    let clear_at_edges = |figure: &str, size: [u32; 2], colour: &dyn Fn(u32, u32) -> u8| {
        for diameter in DIAMETERS {
            let clear = clear(&cloth(size, diameter, colour));
            assert!(clear >= CLEAR, "{figure} {diameter}: {clear}");
        }
    };
    clear_at_edges("bars", [12, 8], &|wale, _| (wale / 2 % 3) as u8);
    clear_at_edges("checks", [6, 5], &|wale, row| ((wale / 2 + row / 2) % 3) as u8);
    clear_at_edges("figure", [8, 6], &|wale, row| ((wale * wale + 3 * row + wale * row) % 3) as u8);
    for figure in random {
        clear_at_edges(&format!("{figure:?}"), [6, 3], &|wale, row| figure[(wale + 6 * row) as usize]);
    }
}

/// The loops of any figure are drawn through those below from the start. Its yarns come to rest,
/// and their clearance with the cut edges is at least [`CUT`].
#[test]
fn any_figure_rests() {
    let colours = prop::collection::vec(0_u8..3, 6 * 3);
    let mut runner = TestRunner::new(Config { cases: 5, failure_persistence: None, ..Config::default() });
    let rests = |colours: Vec<u8>| {
        for diameter in DIAMETERS {
            let cloth = cloth([6, 3], diameter, |wale, course| colours[(wale + 6 * course) as usize]);
            let piece = cloth.piece().expect("a piece");
            prop_assert_eq!(faults(&cloth, &piece, &piece.yarns), Vec::<String>::new());
            prop_assert_eq!(fault("any figure", &cloth, diameter, FOLD), None);
            let clear = clear(&cloth);
            prop_assert!(clear >= CUT, "{} with its cut edges", clear);
        }
        Ok(())
    };
    runner.run(&colours, rests).expect("figures that rest");
}
