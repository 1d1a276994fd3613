//! Control points to the device: piece by piece through two mapped buffers, one of which is filled while the other is
//! copied.

use texere_core::BackendError;
use wgpu::{BufferUsages, MapMode};

use crate::gpu::Gpu;
use crate::mapped::Mapped;

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
    sides.iter().try_for_each(|side| side.mapped.wait(gpu))
}

/// A buffer that is mapped, or going to be.
struct Side<'a> {
    gpu: &'a Gpu,
    buffer: wgpu::Buffer,
    mapped: Mapped,
}

impl<'a> Side<'a> {
    fn new(gpu: &'a Gpu) -> Result<Self, BackendError> {
        let usage = BufferUsages::MAP_WRITE | BufferUsages::COPY_SRC;
        let buffer = gpu.buffer("upload", PIECE_BYTES as u64, usage)?;
        let mapped = Mapped::submit(gpu, &buffer, MapMode::Write, PIECE_BYTES as u64, |_| ())?;
        Ok(Self { gpu, buffer, mapped })
    }

    fn send(&mut self, target: &wgpu::Buffer, offset: u64, piece: &[u8]) -> Result<(), BackendError> {
        self.mapped.wait(self.gpu)?;
        let (call, bytes) = ("Buffer::get_mapped_range_mut", piece.len() as u64);
        let filled = self.gpu.scoped(call, || {
            let view = self.buffer.get_mapped_range_mut(..bytes);
            let filled = view.map(|mut view| view.copy_from_slice(piece));
            self.buffer.unmap();
            filled
        })?;
        filled.map_err(|source| BackendError::Driver { call, source: source.into() })?;
        self.mapped =
            Mapped::submit(self.gpu, &self.buffer, MapMode::Write, PIECE_BYTES as u64, |encoder| {
                encoder.copy_buffer_to_buffer(&self.buffer, 0, target, offset, bytes);
            })?;
        Ok(())
    }
}
