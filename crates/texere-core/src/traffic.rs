//! Bytes between host and device.

/// Bytes that a session has moved between host and device, so far. A backend that works in the
/// host's own memory lends its results where they lie, so it reads none back.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Traffic {
    /// Control points, their virtual ends included, sent by
    /// [`Session::upload`](crate::backend::Session::upload) or
    /// [`Session::take_settled`](crate::backend::Session::take_settled). Tables are not counted:
    /// they are sent once.
    pub uploaded: u64,
    /// Rings, vertices, packed or not, and indices that came back, and control points of a settler
    /// on another device.
    pub read: u64,
}
