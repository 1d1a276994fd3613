//! Every chord's neighbours.

use texere_core::BackendError;
use texere_gpu::{EXTENT_GROUPS, ExtentRow};
use texere_shaders::Resource;
use wgpu::{ComputePass, ComputePassDescriptor};

use super::memory::{numbers, tiles};
use super::{WgpuSettler, record};
use crate::kernels::Kernel;

impl WgpuSettler {
    /// Works out all chords, and cells as they need them while yarns have `growth` of their thickness.
    pub(super) fn find_cells(&mut self, growth: f32) -> Result<(), BackendError> {
        self.params.growth = growth;
        self.send_params()?;
        let (gpu, memory, kernels) = (&self.opened.gpu, &self.memory, &self.kernels);
        let groups = self.chord_groups(&kernels.extent).min(EXTENT_GROUPS);
        let rows: Vec<ExtentRow> =
            self.answer.after(gpu, &memory.extents, (0, groups.into()), |encoder| {
                let chords = self.chord_groups(&kernels.chords);
                record(gpu, memory, encoder, &[(&kernels.chords, chords), (&kernels.extent, groups)]);
            })?;
        self.params = self.params.with_cells(&self.plan, growth, &rows);
        self.send_params()
    }

    /// Sorts chords into cells, and finds the neighbours of each. Gives back how many there are.
    pub(super) fn find_neighbours(&mut self) -> Result<u64, BackendError> {
        let (gpu, memory, kernels) = (&self.opened.gpu, &self.memory, &self.kernels);
        let chords = u64::from(self.params.chords);
        let cells = u64::from(self.params.cells());
        let groups = self.chord_groups(&kernels.count);
        let total: Vec<u32> = self.answer.after(gpu, &memory.list_starts, (chords, 1), |encoder| {
            encoder.clear_buffer(&memory.cell_starts, 0, None);
            encoder.clear_buffer(&memory.list_starts, 0, None);
            record(gpu, memory, encoder, &[(&kernels.cell_count, groups)]);
            let mut pass = encoder.begin_compute_pass(&ComputePassDescriptor::default());
            self.scan(&mut pass, &memory.cell_starts, cells + 1, 0);
            drop(pass);
            record(gpu, memory, encoder, &[(&kernels.cell_fill, groups), (&kernels.count, groups)]);
            let mut pass = encoder.begin_compute_pass(&ComputePassDescriptor::default());
            self.scan(&mut pass, &memory.list_starts, chords + 1, 0);
        })?;
        let total = total.first().copied().unwrap_or(0);
        if total == u32::MAX {
            let bytes = 4 * u64::from(total);
            return Err(BackendError::OutOfMemory { what: "neighbours of chords", bytes });
        }
        self.memory.reserve_neighbours(&self.opened.gpu, total.into())?;
        self.copy(|encoder| {
            record(&self.opened.gpu, &self.memory, encoder, &[(&self.kernels.fill, groups)]);
        })?;
        Ok(total.into())
    }

    /// Counts to where each begins: the first `count` numbers of `counts`, with sums of tiles from those of `level` on.
    fn scan(&self, pass: &mut ComputePass<'_>, counts: &wgpu::Buffer, count: u64, level: usize) {
        let Some(sums) = self.memory.tile_sums.get(level) else { return };
        let tiles = tiles(count);
        let run = |pass: &mut ComputePass<'_>, kernel: &Kernel| {
            let bound = kernel.bind(&self.opened.gpu, |resource| match resource {
                Resource::TileSums => numbers(sums, tiles),
                _ => numbers(counts, count),
            });
            kernel.record(pass, &bound, tiles as u32);
        };
        run(pass, &self.kernels.scan);
        if tiles > 1 {
            self.scan(pass, sums, tiles, level + 1);
            run(pass, &self.kernels.scan_add);
        }
    }
}
