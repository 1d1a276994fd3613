//! Stage 2 for a block: vertices of several rings at a time, a ring in each lane, then a transpose into place.

use texere_core::SectionPoint;

use super::rings::{BlockRings, Lane};
use super::vector::Vector;

/// Floats of a vertex: position and normal.
const VERTEX: usize = 6;

/// Vertices that are worked out before their rows are stored: four times six floats are whole vectors of any width.
const UNIT: usize = 4;

/// Floats that the scratch space needs beyond a block's vertices: a ring's last store may reach that far over its end.
pub(super) const OVERHANG: usize = 8;

/// What the rings in the lanes of a vector bring to their vertices.
struct Lanes<V> {
    centre: [V; 3],
    radius: V,
    side: [V; 3],
    up: [V; 3],
    tangent: [V; 3],
    slope: V,
}

/// Writes the vertices of all rings of a block, `outline.len()` each, to `scratch`, which is longer by [`OVERHANG`].
#[inline(always)]
pub(super) fn vertices<V: Vector>(rings: &BlockRings, outline: &[SectionPoint], scratch: &mut [f32]) {
    let stride = outline.len() * VERTEX;
    let mut first = 0;
    while first < rings.count {
        let load = |lane: &Lane| V::load(&lane[first..]);
        let load3 = |lanes: &[Lane; 3]| [load(&lanes[0]), load(&lanes[1]), load(&lanes[2])];
        let lanes = Lanes {
            centre: load3(&rings.centre),
            radius: load(&rings.radius),
            side: load3(&rings.side),
            up: load3(&rings.up),
            tangent: load3(&rings.tangent),
            slope: load(&rings.slope),
        };
        let out = &mut scratch[first * stride..];
        if rings.slope[first..first + V::LANES].iter().any(|slope| *slope != 0.0) {
            rings_vertices::<V, true>(&lanes, outline, out, stride);
        } else {
            rings_vertices::<V, false>(&lanes, outline, out, stride);
        }
        first += V::LANES;
    }
}

/// All vertices of the rings in `lanes`, the last ones first: a store that reaches over the end of its ring is then
/// followed by the next ring's own.
#[inline(always)]
fn rings_vertices<V: Vector, const SLOPED: bool>(
    lanes: &Lanes<V>,
    outline: &[SectionPoint],
    out: &mut [f32],
    stride: usize,
) {
    let (units, last) = outline.as_chunks::<UNIT>();
    let at = &mut out[units.len() * UNIT * VERTEX..];
    match *last {
        [a] => unit::<V, 1, SLOPED>(lanes, &[a], at, stride),
        [a, b] => unit::<V, 2, SLOPED>(lanes, &[a, b], at, stride),
        [a, b, c] => unit::<V, 3, SLOPED>(lanes, &[a, b, c], at, stride),
        _ => {}
    }
    for (number, points) in units.iter().enumerate().rev() {
        unit::<V, UNIT, SLOPED>(lanes, points, &mut out[number * UNIT * VERTEX..], stride);
    }
}

/// `COUNT` vertices of the rings in `lanes`: rows of x, y, z and so on, a ring in each lane, stored as columns.
#[inline(always)]
fn unit<V: Vector, const COUNT: usize, const SLOPED: bool>(
    lanes: &Lanes<V>,
    points: &[SectionPoint; COUNT],
    out: &mut [f32],
    stride: usize,
) {
    let mut rows = [V::splat(0.0); UNIT * VERTEX];
    for (k, point) in points.iter().enumerate() {
        let (x, y) = (V::splat(point.x), V::splat(point.y));
        let (normal_x, normal_y) = (V::splat(point.normal_x), V::splat(point.normal_y));
        let lean = lanes.slope.mul(V::splat(point.reach()));
        let steep = if SLOPED { V::splat(1.0).add(lean.mul(lean)).inverse_root() } else { lean };
        for axis in 0..3 {
            let outward = lanes.side[axis].mul(x).add(lanes.up[axis].mul(y));
            rows[k * VERTEX + axis] = lanes.centre[axis].add(outward.mul(lanes.radius));
            let across = lanes.side[axis].mul(normal_x).add(lanes.up[axis].mul(normal_y));
            rows[k * VERTEX + 3 + axis] = if SLOPED {
                let leaning = across.sub(lanes.tangent[axis].mul(lean)).mul(steep);
                lanes.slope.where_zero(across, leaning)
            } else {
                across
            };
        }
    }
    let stores = (COUNT * VERTEX).div_ceil(V::LANES);
    for store in (0..stores).rev() {
        V::scatter(&rows[store * V::LANES..][..V::LANES], &mut out[store * V::LANES..], stride);
    }
}

/// The index pattern of four rings, a multiple of every vector's lanes, and the start of the fifth.
#[derive(Debug)]
pub(super) struct IndexTable {
    table: Vec<u32>,
    period: usize,
    growth: u32,
}

/// Rings whose indices are whole vectors, whatever the sides: four times six a side.
const INDEX_RINGS: u32 = 4;

impl IndexTable {
    pub(super) fn new(sides: u32) -> Self {
        let pattern = texere_core::index_pattern(sides);
        let rings = (0..=INDEX_RINGS).flat_map(|ring| pattern.iter().map(move |index| ring * sides + index));
        let period = pattern.len() * INDEX_RINGS as usize;
        Self { table: rings.take(period + 8).collect(), period, growth: INDEX_RINGS * sides }
    }

    /// Writes the indices of consecutive rings' quads, the first ring's vertices starting at `first_vertex`.
    #[inline(always)]
    pub(super) fn write<V: Vector>(&self, first_vertex: u32, out: &mut [u32]) {
        V::stream_pattern(&self.table, self.period, self.growth, first_vertex, out);
    }
}
