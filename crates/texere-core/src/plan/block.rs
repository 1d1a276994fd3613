//! The block: the unit of work on every backend.

use bytemuck::{Pod, Zeroable};

/// The rings of a full block. 64 rings of six vertices are nine kilobytes, which fit a core's first
/// cache. On a GPU a block is a workgroup.
pub const BLOCK_RINGS: u32 = 64;

/// A block: up to [`BLOCK_RINGS`] consecutive rings of one yarn. Blocks are the rows of a table
/// from which every kernel learns its yarn without a search.
///
/// **Shape**: eight `u32`, 32 bytes. All but `yarn` and `first_ring` count from the start of the
/// chunk.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Pod, Zeroable)]
pub struct Block {
    /// The yarn, from 0 among all.
    pub yarn: u32,
    /// The first ring, from the yarn's start.
    pub first_ring: u32,
    /// The rings whose vertices the block writes, 1 to 64.
    pub rings: u32,
    /// The rings that are joined by quads to the ring after each: `rings`, or one less at the end
    /// of a part.
    pub quads: u32,
    /// The padded control point `P[j-1]` of the first ring's interval, from the start of the
    /// chunk's window.
    pub first_point: u32,
    /// The first ring among the chunk's.
    pub chunk_ring: u32,
    /// The first vertex.
    pub first_vertex: u32,
    /// The first index, if the topology has any.
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
