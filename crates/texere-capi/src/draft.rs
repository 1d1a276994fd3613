//! Drafts, stitch charts and lapping diagrams as pictures.

use std::ffi::c_char;

use texere::Structure;
use texere::write::Side;

use crate::argument::text;
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
            _ => return Err(Failure::argument("the design has a structure that no draft shows")),
        };
        Ok(())
    })
}
