//! The shaders that make pictures. `texere-render` runs them.
//!
//! | file | entry points | work |
//! |---|---|---|
//! | `view.wgsl` | | the view: stands before each of the files below |
//! | `fabric.wgsl` | | a chunk that is drawn without a mesh: stands before all files down to `resolve.wgsl` |
//! | `cull.wgsl` | `cull`, `list_all`, `count_listed`, `count_left` | the blocks that the view may show |
//! | `weights.wgsl` | | how much each corner of a triangle counts |
//! | `keys_64.wgsl`, `keys_32.wgsl` | | the nearest triangle in each sample, by atomics of 64 or of 32 bits |
//! | `cover.wgsl` | | the places of corners on the screen, and the samples that a quad may cover |
//! | `draw.wgsl` | | draws quads and triangles in their samples |
//! | `axes.wgsl`, `axes_level.wgsl`, `axes_rolled.wgsl` | | a block's rings on the screen, for fabrics in which no section turns and for all |
//! | `hair.wgsl` | | the fibres that stand off their yarns |
//! | `hairs.wgsl` | `hairs` | draws the fibres that stand off the yarns of a chunk |
//! | `raster.wgsl` | `raster`, `raster_few`, `raster_many`, `raster_caps` | draws a chunk from its control points |
//! | `kept.wgsl` | | the encoding of a sample until it is lit |
//! | `resolve.wgsl` | `resolve` | works out what each sample shows, from the number of its nearest triangle |
//! | `screen.wgsl` | | reads back what `resolve` has written: stands before `visibility.wgsl` and `shade.wgsl` |
//! | `visibility.wgsl` | `visibility` | ambient occlusion and shadow, on the screen |
//! | `shade.wgsl` | `shade` | light and tone mapping, sample by sample |
//! | `lit.wgsl` | | the encoding of a lit sample |
//! | `gather.wgsl` | `gather` | the pixels of the picture, from the samples in and about each |

/// The view, and the encoding of samples. A shader that draws a mesh into samples by a device's own
/// rasteriser follows this source.
pub const KEPT: &str = concat!(include_str!("view.wgsl"), include_str!("kept.wgsl"));

/// The source that stands before all shaders that draw without a mesh.
macro_rules! fabric {
    () => {
        concat!(include_str!("../common.wgsl"), include_str!("view.wgsl"), include_str!("fabric.wgsl"))
    };
}

/// The source that draws with one kind of keys.
macro_rules! drawing {
    ($keys:literal, $($own:expr),+) => {
        concat!(fabric!(), include_str!($keys), include_str!("cover.wgsl"), $($own),+)
    };
}

/// `raster`, `raster_few`, `raster_many` and `raster_caps` with one kind of keys. The first source
/// is for fabrics in which no section turns, the second for all fabrics.
macro_rules! raster {
    ($keys:literal) => {
        [
            drawing!(
                $keys,
                include_str!("weights.wgsl"),
                include_str!("draw.wgsl"),
                include_str!("axes.wgsl"),
                include_str!("axes_level.wgsl"),
                include_str!("raster.wgsl")
            ),
            drawing!(
                $keys,
                include_str!("weights.wgsl"),
                include_str!("draw.wgsl"),
                rings!(),
                include_str!("axes.wgsl"),
                include_str!("axes_rolled.wgsl"),
                include_str!("raster.wgsl")
            ),
        ]
    };
}

/// `rings.wgsl` for stages that make a block's rings and the ring after them.
macro_rules! rings {
    () => {
        concat!("const RINGS_BEYOND = 1u;\n", include_str!("../rings.wgsl"))
    };
}

/// `cull`, `list_all`, `count_listed` and `count_left`. This source, [`RASTER`],
/// [`RASTER_IN_ROUNDS`], [`HAIRS`], [`HAIRS_IN_ROUNDS`] and [`RESOLVE`] need `texere_gpu::prelude`
/// before them.
pub const CULL: &str = concat!(fabric!(), include_str!("cull.wgsl"));

/// `raster`, `raster_few`, `raster_many` and `raster_caps` for devices with atomics of 64 bits. The
/// first source is for fabrics in which no section turns, the second for all fabrics.
pub const RASTER: [&str; 2] = raster!("keys_64.wgsl");

/// [`RASTER`] for any device.
pub const RASTER_IN_ROUNDS: [&str; 2] = raster!("keys_32.wgsl");

/// `hairs`, for devices with atomics of 64 bits.
pub const HAIRS: &str =
    drawing!("keys_64.wgsl", rings!(), include_str!("hair.wgsl"), include_str!("hairs.wgsl"));

/// [`HAIRS`] for any device.
pub const HAIRS_IN_ROUNDS: &str =
    drawing!("keys_32.wgsl", rings!(), include_str!("hair.wgsl"), include_str!("hairs.wgsl"));

/// `resolve`. The constant of [`hairy`] must come before it.
pub const RESOLVE: &str = concat!(
    fabric!(),
    include_str!("weights.wgsl"),
    include_str!("kept.wgsl"),
    include_str!("hair.wgsl"),
    include_str!("resolve.wgsl")
);

/// The constant that must come before [`RESOLVE`]: whether any yarn has fibres that stand off.
#[must_use]
pub const fn hairy(hairs: bool) -> &'static str {
    if hairs { "const HAIRY = true;\n" } else { "const HAIRY = false;\n" }
}

/// `visibility`.
pub const VISIBILITY: &str =
    concat!(include_str!("view.wgsl"), include_str!("screen.wgsl"), include_str!("visibility.wgsl"));

/// `shade`. The constant of [`far`] must come before it.
pub const SHADE: &str = concat!(
    include_str!("view.wgsl"),
    include_str!("screen.wgsl"),
    include_str!("lit.wgsl"),
    include_str!("shade.wgsl")
);

/// The constant that must come before [`SHADE`]: whether the picture has no `visibility`, because
/// everything that could take light from a place lies too close to it on the screen.
#[must_use]
pub const fn far(far: bool) -> &'static str {
    if far { "const FAR = true;\n" } else { "const FAR = false;\n" }
}

/// `gather`.
pub const GATHER: &str =
    concat!(include_str!("view.wgsl"), include_str!("lit.wgsl"), include_str!("gather.wgsl"));
