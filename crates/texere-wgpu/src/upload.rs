//! Sends control points to the device, piece by piece. All cores pad a piece into a mapped buffer,
//! while the device copies the piece before.

use std::ops::Range;

use rayon::prelude::*;
use texere_core::{BackendError, ControlPoint};
use texere_gpu::PaddedUpload;
use wgpu::{BufferUsages, BufferViewMut, MapMode, WriteOnly};

use crate::gpu::Gpu;
use crate::mapped::Mapped;

const POINT_BYTES: u64 = size_of::<ControlPoint>() as u64;

/// The most points that go through wgpu's own staging, such as an edited yarn's. For more, wgpu
/// would make a buffer as large as all of them, and mapping that much memory takes several times as
/// long as filling and copying it.
const FEW_POINTS: u64 = (2 << 20) / POINT_BYTES;

/// The bytes of a piece. It is small, so that filling and copying soon overlap.
const PIECE_BYTES: u64 = 8 << 20;

/// The number of bytes that a core pads at a time. A piece is a multiple of it.
const PART_BYTES: usize = 64 << 10;

/// The two mapped buffers that control points are sent from. They are made for the first upload of
/// more than a few points, and kept.
#[derive(Debug, Default)]
pub(crate) struct Outbox {
    sides: Vec<Side>,
}

impl Outbox {
    /// Sends `upload` to `target`, where it arrives before any later launch. Returns the number of
    /// its bytes.
    pub(crate) fn send(
        &mut self,
        gpu: &Gpu,
        target: &wgpu::Buffer,
        upload: &PaddedUpload<'_>,
    ) -> Result<u64, BackendError> {
        let mut sent = 0;
        for range in upload.ranges() {
            let count = range.end - range.start;
            if count > FEW_POINTS {
                // This runs on a thread of the pool. Threads of the pool then need not be woken
                // from outside for each piece.
                let pieces = rayon::scope(|_| self.send_pieces(gpu, target, upload, range));
                // Buffers that an error left half filled must not be used again.
                pieces.inspect_err(|_| self.sides.clear())?;
            } else {
                let offset = range.start * POINT_BYTES;
                gpu.write(target, offset, bytemuck::cast_slice(&upload.copied(range)))?;
            }
            sent += count * POINT_BYTES;
        }
        Ok(sent)
    }

    fn send_pieces(
        &mut self,
        gpu: &Gpu,
        target: &wgpu::Buffer,
        upload: &PaddedUpload<'_>,
        range: Range<u64>,
    ) -> Result<(), BackendError> {
        while self.sides.len() < 2 {
            self.sides.push(Side::new(gpu)?);
        }
        let per_piece = PIECE_BYTES / POINT_BYTES;
        for (number, first) in range.clone().step_by(per_piece as usize).enumerate() {
            let piece = first..range.end.min(first + per_piece);
            self.sides[number % 2].send(gpu, target, upload, piece)?;
        }
        self.sides.iter_mut().try_for_each(|side| side.wait(gpu))
    }
}

#[derive(Debug)]
struct Side {
    buffer: wgpu::Buffer,
    /// The submission after which the buffer is mapped; none if it is mapped now.
    mapped: Option<Mapped>,
}

impl Side {
    fn new(gpu: &Gpu) -> Result<Self, BackendError> {
        let buffer = gpu.buffer("upload", PIECE_BYTES, BufferUsages::MAP_WRITE | BufferUsages::COPY_SRC)?;
        let mapped = Mapped::submit(gpu, &buffer, MapMode::Write, PIECE_BYTES, |_| ())?;
        Ok(Self { buffer, mapped: Some(mapped) })
    }

    fn wait(&mut self, gpu: &Gpu) -> Result<(), BackendError> {
        self.mapped.take().map_or(Ok(()), |mapped| mapped.wait(gpu))
    }

    fn send(
        &mut self,
        gpu: &Gpu,
        target: &wgpu::Buffer,
        upload: &PaddedUpload<'_>,
        piece: Range<u64>,
    ) -> Result<(), BackendError> {
        self.wait(gpu)?;
        let call = "Buffer::get_mapped_range_mut";
        let filled = gpu.scoped(call, || {
            let view = self.buffer.get_mapped_range_mut(..);
            let filled = view.map(|mut view| pad(upload, &piece, &mut view));
            self.buffer.unmap();
            filled
        })?;
        filled.map_err(|source| BackendError::Driver { call, source: source.into() })?;
        let (offset, bytes) = (piece.start * POINT_BYTES, (piece.end - piece.start) * POINT_BYTES);
        self.mapped = Some(Mapped::submit(gpu, &self.buffer, MapMode::Write, PIECE_BYTES, |encoder| {
            encoder.copy_buffer_to_buffer(&self.buffer, 0, target, offset, bytes);
        })?);
        Ok(())
    }
}

/// Writes the padded points of `piece` to the start of `view`, on all cores.
fn pad(upload: &PaddedUpload<'_>, piece: &Range<u64>, view: &mut BufferViewMut) {
    const PART_POINTS: u64 = PART_BYTES as u64 / POINT_BYTES;
    // The parts are arrays, because wgpu's slices can't be sent to other threads.
    let parts: Vec<_> = view.slice(..).into_chunks::<PART_BYTES>().0.into_iter().collect();
    parts.into_par_iter().enumerate().for_each(|(number, part)| {
        let first = piece.start + number as u64 * PART_POINTS;
        let (mut part, mut at) = (WriteOnly::<[u8]>::from(part), 0);
        upload.runs(first..piece.end.min(first + PART_POINTS), |run| {
            let run: &[u8] = bytemuck::cast_slice(run);
            part.slice(at..at + run.len()).copy_from_slice(run);
            at += run.len();
        });
    });
}
