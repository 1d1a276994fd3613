//! The layout of `.yarns` files, which their writer and their reader share. `docs/FORMATS.md` says
//! what each byte means.

use texere_core::Yarns;

/// The extension of a file of yarns, without its dot.
pub(crate) const ENDING: &str = "yarns";

/// The first bytes of a file. No UTF-8 text begins with the byte 0x89, so the file is not taken for
/// text. The last two bytes are a line end, so a transfer that changes line ends damages them and
/// the reader notices.
pub(crate) const MAGIC: [u8; 8] = *b"\x89YARNS\r\n";

/// The version of the format. No other version is read.
pub(crate) const VERSION: u32 = 1;

/// The largest file, bytes. It has room for half a billion control points with up directions and
/// sources. The limit is needed because a reader holds all of a file in memory.
pub(crate) const BYTES_MAX: u64 = 1 << 34;

/// The bit of the header that says that up directions follow the control points.
pub(crate) const HAS_UPS: u32 = 1;

/// The bit of the header that says that sources follow the control points.
pub(crate) const HAS_SOURCES: u32 = 2;

/// The bit of the header that says that bending stiffnesses follow the materials.
pub(crate) const HAS_BENDING: u32 = 4;

pub(crate) const HEADER_BYTES: u64 = 60;
/// Bytes of a material, without the letters of its name.
pub(crate) const MATERIAL_BYTES: u64 = 20;
pub(crate) const BENDING_BYTES: u64 = 4;
/// Bytes of a section, without the corners of a polygon.
pub(crate) const SECTION_BYTES: u64 = 12;
pub(crate) const CORNER_BYTES: u64 = 8;
pub(crate) const YARN_BYTES: u64 = 44;
pub(crate) const POINT_BYTES: u64 = 16;
pub(crate) const UP_BYTES: u64 = 12;
pub(crate) const SOURCE_BYTES: u64 = 4;
pub(crate) const CHECKSUM_BYTES: u64 = 4;

/// Numbers that stand for kinds of sections.
pub(crate) mod section {
    pub(crate) const CIRCLE: u32 = 0;
    pub(crate) const ELLIPSE: u32 = 1;
    pub(crate) const LENTICULAR: u32 = 2;
    pub(crate) const POWER_ELLIPSE: u32 = 3;
    pub(crate) const LOBED: u32 = 4;
    pub(crate) const POLYGON: u32 = 5;
}

/// Numbers that stand for the ends of a yarn.
pub(crate) mod ends {
    pub(crate) const OPEN: u32 = 0;
    pub(crate) const CLOSED: u32 = 1;
    pub(crate) const REPEATS: u32 = 2;
}

/// Numbers that stand for kinds of origins.
pub(crate) mod origin {
    pub(crate) const UNKNOWN: u32 = 0;
    pub(crate) const END: u32 = 1;
    pub(crate) const PICK: u32 = 2;
    pub(crate) const COURSE: u32 = 3;
    pub(crate) const CARRIER: u32 = 4;
    pub(crate) const GUIDE: u32 = 5;
}

/// The bits of the header for `yarns`.
pub(crate) fn flags(yarns: &Yarns) -> u32 {
    let ups = if yarns.ups().is_some() { HAS_UPS } else { 0 };
    let sources = if yarns.sources().is_some() { HAS_SOURCES } else { 0 };
    let bends = yarns.materials().iter().any(|material| material.bending.is_some());
    ups | sources | if bends { HAS_BENDING } else { 0 }
}

/// Bytes of a control point. Its up direction and its source are included if `flags`, the header's
/// bits, announce them.
pub(crate) const fn bytes_per_point(flags: u32) -> u64 {
    let ups = if flags & HAS_UPS != 0 { UP_BYTES } else { 0 };
    let sources = if flags & HAS_SOURCES != 0 { SOURCE_BYTES } else { 0 };
    POINT_BYTES + ups + sources
}
