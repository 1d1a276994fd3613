//! What comes of knitting programs.

mod known;
mod program;
