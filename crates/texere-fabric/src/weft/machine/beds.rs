//! Both needle beds, and the loops that hang on their needles.

use texere_core::OutOfMemory;
use texere_core::backend::room_for;

use super::super::stitches::HALVES;
use super::super::{Bed, LoopRef, Needle};

/// A loop that hangs on a needle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Held {
    /// The number of the loop.
    pub(super) number: u32,
    /// The round in which the loop was made.
    pub(super) round: u32,
    /// The repeat to which the loop belongs, when it hangs on a needle of repeat 0.
    pub(super) repeat: i32,
    /// The number of the loop's last transfer, 0 before any.
    pub(super) moved: u32,
    /// The loop that a split has drawn through this loop, with its repeat relative to this loop.
    pub(super) split: Option<LoopRef>,
}

/// The place of a needle's loops in [`Beds`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Slot {
    /// Index of the needle's list of loops.
    pub(super) index: usize,
    /// The repeat in which the needle lies.
    pub(super) repeat: i32,
}

/// Both needle beds, with their sliders.
#[derive(Debug)]
pub(super) struct Beds {
    low: i32,
    width: i32,
    repeats: bool,
    /// The loops on each needle: front needles, front sliders, back needles, back sliders.
    stacks: Vec<Vec<Held>>,
    /// Half wales by which the back bed is shifted to the right.
    racked: i64,
}

impl Beds {
    /// Empty needles from `low` to `low + width - 1`. With `repeats` they are the needles of one
    /// repeat, and all other needles belong to other repeats.
    pub(super) fn new(low: i32, width: i32, repeats: bool) -> Result<Self, OutOfMemory> {
        let count = 4 * usize::try_from(width).unwrap_or(0);
        let mut stacks = Vec::new();
        room_for(&mut stacks, count, "needles")?;
        stacks.resize(count, Vec::new());
        Ok(Self { low, width, repeats, stacks, racked: 0 })
    }

    /// Shifts the back bed by `rack` needles. Any fraction puts the back needles half way between
    /// front needles.
    pub(super) fn rack(&mut self, rack: f64) {
        let whole = rack.floor();
        self.racked = HALVES * whole as i64 + i64::from(rack > whole);
    }

    /// The place of a needle, in half wales.
    pub(super) fn place(&self, needle: Needle) -> i64 {
        let racked = if needle.bed == Bed::Back { self.racked } else { 0 };
        HALVES * i64::from(needle.number) + racked
    }

    /// The width of `repeats` repeats, in half wales. It is the distance from a needle to the
    /// needle with the same index in the repeat that lies this number of repeats further on.
    pub(super) fn shift(&self, repeats: i32) -> i64 {
        HALVES * i64::from(repeats) * i64::from(self.width)
    }

    /// The slot of a needle; none outside the beds.
    pub(super) fn slot(&self, needle: Needle) -> Option<Slot> {
        let (number, repeat) = if self.repeats {
            (needle.number.rem_euclid(self.width), needle.number.div_euclid(self.width))
        } else {
            (needle.number.checked_sub(self.low)?, 0)
        };
        let number = usize::try_from(number).ok().filter(|_| number < self.width)?;
        let row = 2 * usize::from(needle.bed == Bed::Back) + usize::from(needle.slider);
        Some(Slot { index: row * self.width as usize + number, repeat })
    }

    /// The needle of repeat 0 that the list with this index belongs to.
    pub(super) fn needle(&self, index: usize) -> Needle {
        let width = self.width as usize;
        let bed = if index / width < 2 { Bed::Front } else { Bed::Back };
        Needle { bed, slider: index / width % 2 == 1, number: self.low + (index % width) as i32 }
    }

    /// The loops on a needle, in the order in which they came.
    pub(super) fn stack(&mut self, slot: Slot) -> &mut Vec<Held> {
        &mut self.stacks[slot.index]
    }

    /// The lists of loops of all needles.
    pub(super) fn stacks(&self) -> &[Vec<Held>] {
        &self.stacks
    }

    /// Whether a needle of the other bed less than a wale away holds loops.
    pub(super) fn opposite(&self, needle: Needle) -> bool {
        let (place, bed) = (self.place(needle), needle.bed.other());
        let start = self.place(Needle { bed, slider: false, number: 0 });
        (place - 1..=place + 1).filter(|near| (near - start) % HALVES == 0).any(|near| {
            let number = ((near - start) / HALVES) as i32;
            [false, true].into_iter().any(|slider| {
                let slot = self.slot(Needle { bed, slider, number });
                slot.is_some_and(|slot| !self.stacks[slot.index].is_empty())
            })
        })
    }

    /// Whether two needles face each other, so that loops can go from one to the other.
    pub(super) fn aligned(&self, one: Needle, other: Needle) -> bool {
        self.place(one) == self.place(other)
    }
}
