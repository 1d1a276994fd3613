//! The backend on the first OpenCL device, beyond what the conformance suite tests of every
//! backend.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test may panic")]

mod layout;
mod own_queue;
mod per_yarn;
mod session;
mod support;
