//! Cloth baked to maps: what a plane needs to look like the yarns' geometry.
//!
//! [`bake`] lets one repeat of a design come to rest amid copies of itself, looks at it straight
//! from above its face and its back, and keeps what it sees in [`Maps`]: colour, share of yarn,
//! normal, height, roughness, ambient occlusion, and which yarn lies where. The maps have the
//! cloth's true size, and go on at their edges. [`Material::write`] puts them into a folder with
//! the documents that other programs open.
//!
//! | file | holds |
//! |---|---|
//! | `NAME.u3m` | the material with its size, weight and thickness: U3M 1.1 |
//! | `NAME.u3ma` | the same material and its maps in one file |
//! | `NAME.mtlx` | the face as a MaterialX surface, in its true size |
//! | `textures/{front,back}_*.{png,exr}` | the maps |
//! | `yarns.json` | the yarns that the numbers of `*_yarn` stand for |
//! | `preview.png` | a picture of the face |
//!
//! ```no_run
//! use std::ops::ControlFlow;
//! use texere_bake::{Options, bake};
//! use texere_render::Renderer;
//! # fn example(device: &dyn texere_core::Backend, renderer: &Renderer) -> Result<(), Box<dyn std::error::Error>> {
//! let design = texere_formats::read("designs/denim.toml")?;
//! let goes_on = |_| ControlFlow::Continue(());
//! let material = bake(design, device, renderer, &Options::default(), goes_on)?;
//! material.write("denim")?;
//! # Ok(())
//! # }
//! ```

mod archive;
mod area;
mod bake;
mod error;
mod gaps;
mod images;
mod maps;
mod material;
mod mtlx;
mod occlusion;
mod side;
mod texel;
mod u3m;

pub use area::Area;
pub use bake::{Options, bake};
pub use error::BakeError;
pub use maps::Maps;
pub use material::Material;
pub use occlusion::occlusion;
pub use side::Side;
