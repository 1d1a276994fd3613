//! What the GPU backends of texere share in addition to the core: tables, uploads, constants and
//! schedules. This crate uses no GPU interface.
//!
//! | what a GPU backend needs | here |
//! |---|---|
//! | tables that its kernels read beside control points and blocks | [`YarnRow`], [`CapRow`], [`Params`], [`part_rows`], [`cap_pattern`] |
//! | tables of a settling, and what comes back in them | [`PlaceRow`], [`StrandRow`], [`ChordRow`], [`SettlingParams`], [`ExtentRow`], [`SeenRow`] |
//! | tables of crossings | [`CrossingsParams`], [`ThreadRow`], [`CrossingSite`], [`CrossingsSeenRow`] |
//! | tables that turn settled places into control points, and boxes round these points | [`SettledParams`], [`SettledRow`], [`BoundsRow`] |
//! | uploads of control points with virtual ends | [`YarnEnds`], [`PaddedUpload`] |
//! | the constants that kernels and shaders share with the core | [`prelude()`] |
//! | the chunk whose tables lie in a slot, checked so that no kernel has to check a bound | [`LoadedChunk`] |
//! | a device's name and capabilities under a schedule, and what the schedule leaves out | [`device_name`], [`capabilities`], [`check_schedule`], [`serial_unsupported`] |
//! | the memory that a plan's work takes | [`device_buffers`], [`host_bytes_beside_gpu`] |
//!
//! ```
//! use texere_core::backend::Plan;
//! use texere_core::{ControlPoint, Limits, Settings, Yarn, Yarns};
//! use texere_gpu::{Params, YarnRow};
//! let mut yarns = Yarns::builder();
//! yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
//! let plan = Plan::new(yarns.build()?.layout().clone(), Settings::default())?;
//! assert_eq!(YarnRow::all(&plan)[0].rings, 5);
//! for chunk in plan.chunks(&Limits::NONE)? {
//!     assert_eq!(Params::new(&plan, &chunk).sides, 6);
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod crossings;
mod loaded;
mod memory;
mod prelude;
mod schedule;
mod settled;
mod settling;
mod tables;
mod upload;

pub use crossings::{
    CROSSINGS_PASSES, CrossingSite, CrossingsParams, CrossingsSeenRow, ThreadRow, crossings_batches,
    crossings_pass_bytes,
};
pub use loaded::LoadedChunk;
pub use memory::{device_buffers, host_bytes_beside_gpu};
pub use prelude::{CONSTANTS, CROSSINGS_CONSTANTS, Constant, Language, SETTLING_CONSTANTS, Value, prelude};
pub use schedule::{capabilities, check_schedule, device_name, serial_unsupported};
pub use settled::{BoundsRow, SettledParams, SettledRow};
pub use settling::{
    ChordRow, EXTENT_GROUPS, ExtentRow, PlaceRow, SeenRow, SettlingParams, StrandRow, settles_flattened,
    settling_pass_bytes,
};
pub use tables::{CapRow, Params, YarnRow, cap_pattern, lean_count, lean_rows, part_rows};
pub use upload::{PaddedUpload, YarnEnds};
