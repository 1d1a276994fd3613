//! Sends control points to the device, piece by piece. All cores pad a piece into pinned memory,
//! while earlier pieces are sent.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::thread;

use opencl3::command_queue::{CL_NON_BLOCKING, flush};
use opencl3::memory::CL_MAP_WRITE;
use texere_core::{BackendError, ControlPoint};
use texere_gpu::PaddedUpload;

use crate::buffer::Buffer;
use crate::clock::{Clock, Stage};
use crate::handles::Handle;
use crate::opened::Opened;
use crate::pinned::Pinned;

const POINT_BYTES: u64 = size_of::<ControlPoint>() as u64;

/// The most points, such as an edited yarn's, that are sent without pinned memory. For so few, the
/// driver's own transfer is as fast.
const FEW_POINTS: u64 = (2 << 20) / POINT_BYTES;

/// The most points that are sent without pinned memory as long as no earlier upload had more than
/// [`FEW_POINTS`]. Allocating pinned memory takes more time than it saves in one such upload, and
/// there may be no other.
const FIRST_POINTS: u64 = (16 << 20) / POINT_BYTES;

/// The number of points of a piece. A piece is so large that the overhead of a transfer is
/// negligible. The first pieces are shorter, so that transfers start early.
const PIECE_POINTS: u64 = (8 << 20) / POINT_BYTES;
const FIRST_PIECE_POINTS: u64 = (2 << 20) / POINT_BYTES;

/// The number of points that a core pads at a time. Every piece but the last has a multiple of this
/// number.
const PART_POINTS: u64 = (32 << 10) / POINT_BYTES;

/// The number of pieces that have memory at once: one is filled, one is sent, and the third keeps
/// both from waiting.
const SLOTS: usize = 3;

/// The pinned memory that control points are sent from. It is kept for the next upload.
#[derive(Debug, Default)]
pub(crate) struct Outbox {
    slots: Vec<Pinned>,
    /// Whether more than [`FEW_POINTS`] have been sent at once.
    used: bool,
    /// The last command that reads the slots. Earlier commands end before it.
    last: Option<Arc<Handle>>,
}

impl Outbox {
    /// Sends `upload` to `target` through the queue of the kernels, and returns its bytes. It may
    /// return before the points have arrived.
    pub(crate) fn send(
        &mut self,
        opened: &Arc<Opened>,
        target: &mut Buffer,
        upload: &PaddedUpload<'_>,
        clock: &mut Clock,
    ) -> Result<u64, BackendError> {
        let mut bytes = 0;
        for range in upload.ranges() {
            let count = range.end - range.start;
            let pinned = count > if self.used { FEW_POINTS } else { FIRST_POINTS };
            self.used |= count > FEW_POINTS;
            let events = if pinned {
                self.send_pieces(opened, target, upload, range)?
            } else {
                let offset = range.start * POINT_BYTES;
                let sent = target.write(opened, &opened.queue, offset, &upload.copied(range), None)?;
                sent.into_iter().collect()
            };
            if let (Some(first), Some(last)) = (events.first(), events.last()) {
                clock.note_all(Stage::Upload, first, last);
            }
            bytes += count * POINT_BYTES;
        }
        Ok(bytes)
    }

    /// Sends the points of `range` in pieces. Returns the commands in the order in which they run.
    fn send_pieces(
        &mut self,
        opened: &Arc<Opened>,
        target: &mut Buffer,
        upload: &PaddedUpload<'_>,
        range: Range<u64>,
    ) -> Result<Vec<Arc<Handle>>, BackendError> {
        if let Some(last) = self.last.take() {
            opened.wait(&last)?;
        }
        let pieces = Piece::cut(&range);
        let largest = pieces.iter().map(|piece| piece.range.end - piece.range.start).max().unwrap_or(0);
        let bytes = (largest * POINT_BYTES) as usize;
        self.slots.retain(|slot| slot.bytes() >= bytes);
        while self.slots.len() < pieces.len().min(SLOTS) {
            self.slots.push(Pinned::new(opened, "sending control points", CL_MAP_WRITE, bytes)?);
        }
        let flight = Flight {
            opened,
            upload,
            slots: &self.slots,
            pieces,
            next: AtomicU64::new(range.start),
            end: range.end,
            sent: Mutex::new((target, Vec::new())),
            failed: OnceLock::new(),
        };
        let helpers =
            ((range.end - range.start).div_ceil(PART_POINTS) as usize).min(rayon::current_num_threads());
        rayon::in_place_scope(|scope| {
            (1..helpers).for_each(|_| scope.spawn(|_| flight.run()));
            flight.run();
        });
        let (_, events) = flight.sent.into_inner().unwrap_or_else(PoisonError::into_inner);
        self.last = events.last().cloned();
        flight.failed.into_inner().map_or(Ok(events), Err)
    }
}

