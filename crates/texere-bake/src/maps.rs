//! Maps of one side of a cloth.

use std::ops::ControlFlow;

use glam::Vec3;
use rayon::prelude::*;
use texere_core::backend::room_for;
use texere_core::{Origin, Yarns};
use texere_render::{Camera, Extent, Layers, Scene};

use crate::gaps::fill;
use crate::texel::{Look, SAMPLES, Texel};
use crate::{Area, BakeError, Side, occlusion};

/// The most texels across, and the most down, that are drawn at once. The device then needs some
/// 150 MB.
const PIECE: u32 = 256;

/// The reach of ambient occlusion, in mean radii of the yarns. texere's pictures have the same
/// reach.
const REACH_RADII: f64 = 5.0;

/// What one side of a cloth shows, texel by texel. Rows are listed from the top, and the texels of
/// a row from the left of the side as it is seen.
///
/// Where a texel shows no yarn, its alpha is 0, and its yarn is [`Maps::NO_YARN`]. Its colour,
/// normal and roughness are then those of what lies round the gap, so that a filtered map has no
/// fringes.
#[derive(Debug, Clone, PartialEq)]
pub struct Maps {
    /// Width and height, texels.
    pub size: [u32; 2],
    /// Width and height of the cloth that is shown, mm.
    pub size_mm: [f64; 2],
    /// The colour of the yarns without light: linear red, green and blue from 0 to 1.
    pub color: Vec<[f32; 3]>,
    /// The share of the texel that shows yarn, from 0 to 1.
    pub alpha: Vec<f32>,
    /// The mean direction out of the yarns, of length 1: x to the right, y up, z towards the eye.
    pub normal: Vec<[f32; 3]>,
    /// The mean height of the yarns, mm, from the plane z = 0 towards the eye. Gaps have the least
    /// height of all texels.
    pub height: Vec<f32>,
    /// The roughness of a microfacet surface, from 0 to 1. It is the root of the width α of the
    /// surface's microfacets. α² is twice the sum of two mean square slopes: that of the fibres
    /// along the surface, and that of the normals within the texel.
    ///
    /// **Source**: Burley 2012 (roughness is the root of the width α), Toksvig 2005 (the width of
    /// normals from the length of their mean).
    pub roughness: Vec<f32>,
    /// The share of the light of an even sky that reaches the texel, from 0 to 1: [`occlusion()`].
    pub occlusion: Vec<f32>,
    /// The yarn in the texel's middle: its number in [`Maps::yarns`], counted from 0, or
    /// [`Maps::NO_YARN`].
    pub yarn: Vec<u32>,
    /// The place on the yarn of [`Maps::yarn`]: the angle round the yarn as a share of a turn, and
    /// the distance along it from its first control point, mm. Both are 0 where no yarn is seen.
    pub uv: Vec<[f32; 2]>,
    /// What made each yarn, and the number of the yarn's material. [`Maps::yarn`] has the numbers
    /// of yarns in this list.
    pub yarns: Vec<(Origin, u32)>,
}

impl Maps {
    /// The number that [`Maps::yarn`] has where no yarn is seen.
    pub const NO_YARN: u32 = u32::MAX;

    /// The least and the greatest height, mm.
    #[must_use]
    pub fn heights_mm(&self) -> [f32; 2] {
        let both = |[low, high]: [f32; 2], height: &f32| [low.min(*height), high.max(*height)];
        self.height.iter().fold([f32::INFINITY, f32::NEG_INFINITY], both)
    }

