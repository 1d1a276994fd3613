//! The block: the unit of work on every backend.

use bytemuck::{Pod, Zeroable};

/// Number of rings of a full block. 64 rings of six vertices are nine kilobytes, which fit a core's
/// first cache. A GPU works on each block with one workgroup.
pub const BLOCK_RINGS: u32 = 64;

/// A block: up to [`BLOCK_RINGS`] consecutive rings of one yarn. Blocks are the rows of a table. A
/// kernel reads a block's yarn from the row, without a search.
///
/// **Shape**: eight `u32`, 32 bytes. `first_ring` is counted from the start of the yarn, and
/// `first_point` from the start of the chunk's window. The window is the range of padded control
/// points that the chunk reads. All other positions are counted from the start of the chunk.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Pod, Zeroable)]
pub struct Block {
    /// Number of the yarn among all yarns, counted from 0.
    pub yarn: u32,
    /// Number of the first ring, counted from the yarn's start.
    pub first_ring: u32,
    /// Number of rings whose vertices the block writes, 1 to 64.
    pub rings: u32,
    /// Number of rings that are joined by quads to the ring after them. It equals `rings`, or is
    /// one less at the end of a part.
    pub quads: u32,
    /// Number of the padded control point `P[j-1]` of the first ring's interval, counted from the
    /// start of the chunk's window.
    pub first_point: u32,
    /// Number of the first ring among the chunk's rings.
    pub chunk_ring: u32,
    /// Number of the first vertex among the chunk's.
    pub first_vertex: u32,
    /// Number of the first index among the chunk's, if the topology is indexed.
    pub first_index: u32,
}

impl Block {
    /// Whether the rings of `next` follow directly on those of this block, on the same yarn.
    #[must_use]
    pub const fn is_before(&self, next: &Self) -> bool {
        self.yarn == next.yarn && self.first_ring + self.rings == next.first_ring
    }
}

const _: () = assert!(size_of::<Block>() == 32 && std::mem::offset_of!(Block, first_index) == 28);
