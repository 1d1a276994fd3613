//! The shaders that bring yarns to rest.
//!
//! | file | entry points | work |
//! |---|---|---|
//! | `settling.wgsl` | | tables, places, intervals, chords: stands before each of the files below but the scan |
//! | `settling_chords.wgsl` | `settling_chords` | the chords of all intervals |
//! | `settling_list.wgsl` | `settling_extent`, `settling_cell_count`, `settling_cell_fill`, `settling_count`, `settling_fill` | each chord's neighbours |
//! | `settling_scan.wgsl` | `settling_scan`, `settling_scan_add` | sums of all counts before each one |
//! | `settling_contact.wgsl` | | the places where two intervals come near one another: stands before `settling_pull.wgsl` |
//! | `settling_pull.wgsl` | `settling_pull_weighted`, `settling_pull_block`, `settling_seen` | the pulls at the control points of an interval; the measures of a pass |
//! | `settling_step.wgsl` | `settling_step_weighted`, `settling_step_block`, `settling_ends` | the step of each control point; the places beyond yarns' ends |
//! | `settling_points.wgsl` | `settling_points`, `settling_bounds` | control points from settled places; the box round them |

use crate::{Resource, Shader, read, uniform, write};

const LIST_SOURCE: &str = concat!(include_str!("settling.wgsl"), include_str!("settling_list.wgsl"));
const PULL_SOURCE: &str = concat!(
    include_str!("settling.wgsl"),
    include_str!("settling_contact.wgsl"),
    include_str!("settling_pull.wgsl")
);
const STEP_SOURCE: &str = concat!(include_str!("settling.wgsl"), include_str!("settling_step.wgsl"));

/// Chords from places. The shader runs with one lane for each chord.
pub const CHORDS: Shader = Shader {
    entry_point: "settling_chords",
    source: concat!(include_str!("settling.wgsl"), include_str!("settling_chords.wgsl")),
    workgroup: 64,
    bindings: &[
        uniform(Resource::SettlingParams),
        read(Resource::PlaceRows),
        read(Resource::Places),
        read(Resource::ChordRows),
        write(Resource::Chords),
    ],
};

/// The longest chord, and the box round the middles of all chords. Each workgroup writes a row.
pub const EXTENT: Shader = Shader {
    entry_point: "settling_extent",
    source: LIST_SOURCE,
    workgroup: 256,
    bindings: &[uniform(Resource::SettlingParams), read(Resource::Chords), write(Resource::Extents)],
};

/// The number of chords in each cell. The shader runs with one lane for each chord.
pub const CELL_COUNT: Shader = Shader {
    entry_point: "settling_cell_count",
    source: LIST_SOURCE,
    workgroup: 64,
    bindings: &[uniform(Resource::SettlingParams), read(Resource::Chords), write(Resource::CellStarts)],
};

/// Chords sorted by cells. The shader runs with one lane for each chord.
pub const CELL_FILL: Shader = Shader {
    entry_point: "settling_cell_fill",
    bindings: &[
        uniform(Resource::SettlingParams),
        read(Resource::Chords),
        write(Resource::CellStarts),
        write(Resource::CellChords),
    ],
    ..CELL_COUNT
};

/// Replaces each value by the sum of the values before it. A workgroup scans [`SCAN_VALUES`]
/// values.
pub const SCAN: Shader = Shader {
    entry_point: "settling_scan",
    source: include_str!("settling_scan.wgsl"),
    workgroup: 256,
    bindings: &[write(Resource::ScanValues), write(Resource::ScanSums)],
};

/// Adds to each value the sum of all workgroups before its own. The workgroups are those of
/// [`SCAN`].
pub const SCAN_ADD: Shader = Shader { entry_point: "settling_scan_add", ..SCAN };

/// The number of values that a workgroup of [`SCAN`] scans.
pub const SCAN_VALUES: u32 = 1024;

/// The number of each chord's neighbours. The shader runs with one lane for each chord.
pub const COUNT: Shader = Shader {
    entry_point: "settling_count",
    source: LIST_SOURCE,
    workgroup: 64,
    bindings: &[
        uniform(Resource::SettlingParams),
        read(Resource::PlaceRows),
        read(Resource::Strands),
        read(Resource::ChordRows),
        read(Resource::Chords),
        read(Resource::CellStarts),
        read(Resource::CellChords),
        write(Resource::ListStarts),
        write(Resource::Neighbours),
    ],
};

