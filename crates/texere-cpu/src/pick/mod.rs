//! Which triangle of a mesh a ray hits first, without the mesh.
//!
//! Boxes stand round the blocks of each yarn, in a tree along the yarn, and a tree of the yarns'
//! boxes above them. Rings and triangles are made only where the ray comes by, by the functions of
//! the serial backend: they are those of the mesh, to the bit.

mod beam;
mod picker;
mod search;
mod tree;

pub use picker::{PickError, Picker};
pub use search::Hit;
