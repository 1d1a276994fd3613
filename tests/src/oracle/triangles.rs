//! Triangles from their definition, and the check that a cap is closed.

use std::collections::BTreeMap;

use texere_core::End;

use super::OutlinePoint;

/// The two triangles between side `side` of ring `ring` and the next ring, as vertex numbers of a
/// tube whose rings have `sides` vertices each and follow one another from 0. Seen from outside,
/// both triangles are counter-clockwise. Their common edge goes from vertex `side` + 1 of the ring
/// to vertex `side` of the next ring.
#[must_use]
pub fn quad_indices(ring: u64, side: u64, sides: u64) -> [u64; 6] {
    let vertex = |ring: u64, side: u64| ring * sides + side % sides;
    let (here, beside) = (vertex(ring, side), vertex(ring, side + 1));
    let (ahead, across) = (vertex(ring + 1, side), vertex(ring + 1, side + 1));
    [here, beside, ahead, beside, across, ahead]
}

/// A fault of a cap.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Flaw {
    /// The number of the cap's triangles is not two less than that of the corners.
    Count,
    /// The cap names a corner that the outline does not have.
    Corner,
    /// A triangle faces inward, or has no area.
    Flipped,
    /// The cap does not close the outline: an edge is missing, occurs twice, or runs the wrong way.
    Open,
}

/// The fault of `triangles` as a cap of `outline` at `end`, or `None`.
///
/// Corners run counter-clockwise about the tangent. A finish cap faces along the tangent and has
/// them in order; a start cap has them in reverse. Triangles cover the outline exactly once, if
/// there are two fewer than corners, each faces outward, and all edges cancel except those of the
/// outline.
#[must_use]
pub fn cap_flaw(outline: &[OutlinePoint], end: End, triangles: &[[u32; 3]]) -> Option<Flaw> {
    let count = outline.len();
    if triangles.len() + 2 != count {
        return Some(Flaw::Count);
    }
    let mut edges = BTreeMap::new();
    for triangle in triangles {
        let [a, b, c] = match end {
            End::Start => [triangle[0], triangle[2], triangle[1]],
            End::Finish => *triangle,
        };
        if [a, b, c].iter().any(|&corner| corner as usize >= count) {
            return Some(Flaw::Corner);
        }
        let [p, q, r] = [a, b, c].map(|corner| &outline[corner as usize]);
        if (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x) <= 0.0 {
            return Some(Flaw::Flipped);
        }
        for (from, to) in [(a, b), (b, c), (c, a)] {
            *edges.entry((from, to)).or_insert(0) += 1;
            *edges.entry((to, from)).or_insert(0) -= 1;
        }
    }
    for corner in 0..count as u32 {
        let next = (corner + 1) % count as u32;
        *edges.entry((corner, next)).or_insert(0) -= 1;
        *edges.entry((next, corner)).or_insert(0) += 1;
    }
    edges.values().any(|&uses| uses != 0).then_some(Flaw::Open)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::oracle::outline;
    use texere_core::Section;

    #[test]
    fn a_square_is_closed_by_either_diagonal_and_nothing_else() {
        let square = outline(&Section::Circle, 4);
        let cap = |end, triangles: &[[u32; 3]]| cap_flaw(&square, end, triangles);
        assert_eq!(cap(End::Finish, &[[0, 1, 2], [0, 2, 3]]), None);
        assert_eq!(cap(End::Finish, &[[0, 1, 3], [1, 2, 3]]), None);
        assert_eq!(cap(End::Start, &[[0, 2, 1], [0, 3, 2]]), None);
        assert_eq!(cap(End::Start, &[[0, 1, 2], [0, 2, 3]]), Some(Flaw::Flipped));
        assert_eq!(cap(End::Finish, &[[0, 1, 2], [0, 1, 3]]), Some(Flaw::Open));
        assert_eq!(cap(End::Finish, &[[0, 1, 2]]), Some(Flaw::Count));
        assert_eq!(cap(End::Finish, &[[0, 1, 2], [0, 2, 4]]), Some(Flaw::Corner));
    }
}
