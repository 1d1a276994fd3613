//! The WGSL shaders of texere: sources, entry points, workgroup sizes and bindings. This crate uses
//! no GPU interface; `texere-wgpu` runs the shaders.
//!
//! | file | entry points | work |
//! |---|---|---|
//! | `common.wgsl` | | tables, turn, spline, frame, vertex: stands before each of the files below but `unpack.wgsl` |
//! | `rings.wgsl` | | a block's rings in workgroup memory: stands before `trajectory`, `mesh` and `packed` |
//! | `share.wgsl` | | how lanes share a ring's stores: stands before `mesh` and `packed` |
//! | `scan.wgsl` | `block_turns`, `yarn_rolls` | the roll at each block's start |
//! | `trajectory.wgsl` | `trajectory` | stage 1 |
//! | `mesh.wgsl` | `mesh`, `mesh_odd` | stage 2 with stage 1 in it |
//! | `caps.wgsl` | `caps` | closed ends |
//! | `packed.wgsl` | `packed`, `packed_odd`, `packed_caps` | stage 2 with stage 1 in it, as packed vertices |
//! | `unpack.wgsl` | | how a caller's shaders unpack packed vertices |
//! | `attributes.wgsl` | `block_lengths`, `yarn_lengths`, `attributes`, `cap_attributes` | attributes of vertices |
//! | `per_yarn.wgsl` | `trajectory_per_yarn`, `mesh_per_yarn` | the paper's algorithms 2 and 4 |
//!
//! The shaders that bring yarns to rest are in [`settling`] and [`crossings`], the shaders that
//! make pictures in [`picture`]. Most files have an OpenCL C twin of the same name in
//! `texere-kernels`. The files of [`picture`] and `unpack.wgsl` have none, and the twin of
//! `settling_chords.wgsl` is a part of `settling.cl`.
//!
//! ```
//! use texere_shaders::{MESH, Resource};
//! assert!(MESH.source.contains("fn mesh("));
//! assert!(MESH.bindings.iter().any(|binding| binding.resource == Resource::Vertices));
//! ```

pub mod crossings;
pub mod picture;
pub mod settling;

/// The grid of a launch of `workgroups`: columns, rows. No side is longer than 65,535, which every
/// device allows. The grid has as few rows as possible, and then as few columns. Workgroups without
/// work take time, too, and the grid has fewer of them than rows.
///
/// ```
/// assert_eq!(texere_shaders::grid(65_535), (65_535, 1));
/// assert_eq!(texere_shaders::grid(65_537), (32_769, 2));
/// ```
#[must_use]
pub const fn grid(workgroups: u32) -> (u32, u32) {
    let rows = workgroups.div_ceil(65_535);
    if rows == 0 { (0, 0) } else { (workgroups.div_ceil(rows), rows) }
}