    /// Bakes a side of the cloth in `scene`, which has the yarns `yarns`. `origin` turns the origin
    /// of a yarn of the scene into what made it in the design. Yarns with the same origin and
    /// material get the same number.
    ///
    /// **Errors**: [`BakeError::Render`], [`BakeError::Memory`], [`BakeError::Empty`],
    /// [`BakeError::Cancelled`].
    pub(crate) fn bake(
        scene: &mut Scene,
        yarns: &Yarns,
        area: &Area,
        size: [u32; 2],
        side: Side,
        origin: impl Fn(Origin) -> Origin,
        mut progress: impl FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Self, BakeError> {
        let look = Look::new(yarns, scene.plan().settings(), side, origin);
        let count = u64::from(size[0]) * u64::from(size[1]);
        let mut texels = Vec::new();
        room_for(&mut texels, count as usize, "texels")?;
        texels.resize(count as usize, Texel::default());
        let [columns, rows] = size.map(|texels| texels.div_ceil(PIECE));
        let mut done = 0;
        for row in 0..rows {
            for column in 0..columns {
                let piece = Piece::new(area, size, side, [column * PIECE, row * PIECE]);
                let camera = piece.camera(scene.extent(), side)?;
                let layers =
                    scene.view_layers(&camera, &mut progress_of(&mut progress, done, columns * rows))?;
                piece.gather(&layers, &look, &mut texels, size[0] as usize);
                done += 1;
            }
        }
        Self::of(&texels, look, area, size, scene.extent())
    }

    fn of(
        texels: &[Texel],
        look: Look,
        area: &Area,
        size: [u32; 2],
        extent: &Extent,
    ) -> Result<Self, BakeError> {
        if texels.iter().all(|texel| texel.seen == 0) {
            return Err(BakeError::Empty);
        }
        let is_seen: Vec<bool> = texels.iter().map(|texel| texel.seen > 0).collect();
        let least =
            texels.iter().filter(|texel| texel.seen > 0).map(Texel::height).fold(f32::INFINITY, f32::min);
        let own =
            |texel: &Texel| [texel.color().to_array(), texel.normal().to_array(), [texel.width(), 0.0, 0.0]];
        let mut filled: Vec<[[f32; 3]; 3]> = texels.par_iter().map(own).collect();
        fill(&mut filled, &is_seen, size, area.tiles);
        let height: Vec<f32> =
            texels.iter().map(|texel| if texel.seen > 0 { texel.height() } else { least }).collect();
        let normal: Vec<[f32; 3]> =
            filled.par_iter().map(|own| Vec3::from(own[1]).normalize_or(Vec3::Z).to_array()).collect();
        let texel_mm = [0, 1].map(|axis| area.size[axis] / f64::from(size[axis]));
        let reach = f64::from(extent.radius) * REACH_RADII;
        let shaded = occlusion(&height, &normal, size, texel_mm, reach, area.tiles);
        let samples = (SAMPLES * SAMPLES) as f32;
        Ok(Self {
            size,
            size_mm: area.size,
            color: filled.iter().map(|own| own[0]).collect(),
            alpha: texels.iter().map(|texel| texel.seen as f32 / samples).collect(),
            normal,
            height,
            roughness: filled.iter().map(|own| own[2][0].sqrt().min(1.0)).collect(),
            occlusion: shaded,
            yarn: texels.iter().map(|texel| texel.yarn.checked_sub(1).unwrap_or(Self::NO_YARN)).collect(),
            uv: texels.iter().map(|texel| texel.uv).collect(),
            yarns: look.into_yarns(),
        })
    }
}

/// Turns the progress of one piece, number `done` of `all`, into that of all pieces.
fn progress_of(
    progress: &mut impl FnMut(f64) -> ControlFlow<()>,
    done: u32,
    all: u32,
) -> impl FnMut(f64) -> ControlFlow<()> {
    move |share| progress((f64::from(done) + share) / f64::from(all))
}

/// A rectangle of texels that are drawn at once.
#[derive(Debug, Clone, Copy)]
struct Piece {
    /// The piece's first column and row among all texels.
    first: [u32; 2],
    /// The piece's numbers of columns and rows.
    size: [u32; 2],
    /// The lower left corner of the part of the cloth that the piece shows, mm.
    low: [f64; 2],
    /// The width and height of this part, mm.
    shown: [f64; 2],
}

impl Piece {
    fn new(area: &Area, all: [u32; 2], side: Side, first: [u32; 2]) -> Self {
        let size = [0, 1].map(|axis| PIECE.min(all[axis] - first[axis]));
        let texel = [0, 1].map(|axis| area.size[axis] / f64::from(all[axis]));
        let shown = [0, 1].map(|axis| texel[axis] * f64::from(size[axis]));
        // Rows go down. Columns of the back go to the left in the cloth.
        let left = texel[0] * f64::from(first[0]);
        let left = if side == Side::Front { left } else { area.size[0] - left - shown[0] };
        let lower = area.size[1] - texel[1] * f64::from(first[1]) - shown[1];
        Self { first, size, low: [area.low[0] + left, area.low[1] + lower], shown }
    }

    fn camera(&self, extent: &Extent, side: Side) -> Result<Camera, BakeError> {
        let [low, shown] = [self.low, self.shown].map(|both| both.map(|mm| mm as f32));
        let camera = Camera::plan(extent, low, shown, self.size.map(|texels| texels * SAMPLES))?;
        Ok(if side == Side::Front { camera } else { camera.turned_over() })
    }

    /// Makes the piece's texels from their samples. A row of `texels` has `stride` texels.
    fn gather(&self, layers: &Layers, look: &Look, texels: &mut [Texel], stride: usize) {
        let [first, rows] = [self.first[1] as usize * stride, self.size[1] as usize];
        let lines = texels[first..first + rows * stride].par_chunks_exact_mut(stride);
        lines.enumerate().for_each(|(row, line)| {
            let own = &mut line[self.first[0] as usize..][..self.size[0] as usize];
            for (column, texel) in own.iter_mut().enumerate() {
                *texel = look.texel(layers, [column as u32, row as u32]);
            }
        });
    }
}
