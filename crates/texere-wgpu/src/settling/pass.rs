//! The kernels of a pass.

use texere_core::BackendError;
use texere_core::settling::{Pass, SettlingSeen};
use texere_gpu::SeenRow;

use super::{WgpuSettler, record};

impl WgpuSettler {
    /// Makes a pass from `memory.places` to `memory.seen`, and returns its measures.
    pub(super) fn run(&mut self, pass: &Pass) -> Result<SettlingSeen, BackendError> {
        self.params = self.params.with_pass(&self.plan, pass);
        self.send_params()?;
        let (gpu, memory, kernels) = (&self.opened.gpu, &self.memory, &self.kernels);
        let [pull, step] = kernels.form(pass.form);
        let places = pull.workgroups(self.params.places);
        let yarns = kernels.ends.workgroups(self.params.yarns);
        let seen: Vec<SeenRow> = self.answer.after(gpu, &memory.all, (0, 1), |encoder| {
            let stages = [
                (&kernels.chords, kernels.chords.workgroups(self.params.chords)),
                (pull, places),
                (step, places),
                (&kernels.ends, yarns),
                (&kernels.seen, 1),
            ];
            record(gpu, memory, encoder, &stages);
        })?;
        Ok(seen.first().map_or(SettlingSeen::NOTHING, |row| row.seen()))
    }
}
