//! The control intervals that a cell of the search holds.

use glam::UVec3;

use super::line::Line;
use crate::grid::Bounds;

/// One interval in a cell.
pub(super) struct Part<'a> {
    pub(super) point: usize,
    pub(super) line: Line<'a>,
    pub(super) bounds: Bounds,
    /// The first cell that the box reaches into.
    pub(super) cell: UVec3,
}
