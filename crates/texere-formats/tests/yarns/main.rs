//! Files of yarns: what is read is what was written, to the bit, and what has changed on the way is
//! refused.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test may panic")]

mod clothes;
mod hostile;
mod random;
mod round_trip;

use peak_alloc::PeakAlloc;

#[global_allocator]
static HEAP: PeakAlloc = PeakAlloc;
