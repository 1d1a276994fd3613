//! Control points to the device: piece by piece through two mapped buffers, one of which is filled while the other is
//! copied.

use std::sync::mpsc::{Receiver, sync_channel};

use texere_core::BackendError;
use wgpu::{BufferAsyncError, BufferUsages, MapMode, SubmissionIndex};

use crate::gpu::{Gpu, WAIT_LIMIT};

/// Bytes of a piece: so few that filling one and copying the other overlap from early on.
const PIECE_BYTES: usize = 8 << 20;

/// Sends `bytes` to `target`, `offset` bytes from its start; they are there before any later launch.
///
/// wgpu's own way is a buffer as large as all of them, made for the occasion: to have that much memory mapped takes several
/// times as long as to fill and copy it.
pub(crate) fn send(gpu: &Gpu, target: &wgpu::Buffer, offset: u64, bytes: &[u8]) -> Result<(), BackendError> {
    if bytes.len() <= PIECE_BYTES {
        return gpu.write(target, offset, bytes);
    }
    let mut sides = [Side::new(gpu)?, Side::new(gpu)?];
    for (number, piece) in bytes.chunks(PIECE_BYTES).enumerate() {
        let at = offset + (number * PIECE_BYTES) as u64;
        sides[number % 2].send(target, at, piece)?;
    }
    sides.iter().try_for_each(Side::wait)
}

/// A buffer that is mapped, or going to be.
struct Side<'a> {
    gpu: &'a Gpu,
    buffer: wgpu::Buffer,
    submission: SubmissionIndex,
    mapped: Receiver<Result<(), BufferAsyncError>>,
}

impl<'a> Side<'a> {
    fn new(gpu: &'a Gpu) -> Result<Self, BackendError> {
        let buffer =
            gpu.buffer("upload", PIECE_BYTES as u64, BufferUsages::MAP_WRITE | BufferUsages::COPY_SRC)?;
        let (submission, mapped) = submit(gpu, &buffer, None)?;
        Ok(Self { gpu, buffer, submission, mapped })
    }

    /// Waits until the buffer is mapped again.
    fn wait(&self) -> Result<(), BackendError> {
        self.gpu.wait(self.submission.clone())?;
        // Another thread's poll may have found the work done, and be about to say so.
        match self.mapped.recv_timeout(WAIT_LIMIT) {
            Ok(Ok(())) => Ok(()),
            Ok(Err(source)) => Err(self.gpu.lost(source)),
            Err(source) => {
                Err(BackendError::Driver { call: "BufferSlice::map_async", source: source.into() })
            }
        }
    }

    fn send(&mut self, target: &wgpu::Buffer, offset: u64, piece: &[u8]) -> Result<(), BackendError> {
        self.wait()?;
        let call = "Buffer::get_mapped_range_mut";
        let filled = self.gpu.scoped(call, || {
            let view = self.buffer.get_mapped_range_mut(..piece.len() as u64);
            let filled = view.map(|mut view| view.copy_from_slice(piece));
            self.buffer.unmap();
            filled
        })?;
        filled.map_err(|source| BackendError::Driver { call, source: source.into() })?;
        let copy = (target, offset, piece.len() as u64);
        (self.submission, self.mapped) = submit(self.gpu, &self.buffer, Some(copy))?;
        Ok(())
    }
}

/// Copies the start of `buffer` to a target, and asks for it to be mapped once that is done.
fn submit(
    gpu: &Gpu,
    buffer: &wgpu::Buffer,
    copy: Option<(&wgpu::Buffer, u64, u64)>,
) -> Result<(SubmissionIndex, Receiver<Result<(), BufferAsyncError>>), BackendError> {
    let (note, mapped) = sync_channel(1);
    let submission = gpu.scoped("Queue::submit", || {
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        if let Some((target, offset, bytes)) = copy {
            encoder.copy_buffer_to_buffer(buffer, 0, target, offset, bytes);
        }
        let submission = gpu.queue.submit([encoder.finish()]);
        buffer.map_async(MapMode::Write, .., move |answer| {
            let _ = note.send(answer);
        });
        submission
    })?;
    Ok((submission, mapped))
}