impl Drop for Outbox {
    fn drop(&mut self) {
        if let Some(last) = self.last.take() {
            // The memory must not be freed before the command has ended. If the wait fails, the
            // device is lost.
            let _ = opencl3::event::wait_for_events(&[last.raw()]);
        }
    }
}

/// A piece of an upload, on its way through one slot.
#[derive(Debug)]
struct Piece {
    range: Range<u64>,
    /// Whether the piece that was in its slot before has been sent.
    free: AtomicBool,
    /// The number of the piece's parts that are still to be padded.
    left: AtomicUsize,
    /// The command that sends the piece.
    sent: OnceLock<Arc<Handle>>,
}

impl Piece {
    fn cut(range: &Range<u64>) -> Vec<Self> {
        let (mut pieces, mut first, mut most) = (Vec::new(), range.start, FIRST_PIECE_POINTS);
        while first < range.end {
            let count = most.min(range.end - first);
            pieces.push(Self {
                range: first..first + count,
                free: AtomicBool::new(pieces.len() < SLOTS),
                left: AtomicUsize::new(count.div_ceil(PART_POINTS) as usize),
                sent: OnceLock::new(),
            });
            first += count;
            most = PIECE_POINTS.min(2 * most);
        }
        pieces
    }
}

/// An upload in progress. Cores take parts in order, and the core that finishes a piece sends it.
/// There is no barrier between pieces, at which cores would go to sleep.
struct Flight<'a> {
    opened: &'a Opened,
    upload: &'a PaddedUpload<'a>,
    slots: &'a [Pinned],
    pieces: Vec<Piece>,
    /// The first point that no core has taken.
    next: AtomicU64,
    end: u64,
    /// The target and the commands so far. One thread at a time calls the driver.
    sent: Mutex<(&'a mut Buffer, Vec<Arc<Handle>>)>,
    /// The error that ended the upload early.
    failed: OnceLock<BackendError>,
}

