//! The shaders that bring yarns to rest.
//!
//! | file | entry points | work |
//! |---|---|---|
//! | `settling.wgsl` | | tables, places, intervals, chords: stands before each of the others but the scan |
//! | `settling_chords.wgsl` | `settling_chords` | where chords lie |
//! | `settling_list.wgsl` | `settling_extent`, `settling_cell_count`, `settling_cell_fill`, `settling_count`, `settling_fill` | each chord's neighbours |
//! | `settling_scan.wgsl` | `settling_scan`, `settling_scan_add` | sums of all counts before each one |
//! | `settling_contact.wgsl` | | where two intervals come near one another: stands before the next one |
//! | `settling_pull.wgsl` | `settling_pull_weighted`, `settling_pull_block`, `settling_seen` | what pulls at the control points of an interval; what a pass has seen |
//! | `settling_step.wgsl` | `settling_step_weighted`, `settling_step_block`, `settling_ends` | the step that each control point takes; places beyond yarns' ends |

use crate::{Resource, Shader, read, uniform, write};

const LIST_SOURCE: &str = concat!(include_str!("settling.wgsl"), include_str!("settling_list.wgsl"));
const PULL_SOURCE: &str = concat!(
    include_str!("settling.wgsl"),
    include_str!("settling_contact.wgsl"),
    include_str!("settling_pull.wgsl")
);
const STEP_SOURCE: &str = concat!(include_str!("settling.wgsl"), include_str!("settling_step.wgsl"));

/// Chords from places: a lane a chord.
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

/// The longest chord and where chords' middles lie: a row a workgroup.
pub const EXTENT: Shader = Shader {
    entry_point: "settling_extent",
    source: LIST_SOURCE,
    workgroup: 256,
    bindings: &[uniform(Resource::SettlingParams), read(Resource::Chords), write(Resource::Extents)],
};

/// How many chords each cell has: a lane a chord.
pub const CELL_COUNT: Shader = Shader {
    entry_point: "settling_cell_count",
    source: LIST_SOURCE,
    workgroup: 64,
    bindings: &[uniform(Resource::SettlingParams), read(Resource::Chords), write(Resource::CellStarts)],
};

/// Each cell's chords: a lane a chord.
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

/// Sums of all values before each one, in place: a workgroup each [`SCAN_VALUES`] of them.
pub const SCAN: Shader = Shader {
    entry_point: "settling_scan",
    source: include_str!("settling_scan.wgsl"),
    workgroup: 256,
    bindings: &[write(Resource::ScanValues), write(Resource::ScanSums)],
};

/// Adds what all groups before have: likewise.
pub const SCAN_ADD: Shader = Shader { entry_point: "settling_scan_add", ..SCAN };

/// Values of a workgroup of [`SCAN`].
pub const SCAN_VALUES: u32 = 1024;

/// How many neighbours each chord has: a lane a chord.
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

/// Each chord's neighbours: a lane a chord.
pub const FILL: Shader = Shader { entry_point: "settling_fill", ..COUNT };

/// What pulls at intervals in the weighted form, and a row of what was seen for each workgroup: a
/// lane a place.
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

/// The same in the block form.
pub const PULL_BLOCK: Shader = Shader { entry_point: "settling_pull_block", ..PULL_WEIGHTED };

/// The step of each control point in the weighted form, and the longest one in each workgroup's
/// row: a lane a place.
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

/// The same in the block form.
pub const STEP_BLOCK: Shader = Shader { entry_point: "settling_step_block", ..STEP_WEIGHTED };

/// Places beyond yarns' ends: a lane a yarn.
pub const ENDS: Shader = Shader {
    entry_point: "settling_ends",
    source: STEP_SOURCE,
    workgroup: 64,
    bindings: &[uniform(Resource::SettlingParams), read(Resource::Strands), write(Resource::NextPlaces)],
};

/// What a pass has seen, from the rows of all workgroups: one workgroup.
pub const SEEN: Shader = Shader {
    entry_point: "settling_seen",
    source: PULL_SOURCE,
    workgroup: 256,
    bindings: &[uniform(Resource::SettlingParams), write(Resource::SeenRows), write(Resource::Seen)],
};

const POINTS_SOURCE: &str = concat!(include_str!("settling.wgsl"), include_str!("settling_points.wgsl"));

/// Control points from places, where yarns have come to rest: a lane a place.
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

/// How far control points reach: any number of workgroups, each of which takes every so many
/// places.
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

/// All of them.
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
