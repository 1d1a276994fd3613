//! The places in a file of vertices that come chunk by chunk.

use texere_core::backend::{Chunk, Plan};
use texere_core::definitions::index_pattern;

/// The vertices that a file has for each ring.
#[derive(Debug, Clone, Copy)]
pub(super) struct RingForm {
    sides: u32,
    /// Number of the vertices: one for each side, and with a seam one more.
    pub(super) corners: u32,
}

impl RingForm {
    /// The rings of `plan`. With a `seam` the first vertex of a ring comes again at the ring's end,
    /// where a texture that goes round the yarn ends.
    pub(super) fn new(plan: &Plan, seam: bool) -> Self {
        let sides = plan.settings().sides;
        Self { sides, corners: sides + u32::from(seam) }
    }

    /// The number of vertices of all rings of `plan`.
    pub(super) fn tubes(self, plan: &Plan) -> u64 {
        plan.counts().rings * u64::from(self.corners)
    }

    /// The number of vertices of all rings and caps of `plan`.
    pub(super) fn vertices(self, plan: &Plan) -> u64 {
        let seams = plan.counts().rings * u64::from(self.corners - self.sides);
        plan.counts().vertices + seams
    }

    /// The corners of the triangles between a ring and the next, as numbers of the two rings'
    /// vertices.
    pub(super) fn quads(self) -> Vec<u32> {
        let mut quads = index_pattern(self.sides);
        if self.corners > self.sides {
            // The last side ends at the seam instead of the first vertex.
            for (side, quad) in (0..).zip(quads.chunks_exact_mut(6)) {
                let next = self.corners + side;
                quad.copy_from_slice(&[side, side + 1, next, side + 1, next + 1, next]);
            }
        }
        quads
    }
}

/// Places of vertices in a file. The file has first all rings of the fabric, each once, then all
/// caps.
///
/// A chunk that ends inside a yarn repeats the next chunk's first ring. The file has that ring
/// once, and the triangles of both chunks refer to it. Every yarn is then one piece, and the file
/// does not depend on where chunks are cut.
#[derive(Debug)]
pub(super) struct Places {
    ring: RingForm,
    /// Number of rings in the whole file.
    all_rings: u64,
    /// Number of rings in the chunks before the current one.
    rings: u64,
    /// Number of caps in the chunks before the current one.
    caps: u64,
}

impl Places {
    /// Places of the mesh of `plan`, before its first chunk.
    pub(super) fn new(plan: &Plan, ring: RingForm) -> Self {
        Self { ring, all_rings: plan.counts().rings, rings: 0, caps: 0 }
    }

    /// The number in the file of vertex number `vertex` of `chunk`, the current chunk.
    pub(super) fn of(&self, chunk: &Chunk, vertex: u32) -> u64 {
        let [sides, corners] = [self.ring.sides, self.ring.corners].map(u64::from);
        let (tubes, vertex) = (u64::from(chunk.rings()) * sides, u64::from(vertex));
        match vertex.checked_sub(tubes) {
            None => (self.rings + vertex / sides) * corners + vertex % sides,
            Some(of_caps) => self.all_rings * corners + self.caps * sides + of_caps,
        }
    }

    /// Goes on to the chunk after `chunk`.
    pub(super) fn pass(&mut self, chunk: &Chunk) {
        self.rings += u64::from(chunk.rings()) - u64::from(chunk.repeats_ring());
        self.caps += chunk.caps().len() as u64;
    }
}
