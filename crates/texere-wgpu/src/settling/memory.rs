//! The memory of a settling.

use texere_core::settling::{Place, SettlingPlan};
use texere_core::{BackendError, Limits, OutOfMemory};
use texere_gpu::{ChordRow, EXTENT_GROUPS, ExtentRow, PlaceRow, SeenRow, SettlingParams, StrandRow};
use texere_shaders::Resource;
use texere_shaders::settling::SCAN_VALUES;
use wgpu::{BindingResource, BufferUsages};

use crate::gpu::Gpu;
use crate::parameters::PARAMETERS;
use crate::room::Room;

/// The numbers that a pass writes for each place. The block form of docs/SETTLING.md writes most:
/// nine for each of an interval's four points, and six for the interval.
const PULL_PLANES: u64 = 4 * 9 + 6;

/// The number of lanes of a workgroup of places, which write one row together.
const ROW_PLACES: u64 = 64;

/// The buffers that the shaders read and write.
#[derive(Debug)]
pub(super) struct Memory {
    pub(super) params: wgpu::Buffer,
    place_rows: wgpu::Buffer,
    strands: wgpu::Buffer,
    chord_rows: wgpu::Buffer,
    pub(super) places: wgpu::Buffer,
    /// The places that the last pass measured, before it moved them. The next pass writes its
    /// places here, and then both buffers change their roles.
    pub(super) seen: wgpu::Buffer,
    /// The places of the best pass so far.
    pub(super) kept: wgpu::Buffer,
    /// The last step of each point, mm.
    pub(super) steps: wgpu::Buffer,
    /// The length that each interval should have, mm.
    pub(super) lengths: wgpu::Buffer,
    /// All chords: where each begins, its span, its interval's place and its largest half width or
    /// half height.
    chords: wgpu::Buffer,
    pulls: wgpu::Buffer,
    /// The measures of each workgroup of a pass.
    rows: wgpu::Buffer,
    /// The measures of the whole pass.
    pub(super) all: wgpu::Buffer,
    /// The extent of each workgroup's chords. There are at most [`EXTENT_GROUPS`] workgroups.
    pub(super) extents: wgpu::Buffer,
    /// The position of each cell's first chord in `sorted`, and the chords cell by cell.
    pub(super) cells: wgpu::Buffer,
    sorted: wgpu::Buffer,
    /// The position of each chord's first neighbour in `neighbours`, and the neighbours of all
    /// chords.
    pub(super) starts: wgpu::Buffer,
    pub(super) neighbours: wgpu::Buffer,
    /// The bytes of `room` that `neighbours` has taken.
    listed: u64,
    /// The sums of the workgroups of a scan, level by level.
    pub(super) sums: Vec<wgpu::Buffer>,
    room: Room,
}

impl Memory {
    /// **Errors**: [`BackendError::OutOfMemory`], also if one buffer, or all buffers together,
    /// would have more than the device's limits allow.
    pub(super) fn new(gpu: &Gpu, limits: &Limits, plan: &SettlingPlan) -> Result<Self, BackendError> {
        let mut room = Room::new(gpu, limits);
        let (places, chords) = (plan.counts().places, plan.counts().chords);
        let of = |count: u64, each: usize| count * each as u64;
        let place_bytes = of(places, size_of::<Place>());
        // There are at most as many cells as chords, or 64 if there are fewer chords. One number
        // more is the end of the last cell.
        let counts = chords.max(64) + 1;
        let mut sums = Vec::new();
        let mut values = counts;
        while values > 1 || sums.is_empty() {
            values = groups(values);
            sums.push(room.take(gpu, "sums of counts", 4 * values)?);
        }
        let params = size_of::<SettlingParams>() as u64;
        let seen_row = size_of::<SeenRow>();
        Ok(Self {
            params: gpu.buffer("parameters", params, PARAMETERS | BufferUsages::COPY_DST)?,
            place_rows: room.holding(gpu, "the place table", &PlaceRow::all(plan))?,
            strands: room.holding(gpu, "the strand table", &StrandRow::all(plan))?,
            chord_rows: room.holding(gpu, "the chord table", &ChordRow::all(plan))?,
            places: room.take(gpu, "places", place_bytes)?,
            seen: room.take(gpu, "places that were seen", place_bytes)?,
            kept: room.take(gpu, "places that are kept", place_bytes)?,
            steps: room.take(gpu, "steps of places", place_bytes)?,
            lengths: room.take(gpu, "lengths of intervals", 4 * places)?,
            chords: room.take(gpu, "chords", of(chords, 32))?,
            pulls: room.take(gpu, "pulls of intervals", 4 * PULL_PLANES * places)?,
            rows: room.take(gpu, "what groups have seen", of(places.div_ceil(ROW_PLACES), seen_row))?,
            all: room.take(gpu, "what was seen", seen_row as u64)?,
            extents: room.take(gpu, "extents", of(EXTENT_GROUPS.into(), size_of::<ExtentRow>()))?,
            cells: room.take(gpu, "cells of chords", 4 * counts)?,
            sorted: room.take(gpu, "chords by cells", 4 * chords)?,
            starts: room.take(gpu, "starts of neighbours", 4 * (chords + 1))?,
            neighbours: room.take(gpu, "neighbours of chords", 0)?,
            listed: 0,
            sums,
            room,
        })
    }

    /// The most bytes of a binding.
    pub(super) const fn binding_bytes(&self) -> u64 {
        self.room.binding_bytes
    }

    /// Makes room for `count` neighbours, and for an eighth more if memory allows it, so
    /// that lists that grow a little take no new memory.
    ///
    /// **Errors**: [`BackendError::OutOfMemory`].
    pub(super) fn reserve_neighbours(&mut self, gpu: &Gpu, count: u32) -> Result<(), BackendError> {
        let (what, bytes) = ("neighbours of chords", 4 * u64::from(count));
        if count == u32::MAX {
            return Err(BackendError::OutOfMemory(OutOfMemory { what, bytes }));
        }
        if bytes > self.neighbours.size() {
            let mut room = Room { memory_bytes: self.room.memory_bytes + self.listed, ..self.room };
            let most = room.binding_bytes.min(room.memory_bytes) / 4 * 4;
            let more = (bytes + bytes / 32 * 4).min(most).max(bytes);
            self.neighbours = room.take(gpu, what, more)?;
            (self.room, self.listed) = (room, more);
        }
        Ok(())
    }

    /// The binding of `resource`. None for a resource that is not in this memory.
    pub(super) fn resource(&self, resource: Resource) -> Option<BindingResource<'_>> {
        let buffer = match resource {
            Resource::SettlingParams => &self.params,
            Resource::PlaceRows => &self.place_rows,
            Resource::Strands => &self.strands,
            Resource::Places => &self.places,
            Resource::ChordRows => &self.chord_rows,
            Resource::Chords => &self.chords,
            Resource::CellStarts => &self.cells,
            Resource::CellChords => &self.sorted,
            Resource::ListStarts => &self.starts,
            Resource::Neighbours => &self.neighbours,
            Resource::Lengths => &self.lengths,
            Resource::Pulls => &self.pulls,
            Resource::SeenRows => &self.rows,
            Resource::Extents => &self.extents,
            Resource::Steps => &self.steps,
            Resource::NextPlaces => &self.seen,
            Resource::Seen => &self.all,
            _ => return None,
        };
        Some(buffer.as_entire_binding())
    }
}

/// The workgroups of a scan of `values` values.
pub(super) fn groups(values: u64) -> u64 {
    values.div_ceil(SCAN_VALUES.into())
}
