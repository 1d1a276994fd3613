//! The layout of BCC files, which their writer and their reader share. `docs/FORMATS.md` says what
//! each byte means.

/// Bytes of the header.
pub(crate) const HEADER_BYTES: usize = 64;

/// The first bytes. The fourth byte says that integers and floats have four bytes each.
pub(crate) const SIGN: [u8; 4] = *b"BCC\x44";

/// The number of the axis that points up: z. 0 is x, and 1 is y.
pub(crate) const Z_UP: u8 = 2;

/// Bytes of the text at the end of the header.
pub(crate) const INFO_BYTES: usize = 40;

/// The text at the end of the header of files that texere writes.
pub(crate) const INFO: &str = "texere: mm, face along z";

/// The kind of all curves of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Spline {
    /// Uniform Catmull-Rom splines through the control points.
    CatmullRom,
    /// Straight lines from point to point.
    Polyline,
}

impl Spline {
    /// The two letters of the header.
    pub(crate) const fn letters(self) -> [u8; 2] {
        match self {
            Self::CatmullRom => *b"C0",
            Self::Polyline => *b"PL",
        }
    }
}
