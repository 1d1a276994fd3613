//! Settling: the yarns of a structure come to rest, and copies of a settled repeat are placed side
//! by side.

mod error;
mod finished;
mod look;
mod piece;
mod repeat;
mod settled;

use std::ops::ControlFlow;
use std::sync::Arc;

use texere_contact::{clearance_with_progress, linking_with_progress};
use texere_core::settling::{self, Rest, SettlingPlan};
use texere_core::{Backend, Layout, Origin, Settings, Yarn, YarnPlace, Yarns};

pub use self::error::FinishError;
pub use self::finished::Finished;
pub(crate) use self::look::Look;
pub use self::piece::Piece;
pub use self::repeat::Repeat;
pub(crate) use self::repeat::settled_together;
pub use self::settled::{Finish, Press, RestBy, Settled};

pub(crate) use self::look::tell;
pub(crate) use self::settled::unchanged;
use crate::{FabricError, thickness_mm};

/// The share of the progress at which all passes have been made. Nothing but the progress depends
/// on the three shares of this file.
const PASSED: f64 = 0.9;
/// The share of the progress at which the start and the end have been compared, to find yarns that
/// have passed through one another.
const COMPARED: f64 = 0.95;

/// Lets the yarns of `piece` settle on `backend`. They move until they nowhere pierce one another,
/// nowhere fold, and have the lengths that `finish` asks for. `progress` gets the share of the work
/// done, from 0 to 1. If it returns `Break`, settling ends: on the CPU within 50 ms, on any
/// other device after the pass that it makes.
///
/// [`Settled::rest`] says whether the yarns came to rest within their passes, with figures. The
/// result is the best of all passes: by clearance, then by bends, then by length. It is never worse
/// than the start ([`texere_core::settling::settle`]). If yarns have passed through one another, or
/// not all could be compared, the yarns of `piece` are returned unmoved. [`Settled::linking`] lists
/// the worst places.
///
/// **Errors**: [`FinishError::Settling`] and [`FinishError::Thread`] for yarns that can't be
/// settled as asked, and [`FinishError::Backend`] for a backend that can't settle, a device that
/// fails, or too many yarns in one place. [`FinishError::Fabric`] holds [`FabricError::Cancelled`]
/// if `progress` answers `Break`, [`FabricError::Yarns`] for yarns that would come to lie too far
/// out, or an error of [`linking()`](texere_contact::linking()) or
/// [`clearance()`](texere_contact::clearance()).
///
/// ```
/// use std::ops::ControlFlow;
/// use texere_core::{ControlPoint, Yarn, Yarns};
/// use texere_cpu::SerialBackend;
/// use texere_fabric::{Finish, Piece, settle};
/// // Two yarns that cross nearer than they are thick, each held at both its ends.
/// let mut yarns = Yarns::builder();
/// let along = [-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0];
/// yarns.yarn(Yarn::default(), &along.map(|x| ControlPoint::new(x, 0.0, 0.2, 0.25)));
/// yarns.yarn(Yarn::default(), &along.map(|y| ControlPoint::new(0.0, y, -0.2, 0.25)));
/// let piece = Piece::cut(yarns.build()?);
/// let settled = settle(&piece, &Finish::default(), &SerialBackend::new(), |_| ControlFlow::Continue(()))?;
/// assert!(settled.rest.at_rest && settled.is_linked());
/// assert!(settled.rest.start.clearance < 0.81 && settled.clearance.min > 0.99);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn settle(
    piece: &Piece,
    finish: &Finish,
    backend: &dyn Backend,
    mut progress: impl FnMut(f64) -> ControlFlow<()> + Send,
) -> Result<Settled, FinishError> {
    tell(&mut progress, 0.0)?;
    let plan = SettlingPlan::new(&piece.settling(finish)).map_err(|source| {
        match source.yarn().and_then(|yarn| piece.yarns.layout().yarns().get(yarn)) {
            // Errors of settling name a yarn of no structure by its number.
            None | Some(Yarn { origin: Origin::Unknown, .. }) => source.into(),
            Some(yarn) => FinishError::Thread { thread: yarn.origin, source },
        }
    })?;
    let plan = Arc::new(plan);
    tell(&mut progress, 0.0)?;
    let mut settler = backend.settler(Arc::clone(&plan))?;
    tell(&mut progress, 0.0)?;
    let (mut course, mut stopped) = (Vec::new(), false);
    // The progress assumes at most `finish.passes` passes of each of the two forms of settling.
    // Settling may make 41 more passes: one that measures the start, and forty in which yarns grow.
    let (mut made, most) = (0.0, 2.0 * f64::from(finish.passes));
    let rest = settling::settle(&plan, settler.as_mut(), |pass, seen| {
        if let Some(seen) = seen {
            if finish.record {
                course.push((*pass, *seen));
            }
            made += 1.0;
        }
        let answer = progress(PASSED * f64::min(made / most, 1.0));
        stopped = answer.is_break();
        answer
    })?;
    if stopped {
        return Err(FabricError::Cancelled.into());
    }
    let points = settling::settled(&plan, settler.as_mut(), piece.yarns.points())?;
    drop(settler);
    tell(&mut progress, PASSED)?;

    let settings = Settings::default();
    let moved = piece.moved(&points).map_err(FabricError::from)?;
    tell(&mut progress, PASSED)?;
    let linking = linking_with_progress(&piece.yarns, &moved, &piece.boundary, |done| {
        progress(PASSED + (COMPARED - PASSED) * done)
    })?;
    let (yarns, rest) = if unchanged(&linking) {
        (moved, rest)
    } else {
        (piece.yarns.clone(), Rest { at_rest: false, end: rest.start, ..rest })
    };
    let measured = |done| progress(COMPARED + (1.0 - COMPARED) * done);
    let clearance = clearance_with_progress(&yarns, &settings, measured)?;
    let press = finish.press_mm.map(|asked| {
        let reached_mm = thickness_mm(&yarns);
        Press { asked_mm: f64::from(asked), reached_mm }
    });
    Ok(Settled { yarns, length: finish.length(), rest, linking, clearance, press, course })
}

