//! Distances between the surfaces of yarns with furrows and twist: the clearance report against an
//! oracle.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test ends at what it did not expect")]

mod cloths;
mod outline;
mod ratio;
mod tube;

use std::rc::Rc;

use glam::DVec3;
use rayon::prelude::*;
use texere_contact::{CLEARANCE_NEAR, clearance};
use texere_core::{ControlPoint, Frame, Pipeline, Section, Settings, Yarn, Yarns};
use texere_cpu::SerialBackend;

use cloths::{RADIUS, close, flattened, set, woven};
use outline::Outline;
use ratio::{hull_ratio, surface_ratio};
use tube::Tube;

/// Settings whose rings lie at most a twenty-fifth of a diameter apart.
fn dense(yarns: &Yarns) -> Settings {
    let longest = (0..yarns.layout().yarns().len())
        .flat_map(|yarn| yarns.yarn_points(yarn).unwrap().windows(2))
        .map(|two| two[0].position().distance(two[1].position()))
        .fold(0.0, f32::max);
    Settings { subdivisions: (longest / (2.0 * RADIUS / 25.0)) as u32, ..Settings::default() }
}

/// A straight yarn of `section`.
fn straight(from: [f32; 3], to: [f32; 3], section: u32, twist: f32) -> (Yarn, [ControlPoint; 2]) {
    let points = [from, to].map(|[x, y, z]| ControlPoint::new(x, y, z, RADIUS));
    (Yarn { section, twist, ..Yarn::default() }, points)
}

fn yarns<const N: usize>(section: Section, each: &[(Yarn, [ControlPoint; N])]) -> Yarns {
    let mut yarns = Yarns::builder();
    yarns.section(section);
    for (yarn, points) in each {
        yarns.yarn(*yarn, points);
    }
    yarns.build().unwrap()
}

#[track_caller]
fn assert_near(ratio: f64, expected: f64) {
    assert!((ratio - expected).abs() < 5e-4, "{ratio} instead of {expected}");
}

/// The oracle's tube is the tube whose vertices a backend makes, on rings and half way between
/// them. Yarns are bent, flattened, and twisted in either direction.
#[test]
fn vertices_lie_on_the_surface() {
    const SIDES: u32 = 48;
    let bent = [[0.0, 0.0, 0.0], [1.0, 0.2, 0.2], [2.0, 0.5, -0.2], [3.0, 0.3, 0.0]]
        .map(|[x, y, z]| ControlPoint::new(x, y, z, RADIUS).flattened(RADIUS + 0.1 * z, RADIUS - 0.2 * z));
    let section = Section::plied(3);
    let outline = Rc::new(Outline::of(&section));
    for twist in [-4.0, 4.0] {
        let yarns = yarns(section.clone(), &[(Yarn { twist, ..Yarn::default() }, bent)]);
        let settings = Settings { sides: SIDES, ..dense(&yarns) };
        let trajectory = Pipeline::new(&yarns).settings(settings).trajectory(&SerialBackend::new()).unwrap();
        let tube = Tube::new(&trajectory.rings, outline.clone());
        let twice = Settings { subdivisions: 2 * settings.subdivisions + 1, ..settings };
        let mesh = Pipeline::new(&yarns).settings(twice).mesh(&SerialBackend::new()).unwrap();
        let (all, mut ring) = (0..=tube.rings() - 1, 0);
        // The first and the last ring are the yarn's ends.
        for half in 1..2 * tube.rings() - 2 {
            let stance = tube.stance(half as f64 / 2.0);
            for k in 0..SIDES as usize {
                let angle = k as f64 / f64::from(SIDES) * std::f64::consts::TAU;
                let vertex = mesh.vertices[half * SIDES as usize + k].position;
                let vertex = DVec3::from_array(vertex.map(f64::from));
                let off = vertex.distance(stance.centre + stance.outward(outline.point(angle)));
                assert!(off < 1e-3 * f64::from(RADIUS), "{off} mm from {vertex}, {half} half rings on");
                let gauge = tube.gauge(vertex, &all, &mut ring, 2.0);
                assert!((gauge - 1.0).abs() < 1e-3, "{gauge} at {vertex}, {half} half rings on");
            }
        }
    }
}

