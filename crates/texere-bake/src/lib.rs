//! Cloth baked to maps: what a plane needs to look like the yarns' geometry.
//!
//! [`bake()`] lets one repeat of a design come to rest amid copies of itself. It then looks
//! straight at the face and at the back of the repeat, and keeps what it sees in [`Maps`]: colour,
//! share of yarn, normal, height, roughness, ambient occlusion, which yarn lies where, and the
//! place on that yarn. The maps have the cloth's true size, and they tile: what leaves them at one
//! edge comes in at the opposite one. [`BakedCloth::write`] puts the maps into a folder, with the
//! documents that other programs open.
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
//! use texere_bake::{BakeOptions, bake};
//! use texere_render::Renderer;
//! # fn example(device: &dyn texere_core::Backend, renderer: &Renderer) -> Result<(), Box<dyn std::error::Error>> {
//! let design = texere_formats::read("designs/denim.toml")?;
//! let goes_on = |_| ControlFlow::Continue(());
//! let material = bake(design, device, renderer, &BakeOptions::default(), goes_on)?;
//! material.write("denim")?;
//! # Ok(())
//! # }
//! ```

mod archive;
mod area;
mod bake;
mod baked_cloth;
mod error;
mod gaps;
mod images;
mod maps;
mod mtlx;
mod occlusion;
mod side;
mod texel;
mod u3m;

use area::Area;
pub use bake::{BakeOptions, bake};
pub use baked_cloth::BakedCloth;
pub use error::BakeError;
pub use maps::Maps;
pub use occlusion::occlusion;
use side::Side;
