//! What a device can hold.

/// The limits that chunks are cut to.
///
/// ```
/// use texere_core::Limits;
/// let half = Limits { memory_bytes: 1 << 30, ..Limits::NONE }.min(&Limits { blocks: 65_535, ..Limits::NONE });
/// assert_eq!((half.memory_bytes, half.blocks), (1 << 30, 65_535));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Most bytes of one buffer that a kernel can see.
    pub binding_bytes: u64,
    /// Bytes that the control points and two chunks may take together.
    pub memory_bytes: u64,
    /// Most blocks that one launch can work on.
    pub blocks: u64,
}

impl Limits {
    /// No limit but those of `u32` indices.
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

impl Default for Limits {
    fn default() -> Self {
        Self::NONE
    }
}
