//! Pictures of cloth, lit and shaded on a device of `wgpu` (feature `render`).
//!
//! | to | use |
//! |---|---|
//! | open a device that renders | [`open_renderer`], which gives a [`Renderer`] |
//! | send cloth to it | [`Renderer::scene`], which gives a [`Scene`] |
//! | choose the view | [`Camera`], [`Pose`], [`Extent`], [`Cut`] |
//! | make a picture in memory | [`Scene::picture`], which gives a [`Picture`] |
//! | choose the quality, and the background | [`Quality`], [`Background`] |
//! | know which yarn a pixel shows | [`Scene::seen_at`], which gives a [`Seen`] |
//! | have depths, normals and yarns of all pixels | [`Scene::layers`], which gives [`Layers`] |
//!
//! [`open_renderer`] has an example. With the feature `bake`, `picture::bake` makes maps of cloth
//! that tile.

#[cfg(feature = "bake")]
pub mod bake;

pub use texere_render::{
    Background, Camera, Cut, DevicePicture, Extent, Layers, Picture, PictureTimings, Pose, Quality,
    RenderError, Renderer, Scene, Seen, picture_sides,
};

pub use crate::device::{open_renderer, picture_device};
