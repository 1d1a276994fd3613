//! Rolls of a block's rings: each step's turn in lanes, then their sum.

use glam::Vec3;
use texere_core::{Block, Frame, NO_LENGTH, NO_MIRROR, Turn, atan2_turns};

use super::rings::{BlockRings, FULL, N};
use crate::session::Work;

impl BlockRings {
    /// Rolls from the block's start on, and the bases turned by them.
    #[inline(always)]
    pub(super) fn turn(&mut self, work: &Work, block: &Block, number: u64) {
        let (plan, yarn) = (&work.plan, block.yarn as usize);
        let mut steps = [Turn::ZERO; FULL];
        self.steps(plan.settings().frame, plan.twist_turns(yarn), &mut steps);
        let mut sum = work.rolls.at_block(number);
        for (k, step) in steps.into_iter().enumerate().take(self.count) {
            self.roll[k] = work.rolls.closed_up(plan, yarn, block.first_ring + k as u32, sum);
            sum = sum + step;
        }
        for k in 0..N {
            let (sin, cos) = self.roll[k].sin_cos();
            let level = self.roll[k] == Turn::ZERO;
            for axis in 0..3 {
                let (side, up) = (self.side[axis][k], self.up[axis][k]);
                self.side[axis][k] = if level { side } else { side * cos + up * sin };
                self.up[axis][k] = if level { up } else { up * cos - side * sin };
            }
        }
    }

    /// The turn from each ring to the next one, from upright bases: `Frame::step`, without its jumps.
    #[inline(always)]
    pub(super) fn steps(&self, frame: Frame, twist: f32, steps: &mut [Turn; FULL]) {
        let minimizing = frame == Frame::RotationMinimizing;
        let at = |lanes: &[[f32; N]; 3], k: usize| Vec3::new(lanes[0][k], lanes[1][k], lanes[2][k]);
        let mut turns = [0.0; FULL];
        if minimizing {
            for (k, turn) in turns.iter_mut().enumerate() {
                let (tangent, chord) = (at(&self.tangent, k), at(&self.chord, k));
                let length_squared = chord.length_squared();
                let apart = length_squared > NO_LENGTH;
                let mirror = if apart { chord } else { tangent };
                let mirror_squared = if apart { length_squared } else { 1.0 };
                let side = reflect(at(&self.side, k), mirror, mirror_squared);
                let second = at(&self.tangent, k + 1) - reflect(tangent, mirror, mirror_squared);
                let second_squared = second.length_squared();
                let twice = reflect(side, second, second_squared);
                let side = if second_squared > NO_MIRROR { twice } else { side };
                *turn = atan2_turns(side.dot(at(&self.up, k + 1)), side.dot(at(&self.side, k + 1)));
            }
        }
        for (k, (step, turn)) in steps.iter_mut().zip(turns).enumerate() {
            *step = Turn::from_turns(turn + twist * at(&self.chord, k).length_squared().sqrt());
        }
    }
}

/// `v` mirrored in the plane at right angles to `mirror`.
#[inline(always)]
fn reflect(v: Vec3, mirror: Vec3, mirror_squared: f32) -> Vec3 {
    v - mirror * (2.0 * v.dot(mirror) / mirror_squared)
}
