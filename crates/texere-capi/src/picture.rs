//! Pictures: what they show, and how.

use crate::error::guard;
use crate::failure::Failure;
use crate::sized::{check_sized, grows_after, sized, write_sized};
use crate::status::texere_status;

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
        // SAFETY: `check_sized` has taken it; the caller vouches for the rest.
        unsafe { write_sized(picture, usual) };
        Ok(())
    })
}

/// The picture that `pointer` names, of one pixel at least.
///
/// # Safety
///
/// As for `sized`.
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
