//! Reads results to the host, piece by piece through pinned memory.

use std::ops::ControlFlow;
use std::sync::Arc;

use bytemuck::Pod;
use opencl3::command_queue::{CL_NON_BLOCKING, flush};
use opencl3::memory::CL_MAP_READ;
use texere_core::BackendError;

use crate::buffer::Buffer;
use crate::clock::{Clock, Stage};
use crate::handles::Handle;
use crate::opened::Opened;
use crate::pinned::Pinned;

/// The bytes of a piece, which a sink is lent at a time. A piece holds whole vertices (24 bytes) or
/// whole rings (48 bytes). It is so large that the start of a transfer takes a negligible part of
/// the transfer's time.
const PIECE_BYTES: usize = (16 << 20) / 96 * 96;

/// Two pieces of pinned memory. While the sink reads one, the other is filled.
#[derive(Debug, Default)]
pub(crate) struct Readback {
    pieces: [Option<Pinned>; 2],
}

/// A function that is lent values, with the number of the first.
pub(crate) type Sink<'a, T> = &'a mut dyn FnMut(u32, &[T]) -> ControlFlow<()>;

impl Readback {
    /// Reads `count` values from the start of `buffer`, after `after`, and lends them to `sink`
    /// piece by piece.
    pub(crate) fn read<T: Pod>(
        &mut self,
        opened: &Arc<Opened>,
        buffer: &Buffer,
        count: u32,
        after: Option<&Handle>,
        clock: &mut Clock,
        sink: Sink<'_, T>,
    ) -> Result<ControlFlow<()>, BackendError> {
        let (count, each) = (count as usize, size_of::<T>());
        let per_piece = PIECE_BYTES / each;
        let mut launch = |pieces: &mut [Option<Pinned>; 2], first: usize| {
            let here = per_piece.min(count - first);
            let piece = &mut pieces[first / per_piece % 2];
            let pinned = match piece.take().filter(|pinned| pinned.bytes() >= here * each) {
                Some(pinned) => pinned,
                None => Pinned::new(opened, "reading results back", CL_MAP_READ, here * each)?,
            };
            let start = pinned.start();
            *piece = Some(pinned);
            // SAFETY: the pinned memory is large enough. Commands run in order, so no other command
            // writes it at the time, and the host does not read it before this command has ended.
            let event = unsafe {
                buffer.enqueue_read(
                    opened,
                    &opened.transfers,
                    CL_NON_BLOCKING,
                    first * each,
                    here * each,
                    start,
                    after,
                )
            }?;
            clock.note(Stage::Readback, &event);
            flush(opened.transfers.raw()).map_err(opened.failed("clFlush"))?;
            Ok::<_, BackendError>(event)
        };
        let mut running = if count > 0 { Some(launch(&mut self.pieces, 0)?) } else { None };
        let mut first = 0;
        while let Some(event) = running {
            let next = first + per_piece;
            running = if next < count { Some(launch(&mut self.pieces, next)?) } else { None };
            opened.wait(&event)?;
            if let Some(pinned) = &self.pieces[first / per_piece % 2] {
                // SAFETY: the command that wrote this piece has ended, and the command that is
                // running writes the other piece.
                let values = unsafe { pinned.values(per_piece.min(count - first)) }?;
                if sink(first as u32, values).is_break() {
                    return Ok(ControlFlow::Break(()));
                }
            }
            first = next;
        }
        Ok(ControlFlow::Continue(()))
    }
}
