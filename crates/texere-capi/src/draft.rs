//! Drafts, stitch charts and lapping diagrams as pictures.

use std::ffi::{c_char, c_void};

use texere::Structure;
use texere::write::Side;

use crate::argument::text;
use crate::callback_file::{CallbackFile, texere_write_callback};
use crate::design::texere_design;
use crate::error::guard;
use crate::failure::Failure;
use crate::handle::get;
use crate::status::texere_status;
use crate::structure::choice;

/// Draws a design on squared paper, in a `.png` file: the draft or the point paper of woven cloth,
/// the stitch chart of a weft knit, the lapping diagram of a warp knit. `back` is 1 to show the
/// cloth turned over sideways, else 0. An existing file of that name is replaced only once the new
/// one is complete.
///
/// Fails with TEXERE_ARGUMENT for a cloth that is too large to draw, and with TEXERE_IO if the file
/// can't be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_design_draft(
    design: *const texere_design,
    back: u32,
    path: *const c_char,
    path_length: usize,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `path`.
        let path = unsafe { text("path", path, path_length) }?;
        let side = choice("back", back, &[Side::Face, Side::Back])?;
        match &get(design)?.structure {
            Structure::Woven(woven) => texere::write::draft(woven.cloth(), woven.draft(), side, path)?,
            Structure::Weft(knit) => texere::write::knit_draft(knit, side, path)?,
            Structure::Warp(knit) => texere::write::warp_draft(knit, side, path)?,
            _ => return Err(undrawn()),
        };
        Ok(())
    })
}

/// Draws a design on squared paper, and hands the bytes of a `.png` file to `callback`: the bytes
/// that `texere_design_draft` writes. The callback runs on the calling thread, with `user` as its
/// first argument.
///
/// Fails with TEXERE_ARGUMENT for a cloth that is too large to draw, and with TEXERE_CANCELLED if
/// the callback returned a number other than 0. The bytes that came before then are not a complete
/// file.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_design_draft_to(
    design: *const texere_design,
    back: u32,
    callback: texere_write_callback,
    user: *mut c_void,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for the callback.
        let file = unsafe { CallbackFile::new(callback, user) }?;
        let side = choice("back", back, &[Side::Face, Side::Back])?;
        match &get(design)?.structure {
            Structure::Woven(woven) => texere::write::draft_to(woven.cloth(), woven.draft(), side, file)?,
            Structure::Weft(knit) => texere::write::knit_draft_to(knit, side, file)?,
            Structure::Warp(knit) => texere::write::warp_draft_to(knit, side, file)?,
            _ => return Err(undrawn()),
        };
        Ok(())
    })
}

fn undrawn() -> Failure {
    Failure::argument("the design has a structure that no draft shows")
}
