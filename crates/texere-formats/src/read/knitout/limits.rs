//! The limits of what a knitout file may hold.

/// The largest knitout file that is read, bytes: ten million operations and more.
pub(crate) const FILE_MAX: u64 = 1 << 28;

/// The most operations of a file. Some square metres of fine cloth have as many stitches.
pub(super) const OPERATIONS_MAX: usize = 1 << 24;

/// The most carriers. Machines have up to sixteen.
pub(super) const CARRIERS_MAX: usize = 256;

/// The highest number of a needle, on either side of needle 0. Machines have up to a thousand or
/// two.
pub(super) const NEEDLE_MAX: i32 = 1 << 16;

/// The longest name of a carrier, in letters. Machines number their carriers.
pub(super) const NAME_MAX: usize = 40;

/// The longest text about a yarn, the machine or the place on its bed that is kept, in letters.
pub(super) const TEXT_MAX: usize = 80;

/// The fewest and the most needles to the inch that a header may say.
pub(crate) const GAUGE: [f64; 2] = [0.1, 100.0];