/// The share of the progress at which one repeat has settled. Its copies are then measured.
const SETTLED: f64 = 0.8;

/// Lets one repeat settle, and measures [`Settled::clearance`] on all its copies, which `placed`
/// makes.
pub(crate) fn settle_repeat(
    repeat: &Repeat,
    placed: impl FnOnce(&Yarns, Look<'_>) -> Result<Yarns, FabricError>,
    finish: &Finish,
    backend: &dyn Backend,
    mut progress: impl FnMut(f64) -> ControlFlow<()> + Send,
) -> Result<Settled, FinishError> {
    let mut settled = settle(&repeat.piece, finish, backend, |done| progress(SETTLED * done))?;
    let yarns = placed(&settled.yarns, &mut || tell(&mut progress, SETTLED))?;
    tell(&mut progress, SETTLED)?;
    let settings = Settings::default();
    settled.clearance =
        clearance_with_progress(&yarns, &settings, |done| progress(SETTLED + (1.0 - SETTLED) * done))?;
    for passage in &mut settled.linking.worst {
        passage.places =
            passage.places.map(|place| placed_at(&place, settled.yarns.layout(), yarns.layout()));
    }
    Ok(Settled { yarns, ..settled })
}

/// `place` lies on a yarn of the repeat. The result is the same place on the first yarn of `placed`
/// that has the same origin.
fn placed_at(place: &YarnPlace, repeat: &Layout, placed: &Layout) -> YarnPlace {
    let origin = repeat.yarns()[place.yarn].origin;
    let yarn = placed.yarns().iter().position(|yarn| yarn.origin == origin);
    YarnPlace { yarn: yarn.unwrap_or(place.yarn), ..*place }
}
