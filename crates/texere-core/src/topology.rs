//! The encoding of triangles.

/// One of the two ends of a yarn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum End {
    /// The end with its first ring.
    Start,
    /// The end with its last ring.
    Finish,
}

/// The encoding of triangles, which are counter-clockwise seen from outside.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Topology {
    /// Three `u32` indices per triangle, counted from the chunk's first vertex.
    #[default]
    Indexed,
    /// One index pattern for all parts, drawn with a base vertex. About half as many bytes have to
    /// be written as with [`Topology::Indexed`].
    Shared,
    /// No indices. This is for a caller who has the pattern.
    None,
}

/// The most gaps between rings that the shared pattern covers. Longer parts need several draws.
/// With up to seven sides every index fits 16 bits.
pub(crate) const SHARED_GAPS: u64 = 8192;

/// The indices of the quads between a ring and the next, counted from the ring's first vertex: six
/// per side.
///
/// ```
/// let quad = &texere_core::definitions::index_pattern(6)[..6];
/// assert_eq!(quad, [0, 1, 6, 1, 7, 6]);
/// ```
#[must_use]
pub fn index_pattern(sides: u32) -> Vec<u32> {
    (0..sides)
        .flat_map(|k| {
            let next = (k + 1) % sides;
            [k, next, sides + k, next, sides + next, sides + k]
        })
        .collect()
}
