//! Tables that kernels read in addition to control points and blocks. They are sent to a device
//! byte for byte.

use std::ops::Range;

use bytemuck::{Pod, Zeroable};

use texere_core::backend::{BLOCK_RINGS, Block, Chunk, Plan};
use texere_core::definitions::Turn;
use texere_core::{Cap, End, RINGS_MAX, Topology};

/// A yarn's row in the table that kernels read.
///
/// **Shape**: six 4-byte values, 24 bytes, 24-byte stride.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default, Pod, Zeroable)]
pub struct YarnRow {
    /// Number of the yarn's rings.
    pub rings: u32,
    /// Number of the yarn's first block among all blocks of the plan.
    pub first_block: u32,
    /// Number of the yarn's section.
    pub section: u32,
    /// 1 if the yarn is closed, otherwise 0.
    pub closed: u32,
    /// The yarn's twist, turns per mm.
    pub twist: f32,
    /// The yarn's frame: 0 for upright, 1 for rotation minimising.
    pub frame: u32,
}

const _: () = assert!(size_of::<YarnRow>() == 24 && std::mem::offset_of!(YarnRow, twist) == 16);

/// A cap's row in the table that kernels read.
///
/// **Shape**: eight `u32`, 32 bytes. Vertices and indices are counted from the start of the chunk.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Pod, Zeroable)]
pub struct CapRow {
    /// Number of the yarn among all yarns, counted from 0.
    pub yarn: u32,
    /// 0 for the cap at the yarn's start, 1 for that at its finish.
    pub end: u32,
    /// Number of the padded control point `P[j-1]` of the interval at the yarn's end, counted from
    /// the start of the chunk's window.
    pub first_point: u32,
    /// Number of the first vertex of the ring that the cap closes.
    pub ring_vertex: u32,
    /// Number of the cap's own first vertex.
    pub first_vertex: u32,
    /// Number of the cap's own first index, if the topology is indexed.
    pub first_index: u32,
    /// The start in [`cap_pattern`] of the triangles of this cap.
    pub first_corner: u32,
    /// Unused, 0. It makes the row a multiple of 16 bytes.
    pub padding: u32,
}

const _: () = assert!(size_of::<CapRow>() == 32 && std::mem::offset_of!(CapRow, padding) == 28);

/// The parameters of a launch.
///
/// **Shape**: twelve 4-byte values, 48 bytes. Uniform buffers need a multiple of 16.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default, Pod, Zeroable)]
pub struct Params {
    /// Number of rows of the block table.
    pub blocks: u32,
    /// Number of rows of the cap table.
    pub caps: u32,
    /// Number of the first yarn of a launch over yarns. In a launch over yarns, [`Params::blocks`]
    /// is the number of yarns.
    pub first_yarn: u32,
    /// Number of yarns of the plan.
    pub yarns: u32,
    /// Number of sides of the tube.
    pub sides: u32,
    /// Number of points inserted between two control points.
    pub subdivisions: u32,
    /// Index of the first ring's lean, counted from the roll of the first block. Leans lie behind
    /// the rolls of blocks. The index is 0 if no yarn leans.
    pub leans: u32,
    /// 1 if indices are written, otherwise 0.
    pub indexed: u32,
    /// 1 if rolls have been scanned, otherwise 0. Without a scan every roll is zero.
    pub rolled: u32,
    /// The factor `s = (1 - tension) / 2` of the spline's tangents.
    pub s: f32,
    /// `1 / (K + 1)`, where K is the number of subdivisions.
    pub step: f32,
    /// Number of quanta of packed positions per mm.
    pub quanta_per_mm: f32,
}

const _: () = assert!(size_of::<Params>() == 48 && std::mem::offset_of!(Params, quanta_per_mm) == 44);

impl YarnRow {
    /// The rows of all yarns of `plan`.
    #[must_use]
    pub fn all(plan: &Plan) -> Vec<Self> {
        Self::of(plan, 0..plan.layout().yarns().len())
    }

    /// The rows of the range `yarns` of the yarns of `plan`.
    ///
    /// **Panics** past the last yarn.
    #[must_use]
    pub fn of(plan: &Plan, yarns: Range<usize>) -> Vec<Self> {
        let row = |yarn| Self {
            rings: plan.rings(yarn),
            first_block: plan.block_offsets()[yarn] as u32,
            section: plan.yarn(yarn).section,
            closed: plan.yarn(yarn).closed.into(),
            twist: plan.turns_per_mm(yarn),
            frame: plan.frame(yarn) as u32,
        };
        yarns.map(row).collect()
    }
}

