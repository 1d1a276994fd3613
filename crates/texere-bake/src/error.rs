//! Errors of baking.

use std::path::PathBuf;

use texere_core::OutOfMemory;
use texere_formats::{Refusal, WriteError};
use texere_render::RenderError;
use thiserror::Error;

/// The reason why a cloth can't be baked, or its maps can't be written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum BakeError {
    /// The design can't be tiled, or its yarns can't come to rest.
    #[error(transparent)]
    Design(#[from] Refusal),
    /// The area has no size, or its numbers are not finite.
    #[error("an area of {} by {} mm at ({}, {}) can't be baked", .size[0], .size[1], .low[0], .low[1])]
    Area {
        /// The area's lower left corner, mm.
        low: [f64; 2],
        /// The area's width and height, mm.
        size: [f64; 2],
    },
    /// The size of a texel is not a finite number above zero.
    #[error("texels of {mm} mm can't be baked: they must have a finite size above 0")]
    Texel {
        /// The size that was asked for, mm.
        mm: f64,
    },
    /// The maps would have too many texels.
    #[error(
        "maps of {width} × {height} texels; each side may have {side} at most, and all {limit}: take larger texels, \
         or a smaller area"
    )]
    TooLarge {
        /// The maps' width, texels.
        width: u64,
        /// The maps' height, texels.
        height: u64,
        /// The most texels along a side.
        side: u32,
        /// The most texels of a map.
        limit: u64,
    },
    /// The area shows no yarn.
    #[error("no yarn lies in the area")]
    Empty,
    /// The device can't draw.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// Memory is short.
    #[error(transparent)]
    Memory(#[from] OutOfMemory),
    /// A file can't be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// A map or a document of the folder can't be encoded or written.
    #[error("can't write {}", .path.display())]
    Image {
        /// The file, or the folder of the maps.
        path: PathBuf,
        /// The error of the encoder or of the file system.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
    /// The progress callback asked to stop.
    #[error("cancelled")]
    Cancelled,
}
