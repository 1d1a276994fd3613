//! Tables that kernels read beside control points and blocks. They are sent to a device byte for
//! byte.

use std::ops::Range;

use bytemuck::{Pod, Zeroable};

use texere_core::backend::{BLOCK_RINGS, Block, Chunk, Plan};
use texere_core::definitions::Turn;
use texere_core::{Cap, End, RINGS_MAX, Topology};

/// A yarn as kernels see it.
///
/// **Shape**: six 4-byte values, 24 bytes, 24-byte stride.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default, Pod, Zeroable)]
pub struct YarnRow {
    /// Its rings.
    pub rings: u32,
    /// Its first block among all of the plan.
    pub first_block: u32,
    /// Its section.
    pub section: u32,
    /// 1 where it is closed, else 0.
    pub closed: u32,
    /// Its twist, turns per mm.
    pub twist: f32,
    /// 0 upright, 1 rotation minimising.
    pub frame: u32,
}

const _: () = assert!(size_of::<YarnRow>() == 24 && std::mem::offset_of!(YarnRow, twist) == 16);

/// A cap as kernels see it.
///
/// **Shape**: eight `u32`, 32 bytes. All but `yarn` count from the start of the chunk.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Pod, Zeroable)]
pub struct CapRow {
    /// The yarn, from 0 among all.
    pub yarn: u32,
    /// 0 at the yarn's start, 1 at its finish.
    pub end: u32,
    /// Padded control point `P[j-1]` of the interval that the end belongs to, from the start of the
    /// chunk's window.
    pub first_point: u32,
    /// The first vertex of the ring that the cap closes.
    pub ring_vertex: u32,
    /// The cap's own first vertex.
    pub first_vertex: u32,
    /// The cap's own first index, where the topology has any.
    pub first_index: u32,
    /// Where the section's cap triangles start in [`cap_pattern`].
    pub first_corner: u32,
    /// Unused, 0: keeps the row a multiple of 16 bytes.
    pub padding: u32,
}

const _: () = assert!(size_of::<CapRow>() == 32 && std::mem::offset_of!(CapRow, padding) == 28);

/// The parameters of a launch.
///
/// **Shape**: twelve 4-byte values, 48 bytes, a multiple of 16 as a uniform buffer wants.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default, Pod, Zeroable)]
pub struct Params {
    /// Rows of the block table.
    pub blocks: u32,
    /// Rows of the cap table.
    pub caps: u32,
    /// The first yarn of a launch over yarns. In such a launch [`Params::blocks`] is the number of
    /// yarns.
    pub first_yarn: u32,
    /// Yarns of the plan.
    pub yarns: u32,
    /// Sides of the tube.
    pub sides: u32,
    /// Points inserted between two control points.
    pub subdivisions: u32,
    /// Index of the first ring's lean, behind the rolls of blocks; 0 where no yarn leans.
    pub leans: u32,
    /// 1 where indices are written, else 0.
    pub indexed: u32,
    /// 1 where rolls have been scanned, else 0: every roll is zero then.
    pub rolled: u32,
    /// `s = (1 - tension) / 2`.
    pub s: f32,
    /// `1 / (K + 1)`.
    pub step: f32,
    /// Quanta of packed positions, per mm.
    pub quanta_per_mm: f32,
}

const _: () = assert!(size_of::<Params>() == 48 && std::mem::offset_of!(Params, quanta_per_mm) == 44);

impl YarnRow {
    /// All yarns of `plan`.
    #[must_use]
    pub fn all(plan: &Plan) -> Vec<Self> {
        Self::of(plan, 0..plan.layout().yarns().len())
    }

    /// Some yarns of `plan`.
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
    /// All caps of `chunk`, one of `plan`'s.
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
    /// The parameters of a launch over some yarns of `plan`; `chunk` is any of its chunks.
    #[must_use]
    pub fn of_yarns(plan: &Plan, chunk: &Chunk, yarns: &Range<usize>) -> Self {
        Self { blocks: yarns.len() as u32, first_yarn: yarns.start as u32, ..Self::new(plan, chunk) }
    }

    /// The parameters of all launches on `chunk`, one of `plan`'s, with its own block table.
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
/// values, the lean of each ring. There are [`BLOCK_RINGS`] for each block of these yarns, zero
/// where a yarn does not lean. Where no yarn of `plan` leans there are none. Kernels read the lean
/// table behind the rolls of blocks.
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

/// The block table of `chunk`, one of `plan`'s, for a schedule in which a lane makes a part. A part
/// is one row, or several where it has more than `most_rings` rings. A row is any number of
/// consecutive rings of a yarn, from any ring on.
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

/// The indices of caps, numbered from the cap's first vertex. For each section of `plan` come those
/// of its start cap, `3 (sides - 2)` values, then as many for its finish cap. Empty where there are
/// no caps.
#[must_use]
pub fn cap_pattern(plan: &Plan) -> Vec<u32> {
    let sections = if plan.settings().caps { plan.layout().sections().len() } else { 0 };
    (0..sections)
        .flat_map(|section| [End::Start, End::Finish].map(|end| (section, end)))
        .flat_map(|(section, end)| plan.cap_indices(section, end))
        .collect()
}

/// Rings and quads of all of `blocks`.
fn totals(blocks: &[Block]) -> [u32; 2] {
    blocks.iter().fold([0, 0], |[rings, quads], block| [rings + block.rings, quads + block.quads])
}

// A block's number fits the `u32` of these tables.
const _: () = assert!(RINGS_MAX / (BLOCK_RINGS as u64) <= u32::MAX as u64);

#[cfg(test)]
mod tests {
    use texere_core::{ControlPoint, Limits, Settings, Yarn, Yarns};

    use super::*;

    /// Chunks of plans of short and long yarns, cut in many places.
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

    /// The plan's own blocks are rows of 64 rings: these come out again, also from rows of fewer,
    /// and no row is longer than asked for.
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
