//! What the structures by arrays share: choices by number, and which value of which array an error
//! is about.

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
    /// Its diameter, mm; `texere_diameter` gives it for a yarn count.
    pub diameter_mm: f64,
    /// Twist, radians a mm; positive is Z twist.
    pub twist: f32,
    /// The number of its material, from 0.
    pub material: u32,
    /// The number of its section, from 0.
    pub section: u32,
    /// Zero.
    pub reserved: u32,
}

/// As many control points as the bends of a yarn need.
pub const TEXERE_CELLS_ROUND: u32 = 0;
/// Equally many control points for each stitch.
pub const TEXERE_CELLS_EVEN: u32 = 1;

impl texere_knit_yarn {
    pub(crate) fn read(&self) -> KnitYarn {
        let Self { diameter_mm, twist, material, section, .. } = *self;
        KnitYarn { radius_mm: (diameter_mm / 2.0) as f32, material, section, twist }
    }
}

/// The one of `choices` with the number `given`, from 0. `name` is the member's.
pub(crate) fn choice<T: Copy>(name: &str, given: u32, choices: &[T]) -> Result<T, Failure> {
    let last = choices.len() - 1;
    let chosen = usize::try_from(given).ok().and_then(|given| choices.get(given));
    chosen.copied().ok_or_else(|| Failure::argument(format!("{name} is {given}, expected 0 to {last}")))
}

/// The failure of a structure by arrays: the error, and before it the value that it is about.
/// `name` is the struct's, `bars` are its guide bars.
pub(crate) fn refused(name: &str, error: FabricError, bars: &[Bar]) -> Failure {
    let array = error.subject().and_then(|subject| array_of(subject, bars));
    let array = array.map(|array| format!(".{array}")).unwrap_or_default();
    let is_memory = matches!(error, FabricError::OutOfMemory(_));
    let Failure { message, .. } = error.into();
    let status = if is_memory { TEXERE_MEMORY } else { TEXERE_ARGUMENT };
    Failure { status, message: format!("{name}{array}: {message}"), place: None }
}

/// The array that a subject lies in, with its number there.
fn array_of(subject: Subject, bars: &[Bar]) -> Option<String> {
    use Subject::{Color, Flatness, Jacquard, Offset, RunIn, Section, Spacing, Stiffness};
    use Subject::{Thickness, Threading, Twist};
    let bar = |number: usize, member: &str| Some(format!("bars[{}].{member}", number.checked_sub(1)?));
    let thread = match subject {
        Spacing(thread) | Thickness(thread) | Flatness(thread) | Stiffness(thread) | Twist(thread)
        | Color(thread) | Section(thread) => thread,
        Threading(number) => return bar(number, "threading"),
        Offset(number) => return bar(number, "offset"),
        RunIn(number) => return bar(number, "run_in_mm"),
        Jacquard(number) => return bar(number, "laps"),
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
