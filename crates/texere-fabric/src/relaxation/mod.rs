//! Relaxation: the yarns of a knit come to rest by their energy, and the gauge follows.

mod elastic;
mod relaxing;
mod strain;

use std::ops::ControlFlow;

use glam::DVec2;
use texere_contact::{Clearance, Linking, clearance_with_progress};
use texere_core::relaxation::Energy;
use texere_core::{Backend, Settings, Yarns};

pub use self::elastic::elastic_of_radius;
use self::relaxing::{Relaxing, STEPS};
pub(crate) use self::strain::strain_repeat;
pub use self::strain::{StrainState, StrainTest};
use crate::settling::{Look, tell, unchanged};
use crate::weft::Gauge;
use crate::{Along, FabricError, Finish, FinishError, Piece, Repeat};

/// The most steps in which yarns grow to their full thickness. Only the progress depends on this
/// number.
const GROWING: u32 = 300;

/// The share of the progress at which the yarns are at rest. Their clearance is then measured.
const RELAXED: f64 = 0.95;

/// A knit that has come to rest by its energy, or as near to rest as it came.
#[derive(Debug, Clone)]
pub struct RelaxedKnit {
    /// The yarns of the whole cloth. If any yarns have passed through one another, these are the
    /// cloth's yarns as they were placed before they moved.
    pub yarns: Yarns,
    /// The distances of wales and courses at rest, and in a weft knit the mean length of a loop.
    pub gauge: Gauge,
    /// Whether the forces balance: see
    /// [`Relaxed::at_rest`](texere_core::relaxation::Relaxed::at_rest).
    pub balanced: bool,
    /// Number of steps in which the yarns came to rest after they had grown. 0 if yarns have passed
    /// through one another.
    pub steps: u32,
    /// The energy of one repeat.
    pub energy: Energy,
    /// The largest force that balances no other force, N.
    pub unbalanced: f64,
    /// The largest force with which yarns press on one another between two control points, N.
    pub pressed: f64,
    /// Whether yarns have passed through one another, with the worst places.
    pub linking: Linking,
    /// The clearance of the whole cloth.
    pub clearance: Clearance,
}

impl RelaxedKnit {
    /// Whether no yarn has passed through another. False if some yarns could not be compared.
    #[must_use]
    pub const fn is_linked(&self) -> bool {
        unchanged(&self.linking)
    }
}

/// Relaxes one repeat of a knit on `backend`, and places its copies with `placed`. `gauge` is the
/// gauge of the cloth. `finish` says how long its yarns become, and along what it is held. If
/// `finish` leaves lengths free, the yarns keep their lengths.
pub(crate) fn relax_repeat(
    repeat: &Repeat,
    gauge: &Gauge,
    finish: &Finish,
    placed: impl FnOnce(&Repeat, &Yarns, Look<'_>) -> Result<Yarns, FabricError>,
    backend: &dyn Backend,
    mut progress: impl FnMut(f64) -> ControlFlow<()> + Send,
) -> Result<RelaxedKnit, FinishError> {
    tell(&mut progress, 0.0)?;
    let piece = &repeat.piece;
    let held = finish.hold.map_or([false; 2], Along::held);
    let mut relaxing = Relaxing::new(piece, finish.length(), held, backend)?;
    let most = f64::from(GROWING + STEPS);
    let relaxed = relaxing.rest(&mut |made| progress(RELAXED * f64::min(f64::from(made) / most, 1.0)))?;
    let compared = relaxing.compared;
    let moved = match &relaxed {
        Some(relaxed) => compared.piece_of(&relaxed.state)?,
        None => piece.clone(),
    };
    let rest = Repeat { piece: moved, copies: repeat.copies };
    let yarns = placed(&rest, &rest.piece.yarns, &mut || tell(&mut progress, RELAXED))?;
    let settings = Settings::default();
    let clearance =
        clearance_with_progress(&yarns, &settings, |done| progress(RELAXED + (1.0 - RELAXED) * done))?;
    let size = DVec2::from(rest.piece.boundary.repeat().map(f64::from));
    let gauge = gauge_at(size, gauge, piece);
    Ok(RelaxedKnit {
        yarns,
        gauge,
        balanced: relaxed.as_ref().is_some_and(|relaxed| relaxed.at_rest),
        steps: relaxed.as_ref().map_or(0, |relaxed| relaxed.steps),
        energy: relaxed.as_ref().map_or_else(Energy::default, |relaxed| relaxed.energy),
        unbalanced: relaxed.as_ref().map_or(0.0, |relaxed| relaxed.unbalanced),
        pressed: relaxed.as_ref().map_or(0.0, |relaxed| relaxed.pressed),
        linking: compared.linking,
        clearance,
    })
}

/// The gauge of a cloth whose repeat has become `size`, mm. It was `gauge` for the repeat of
/// `piece`.
fn gauge_at(size: DVec2, gauge: &Gauge, piece: &Piece) -> Gauge {
    let scale = size / DVec2::from(piece.boundary.repeat().map(f64::from));
    Gauge { wale_mm: gauge.wale_mm * scale.x, course_mm: gauge.course_mm * scale.y, ..*gauge }
}
