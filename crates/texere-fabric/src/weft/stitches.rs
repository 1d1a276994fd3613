//! Stitches: the loops that a knitting program makes, and which of them is drawn through which.

use std::ops::Range;

use super::{Bed, Direction};

/// Number of half wales in a wale. Where places of needles are compared, they are counted in half
/// wales, because the needles of a bed that is racked by half a pitch lie half way between those of
/// the other bed. [`Stitch::at`] is in wales.
pub(super) const HALVES: i64 = 2;

/// A reference to a loop: its number in [`Stitches::loops`], and its repeat relative to the loop
/// that refers to it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct LoopRef {
    /// The number of the loop.
    pub number: u32,
    /// Number of repeats to the right, and upwards. Both are 0 if nothing repeats.
    pub repeat: [i32; 2],
}

/// A reference to a loop that the referring loop is drawn through.
pub type Parent = LoopRef;

/// How a loop was made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum LoopKind {
    /// Drawn through the loops that its needle held. On an empty needle it is a cast-on.
    Knit,
    /// Laid on its needle, and drawn through nothing.
    Tuck,
    /// Drawn through the loops that its needle held, while those loops moved to another needle.
    Split,
}

/// How a loop ends: held by another loop, on a needle, or dropped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fate {
    /// Another loop is drawn through the loop.
    Held(LoopRef),
    /// The loop hangs on a needle when the program ends.
    OnNeedle,
    /// The loop fell off a needle, and nothing holds it.
    Dropped,
}

/// The place of a loop's head at its end: when another loop is drawn through the loop, when it
/// falls, or when the program ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Head {
    /// The place of the needle that holds the head, in wales from front needle 0. It differs from
    /// [`Stitch::at`] if the loop was transferred.
    pub at: f32,
    /// The bed of this needle.
    pub bed: Bed,
    /// Number of loops on the same needle between this loop and the side to which the next loop is
    /// drawn: 0 for the loop that came to the needle first.
    pub layer: u16,
    /// Order of the loop's last transfer, 0 for a loop that was never transferred. If heads of one
    /// course cross on their way to other needles, the head that was transferred first has the
    /// smaller number, and lies nearer to its new bed.
    pub moved: u32,
}

/// A loop of yarn.
#[derive(Debug, Clone, PartialEq)]
pub struct Stitch {
    /// The way in which the loop was made.
    pub kind: LoopKind,
    /// The bed on which the loop was made, which gives the side to which it is drawn.
    pub bed: Bed,
    /// The place of the needle on which the loop was made, in wales from front needle 0, positive
    /// to the right.
    pub at: f32,
    /// Whether the needle opposite held loops of its own when this loop was made. Two layers of
    /// cloth then lie face to face.
    pub opposite: bool,
    /// The course of the loop, counted from 0. It is one more than the highest course that a stitch
    /// of the same pass is drawn through. A pass is a row of stitches that the same carriers make
    /// in one direction. A pass that is drawn through nothing lies in the course of its carrier's
    /// previous pass.
    pub course: u32,
    /// Number of the loop's yarn in a plated stitch, counted from 0. Yarn 0 lies in front, on the
    /// side to which the loop is drawn.
    pub plate: u16,
    /// The loops that this loop is drawn through: a range of [`Stitches::parents`], in the order in
    /// which they came to the needle.
    pub parents: Range<u32>,
    /// The place of the loop's head at its end.
    pub head: Head,
    /// How the loop ends.
    pub fate: Fate,
    /// The length of yarn in the loop, mm, if the program gives one.
    pub length_mm: Option<f32>,
    /// The [`Operation::source`](super::Operation::source) of the operation that made the loop.
    pub source: u32,
}

/// One step of a yarn: a loop or a float.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Step {
    /// The yarn makes a loop.
    Loop {
        /// The loop's number.
        number: u32,
        /// The direction of the carriage.
        direction: Direction,
    },
    /// The yarn passes a needle without making a loop. It lies behind the loops of the needle, seen
    /// from the side to which the needle draws.
    Float {
        /// The place of the needle, in wales.
        at: f32,
        /// The bed of the needle.
        bed: Bed,
        /// The course of the pass.
        course: u32,
        /// The direction of the carriage.
        direction: Direction,
        /// The operation's source.
        source: u32,
    },
}

/// A needle that a yarn comes to, to make a loop or to float.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Visit {
    /// Number of the loop that the yarn makes; none if it floats.
    pub number: Option<u32>,
    /// The place of the needle, in wales.
    pub at: f32,
    /// The bed of the needle.
    pub bed: Bed,
    /// The course.
    pub course: u32,
    /// The direction in which the carriage moves.
    pub direction: Direction,
    /// The operation's source.
    pub source: u32,
}

/// A yarn from the place where it is brought in to the place where it is cut, or one round of a
/// yarn that goes on from repeat to repeat.
#[derive(Debug, Clone, PartialEq)]
pub struct Strand {
    /// The carrier of the yarn: an index into [`Program::carriers`](super::Program::carriers).
    pub carrier: u32,
    /// The loops and floats of the yarn, in order.
    pub steps: Vec<Step>,
    /// Number of repeats to the right and upwards after which the yarn repeats: after its last step
    /// comes its first step in that repeat. `None` for a yarn that ends in the cloth.
    pub onward: Option<[i32; 2]>,
}

/// The loops and yarns of a knitted cloth: its topology, without any sizes.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Stitches {
    /// The loops, in the order in which they are made.
    pub loops: Vec<Stitch>,
    /// References to the loops that others are drawn through: [`Stitch::parents`] are ranges of
    /// this list.
    pub parents: Vec<Parent>,
    /// The yarns.
    pub strands: Vec<Strand>,
    /// Wales and courses of the repeat, if the program is one repeat.
    pub repeat: Option<[u32; 2]>,
}

impl Stitches {
    /// The loops that the loop `number` is drawn through, in the order in which they came to its
    /// needle.
    ///
    /// **Panics** for a number past the last loop.
    #[must_use]
    pub fn parents_of(&self, number: u32) -> &[Parent] {
        let Range { start, end } = self.loops[number as usize].parents;
        &self.parents[start as usize..end as usize]
    }

    /// The needle of a step, with its course, direction and source.
    ///
    /// **Panics** for a loop past the last one.
    #[must_use]
    pub fn visit(&self, step: &Step) -> Visit {
        match *step {
            Step::Loop { number, direction } => {
                let Stitch { at, bed, course, source, .. } = self.loops[number as usize];
                Visit { number: Some(number), at, bed, course, direction, source }
            }
            Step::Float { at, bed, course, direction, source } => {
                Visit { number: None, at, bed, course, direction, source }
            }
        }
    }
}
