//! The finish of a design: whether and how its yarns come to rest.

use texere::Design;
use texere::rest::{Finish, Length};
use texere::woven::{BySet, Set, Stretch};

use crate::design::texere_design;
use crate::error::guard;
use crate::failure::Failure;
use crate::handle::{clear, get, give};
use crate::sized::{check_sized, grows_after, sized, write_sized};
use crate::status::texere_status;
use crate::structure::choice;

/// The structure's own choice. A weft knit gets the loop lengths of its program or its gauge; if it
/// has neither, its lengths are free. A warp knit gets the lengths of its run-ins; if a bar with
/// yarns has none, yarns keep their lengths.
pub const TEXERE_LENGTH_USUAL: u32 = 0;
/// Yarns keep their lengths, interval by interval, so that no yarn is drawn along its path.
pub const TEXERE_LENGTH_HELD: u32 = 1;
/// Yarns get `length` times the length that they have at the start, 0.5 to 2.
pub const TEXERE_LENGTH_GIVEN: u32 = 2;
/// Yarns take the length that their path needs. `length` is a tension that shortens them, 0 to 0.1:
/// the share of its length by which an interval is shortened in a pass.
pub const TEXERE_LENGTH_FREE: u32 = 3;

/// Cloth is not stretched.
pub const TEXERE_STRETCH_NONE: u32 = 0;
/// Woven cloth is stretched along its warp.
pub const TEXERE_STRETCH_WARP: u32 = 1;
/// Woven cloth is stretched along its weft.
pub const TEXERE_STRETCH_WEFT: u32 = 2;

/// Whether and how the yarns of a design come to rest.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_finish {
    /// Size of this struct, bytes. The caller sets it.
    pub struct_size: u32,
    /// 1 if the yarns come to rest, 0 if they stay where the structure places them.
    pub settle: u32,
    /// For knits: a constant whose name begins with TEXERE_LENGTH.
    pub length_kind: u32,
    /// A number whose meaning the constant in `length_kind` says.
    pub length: f32,
    /// For knits: distance of two plates that press the cloth while yarns settle, 0.001 to 1000 mm.
    /// 0: no plates.
    pub press_mm: f32,
    /// For woven cloth: tautness of the warp, 0 to 10, 1 in relaxed cloth.
    pub warp_tension: f32,
    /// For woven cloth: tautness of the weft, 0 to 10, 1 in relaxed cloth.
    pub weft_tension: f32,
    /// For woven cloth: how strongly it is pressed flat, 0 to 10, 1 in relaxed cloth.
    pub calender: f32,
    /// A constant whose name begins with TEXERE_STRETCH.
    pub stretch: u32,
    /// For knits: how many passes settling makes at most in each of its two forms, 1 to 1000000.
    /// docs/SETTLING.md describes the weighted form and the block form.
    pub passes: u32,
    /// The factor by which a stretch multiplies the length of the cloth, 0.5 to 2.
    pub stretch_by: f64,
}

grows_after!(texere_finish, stretch_by);

impl texere_finish {
    fn of(design: &Design) -> Self {
        let (length_kind, length) = match design.finish.length {
            None => (TEXERE_LENGTH_USUAL, 0.0),
            Some(Length::Held) => (TEXERE_LENGTH_HELD, 0.0),
            Some(Length::Given(times)) => (TEXERE_LENGTH_GIVEN, times),
            Some(Length::Free { tension }) => (TEXERE_LENGTH_FREE, tension),
        };
        let (stretch, stretch_by) = match design.stretch {
            None => (TEXERE_STRETCH_NONE, 1.0),
            Some(Stretch { along: Set::Warp, by }) => (TEXERE_STRETCH_WARP, by),
            Some(Stretch { along: Set::Weft, by }) => (TEXERE_STRETCH_WEFT, by),
        };
        Self {
            struct_size: size_of::<Self>() as u32,
            settle: design.settle.into(),
            length_kind,
            length,
            press_mm: design.finish.press_mm.unwrap_or(0.0),
            warp_tension: design.finish.taut.warp,
            weft_tension: design.finish.taut.weft,
            calender: design.finish.calender,
            stretch,
            passes: design.finish.passes,
            stretch_by,
        }
    }

