//! The kernels that list neighbours.

use bytemuck::bytes_of;
use texere_core::BackendError;
use texere_core::settling::SettlingPlan;
use texere_gpu::{EXTENT_GROUPS, ExtentRow, SettlingParams};
use texere_kernels::{
    EntryPoint, SETTLING_CELL_COUNT, SETTLING_CELL_FILL, SETTLING_COUNT, SETTLING_EXTENT, SETTLING_FILL,
    SETTLING_SCAN, SETTLING_SCAN_ADD, SETTLING_SCAN_VALUES,
};

use super::memory::Memory;
use super::{begin, in_memory, start};
use crate::buffers::Buffer;
use crate::kernel::{Arg, Kernel};
use crate::opened::Opened;

/// They run one after the other; the host waits for the extent of all chords, and for how many neighbours there are.
#[derive(Debug)]
pub(super) struct ListKernels {
    extent: Kernel,
    cell_count: Kernel,
    cell_fill: Kernel,
    count: Kernel,
    fill: Kernel,
    scan: Scan,
}

impl ListKernels {
    pub(super) fn new(
        kernel: &impl Fn(EntryPoint) -> Result<Kernel, BackendError>,
    ) -> Result<Self, BackendError> {
        Ok(Self {
            extent: kernel(SETTLING_EXTENT)?,
            cell_count: kernel(SETTLING_CELL_COUNT)?,
            cell_fill: kernel(SETTLING_CELL_FILL)?,
            count: kernel(SETTLING_COUNT)?,
            fill: kernel(SETTLING_FILL)?,
            scan: Scan { sum: kernel(SETTLING_SCAN)?, add: kernel(SETTLING_SCAN_ADD)? },
        })
    }

    /// Sorts chords into cells, and gives back `params` with them.
    pub(super) fn cells(
        &mut self,
        opened: &Opened,
        plan: &SettlingPlan,
        params: &SettlingParams,
        memory: &mut Memory,
    ) -> Result<SettlingParams, BackendError> {
        let groups = params.chords.div_ceil(SETTLING_EXTENT.group as u32).min(EXTENT_GROUPS);
        let value = [Arg::Value(bytes_of(params))];
        let args = [&value[..], &in_memory([&memory.chords, &memory.extents])].concat();
        // SAFETY: the arguments are those of `settling_extent`; groups read all chords, and each writes its row.
        unsafe { start(&mut self.extent, opened, &args, groups * SETTLING_EXTENT.group as u32) }?;
        let mut extents = vec![ExtentRow::default(); groups as usize];
        memory.extents.read_now(opened, 0, &mut extents)?;
        let params = params.with_cells(plan, params.growth, &extents);
        memory.cells.clear(opened)?;
        let Memory { chords, cells, sorted, sums, .. } = memory;
        let value = [Arg::Value(bytes_of(&params))];
        let args = [&value[..], &in_memory([chords, cells])].concat();
        // SAFETY: the arguments are those of `settling_cell_count`; a lane reads its chord and adds to its cell's count: there
        // are no more cells than there is room for, and one behind them.
        unsafe { start(&mut self.cell_count, opened, &args, params.chords) }?;
        self.scan.run(opened, cells, params.cells() + 1, sums)?;
        let args = [&value[..], &in_memory([chords, cells, sorted])].concat();
        // SAFETY: the arguments are those of `settling_cell_fill`; a lane writes its chord's number where its cell's count says.
        unsafe { start(&mut self.cell_fill, opened, &args, params.chords) }?;
        Ok(params)
    }

    /// Lists the neighbours of all chords in their cells, and gives back how many there are.
    pub(super) fn neighbours(
        &mut self,
        opened: &Opened,
        params: &SettlingParams,
        memory: &mut Memory,
    ) -> Result<u32, BackendError> {
        // The one behind the last count is to be 0.
        memory.starts.clear(opened)?;
        let value = [Arg::Value(bytes_of(params))];
        let Memory { chords, chord_rows, place_rows, strands, cells, sorted, starts, sums, .. } = memory;
        let tables = in_memory([chords, chord_rows, place_rows, strands, cells, sorted, starts]);
        let args = [&value[..], &tables].concat();
        // SAFETY: the arguments are those of `settling_count`; a lane reads its chord and those of the cells beside it with their
        // rows, and writes its count.
        unsafe { start(&mut self.count, opened, &args, params.chords) }?;
        self.scan.run(opened, starts, params.chords + 1, sums)?;
        let mut total = [0];
        starts.read_now(opened, 4 * u64::from(params.chords), &mut total)?;
        memory.reserve_neighbours(opened, total[0])?;
        let Memory { chords, chord_rows, place_rows, strands, cells, sorted, starts, neighbours, .. } =
            memory;
        let tables = in_memory([chords, chord_rows, place_rows, strands, cells, sorted, starts, neighbours]);
        let args = [&value[..], &tables].concat();
        // SAFETY: the arguments are those of `settling_fill`; a lane reads what it has counted by, and writes as many neighbours as it
        // counted, for all of which there is room.
        unsafe { start(&mut self.fill, opened, &args, params.chords) }?;
        begin(opened)?;
        Ok(total[0])
    }
}

/// The kernels that turn counts into sums of those before each.
#[derive(Debug)]
struct Scan {
    sum: Kernel,
    add: Kernel,
}

impl Scan {
    /// Scans the first `count` of `values`, with room for the sums of groups, level by level.
    fn run(
        &mut self,
        opened: &Opened,
        values: &Buffer,
        count: u32,
        sums: &[Buffer],
    ) -> Result<(), BackendError> {
        let [own, further @ ..] = sums else { return Ok(()) };
        let groups = count.div_ceil(SETTLING_SCAN_VALUES as u32);
        let lanes = groups * SETTLING_SCAN.group as u32;
        let args = [&[Arg::Value(bytes_of(&count))][..], &in_memory([values, own])].concat();
        // SAFETY: the arguments are those of both kernels; a group reads and writes its values, of which there are `count` in all,
        // and writes or reads its sum.
        unsafe { start(&mut self.sum, opened, &args, lanes) }?;
        if groups > 1 {
            self.run(opened, own, groups, further)?;
            // SAFETY: as above.
            unsafe { start(&mut self.add, opened, &args, lanes) }?;
        }
        Ok(())
    }
}
