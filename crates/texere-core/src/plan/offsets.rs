//! The offsets of each yarn's control points, rings and blocks, with or without room for more.

use super::BLOCK_RINGS;
use crate::definitions::Sampling;
use crate::{Layout, PlanError};

/// The most rings of one plan, 2³⁶. With six sides, more would be a mesh of over ten terabytes,
/// which must be a mistake in the input.
pub const RINGS_MAX: u64 = 1 << 36;

/// The most rings of one yarn: the largest `u32`.
pub const YARN_RINGS_MAX: u64 = u32::MAX as u64;

/// Prefix sums over the yarns. Each list has one value more than there are yarns.
#[derive(Debug)]
pub(super) struct Offsets {
    pub(super) padded: Vec<u64>,
    pub(super) rings: Vec<u64>,
    pub(super) blocks: Vec<u64>,
    /// Whether the offsets were made with room for more control points.
    pub(super) roomy: bool,
}

impl Offsets {
    /// The offsets of the yarns of `layout`. `room` gives the most control points that a yarn may
    /// have. If that is less than the yarn has, the yarn's own number counts.
    pub(super) fn new(
        layout: &Layout,
        sampling: &Sampling,
        room: Option<&dyn Fn(usize) -> u64>,
    ) -> Result<Self, PlanError> {
        let mut offsets = Self { padded: vec![0], rings: vec![0], blocks: vec![0], roomy: room.is_some() };
        let (mut padded, mut rings, mut blocks) = (0, 0, 0);
        for (index, (yarn, bounds)) in layout.yarns().iter().zip(layout.offsets().windows(2)).enumerate() {
            let points = (bounds[1] - bounds[0]).max(room.map_or(0, |room| room(index)));
            // 2^32 points of 2^10 rings each fit a u64. More points are refused, whatever the
            // number of rings.
            let own = if points > YARN_RINGS_MAX { points } else { sampling.rings(points, yarn.closed) };
            if own > YARN_RINGS_MAX {
                return Err(PlanError::YarnRings { yarn: index, rings: own, limit: YARN_RINGS_MAX });
            }
            padded += points + virtual_points(yarn.closed);
            rings += own;
            blocks += own.div_ceil(u64::from(BLOCK_RINGS));
            if rings > RINGS_MAX {
                return Err(PlanError::Rings { rings, limit: RINGS_MAX });
            }
            offsets.padded.push(padded);
            offsets.rings.push(rings);
            offsets.blocks.push(blocks);
        }
        Ok(offsets)
    }

    /// The most control points that `yarn` may have.
    pub(super) fn room(&self, yarn: usize, closed: bool) -> u64 {
        self.padded[yarn + 1] - self.padded[yarn] - virtual_points(closed)
    }
}

/// The number of padded control points of a yarn beside its own control points.
pub(super) const fn virtual_points(closed: bool) -> u64 {
    if closed { 4 } else { 2 }
}
