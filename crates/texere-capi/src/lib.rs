//! texere for C, and for every language that calls C.
//!
//! ```text
//! texere_device_open ─┐                     ┌> texere_live_of_cloth ─> texere_live_update
//! texere_design_read ─┴> texere_cloth_rest ─┴> texere_cloth_yarns ─┐
//!                                             ┌────────────────────┘
//!                                             └> texere_plan_new ─> texere_plan_mesh
//! ```
//!
//! `include/texere.h` is generated from this crate by cbindgen, and a test fails if it is out of
//! date. docs/C.md describes the installation and a first mesh.
//!
//! # How calls work
//!
//! - A function that can fail returns a [`texere_status`]. [`texere_error_message`] says in words
//!   what went wrong, and [`texere_error_place`] where in a design's file.
//! - A handle is a number with the type of a pointer. The library looks it up in a table and never
//!   dereferences it. A handle that was freed, or that is of another kind, is therefore refused.
//! - A `_free` function does nothing for a null handle, and for one that was freed already.
//! - Handles may be used by several threads at once, unless their description says that one thread
//!   at a time may use them. A handle that is freed while another thread's call uses it lives until
//!   that call ends.
//! - Strings are UTF-8 with a length in bytes. Strings that the library lends end with a zero byte.
//! - Lengths are in mm, angles in radians.
//!
//! # Safety
//!
//! The description of each function says what the library reads or writes through a pointer. The
//! pointers that a program passes have to be valid for that. Null and misaligned pointers are
//! refused.
#![allow(non_camel_case_types, reason = "the names are those of the header")]
#![allow(clippy::missing_safety_doc, reason = "the head of the crate says it for all functions")]

mod argument;
mod callback;
mod callback_file;
mod check;
mod cloth;
mod design;
mod device;
mod draft;
#[cfg(feature = "render")]
mod drawing;
mod edits;
mod error;
mod failure;
mod finish;
mod handle;
mod lendable;
mod lent;
mod live;
mod live_attributes;
mod live_mesh;
mod material;
mod measures;
mod mesh;
mod outputs;
mod picker;
mod picture;
mod plan;
mod renderer;
mod run;
mod session;
mod settings;
mod shafts;
mod sized;
mod status;
mod stream;
mod structure;
#[cfg(not(feature = "render"))]
mod undrawn;
mod view;
mod warp;
mod weft;
mod woven;
mod write;
mod yarns;

pub use callback_file::*;
pub use check::*;
pub use cloth::*;
pub use design::*;
pub use device::*;
pub use draft::*;
pub use edits::*;
pub use error::*;
pub use finish::*;
pub use lent::*;
pub use live::*;
pub use live_attributes::*;
pub use live_mesh::*;
pub use material::*;
pub use measures::*;
pub use mesh::*;
pub use outputs::*;
pub use picker::*;
pub use picture::*;
pub use plan::*;
pub use renderer::*;
pub use run::*;
pub use session::*;
pub use settings::*;
pub use shafts::*;
pub use status::*;
pub use stream::*;
pub use structure::*;
pub use view::*;
pub use warp::*;
pub use weft::*;
pub use woven::*;
pub use write::*;
pub use yarns::*;

/// The number of the binary interface. A program compares this number of its header with what
/// `texere_abi` of the loaded library returns. If the two differ, the program can't use that
/// library.
pub const TEXERE_ABI: u32 = 1;

/// The number of the binary interface of the loaded library: TEXERE_ABI of the header that belongs
/// to it.
#[unsafe(no_mangle)]
pub extern "C" fn texere_abi() -> u32 {
    TEXERE_ABI
}

/// The version of this library, such as "0.1.0". The string ends with a zero byte and is valid as
/// long as the library is loaded.
#[unsafe(no_mangle)]
pub extern "C" fn texere_version() -> *const std::ffi::c_char {
    const VERSION: &std::ffi::CStr =
        match std::ffi::CStr::from_bytes_with_nul(concat!(env!("CARGO_PKG_VERSION"), "\0").as_bytes()) {
            Ok(version) => version,
            Err(_) => c"",
        };
    VERSION.as_ptr()
}
