//! Stage 2 for a block: vertices and indices from tables.

use texere_core::{Basis, SectionPoint, Vertex};

use super::rings::BlockRings;

/// Writes the vertices of all rings of a block, `outline.len()` each, to `out`.
pub(super) fn vertices(rings: &BlockRings, outline: &[SectionPoint], out: &mut [Vertex]) {
    // The usual numbers of sides get loops of known length, which the compiler unrolls.
    match outline.len() {
        4 => vertices_of::<4>(rings, outline, out),
        6 => vertices_of::<6>(rings, outline, out),
        8 => vertices_of::<8>(rings, outline, out),
        12 => vertices_of::<12>(rings, outline, out),
        sides => {
            for (k, ring_out) in out.chunks_exact_mut(sides).enumerate() {
                ring_vertices(rings, k, outline, ring_out);
            }
        }
    }
}

fn vertices_of<const SIDES: usize>(rings: &BlockRings, outline: &[SectionPoint], out: &mut [Vertex]) {
    let Some(outline) = outline.first_chunk::<SIDES>() else { return };
    for (k, ring_out) in out.as_chunks_mut::<SIDES>().0.iter_mut().enumerate() {
        ring_vertices(rings, k, outline, ring_out);
    }
}

#[inline(always)]
fn ring_vertices(rings: &BlockRings, k: usize, outline: &[SectionPoint], out: &mut [Vertex]) {
    let at = |lanes: &[[f32; 64]; 3]| glam::Vec3::new(lanes[0][k], lanes[1][k], lanes[2][k]);
    let (ring, slope) = (rings.ring(k), rings.slope[k]);
    let basis = Basis { side: at(&rings.side), up: at(&rings.up) };
    for (vertex, point) in out.iter_mut().zip(outline) {
        *vertex = ring.vertex(&basis, slope, point);
    }
}

/// Writes the indices of consecutive rings' quads, the first ring's vertices starting at `first_vertex`.
pub(super) fn indices(first_vertex: u32, sides: u32, pattern: &[u32], out: &mut [u32]) {
    let mut base = first_vertex;
    for quads in out.chunks_exact_mut(pattern.len()) {
        for (index, offset) in quads.iter_mut().zip(pattern) {
            *index = base + offset;
        }
        base += sides;
    }
}
