//! Renderers: pictures of yarns, in the caller's memory or in a file.

use std::ffi::{c_char, c_void};
use std::sync::Mutex;

use crate::argument::{check, text};
use crate::callback_file::{CallbackFile, texere_write_callback};
#[cfg(feature = "render")]
use crate::drawing::Drawing;
use crate::error::guard;
use crate::handle::{Handle, alone, clear, free, get, get_any, give};
use crate::picture::{checked, texere_extent, texere_picture, texere_seen};
use crate::run::{reporter, texere_run};
use crate::settings::{chosen, texere_settings};
use crate::status::texere_status;
#[cfg(not(feature = "render"))]
use crate::undrawn::Drawing;
use crate::view::texere_view;
use crate::yarns::texere_yarns;

/// A device that makes pictures, and the yarns that the pictures show. One thread at a time may use
/// it: a call fails with TEXERE_ARGUMENT while a call of another thread is using it.
#[derive(Debug)]
pub struct texere_renderer;

impl Handle for texere_renderer {
    type Value = Mutex<Drawing>;
    const NAME: &str = "renderer";
}

/// Bytes of a pixel in the caller's memory: red, green, blue, alpha.
const PIXEL: usize = 4;

/// Opens a device for pictures: "auto" for the best one, "wgpu", "wgpu:1" and so on. A
/// `name_length` of 0 is "auto".
///
/// Fails with TEXERE_DEVICE if there is no such device, and with TEXERE_UNSUPPORTED if the library
/// was built without pictures.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_renderer_open(
    name: *const c_char,
    name_length: usize,
    out: *mut *mut texere_renderer,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `out` and `name`.
        unsafe {
            clear(out)?;
            let name = text("name", name, name_length)?;
            let drawing = Drawing::open(if name.is_empty() { "auto" } else { name })?;
            give(out, Mutex::new(drawing))
        }
    })
}

/// Sends yarns to a renderer, which shows them from now on in place of those before. `settings` may
/// be null, and then settings that suit a picture apply. Topology and caps of the settings have no
/// effect. `run` may be null.
///
/// Fails with TEXERE_ARGUMENT for settings out of range, and with TEXERE_CANCELLED if `run` was
/// cancelled. After a cancelled call the renderer shows nothing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_renderer_show(
    renderer: *const texere_renderer,
    yarns: *const texere_yarns,
    settings: *const texere_settings,
    run: *const texere_run,
) -> texere_status {
    guard(|| {
        let (yarns, run) = (get(yarns)?, get_any(run)?);
        let given = !settings.is_null();
        // SAFETY: the caller vouches for `settings`.
        let settings = given.then(|| unsafe { chosen(settings, &yarns) }).transpose()?;
        alone(renderer, |drawing| drawing.show(&yarns, settings, reporter(run)))
    })
}

/// Writes the box round the yarns that a renderer shows.
///
/// Fails with TEXERE_ARGUMENT if it shows none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_renderer_extent(
    renderer: *const texere_renderer,
    extent: *mut texere_extent,
) -> texere_status {
    guard(|| {
        check("extent", extent)?;
        let found = alone(renderer, |drawing| drawing.extent())?;
        // SAFETY: the pointer is neither null nor misaligned; the caller vouches for the memory.
        unsafe { extent.write(found) };
        Ok(())
    })
}

