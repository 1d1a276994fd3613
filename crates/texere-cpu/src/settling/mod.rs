//! Settling on a CPU.

mod cells;
mod serial;

pub use serial::SerialSettler;
