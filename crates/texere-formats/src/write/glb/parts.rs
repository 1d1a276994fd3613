//! The parts of yarns that an instanced GLB file holds once, and the places where they recur.

use std::collections::HashMap;
use std::iter;

use texere_core::{End, Vertex};

use crate::write::WriteError;

/// The most bytes of different parts, each with its vertices and [`PART_BYTES`]. The file is made
/// in memory, because its document comes first and counts the parts. The Jacquard cloth of
/// `designs/paper/figure-7a.toml`, 2,880 by 1,840 threads, takes 9 MB of them.
const BYTES_MAX: u64 = 1 << 28;

/// The bytes that a part takes besides its vertices, in memory and in the document. Most of them
/// are the document's text.
const PART_BYTES: u64 = 1 << 11;

/// The number of features of a part. Features are numbers by which a part is looked up. With 16,
/// one for each control interval of a part, parts of figure 7a's cloth that differ are rarely
/// compared vertex by vertex.
const FEATURES: usize = 16;

/// The width of a feature's bins, as a multiple of the most that a feature of equal parts differs.
/// Wider bins hold more parts that differ, narrower ones have more edges that a feature may lie at.
const BIN: f64 = 64.0;

/// The most bins that are looked at for a part. Each feature near an edge doubles their number.
/// Once there are as many, further features are looked up in their own bin only. An equal part may
/// then be missed and the part be held a second time, which costs bytes and nothing else.
const BINS_MOST: usize = 64;

/// The most parts that a part is compared with. In a large cloth whose parts differ a little, one
/// bin may hold thousands. If none of those compared is equal, the part is held a second time.
const COMPARED_MOST: usize = 64;

/// The direction along which vertices are measured for a feature. No axis of a cloth is at right
/// angles to it.
const DIRECTION: [f64; 3] = [0.267, 0.535, 0.802];

/// The most that a coordinate of a normal differs from that of the part held. A unit vector then is
/// off by 0.5 degrees at most.
const NORMAL_OFF: f32 = 0.005;

/// What a part is: which triangles its vertices have, and which material.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct Kind {
    pub(super) triangles: Triangles,
    pub(super) material: u32,
}

/// The triangles of a part.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Triangles {
    /// The triangles of a tube with this number of gaps between rings.
    Tube { gaps: u32 },
    /// The triangles of the cap of a section at an end.
    Cap { section: u32, end: End },
}

/// A part that the file holds.
#[derive(Debug)]
pub(super) struct Part {
    pub(super) kind: Kind,
    /// The vertices, measured from the first of them, mm.
    pub(super) vertices: Vec<Vertex>,
    /// The places of the first vertex wherever the part recurs, mm.
    pub(super) places: Vec<[f32; 3]>,
}

/// The parts of a cloth, each held once.
#[derive(Debug)]
pub(super) struct Parts {
    /// The most that a coordinate differs from that of the part held, mm.
    off: f32,
    parts: Vec<Part>,
    /// The parts by their kinds and the bins of their features.
    found: HashMap<(Kind, [i32; FEATURES]), Vec<usize>>,
    bytes: u64,
}

impl Parts {
    /// No parts yet. Parts are equal if no coordinate differs by more than `off`, mm.
    pub(super) fn new(off: f32) -> Self {
        Self { off, parts: Vec::new(), found: HashMap::new(), bytes: 0 }
    }

    /// All parts of tubes, and then all caps, each in the order in which they first came. If
    /// tubes and caps stayed in the order in which they came, the file would depend on how the mesh
    /// is cut into chunks.
    pub(super) fn in_order(mut self) -> Vec<Part> {
        self.parts.sort_by_key(|part| matches!(part.kind.triangles, Triangles::Cap { .. }));
        self.parts
    }

    /// Adds a part of a yarn, or a place to the part that it is equal to.
    ///
    /// **Errors**: [`WriteError::TooFewRepeats`].
    pub(super) fn add(&mut self, kind: Kind, vertices: &[Vertex]) -> Result<(), WriteError> {
        let place = vertices[0].position;
        let own: Vec<_> = vertices.iter().map(|vertex| from(vertex, place)).collect();
        let features = self.features(&own);
        let equal = bins(&features, 1.0 / BIN)
            .filter_map(|bins| self.found.get(&(kind, bins)))
            .flatten()
            .take(COMPARED_MOST)
            .find(|part| self.are_equal(&self.parts[**part].vertices, &own));
        if let Some(&equal) = equal {
            self.parts[equal].places.push(place);
            return Ok(());
        }
        self.bytes += size_of_val(&own[..]) as u64 + PART_BYTES;
        if self.bytes > BYTES_MAX {
            return Err(WriteError::TooFewRepeats { parts: self.parts.len() + 1, limit: BYTES_MAX });
        }
        let bins = features.map(|feature| feature.floor() as i32);
        self.found.entry((kind, bins)).or_default().push(self.parts.len());
        self.parts.push(Part { kind, vertices: own, places: vec![place] });
        Ok(())
    }

    /// The places of [`FEATURES`] vertices along [`DIRECTION`], in bins. Each place is moved by a
    /// fraction of a bin of its own. Otherwise a place that recurs in a cloth could lie near an
    /// edge of a bin for many features at once.
    fn features(&self, vertices: &[Vertex]) -> [f64; FEATURES] {
        std::array::from_fn(|number| {
            let position = vertices[(vertices.len() - 1) * (number + 1) / FEATURES].position;
            let along: f64 = iter::zip(position, DIRECTION).map(|(own, axis)| f64::from(own) * axis).sum();
            // The fractional parts of the golden ratio's multiples spread evenly over 0 to 1.
            along / self.bin() + 0.618_033_988_75 * (number + 1) as f64
        })
    }

    /// The width of a bin, mm.
    fn bin(&self) -> f64 {
        BIN * self.feature_off()
    }

    /// The most that a feature of equal parts differs, mm.
    fn feature_off(&self) -> f64 {
        f64::from(self.off) * DIRECTION.iter().sum::<f64>()
    }

    fn are_equal(&self, held: &[Vertex], own: &[Vertex]) -> bool {
        let near = |one: [f32; 3], other: [f32; 3], off: f32| {
            iter::zip(one, other).all(|(one, other)| (one - other).abs() <= off)
        };
        iter::zip(held, own).all(|(held, own)| {
            near(held.position, own.position, self.off) && near(held.normal, own.normal, NORMAL_OFF)
        })
    }
}

/// A vertex with its position measured from `place`.
fn from(vertex: &Vertex, place: [f32; 3]) -> Vertex {
    Vertex { position: std::array::from_fn(|axis| vertex.position[axis] - place[axis]), ..*vertex }
}

/// The bins of all features that differ from `features` by no more than `off`. Both are in widths
/// of a bin.
fn bins(features: &[f64; FEATURES], off: f64) -> impl Iterator<Item = [i32; FEATURES]> {
    let mut all = vec![[0; FEATURES]];
    for (number, feature) in features.iter().enumerate() {
        let [low, high] = [feature - off, feature + off].map(|feature| feature.floor() as i32);
        let others = if low == high || all.len() >= BINS_MOST { 0 } else { all.len() };
        let own = feature.floor() as i32;
        all.iter_mut().for_each(|bins| bins[number] = own);
        all.extend_from_within(..others);
        let before = all.len() - others;
        // Either `low` or `high` is the own bin. This is the other one.
        all[before..].iter_mut().for_each(|bins| bins[number] = low ^ high ^ own);
    }
    all.into_iter()
}
