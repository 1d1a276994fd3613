//! How triangles are encoded.

/// One of a yarn's two ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum End {
    /// Where its rings start.
    Start,
    /// Where they finish.
    Finish,
}

/// How triangles are encoded. They are counter-clockwise seen from outside.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Topology {
    /// Three `u32` indices a triangle, counted from the chunk's first vertex.
    #[default]
    Indexed,
    /// One index pattern for all parts, drawn with a base vertex. Halves the bytes that have to be
    /// written.
    Shared,
    /// No indices: for a caller who knows the pattern.
    None,
}

/// The most gaps between rings that the shared pattern covers; longer parts take several draws.
/// With up to seven sides every index of it fits 16 bits.
pub(crate) const SHARED_GAPS: u64 = 8192;

/// The indices of the quads between a ring and the next, counted from the ring's first vertex: six
/// for each side.
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
