//! Whether two intervals of round yarns come nearer to one another anywhere than the nearest
//! approach found so far.
//!
//! Both intervals are halved until bounds on their pieces decide.

use glam::{DVec2, DVec4, Vec4Swizzles};

use super::interval::{Cubic, closest, off_chord};

/// The most halvings of an interval. A piece that is left after the last halving is compared at one
/// place only. With half the value, and with twice, no test is red.
const HALVINGS: u32 = 12;

/// A piece of an interval: centreline and radius as one Bézier polygon in four dimensions.
#[derive(Debug, Clone, Copy)]
struct Piece {
    corners: [DVec4; 4],
    /// The parameter of the interval at which the piece begins.
    start: f64,
    length: f64,
    halvings: u32,
}

impl Piece {
    fn whole(cubic: &Cubic) -> Self {
        let (places, radii) = (cubic.hull(), cubic.half_bounds()[0]);
        let corners = std::array::from_fn(|corner| places[corner].extend(radii[corner]));
        Self { corners, start: 0.0, length: 1.0, halvings: 0 }
    }

    /// Both halves of the piece, by de Casteljau's algorithm.
    fn halves(&self) -> [Self; 2] {
        let middle = |a: DVec4, b: DVec4| (a + b) * 0.5;
        let [a, b, c, d] = self.corners;
        let (ab, bc, cd) = (middle(a, b), middle(b, c), middle(c, d));
        let (abc, bcd) = (middle(ab, bc), middle(bc, cd));
        let centre = middle(abc, bcd);
        let (length, halvings) = (self.length / 2.0, self.halvings + 1);
        [
            Self { corners: [a, ab, abc, centre], start: self.start, length, halvings },
            Self { corners: [centre, bcd, cd, d], start: self.start + length, length, halvings },
        ]
    }

    /// Upper bound of the distance between the piece and the chord between its ends, mm.
    fn bend(&self) -> f64 {
        off_chord(self.corners.map(DVec4::xyz))
    }

    /// Lower bound of the distance to another piece, mm: how far the polygons lie apart along the
    /// direction from place `s` of this piece's chord to place `t` of the other's.
    fn levels(&self, other: &Self, s: f64, t: f64) -> f64 {
        let at = |piece: &Self, t: f64| piece.corners[0].xyz().lerp(piece.corners[3].xyz(), t);
        let towards = (at(other, t) - at(self, s)).normalize_or_zero();
        let own = self
            .corners
            .map(|corner| corner.xyz().dot(towards))
            .into_iter()
            .fold(f64::NEG_INFINITY, f64::max);
        let others =
            other.corners.map(|corner| corner.xyz().dot(towards)).into_iter().fold(f64::INFINITY, f64::min);
        others - own
    }

    /// Lower and upper bound of the piece's radius, before the radius is held at its floor.
    fn radii(&self) -> [f64; 2] {
        let [a, b, c, d] = self.corners.map(|corner| corner.w);
        [a.min(b).min(c).min(d), a.max(b).max(c).max(d)]
    }
}

/// A place where the distance of two round yarns over the sum of their radii is less than `below`,
/// if there is one.
///
/// Two pieces are at least as far apart as their chords, minus each piece's distance from its
/// chord. Pieces that may come nearer than `below` are halved. A valley is a stretch along which
/// the distance hardly changes. If it holds two approaches, this search finds the nearer one, while
/// the chords of the main search have only one approach there.
pub(super) fn nearer(one: &Cubic, other: &Cubic, below: f64) -> Option<DVec2> {
    let [floor, other_floor] = [one, other].map(|cubic| cubic.floors()[0]);
    if below <= 0.0 {
        return None;
    }
    let mut left = vec![(Piece::whole(one), Piece::whole(other))];
    while let Some((a, b)) = left.pop() {
        let (bend_a, bend_b) = (a.bend(), b.bend());
        let ([thin_a, thick_a], [thin_b, thick_b]) = (a.radii(), b.radii());
        let chord = |piece: &Piece| [piece.corners[0].xyz(), piece.corners[3].xyz()];
        let (chords, s, t) = closest(chord(&a), chord(&b));
        let apart = chords.sqrt();
        let least = below * (thick_a.max(floor) + thick_b.max(other_floor));
        if apart - bend_a - bend_b >= least || a.levels(&b, s, t) >= least {
            continue;
        }
        let place = DVec2::new(a.start + s * a.length, b.start + t * b.length);
        let (there, beside) = (one.at(place.x), other.at(place.y));
        if there.position.distance(beside.position) < below * (there.radius()[0] + beside.radius()[0]) {
            return Some(place);
        }
        // The piece with the wider bounds is halved.
        let (vague_a, vague_b) = (bend_a + below * (thick_a - thin_a), bend_b + below * (thick_b - thin_b));
        match (a.halvings < HALVINGS, b.halvings < HALVINGS) {
            (true, more) if vague_a >= vague_b || !more => left.extend(a.halves().map(|half| (half, b))),
            (_, true) => left.extend(b.halves().map(|half| (a, half))),
            _ => {}
        }
    }
    None
}
