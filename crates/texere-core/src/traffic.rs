//! The bytes moved between host and device.

/// The bytes that a session or a live mesh has moved between host and device so far. If a backend
/// works in the host's own memory, its results are lent there, and nothing counts as read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Traffic {
    /// Bytes of control points with their virtual ends, sent by a call such as
    /// [`Session::upload`](crate::backend::Session::upload) or
    /// [`Session::take_settled`](crate::backend::Session::take_settled). Tables do not count.
    pub uploaded: u64,
    /// Bytes of rings, vertices (packed or not), attributes and indices that were read, and of
    /// control points that were read from a settler on another device.
    pub read: u64,
}
