//! The OpenCL C sources of texere, as text, with their entry points and workgroup sizes. This crate
//! uses no GPU interface.
//!
//! Each stage is a file. Its twin is the file of the same name in texere-shaders, which has the
//! same functions and the same order of operations in WGSL. A [`KernelProgram`] is the list of
//! files that are compiled together, shared ones first.
//!
//! ```
//! use texere_kernels::{MESH, PER_RING};
//! assert!(PER_RING.entries.contains(&MESH));
//! assert!(PER_RING.sources.concat().contains("void mesh("));
//! ```

/// A kernel of a program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct EntryPoint {
    /// The kernel function.
    pub name: &'static str,
    /// The number of lanes in a workgroup. The source requires exactly this number, except for
    /// `mesh` and `mesh_odd`, which run with any number from 64 on.
    pub group: usize,
}

/// The first half of the scan: the turn of each block. It runs with one workgroup for each row of
/// the chunk's block table.
pub const BLOCK_TURNS: EntryPoint = EntryPoint { name: "block_turns", group: 64 };

/// The second half of the scan: rolls from turns, in place. It runs with one workgroup for each
/// yarn.
pub const YARN_ROLLS: EntryPoint = EntryPoint { name: "yarn_rolls", group: 256 };

/// Stage 1: the rings of a chunk. It runs with one workgroup for each row of the chunk's block
/// table.
pub const TRAJECTORY: EntryPoint = EntryPoint { name: "trajectory", group: 64 };

/// Stage 2 with stage 1 in it: the vertices and indices of a chunk's tubes, for an even number of
/// sides. It runs with one workgroup for each row of the chunk's block table. It runs with any
/// workgroup of at least 64 lanes; see [`UNINDEXED_GROUP`].
pub const MESH: EntryPoint = EntryPoint { name: "mesh", group: 128 };

/// [`MESH`] for an odd number of sides.
pub const MESH_ODD: EntryPoint = EntryPoint { name: "mesh_odd", ..MESH };

/// The number of lanes in a workgroup of [`MESH`] that writes no indices. Without indices there is
/// less to write for each ring, so lanes beyond one for each ring would take more time than they
/// save.
pub const UNINDEXED_GROUP: usize = 64;

/// The caps of a chunk, after [`MESH`]. It runs with one lane for each cap vertex.
pub const CAPS: EntryPoint = EntryPoint { name: "caps", group: 64 };

/// The first half of measuring: the length of each block. It runs with one workgroup for each row
/// of the chunk's block table.
pub const BLOCK_LENGTHS: EntryPoint = EntryPoint { name: "block_lengths", group: 64 };

/// The second half of measuring: lengths along yarns up to each block's start, in place. It runs
/// with one workgroup for each yarn.
pub const YARN_LENGTHS: EntryPoint = EntryPoint { name: "yarn_lengths", group: 256 };

/// The attributes of a chunk's tubes. It runs with one workgroup for each row of its block table.
pub const ATTRIBUTES_OF_TUBES: EntryPoint = EntryPoint { name: "attributes", group: 64 };

/// The attributes of a chunk's caps, after [`ATTRIBUTES_OF_TUBES`]. It runs with one lane for each
/// cap vertex.
pub const ATTRIBUTES_OF_CAPS: EntryPoint = EntryPoint { name: "cap_attributes", group: 64 };

/// Packed vertices of a chunk's tubes, for an even number of sides. It runs with one workgroup for
/// each row of its block table.
pub const PACKED: EntryPoint = EntryPoint { name: "packed", group: 64 };

/// [`PACKED`] for an odd number of sides.
pub const PACKED_ODD: EntryPoint = EntryPoint { name: "packed_odd", group: 64 };

/// Packed vertices of a chunk's caps, after [`PACKED`]. It runs with one lane for each cap vertex.
pub const PACKED_CAPS: EntryPoint = EntryPoint { name: "packed_caps", group: 64 };

/// The paper's algorithm 2. It runs with one lane for each part of the chunk. A part is a run of
/// one yarn's rings.
pub const TRAJECTORY_PER_YARN: EntryPoint = EntryPoint { name: "trajectory_per_yarn", group: 64 };

/// The paper's algorithm 4, after [`TRAJECTORY_PER_YARN`]. It runs with one lane for each part of
/// the chunk.
pub const MESH_PER_YARN: EntryPoint = EntryPoint { name: "mesh_per_yarn", group: 64 };

