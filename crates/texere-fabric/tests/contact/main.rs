//! Yarns against one another, and the mesh as it is drawn.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test may panic")]

mod clearance;
#[path = "../cloths/mod.rs"]
mod cloths;
mod contacts;
mod crowds;
mod downhill;
mod drawn;
mod flat;
mod length;
#[path = "../oracle/mod.rs"]
mod oracle;
mod places;
