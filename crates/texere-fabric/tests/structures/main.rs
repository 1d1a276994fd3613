//! Woven cloth, weft knits and warp knits: their yarns, their measures and their faults.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test may panic")]

#[path = "../cloths/mod.rs"]
mod cloths;
mod diagnosis;
mod draft;
mod finish;
mod herringbone;
mod layers;
mod levels;
mod loom;
mod measures;
mod notation;
#[path = "../oracle/mod.rs"]
mod oracle;
mod pieces;
mod pitches;
mod relief;
mod samples;
mod setts;
mod shape;
mod tile;
mod warp;
mod weft;
mod woven;