/// The chords of a settling, from places. It runs with one lane for each chord.
pub const SETTLING_CHORDS: EntryPoint = EntryPoint { name: "settling_chords", group: 64 };

/// The longest chord, and the box round the middles of all chords. Any number of workgroups share
/// the chords.
pub const SETTLING_EXTENT: EntryPoint = EntryPoint { name: "settling_extent", group: 256 };

/// The number of chords in each cell. It runs with one lane for each chord.
pub const SETTLING_CELL_COUNT: EntryPoint = EntryPoint { name: "settling_cell_count", group: 64 };

/// Chords sorted by cells. It runs with one lane for each chord.
pub const SETTLING_CELL_FILL: EntryPoint = EntryPoint { name: "settling_cell_fill", group: 64 };

/// The number of each chord's neighbours. It runs with one lane for each chord.
pub const SETTLING_COUNT: EntryPoint = EntryPoint { name: "settling_count", group: 64 };

/// The neighbours of each chord. It runs with one lane for each chord.
pub const SETTLING_FILL: EntryPoint = EntryPoint { name: "settling_fill", group: 64 };

/// Replaces each count by the sum of the counts before it. A workgroup scans
/// [`SETTLING_SCAN_VALUES`] counts.
pub const SETTLING_SCAN: EntryPoint = EntryPoint { name: "settling_scan", group: 256 };

/// The number of counts that a workgroup of [`SETTLING_SCAN`] scans: four in each lane.
pub const SETTLING_SCAN_VALUES: usize = 1024;

/// Adds to each count the sum of all workgroups before its own. The workgroups are those of
/// [`SETTLING_SCAN`].
pub const SETTLING_SCAN_ADD: EntryPoint = EntryPoint { name: "settling_scan_add", group: 256 };

/// Pulls at each interval's points, in the weighted form. It runs with one lane for each place.
pub const SETTLING_PULL_WEIGHTED: EntryPoint = EntryPoint { name: "settling_pull_weighted", group: 64 };

/// [`SETTLING_PULL_WEIGHTED`] in the block form.
pub const SETTLING_PULL_BLOCK: EntryPoint = EntryPoint { name: "settling_pull_block", group: 64 };

/// The step of each point, in the weighted form. It runs with one lane for each place. Each
/// workgroup has the same places as a workgroup of [`SETTLING_PULL_WEIGHTED`].
pub const SETTLING_STEP_WEIGHTED: EntryPoint = EntryPoint { name: "settling_step_weighted", group: 64 };

/// [`SETTLING_STEP_WEIGHTED`] in the block form.
pub const SETTLING_STEP_BLOCK: EntryPoint = EntryPoint { name: "settling_step_block", group: 64 };

/// The places beyond yarns' ends. It runs with one lane for each yarn.
pub const SETTLING_ENDS: EntryPoint = EntryPoint { name: "settling_ends", group: 64 };

/// The measures of all workgroups together. It runs as one workgroup.
pub const SETTLING_SEEN: EntryPoint = EntryPoint { name: "settling_seen", group: 256 };

/// Control points from settled places. It runs with one lane for each place.
pub const SETTLING_POINTS: EntryPoint = EntryPoint { name: "settling_points", group: 64 };

/// The box round all control points. Any number of workgroups share the places.
pub const SETTLING_BOUNDS: EntryPoint = EntryPoint { name: "settling_bounds", group: 256 };

/// The step of each crossing. It runs with one lane for each crossing. Each workgroup writes a row
/// of its measures.
pub const CROSSINGS_MOVE: EntryPoint = EntryPoint { name: "crossings_move", group: 64 };

/// The measures of all workgroups together. It runs as one workgroup.
pub const CROSSINGS_SEEN: EntryPoint = EntryPoint { name: "crossings_seen", group: 256 };

/// Sources that are compiled together, and the entry points in them.
#[derive(Debug, Clone, Copy)]
pub struct KernelProgram {
    /// The name of the program in messages.
    pub name: &'static str,
    /// The files, in order.
    pub sources: &'static [&'static str],
    /// The entry points.
    pub entries: &'static [EntryPoint],
}

/// The schedule per-ring, which makes every mesh that a plan may ask for.
pub const PER_RING: KernelProgram = KernelProgram {
    name: "per-ring",
    sources: &[
        include_str!("common.cl"),
        include_str!("rings.cl"),
        include_str!("scan.cl"),
        include_str!("trajectory.cl"),
        include_str!("share.cl"),
        include_str!("mesh.cl"),
        include_str!("caps.cl"),
    ],
    entries: &[BLOCK_TURNS, YARN_ROLLS, TRAJECTORY, MESH, MESH_ODD, CAPS],
};