/// Makes a picture in the caller's memory. `pixels` has a row of bytes for each row of the picture,
/// from the top. A row has four bytes for each pixel, from the left: red, green, blue (sRGB) and
/// alpha. `pixels->stride` is the number of bytes from one row to the next, at least four times the
/// width. Alpha is 255 unless the background is TEXERE_BACKGROUND_NOTHING. Colours are not
/// multiplied by alpha. `run` may be null.
///
/// Fails with TEXERE_ARGUMENT if the renderer shows no yarns, for a picture that is out of range or
/// larger than the device takes, and for memory that is too small. Fails with TEXERE_CANCELLED if
/// `run` was cancelled. After a failure the memory is as it was.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_renderer_picture(
    renderer: *const texere_renderer,
    picture: *const texere_picture,
    run: *const texere_run,
    pixels: *const texere_view,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `picture`.
        let picture = unsafe { checked(picture) }?;
        let [width, height] = [picture.width, picture.height].map(|side| side as usize);
        check("pixels", pixels)?;
        // SAFETY: the pointer is neither null nor misaligned; the caller vouches for the memory.
        let mut rows = unsafe { pixels.read().rows("pixels", height, width.saturating_mul(PIXEL)) }?;
        let run = get_any(run)?;
        let made = alone(renderer, |drawing| drawing.picture(&picture, reporter(run)))?;
        let lines = made.rgb.chunks_exact(3 * width).zip(made.alpha.chunks_exact(width));
        for (number, (rgb, alpha)) in lines.enumerate() {
            let pixels = rows.row_mut(number).chunks_exact_mut(PIXEL);
            for ((pixel, rgb), alpha) in pixels.zip(rgb.chunks_exact(3)).zip(alpha) {
                pixel[..3].copy_from_slice(rgb);
                pixel[3] = *alpha;
            }
        }
        Ok(())
    })
}

/// Makes a picture in a `.png` file. The file has alpha if the background is
/// TEXERE_BACKGROUND_NOTHING. `run` may be null. An existing file of that name is replaced only
/// once the new one is complete.
///
/// Fails as `texere_renderer_picture` does, and with TEXERE_IO if the file can't be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_renderer_write(
    renderer: *const texere_renderer,
    picture: *const texere_picture,
    run: *const texere_run,
    path: *const c_char,
    path_length: usize,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `picture` and `path`.
        let (picture, path) = unsafe { (checked(picture)?, text("path", path, path_length)?) };
        let run = get_any(run)?;
        let made = alone(renderer, |drawing| drawing.picture(&picture, reporter(run)))?;
        texere::write::picture(made.size, &made.for_file(&picture), path)?;
        Ok(())
    })
}

/// Makes a picture and hands the bytes of a `.png` file to `callback`: the bytes that
/// `texere_renderer_write` writes. `run` may be null. The callback runs on the calling thread, with
/// `user` as its first argument, after the picture has been made.
///
/// Fails as `texere_renderer_picture` does, and with TEXERE_CANCELLED if the callback returned a
/// number other than 0. The bytes that came before then are not a complete file.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_renderer_write_to(
    renderer: *const texere_renderer,
    picture: *const texere_picture,
    run: *const texere_run,
    callback: texere_write_callback,
    user: *mut c_void,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `picture` and the callback.
        let (picture, file) = unsafe { (checked(picture)?, CallbackFile::new(callback, user)?) };
        let run = get_any(run)?;
        let made = alone(renderer, |drawing| drawing.picture(&picture, reporter(run)))?;
        texere::write::picture_to(made.size, &made.for_file(&picture), file)?;
        Ok(())
    })
}

/// Writes what the last picture of a renderer shows at a point, in pixels from its left and upper
/// edges. No yarn is seen outside the picture, before the first picture, and after a picture that
/// was cancelled.
///
/// Fails with TEXERE_ARGUMENT if the renderer shows no yarns.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_renderer_seen(
    renderer: *const texere_renderer,
    x: f32,
    y: f32,
    seen: *mut texere_seen,
) -> texere_status {
    guard(|| {
        check("seen", seen)?;
        let found = alone(renderer, |drawing| drawing.seen([x, y]))?;
        let found = found.map_or(texere_seen::default(), |(yarn, position)| texere_seen {
            position,
            yarn: yarn as u32,
            is_yarn: 1,
        });
        // SAFETY: the pointer is neither null nor misaligned; the caller vouches for the memory.
        unsafe { seen.write(found) };
        Ok(())
    })
}

/// Frees a renderer. A null handle is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_renderer_free(renderer: *mut texere_renderer) {
    free(renderer);
}
