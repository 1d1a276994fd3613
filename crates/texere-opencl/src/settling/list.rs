//! The kernels that list neighbours.

use bytemuck::bytes_of;
use opencl3::command_queue::flush;
use texere_core::BackendError;
use texere_core::settling::SettlingPlan;
use texere_gpu::{EXTENT_GROUPS, ExtentRow, SettlingParams};
use texere_kernels::{
    EntryPoint, SETTLING_CELL_COUNT, SETTLING_CELL_FILL, SETTLING_COUNT, SETTLING_EXTENT, SETTLING_FILL,
    SETTLING_SCAN, SETTLING_SCAN_ADD, SETTLING_SCAN_VALUES,
};

use super::memory::Memory;
use crate::buffer::Buffer;
use crate::kernel::{Arg, Kernel, in_memory, start};
use crate::opened::Opened;

/// The kernels of a list run one after the other. The host waits twice: for the extent of all
/// chords, and for the number of neighbours.
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

    /// Sorts chords into cells, and returns `params` with the cells.
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
        // SAFETY: the arguments are those of `settling_extent`. Groups read all chords, and each
        // writes its row.
        unsafe { start(&mut self.extent, opened, &args, groups * SETTLING_EXTENT.group as u32) }?;
        let mut extents = vec![ExtentRow::default(); groups as usize];
        memory.extents.read_now(opened, 0, &mut extents)?;
        let params = params.with_cells(plan, params.growth, &extents);
        memory.cells.clear(opened)?;
        let Memory { chords, cells, sorted, sums, .. } = memory;
        let value = [Arg::Value(bytes_of(&params))];
        let args = [&value[..], &in_memory([chords, cells])].concat();
        // SAFETY: the arguments are those of `settling_cell_count`. A lane reads its chord and adds
        // to its cell's count. There is room for all cells, and for one entry behind them.
        unsafe { start(&mut self.cell_count, opened, &args, params.chords) }?;
        self.scan.run(opened, cells, params.cells() + 1, sums)?;
        let args = [&value[..], &in_memory([chords, cells, sorted])].concat();
        // SAFETY: the arguments are those of `settling_cell_fill`. A lane writes its chord's number
        // at the position that it gets from its cell. There is a position for each chord.
        unsafe { start(&mut self.cell_fill, opened, &args, params.chords) }?;
        Ok(params)
    }

    /// Lists the neighbours of all chords, and returns their number.
    pub(super) fn neighbours(
        &mut self,
        opened: &Opened,
        plan: &SettlingPlan,
        params: &SettlingParams,
        memory: &mut Memory,
    ) -> Result<u32, BackendError> {
        // The value behind the last count must be 0, because the scan includes it.
        memory.starts.clear(opened)?;
        let value = [Arg::Value(bytes_of(params))];
        let Memory { chords, chord_rows, place_rows, strands, cells, sorted, starts, sums, .. } = memory;
        let tables = in_memory([chords, chord_rows, place_rows, strands, cells, sorted, starts]);
        let args = [&value[..], &tables].concat();
        // SAFETY: the arguments are those of `settling_count`. A lane reads its chord, the chords
        // of the cells beside it and the rows of all of them, and writes its count.
        unsafe { start(&mut self.count, opened, &args, params.chords) }?;
        self.scan.run(opened, starts, params.chords + 1, sums)?;
        let mut total = [0];
        starts.read_now(opened, 4 * u64::from(params.chords), &mut total)?;
        plan.allow_neighbours(total[0].into())?;
        memory.reserve_neighbours(opened, total[0])?;
        let Memory { chords, chord_rows, place_rows, strands, cells, sorted, starts, neighbours, .. } =
            memory;
        let tables = in_memory([chords, chord_rows, place_rows, strands, cells, sorted, starts, neighbours]);
        let args = [&value[..], &tables].concat();
        // SAFETY: the arguments are those of `settling_fill`. A lane reads what the kernel that
        // counted has read, and writes no more neighbours than were counted, for all of which there
        // is room.
        unsafe { start(&mut self.fill, opened, &args, params.chords) }?;
        flush(opened.queue.raw()).map_err(opened.failed("clFlush"))?;
        Ok(total[0])
    }
}

/// The kernels that replace each count by the sum of the counts before it.
#[derive(Debug)]
struct Scan {
    sum: Kernel,
    add: Kernel,
}

