//! Binary STL: one list of facets, each with its normal and its corners.
//!
//! Source: 3D Systems, "Stereolithography Interface Specification", 1989. Programs that print or
//! mesh solids read STL files. The format has no shared vertices. Where two facets meet, their
//! corners have coordinates that are equal to the bit.

use std::io::{Seek, Write};

use glam::Vec3;
use texere_core::backend::{Chunk, Plan};
use texere_core::definitions::index_pattern;

use super::WriteError;
use super::mesh_writer::{MeshWriter, Run};
use super::places::Places;
use super::target::Target;

/// Bytes of the header, which is text that readers pass over.
const HEADER_BYTES: usize = 80;

/// Bytes of a facet: a normal, three corners and two bytes that nothing uses.
const FACET_BYTES: u64 = 50;

/// The most facets of a file, which counts them with a `u32`.
const FACETS_MAX: u64 = u32::MAX as u64;

/// An STL file that is being written.
///
/// Once a ring has come, the facets between it and the ring before it are written. Only two rings
/// are kept. The file has all facets of tubes before those of caps, so it grows in two places.
#[derive(Debug)]
pub(super) struct StlWriter<'a, W: Write + Seek> {
    target: Target<W>,
    plan: &'a Plan,
    /// The corners of the facets between a ring and the next, as numbers of the two rings'
    /// vertices.
    quads: Vec<u32>,
    /// The ring before the one that is coming.
    before: Vec<Vec3>,
    /// The vertices that have come of the current ring or cap.
    ring: Vec<Vec3>,
    /// Whether the next chunk begins with a ring that the chunk before repeats.
    goes_on: bool,
    /// The byte at which the next facet of a tube begins.
    next_tube_facet_at: u64,
    /// The byte at which the next facet of a cap begins.
    next_cap_facet_at: u64,
}

impl<'a, W: Write + Seek> StlWriter<'a, W> {
    pub(super) fn start(mut target: Target<W>, plan: &'a Plan) -> Result<Self, WriteError> {
        let (counts, sides) = (plan.counts(), plan.settings().sides);
        if counts.triangles > FACETS_MAX {
            return Err(WriteError::TooManyFacets { facets: counts.triangles, limit: FACETS_MAX });
        }
        let mut header = [b' '; HEADER_BYTES];
        let text = format!(
            "texere {}; unit mm; x along weft or course, y along warp or wale",
            env!("CARGO_PKG_VERSION")
        );
        for (place, byte) in header.iter_mut().zip(text.bytes()) {
            *place = byte;
        }
        target.write(&header)?;
        target.write_words(&[counts.triangles as u32])?;
        let tubes_at = target.position();
        let caps = counts.vertices / u64::from(sides) - counts.rings;
        let tube_facets = counts.triangles - caps * u64::from(sides - 2);
        Ok(Self {
            target,
            plan,
            quads: index_pattern(sides),
            before: Vec::new(),
            ring: Vec::new(),
            goes_on: false,
            next_tube_facet_at: tubes_at,
            next_cap_facet_at: tubes_at + tube_facets * FACET_BYTES,
        })
    }

    /// Writes the facets of the ring or cap whose vertices have all come. `number` is its number in
    /// the chunk, which counts rings before caps.
    fn complete(&mut self, chunk: &Chunk, number: u32) -> Result<(), WriteError> {
        let sides = self.plan.settings().sides;
        let ring = std::mem::take(&mut self.ring);
        if let Some(cap) = number.checked_sub(chunk.rings()).and_then(|cap| chunk.caps().get(cap as usize)) {
            let section = self.plan.yarn(cap.yarn as usize).section as usize;
            self.target.go_to(self.next_cap_facet_at)?;
            for corners in self.plan.cap_indices(section, cap.end).collect::<Vec<_>>().chunks_exact(3) {
                self.facet([0, 1, 2].map(|corner| ring[corners[corner] as usize]))?;
            }
            self.next_cap_facet_at = self.target.position();
            return Ok(());
        }
        let begins = chunk.parts().binary_search_by_key(&(number * sides), |part| part.first_vertex).is_ok();
        let is_repeated = number == 0 && self.goes_on;
        if !begins || is_repeated {
            let both = [std::mem::take(&mut self.before), ring].concat();
            self.target.go_to(self.next_tube_facet_at)?;
            let quads = std::mem::take(&mut self.quads);
            for corners in quads.chunks_exact(3) {
                self.facet([0, 1, 2].map(|corner| both[corners[corner] as usize]))?;
            }
            self.quads = quads;
            self.next_tube_facet_at = self.target.position();
            self.before = both[sides as usize..].to_vec();
        } else {
            self.before = ring;
        }
        Ok(())
    }

    fn facet(&mut self, corners: [Vec3; 3]) -> Result<(), WriteError> {
        let [one, two, three] = corners;
        // A facet without area gets (0, 0, 0) for its normal.
        let normal = (two - one).cross(three - one).normalize_or_zero();
        let mut bytes = [0; FACET_BYTES as usize];
        let floats = [normal, one, two, three].map(|point| point.to_array());
        for (place, float) in bytes.chunks_exact_mut(4).zip(floats.as_flattened()) {
            place.copy_from_slice(&float.to_le_bytes());
        }
        self.target.write(&bytes)
    }
}

impl<W: Write + Seek> MeshWriter<W> for StlWriter<'_, W> {
    fn vertices(&mut self, run: Run<'_>) -> Result<(), WriteError> {
        let sides = self.plan.settings().sides;
        for (number, vertex) in (run.first..).zip(run.vertices) {
            self.ring.push(Vec3::from(vertex.position));
            if self.ring.len() == sides as usize {
                self.complete(run.chunk, number / sides)?;
            }
        }
        Ok(())
    }

    /// Nothing is left to write: facets are written with the vertices of rings and caps.
    fn triangles(&mut self, chunk: &Chunk, _: &Places) -> Result<(), WriteError> {
        self.goes_on = chunk.repeats_ring();
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<Target<W>, WriteError> {
        Ok(self.target)
    }
}
