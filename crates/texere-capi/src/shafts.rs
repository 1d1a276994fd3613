//! Shaft drafts from the caller's arrays: threading, tie-up and treadling, or a lift plan.

use texere::woven::{Draft, LOOM_MAX, Shedding};

use crate::argument::flag;
use crate::failure::Failure;
use crate::material::array;
use crate::sized::grows_after;

/// Lists of numbers, which lie one behind the other in one array.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_lists {
    /// The numbers of all lists.
    pub numbers: *const u32,
    /// Where each list begins in `numbers`, counted from 0, and at the end how many numbers there
    /// are in all: one offset more than there are lists. Null: every list has one number.
    pub offsets: *const u64,
}

/// A shaft draft. Shafts and treadles count from 1, as weavers write them. The number 0 stands for
/// none; a number that a list has twice counts once.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_draft {
    /// Size of this struct, bytes. The caller sets it.
    pub struct_size: u32,
    /// 0 if lifted shafts carry their ends to the face, 1 if they carry them to the back.
    pub sinking_shed: u32,
    /// How many shafts, 1 to 100000.
    pub shafts: u32,
    /// How many treadles, 0 to 100000. 0 stands for a loom without treadles, such as a dobby loom.
    pub treadles: u32,
    /// For each end the shafts that carry it: as many lists as ends.
    pub threading: texere_lists,
    /// For each treadle the shafts that are tied to it: as many lists as treadles.
    pub tie_up: texere_lists,
    /// For each pick the treadles that it presses: as many lists as picks. On a loom without
    /// treadles this is the lift plan, which has for each pick the shafts that it lifts.
    pub treadling: texere_lists,
}

grows_after!(texere_draft, treadling);

impl texere_lists {
    /// `count` lists of numbers. The caller's numbers are 0 to `limit`; the result has no 0, and no
    /// list has a number twice. `name` is the name of the struct member in error messages.
    ///
    /// # Safety
    ///
    /// Both arrays are valid for reads.
    unsafe fn read(&self, name: &str, count: usize, limit: u32) -> Result<Vec<Vec<u32>>, Failure> {
        let one_each: Vec<u64>;
        let offsets = if self.offsets.is_null() {
            one_each = (0..=count as u64).collect();
            &one_each[..]
        } else {
            // SAFETY: the caller vouches for it.
            unsafe { array(&format!("{name}.offsets"), self.offsets, count as u64 + 1) }?
        };
        check_offsets(name, offsets)?;
        let total = offsets[count];
        // SAFETY: the caller vouches for it.
        let numbers = unsafe { array(&format!("{name}.numbers"), self.numbers, total) }?;
        if let Some((at, number)) = numbers.iter().enumerate().find(|(_, number)| **number > limit) {
            return Err(Failure::argument(format!(
                "{name}.numbers[{at}] is {number}, expected 0 to {limit}"
            )));
        }
        let list = |ends: &[u64]| {
            let list = &numbers[ends[0] as usize..ends[1] as usize];
            let mut list: Vec<_> = list.iter().copied().filter(|number| *number > 0).collect();
            list.sort_unstable();
            list.dedup();
            list
        };
        Ok(offsets.windows(2).map(list).collect())
    }
}

/// Refuses offsets that do not begin at 0, and offsets below the one before.
fn check_offsets(name: &str, offsets: &[u64]) -> Result<(), Failure> {
    if offsets[0] != 0 {
        return Err(Failure::argument(format!("{name}.offsets[0] is {}, expected 0", offsets[0])));
    }
    match offsets.windows(2).position(|pair| pair[1] < pair[0]) {
        None => Ok(()),
        Some(before) => Err(Failure::argument(format!(
            "{name}.offsets[{}] is {}, expected {} or more, as the one before",
            before + 1,
            offsets[before + 1],
            offsets[before]
        ))),
    }
}

impl texere_draft {
    /// The draft of a cloth with this number of ends and picks.
    ///
    /// # Safety
    ///
    /// All arrays are valid for reads.
    pub(crate) unsafe fn read(&self, ends: usize, picks: usize) -> Result<Draft, Failure> {
        let Self { shafts, treadles, .. } = *self;
        let rising_shed = !flag("woven.draft.sinking_shed", self.sinking_shed)?;
        for (name, count, least) in [("shafts", shafts, 1), ("treadles", treadles, 0)] {
            if !(least..=LOOM_MAX).contains(&count) {
                return Err(Failure::argument(format!(
                    "woven.draft.{name} is {count}, expected {least} to {LOOM_MAX}"
                )));
            }
        }
        // SAFETY: the caller vouches for all of them.
        unsafe {
            let threading = self.threading.read("woven.draft.threading", ends, shafts)?;
            let picked = if treadles == 0 { shafts } else { treadles };
            let picks = self.treadling.read("woven.draft.treadling", picks, picked)?;
            let shedding = if treadles == 0 {
                Shedding::LiftPlan(picks)
            } else {
                let tie_up = self.tie_up.read("woven.draft.tie_up", treadles as usize, shafts)?;
                Shedding::TieUp { tie_up, treadling: picks }
            };
            Ok(Draft { threading, shedding, rising_shed })
        }
    }
}
