//! Sizes of pictures and of what is in them.

/// The most shafts, and the most treadles, that are drawn. No loom with treadles has more, nor any
/// dobby.
pub(super) const SHAFTS_MAX: usize = 100;

/// The length of a picture's longer side that its squares are sized for, pixels. A picture of few
/// squares is smaller, because squares have a largest size, and a picture of very many is larger,
/// because a square has at least one pixel.
pub(super) const SIDE_AIM: usize = 2400;

/// The largest square, pixels.
pub(super) const SQUARE_MAX: usize = 16;

/// The longest side of a picture, pixels. Many programs count pixels in 16 bits with a sign.
pub(super) const SIDE_MAX: usize = 32_767;

/// The least width of a bar of yarns, and of the gap between blocks, pixels.
pub(super) const BAR_MIN: usize = 8;
