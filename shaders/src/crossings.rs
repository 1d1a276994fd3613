//! The shaders that bring crossings to rest.
//!
//! | file | entry points | work |
//! |---|---|---|
//! | `crossings.wgsl` | | tables, sites, the block that is gathered at a site: stands before each of the files below |
//! | `crossings_passage.wgsl` | | a thread that changes sides |
//! | `crossings_terms.wgsl` | | the energy's terms at a crossing |
//! | `crossings_pass.wgsl` | `crossings_move`, `crossings_seen` | the step of each crossing; the measures of a pass |

use crate::{Resource, Shader, read, uniform, write};

const SOURCE: &str = concat!(
    include_str!("crossings.wgsl"),
    include_str!("crossings_passage.wgsl"),
    include_str!("crossings_terms.wgsl"),
    include_str!("crossings_pass.wgsl")
);

/// The step of each crossing. It runs with one lane for each crossing. Each workgroup writes a row
/// of its measures.
pub const MOVE: Shader = Shader {
    entry_point: "crossings_move",
    source: SOURCE,
    workgroup: 64,
    bindings: &[
        uniform(Resource::CrossingsParams),
        read(Resource::ThreadRows),
        read(Resource::Sites),
        read(Resource::FoundCrossings),
        write(Resource::Crossings),
        write(Resource::NextCrossings),
        write(Resource::CrossingsGroupRows),
    ],
};

/// The measures of a pass, from the rows of all workgroups. It runs as one workgroup.
pub const SEEN: Shader = Shader {
    entry_point: "crossings_seen",
    source: SOURCE,
    workgroup: 256,
    bindings: &[
        uniform(Resource::CrossingsParams),
        write(Resource::CrossingsGroupRows),
        write(Resource::CrossingsPassRows),
    ],
};

/// All shaders of crossings.
pub const ALL: [&Shader; 2] = [&MOVE, &SEEN];
