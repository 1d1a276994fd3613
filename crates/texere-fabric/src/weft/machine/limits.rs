//! What knitting machines can do, and how large programs may be.

/// The furthest needle on either side that is taken.
pub const NEEDLE_MAX: i32 = 1 << 16;

/// The most loops of a program that are taken.
pub const LOOPS_MAX: usize = 1 << 27;

/// The most loops that one needle may hold.
pub const STACK_MAX: usize = 256;

/// The most faults that are listed.
pub const FAULTS_LISTED: usize = 1000;

/// The most entries of [`Stitches::parents`](crate::weft::Stitches::parents): splits can draw loop
/// after loop through the same ones.
pub(super) const PARENTS_MAX: usize = 1 << 28;

/// The most carriers and sets of carriers.
pub(in crate::weft) const CARRIERS_MAX: usize = 1 << 16;

/// What a knitting machine can do. The default is a V-bed machine's usual limits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Machine {
    /// How far the beds can be racked to either side, in needles: 4.
    pub rack_max: f64,
    /// How many needles a yarn may float past: 6, "usually the maximum number for a continuous
    /// float" (Spencer, Knitting Technology).
    pub float_max: u32,
    /// How many loops a needle may hold: 4, as many as a needle usually tucks at most (likewise).
    pub pile_max: u32,
}

impl Default for Machine {
    fn default() -> Self {
        Self { rack_max: 4.0, float_max: 6, pile_max: 4 }
    }
}