/// The neighbours of each chord. The shader runs with one lane for each chord.
pub const FILL: Shader = Shader { entry_point: "settling_fill", ..COUNT };

/// Pulls at each interval's points, in the weighted form (`Form::Weighted` of texere-core's
/// settling). The shader runs with one lane for each place. Each workgroup writes a row of its
/// measures.
pub const PULL_WEIGHTED: Shader = Shader {
    entry_point: "settling_pull_weighted",
    source: PULL_SOURCE,
    workgroup: 64,
    bindings: &[
        uniform(Resource::SettlingParams),
        read(Resource::PlaceRows),
        read(Resource::Places),
        read(Resource::Chords),
        read(Resource::ListStarts),
        read(Resource::Neighbours),
        read(Resource::Lengths),
        write(Resource::Pulls),
        write(Resource::SeenRows),
    ],
};

/// [`PULL_WEIGHTED`] in the block form.
pub const PULL_BLOCK: Shader = Shader { entry_point: "settling_pull_block", ..PULL_WEIGHTED };

/// The step of each point, in the weighted form. The shader runs with one lane for each place. The
/// longest step goes into the workgroup's row.
pub const STEP_WEIGHTED: Shader = Shader {
    entry_point: "settling_step_weighted",
    source: STEP_SOURCE,
    workgroup: 64,
    bindings: &[
        uniform(Resource::SettlingParams),
        read(Resource::PlaceRows),
        read(Resource::Strands),
        read(Resource::Places),
        write(Resource::Lengths),
        read(Resource::Pulls),
        write(Resource::SeenRows),
        write(Resource::Steps),
        write(Resource::NextPlaces),
    ],
};

/// [`STEP_WEIGHTED`] in the block form.
pub const STEP_BLOCK: Shader = Shader { entry_point: "settling_step_block", ..STEP_WEIGHTED };

/// The places beyond yarns' ends. The shader runs with one lane for each yarn.
pub const ENDS: Shader = Shader {
    entry_point: "settling_ends",
    source: STEP_SOURCE,
    workgroup: 64,
    bindings: &[uniform(Resource::SettlingParams), read(Resource::Strands), write(Resource::NextPlaces)],
};

/// The measures of a pass, from the rows of all workgroups. The shader runs as one workgroup.
pub const SEEN: Shader = Shader {
    entry_point: "settling_seen",
    source: PULL_SOURCE,
    workgroup: 256,
    bindings: &[uniform(Resource::SettlingParams), write(Resource::SeenRows), write(Resource::Seen)],
};

const POINTS_SOURCE: &str = concat!(include_str!("settling.wgsl"), include_str!("settling_points.wgsl"));

/// Control points from settled places. The shader runs with one lane for each place.
pub const POINTS: Shader = Shader {
    entry_point: "settling_points",
    source: POINTS_SOURCE,
    workgroup: 64,
    bindings: &[
        write(Resource::Points),
        read(Resource::PlaceRows),
        read(Resource::Places),
        uniform(Resource::SettledParams),
        read(Resource::SettledRows),
    ],
};

/// The box round all control points. Any number of workgroups share the places.
pub const BOUNDS: Shader = Shader {
    entry_point: "settling_bounds",
    source: POINTS_SOURCE,
    workgroup: 256,
    bindings: &[
        read(Resource::PlaceRows),
        read(Resource::Places),
        uniform(Resource::SettledParams),
        write(Resource::Bounds),
    ],
};

/// All shaders of settling.
pub const ALL: [&Shader; 16] = [
    &CHORDS,
    &EXTENT,
    &CELL_COUNT,
    &CELL_FILL,
    &SCAN,
    &SCAN_ADD,
    &COUNT,
    &FILL,
    &PULL_WEIGHTED,
    &PULL_BLOCK,
    &STEP_WEIGHTED,
    &STEP_BLOCK,
    &ENDS,
    &SEEN,
    &POINTS,
    &BOUNDS,
];
