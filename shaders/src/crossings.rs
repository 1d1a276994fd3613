//! The shaders that bring crossings to rest.
//!
//! | file | entry points | work |
//! |---|---|---|
//! | `crossings.wgsl` | | tables, sites, what is gathered at one: stands before each of the others |
//! | `crossings_passage.wgsl` | | a thread that changes sides |
//! | `crossings_terms.wgsl` | | the energy's terms at a crossing |
//! | `crossings_pass.wgsl` | `crossings_move`, `crossings_seen` | the step of each crossing; what a pass has seen |

use crate::{Resource, Shader, read, uniform, write};

const SOURCE: &str = concat!(
    include_str!("crossings.wgsl"),
    include_str!("crossings_passage.wgsl"),
    include_str!("crossings_terms.wgsl"),
    include_str!("crossings_pass.wgsl")
);

/// The step of each crossing. A lane for each crossing; each workgroup writes a row of what it has
/// seen.
pub const MOVE: Shader = Shader {
    entry_point: "crossings_move",
    source: SOURCE,
    workgroup: 64,
    bindings: &[
        uniform(Resource::CrossingsParams),
        read(Resource::ThreadRows),
        read(Resource::Ups),
        read(Resource::FoundCrossings),
        write(Resource::Crossings),
        write(Resource::NextCrossings),
        write(Resource::CrossingsGroupRows),
    ],
};

/// What a pass has seen, from the rows of all workgroups. One workgroup.
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
