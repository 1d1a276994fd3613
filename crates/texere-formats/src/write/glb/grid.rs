//! The grids on which packed vertices lie.
//!
//! Source: Khronos Group, "KHR_mesh_quantization".

use std::borrow::Cow;

use texere_core::Vertex;

use crate::write::WriteError;
use crate::write::bounds::Bounds;
use crate::write::corners::Batch;

/// The number of steps from a grid's middle to either end: the largest signed 16-bit number.
const STEPS: f32 = 32767.0;

/// The number of steps of a packed direction from 0 to 1: the largest signed 8-bit number. In 40
/// million random directions, packed ones were off by 0.39 degrees at most, and their lengths by
/// 0.006735 at most. Khronos' validator complains about lengths that are off by more than 0.00674.
const DIRECTION_STEPS: f32 = 127.0;

/// The longest yarn that is packed, by the longest side of its box, mm. Its grid has steps of 0.01
/// mm, which is 1/20 of the diameter of a yarn of 0.2 mm. Longer steps would spoil the rings of
/// such a yarn.
const LENGTH_MOST_MM: f32 = 655.0;

/// The shortest step, mm, for yarns that are hardly more than a point.
const STEP_LEAST_MM: f32 = 1e-9;

/// The grid of a yarn's packed positions. Positions are numbers of the grid's steps from its
/// middle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Grid {
    /// The middle of the yarn's box, mm.
    pub(super) middle: [f32; 3],
    /// The length of a step along any axis, mm.
    pub(super) step: f32,
}

impl Grid {
    /// The finest grid for each yarn.
    ///
    /// **Errors**: [`WriteError::TooLongToPack`].
    pub(super) fn all(bounds: &Bounds) -> Result<Vec<Self>, WriteError> {
        let grid = |(yarn, [low, high]): (usize, &[[f32; 3]; 2])| {
            // The ends of the box are halved before they are added, because their sum may be too
            // large for a float.
            let middle = [0, 1, 2].map(|axis| 0.5 * low[axis] + 0.5 * high[axis]);
            let reach = |axis: usize| (high[axis] - middle[axis]).max(middle[axis] - low[axis]);
            let reach = reach(0).max(reach(1)).max(reach(2));
            if reach.is_finite() && 2.0 * reach > LENGTH_MOST_MM {
                let (length_mm, limit_mm) = (2.0 * reach, LENGTH_MOST_MM);
                return Err(WriteError::TooLongToPack { yarn, length_mm, limit_mm });
            }
            // The step is the scale of a node. Readers can't invert a scale of next to nothing.
            let step = (reach / STEPS).max(STEP_LEAST_MM);
            Ok(Self { middle, step })
        };
        bounds.yarns().iter().enumerate().map(grid).collect()
    }

    /// A vertex with its position in whole steps.
    pub(super) fn stepped(&self, vertex: &Vertex) -> Vertex {
        let steps = |axis: usize| {
            let from = f64::from(vertex.position[axis]) - f64::from(self.middle[axis]);
            (from / f64::from(self.step)).round_ties_even() as f32
        };
        Vertex { position: [0, 1, 2].map(|axis| steps(axis).clamp(-STEPS, STEPS)), ..*vertex }
    }
}

/// The vertices of a batch. With `grids` their positions are in steps of their yarn's grid.
pub(super) fn stepped<'a>(grids: Option<&[Grid]>, batch: &Batch<'a>) -> Cow<'a, [Vertex]> {
    match grids {
        Some(grids) => {
            let grid = &grids[batch.yarn as usize];
            batch.vertices.iter().map(|vertex| grid.stepped(vertex)).collect()
        }
        None => batch.vertices.into(),
    }
}

/// The bytes of a position in whole steps: three 16-bit coordinates and padding.
pub(super) fn packed_position(steps: [f32; 3]) -> [u8; 8] {
    let mut bytes = [0; 8];
    for (place, steps) in bytes.chunks_exact_mut(2).zip(steps) {
        place.copy_from_slice(&(steps as i16).to_le_bytes());
    }
    bytes
}

/// The bytes of a unit vector and a fourth number: four 8-bit numbers.
pub(super) fn packed_direction(direction: [f32; 3], fourth: i8) -> [u8; 4] {
    let [x, y, z] = direction.map(|share| (share * DIRECTION_STEPS).round_ties_even() as i8);
    [x, y, z, fourth].map(|number| number as u8)
}
