//! The knitting machine, from programs to stitches.

#![allow(clippy::expect_used, clippy::panic, reason = "a test ends at what it did not expect")]

mod known;
mod laws;
mod limits;
mod naive;
mod parked;
mod program;
