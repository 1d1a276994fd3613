//! Joins the chunks of an output into a whole, which has every ring once, in order, however the
//! chunks were cut.

use std::ops::Range;

use texere_core::backend::{Chunk, Part};
use texere_core::definitions::Ring;
use texere_core::{Cap, End, Topology, Vertex};

use super::{Fault, Report, RingPlace, same_bits};
use crate::drive::{ChunkOutput, DeviceOutput};
use crate::oracle::{Oracle, cap_flaw, quad_indices};
use crate::poison::{POISONED_INDEX, POISONED_RING, POISONED_VERTEX};

/// A whole output, joined from its chunks.
#[derive(Debug, Clone)]
pub struct Assembled {
    /// Rings of all yarns, in order.
    pub rings: Vec<Ring>,
    /// The vertices of all rings, in order.
    pub vertices: Vec<Vertex>,
    /// The start and the finish cap of each open yarn, in order. Empty if the settings have no
    /// caps.
    pub caps: Vec<AssembledCap>,
    /// The first ring of each yarn; at the end, the number of all rings.
    pub offsets: Vec<usize>,
}

/// The cap of an end.
#[derive(Debug, Clone, PartialEq)]
pub struct AssembledCap {
    /// The number of the yarn.
    pub yarn: usize,
    /// The end of the yarn.
    pub end: End,
    /// The vertices, one for each point of the section.
    pub vertices: Vec<Vertex>,
    /// Triangles as points of the section. Empty if the output has no indices, or they were never
    /// written.
    pub triangles: Vec<[u32; 3]>,
}

/// Joins the chunks of `output`. Reports pieces that are missing or repeated, and wrong triangles.
///
/// Rings that two chunks share have to be equal to the bit.
#[must_use]
pub fn assemble(oracle: &Oracle, output: &DeviceOutput, report: &mut Report) -> Assembled {
    let mut whole = Assembly::new(oracle);
    for (chunk, mesh) in output.chunks.iter().zip(&output.meshes) {
        for part in chunk.parts() {
            whole.take_part(part, mesh, report);
        }
        for cap in chunk.caps() {
            whole.take_cap(chunk, cap, mesh, report);
        }
    }
    whole.finish(report)
}

struct Assembly<'a> {
    oracle: &'a Oracle,
    sides: usize,
    assembled: Assembled,
    /// Number of rings of each yarn so far.
    done: Vec<usize>,
}

impl<'a> Assembly<'a> {
    fn new(oracle: &'a Oracle) -> Self {
        let mut offsets = vec![0];
        for yarn in &oracle.yarns {
            offsets.push(offsets[offsets.len() - 1] + yarn.rings.len());
        }
        let (sides, rings) = (oracle.settings.sides as usize, offsets[offsets.len() - 1]);
        let assembled = Assembled {
            rings: vec![POISONED_RING; rings],
            vertices: vec![POISONED_VERTEX; rings * sides],
            caps: Vec::new(),
            offsets,
        };
        Self { oracle, sides, assembled, done: vec![0; oracle.yarns.len()] }
    }

    fn take_part(&mut self, part: &Part, mesh: &ChunkOutput, report: &mut Report) {
        let (yarn, first, rings) = (part.yarn as usize, part.first_ring as usize, part.rings as usize);
        let place = RingPlace { yarn: yarn as u64, ring: first as u64, point: None };
        let Some(done) = self.done.get(yarn).copied() else {
            return report.note(Fault::Count, place, self.oracle.yarns.len(), "a yarn more");
        };
        // A part starts where the previous one ended: at the ring that the cut repeats.
        let goes_on = report.note_count("rings before", place, done.saturating_sub(1) as u64, first as u64);
        let total = self.oracle.yarns[yarn].rings.len();
        if !goes_on || first + rings > total {
            return report.note(Fault::Count, place, total, first + rings);
        }
        self.done[yarn] = first + rings;
        let from = self.assembled.offsets[yarn] + first;
        let vertex = part.first_vertex as usize;
        let place_of =
            |at: usize, per_ring: usize| RingPlace { ring: (first + at / per_ring) as u64, ..place };
        merge(
            &mut self.assembled.rings[from..from + rings],
            mesh.rings.get(vertex / self.sides..vertex / self.sides + rings),
            usize::from(done > 0),
            |at| place_of(at, 1),
            report,
        );
        merge(
            &mut self.assembled.vertices[from * self.sides..(from + rings) * self.sides],
            mesh.vertices.get(vertex..vertex + rings * self.sides),
            usize::from(done > 0) * self.sides,
            |at| place_of(at, self.sides),
            report,
        );
        if self.oracle.settings.topology == Topology::Indexed {
            self.check_quads(part, mesh, report);
        }
    }

