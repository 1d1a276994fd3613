//! Mapped buffers: the submission of work that fills or empties a buffer, and the wait until the
//! host may use the buffer.

use std::sync::mpsc::{Receiver, sync_channel};

use texere_core::BackendError;
use wgpu::{BufferAsyncError, CommandEncoder, MapMode, SubmissionIndex};

use crate::gpu::{Gpu, WAIT_LIMIT};

/// A submission in progress, after which the start of a buffer is mapped.
#[derive(Debug)]
pub(crate) struct Mapped {
    submission: SubmissionIndex,
    answer: Receiver<Result<(), BufferAsyncError>>,
}

impl Mapped {
    /// Submits what `record` records, and asks for the first `bytes` of `buffer` to be mapped after
    /// that work.
    pub(crate) fn submit(
        gpu: &Gpu,
        buffer: &wgpu::Buffer,
        mode: MapMode,
        bytes: u64,
        record: impl FnOnce(&mut CommandEncoder),
    ) -> Result<Self, BackendError> {
        let (note, answer) = sync_channel(1);
        let submission = gpu.scoped("Queue::submit", || {
            let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            record(&mut encoder);
            let submission = gpu.queue.submit([encoder.finish()]);
            buffer.map_async(mode, ..bytes, move |answer| {
                let _ = note.send(answer);
            });
            submission
        })?;
        Ok(Self { submission, answer })
    }

    /// Waits until the buffer is mapped.
    pub(crate) fn wait(&self, gpu: &Gpu) -> Result<(), BackendError> {
        gpu.wait(self.submission.clone())?;
        // Another thread's poll may have found the work done, and be about to report it.
        match self.answer.recv_timeout(WAIT_LIMIT) {
            Ok(Ok(())) => Ok(()),
            // The buffer is valid and its work is done, so the device must be lost.
            Ok(Err(source)) => Err(gpu.lost(source)),
            Err(source) => {
                Err(BackendError::Driver { call: "BufferSlice::map_async", source: source.into() })
            }
        }
    }
}
