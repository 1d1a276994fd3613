//! Which triangle of a mesh a ray hits first, without the mesh.
//!
//! Each yarn has a tree of boxes round its blocks, and the cloth has a tree of boxes round its
//! yarns. A ray goes down both. Rings and triangles are made only in the blocks whose boxes it
//! meets. The serial backend's functions make them, so they are those of the mesh, to the bit.

mod beam;
mod picker;
mod search;
mod tree;

pub use picker::{PickError, Picker};
pub use search::Hit;
