//! The bitstreams of the extension `EXT_meshopt_compression`.
//!
//! Every encoder takes its input piece by piece and keeps a few kilobytes at most, so that a yarn
//! may be larger than memory. The bytes do not depend on the pieces.
//!
//! Source: Khronos Group, "EXT_meshopt_compression", appendices A and B.

mod attributes;
mod octahedral;
#[cfg(test)]
mod tests;
mod triangles;

pub(super) use attributes::AttributeEncoder;
pub(super) use octahedral::octahedral;
pub(super) use triangles::TriangleEncoder;

/// A difference in zigzag code: 0, -1, 1, -2, … become 0, 1, 2, 3, ….
fn zigzag(difference: i32) -> u32 {
    ((difference << 1) ^ (difference >> 31)) as u32
}
