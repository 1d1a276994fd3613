//! Finds the triangle of a mesh that a ray hits first, without making the mesh.
//!
//! Each yarn has a tree of boxes round its blocks, and the cloth has a tree of boxes round its
//! yarns. The search of a ray goes down both. Rings and triangles are made only in the blocks whose
//! boxes the ray meets. The serial backend's functions make them, so they equal those of the mesh
//! to the bit.

mod beam;
mod picker;
mod search;
mod tree;

pub use picker::{PickError, Picker};
pub use search::Hit;
