//! The kernels of a pass.

use bytemuck::bytes_of;
use texere_core::BackendError;
use texere_core::settling::{Form, SettlingSeen};
use texere_gpu::{SeenRow, SettlingParams};
use texere_kernels::{
    EntryPoint, SETTLING_CHORDS, SETTLING_ENDS, SETTLING_PULL_BLOCK, SETTLING_PULL_WEIGHTED, SETTLING_SEEN,
    SETTLING_STEP_BLOCK, SETTLING_STEP_WEIGHTED,
};

use super::memory::Memory;
use crate::kernel::{Arg, Kernel, in_memory, start};
use crate::opened::Opened;

/// The kernels of a pass run one after the other. At the end the host waits for 16 bytes.
#[derive(Debug)]
pub(super) struct PassKernels {
    chords: Kernel,
    /// The kernels of pulls and of steps, in the weighted form and in the block form.
    weighted: [Kernel; 2],
    block: [Kernel; 2],
    ends: Kernel,
    seen: Kernel,
}

// The kernels of pulls write a row for each workgroup, and the kernels of steps add to the same
// rows.
const _: () = assert!(
    SETTLING_PULL_WEIGHTED.group == SETTLING_STEP_WEIGHTED.group
        && SETTLING_PULL_WEIGHTED.group == SETTLING_PULL_BLOCK.group
        && SETTLING_PULL_BLOCK.group == SETTLING_STEP_BLOCK.group
);

impl PassKernels {
    pub(super) fn new(
        kernel: &impl Fn(EntryPoint) -> Result<Kernel, BackendError>,
    ) -> Result<Self, BackendError> {
        Ok(Self {
            chords: kernel(SETTLING_CHORDS)?,
            weighted: [kernel(SETTLING_PULL_WEIGHTED)?, kernel(SETTLING_STEP_WEIGHTED)?],
            block: [kernel(SETTLING_PULL_BLOCK)?, kernel(SETTLING_STEP_BLOCK)?],
            ends: kernel(SETTLING_ENDS)?,
            seen: kernel(SETTLING_SEEN)?,
        })
    }

    /// Works out all chords.
    pub(super) fn chords(
        &mut self,
        opened: &Opened,
        params: &SettlingParams,
        memory: &Memory,
    ) -> Result<(), BackendError> {
        let Memory { places, place_rows, chord_rows, chords, .. } = memory;
        let value = [Arg::Value(bytes_of(params))];
        let args = [&value[..], &in_memory([places, place_rows, chord_rows, chords])].concat();
        // SAFETY: the arguments are those of `settling_chords`. A lane reads its chord's row, the
        // rows of its interval and of the next place, and the interval's four places, and writes
        // its chord. There is room for all chords of the plan.
        unsafe { start(&mut self.chords, opened, &args, params.chords) }
    }

    /// Makes a pass from `memory.places` to `memory.seen`, and returns its measures.
    pub(super) fn run(
        &mut self,
        opened: &Opened,
        params: &SettlingParams,
        form: Form,
        memory: &Memory,
    ) -> Result<SettlingSeen, BackendError> {
        self.chords(opened, params, memory)?;
        let Memory { places, place_rows, strands, chords, starts, neighbours, .. } = memory;
        let Memory { lengths, pulls, rows, steps, seen: next, all, .. } = memory;
        let value = [Arg::Value(bytes_of(params))];
        let tables = in_memory([places, place_rows, chords, starts, neighbours, lengths, pulls, rows]);
        let args = [&value[..], &tables].concat();
        let [pull, step] = if form == Form::Block { &mut self.block } else { &mut self.weighted };
        // SAFETY: the arguments are those of the pull kernels of both forms. A lane reads its
        // interval's places, rows and chords, the neighbours that were listed for the chords, and
        // each neighbour with the places and rows of its interval. It writes its planes, and a
        // group writes its row.
        unsafe { start(pull, opened, &args, params.places) }?;
        let tables = in_memory([places, place_rows, strands, pulls, steps, lengths, next, rows]);
        let args = [&value[..], &tables].concat();
        // SAFETY: the arguments are those of the step kernels of both forms. A lane reads the rows
        // of its place and its yarn, and the planes of its yarn's intervals. It writes its own
        // step, length and next place, and a group adds to its row.
        unsafe { start(step, opened, &args, params.places) }?;
        let args = [&value[..], &in_memory([strands, next])].concat();
        // SAFETY: the arguments are those of `settling_ends`. A lane reads its yarn's row and
        // places, and writes the places beyond the yarn's ends.
        unsafe { start(&mut self.ends, opened, &args, params.yarns) }?;
        let count = params.places.div_ceil(SETTLING_STEP_WEIGHTED.group as u32);
        let args = [&[Arg::Value(bytes_of(&count))][..], &in_memory([rows, all])].concat();
        // SAFETY: the arguments are those of `settling_seen`. The only group reads `count` rows and
        // writes one.
        unsafe { start(&mut self.seen, opened, &args, 1) }?;
        let mut seen = [SeenRow::default()];
        all.read_now(opened, 0, &mut seen)?;
        Ok(seen[0].seen())
    }
}
