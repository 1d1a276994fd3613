//! What woven cloth, weft knits and warp knits from the caller's arrays share: choices by number,
//! and the name of the array element that an error is about.

use texere::FabricError;
use texere::rest::Subject;
use texere::warp::Bar;
use texere::weft::KnitYarn;
use texere::yarn::Origin;

use crate::failure::Failure;
use crate::status::texere_status::{TEXERE_ARGUMENT, TEXERE_MEMORY};

/// A yarn of a knit.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_knit_yarn {
    /// Its diameter, mm. `texere_diameter` works it out from a linear density in tex.
    pub diameter_mm: f64,
    /// Twist, radians per mm; positive is Z twist.
    pub twist: f32,
    /// The number of its material, from 0.
    pub material: u32,
    /// The number of its section, from 0.
    pub section: u32,
    /// Zero.
    pub reserved: u32,
}

/// Each stitch has as many control points as the bends of its yarn need.
pub const TEXERE_CELLS_ROUND: u32 = 0;
/// All stitches have the same number of control points.
pub const TEXERE_CELLS_EVEN: u32 = 1;

impl texere_knit_yarn {
    pub(crate) fn read(&self) -> KnitYarn {
        let Self { diameter_mm, twist, material, section, .. } = *self;
        KnitYarn { radius_mm: (diameter_mm / 2.0) as f32, material, section, twist }
    }
}

/// Element `given` of `choices`, counted from 0. `name` is the name of the struct member in the
/// error message.
pub(crate) fn choice<T: Copy>(name: &str, given: u32, choices: &[T]) -> Result<T, Failure> {
    let last = choices.len() - 1;
    let chosen = usize::try_from(given).ok().and_then(|given| choices.get(given));
    chosen.copied().ok_or_else(|| Failure::argument(format!("{name} is {given}, expected 0 to {last}")))
}

/// The failure of a structure from arrays. Its message is the error, after the name of the struct
/// and of the array element that the error is about. `name` is the struct's name. `bars` are the
/// guide bars of a warp knit, else none.
pub(crate) fn refused(name: &str, error: FabricError, bars: &[Bar]) -> Failure {
    let array = error.subject().and_then(|subject| array_of(subject, bars));
    let array = array.map(|array| format!(".{array}")).unwrap_or_default();
    let is_memory = matches!(error, FabricError::OutOfMemory(_));
    let Failure { message, .. } = error.into();
    let status = if is_memory { TEXERE_MEMORY } else { TEXERE_ARGUMENT };
    Failure { status, message: format!("{name}{array}: {message}"), place: None }
}

/// The array element that the subject of an error comes from, such as `warp[2]`.
fn array_of(subject: Subject, bars: &[Bar]) -> Option<String> {
    use Subject::{Color, Firmness, Flatness, Jacquard, LeastArea, Offset, RunIn, Section, Spacing};
    use Subject::{Stiffness, Thickness, Threading, Twist};
    let bar = |number: usize, member: &str| Some(format!("bars[{}].{member}", number.checked_sub(1)?));
    let thread = match subject {
        Spacing(thread) | Thickness(thread) | Flatness(thread) | Stiffness(thread) | Firmness(thread)
        | LeastArea(thread) | Twist(thread) | Color(thread) | Section(thread) => thread,
        Threading(number) => return bar(number, "threading"),
        Offset(number) => return bar(number, "offset"),
        RunIn(number) => return bar(number, "run_in_mm"),
        Jacquard(number) => return Some(format!("jacquards[{}].shifts", number.checked_sub(1)?)),
        _ => return None,
    };
    let numbered = |array: &str, number: u32| Some(format!("{array}[{}]", number.checked_sub(1)?));
    match thread {
        Origin::End(number) => numbered("warp", number),
        Origin::Pick(number) => numbered("weft", number),
        Origin::Carrier(number) => numbered("yarns", number),
        Origin::Guide { bar, guide } => {
            let held = &bars.get(bar.checked_sub(1)? as usize)?.threading;
            Some(format!("yarns[{}]", held.yarn(guide.checked_sub(1)?)?))
        }
        _ => None,
    }
}
