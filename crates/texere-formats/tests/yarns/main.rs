//! Files of saved yarns: yarns are read as they were written, to the bit, and damaged files are
//! refused.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test may panic")]

mod clothes;
mod hostile;
mod random;
mod round_trip;

use peak_alloc::PeakAlloc;

#[global_allocator]
static HEAP: PeakAlloc = PeakAlloc;