impl CapRow {
    /// The rows of all caps of `chunk`, which is a chunk of `plan`.
    #[must_use]
    pub fn all(plan: &Plan, chunk: &Chunk) -> Vec<Self> {
        let settings = plan.settings();
        let row = |cap: &Cap| {
            let yarn = cap.yarn as usize;
            let intervals = (u64::from(plan.rings(yarn)) - 1) / (u64::from(settings.subdivisions) + 1);
            let interval = if cap.end == End::Start { 0 } else { intervals - 1 };
            let corners = 3 * (settings.sides - 2);
            Self {
                yarn: cap.yarn,
                end: (cap.end == End::Finish).into(),
                first_point: (plan.padded_offsets()[yarn] + interval - chunk.window().start) as u32,
                ring_vertex: cap.chunk_ring * settings.sides,
                first_vertex: cap.first_vertex,
                first_index: cap.first_index,
                first_corner: (2 * plan.yarn(yarn).section + u32::from(cap.end == End::Finish)) * corners,
                padding: 0,
            }
        };
        chunk.caps().iter().map(row).collect()
    }
}

impl Params {
    /// The parameters of a launch over some yarns of `plan`. `chunk` is any chunk of `plan`.
    #[must_use]
    pub fn of_yarns(plan: &Plan, chunk: &Chunk, yarns: &Range<usize>) -> Self {
        Self { blocks: yarns.len() as u32, first_yarn: yarns.start as u32, ..Self::new(plan, chunk) }
    }

    /// The parameters of all launches on `chunk`, a chunk of `plan`, with the chunk's own block
    /// table.
    #[must_use]
    pub fn new(plan: &Plan, chunk: &Chunk) -> Self {
        let settings = plan.settings();
        Self {
            blocks: chunk.blocks().len() as u32,
            caps: chunk.caps().len() as u32,
            first_yarn: 0,
            yarns: plan.layout().yarns().len() as u32,
            sides: settings.sides,
            subdivisions: settings.subdivisions,
            leans: if plan.layout().leans() { plan.block_count() as u32 } else { 0 },
            indexed: (settings.topology == Topology::Indexed).into(),
            rolled: plan.needs_scan().into(),
            s: plan.sampling().s(),
            step: plan.sampling().step(),
            quanta_per_mm: settings.quantum.per_mm(),
        }
    }
}

/// The part of the lean table that belongs to `yarns`: the index of its first value, and its
/// values. The values are the lean of each ring. There are [`BLOCK_RINGS`] of them for each block
/// of these yarns, and they are zero for a yarn that does not lean. If no yarn of `plan` leans,
/// there are no values. Kernels read the lean table behind the rolls of blocks.
///
/// **Panics** past the last yarn.
#[must_use]
pub fn lean_rows(plan: &Plan, yarns: Range<usize>) -> (u64, Vec<Turn>) {
    let place = |yarn: usize| plan.block_offsets()[yarn] * u64::from(BLOCK_RINGS);
    let first = place(yarns.start);
    if !plan.layout().leans() {
        return (first, Vec::new());
    }
    let mut rows = vec![Turn::ZERO; (place(yarns.end) - first) as usize];
    for yarn in yarns {
        if let Some(leans) = plan.leans(yarn) {
            rows[(place(yarn) - first) as usize..][..leans.len()].copy_from_slice(leans);
        }
    }
    (first, rows)
}

/// The number of values in the whole lean table.
#[must_use]
pub fn lean_count(plan: &Plan) -> u64 {
    if plan.layout().leans() { plan.block_count() * u64::from(BLOCK_RINGS) } else { 0 }
}

/// The block table of `chunk`, a chunk of `plan`, for a schedule in which a lane makes a whole
/// part. A part is all consecutive blocks of one yarn in the chunk. It is one row, or several if it
/// has more than `most_rings` rings. A row is any number of consecutive rings of a yarn, from any
/// ring on.
#[must_use]
pub fn part_rows(plan: &Plan, chunk: &Chunk, most_rings: u32) -> Vec<Block> {
    joined_rows(plan, chunk.blocks(), most_rings)
}

