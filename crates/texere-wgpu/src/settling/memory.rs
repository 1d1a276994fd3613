//! Device memory of a settling.

use texere_core::settling::{Place, SettlingPlan};
use texere_core::{BackendError, Limits};
use texere_gpu::{ChordRow, EXTENT_GROUPS, ExtentRow, PlaceRow, SeenRow, SettlingParams, StrandRow};
use texere_shaders::Resource;
use texere_shaders::settling::SCAN_TILE;
use wgpu::{BindingResource, BufferBinding, BufferSize, BufferUsages};

use crate::gpu::Gpu;

/// Everything that stays on the device, each array in a buffer of its own.
#[derive(Debug)]
pub(super) struct Memory {
    pub(super) limit: u64,
    pub(super) params: wgpu::Buffer,
    place_rows: wgpu::Buffer,
    strands: wgpu::Buffer,
    chord_rows: wgpu::Buffer,
    /// Where everything is.
    pub(super) places: wgpu::Buffer,
    /// Where everything was when the last pass saw it; the next places while a pass makes them.
    pub(super) seen: wgpu::Buffer,
    chords: wgpu::Buffer,
    pub(super) cell_starts: wgpu::Buffer,
    cell_chords: wgpu::Buffer,
    pub(super) list_starts: wgpu::Buffer,
    neighbours: wgpu::Buffer,
    pub(super) lengths: wgpu::Buffer,
    pub(super) steps: wgpu::Buffer,
    pulls: wgpu::Buffer,
    seen_rows: wgpu::Buffer,
    pub(super) extents: wgpu::Buffer,
    /// What the last pass has seen.
    pub(super) whole: wgpu::Buffer,
    /// Sums of tiles, of tiles of those, and so on.
    pub(super) tile_sums: Vec<wgpu::Buffer>,
}

/// Numbers that the pulls of an interval are written as, in the form that has more of them.
const PLANES: u64 = 42;

/// Lanes of a workgroup of places.
const ROW_PLACES: u64 = 64;

impl Memory {
    /// Takes memory for a plan and sends what never changes.
    ///
    /// **Errors**: [`BackendError::OutOfMemory`], also for an array larger than a binding may be.
    pub(super) fn new(gpu: &Gpu, limits: &Limits, plan: &SettlingPlan) -> Result<Self, BackendError> {
        let limit = limits.binding_bytes.min(gpu.device.limits().max_storage_buffer_binding_size);
        let counts = plan.counts();
        let (places, chords) = (counts.places, counts.chords);
        let array = |what, bytes| array(gpu, limit, what, bytes);
        let table = |what, bytes: &[u8]| {
            let table = array(what, bytes.len() as u64)?;
            gpu.write(&table, 0, bytes)?;
            Ok::<_, BackendError>(table)
        };
        let scanned = (chords.max(CELLS) + 1).max(places);
        let tiles = std::iter::successors(Some(tiles(scanned)), |&count| (count > 1).then(|| tiles(count)));
        let place_bytes = places * size_of::<Place>() as u64;
        Ok(Self {
            limit,
            params: gpu.buffer(
                "parameters",
                size_of::<SettlingParams>() as u64,
                BufferUsages::UNIFORM | BufferUsages::COPY_DST,
            )?,
            place_rows: table("places' tags", bytemuck::cast_slice(&PlaceRow::all(plan)))?,
            strands: table("strands", bytemuck::cast_slice(&StrandRow::all(plan)))?,
            chord_rows: table("the chord table", bytemuck::cast_slice(&ChordRow::all(plan)))?,
            places: array("places", place_bytes)?,
            seen: array("places before the last pass", place_bytes)?,
            chords: array("chords", 32 * chords)?,
            cell_starts: array("cells", 4 * (chords.max(CELLS) + 1))?,
            cell_chords: array("chords by cells", 4 * chords)?,
            list_starts: array("lists' starts", 4 * (chords + 1))?,
            neighbours: array("neighbours of chords", 0)?,
            lengths: array("lengths", 4 * places)?,
            steps: array("steps", 16 * places)?,
            pulls: array("pulls", 4 * PLANES * places)?,
            seen_rows: array("what workgroups see", 16 * places.div_ceil(ROW_PLACES))?,
            extents: array("extents", u64::from(EXTENT_GROUPS) * size_of::<ExtentRow>() as u64)?,
            whole: array("what a pass sees", size_of::<SeenRow>() as u64)?,
            tile_sums: tiles.map(|count| array("tiles' sums", 4 * count)).collect::<Result<_, _>>()?,
        })
    }

    /// A buffer like that of places.
    pub(super) fn more_places(&self, gpu: &Gpu) -> Result<wgpu::Buffer, BackendError> {
        array(gpu, self.limit, "places that are kept", self.places.size())
    }

    /// Makes room for so many neighbours, and an eighth more where it is too small.
    pub(super) fn reserve_neighbours(&mut self, gpu: &Gpu, count: u64) -> Result<(), BackendError> {
        let what = "neighbours of chords";
        if self.neighbours.size() < 4 * count {
            let more = (4 * (count + count / 8)).min(self.limit).max(4 * count);
            self.neighbours = array(gpu, self.limit, what, more)?;
        }
        Ok(())
    }

    /// What a shader sees as `resource`.
    pub(super) fn resource(&self, resource: Resource) -> BindingResource<'_> {
        let buffer = match resource {
            Resource::SettlingParams => &self.params,
            Resource::PlaceRows => &self.place_rows,
            Resource::Strands => &self.strands,
            Resource::Places => &self.places,
            Resource::ChordRows => &self.chord_rows,
            Resource::Chords => &self.chords,
            Resource::CellStarts => &self.cell_starts,
            Resource::CellChords => &self.cell_chords,
            Resource::ListStarts => &self.list_starts,
            Resource::Neighbours => &self.neighbours,
            Resource::Lengths => &self.lengths,
            Resource::Pulls => &self.pulls,
            Resource::SeenRows => &self.seen_rows,
            Resource::Extents => &self.extents,
            Resource::Steps => &self.steps,
            Resource::NextPlaces => &self.seen,
            _ => &self.whole,
        };
        buffer.as_entire_binding()
    }
}

/// Cells that a grid may have however few chords there are.
const CELLS: u64 = 64;

/// Tiles of a scan of so many numbers.
pub(super) fn tiles(count: u64) -> u64 {
    count.div_ceil(SCAN_TILE.into())
}

/// The first `count` numbers of a buffer.
pub(super) fn numbers(buffer: &wgpu::Buffer, count: u64) -> BindingResource<'_> {
    BindingResource::Buffer(BufferBinding { buffer, offset: 0, size: BufferSize::new(4 * count) })
}

fn array(gpu: &Gpu, limit: u64, what: &'static str, bytes: u64) -> Result<wgpu::Buffer, BackendError> {
    if bytes > limit {
        return Err(BackendError::OutOfMemory { what, bytes });
    }
    gpu.buffer(what, bytes, BufferUsages::STORAGE | BufferUsages::COPY_DST | BufferUsages::COPY_SRC)
}
