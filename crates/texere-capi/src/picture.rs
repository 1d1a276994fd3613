//! Pictures: the view, the background and the quality of one.

use std::borrow::Cow;

use crate::error::guard;
use crate::failure::Failure;
use crate::sized::{check_sized, grows_after, sized, write_sized};
use crate::status::texere_status;

/// The whole cloth from straight above its face.
pub const TEXERE_VIEW_FACE: u32 = 0;
/// The whole cloth from above, with the eye on the side of the cloth's lower edge. `turn` turns the
/// eye about the cloth's middle.
pub const TEXERE_VIEW_OBLIQUE: u32 = 1;
/// A part of the cloth, `width_mm` wide, round the point `at`, from above and aside.
pub const TEXERE_VIEW_CLOSE_UP: u32 = 2;
/// A cut across the ends, through the point `at`. The picture shows `width_mm` of it.
pub const TEXERE_VIEW_CUT_WARP: u32 = 3;
/// A cut across the picks, through the point `at`. The picture shows `width_mm` of it.
pub const TEXERE_VIEW_CUT_WEFT: u32 = 4;
/// The view from `eye` to `target`, with `field_of_view`.
pub const TEXERE_VIEW_EYE: u32 = 5;
/// The view in the direction from `eye` to `target`, with parallel lines of sight. The picture
/// shows `height_mm` from its lower to its upper edge.
pub const TEXERE_VIEW_PARALLEL: u32 = 6;

/// Light grey ground that the cloth lies on and casts its shadow on.
pub const TEXERE_BACKGROUND_GROUND: u32 = 0;
/// One colour, `color`.
pub const TEXERE_BACKGROUND_COLOR: u32 = 1;
/// Nothing. Alpha says how much of each pixel shows yarn.
pub const TEXERE_BACKGROUND_NOTHING: u32 = 2;

/// What a picture shows, and how. `texere_picture_default` fills it in.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_picture {
    /// Size of this struct, bytes. The caller sets it.
    pub struct_size: u32,
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// How many pixels are drawn for each pixel of the picture, in each direction, 1 or more. Each
    /// pixel that is drawn has four samples.
    pub supersampling: u32,
    /// 1 if fibres that stand off yarns are drawn, else 0. Cuts never show them, nor do pictures in
    /// which threads are narrower than four pixels.
    pub hairs: u32,
    /// A constant whose name begins with TEXERE_BACKGROUND.
    pub background: u32,
    /// The colour of the background with TEXERE_BACKGROUND_COLOR, sRGB.
    pub color: [u8; 3],
    /// Zero.
    pub reserved: u8,
    /// A constant whose name begins with TEXERE_VIEW.
    pub view: u32,
    /// 1 if the cloth is turned over sideways, so that its back is seen, else 0.
    pub turned_over: u32,
    /// With TEXERE_VIEW_OBLIQUE: turn of the eye about the cloth's middle, radians,
    /// counter-clockwise as seen from above.
    pub turn: f32,
    /// With TEXERE_VIEW_CLOSE_UP and cuts: a point of the cloth, x and y, mm.
    pub at: [f32; 2],
    /// With TEXERE_VIEW_CLOSE_UP and cuts: how much of the cloth the picture's width shows, mm.
    pub width_mm: f32,
    /// With TEXERE_VIEW_EYE and TEXERE_VIEW_PARALLEL: the eye, mm.
    pub eye: [f32; 3],
    /// With TEXERE_VIEW_EYE and TEXERE_VIEW_PARALLEL: the point in the middle of the picture, mm.
    pub target: [f32; 3],
    /// With TEXERE_VIEW_EYE and TEXERE_VIEW_PARALLEL: the direction that is up in the picture, of
    /// any length.
    pub up: [f32; 3],
    /// With TEXERE_VIEW_EYE: the angle from the picture's lower to its upper edge, radians, 0.0001
    /// to 3.1.
    pub field_of_view: f32,
    /// With TEXERE_VIEW_PARALLEL: how much the picture's height shows, mm.
    pub height_mm: f32,
}

grows_after!(texere_picture, height_mm);

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
    /// The place on the yarn's surface, mm.
    pub position: [f64; 3],
    /// The yarn, counted from 0.
    pub yarn: u32,
    /// 1 if a yarn is seen, else 0.
    pub is_yarn: u32,
}

/// Pixels of a picture.
#[derive(Debug)]
pub(crate) struct Pixels {
    pub(crate) size: [u32; 2],
    /// Red, green and blue of each pixel, row after row from the top.
    pub(crate) rgb: Vec<u8>,
    pub(crate) alpha: Vec<u8>,
}

impl Pixels {
    /// The pixels as a file of this picture holds them: with alpha if nothing is in the background.
    pub(crate) fn for_file(&self, picture: &texere_picture) -> Cow<'_, [u8]> {
        if picture.background != TEXERE_BACKGROUND_NOTHING {
            return Cow::Borrowed(&self.rgb);
        }
        let pixels = self.rgb.chunks_exact(3).zip(&self.alpha);
        pixels.flat_map(|(rgb, alpha)| [rgb[0], rgb[1], rgb[2], *alpha]).collect()
    }
}

/// Width and height of the usual picture, pixels. The usual field of view, radians, is that of a
/// portrait lens.
const SIZE: [u32; 2] = [1600, 1200];
const FIELD_OF_VIEW: f32 = 0.42;

/// Writes the usual picture: the whole cloth from above its face, 1600 by 1200 pixels of sixteen
/// samples each, with fibres, on the ground. The caller sets `picture->struct_size` before the
/// call.
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
        // SAFETY: `check_sized` has accepted the size; the caller vouches for the memory.
        unsafe { write_sized(picture, usual) };
        Ok(())
    })
}

/// The picture that `pointer` points to. Fails if it has no pixels.
///
/// # Safety
///
/// The conditions of `sized` hold.
pub(crate) unsafe fn checked(pointer: *const texere_picture) -> Result<texere_picture, Failure> {
    // SAFETY: the caller vouches for it.
    let picture = unsafe { sized("picture", pointer) }?;
    for (name, side) in [("width", picture.width), ("height", picture.height)] {
        if side == 0 {
            return Err(Failure::argument(format!("picture.{name} is 0, expected 1 or more")));
        }
    }
    Ok(picture)
}