/// The paper's schedule, per-yarn, for upright, untwisted, open yarns without caps.
pub const PER_YARN: KernelProgram = KernelProgram {
    name: "per-yarn",
    sources: &[include_str!("common.cl"), include_str!("per_yarn.cl")],
    entries: &[TRAJECTORY_PER_YARN, MESH_PER_YARN],
};

/// Attributes of vertices. The program is compiled at their first use.
pub const ATTRIBUTES: KernelProgram = KernelProgram {
    name: "attributes",
    sources: &[include_str!("common.cl"), include_str!("attributes.cl")],
    entries: &[BLOCK_LENGTHS, YARN_LENGTHS, ATTRIBUTES_OF_TUBES, ATTRIBUTES_OF_CAPS],
};

/// Packed vertices. The program is compiled at their first use.
pub const PACKING: KernelProgram = KernelProgram {
    name: "packing",
    sources: &[
        include_str!("common.cl"),
        include_str!("rings.cl"),
        include_str!("share.cl"),
        include_str!("packed.cl"),
    ],
    entries: &[PACKED, PACKED_ODD, PACKED_CAPS],
};

/// A settling. The program is compiled for the first settler.
pub const SETTLING: KernelProgram = KernelProgram {
    name: "settling",
    sources: &[
        include_str!("settling.cl"),
        include_str!("settling_list.cl"),
        include_str!("settling_scan.cl"),
        include_str!("settling_contact.cl"),
        include_str!("settling_pull.cl"),
        include_str!("settling_step.cl"),
        include_str!("settling_points.cl"),
    ],
    entries: &[
        SETTLING_CHORDS,
        SETTLING_EXTENT,
        SETTLING_CELL_COUNT,
        SETTLING_CELL_FILL,
        SETTLING_COUNT,
        SETTLING_FILL,
        SETTLING_SCAN,
        SETTLING_SCAN_ADD,
        SETTLING_PULL_WEIGHTED,
        SETTLING_PULL_BLOCK,
        SETTLING_STEP_WEIGHTED,
        SETTLING_STEP_BLOCK,
        SETTLING_ENDS,
        SETTLING_SEEN,
        SETTLING_POINTS,
        SETTLING_BOUNDS,
    ],
};

/// Crossings at rest. The program is compiled for the first settler of crossings.
pub const CROSSINGS: KernelProgram = KernelProgram {
    name: "crossings",
    sources: &[
        include_str!("crossings.cl"),
        include_str!("crossings_passage.cl"),
        include_str!("crossings_terms.cl"),
        include_str!("crossings_pass.cl"),
    ],
    entries: &[CROSSINGS_MOVE, CROSSINGS_SEEN],
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn workgroups_are_what_the_sources_require() {
        for program in [PER_RING, PER_YARN, ATTRIBUTES, PACKING, SETTLING, CROSSINGS] {
            let source = program.sources.concat();
            for entry in program.entries {
                let head = source.split_once(&format!("void {}(", entry.name)).unwrap().0;
                let attribute = head.rsplit_once("__kernel").unwrap().1;
                if [MESH.name, MESH_ODD.name].contains(&entry.name) {
                    assert!(!attribute.contains("reqd_work_group_size"), "{} takes any", entry.name);
                    continue;
                }
                let macro_name =
                    attribute.split_once("reqd_work_group_size(").unwrap().1.split(',').next().unwrap();
                let defined = source.split_once(&format!("#define {macro_name} ")).unwrap().1;
                assert_eq!(defined.lines().next().unwrap(), entry.group.to_string(), "{}", entry.name);
            }
        }
    }

    #[test]
    fn no_function_of_lower_accuracy_is_called() {
        for program in [PER_RING, PER_YARN, ATTRIBUTES, PACKING, SETTLING, CROSSINGS] {
            let source = program.sources.concat();
            // These four names begin like functions of low accuracy, but are names of values.
            let source = ["half_width", "half_height", "half_gap", "half_way"]
                .iter()
                .fold(source, |source, name| source.replace(name, ""));
            for word in ["native_", "half_", "fast_", "mad("] {
                assert!(!source.contains(word), "{word} in {}", program.name);
            }
        }
    }
}
