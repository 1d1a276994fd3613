//! Where a file has the vertices of a mesh that comes chunk by chunk.

use texere_core::backend::{Chunk, Plan};

/// Where a file has the vertices of the chunks that come: first all rings of the fabric, each once,
/// then all caps.
///
/// A chunk that ends inside a yarn repeats the next chunk's first ring. In the file that ring
/// stands once, and the triangles of both chunks refer to it. So every yarn is one piece, and the
/// file is the same wherever chunks are cut.
#[derive(Debug)]
pub(super) struct Places {
    sides: u64,
    /// Rings of the whole file.
    all_rings: u64,
    /// Rings and caps of the chunks before the current one.
    rings: u64,
    caps: u64,
}

impl Places {
    /// Places of the mesh of `plan`, before its first chunk.
    pub(super) fn new(plan: &Plan) -> Self {
        let sides = u64::from(plan.settings().sides);
        Self { sides, all_rings: plan.counts().rings, rings: 0, caps: 0 }
    }

    /// The number in the file of vertex number `vertex` of `chunk`, which is the current one.
    pub(super) fn of(&self, chunk: &Chunk, vertex: u32) -> u64 {
        let tubes = u64::from(chunk.rings()) * self.sides;
        match u64::from(vertex).checked_sub(tubes) {
            None => self.rings * self.sides + u64::from(vertex),
            Some(of_caps) => (self.all_rings + self.caps) * self.sides + of_caps,
        }
    }

    /// Goes on to the chunk after `chunk`.
    pub(super) fn pass(&mut self, chunk: &Chunk) {
        self.rings += u64::from(chunk.rings()) - u64::from(chunk.repeats_ring());
        self.caps += chunk.caps().len() as u64;
    }
}
