//! The layout of BCC files, which their writer and their reader share. `docs/FORMATS.md` says what
//! each byte means.

/// The length of the header, bytes.
pub(crate) const HEADER_BYTES: usize = 64;

/// The first bytes of a file. The fourth byte says that integers and floats have four bytes each.
pub(crate) const SIGN: [u8; 4] = *b"BCC\x44";

/// The number of the axis that points up: z. 0 is x, and 1 is y.
pub(crate) const Z_UP: u8 = 2;

/// The length of the text at the end of the header, bytes.
pub(crate) const INFO_BYTES: usize = 40;

/// The text at the end of the header of files that texere writes.
pub(crate) const INFO: &str = "texere: mm, face along z";

/// The kind of curve. All curves of a file are of one kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Spline {
    /// Uniform Catmull-Rom splines through the control points.
    CatmullRom,
    /// Straight lines from point to point.
    Polyline,
}

impl Spline {
    /// The two letters that stand for this kind in the header.
    pub(crate) const fn letters(self) -> [u8; 2] {
        match self {
            Self::CatmullRom => *b"C0",
            Self::Polyline => *b"PL",
        }
    }
}
