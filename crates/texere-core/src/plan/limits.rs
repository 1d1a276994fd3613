//! The limits of a device, which chunks are cut to.

use super::BLOCK_RINGS;
use crate::Vertex;
use crate::definitions::SIDES_MAX;

/// The limits that chunks are cut to.
///
/// By default a buffer of a chunk has at most 64 MiB. With six sides that is some 466,000 rings and
/// 5.6 million triangles. Two such chunks need less than 300 MiB, whatever the fabric. Progress is
/// reported after each chunk, and a cancellation takes effect after the present one. Larger chunks
/// would only save launches.
///
/// ```
/// use texere_core::Limits;
/// let half = Limits { memory_bytes: 1 << 30, ..Limits::default() };
/// let both = half.min(&Limits { blocks: 65_535, ..Limits::NONE });
/// assert_eq!((both.memory_bytes, both.blocks, both.binding_bytes), (1 << 30, 65_535, 64 << 20));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// The most bytes of one buffer that a kernel can see.
    pub binding_bytes: u64,
    /// The most bytes of all control points and two chunks together.
    pub memory_bytes: u64,
    /// The most blocks of one launch.
    pub blocks: u64,
}

impl Limits {
    /// No limits except those of an indexed draw, which counts indices in a `u32` and vertices in
    /// an `i32`.
    pub const NONE: Self = Self { binding_bytes: u64::MAX, memory_bytes: u64::MAX, blocks: u64::MAX };

    /// The stricter of two limits in each field.
    #[must_use]
    pub fn min(&self, other: &Self) -> Self {
        Self {
            binding_bytes: self.binding_bytes.min(other.binding_bytes),
            memory_bytes: self.memory_bytes.min(other.memory_bytes),
            blocks: self.blocks.min(other.blocks),
        }
    }
}

/// The most bytes of a buffer of a chunk by default.
const CHUNK_BUFFER_BYTES: u64 = 64 << 20;

// A block with the largest number of sides fits, so the default refuses no plan.
const _: () = assert!(
    (BLOCK_RINGS as u64 + 3) * (SIDES_MAX as u64) * (size_of::<Vertex>() as u64) <= CHUNK_BUFFER_BYTES
        && (BLOCK_RINGS as u64 + 2) * (SIDES_MAX as u64) * 6 * 4 <= CHUNK_BUFFER_BYTES
);

impl Default for Limits {
    /// Chunks of bounded size, on a device without limits of its own.
    fn default() -> Self {
        Self { binding_bytes: CHUNK_BUFFER_BYTES, ..Self::NONE }
    }
}
