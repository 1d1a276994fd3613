//! Pictures of yarns, in the caller's memory or in a file.

use std::ffi::c_char;
use std::sync::Mutex;

use crate::argument::{check, check_sized, sized, text};
#[cfg(feature = "render")]
use crate::drawing::Drawing;
use crate::error::guard;
use crate::failure::Failure;
use crate::handle::{Handle, alone, clear, free, get, get_any, give};
use crate::run::{reporter, texere_run};
use crate::settings::{chosen, texere_settings};
use crate::status::texere_status;
#[cfg(not(feature = "render"))]
use crate::undrawn::Drawing;
use crate::view::texere_view;
use crate::yarns::texere_yarns;

/// A device that makes pictures, and the yarns that it shows. One thread at a time may use it: a
/// call while another thread's is under way fails with TEXERE_ARGUMENT.
#[derive(Debug)]
pub struct texere_renderer;

impl Handle for texere_renderer {
    type Value = Mutex<Drawing>;
    const NAME: &str = "renderer";
}

/// The whole cloth from straight above its face.
pub const TEXERE_VIEW_FACE: u32 = 0;
/// The whole cloth from above its lower edge, turned by `turn`.
pub const TEXERE_VIEW_OBLIQUE: u32 = 1;
/// A stretch of `width_mm` round the point `at`, from above and aside.
pub const TEXERE_VIEW_CLOSE_UP: u32 = 2;
/// A cut across the ends, through the point `at`, `width_mm` of it.
pub const TEXERE_VIEW_CUT_WARP: u32 = 3;
/// A cut across the picks, through the point `at`, `width_mm` of it.
pub const TEXERE_VIEW_CUT_WEFT: u32 = 4;
/// From `eye` to `target`, with `field_of_view`.
pub const TEXERE_VIEW_EYE: u32 = 5;
/// From `eye` to `target` with parallel lines of sight; the picture shows `height_mm`.
pub const TEXERE_VIEW_PARALLEL: u32 = 6;

/// Light grey ground that the cloth lies on and casts its shadow on.
pub const TEXERE_BACKGROUND_GROUND: u32 = 0;
/// The colour `color`.
pub const TEXERE_BACKGROUND_COLOR: u32 = 1;
/// Nothing: alpha says how much of each pixel is yarn.
pub const TEXERE_BACKGROUND_NOTHING: u32 = 2;

/// What a picture shows, and how. `texere_picture_default` fills it in.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_picture {
    /// Bytes of this struct, which the caller sets.
    pub struct_size: u32,
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Pixels that are drawn for each pixel of the picture, each way, from 1; each of them has four
    /// samples.
    pub supersampling: u32,
    /// 1 if fibres that stand off yarns are drawn, else 0.
    pub hairs: u32,
    /// A number that begins with TEXERE_BACKGROUND.
    pub background: u32,
    /// A colour of the background, sRGB.
    pub color: [u8; 3],
    /// Zero.
    pub reserved: u8,
    /// A number that begins with TEXERE_VIEW.
    pub view: u32,
    /// 1 if the cloth is turned over sideways, so that its back is seen, else 0.
    pub turned_over: u32,
    /// Turn about the cloth's middle, radians, counter-clockwise as seen from above.
    pub turn: f32,
    /// A point of the cloth, x and y, mm.
    pub at: [f32; 2],
    /// What the picture's width shows, mm.
    pub width_mm: f32,
    /// The eye, mm.
    pub eye: [f32; 3],
    /// The point in the middle of the picture, mm.
    pub target: [f32; 3],
    /// What is up in the picture, of any length.
    pub up: [f32; 3],
    /// From the picture's lower to its upper edge, radians, 0.0001 to 3.1.
    pub field_of_view: f32,
    /// What the picture's height shows, mm.
    pub height_mm: f32,
}

/// The box round yarns.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct texere_extent {
    /// The least x, y and z, mm.
    pub low: [f32; 3],
    /// The greatest x, y and z, mm.
    pub high: [f32; 3],
}

/// What a picture shows at a point.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct texere_seen {
    /// The place on the yarn's surface, mm; how far it is from the eye follows.
    pub position: [f64; 3],
    /// The yarn, from 0.
    pub yarn: u32,
    /// 1 where a yarn is seen, else 0.
    pub is_yarn: u32,
}

/// Pixels of a picture.
#[derive(Debug)]
pub(crate) struct Pixels {
    pub(crate) size: [u32; 2],
    /// Three bytes each, rows from the top.
    pub(crate) rgb: Vec<u8>,
    pub(crate) alpha: Vec<u8>,
}

/// Bytes of a pixel in the caller's memory: red, green, blue, alpha.
const PIXEL: usize = 4;

/// The usual picture: width and height, pixels; and a portrait lens's field of view, radians.
const SIZE: [u32; 2] = [1600, 1200];
const FIELD_OF_VIEW: f32 = 0.42;