impl Flight<'_> {
    /// Pads and sends part after part, until none is left or a core has failed.
    fn run(&self) {
        loop {
            let first = self.next.fetch_add(PART_POINTS, Ordering::Relaxed);
            if first >= self.end || self.failed.get().is_some() {
                return;
            }
            if let Err(error) = self.take(first) {
                // The first of several errors is reported.
                let _ = self.failed.set(error);
            }
        }
    }

    /// Pads the part from point number `first` on, and sends its piece if this was the piece's last
    /// part.
    fn take(&self, first: u64) -> Result<(), BackendError> {
        let number = self.pieces.partition_point(|piece| piece.range.start <= first) - 1;
        let piece = &self.pieces[number];
        let slot = self.slots[number % self.slots.len()].aligned::<ControlPoint>()?;
        if !self.wait_for_slot(number, first == piece.range.start)? {
            return Ok(());
        }
        let part = first..piece.range.end.min(first + PART_POINTS);
        // SAFETY: a slot has room for any piece, is mapped for as long as it exists, and may hold
        // any bits. Its earlier contents have been sent, and no other core has this part.
        let padded: &mut [ControlPoint] = unsafe {
            let start = slot.add((first - piece.range.start) as usize);
            std::slice::from_raw_parts_mut(start, (part.end - part.start) as usize)
        };
        // The last pieces are written past the caches. Cores may go to sleep after these pieces.
        // The device then took up to four times as long to read data that still lay in the caches
        // of sleeping cores. If all pieces were written past the caches, they would slow down the
        // device's own reads of memory.
        pad(self.upload, part, padded, number + self.slots.len() >= self.pieces.len());
        if piece.left.fetch_sub(1, Ordering::AcqRel) == 1 {
            let count = (piece.range.end - piece.range.start) as usize;
            // SAFETY: the slot has room for the piece and is mapped. All cores have finished their
            // parts of the piece.
            self.send(piece, unsafe { std::slice::from_raw_parts(slot, count) })?;
        }
        Ok(())
    }

    /// Waits until the slot of piece `number` may be written. The core with the piece's first part
    /// waits for the device. Returns false if another core has failed.
    fn wait_for_slot(&self, number: usize, first_part: bool) -> Result<bool, BackendError> {
        let piece = &self.pieces[number];
        if let (true, Some(before)) = (first_part, number.checked_sub(self.slots.len())) {
            // The earlier piece's parts were taken earlier, so other cores are working on them.
            let Some(sent) = self.wait_until(|| self.pieces[before].sent.get()) else { return Ok(false) };
            self.opened.wait(sent)?;
            piece.free.store(true, Ordering::Release);
        }
        Ok(self.wait_until(|| piece.free.load(Ordering::Acquire).then_some(())).is_some())
    }

    /// Calls `ask` until it returns an answer. None if another core has failed.
    fn wait_until<T>(&self, ask: impl Fn() -> Option<T>) -> Option<T> {
        loop {
            match ask() {
                Some(answer) => return Some(answer),
                None if self.failed.get().is_some() => return None,
                // The answer takes microseconds, but the core that it depends on may be shared with
                // other threads.
                None => thread::yield_now(),
            }
        }
    }

    fn send(&self, piece: &Piece, padded: &[ControlPoint]) -> Result<(), BackendError> {
        let mut sent = self.sent.lock().unwrap_or_else(PoisonError::into_inner);
        let (target, events) = &mut *sent;
        let (queue, offset) = (&self.opened.queue, piece.range.start * POINT_BYTES);
        // SAFETY: the slot is not written again before this command has ended.
        let event = unsafe { target.enqueue_write(queue, CL_NON_BLOCKING, offset, padded, None) };
        let event = Arc::new(event.map_err(self.opened.failed("clEnqueueWriteBuffer"))?);
        events.push(event.clone());
        flush(queue.raw()).map_err(self.opened.failed("clFlush"))?;
        // Only this core sets the event.
        let _ = piece.sent.set(event);
        Ok(())
    }
}

/// Writes the padded points of `part`. With `past_caches` they are written past the caches, if the
/// processor can do so.
fn pad(upload: &PaddedUpload<'_>, part: Range<u64>, padded: &mut [ControlPoint], past_caches: bool) {
    let mut rest = padded;
    upload.runs(part, |run| {
        let (now, later) = std::mem::take(&mut rest).split_at_mut(run.len());
        if past_caches {
            stream(run, now);
        } else {
            now.copy_from_slice(run);
        }
        rest = later;
    });
    #[cfg(target_arch = "x86_64")]
    if past_caches {
        // SAFETY: every x86-64 processor has this instruction. Other threads see stores past the
        // caches only after it.
        unsafe { std::arch::x86_64::_mm_sfence() };
    }
}

fn stream(run: &[ControlPoint], out: &mut [ControlPoint]) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{__m128, _mm_loadu_ps, _mm_stream_ps};
        if out.as_ptr().cast::<__m128>().is_aligned() {
            for (from, to) in run.iter().zip(out) {
                // SAFETY: every x86-64 processor has these instructions. A point is four f32, and
                // the first point is aligned.
                unsafe {
                    _mm_stream_ps(
                        std::ptr::from_mut(to).cast(),
                        _mm_loadu_ps(std::ptr::from_ref(from).cast()),
                    );
                }
            }
            return;
        }
    }
    out.copy_from_slice(run);
}