/// Round yarns touch if their radii add up to the distance.
#[test]
fn round_yarns_that_cross() {
    for distance in [0.2, 0.25, 0.27] {
        for slant in [0.0, 0.4] {
            let weft = straight([-0.5, 0.0, 0.0], [0.5, 0.0, 0.0], 0, 0.0);
            let warp = straight([-slant, -0.55, distance], [slant, 0.5, distance], 0, 0.0);
            let yarns = yarns(Section::Circle, &[weft, warp]);
            assert_near(surface_ratio(&yarns, dense(&yarns)), f64::from(distance) / 0.25);
        }
    }
}

/// A quarter turn stands a flat yarn on its edge.
#[test]
fn flat_yarns_that_cross() {
    let radius = f64::from(RADIUS);
    let (height, width) = (radius / 2f64.sqrt(), radius * 2f64.sqrt());
    for (quarters, reach) in [(0.0, 2.0 * height), (1.0, width + height)] {
        // The quarter turn is made on the way to the crossing.
        let lead = 5.0;
        let twist = quarters * std::f32::consts::FRAC_PI_2 / lead;
        let distance = 0.9 * reach;
        let weft = straight([-0.5, 0.0, 0.0], [0.5, 0.0, 0.0], 0, 0.0);
        let warp = straight([0.0, -lead, distance as f32], [0.0, 0.5, distance as f32], 0, twist);
        let yarns = yarns(Section::Ellipse { aspect: 2.0 }, &[weft, warp]);
        assert_near(surface_ratio(&yarns, dense(&yarns)), 0.9);
    }
}

/// Flat yarns with the same twist turn alike. Side by side they touch at places where both lie
/// flat.
#[test]
fn twisted_yarns_side_by_side() {
    let width = f64::from(RADIUS) * 2f64.sqrt();
    let apart = (0.8 * 2.0 * width) as f32;
    let [first, second] = [0.0, apart].map(|x| straight([x, 0.0, 0.0], [x, 3.0, 0.0], 0, 4.0));
    let yarns = yarns(Section::Ellipse { aspect: 2.0 }, &[first, second]);
    assert_near(surface_ratio(&yarns, dense(&yarns)), 0.8);
}

/// Two straight yarns of two plies side by side, 1.95 radii apart. A ply of the short yarn points
/// at the other yarn. The other yarn has made a quarter turn there, so that its furrow faces the
/// ply.
fn furrow_and_ply() -> Yarns {
    let (lead, apart) = (5.0, 1.95 * RADIUS);
    let ply = straight([0.0, 0.0, 0.0], [0.0, 0.01, 0.0], 0, 0.0);
    let furrow = straight([apart, -lead, 0.0], [apart, 1.0, 0.0], 0, std::f32::consts::FRAC_PI_2 / lead);
    yarns(Section::plied(2), &[ply, furrow])
}

/// A ply fits into a furrow. Hulls of sections have no furrows, and touch earlier.
#[test]
fn a_ply_lies_in_a_furrow() {
    let yarns = furrow_and_ply();
    // The outline is r(θ) = 1 - depth (1 - cos 2θ) with a depth of 1/4, scaled to the area of the
    // circle. Its plies reach to 1.2978, its furrows to half of that. Over the furrows, the hull
    // lies at (2/3)^(3/2) of the reach of the plies.
    let ply = (0.75f64 * 0.75 + 0.25 * 0.25 / 2.0).sqrt().recip();
    assert_near(surface_ratio(&yarns, dense(&yarns)), 1.95 / (ply * 1.5));
    assert_near(hull_ratio(&yarns, dense(&yarns)), 1.95 / (ply * (1.0 + (2.0f64 / 3.0).powf(1.5))));
}

/// The clearance that texere-contact measures.
fn clearance_ratio(yarns: &Yarns, settings: Settings) -> f64 {
    clearance(yarns, &settings).unwrap().min
}

