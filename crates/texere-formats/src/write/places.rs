//! The places in a file of vertices that come chunk by chunk.

use texere_core::backend::{Chunk, Plan};

/// Places of vertices in a file. The file has first all rings of the fabric, each once, then all
/// caps.
///
/// A chunk that ends inside a yarn repeats the next chunk's first ring. The file has that ring
/// once, and the triangles of both chunks refer to it. Every yarn is then one piece, and the file
/// does not depend on where chunks are cut.
#[derive(Debug)]
pub(super) struct Places {
    sides: u64,
    /// Number of rings in the whole file.
    all_rings: u64,
    /// Number of rings in the chunks before the current one.
    rings: u64,
    /// Number of caps in the chunks before the current one.
    caps: u64,
}

impl Places {
    /// Places of the mesh of `plan`, before its first chunk.
    pub(super) fn new(plan: &Plan) -> Self {
        let sides = u64::from(plan.settings().sides);
        Self { sides, all_rings: plan.counts().rings, rings: 0, caps: 0 }
    }

    /// The number in the file of vertex number `vertex` of `chunk`, the current chunk.
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
