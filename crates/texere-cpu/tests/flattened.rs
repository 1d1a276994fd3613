//! Flattened yarns in lanes have the same bits as in the reference, whatever instructions the
//! processor has.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use texere_core::definitions::Ring;
use texere_core::{ControlPoint, Frame, Pipeline, Section, Settings, Topology, Yarn, Yarns};
use texere_cpu::{ParallelBackend, SerialBackend};

/// Numbers from 0 to just below `below`. Equal seeds give equal numbers.
struct Dice(u64);

impl Dice {
    fn roll(&mut self, below: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % below
    }

    /// A number from 0 to 1.
    fn share(&mut self) -> f32 {
        self.roll(1 << 20) as f32 / (1 << 20) as f32
    }
}

/// How the half widths and half heights of a yarn change along it.
#[derive(Debug, Clone, Copy)]
enum Sizes {
    Round,
    Ribbon,
    /// Each point has sizes of its own.
    Changing,
    /// Round for a while, then flattened, and so on, so that vectors hold both kinds of rings.
    HereAndThere,
    /// From the least allowed size to 20 m, so that the spline of the sizes dips below zero, and
    /// sizes at virtual ends are negative.
    Wild,
}

const ALL_SIZES: [Sizes; 5] =
    [Sizes::Round, Sizes::Ribbon, Sizes::Changing, Sizes::HereAndThere, Sizes::Wild];

/// A yarn of `count` points that winds, climbs and now and then repeats a point.
fn wander(dice: &mut Dice, count: usize, sizes: Sizes) -> Vec<ControlPoint> {
    let (mut at, mut flat) = ([0.0f32, -0.0, -0.0], false);
    let points = (0..count).map(|_| {
        let way = dice.roll(10);
        let step = [dice.share(), dice.share() - 0.5, dice.share() - 0.5];
        match way {
            0 => {}
            1 => at[2] += 1.0,
            2..5 => at[0] += 1.0,
            _ => (0..3).for_each(|axis| at[axis] += step[axis]),
        }
        if dice.roll(4) == 0 {
            flat = !flat;
        }
        let round = ControlPoint::new(at[0], at[1], at[2], 0.25);
        match sizes {
            Sizes::Round => round,
            Sizes::Ribbon => round.flattened(0.5, 0.125),
            Sizes::Changing => round.flattened(0.2 + dice.share(), 0.1 + dice.share()),
            Sizes::HereAndThere if flat => round.flattened(0.5, 0.2),
            Sizes::HereAndThere => round,
            Sizes::Wild => {
                let mut wild = || [1e-4, 0.003, 1.0, 30.0, 2e4][dice.roll(5) as usize];
                round.flattened(wild(), wild())
            }
        }
    });
    points.collect()
}

fn sections() -> Vec<Section> {
    vec![
        Section::Circle,
        Section::Ellipse { aspect: 2.0 },
        Section::Lenticular { aspect: 3.0, distortion: 0.2 },
        Section::PowerEllipse { aspect: 1.5, exponent: 0.5 },
        Section::plied(3),
    ]
}

/// Thirty yarns. With `corners` their section is a polygon with negative zeros among its corners.
fn yarns(dice: &mut Dice, corners: bool) -> Yarns {
    let mut yarns = Yarns::builder();
    let sections: Vec<_> = if corners {
        let square = [[1.0, -0.0], [0.0, 1.0], [-1.0, 0.0], [-0.0, -1.0]];
        vec![yarns.section(Section::Polygon(square.into()))]
    } else {
        sections().into_iter().map(|section| yarns.section(section)).collect()
    };
    for number in 0..30 {
        let count = 3 + dice.roll(if number % 3 == 0 { 200 } else { 20 }) as usize;
        let twist = if dice.roll(2) == 0 { 0.7 } else { 0.0 };
        let section = sections[dice.roll(sections.len() as u64) as usize];
        let yarn = Yarn { closed: dice.roll(4) == 0, twist, section, ..Yarn::default() };
        yarns.yarn(yarn, &wander(dice, count, ALL_SIZES[number % ALL_SIZES.len()]));
    }
    yarns.build().unwrap()
}

fn ring_bits(rings: &[Ring]) -> Vec<u32> {
    bytemuck::cast_slice(rings).to_vec()
}

#[test]
fn flattened_yarns_have_the_bits_of_the_reference() {
    let (mut dice, devices) = (Dice(11), ParallelBackend::each());
    for round in 0..24 {
        let sides = [4, 6, 8, 5, 13, 3][round % 6];
        let yarns = yarns(&mut dice, sides == 4).with_tension([0.0, 0.3][round % 2]).unwrap();
        let settings = Settings {
            sides,
            subdivisions: [1, 0, 2, 7][round % 4],
            frame: [Frame::Upright, Frame::RotationMinimizing][round / 2 % 2],
            topology: [Topology::Indexed, Topology::Shared][round / 3 % 2],
            caps: round / 4 % 2 == 0,
            ..Settings::default()
        };
        let pipeline = || Pipeline::new(&yarns).settings(settings);
        let mesh_bits = |mesh: &texere_core::Mesh| bytemuck::cast_slice::<_, u32>(&mesh.vertices).to_vec();
        let gold = pipeline().mesh(&SerialBackend::new()).unwrap();
        let gold_rings = ring_bits(&pipeline().trajectory(&SerialBackend::new()).unwrap().rings);
        for (device, name) in devices.iter().zip(["portable", "avx2", "avx512"]) {
            let rings = ring_bits(&pipeline().trajectory(device).unwrap().rings);
            assert!(gold_rings == rings, "{name}: rings, round {round}, {settings:?}");
            let mesh = pipeline().mesh(device).unwrap();
            assert!(mesh_bits(&gold) == mesh_bits(&mesh), "{name}: vertices, round {round}, {settings:?}");
            assert!(gold.indices == mesh.indices, "{name}: indices, round {round}, {settings:?}");
        }
    }
}

#[test]
fn a_yarn_may_flatten_right_after_a_run_of_rings_ends() {
    // A run has 2,048 rings. With one ring inserted between points, the last ring of the run lies
    // half-way between points 1,023 and 1,024, and depends on point 1,025.
    for last_round in 1020..1028 {
        let points = (0..1100u16).map(|k| {
            let point = ControlPoint::new(k.into(), 0.0, 0.0, 0.25);
            if usize::from(k) <= last_round { point } else { point.flattened(0.5, 0.125) }
        });
        let mut yarns = Yarns::builder();
        yarns.yarn(Yarn::default(), &points.collect::<Vec<_>>());
        let yarns = yarns.build().unwrap();
        let rings = |device: &dyn texere_core::Backend| {
            ring_bits(&Pipeline::new(&yarns).subdivisions(1).trajectory(device).unwrap().rings)
        };
        let gold = rings(&SerialBackend::new());
        for device in ParallelBackend::each() {
            assert!(gold == rings(&device), "round up to point {last_round}");
        }
    }
}
