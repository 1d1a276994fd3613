//! The two sides of a cloth.

/// The side of a cloth that is seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Side {
    /// The face, from above.
    Front,
    /// The back, with the cloth turned over sideways.
    Back,
}
