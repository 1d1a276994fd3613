//! One repeat amid copies of itself: yarns leave its area at one edge and come in at the other.

use std::ops::ControlFlow;

use texere_core::{Material, Origin, Section, Yarns};
use texere_cpu::ParallelBackend;
use texere_fabric::warp::{Bar, Chain, WarpKnitted};
use texere_fabric::weft::{Beds, Chart, Gauge, KnitYarn, Knitted, Machine};
use texere_fabric::{Finish, Relief, Structure, Thread, Tile, Weave, Woven, WovenDesign};

/// A point at one edge of a tile, moved on by one tile, has at most this distance from a point at
/// the other edge, mm. Coordinates of some ten millimetres are rounded to .000001 mm.
const EXACT: f32 = 2e-5;

fn woven(weave: &str, size: [usize; 2], colors: usize) -> Structure {
    let drawdown = Weave::parse(weave).unwrap().drawdown(size[0], size[1]).unwrap();
    let threads = |count: usize, spacing: f64| {
        let thread =
            |number: usize| Thread { material: (number % colors) as u32, ..Thread::new(spacing, 0.12) };
        (0..count).map(thread).collect()
    };
    let materials = vec![Material::default(); colors];
    let (warp, weft) = (threads(size[0], 0.3), threads(size[1], 0.4));
    let cloth = Woven::new(drawdown, warp, weft, materials, vec![Section::Circle]).unwrap();
    Structure::Woven(WovenDesign::new(cloth, None, Relief::Report).unwrap())
}

fn weft(chart: &str, copies: [u32; 2]) -> Structure {
    let program = Chart::parse(chart, Beds::One).unwrap().program().unwrap();
    let stitches = Machine::default().knit(&program).unwrap().stitches;
    let (gauge, yarns) = (Gauge::new(1.0, 0.75), vec![KnitYarn::new(0.1)]);
    let cloth =
        Knitted::new(stitches, gauge, yarns, vec![Material::default()], vec![Section::Circle], copies);
    Structure::Weft(cloth.unwrap())
}

fn warp(chains: &[&str], copies: [u32; 2]) -> Structure {
    let bar = |name: &&str| Bar::new(Chain::named(name).unwrap());
    let (bars, yarns) = (chains.iter().map(bar).collect(), vec![KnitYarn::new(0.05)]);
    let (materials, sections) = (vec![Material::default()], vec![Section::Circle]);
    let cloth = WarpKnitted::new(bars, Gauge::new(1.0, 0.75), 2, 4, yarns, materials, sections, copies);
    Structure::Warp(cloth.unwrap())
}

fn at_rest(structure: &Structure) -> Yarns {
    let finish = Finish { passes: 40, ..Finish::default() };
    let goes_on = |_| ControlFlow::Continue(());
    structure.settle(&finish, 0.0, &ParallelBackend::open().unwrap(), goes_on).unwrap().yarns().clone()
}

/// The largest misfit at the tile's left and lower edges, mm. Each control point within `reach` mm
/// of these edges is moved on by one tile and compared with all points. The misfit of two points is
/// their distance, or the difference of their half widths if it is larger. The best fit counts.
fn seam(yarns: &Yarns, [low, size]: [[f64; 2]; 2], reach: f64) -> f32 {
    let inside =
        |at: f64, axis: usize, reach: f64| at > low[axis] - reach && at < low[axis] + size[axis] + reach;
    let mut worst = 0.0f32;
    for axis in [0, 1] {
        let mut seen = 0;
        for point in yarns.points() {
            let at = [f64::from(point.x), f64::from(point.y)];
            if (at[axis] - low[axis]).abs() > reach || !inside(at[1 - axis], 1 - axis, reach) {
                continue;
            }
            seen += 1;
            let mut there = point.position();
            there[axis] += size[axis] as f32;
            let distances = yarns.points().iter().map(|other| {
                let thickness = (other.half_width() - point.half_width()).abs();
                other.position().distance(there).max(thickness)
            });
            worst = worst.max(distances.fold(f32::INFINITY, f32::min));
        }
        assert!(seen > 3, "{seen} points at the edge across axis {axis}");
    }
    worst
}

fn goes_on(name: &str, tile: &Tile) {
    let area = tile.area_mm(&tile.structure);
    for yarns in [tile.structure.yarns().unwrap(), at_rest(&tile.structure)] {
        let worst = seam(&yarns, area, 0.6);
        assert!(worst < EXACT, "{name}: {worst}");
    }
}

#[test]
fn tiles_go_on_at_their_edges() {
    for (name, structure) in [
        ("plain", woven("plain", [6, 4], 1)),
        ("striped twill", woven("2/2", [24, 24], 3)),
        ("satin", woven("satin 8", [16, 16], 1)),
        // Nothing repeats: the last thread lies beside the first one.
        ("a piece of satin", woven("satin 8", [7, 7], 1)),
        ("jersey", weft("k", [3, 3])),
        ("tuck", weft("kt\ntk\nkk", [2, 2])),
        ("pillar", warp(&["pillar"], [2, 2])),
        ("velvet", warp(&["open tricot", "velvet"], [1, 1])),
    ] {
        goes_on(name, &structure.tile().unwrap().unwrap());
    }
}

/// A tile of woven cloth has whole repeats of its colours, and of its threads' sizes.
#[test]
fn a_tile_has_a_repeat_of_colours() {
    let tile = woven("plain", [12, 12], 3).tile().unwrap().unwrap();
    let [_, size] = tile.area_mm(&tile.structure);
    // Two threads of the weave and three colours make six threads.
    assert!((size[0] - 1.8).abs() < 1e-9 && (size[1] - 2.4).abs() < 1e-9, "{size:?}");
    let yarns = tile.structure.yarns().unwrap();
    let ends = yarns.layout().yarns().iter().filter_map(|yarn| match tile.origin(yarn.origin) {
        Origin::End(end) => Some((end, yarn.material)),
        _ => None,
    });
    // Ends of one number have one colour: that of the design's end.
    for (end, material) in ends {
        assert!((1..=6).contains(&end));
        assert_eq!((end - 1) % 3, material);
    }
}

#[test]
fn a_knit_that_does_not_repeat_has_no_tile() {
    use texere_fabric::weft::{CarrierSet, Direction, Instruction, Needle, Operation, Program};
    let knit = |needle| Instruction::Knit(Direction::Right, Needle::front(needle));
    let operations =
        [Instruction::In, knit(0), knit(1), knit(2), Instruction::Out].into_iter().enumerate().map(
            |(line, instruction)| Operation { instruction, carriers: CarrierSet(1), source: line as u32 + 1 },
        );
    let program = Program {
        carriers: vec!["1".into()],
        carrier_sets: vec![vec![], vec![0]],
        operations: operations.collect(),
        repeat: None,
    };
    let stitches = Machine::default().knit(&program).unwrap().stitches;
    let (gauge, yarns) = (Gauge::new(1.0, 0.75), vec![KnitYarn::new(0.1)]);
    let cloth =
        Knitted::new(stitches, gauge, yarns, vec![Material::default()], vec![Section::Circle], [1, 1]);
    assert!(Structure::Weft(cloth.unwrap()).tile().unwrap().is_none());
}