    /// Gives this finish to `design`.
    fn set(&self, design: &mut Design) -> Result<(), Failure> {
        let is_woven = design.structure.woven().is_some();
        let length = self.length;
        let lengths = [
            None,
            Some(Length::Held),
            Some(Length::Given(within("length", length, [0.5, 2.0], self.length_kind == 2)?)),
            Some(Length::Free { tension: within("length", length, [0.0, 0.1], self.length_kind == 3)? }),
        ];
        let length = choice("finish.length_kind", self.length_kind, &lengths)?;
        let pressed = self.press_mm != 0.0;
        let press_mm = within("press_mm", self.press_mm, [0.001, 1000.0], pressed)?;
        let stretches = [None, Some(Set::Warp), Some(Set::Weft)];
        let along = choice("finish.stretch", self.stretch, &stretches)?;
        if is_woven && (pressed || length.is_some()) {
            return Err(Failure::argument("finish.length_kind and finish.press_mm are those of a knit"));
        }
        if !is_woven && along.is_some() {
            return Err(Failure::argument("finish.stretch is that of woven cloth"));
        }
        let times = |name, value| within(name, value, [0.0, 10.0], true);
        if along.is_some() && !(0.5..=2.0).contains(&self.stretch_by) {
            let by = self.stretch_by;
            return Err(Failure::argument(format!("finish.stretch_by is {by}, expected 0.5 to 2")));
        }
        if !(1..=1_000_000).contains(&self.passes) {
            let passes = self.passes;
            return Err(Failure::argument(format!("finish.passes is {passes}, expected 1 to 1000000")));
        }
        design.finish = Finish {
            length,
            press_mm: pressed.then_some(press_mm),
            passes: self.passes,
            taut: BySet {
                warp: times("warp_tension", self.warp_tension)?,
                weft: times("weft_tension", self.weft_tension)?,
            },
            calender: times("calender", self.calender)?,
            ..design.finish
        };
        design.settle = choice("finish.settle", self.settle, &[false, true])?;
        design.stretch = along.map(|along| Stretch { along, by: self.stretch_by });
        Ok(())
    }
}

/// Makes sure that a member of the struct lies within its limits. A member that does not count,
/// because another member makes it meaningless, may have any value.
fn within(name: &str, value: f32, [low, high]: [f32; 2], counts: bool) -> Result<f32, Failure> {
    if !counts || (low..=high).contains(&value) {
        return Ok(value);
    }
    Err(Failure::argument(format!("finish.{name} is {value}, expected {low} to {high}")))
}

/// Writes the finish of a design. The caller sets `finish->struct_size` before the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_design_finish(
    design: *const texere_design,
    finish: *mut texere_finish,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `finish`.
        unsafe { check_sized("finish", finish) }?;
        let found = texere_finish::of(&*get(design)?);
        // SAFETY: `check_sized` has accepted the size; the caller vouches for the memory.
        unsafe { write_sized(finish, found) };
        Ok(())
    })
}

/// Makes a copy of a design with the finish `finish`.
///
/// Fails with TEXERE_ARGUMENT for a value out of range, and for a finish that the structure does
/// not have, such as a stretch of a knit.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_design_finished(
    design: *const texere_design,
    finish: *const texere_finish,
    out: *mut *mut texere_design,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `out` and `finish`.
        let finish = unsafe {
            clear(out)?;
            sized("finish", finish)?
        };
        let mut design = (*get(design)?).clone();
        finish.set(&mut design)?;
        // SAFETY: as above.
        unsafe { give(out, design) }
    })
}
