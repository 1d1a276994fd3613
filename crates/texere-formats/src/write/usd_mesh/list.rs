//! The lists of a prim. All values of a list have the same length as text.

use std::fmt::Write;

use crate::write::corners::Batch;
use crate::write::mesh_form::Attributes;

/// Bytes of any float as text: a sign, nine digits, a point, and an exponent of four bytes.
const FLOAT_BYTES: u64 = 15;

/// Bytes of a point or a direction as text: three floats, brackets and commas.
const THREE_BYTES: u64 = 3 * FLOAT_BYTES + 6;

/// Bytes of a pair of floats as text.
const TWO_BYTES: u64 = 2 * FLOAT_BYTES + 4;

/// Bytes before each value: a comma and a line's end, or before the first one, a line's end and a
/// space.
const BREAK_BYTES: u64 = 2;

/// A list of a prim.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum List {
    /// How many corners each face has.
    Counts,
    /// The vertices of the corners of all faces.
    Corners,
    Points,
    Normals,
    Coordinates,
    Tangents,
}

impl List {
    /// The number of all lists.
    pub(super) const ALL: usize = 6;

    /// The lists of a prim with these attributes. The number of the yarn needs no list.
    pub(super) fn of(Attributes { uv, tangent, .. }: Attributes) -> Vec<Self> {
        let always = [Self::Counts, Self::Corners, Self::Points, Self::Normals];
        let asked = [(uv, Self::Coordinates), (tangent, Self::Tangents)];
        let asked = asked.into_iter().filter_map(|(is_asked, list)| is_asked.then_some(list));
        always.into_iter().chain(asked).collect()
    }

    /// The text before the list's values.
    pub(super) const fn start(self) -> &'static str {
        match self {
            Self::Counts => "        int[] faceVertexCounts = [",
            Self::Corners => "        int[] faceVertexIndices = [",
            Self::Points => "        point3f[] points = [",
            Self::Normals => "        normal3f[] normals = [",
            Self::Coordinates => "        texCoord2f[] primvars:st = [",
            Self::Tangents => "        vector3f[] primvars:tangents = [",
        }
    }

    /// The text after the list's values.
    pub(super) const fn end(self) -> &'static str {
        match self {
            Self::Counts | Self::Corners | Self::Points => "]\n",
            Self::Normals | Self::Coordinates | Self::Tangents => {
                "] (\n            interpolation = \"vertex\"\n        )\n"
            }
        }
    }

    /// Whether the list is about triangles, not about vertices.
    pub(super) const fn is_of_triangles(self) -> bool {
        matches!(self, Self::Counts | Self::Corners)
    }

    /// The number of values that the list has for `number` triangles or vertices.
    pub(super) const fn values(self, number: u64) -> u64 {
        if matches!(self, Self::Corners) { 3 * number } else { number }
    }

    /// Bytes of all values of the list of a prim.
    pub(super) const fn all_bytes(self, vertices: u64, triangles: u64) -> u64 {
        self.values(if self.is_of_triangles() { triangles } else { vertices }) * self.bytes(vertices)
    }

    /// Bytes of a value, with the break before it, of a prim with this number of `vertices`.
    pub(super) const fn bytes(self, vertices: u64) -> u64 {
        BREAK_BYTES
            + match self {
                Self::Counts => 1,
                Self::Corners => (vertices - 1).ilog10() as u64 + 1,
                Self::Points | Self::Normals | Self::Tangents => THREE_BYTES,
                Self::Coordinates => TWO_BYTES,
            }
    }

    /// Writes the list's values of the vertices of `batch`, of which the first is number `first` of
    /// the prim. A list about triangles writes nothing.
    pub(super) fn vertices(self, text: &mut String, first: u64, batch: &Batch<'_>) {
        for ((vertex, surface), number) in batch.vertices.iter().zip(batch.surfaces()).zip(first..) {
            match self {
                Self::Counts | Self::Corners => return,
                Self::Points => value(text, number, three(vertex.position)),
                Self::Normals => value(text, number, three(vertex.normal)),
                Self::Tangents => value(text, number, three(surface.tangent)),
                Self::Coordinates => {
                    let [turn, along] = surface.uv;
                    value(text, number, format_args!("({turn:15e}, {along:15e})"));
                }
            }
        }
    }

    /// Writes the list's values of the triangles of `corners`, of which the first is number `first`
    /// of the prim. Each value is `width` bytes long, with the break before it. Corners count from
    /// vertex `base`. A list about vertices writes nothing.
    pub(super) fn triangles(self, text: &mut String, first: u64, base: u64, corners: &[u32], width: u64) {
        match self {
            Self::Counts => (first..).take(corners.len() / 3).for_each(|number| value(text, number, 3)),
            Self::Corners => {
                let width = (width - BREAK_BYTES) as usize;
                for (corner, number) in corners.iter().zip(3 * first..) {
                    value(text, number, format_args!("{:width$}", base + u64::from(*corner)));
                }
            }
            Self::Points | Self::Normals | Self::Coordinates | Self::Tangents => {}
        }
    }
}

/// The text of a point or a direction. All such texts are equally long.
pub(super) fn three([x, y, z]: [f32; 3]) -> String {
    format!("({x:15e}, {y:15e}, {z:15e})")
}

/// Writes value number `number` of a list.
fn value(text: &mut String, number: u64, value: impl std::fmt::Display) {
    let before = if number == 0 { "\n " } else { ",\n" };
    // Writing to a string does not fail.
    let _ = write!(text, "{before}{value}");
}