#[test]
fn the_clearance_is_that_of_surfaces() {
    let mut cases = vec![("ply in a furrow".to_owned(), furrow_and_ply())];
    // Ends lie in pairs, and picks, too. The plies of each thread lie in the furrows of its
    // neighbour along the whole length.
    for plies in [3, 5] {
        let threads = set(4, [2.5, 0.95], RADIUS, 0.0);
        let doubled = woven("2/2(2+2)", threads, Section::plied(plies));
        cases.push((format!("doubled threads of {plies} plies"), doubled));
    }
    let lobed = (2..=6).map(Section::plied);
    let sections: Vec<_> = [Section::Ellipse { aspect: 2.0 }].into_iter().chain(lobed).collect();
    for section in [Section::Circle, Section::Ellipse { aspect: 2.0 }, Section::plied(2)] {
        for twist in [0.0, 300.0] {
            cases.push((format!("flattened {section:?}, twist {twist}"), flattened(&section, twist)));
        }
    }
    for weave in ["plain", "2/2", "satin 5"] {
        for section in &sections {
            for twist in [0.0, 300.0, 700.0] {
                cases.push((format!("{weave}, {section:?}, twist {twist}"), close(weave, section, twist)));
            }
        }
    }
    let measure = |(name, yarns): &(String, Yarns)| {
        let settings = dense(yarns);
        (name.clone(), surface_ratio(yarns, settings), clearance_ratio(yarns, settings))
    };
    let measured: Vec<_> = cases.par_iter().map(measure).collect();
    for (name, oracle, crates) in measured {
        assert!((0.75..=1.08).contains(&oracle), "{name}: {oracle} tells too little");
        assert!((oracle - crates).abs() <= 0.003, "{name}: {oracle}, clearance {crates}");
    }
}

/// A yarn that bends over backwards passes through the vertical between two rings. The upright
/// frame flips there, and the frame that is carried along does not. A round yarn passes at that
/// place, on the wide side of the section.
#[test]
fn a_carried_frame_does_not_flip_between_rings() {
    for (section, away) in [(Section::Ellipse { aspect: 3.0 }, 0.33), (Section::plied(2), 0.28)] {
        let mut yarns = Yarns::builder();
        let round = yarns.section(Section::Circle);
        let section = yarns.section(section);
        let bend = [[0.9, 0.0], [0.1, 0.1], [-0.1, 0.5], [-0.05, 0.75], [0.3, 1.1], [0.9, 1.2]];
        let bend = bend.map(|[x, z]| ControlPoint::new(x, 0.0, z, RADIUS));
        let beside = [-1.0, 1.0].map(|x| ControlPoint::new(x, away, 0.57, RADIUS));
        yarns.yarn(Yarn { section, ..Yarn::default() }, &bend);
        yarns.yarn(Yarn { section: round, ..Yarn::default() }, &beside);
        let yarns = yarns.build().unwrap();
        let minimizing = |settings| Settings { frame: Frame::RotationMinimizing, ..settings };
        let oracle = surface_ratio(&yarns, minimizing(dense(&yarns)));
        let coarse = clearance_ratio(&yarns, minimizing(Settings::default()));
        assert!((0.75..=1.08).contains(&oracle), "section {section}: {oracle} tells too little");
        assert!((oracle - coarse).abs() <= 0.003, "section {section}: {oracle}, clearance {coarse}");
    }
}

/// Threads that cross make room for all plies, at any turn of the twist.
#[test]
fn plied_threads_in_their_own_room_stay_clear() {
    for plies in 2..=6 {
        for twist in [0.0, 300.0, 700.0] {
            for sett in [3.0, 5.0] {
                let section = Section::plied(plies);
                let yarns = woven("plain", set(4, [sett; 2], RADIUS, twist), section);
                let settings = dense(&yarns);
                let (oracle, crates) = (surface_ratio(&yarns, settings), clearance_ratio(&yarns, settings));
                let name = format!("{plies} plies, twist {twist}, {sett} diameters");
                assert!(oracle >= 0.999, "{name}: {oracle}");
                // Beyond `CLEARANCE_NEAR` texere-contact does not search.
                let same = (oracle - crates).abs() <= 0.003 || oracle.min(crates) > CLEARANCE_NEAR - 0.003;
                assert!(same, "{name}: {oracle}, clearance {crates}");
            }
        }
    }
}
