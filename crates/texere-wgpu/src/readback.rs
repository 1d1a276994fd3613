//! Reads results to the host, piece by piece through two mapped buffers. One is filled while the
//! other is lent.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use texere_core::BackendError;
use wgpu::{BufferUsages, MapMode};

use crate::buffer::Buffer;
use crate::gpu::Gpu;
use crate::mapped::Mapped;

/// The most bytes of a piece: a multiple of the sizes of a vertex, a ring and an index. Larger
/// pieces need more host memory. With smaller pieces the pauses between submissions matter: at 24
/// MB nothing was transferred for a fifth of the time.
const PIECE_BYTES: u64 = 96 << 20;

/// The two buffers, and the time and the bytes of all copies so far.
#[derive(Debug)]
pub(crate) struct Readback {
    sides: [Buffer; 2],
    /// The time spent waiting for copies.
    pub(crate) waited: Duration,
    /// The number of bytes copied.
    pub(crate) bytes: u64,
}

/// A copy in progress. Its buffer is mapped, or will be, and is unmapped when the copy is dropped.
struct Copy<'a> {
    gpu: &'a Gpu,
    buffer: wgpu::Buffer,
    bytes: u64,
    mapped: Mapped,
}

impl Readback {
    pub(crate) fn new(gpu: &Gpu) -> Result<Self, BackendError> {
        let side = || Buffer::new(gpu, "readback", BufferUsages::MAP_READ | BufferUsages::COPY_DST);
        Ok(Self { sides: [side()?, side()?], waited: Duration::ZERO, bytes: 0 })
    }

    /// Lends `count` values of `source` to `sink` in pieces, each with the number of its first
    /// value.
    pub(crate) fn lend<T: bytemuck::AnyBitPattern>(
        &mut self,
        gpu: &Gpu,
        source: &wgpu::Buffer,
        count: u32,
        sink: &mut dyn FnMut(u32, &[T]) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, BackendError> {
        let total = u64::from(count) * size_of::<T>() as u64;
        let mut offsets = (0..total).step_by(PIECE_BYTES as usize);
        let mut waiting = match offsets.next() {
            Some(offset) => Some(self.start(gpu, source, offset, total)?),
            None => None,
        };
        let mut first = 0;
        while let Some(copy) = waiting.take() {
            if let Some(offset) = offsets.next() {
                waiting = Some(self.start(gpu, source, offset, total)?);
            }
            let start = Instant::now();
            let view = copy.wait()?;
            self.waited += start.elapsed();
            self.bytes += copy.bytes;
            let values: &[T] = bytemuck::try_cast_slice(&view).map_err(|error| BackendError::Driver {
                call: "BufferSlice::get_mapped_range",
                source: error.to_string().into(),
            })?;
            if sink(first, values).is_break() {
                return Ok(ControlFlow::Break(()));
            }
            first += values.len() as u32;
        }
        Ok(ControlFlow::Continue(()))
    }

    /// Starts the copy of the piece at `offset`. The next piece uses the other buffer.
    fn start<'a>(
        &mut self,
        gpu: &'a Gpu,
        source: &wgpu::Buffer,
        offset: u64,
        total: u64,
    ) -> Result<Copy<'a>, BackendError> {
        let bytes = PIECE_BYTES.min(total - offset);
        self.sides.swap(0, 1);
        let buffer = self.sides[0].reserve(gpu, bytes)?.clone();
        let mapped = Mapped::submit(gpu, &buffer, MapMode::Read, bytes, |encoder| {
            encoder.copy_buffer_to_buffer(source, offset, &buffer, 0, bytes);
        })?;
        Ok(Copy { gpu, buffer, bytes, mapped })
    }
}

impl Copy<'_> {
    fn wait(&self) -> Result<wgpu::BufferView, BackendError> {
        self.mapped.wait(self.gpu)?;
        self.buffer.get_mapped_range(..self.bytes).map_err(|source| BackendError::Driver {
            call: "BufferSlice::get_mapped_range",
            source: source.into(),
        })
    }
}

impl Drop for Copy<'_> {
    fn drop(&mut self) {
        // An error here can't be returned. Without the scope it would panic.
        let _ = self.gpu.caught(|| self.buffer.unmap());
    }
}
