//! Cloth baked to maps that tile, for programs that show cloth on a plane (feature `bake`).
//!
//! | to | use |
//! |---|---|
//! | bake a design | [`bake`](fn@bake) with [`Options`], which gives a [`Material`] |
//! | write maps, U3M and MaterialX into a folder | [`Material::write`] |
//! | have the maps in memory | [`Material::front`], [`Material::back`]: [`Maps`] |
//! | have the ambient occlusion of any heights | [`occlusion`] |
//!
//! [`bake`](fn@bake) has an example.

pub use texere_bake::{BakeError, Maps, Material, Options, Side, bake, occlusion};