/// A resource that a shader reads or writes. Its number is that of its binding in group 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[repr(u32)]
pub enum Resource {
    /// `Params` of `texere-gpu`.
    Params = 0,
    /// Control points, from the start of the chunk's window.
    Points = 1,
    /// `YarnRow`s.
    Yarns = 2,
    /// `Block`s of a chunk. In the schedule per-yarn there is one for each part.
    Blocks = 3,
    /// The total turn of each yarn, then the roll at each block's start, then, if any yarn leans,
    /// the lean of each ring: `u32`s.
    Rolls = 4,
    /// `SectionPoint`s of all sections.
    Outlines = 5,
    /// The indices of the quads between a ring and the next.
    Pattern = 6,
    /// `Vertex`es of a chunk.
    Vertices = 7,
    /// Indices of a chunk.
    Indices = 8,
    /// `Ring`s of a chunk.
    Rings = 9,
    /// `CapRow`s of a chunk.
    CapRows = 10,
    /// Cap indices, from `texere_gpu::cap_pattern`.
    CapPattern = 11,
    /// `SettlingParams` of `texere-gpu`.
    SettlingParams = 12,
    /// `PlaceRow`s, and one more, whose first chord is the end of the last interval's chords.
    PlaceRows = 13,
    /// `StrandRow`s.
    Strands = 14,
    /// `Place`s.
    Places = 15,
    /// `ChordRow`s.
    ChordRows = 16,
    /// Chords: for each the point where it begins and the place of its interval, then its span and
    /// the largest half width or half height of its interval.
    Chords = 17,
    /// The position of each cell's first chord, and at the end the number of all chords.
    CellStarts = 18,
    /// Chords, cell by cell.
    CellChords = 19,
    /// The position of each chord's first neighbour, and at the end the number of all neighbours.
    ListStarts = 20,
    /// The neighbours of all chords.
    Neighbours = 21,
    /// The length that each interval should have, mm.
    Lengths = 22,
    /// Pulls at intervals' control points, plane by plane.
    Pulls = 23,
    /// The measures of each workgroup of places.
    SeenRows = 24,
    /// The extent of chords, a row from each workgroup.
    Extents = 25,
    /// Values that are scanned.
    ScanValues = 26,
    /// The sum of each workgroup's values.
    ScanSums = 27,
    /// The last step of each place, mm.
    Steps = 28,
    /// `Place`s after a pass.
    NextPlaces = 29,
    /// The measures of a pass.
    Seen = 30,
    /// `SettledParams` of `texere-gpu`.
    SettledParams = 31,
    /// `SettledRow`s.
    SettledRows = 32,
    /// The box round control points, a row from each workgroup.
    Bounds = 33,
    /// `CrossingsParams` of `texere-gpu`.
    CrossingsParams = 34,
    /// `ThreadRow`s, ends first.
    ThreadRows = 35,
    /// `CrossingSite`s of `texere-gpu`.
    Sites = 36,
    /// `CrossingState`s with momentum added, which a pass reads.
    FoundCrossings = 37,
    /// `CrossingState`s without momentum.
    Crossings = 38,
    /// `CrossingState`s with momentum added, which the next pass reads.
    NextCrossings = 39,
    /// The measures of each workgroup of crossings.
    CrossingsGroupRows = 40,
    /// The measures of each pass since the host last waited for the device.
    CrossingsPassRows = 41,
    /// For each block, the length of its yarn up to the block's first ring: `ArcLength`s.
    ArcLengths = 42,
    /// `Attribute`s of a chunk.
    Attributes = 43,
    /// `PackedVertex`es of a chunk.
    Packed = 44,
}

/// How a shader uses a resource.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Access {
    /// A uniform buffer.
    Uniform,
    /// A storage buffer that is only read.
    Read,
    /// A storage buffer that is also written.
    Write,
}

/// A resource that a shader uses, and its access.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Binding {
    /// The resource. Its number is that of the binding.
    pub resource: Resource,
    /// How the shader uses the resource.
    pub access: Access,
}

/// A compute shader.
#[derive(Debug, Clone, Copy)]
pub struct Shader {
    /// The name of the entry point.
    pub entry_point: &'static str,
    /// The WGSL source, complete.
    pub source: &'static str,
    /// The number of lanes of a workgroup, in one dimension.
    pub workgroup: u32,
    /// All resources that the shader uses, sorted by number, in group 0. At most eight are storage
    /// buffers, the number that WebGPU guarantees.
    pub bindings: &'static [Binding],
}

const fn uniform(resource: Resource) -> Binding {
    Binding { resource, access: Access::Uniform }
}

const fn read(resource: Resource) -> Binding {
    Binding { resource, access: Access::Read }
}

const fn write(resource: Resource) -> Binding {
    Binding { resource, access: Access::Write }
}

/// `rings.wgsl` for stages that make only a block's own rings.
macro_rules! rings {
    () => {
        concat!("const RINGS_BEYOND = 0u;\n", include_str!("rings.wgsl"))
    };
}

const SCAN_SOURCE: &str = concat!(include_str!("common.wgsl"), include_str!("scan.wgsl"));
const MESH_SOURCE: &str =
    concat!(include_str!("common.wgsl"), rings!(), include_str!("share.wgsl"), include_str!("mesh.wgsl"));
const PACKED_SOURCE: &str =
    concat!(include_str!("common.wgsl"), rings!(), include_str!("share.wgsl"), include_str!("packed.wgsl"));
