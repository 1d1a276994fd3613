//! Cloth baked to maps that tile, for programs that show cloth on a plane (feature `bake`).
//!
//! | to | use |
//! |---|---|
//! | bake a design | [`bake`](fn@bake) with [`BakeOptions`], which gives a [`BakedCloth`] |
//! | write maps, U3M and MaterialX into a folder | [`BakedCloth::write`] |
//! | have the maps in memory | [`BakedCloth::front`], [`BakedCloth::back`]: [`Maps`] |
//! | have the ambient occlusion of any heights | [`occlusion`] |
//!
//! [`bake`](fn@bake) has an example.

pub use texere_bake::{BakeError, BakeOptions, BakedCloth, Maps, bake, occlusion};