/// Writes the usual picture: the whole cloth from above its face, 1600 by 1200 pixels of sixteen
/// samples each, with fibres, on the ground. The caller has set `picture->struct_size`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_picture_default(picture: *mut texere_picture) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `picture`.
        unsafe { check_sized("picture", picture) }?;
        let usual = texere_picture {
            struct_size: size_of::<texere_picture>() as u32,
            width: SIZE[0],
            height: SIZE[1],
            supersampling: 2,
            hairs: 1,
            background: TEXERE_BACKGROUND_GROUND,
            color: [255; 3],
            reserved: 0,
            view: TEXERE_VIEW_FACE,
            turned_over: 0,
            turn: 0.0,
            at: [0.0; 2],
            width_mm: 0.0,
            eye: [0.0, 0.0, 1.0],
            target: [0.0; 3],
            up: [0.0, 1.0, 0.0],
            field_of_view: FIELD_OF_VIEW,
            height_mm: 0.0,
        };
        // SAFETY: `check_sized` has seen that it is neither null nor misaligned nor too short.
        unsafe { picture.write(usual) };
        Ok(())
    })
}

/// Opens a device for pictures: "auto" for the best one, "wgpu", "wgpu:1" and so on. A `name_length`
/// of 0 is "auto".
///
/// Fails with TEXERE_DEVICE where there is none, and with TEXERE_UNSUPPORTED where the library was
/// built without pictures.
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

/// Sends yarns to a renderer, which shows them from now on in place of others. `settings` may be
/// null: what suits a picture holds then. Their topology and caps have no effect. `run` may be null.
///
/// Fails with TEXERE_ARGUMENT for settings out of range, and with TEXERE_CANCELLED where `run` was
/// cancelled. The renderer then shows nothing.
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
/// Fails with TEXERE_ARGUMENT where it shows none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_renderer_extent(
    renderer: *const texere_renderer,
    extent: *mut texere_extent,
) -> texere_status {
    guard(|| {
        check("extent", extent)?;
        let found = alone(renderer, |drawing| drawing.extent())?;
        // SAFETY: neither null nor misaligned; the caller vouches for the rest.
        unsafe { extent.write(found) };
        Ok(())
    })
}

/// Makes a picture in the caller's memory: in each row of `pixels` red, green, blue and alpha of
/// each pixel from the left, a byte each, sRGB; rows from the top. `pixels.stride` is the bytes from
/// one row to the next, at least four times the width. Alpha is 255 unless the background is
/// nothing; colours are not multiplied by it. `run` may be null.
///
/// Fails with TEXERE_ARGUMENT where the renderer shows no yarns, for a picture that is out of range
/// or larger than the device takes, and for memory that is too small; with TEXERE_CANCELLED where
/// `run` was cancelled. The memory is then as it was.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_renderer_picture(
    renderer: *const texere_renderer,
    picture: *const texere_picture,
    run: *const texere_run,
    pixels: texere_view,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `picture`.
        let picture = unsafe { checked(picture) }?;
        let [width, height] = [picture.width, picture.height].map(|side| side as usize);
        // SAFETY: the caller vouches for `pixels`.
        let mut rows = unsafe { pixels.rows("pixels", height, width.saturating_mul(PIXEL)) }?;
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

/// Makes a picture in a `.png` file, with alpha where the background is nothing. `run` may be null.
/// A file of that name is replaced once the new one is whole.
///
/// Fails as `texere_renderer_picture` does, and with TEXERE_IO where the file can't be written.
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
        let Pixels { size, mut rgb, alpha } =
            alone(renderer, |drawing| drawing.picture(&picture, reporter(run)))?;
        if picture.background == TEXERE_BACKGROUND_NOTHING {
            let pixels = rgb.chunks_exact(3).zip(alpha);
            rgb = pixels.flat_map(|(rgb, alpha)| [rgb[0], rgb[1], rgb[2], alpha]).collect();
        }
        texere::write::picture(size, &rgb, path)?;
        Ok(())
    })
}

/// The picture that `pointer` names, of one pixel at least.
///
/// # Safety
///
/// As for `sized`.
unsafe fn checked(pointer: *const texere_picture) -> Result<texere_picture, Failure> {
    // SAFETY: the caller vouches for it.
    let picture = unsafe { sized("picture", pointer) }?;
    for (name, side) in [("width", picture.width), ("height", picture.height)] {
        if side == 0 {
            return Err(Failure::argument(format!("picture.{name} is 0, expected 1 or more")));
        }
    }
    Ok(picture)
}

/// Writes what the last picture of a renderer shows at a point, in pixels from its left and upper
/// edges. No yarn is seen outside the picture, and before the first one.
///
/// Fails with TEXERE_ARGUMENT where the renderer shows no yarns.
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
        // SAFETY: neither null nor misaligned; the caller vouches for the rest.
        unsafe { seen.write(found) };
        Ok(())
    })
}

/// Frees a renderer, or nothing where it is null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_renderer_free(renderer: *mut texere_renderer) {
    free(renderer);
}