const ATTRIBUTES_SOURCE: &str = concat!(include_str!("common.wgsl"), include_str!("attributes.wgsl"));
const PER_YARN_SOURCE: &str = concat!(include_str!("common.wgsl"), include_str!("per_yarn.wgsl"));

/// The turn of each block of a chunk. The shader runs with one workgroup for each row of the
/// chunk's block table.
pub const BLOCK_TURNS: Shader = Shader {
    entry_point: "block_turns",
    source: SCAN_SOURCE,
    workgroup: 64,
    bindings: &[
        uniform(Resource::Params),
        read(Resource::Points),
        read(Resource::Yarns),
        read(Resource::Blocks),
        write(Resource::Rolls),
    ],
};

/// Rolls from turns, in place. The shader runs with one workgroup for each yarn.
pub const YARN_ROLLS: Shader = Shader {
    entry_point: "yarn_rolls",
    source: SCAN_SOURCE,
    workgroup: 256,
    bindings: &[uniform(Resource::Params), read(Resource::Yarns), write(Resource::Rolls)],
};

/// Rings of a chunk. The shader runs with one workgroup for each row of the chunk's block table.
pub const TRAJECTORY: Shader = Shader {
    entry_point: "trajectory",
    source: concat!(include_str!("common.wgsl"), rings!(), include_str!("trajectory.wgsl")),
    workgroup: 64,
    bindings: &[
        uniform(Resource::Params),
        read(Resource::Points),
        read(Resource::Yarns),
        read(Resource::Blocks),
        read(Resource::Rolls),
        write(Resource::Rings),
    ],
};

const MESH_BINDINGS: &[Binding] = &[
    uniform(Resource::Params),
    read(Resource::Points),
    read(Resource::Yarns),
    read(Resource::Blocks),
    read(Resource::Rolls),
    read(Resource::Outlines),
    read(Resource::Pattern),
    write(Resource::Vertices),
    write(Resource::Indices),
];

/// Vertices and indices of a chunk's tubes, for an even number of sides. The shader runs with one
/// workgroup for each row of the chunk's block table.
pub const MESH: Shader =
    Shader { entry_point: "mesh", source: MESH_SOURCE, workgroup: 128, bindings: MESH_BINDINGS };

/// [`MESH`] for an odd number of sides.
pub const MESH_ODD: Shader = Shader { entry_point: "mesh_odd", ..MESH };

/// Vertices and indices of a chunk's caps. The shader runs with one lane for each cap vertex.
pub const CAPS: Shader = Shader {
    entry_point: "caps",
    source: concat!(include_str!("common.wgsl"), include_str!("caps.wgsl")),
    workgroup: 64,
    bindings: &[
        uniform(Resource::Params),
        read(Resource::Points),
        write(Resource::Vertices),
        write(Resource::Indices),
        read(Resource::CapRows),
        read(Resource::CapPattern),
    ],
};

/// Packed vertices of a chunk's tubes, for an even number of sides. The shader runs with one
/// workgroup for each row of the chunk's block table.
pub const PACKED: Shader = Shader {
    entry_point: "packed",
    source: PACKED_SOURCE,
    workgroup: 64,
    bindings: &[
        uniform(Resource::Params),
        read(Resource::Points),
        read(Resource::Yarns),
        read(Resource::Blocks),
        read(Resource::Rolls),
        read(Resource::Outlines),
        write(Resource::Packed),
    ],
};

/// [`PACKED`] for an odd number of sides.
pub const PACKED_ODD: Shader = Shader { entry_point: "packed_odd", ..PACKED };

/// Packed vertices of a chunk's caps. The shader runs with one lane for each cap vertex.
pub const PACKED_CAPS: Shader = Shader {
    entry_point: "packed_caps",
    source: PACKED_SOURCE,
    workgroup: 64,
    bindings: &[
        uniform(Resource::Params),
        read(Resource::Points),
        read(Resource::CapRows),
        write(Resource::Packed),
    ],
};

