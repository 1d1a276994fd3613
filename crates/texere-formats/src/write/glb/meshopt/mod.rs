//! The bitstreams of the extensions `EXT_meshopt_compression` and `KHR_meshopt_compression`.
//!
//! Every encoder takes its input piece by piece and keeps a few kilobytes at most, so that a yarn
//! may be larger than memory. The bytes do not depend on the pieces.
//!
//! **Source**: Khronos Group, "EXT_meshopt_compression" and "KHR_meshopt_compression", appendices A
//! and B of each.

mod attributes;
mod octahedral;
#[cfg(test)]
mod tests;
mod triangles;

pub(super) use attributes::{AttributeEncoder, Differences};
pub(super) use octahedral::octahedral;
pub(super) use triangles::TriangleEncoder;

/// An extension of glTF that compresses buffer views.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Meshopt {
    /// The older extension, which most programs know. Its attributes are streams of version 0.
    Ext,
    /// The later extension. Its attributes are streams of version 1, which are shorter.
    Khr,
}

impl Meshopt {
    /// The name of the extension.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Ext => "EXT_meshopt_compression",
            Self::Khr => "KHR_meshopt_compression",
        }
    }

    /// The first byte of a stream of attributes, which says its version.
    const fn attributes_header(self) -> u8 {
        match self {
            Self::Ext => 0xa0,
            Self::Khr => 0xa1,
        }
    }

    /// The fewest bytes of the tail of a stream of attributes.
    const fn tail_bytes_least(self) -> usize {
        match self {
            Self::Ext => 32,
            Self::Khr => 24,
        }
    }
}

/// A difference in zigzag code: 0, -1, 1, -2, … become 0, 1, 2, 3, ….
fn zigzag(difference: i32) -> u32 {
    ((difference << 1) ^ (difference >> 31)) as u32
}
