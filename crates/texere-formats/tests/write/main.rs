//! Files that texere writes, read back: meshes by other crates or by readers of these tests,
//! designs by texere itself. Also the files that are left when writing fails.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may panic")]

mod attributes;
mod compressed;
mod designs;
mod draft;
mod fabric;
mod files;
mod glb;
mod instanced;
mod knit_draft;
mod knits;
mod obj;
mod outputs;
mod packed;
mod pieces;
mod ply;
mod programs;
mod random_designs;
mod random_knits;
mod stl;
mod unpack;
mod usd_mesh;
mod writers;
