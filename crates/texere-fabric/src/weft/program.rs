//! Knitting programs: the operations of a knitting machine.

use std::fmt;

/// A row of needles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Bed {
    /// The front bed. Its needles draw loops to the technical face, towards +z.
    Front,
    /// The back bed. Its needles draw loops to the technical back.
    Back,
}

impl Bed {
    /// The other bed.
    #[must_use]
    pub const fn other(self) -> Self {
        match self {
            Self::Front => Self::Back,
            Self::Back => Self::Front,
        }
    }
}

/// A needle, or its slider, which can hold loops but not knit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Needle {
    /// The bed of the needle.
    pub bed: Bed,
    /// Whether this is the needle's slider.
    pub slider: bool,
    /// The number of the needle on its bed. Numbers rise to the right, and may be negative.
    pub number: i32,
}

impl Needle {
    /// A needle of the front bed.
    #[must_use]
    pub const fn front(number: i32) -> Self {
        Self { bed: Bed::Front, slider: false, number }
    }

    /// A needle of the back bed.
    #[must_use]
    pub const fn back(number: i32) -> Self {
        Self { bed: Bed::Back, slider: false, number }
    }
}

impl fmt::Display for Needle {
    /// Writes the needle in knitout's notation: `f3`, `bs-1`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let bed = if self.bed == Bed::Front { 'f' } else { 'b' };
        let slider = if self.slider { "s" } else { "" };
        write!(f, "{bed}{slider}{}", self.number)
    }
}

/// The direction in which the carriage moves while a stitch is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Direction {
    /// To the left: needle numbers fall. Knitout's `-`.
    Left,
    /// To the right: needle numbers rise. Knitout's `+`.
    Right,
}

/// The carriers of an operation: an index into [`Program::carrier_sets`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct CarrierSet(pub u32);

/// One instruction of a knitting machine. Names and meaning follow knitout 2 (McCann, "The Knitout
/// File Format", v0.6).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Instruction {
    /// Brings yarns in.
    In,
    /// Brings yarns in with the hook. The hook holds their ends until it is released.
    InHook,
    /// Lets the hook release yarns.
    ReleaseHook,
    /// Takes yarns out.
    Out,
    /// Cuts yarns, and takes their ends out with the hook.
    OutHook,
    /// Draws a new loop through all loops of a needle. The old loops then fall off the needle.
    /// Without a carrier the loops only fall.
    Knit(Direction, Needle),
    /// Lays a loop on a needle, on top of the loops that the needle holds.
    Tuck(Direction, Needle),
    /// Knits, but the loops of the first needle go to the second instead of falling off.
    Split(Direction, Needle, Needle),
    /// Lets all loops of a needle fall.
    Drop(Needle),
    /// Moves all loops of a needle to a needle of the other bed. The moved loops lie nearer to the
    /// tip of the second needle than the loops that this needle already holds.
    Transfer(Needle, Needle),
    /// Moves carriers past a needle: with `Left` to the needle's left side, with `Right` to its
    /// right side.
    Miss(Direction, Needle),
    /// Shifts the back bed, so that back needle b faces front needle b + rack. A fraction puts back
    /// needles half way between front needles.
    Rack(f64),
    /// Sets the length of the loops that follow, mm. With `None` the gauge of the cloth gives the
    /// length.
    LoopLength(Option<f64>),
}

impl fmt::Display for Direction {
    /// Writes the direction in knitout's notation: `+` or `-`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", if *self == Self::Right { '+' } else { '-' })
    }
}

impl fmt::Display for Instruction {
    /// Writes the instruction in knitout's notation, without carriers: `knit + f3`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::In => write!(f, "in"),
            Self::InHook => write!(f, "inhook"),
            Self::ReleaseHook => write!(f, "releasehook"),
            Self::Out => write!(f, "out"),
            Self::OutHook => write!(f, "outhook"),
            Self::Knit(direction, needle) => write!(f, "knit {direction} {needle}"),
            Self::Tuck(direction, needle) => write!(f, "tuck {direction} {needle}"),
            Self::Split(direction, from, to) => write!(f, "split {direction} {from} {to}"),
            Self::Drop(needle) => write!(f, "drop {needle}"),
            Self::Transfer(from, to) => write!(f, "xfer {from} {to}"),
            Self::Miss(direction, needle) => write!(f, "miss {direction} {needle}"),
            Self::Rack(rack) => write!(f, "rack {rack}"),
            Self::LoopLength(Some(length_mm)) => write!(f, "loops of {length_mm} mm"),
            Self::LoopLength(None) => write!(f, "loops of any length"),
        }
    }
}

/// An instruction with its carriers and its source.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Operation {
    /// The instruction.
    pub instruction: Instruction,
    /// The carriers that take part. If there are several, their yarns are plated: the yarn of the
    /// first carrier lies in front, on the side to which the loop is drawn.
    pub carriers: CarrierSet,
    /// The line of the file, or the cell of the chart, that the operation comes from. Every control
    /// point of the operation's loops and floats keeps this number.
    pub source: u32,
}

/// A knitting program: the operations of a machine, in order.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Program {
    /// The names of the yarn carriers. [`Knitted`](super::Knitted) says which yarn each of them
    /// holds.
    pub carriers: Vec<String>,
    /// The sets of carriers that operations refer to. Each is a list of indices into `carriers`.
    /// The first set is empty.
    pub carrier_sets: Vec<Vec<u32>>,
    /// The operations.
    pub operations: Vec<Operation>,
    /// Width of the repeat in needles, if the program is one repeat of a cloth. The needles of the
    /// repeat are 0 to `width` - 1; other needles belong to the neighbouring repeats. After the
    /// last operation the program repeats from the first one, in the next courses.
    pub repeat: Option<u32>,
}
