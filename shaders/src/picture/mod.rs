//! The shaders that make pictures; `texere-render` runs them.
//!
//! | file | entry points | work |
//! |---|---|---|
//! | `view.wgsl` | | the view: stands before each of the others |
//! | `chunk.wgsl` | | a chunk's mesh: stands before the two that follow |
//! | `sieve.wgsl` | `sieve` | the triangles that a sample may see |
//! | `yarns.wgsl` | `yarn_corner`, `yarn_sample` | what is nearest in each sample, unlit |
//! | `screen.wgsl` | `screen` | reads that back: stands before the two that follow |
//! | `visibility.wgsl` | `visibility` | ambient occlusion and shadow, on the screen |
//! | `shade.wgsl` | `shade` | light, tone mapping, the picture's own pixels |

/// `sieve`.
pub const SIEVE: &str =
    concat!(include_str!("view.wgsl"), include_str!("chunk.wgsl"), include_str!("sieve.wgsl"));

/// `yarn_corner` and `yarn_sample`.
pub const YARNS: &str =
    concat!(include_str!("view.wgsl"), include_str!("chunk.wgsl"), include_str!("yarns.wgsl"));

/// `screen` and `visibility`.
pub const VISIBILITY: &str =
    concat!(include_str!("view.wgsl"), include_str!("screen.wgsl"), include_str!("visibility.wgsl"));

/// `screen` and `shade`.
pub const SHADE: &str =
    concat!(include_str!("view.wgsl"), include_str!("screen.wgsl"), include_str!("shade.wgsl"));
