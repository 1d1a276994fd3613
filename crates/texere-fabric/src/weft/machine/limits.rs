//! The limits of knitting machines, and of the size of programs.

/// The highest number of a needle that is allowed, on either side of needle 0.
pub const NEEDLE_MAX: i32 = 1 << 16;

/// The most loops of a program.
pub(super) const LOOPS_MAX: usize = 1 << 27;

/// The most loops that one needle may hold. A program that puts more on a needle is refused.
pub const STACK_MAX: usize = 256;

/// The most faults that [`Knit::faults`](crate::weft::Knit::faults) lists, apart from the two kinds
/// that a program gets only once.
pub(super) const FAULTS_LISTED: usize = 1000;

/// The most entries of [`Stitches::parents`](crate::weft::Stitches::parents). The number of loops
/// does not limit them, because splits can draw any number of loops through the same loops.
pub(super) const PARENTS_MAX: usize = 1 << 28;

/// The most carriers, and the most sets of carriers.
pub(in crate::weft) const CARRIERS_MAX: usize = 1 << 16;

/// The limits of a knitting machine. A program that goes beyond them has faults, but is not
/// refused. The default has the limits that V-bed machines usually have.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Machine {
    /// The furthest rack to either side, in needles. Default: 4.
    pub rack_max: f64,
    /// The most needles that a yarn may float past. Default: 6, "usually the maximum number for a
    /// continuous float" (Spencer, Knitting Technology).
    pub float_max: u32,
    /// The most loops that a needle may hold. Default: 4, the most that a needle usually tucks
    /// (Spencer, Knitting Technology).
    pub pile_max: u32,
}

impl Default for Machine {
    fn default() -> Self {
        Self { rack_max: 4.0, float_max: 6, pile_max: 4 }
    }
}