fn joined_rows(plan: &Plan, blocks: &[Block], most_rings: u32) -> Vec<Block> {
    let settings = plan.settings();
    let (per_interval, most_rings) = (settings.subdivisions + 1, most_rings.max(1));
    let ring_indices = if settings.topology == Topology::Indexed { 6 * settings.sides } else { 0 };
    let mut rows = Vec::new();
    for part in blocks.chunk_by(|block, next| block.is_before(next)) {
        let (first, [rings, quads]) = (part[0], totals(part));
        for done in (0..rings).step_by(most_rings as usize) {
            let first_ring = first.first_ring + done;
            rows.push(Block {
                first_ring,
                rings: (rings - done).min(most_rings),
                quads: (quads - done).min(most_rings),
                first_point: first.first_point + first_ring / per_interval - first.first_ring / per_interval,
                chunk_ring: first.chunk_ring + done,
                first_vertex: first.first_vertex + done * settings.sides,
                first_index: first.first_index + done * ring_indices,
                ..first
            });
        }
    }
    rows
}

/// The indices of caps, counted from the cap's first vertex. For each section of `plan` there are
/// the indices of its start cap, `3 (sides - 2)` values, then as many of its finish cap. Empty if
/// the plan has no caps.
#[must_use]
pub fn cap_pattern(plan: &Plan) -> Vec<u32> {
    let sections = if plan.settings().caps { plan.layout().sections().len() } else { 0 };
    (0..sections)
        .flat_map(|section| [End::Start, End::Finish].map(|end| (section, end)))
        .flat_map(|(section, end)| plan.cap_indices(section, end))
        .collect()
}

/// The numbers of rings and quads of all `blocks` together.
fn totals(blocks: &[Block]) -> [u32; 2] {
    blocks.iter().fold([0, 0], |[rings, quads], block| [rings + block.rings, quads + block.quads])
}

// A block's number fits the `u32` of these tables.
const _: () = assert!(RINGS_MAX / (BLOCK_RINGS as u64) <= u32::MAX as u64);

#[cfg(test)]
mod tests {
    use texere_core::{ControlPoint, Limits, Settings, Yarn, Yarns};

    use super::*;

    /// Calls `check` with chunks of plans of short and long yarns, cut in many places.
    fn chunks(check: impl Fn(&Plan, &Chunk)) {
        for (subdivisions, sides) in [(0, 3), (1, 6), (7, 5)] {
            for topology in [Topology::Indexed, Topology::Shared] {
                let mut yarns = Yarns::builder();
                for points in [2, 65, 64, 130, 1_000] {
                    let points: Vec<_> =
                        (0..points).map(|k| ControlPoint::new(k as f32, 0.0, 0.0, 0.1)).collect();
                    yarns.yarn(Yarn::default(), &points);
                }
                let settings = Settings { subdivisions, sides, topology, ..Settings::default() };
                let plan = Plan::new(yarns.build().unwrap().layout().clone(), settings).unwrap();
                for blocks in [2, 3, 7, u64::MAX] {
                    plan.chunks(&Limits { blocks, ..Limits::NONE })
                        .unwrap()
                        .for_each(|chunk| check(&plan, &chunk));
                }
            }
        }
    }

    #[test]
    fn a_part_is_one_row_unless_it_is_too_long() {
        chunks(|plan, chunk| {
            let rows = part_rows(plan, chunk, u32::MAX);
            let made = rows
                .iter()
                .map(|row| [row.yarn, row.first_ring, row.rings, row.first_vertex, row.first_index]);
            let parts = chunk
                .parts()
                .iter()
                .map(|part| [part.yarn, part.first_ring, part.rings, part.first_vertex, part.first_index]);
            assert!(made.eq(parts), "{rows:?} for {chunk:?}");
            assert!(rows.iter().all(|row| row.quads + 1 == row.rings), "{rows:?}");
        });
    }

    /// Rows of at most 64 rings must equal the chunk's own blocks, also if they are made from rows
    /// of another length. No row may be longer than asked for, and each must have the control point
    /// of its first ring.
    #[test]
    fn rows_of_any_length_say_what_the_blocks_say() {
        chunks(|plan, chunk| {
            assert_eq!(part_rows(plan, chunk, BLOCK_RINGS), chunk.blocks());
            for most in [0, 1, 5, 21, 63, 65, 100] {
                let rows = part_rows(plan, chunk, most);
                assert!(rows.iter().all(|row| (1..=most.max(1)).contains(&row.rings)), "{most}: {rows:?}");
                for row in &rows {
                    let interval = row.first_ring / (plan.settings().subdivisions + 1);
                    let point = plan.padded_offsets()[row.yarn as usize] + u64::from(interval);
                    assert_eq!(u64::from(row.first_point) + chunk.window().start, point, "{row:?}");
                }
                assert_eq!(joined_rows(plan, &rows, BLOCK_RINGS), chunk.blocks(), "{most}");
            }
        });
    }
}
