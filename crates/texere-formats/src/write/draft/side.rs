//! The sides of a cloth.

/// The side of a cloth that faces the viewer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Side {
    /// The technical face.
    #[default]
    Face,
    /// The back: the cloth turned over sideways.
    Back,
}