impl Scan {
    /// Scans the first `count` of `values`. `sums` has room for the sums of workgroups, level by
    /// level.
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
        // SAFETY: the arguments are those of both kernels. A group reads and writes its values, of
        // which there are `count` in all, and writes or reads its sum.
        unsafe { start(&mut self.sum, opened, &args, lanes) }?;
        if groups > 1 {
            self.run(opened, own, groups, further)?;
            // SAFETY: the arguments are those of both kernels. A group reads its sum, and reads and
            // writes its values, of which there are `count` in all.
            unsafe { start(&mut self.add, opened, &args, lanes) }?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use texere_core::backend::Schedule;
    use texere_core::settling::{Chord, Listed, Settler, Settling, tag};
    use texere_core::{ControlPoint, Limits, Yarn, Yarns};

    use super::*;
    use crate::OpenClBackend;
    use crate::settling::OpenClSettler;

    /// Tests three levels of sums, and sums that stop at the largest number.
    #[test]
    fn sums_are_those_of_all_counts_before() {
        let opened = OpenClBackend::open(0, Schedule::PerRing).unwrap().opened;
        let kernel = |entry| Kernel::of(&opened, opened.settling(false)?, entry);
        let mut scan = Scan { sum: kernel(SETTLING_SCAN).unwrap(), add: kernel(SETTLING_SCAN_ADD).unwrap() };
        for (most, count) in [(9, 1_050_001), (9, 1024), (9, 1025), (9, 1), (1 << 20, 9000)] {
            let counts: Vec<u32> = (0..count).map(|k: u32| k.wrapping_mul(2_654_435_761) % most).collect();
            let values = Buffer::holding(&opened, "counts", &counts).unwrap();
            let sums = [1026, 2, 1].map(|groups| Buffer::zeroed(&opened, "sums", 4 * groups).unwrap());
            scan.run(&opened, &values, count, &sums).unwrap();
            let mut found = vec![0; counts.len()];
            values.read_now(&opened, 0, &mut found).unwrap();
            let before = counts.iter().scan(0_u32, |sum, count| {
                let before = *sum;
                *sum = sum.saturating_add(*count);
                Some(before)
            });
            assert!(before.eq(found.iter().copied()), "{count} counts below {most}");
            assert_eq!(found.last() == Some(&u32::MAX), most > 9);
        }
    }

    /// The neighbours of each chord are those that a comparison of all pairs finds, in the order of
    /// their numbers.
    #[test]
    fn neighbours_are_listed_in_the_order_of_their_numbers() {
        let mut yarns = Yarns::builder();
        for yarn in 0..24 {
            let along = |k: u32| k as f32 * 0.35;
            let aside = (yarn / 2) as f32 * 0.6 + 0.1;
            let point = |k: u32| match yarn % 2 {
                0 => ControlPoint::new(along(k), aside, 0.2, 0.25),
                _ => ControlPoint::new(aside, along(k), -0.2, 0.25),
            };
            yarns.yarn(Yarn::default(), &(0..20).map(point).collect::<Vec<_>>());
        }
        let plan = Arc::new(SettlingPlan::new(&Settling::new(&yarns.build().unwrap())).unwrap());
        let opened = OpenClBackend::open(0, Schedule::PerRing).unwrap().opened;
        let mut settler = OpenClSettler::new(opened.clone(), &Limits::NONE, plan.clone()).unwrap();
        let points = plan.places().iter().zip(plan.tags()).filter(|(_, tags)| *tags & tag::POINT != 0);
        settler.upload(&points.map(|(place, _)| *place).collect::<Vec<_>>()).unwrap();
        let count = settler.list(1.0).unwrap();
        let chords = plan.counts().chords as usize;
        let (mut starts, mut found) = (vec![0_u32; chords + 1], vec![0_u32; count as usize]);
        settler.memory.starts.read_now(&opened, 0, &mut starts).unwrap();
        settler.memory.neighbours.read_now(&opened, 0, &mut found).unwrap();
        let mut all = Vec::new();
        for place in (0..plan.places().len()).filter(|&place| plan.tags()[place] & tag::INTERVAL != 0) {
            let interval = plan.interval(plan.places(), place);
            let pieces = plan.chords()[place + 1] - plan.chords()[place];
            let chord = |piece| (place, interval, Chord::new(&interval, piece, pieces, plan.scale()));
            all.extend((0..pieces).map(chord));
        }
        let listed = |number: usize| {
            let (place, interval, chord) = &all[number];
            Listed::new(&plan, number as u32, chord, *place, interval)
        };
        for one in 0..chords {
            let near = (0..chords)
                .filter(|&other| other != one && plan.are_neighbours(listed(one), listed(other), 1.0))
                .map(|other| other as u32);
            let own = &found[starts[one] as usize..starts[one + 1] as usize];
            assert!(near.eq(own.iter().copied()), "chord {one}: {own:?}");
        }
        assert!(count > 1000, "{count} neighbours of {chords} chords");
    }
}
