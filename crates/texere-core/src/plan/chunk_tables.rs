//! The tables of a chunk: blocks, parts and caps. They are filled when the plan is cut, filled
//! again after an edit, or copied in part for a patch.

use std::ops::Range;

use super::chunk::{Cap, Chunk, Part};
use super::identity::TablesId;
use super::{BLOCK_RINGS, Block, Plan};
use crate::{End, Topology};

impl Plan {
    /// `chunk` with the block table, parts and caps that it has in this plan. `chunk` must be a
    /// chunk of this plan or of a plan that this one was [edited](Plan::edited) from.
    #[must_use]
    pub(crate) fn recut(&self, chunk: &Chunk) -> Chunk {
        let mut cut = Chunk {
            window: chunk.window(),
            tables: TablesId::next(chunk.block_range()),
            runs: chunk.runs.clone(),
            blocks: Vec::with_capacity(chunk.blocks.len()),
            parts: Vec::with_capacity(chunk.parts.len()),
            caps: Vec::with_capacity(chunk.caps.len()),
            repeats_ring: false,
            rings: 0,
            vertices: 0,
            indices: 0,
            ..*chunk
        };
        self.fill(&mut cut);
        cut
    }

    /// A patch: a chunk of some rows of the block table of `chunk`, with the caps of their yarns.
    /// All results of the patch have the places that they have in `chunk`, so memory for `chunk` is
    /// enough. `chunk` must be a chunk of this plan. `rows` are in order and do not overlap.
    ///
    /// **Panics** for no rows, and for rows past the last.
    #[must_use]
    pub(crate) fn patch(&self, chunk: &Chunk, rows: &[Range<usize>]) -> Chunk {
        let blocks: Vec<_> = rows.iter().flat_map(|rows| &chunk.blocks[rows.clone()]).copied().collect();
        let number =
            |row: &Block| self.block_offsets()[row.yarn as usize] + u64::from(row.first_ring / BLOCK_RINGS);
        let part = |rows: &[Block]| Part {
            yarn: rows[0].yarn,
            first_ring: rows[0].first_ring,
            rings: rows.iter().map(|row| row.rings).sum(),
            first_vertex: rows[0].first_vertex,
            first_index: rows[0].first_index,
        };
        let has = |cap: &&Cap| blocks.binary_search_by_key(&cap.yarn, |row| row.yarn).is_ok();
        Chunk {
            tables: TablesId::next(number(&blocks[0])..number(&blocks[blocks.len() - 1]) + 1),
            window: chunk.window(),
            runs: chunk.runs.clone(),
            parts: blocks.chunk_by(Block::is_before).map(part).collect(),
            caps: chunk.caps.iter().filter(has).copied().collect(),
            blocks,
            ..*chunk
        }
    }
}

impl Plan {
    /// The rings of block `block` of `yarn`, room included: the first, their number, and whether
    /// the yarn may go on after the block.
    pub(super) fn block_rings(&self, yarn: usize, block: u64) -> (u32, u32, bool) {
        let offsets = self.ring_offsets();
        let first = (block - self.block_offsets()[yarn]) as u32 * BLOCK_RINGS;
        let left = (offsets[yarn + 1] - offsets[yarn]) as u32 - first;
        (first, left.min(BLOCK_RINGS), left > BLOCK_RINGS)
    }

    /// Fills the block table, the parts and the caps of `chunk`. Unused room has a place in the
    /// chunk, but only rings that exist are in a row.
    pub(super) fn fill(&self, chunk: &mut Chunk) {
        let (settings, roomy) = (self.settings(), self.is_roomy());
        let (sides, indexed) = (settings.sides, settings.topology == Topology::Indexed);
        let (mut caps, mut finish) = (0, 0);
        let runs = std::mem::take(&mut chunk.runs);
        for run in &runs {
            let mut yarn = self.yarn_of_block(run.start);
            for number in run.clone() {
                let (first, room, may_go_on) = self.block_rings(yarn, number);
                let left = self.rings(yarn).saturating_sub(first);
                let (rings, goes_on) = (left.min(BLOCK_RINGS), left > BLOCK_RINGS);
                let starts_part = number == run.start || first == 0;
                let ends_run = number + 1 == run.end;
                let here = [chunk.rings, chunk.indices];
                if starts_part && rings > 0 {
                    chunk.parts.push(Part {
                        yarn: yarn as u32,
                        first_ring: first,
                        rings: 0,
                        first_vertex: here[0] * sides,
                        first_index: here[1],
                    });
                }
                if settings.caps && !self.yarn(yarn).closed {
                    if first == 0 {
                        chunk.caps.push(Cap::at(caps, yarn, End::Start, here[0]));
                        caps += 1;
                    }
                    // A yarn with room may end anywhere in the chunk.
                    let has_finish = if roomy { starts_part } else { !may_go_on };
                    if has_finish {
                        finish = caps;
                        caps += 1;
                    }
                    if rings > 0 && !goes_on {
                        chunk.caps.push(Cap::at(finish, yarn, End::Finish, here[0] + rings - 1));
                    }
                }
                if rings > 0 {
                    self.push_block(chunk, yarn, first, rings, if goes_on { rings } else { rings - 1 });
                }
                let repeats = u32::from(may_go_on && ends_run);
                [chunk.rings, chunk.indices] = here;
                chunk.rings += room;
                if indexed {
                    chunk.indices += (if may_go_on { room } else { room - 1 }) * sides * 6;
                }
                // The repeated ring is the first of the next chunk, or in a region a ring of no
                // other chunk.
                chunk.repeats_ring = goes_on && ends_run && self.makes(number + 1);
                if goes_on && ends_run {
                    self.push_block(chunk, yarn, first + rings, 1, 0);
                }
                chunk.rings += repeats;
                if !may_go_on {
                    yarn += 1;
                }
            }
        }
        chunk.runs = runs;
        let cap_indices = if indexed { (sides - 2) * 3 } else { 0 };
        for cap in &mut chunk.caps {
            cap.first_vertex = (chunk.rings + cap.first_vertex) * sides;
            cap.first_index = chunk.indices + cap.first_index * cap_indices;
        }
        chunk.vertices = (chunk.rings + caps) * sides;
        chunk.indices += caps * cap_indices;
    }

    /// Adds a row of the block table for the next rings.
    fn push_block(&self, chunk: &mut Chunk, yarn: usize, first_ring: u32, rings: u32, quads: u32) {
        let settings = self.settings();
        // Kernels work out the interval and the ring within it in the same way for all rings. The
        // row therefore has the quotient for its first ring, even if that ring is the yarn's last.
        let interval = u64::from(first_ring) / (u64::from(settings.subdivisions) + 1);
        let point = self.padded_offsets()[yarn] + interval;
        chunk.blocks.push(Block {
            yarn: yarn as u32,
            first_ring,
            rings,
            quads,
            first_point: (point - chunk.window.start) as u32,
            chunk_ring: chunk.rings,
            first_vertex: chunk.rings * settings.sides,
            first_index: chunk.indices,
        });
        if let Some(part) = chunk.parts.last_mut() {
            part.rings += rings;
        }
    }
}
