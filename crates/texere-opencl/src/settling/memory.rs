//! The memory of a settling.

use texere_core::settling::{Place, SettlingPlan};
use texere_core::{BackendError, Limits, OutOfMemory};
use texere_gpu::{ChordRow, EXTENT_GROUPS, ExtentRow, PlaceRow, SeenRow, StrandRow};
use texere_kernels::{SETTLING_PULL_WEIGHTED, SETTLING_SCAN_VALUES};

use crate::buffer::Buffer;
use crate::opened::Opened;
use crate::room::Room;

/// The numbers that a pass writes for each place. The block form of docs/SETTLING.md writes most:
/// nine for each of an interval's four points, and six for the interval.
const PULL_PLANES: u64 = 4 * 9 + 6;

/// The buffers that the kernels read and write.
#[derive(Debug)]
pub(super) struct Memory {
    pub(super) place_rows: Buffer,
    pub(super) strands: Buffer,
    pub(super) chord_rows: Buffer,
    pub(super) places: Buffer,
    /// The places that the last pass measured, before it moved them. The next pass writes its
    /// places here, and then `places` and `seen` change their roles.
    pub(super) seen: Buffer,
    /// The places of the best pass so far.
    pub(super) kept: Buffer,
    /// The last step of each point, mm.
    pub(super) steps: Buffer,
    /// The length that each interval should have, mm.
    pub(super) lengths: Buffer,
    /// All chords: where each begins, its span, its interval's place and its largest half width or
    /// half height.
    pub(super) chords: Buffer,
    pub(super) pulls: Buffer,
    /// The measures of each workgroup of a pass.
    pub(super) rows: Buffer,
    /// The measures of the whole pass.
    pub(super) all: Buffer,
    /// The extent of each workgroup's chords. There are at most [`EXTENT_GROUPS`] workgroups.
    pub(super) extents: Buffer,
    /// The position of each cell's first chord in `sorted`, and the chords cell by cell.
    pub(super) cells: Buffer,
    pub(super) sorted: Buffer,
    /// The position of each chord's first neighbour in `neighbours`, and the neighbours of all
    /// chords.
    pub(super) starts: Buffer,
    pub(super) neighbours: Buffer,
    /// The sums of the workgroups of a scan, level by level.
    pub(super) sums: Vec<Buffer>,
    room: Room,
}

impl Memory {
    /// **Errors**: [`BackendError::OutOfMemory`], also if one buffer, or all buffers together,
    /// would have more than the device's limits allow.
    pub(super) fn new(opened: &Opened, limits: &Limits, plan: &SettlingPlan) -> Result<Self, BackendError> {
        let mut room = Room::new(limits);
        let (places, chords) = (plan.counts().places, plan.counts().chords);
        let groups = places.div_ceil(SETTLING_PULL_WEIGHTED.group as u64);
        let of = |count: u64, each: usize| count * each as u64;
        let place_bytes = of(places, size_of::<Place>());
        // There are at most as many cells as chords, or 64 if there are fewer chords. One number
        // more is the end of the last cell.
        let counts = chords.max(64) + 1;
        let mut sums = Vec::new();
        let mut values = counts;
        while values > 1 || sums.is_empty() {
            values = values.div_ceil(SETTLING_SCAN_VALUES as u64);
            sums.push(room.zeroed(opened, "sums of counts", 4 * values)?);
        }
        Ok(Self {
            place_rows: room.holding(opened, "the place table", &PlaceRow::all(plan))?,
            strands: room.holding(opened, "the strand table", &StrandRow::all(plan))?,
            chord_rows: room.holding(opened, "the chord table", &ChordRow::all(plan))?,
            places: room.zeroed(opened, "places", place_bytes)?,
            seen: room.zeroed(opened, "places that were seen", place_bytes)?,
            kept: room.zeroed(opened, "places that are kept", place_bytes)?,
            steps: room.zeroed(opened, "steps of places", place_bytes)?,
            lengths: room.zeroed(opened, "lengths of intervals", 4 * places)?,
            chords: room.zeroed(opened, "chords", of(chords, 32))?,
            pulls: room.zeroed(opened, "pulls of intervals", 4 * PULL_PLANES * places)?,
            rows: room.zeroed(opened, "what groups have seen", of(groups, size_of::<SeenRow>()))?,
            all: room.zeroed(opened, "what was seen", size_of::<SeenRow>() as u64)?,
            extents: room.zeroed(opened, "extents", of(EXTENT_GROUPS.into(), size_of::<ExtentRow>()))?,
            cells: room.zeroed(opened, "cells of chords", 4 * counts)?,
            sorted: room.zeroed(opened, "chords by cells", 4 * chords)?,
            starts: room.zeroed(opened, "starts of neighbours", 4 * (chords + 1))?,
            neighbours: Buffer::default(),
            sums,
            room,
        })
    }

    /// Makes room for `count` neighbours, and for an eighth more if memory allows it, so
    /// that lists that grow a little take no new memory.
    ///
    /// **Errors**: [`BackendError::OutOfMemory`].
    pub(super) fn reserve_neighbours(&mut self, opened: &Opened, count: u32) -> Result<(), BackendError> {
        let (what, bytes) = ("neighbours of chords", 4 * u64::from(count));
        // A scan whose sum no `u32` holds gives `u32::MAX`.
        if count == u32::MAX {
            return Err(BackendError::OutOfMemory(OutOfMemory { what, bytes }));
        }
        if bytes > self.neighbours.bytes() {
            self.room.memory_bytes += std::mem::take(&mut self.neighbours).bytes();
            let most = self.room.binding_bytes.min(self.room.memory_bytes) / 4 * 4;
            let more = (bytes + bytes / 32 * 4).min(most).max(bytes);
            self.neighbours = self.room.zeroed(opened, what, more)?;
        }
        Ok(())
    }
}
