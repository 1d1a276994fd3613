//! How a piece of cloth goes on beyond its edges.

/// How a yarn goes on at its ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Ends {
    /// It ends there.
    #[default]
    Open,
    /// Its last control point joins up with its first.
    Closed,
    /// It goes on in the next repeat: the point after its last one is its first one, moved by so many repeats in x and in y.
    Repeats([i32; 2]),
}
