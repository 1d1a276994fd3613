//! Headless pictures of yarn-level cloth, on wgpu.
//!
//! ```text
//! Yarns ──> Scene ──> screen ──> Picture
//!           chunks    depth,     light
//!                     normals
//! ```
//!
//! A [`Renderer`] is an open device with its shaders, a [`Scene`] is a fabric on it, and a
//! [`Camera`] is a view of the fabric. Compute shaders draw every triangle straight from control
//! points, chunk after chunk, without a mesh. Then the samples of the screen are lit, and pixels
//! are made from them.

mod axes;
mod background;
mod camera;
mod error;
mod extent;
mod hairs;
mod layers;
mod mapped;
mod memory;
mod projection;
mod raster;
mod rasteriser;
mod renderer;
mod scene;
mod screen;
mod seen;
#[cfg(test)]
mod tests;
mod uniform;
mod watch;

pub use background::Background;
pub use camera::{Camera, Cut, Pose};
pub use error::RenderError;
pub use extent::Extent;
pub use layers::Layers;
pub use renderer::Renderer;
pub use scene::{DevicePicture, Picture, PictureTimings, Quality, Scene, picture_sides};
pub use seen::Seen;
pub use uniform::surface_width;
