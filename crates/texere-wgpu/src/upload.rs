//! Control points to the device: all cores pad them into mapped buffers, piece by piece, while the
//! piece before is copied.

use std::ops::Range;

use rayon::prelude::*;
use texere_core::{BackendError, ControlPoint};
use texere_gpu::PaddedUpload;
use wgpu::{BufferUsages, BufferViewMut, MapMode, WriteOnly};

use crate::gpu::Gpu;
use crate::mapped::Mapped;

const POINT_BYTES: u64 = size_of::<ControlPoint>() as u64;

/// Up to so many points, such as an edited yarn's, go through wgpu's own staging. For more it would
/// make a buffer as large as all of them, and to have that much memory mapped takes several times
/// as long as to fill and copy it.
const FEW_POINTS: u64 = (2 << 20) / POINT_BYTES;

/// Bytes of a piece: so few that filling one and copying the other overlap from early on.
const PIECE_BYTES: u64 = 8 << 20;

/// Bytes that a core pads at a time. A multiple of them is a piece.
const PART_BYTES: usize = 64 << 10;

/// Two mapped buffers that control points are sent from, made for the first upload of more than a
/// few points and kept for the next.
#[derive(Debug, Default)]
pub(crate) struct Outbox {
    sides: Vec<Side>,
}

impl Outbox {
    /// Sends `upload` to `target`: it is there before any later launch. Gives back the bytes of it.
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
                // On one of the pool's threads, which need not be woken by another one for each
                // piece.
                let pieces = rayon::scope(|_| self.send_pieces(gpu, target, upload, range));
                // A side that was left in between is not to be used again.
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
    /// Work after which it is mapped; none where it is.
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

/// Writes the padded points of `piece` to the start of `view`, by all cores.
fn pad(upload: &PaddedUpload<'_>, piece: &Range<u64>, view: &mut BufferViewMut) {
    const PART_POINTS: u64 = PART_BYTES as u64 / POINT_BYTES;
    // Arrays, since wgpu lets no other thread have a slice.
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
