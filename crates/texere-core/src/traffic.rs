//! Bytes moved between host and device.

/// The bytes that a session has moved between host and device so far. A backend that works in the
/// host's own memory lends its results there, so nothing counts as read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Traffic {
    /// Control points with their virtual ends, sent by
    /// [`Session::upload`](crate::backend::Session::upload) or
    /// [`Session::take_settled`](crate::backend::Session::take_settled). Tables do not count: they
    /// are sent once.
    pub uploaded: u64,
    /// Rings, vertices (packed or not) and indices that were read, and control points read from a
    /// settler on another device.
    pub read: u64,
}
