//! Yarns in planes of constant x or y, for which the scan has a short way: the same bits as the reference.

#![allow(clippy::unwrap_used, reason = "a test ends at what it did not expect")]

use texere_core::{Backend, ControlPoint, Frame, Mesh, Pipeline, Yarn, Yarns};
use texere_cpu::{ParallelBackend, SerialBackend};

/// Numbers from 0 to `below`, the same ones every time.
struct Dice(u64);

impl Dice {
    fn roll(&mut self, below: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % below
    }
}

/// A yarn of `count` points in the plane, on a coarse grid: it goes straight on for a while, and here and there it turns back,
/// climbs straight up or stays where it is. Where `bulges`, it leaves the plane once.
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
