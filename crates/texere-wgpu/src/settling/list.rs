//! The kernels that list neighbours.

use texere_core::BackendError;
use texere_gpu::{EXTENT_GROUPS, ExtentRow};
use texere_shaders::Resource;
use wgpu::{BindingResource, BufferBinding, BufferSize, CommandEncoder, ComputePassDescriptor};

use super::memory::groups;
use super::{SettlingKernels, WgpuSettler, record, submit};
use crate::gpu::Gpu;
use crate::kernel::Kernel;

impl WgpuSettler {
    /// Works out all chords, and the cells for them. `growth` is the share of their thickness that
    /// yarns have.
    pub(super) fn find_cells(&mut self, growth: f32) -> Result<(), BackendError> {
        self.params.growth = growth;
        self.send_params()?;
        let (gpu, memory, kernels) = (&self.opened.gpu, &self.memory, &self.kernels);
        let groups = kernels.extent.workgroups(self.params.chords).min(EXTENT_GROUPS);
        let rows: Vec<ExtentRow> =
            self.answer.after(gpu, &memory.extents, (0, groups.into()), |encoder| {
                let chords = kernels.chords.workgroups(self.params.chords);
                record(gpu, memory, encoder, &[(&kernels.chords, chords), (&kernels.extent, groups)]);
            })?;
        self.params = self.params.with_cells(&self.plan, growth, &rows);
        self.send_params()
    }

    /// Sorts chords into cells, and lists the neighbours of each chord. Returns the number of all
    /// neighbours.
    pub(super) fn find_neighbours(&mut self) -> Result<u32, BackendError> {
        let Self { opened, memory, kernels, answer, params, .. } = self;
        let (gpu, chords) = (&opened.gpu, u64::from(params.chords));
        let groups = kernels.count.workgroups(params.chords);
        let total: Vec<u32> = answer.after(gpu, &memory.starts, (chords, 1), |encoder| {
            encoder.clear_buffer(&memory.cells, 0, None);
            // The value behind the last count must be 0, because the scan includes it.
            encoder.clear_buffer(&memory.starts, 0, None);
            record(gpu, memory, encoder, &[(&kernels.cell_count, groups)]);
            scan(gpu, kernels, encoder, (&memory.cells, u64::from(params.cells()) + 1), &memory.sums);
            record(gpu, memory, encoder, &[(&kernels.cell_fill, groups), (&kernels.count, groups)]);
            scan(gpu, kernels, encoder, (&memory.starts, chords + 1), &memory.sums);
        })?;
        let total = total.first().copied().unwrap_or(0);
        self.plan.allow_neighbours(total.into())?;
        memory.reserve_neighbours(gpu, total)?;
        submit(gpu, |encoder| record(gpu, memory, encoder, &[(&kernels.fill, groups)]))?;
        Ok(total)
    }
}

/// Replaces each of the first `count` of `values` by the sum of the values before it. `sums` has
/// room for the sums of workgroups, level by level.
fn scan(
    gpu: &Gpu,
    kernels: &SettlingKernels,
    encoder: &mut CommandEncoder,
    (values, count): (&wgpu::Buffer, u64),
    sums: &[wgpu::Buffer],
) {
    let [own, further @ ..] = sums else { return };
    let groups = groups(count);
    let run = |encoder: &mut CommandEncoder, kernel: &Kernel| {
        let bound = kernel.bind(gpu, |resource| match resource {
            Resource::ScanValues => Some(first(values, count)),
            Resource::ScanSums => Some(first(own, groups)),
            _ => None,
        });
        let mut pass = encoder.begin_compute_pass(&ComputePassDescriptor::default());
        kernel.record(&mut pass, &bound, groups as u32);
    };
    run(encoder, &kernels.scan);
    if groups > 1 {
        scan(gpu, kernels, encoder, (own, groups), further);
        run(encoder, &kernels.scan_add);
    }
}

/// The first `count` numbers of a buffer.
fn first(buffer: &wgpu::Buffer, count: u64) -> BindingResource<'_> {
    BindingResource::Buffer(BufferBinding { buffer, offset: 0, size: BufferSize::new(4 * count) })
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;
    use std::sync::Arc;

    use texere_core::backend::Schedule;
    use texere_core::settling::{Chord, Listed, Settler, Settling, SettlingPlan, tag};
    use texere_core::{ControlPoint, Limits, Yarn, Yarns};
    use wgpu::BufferUsages;

    use super::*;
    use crate::WgpuBackend;
    use crate::readback::Readback;

    /// The first `count` numbers of `source`.
    fn read(gpu: &Gpu, source: &wgpu::Buffer, count: u32) -> Vec<u32> {
        let mut all = Vec::new();
        let read = Readback::new(gpu).unwrap().lend(gpu, source, count, &mut |_, numbers| {
            all.extend_from_slice(numbers);
            ControlFlow::Continue(())
        });
        assert!(read.unwrap().is_continue());
        all
    }

    /// Tests three levels of sums, and sums that stop at the largest number.
    #[test]
    fn sums_are_those_of_all_counts_before() {
        let opened = WgpuBackend::open(0, Schedule::PerRing).unwrap().opened;
        let (gpu, kernels) = (&opened.gpu, opened.settling(false).unwrap());
        let usage = BufferUsages::STORAGE | BufferUsages::COPY_DST | BufferUsages::COPY_SRC;
        for (most, count) in [(9, 1_050_001), (9, 1024), (9, 1025), (9, 1), (1 << 20, 9000)] {
            let counts: Vec<u32> = (0..count).map(|k: u32| k.wrapping_mul(2_654_435_761) % most).collect();
            let values = gpu.buffer("counts", 4 * u64::from(count), usage).unwrap();
            gpu.write(&values, 0, bytemuck::cast_slice(&counts)).unwrap();
            let sums = [1026, 2, 1].map(|groups| gpu.buffer("sums", 4 * groups, usage).unwrap());
            submit(gpu, |encoder| scan(gpu, &kernels, encoder, (&values, count.into()), &sums)).unwrap();
            let found = read(gpu, &values, count);
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
        let opened = WgpuBackend::open(0, Schedule::PerRing).unwrap().opened;
        let mut settler = WgpuSettler::new(opened.clone(), &Limits::NONE, plan.clone()).unwrap();
        let points = plan.places().iter().zip(plan.tags()).filter(|(_, tags)| *tags & tag::POINT != 0);
        settler.upload(&points.map(|(place, _)| *place).collect::<Vec<_>>()).unwrap();
        let count = settler.list(1.0).unwrap() as u32;
        let chords = plan.counts().chords as usize;
        let starts = read(&opened.gpu, &settler.memory.starts, chords as u32 + 1);
        let found = read(&opened.gpu, &settler.memory.neighbours, count);
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
