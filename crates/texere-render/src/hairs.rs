//! Hairs, which are fibres that stand off their yarns: their number, and the constants of the
//! shaders.

use std::f32::consts::E;

use texere_core::backend::BLOCK_RINGS;
use texere_core::{BackendError, Yarns};
use wgpu::BufferUsages;

use crate::Renderer;

/// `HAIRS_OF_GAP` of `hair.wgsl`: the most hairs of a gap between two rings.
const OF_GAP: u32 = 16;

/// `HAIR_PARTS` of `hair.wgsl`: the number of straight parts of a hair.
const PARTS: u32 = 16;

/// `HAIR_SCALE` of `hair.wgsl`: the scale of the exponential distribution of hairs' lengths, mm.
const SCALE: f32 = 0.6;

/// `HAIR_LONGEST` of `hair.wgsl`: the length at which the distribution is cut off, in units of its
/// scale.
const LONGEST: f32 = 4.0;

/// The greatest distance to which a hair reaches from its root, mm.
pub(crate) const REACH: f32 = LONGEST * SCALE;

/// The most parts of hairs that a block can have.
pub(crate) const OF_BLOCK: u64 = BLOCK_RINGS as u64 * OF_GAP as u64 * PARTS as u64;

/// The mean length of hairs, mm.
fn mean() -> f32 {
    SCALE * (1.0 - LONGEST / (E.powf(LONGEST) - 1.0))
}

/// Whether fibres stand off any of `yarns`.
pub(crate) fn any(yarns: &Yarns) -> bool {
    yarns.layout().yarns().iter().any(|yarn| yarns.materials()[yarn.material as usize].hairiness > 0.0)
}

/// The number of hairs per mm of each yarn, for `hairs.wgsl`. Uster's hairiness H is the length of
/// hairs per length of yarn, a pure number.
pub(crate) fn densities(renderer: &Renderer, yarns: &Yarns) -> Result<wgpu::Buffer, BackendError> {
    let mean = mean();
    let density = |yarn: &texere_core::Yarn| yarns.materials()[yarn.material as usize].hairiness / mean;
    let each: Vec<_> = yarns.layout().yarns().iter().map(density).collect();
    renderer.filled("hairs of yarns", bytemuck::cast_slice(&each), BufferUsages::STORAGE)
}
