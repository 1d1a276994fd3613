//! What comes of knitting programs.

mod known;
mod laws;
mod limits;
mod naive;
mod program;
