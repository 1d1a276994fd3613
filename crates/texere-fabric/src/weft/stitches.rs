//! Which loop is drawn through which: what comes of a knitting program.

use std::ops::Range;

use super::{Bed, Direction};

/// Half wales to the wale: needles of a bed that is racked by half a pitch lie between those of the
/// other.
pub(super) const HALVES: i64 = 2;

/// A loop, by its number in [`Stitches::loops`], and in which repeat it lies as seen from the one
/// that refers to it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct LoopRef {
    /// Its number.
    pub number: u32,
    /// So many repeats to the right and upwards; 0 where nothing repeats.
    pub repeat: [i32; 2],
}

/// A loop that another one is drawn through.
pub type Parent = LoopRef;

/// How a loop was made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum LoopKind {
    /// Drawn through what its needle held; a cast-on where that was nothing.
    Knit,
    /// Laid on its needle.
    Tuck,
    /// Drawn through what its needle held, while that went to another needle.
    Split,
}

/// What becomes of a loop in the end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fate {
    /// Another loop is drawn through it.
    Held(LoopRef),
    /// It hangs on a needle when the program ends.
    OnNeedle,
    /// It fell off a needle, and nothing holds it.
    Dropped,
}

/// Where the head of a loop hangs when its fate comes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Head {
    /// Its needle's place, in wales from that of front needle 0. Other than [`Stitch::at`] where
    /// the loop was transferred.
    pub at: f32,
    /// The bed of its needle.
    pub bed: Bed,
    /// How many loops of the same needle lie between it and the side that the next loop is drawn
    /// to: 0 for the loop that came to the needle first.
    pub layer: u16,
    /// Where heads of one course cross on their way to other needles, the one that was transferred
    /// first, and so lies nearer its new bed, has the smaller number; 0 for one that was never
    /// transferred.
    pub moved: u32,
}

/// A loop of yarn.
#[derive(Debug, Clone, PartialEq)]
pub struct Stitch {
    /// How it was made.
    pub kind: LoopKind,
    /// The bed on which it was made: the side to which it is drawn.
    pub bed: Bed,
    /// Its needle's place when it was made, in wales from that of front needle 0, rising to the
    /// right.
    pub at: f32,
    /// Whether the needle opposite holds loops of its own then, so that two layers of cloth lie
    /// face to face there.
    pub opposite: bool,
    /// Its course, from 0: one more than the highest that any stitch of its pass is drawn through.
    pub course: u32,
    /// Of several yarns in one stitch, which one: 0 lies in front on the side to which the loop is
    /// drawn.
    pub plate: u16,
    /// The loops that it is drawn through, in [`Stitches::parents`], in the order in which they
    /// came to the needle.
    pub parents: Range<u32>,
    /// Where its head hangs in the end.
    pub head: Head,
    /// What becomes of it.
    pub fate: Fate,
    /// Its length, mm, where the program says.
    pub length_mm: Option<f32>,
    /// Its [`Operation::source`](super::Operation::source).
    pub source: u32,
}

/// What a yarn does next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Step {
    /// It makes a loop, while the carriage moves that way.
    Loop {
        /// The loop's number.
        number: u32,
        /// Which way.
        direction: Direction,
    },
    /// It passes a needle of that bed without a loop, behind what hangs there (seen from the side
    /// to which the needle draws).
    Float {
        /// The needle's place, in wales.
        at: f32,
        /// Its bed.
        bed: Bed,
        /// The course of the pass.
        course: u32,
        /// Which way.
        direction: Direction,
        /// The operation's source.
        source: u32,
    },
}

/// A needle that a yarn comes to, whatever it does there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Visit {
    /// The loop that it makes; none where it floats.
    pub number: Option<u32>,
    /// The needle's place, in wales.
    pub at: f32,
    /// Its bed.
    pub bed: Bed,
    /// The course.
    pub course: u32,
    /// Which way the carriage moves.
    pub direction: Direction,
    /// The operation's source.
    pub source: u32,
}

/// A yarn from where it is brought in to where it is cut.
#[derive(Debug, Clone, PartialEq)]
pub struct Strand {
    /// Its carrier, an index into the program's.
    pub carrier: u32,
    /// What it does, in order.
    pub steps: Vec<Step>,
    /// Where the program is one repeat: how many repeats to the right and upwards the yarn goes on
    /// after its last step with its first. `None` where it ends.
    pub onward: Option<[i32; 2]>,
}

/// Loops and yarns of a knitted cloth: its topology, without sizes.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Stitches {
    /// The loops, in the order in which they are made.
    pub loops: Vec<Stitch>,
    /// The loops that others are drawn through: see [`Stitch::parents`].
    pub parents: Vec<Parent>,
    /// The yarns.
    pub strands: Vec<Strand>,
    /// Wales and courses of a repeat, where the program was one.
    pub repeat: Option<[u32; 2]>,
}

impl Stitches {
    /// The loops that a loop is drawn through, in the order in which they came to its needle.
    ///
    /// **Panics** past the last loop.
    #[must_use]
    pub fn parents_of(&self, number: u32) -> &[Parent] {
        let Range { start, end } = self.loops[number as usize].parents;
        &self.parents[start as usize..end as usize]
    }

    /// Where a yarn is at a step, and which way it goes.
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
