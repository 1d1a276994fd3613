//! Yarns in a plane of constant x or y. The scan skips the turns from ring to ring where such a
//! yarn goes on without turning back and has no twist. The meshes of these yarns equal those of the
//! reference to the bit.

#![allow(clippy::unwrap_used, reason = "a test ends at what it did not expect")]

use texere_core::{Backend, ControlPoint, Frame, Mesh, Pipeline, Yarn, Yarns};
use texere_cpu::{ParallelBackend, SerialBackend};

/// Numbers from 0 to just below `below`. Equal seeds give equal numbers.
struct Dice(u64);

impl Dice {
    fn roll(&mut self, below: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % below
    }
}

/// A yarn of `count` points in a plane, on a coarse grid. It goes straight on for a while, and here
/// and there it turns back, climbs or repeats a point. The plane is one of constant y if `swapped`,
/// else one of constant x. If `bulges`, the yarn leaves the plane once.
fn walk(dice: &mut Dice, count: usize, swapped: bool, bulges: bool) -> Vec<ControlPoint> {
    let (mut along, mut z) = (0.0, 0.0);
    let mut forward = 1.0;
    let points = (0..count).map(|number| {
        if dice.roll(12) == 0 {
            forward = -forward;
        }
        along += forward * if dice.roll(8) == 0 { 0.0 } else { 1.0 };
        z += [-0.5, 0.0, 0.0, 0.5][dice.roll(4) as usize];
        let across = if bulges && number == count / 2 { 3.25 } else { 3.0 };
        let [x, y] = if swapped { [along, across] } else { [across, along] };
        ControlPoint::new(x, y, z, 0.1)
    });
    points.collect()
}

fn mesh(yarns: &Yarns, subdivisions: u32, device: &dyn Backend) -> Mesh {
    Pipeline::new(yarns).subdivisions(subdivisions).frame(Frame::RotationMinimizing).mesh(device).unwrap()
}

#[test]
fn the_last_ring_of_a_closed_yarn_stands_still_where_what_follows_is_far_away() {
    // From ring 64, where a block starts, the yarn goes on along y to the last ring, which is ring
    // 0 again. Point 1 is near, but point 2 is very far away. Compared with that distance, the
    // velocity at the first ring and at the last ring counts as zero.
    let mut points: Vec<_> = (0..80).map(|k| [0.0, 0.001 * (k as f32 - 80.0), 0.0]).collect();
    (points[0], points[1], points[2]) = ([0.0; 3], [0.0, 0.001, 0.0], [2000.0, 0.0, 2000.0]);
    for (k, point) in points.iter_mut().enumerate().take(63).skip(3) {
        let rest = 1.0 - k as f32 / 63.0;
        *point = [2000.0 * rest, -1.0, 2000.0 * rest];
    }
    let points: Vec<_> = points.into_iter().map(|[x, y, z]| ControlPoint::new(x, y, z, 0.1)).collect();
    let mut yarns = Yarns::builder();
    yarns.yarn(Yarn { closed: true, ..Yarn::default() }, &points);
    let yarns = yarns.build().unwrap();
    let gold = mesh(&yarns, 0, &SerialBackend::new());
    for device in ParallelBackend::each() {
        assert!(mesh(&yarns, 0, &device).vertices == gold.vertices, "{}", device.info().name);
    }
}

#[test]
fn rolls_in_a_plane_are_those_of_the_reference() {
    let (mut dice, devices) = (Dice(7), ParallelBackend::each());
    for round in 0..60 {
        let mut yarns = Yarns::builder();
        for number in 0..8 {
            let count = 3 + dice.roll(150) as usize;
            let twist = if dice.roll(3) == 0 { 0.7 } else { 0.0 };
            let yarn = Yarn { closed: dice.roll(4) == 0, twist, ..Yarn::default() };
            let bulges = dice.roll(4) == 0;
            yarns.yarn(yarn, &walk(&mut dice, count, number % 2 == 1, bulges));
        }
        let yarns = yarns.build().unwrap();
        for subdivisions in [0, 1, 3] {
            let bits = |mesh: &Mesh| bytemuck::cast_slice::<_, u32>(&mesh.vertices).to_vec();
            let gold = bits(&mesh(&yarns, subdivisions, &SerialBackend::new()));
            for device in &devices {
                let name = &device.info().name;
                let ours = bits(&mesh(&yarns, subdivisions, device));
                assert!(gold == ours, "{name}: round {round}, K = {subdivisions}");
            }
        }
    }
}
