//! Files that are read: what they say, and how those that can't be read are refused.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test may panic")]

mod curves;
mod design_file;
mod drafts;
mod from_memory;
mod images;
mod knit;
mod palettes;
mod plurals;
mod point_paper;
mod polylines;
mod refusals;
mod rest;
mod texgen;
mod usd;
mod warp_knit;
mod wif;