    /// Checks that the indices of a part are those of its quads, in order.
    fn check_quads(&self, part: &Part, mesh: &ChunkOutput, report: &mut Report) {
        let (sides, base) = (self.sides as u64, u64::from(part.first_vertex));
        for gap in 0..u64::from(part.rings) - 1 {
            let place =
                RingPlace { yarn: part.yarn.into(), ring: u64::from(part.first_ring) + gap, point: None };
            for side in 0..sides {
                let at = part.first_index as usize + ((gap * sides + side) * 6) as usize;
                let Some(actual) = mesh.indices.get(at..at + 6) else {
                    return report.note(
                        Fault::Count,
                        place,
                        format_args!("{} indices", at + 6),
                        mesh.indices.len(),
                    );
                };
                let expected = quad_indices(gap, side, sides).map(|index| base + index);
                if !actual.iter().zip(expected).all(|(&actual, expected)| u64::from(actual) == expected) {
                    let unwritten = actual.contains(&POISONED_INDEX);
                    let fault = if unwritten { Fault::Missing } else { Fault::Index };
                    report.note(fault, RingPlace { point: Some(side), ..place }, expected, actual);
                }
            }
        }
    }

    fn take_cap(&mut self, chunk: &Chunk, cap: &Cap, mesh: &ChunkOutput, report: &mut Report) {
        let yarn = cap.yarn as usize;
        let ring = if cap.end == End::Start { 0 } else { self.oracle.yarns[yarn].rings.len() as u64 - 1 };
        let place = RingPlace { yarn: yarn as u64, ring, point: None };
        let tube_vertices = chunk.parts().iter().map(|part| part.rings as usize * self.sides).sum();
        let first = cap.first_vertex as usize;
        let vertices = mesh.vertices.get(first..first + self.sides).filter(|_| first >= tube_vertices);
        let Some(vertices) = vertices else {
            return report.note(
                Fault::Count,
                place,
                format_args!("cap after {tube_vertices} vertices"),
                first,
            );
        };
        let mut triangles = Vec::new();
        if self.oracle.settings.topology == Topology::Indexed {
            let (from, count) = (cap.first_index as usize, (self.sides - 2) * 3);
            let Some(indices) = mesh.indices.get(from..from + count) else {
                return report.note(Fault::Count, place, from + count, mesh.indices.len());
            };
            if indices.contains(&POISONED_INDEX) {
                report.note(Fault::Missing, place, "indices of a cap", indices);
            } else {
                let corner = |index: &u32| index.wrapping_sub(cap.first_vertex);
                triangles = indices.chunks_exact(3).map(|at| [0, 1, 2].map(|k| corner(&at[k]))).collect();
                let outline = &self.oracle.outlines[self.oracle.yarns[yarn].section];
                if let Some(flaw) = cap_flaw(outline, cap.end, &triangles) {
                    report.note(Fault::Index, place, "a closed cap", (flaw, &triangles));
                }
            }
        }
        self.assembled.caps.push(AssembledCap { yarn, end: cap.end, vertices: vertices.to_vec(), triangles });
    }

    fn finish(mut self, report: &mut Report) -> Assembled {
        for (number, (yarn, &done)) in self.oracle.yarns.iter().zip(&self.done).enumerate() {
            let place = RingPlace { yarn: number as u64, ring: done as u64, point: None };
            report.note_count("rings", place, yarn.rings.len() as u64, done as u64);
        }
        // Caps come chunk by chunk. They are compared yarn by yarn, the start cap first.
        self.assembled.caps.sort_by_key(|cap| (cap.yarn, cap.end == End::Finish));
        let capped = |yarn: usize| self.oracle.settings.caps && !self.oracle.yarns[yarn].closed;
        let expected: Vec<_> = (0..self.oracle.yarns.len())
            .filter(|&yarn| capped(yarn))
            .flat_map(|yarn| [(yarn, End::Start), (yarn, End::Finish)])
            .collect();
        let actual: Vec<_> = self.assembled.caps.iter().map(|cap| (cap.yarn, cap.end)).collect();
        if expected != actual {
            report.note(Fault::Count, RingPlace::default(), expected, actual);
        }
        self.assembled
    }
}

impl Assembled {
    /// The rings of `yarn` as a range of all rings.
    #[must_use]
    pub fn rings_of(&self, yarn: usize) -> Range<usize> {
        self.offsets[yarn]..self.offsets[yarn + 1]
    }
}

/// Copies `from` to `to`. The first `shared` values of `from` are in `to` already, and have to be
/// equal.
fn merge<T: bytemuck::Pod + std::fmt::Debug>(
    to: &mut [T],
    from: Option<&[T]>,
    shared: usize,
    place: impl Fn(usize) -> RingPlace,
    report: &mut Report,
) {
    let Some(from) = from else {
        return report.note(
            Fault::Count,
            place(0),
            format_args!("{} more", to.len()),
            "too few in the chunk",
        );
    };
    for (at, (old, new)) in to.iter().zip(from).enumerate().take(shared) {
        if !same_bits(old, new) {
            report.note(Fault::Bits, place(at), old, new);
        }
    }
    to.copy_from_slice(from);
}