/// WGSL functions for a caller's shaders that unpack packed vertices: `unpacked_position` and
/// `unpacked_normal`. Put this text before the shader. It binds nothing.
///
/// This vertex shader draws a cloth from its packed vertices.
/// The middle of the cloth lies at (50, 50, 0) mm:
///
/// ```
/// let source = format!("{}{}", texere_shaders::UNPACK, "
///     @group(0) @binding(0) var<uniform> clip_from_cloth: mat4x4<f32>;
///     struct Drawn { @builtin(position) clip: vec4<f32>, @location(0) normal: vec3<f32> }
///     @vertex fn draw(@location(0) position: vec2<u32>, @location(1) normal: vec2<f32>) -> Drawn {
///         let place = unpacked_position(position, vec3(50.0, 50.0, 0.0), 1.0 / 4096.0);
///         return Drawn(clip_from_cloth * vec4(place, 1.0), unpacked_normal(normal));
///     }
/// ");
/// assert!(source.contains("fn unpacked_position("));
/// ```
pub const UNPACK: &str = include_str!("unpack.wgsl");

/// The length of each block of a chunk. The shader runs with one workgroup for each row of the
/// chunk's block table.
pub const BLOCK_LENGTHS: Shader = Shader {
    entry_point: "block_lengths",
    source: ATTRIBUTES_SOURCE,
    workgroup: 64,
    bindings: &[
        uniform(Resource::Params),
        read(Resource::Points),
        read(Resource::Yarns),
        read(Resource::Blocks),
        write(Resource::ArcLengths),
    ],
};

/// Lengths along yarns up to each block's start, in place. The shader runs with one workgroup for
/// each yarn.
pub const YARN_LENGTHS: Shader = Shader {
    entry_point: "yarn_lengths",
    source: ATTRIBUTES_SOURCE,
    workgroup: 256,
    bindings: &[uniform(Resource::Params), read(Resource::Yarns), write(Resource::ArcLengths)],
};

/// Attributes of a chunk's tubes. The shader runs with one workgroup for each row of the chunk's
/// block table.
pub const ATTRIBUTES_OF_TUBES: Shader = Shader {
    entry_point: "attributes",
    source: ATTRIBUTES_SOURCE,
    workgroup: 64,
    bindings: &[
        uniform(Resource::Params),
        read(Resource::Points),
        read(Resource::Yarns),
        read(Resource::Blocks),
        write(Resource::ArcLengths),
        write(Resource::Attributes),
    ],
};

/// Attributes of a chunk's caps. The shader runs with one lane for each cap vertex.
pub const ATTRIBUTES_OF_CAPS: Shader = Shader {
    entry_point: "cap_attributes",
    source: ATTRIBUTES_SOURCE,
    workgroup: 64,
    bindings: &[uniform(Resource::Params), read(Resource::CapRows), write(Resource::Attributes)],
};

/// The paper's algorithm 2. It runs with one lane for each part of the chunk. A part is a run of
/// one yarn's rings.
pub const TRAJECTORY_PER_YARN: Shader = Shader {
    entry_point: "trajectory_per_yarn",
    source: PER_YARN_SOURCE,
    workgroup: 64,
    bindings: &[
        uniform(Resource::Params),
        read(Resource::Points),
        read(Resource::Yarns),
        read(Resource::Blocks),
        write(Resource::Rings),
    ],
};

/// The paper's algorithm 4. It runs with one lane for each part of the chunk.
pub const MESH_PER_YARN: Shader = Shader {
    entry_point: "mesh_per_yarn",
    source: PER_YARN_SOURCE,
    workgroup: 64,
    bindings: &[
        uniform(Resource::Params),
        read(Resource::Yarns),
        read(Resource::Blocks),
        read(Resource::Outlines),
        read(Resource::Pattern),
        write(Resource::Vertices),
        write(Resource::Indices),
        write(Resource::Rings),
    ],
};

/// All shaders of meshes, attributes and packed vertices.
pub const ALL: [&Shader; 15] = [
    &BLOCK_TURNS,
    &YARN_ROLLS,
    &TRAJECTORY,
    &MESH,
    &MESH_ODD,
    &CAPS,
    &PACKED,
    &PACKED_ODD,
    &PACKED_CAPS,
    &BLOCK_LENGTHS,
    &YARN_LENGTHS,
    &ATTRIBUTES_OF_TUBES,
    &ATTRIBUTES_OF_CAPS,
    &TRAJECTORY_PER_YARN,
    &MESH_PER_YARN,
];
