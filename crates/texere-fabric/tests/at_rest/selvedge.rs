//! Cloths with a selvedge at rest: their weft turns round the edge ends.

use texere_core::{ControlPoint, Material, Section, Yarns};
use texere_fabric::{Drawdown, Finish, NO_CROSSING, Thread, Woven};

use crate::surfaces::Surfaces;
use crate::{finished, plain, satin, tightest, twill};

/// Diameter of all threads, mm.
const DIAMETER: f64 = 0.3;

/// Number of ends, and of picks.
const THREADS: usize = 16;

/// A cloth whose ends and picks lie `pitch` diameters apart.
fn cloth(up: impl FnMut(usize, usize) -> bool, pitch: [f64; 2]) -> Woven {
    let threads = |set: usize| vec![Thread::new(pitch[set] * DIAMETER, (DIAMETER / 2.0) as f32); THREADS];
    let drawdown = Drawdown::from_fn(THREADS, THREADS, up).unwrap();
    let materials = vec![Material::default()];
    let mut woven = Woven::new(drawdown, threads(0), threads(1), materials, vec![Section::Circle]).unwrap();
    woven.set_selvedge(true);
    woven
}

/// The control points of each turn. They have no crossing as their source.
fn turns(yarns: &Yarns) -> Vec<Vec<ControlPoint>> {
    let points: Vec<_> = yarns.points().iter().zip(yarns.sources().unwrap()).collect();
    let runs = points.chunk_by(|one, two| (*one.1 == NO_CROSSING) == (*two.1 == NO_CROSSING));
    // The cut ends of yarns have no crossing, either, and are single points.
    let turns = runs.filter(|run| *run[0].1 == NO_CROSSING && run.len() > 2);
    turns.map(|run| run.iter().map(|(point, _)| **point).collect()).collect()
}

/// Turns do not fold, touch no other turn, and keep the area that picks have, however close these
/// lie. A yarn that is flat in the cloth may be rounder in its turns.
#[test]
fn turns_do_not_fold() {
    let two = |end: usize, pick: usize| (end + 400 - pick) % 4 < 2;
    let rib = |end: usize, pick: usize| (end / 2 + pick).is_multiple_of(2);
    type Weave = fn(usize, usize) -> bool;
    let weaves = [
        ("plain", plain as Weave),
        ("2/2", two as Weave),
        ("3/1", twill as Weave),
        ("satin", satin as Weave),
        ("rib", rib as Weave),
    ];
    for (name, weave) in weaves {
        // With the last pitches, picks are so close that a round yarn has no room for a half
        // circle.
        for pitch in [[2.0, 5.0 / 3.0], [3.0, 3.0], [2.0, 1.0]] {
            let woven = cloth(weave, pitch);
            let rest = finished(&woven, &Finish::default());
            let turns = turns(&rest.yarns);
            assert_eq!(turns.len(), THREADS - 1, "{name} {pitch:?}");
            let (bends, nearest) = (tightest(&rest.yarns), nearest(&turns));
            let clearance = Surfaces::new(&rest.yarns).clearance();
            let areas = turns.iter().flatten().map(|point| point.half_width() * point.half_height());
            let area = areas.fold(f32::MAX, f32::min) / (DIAMETER / 2.0).powi(2) as f32;
            println!(
                "{name} {pitch:?}: bends {bends:.2}, turns {nearest:.3} of touching, clearance {clearance:.3}, area {area:.2} ({:.2})",
                rest.area_least.weft
            );
            assert!(bends >= 1.0, "{name} {pitch:?} folds: {bends}");
            assert!(nearest >= 0.98 && clearance >= 0.98, "{name} {pitch:?}: {nearest} {clearance}");
            assert!(f64::from(area) >= rest.area_least.weft - 1e-3, "{name} {pitch:?}: area {area}");
        }
    }
}

/// A thin yarn beside a thick one of the same material, and picks at uneven distances: turns have
/// the sizes of their picks, and leave room for one another.
#[test]
fn turns_of_uneven_picks_do_not_touch() {
    let spacings = [3.0, 1.0, 1.0, 1.0].map(|pitch| pitch * DIAMETER);
    for radii in [[1.0; 4], [1.0, 0.5, 1.0, 0.5]] {
        let pick =
            |number: usize| Thread::new(spacings[number % 4], (radii[number % 4] * DIAMETER / 2.0) as f32);
        let rib = |end: usize, pick: usize| (end + pick / 2).is_multiple_of(2);
        let warp = vec![Thread::new(2.0 * DIAMETER, (DIAMETER / 2.0) as f32); THREADS];
        let weft = (0..THREADS).map(pick).collect();
        let drawdown = Drawdown::from_fn(THREADS, THREADS, rib).unwrap();
        let (materials, sections) = (vec![Material::default()], vec![Section::Circle]);
        let mut woven = Woven::new(drawdown, warp, weft, materials, sections).unwrap();
        woven.set_selvedge(true);
        let rest = finished(&woven, &Finish::default());
        let turns = turns(&rest.yarns);
        let (bends, nearest) = (tightest(&rest.yarns), nearest(&turns));
        let flattest =
            turns.iter().flatten().map(|point| point.half_width() / point.half_height()).fold(0.0, f32::max);
        println!("{radii:?}: bends {bends:.2}, turns {nearest:.3} of touching, at most {flattest:.2} : 1");
        assert!(bends >= 1.0 && nearest >= 0.98, "{bends} {nearest}");
        assert!(flattest < 3.0, "{flattest}");
    }
}

/// The least distance of the middles of two turns, over the sum of their half widths.
fn nearest(turns: &[Vec<ControlPoint>]) -> f32 {
    let mut least = f32::MAX;
    for (number, one) in turns.iter().enumerate() {
        for other in &turns[number + 1..] {
            for (p, q) in one.iter().flat_map(|p| other.iter().map(move |q| (p, q))) {
                let apart = [p.x - q.x, p.y - q.y, p.z - q.z].map(|way| way * way).iter().sum::<f32>().sqrt();
                least = least.min(apart / (p.half_width() + q.half_width()));
            }
        }
    }
    least
}
