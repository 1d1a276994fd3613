//! Relaxation: the yarns of a knit come to rest by their energy, and the gauge follows.

mod elastic;

use std::ops::ControlFlow;
use std::sync::Arc;

use texere_contact::{Clearance, Linking, clearance_with_progress, linking_with_progress};
use texere_core::relaxation::{Energy, Relaxation, RelaxationPlan, RelaxationState, relax};
use texere_core::settling::Length;
use texere_core::{Backend, Boundary, ControlPoint, Settings, Yarns};

pub use self::elastic::elastic_of_radius;
use crate::settling::{Look, tell, unchanged};
use crate::weft::Gauge;
use crate::{FabricError, FinishError, Piece, Repeat};

/// The most steps in which yarns that have grown come to rest.
const STEPS: u32 = 3000;

/// The steps in which yarns grow: only the progress depends on them.
const GROWING: u32 = 300;

/// The share of the progress at which the yarns are at rest. Their clearance is then measured.
const RELAXED: f64 = 0.95;

/// The longest way of a control point, in radii of the thinnest yarn, after which linking is
/// compared. Over longer ways more pairs of yarns have to be compared, and windows of yarn that
/// have bent much look as if they had passed through one another.
const COMPARED: f64 = 0.5;

/// A knit that has come to rest by its energy, or as near to rest as it came.
#[derive(Debug, Clone)]
pub struct RelaxedKnit {
    /// The yarns of the whole cloth. If any yarns have passed through one another, they are the
    /// cloth's own yarns, as placed.
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

/// Relaxes one repeat of a knit on `backend`, and places its copies with `placed`. `gauge` is that
/// of the cloth, and `length` the rule for its lengths; free lengths are held.
pub(crate) fn relax_repeat(
    repeat: &Repeat,
    gauge: &Gauge,
    length: Length,
    placed: impl FnOnce(&Repeat, &Yarns, Look<'_>) -> Result<Yarns, FabricError>,
    backend: &dyn Backend,
    mut progress: impl FnMut(f64) -> ControlFlow<()> + Send,
) -> Result<RelaxedKnit, FinishError> {
    tell(&mut progress, 0.0)?;
    let piece = &repeat.piece;
    let elastic = elastic::of_yarns(&piece.yarns);
    let factor = if let Length::Given(factor) = length { f64::from(factor) } else { 1.0 };
    let problem = Relaxation::new(&piece.yarns, &elastic)
        .boundary(piece.boundary.clone())
        .pinned(piece.pinned.clone())
        .length(factor)
        .press(elastic::press_of(&elastic))
        .steps(STEPS);
    let plan = Arc::new(RelaxationPlan::new(&problem)?);
    let mut relaxer = backend.relaxer(Arc::clone(&plan))?;
    let thinnest = elastic.iter().map(|elastic| elastic.core).fold(f64::INFINITY, f64::min);
    let mut compared = Compared::new(piece, plan.start(), COMPARED * thinnest);
    let (mut made, mut failed, mut cancelled) = (0_u32, None, false);
    let relaxed = relax(&plan, relaxer.as_mut(), |state| {
        let mut ask = || progress(RELAXED * f64::min(f64::from(made) / f64::from(GROWING + STEPS), 1.0));
        match state.map(|state| compared.is_linked(state, &mut ask)) {
            Some(Ok(false)) => return ControlFlow::Break(()),
            Some(Err(error)) => {
                failed = Some(error);
                return ControlFlow::Break(());
            }
            Some(Ok(true)) | None => {}
        }
        let answer = ask();
        made += u32::from(state.is_some());
        cancelled = answer.is_break();
        answer
    })?;
    drop(relaxer);
    if let Some(error) = failed {
        return Err(error);
    }
    if cancelled {
        return Err(FabricError::Cancelled.into());
    }
    let relaxed = match relaxed {
        ControlFlow::Continue(relaxed) => {
            let linked = compared.compare(compared.back(&relaxed.state), &mut || progress(RELAXED))?;
            linked.then_some(relaxed)
        }
        ControlFlow::Break(()) => None,
    };
    let moved = match &relaxed {
        Some(relaxed) => compared.piece_of(&relaxed.state)?,
        None => piece.clone(),
    };
    let rest = Repeat { piece: moved, copies: repeat.copies };
    let yarns = placed(&rest, &rest.piece.yarns, &mut || tell(&mut progress, RELAXED))?;
    let settings = Settings::default();
    let clearance =
        clearance_with_progress(&yarns, &settings, |done| progress(RELAXED + (1.0 - RELAXED) * done))?;
    let scale = [0, 1]
        .map(|axis| f64::from(rest.piece.boundary.repeat()[axis]) / f64::from(piece.boundary.repeat()[axis]));
    let gauge = Gauge { wale_mm: gauge.wale_mm * scale[0], course_mm: gauge.course_mm * scale[1], ..*gauge };
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

/// The yarns of a piece at the state that was compared last. All states are compared as if their
/// repeat had its first lengths: stretching it passes no yarn through another.
struct Compared<'a> {
    piece: &'a Piece,
    last: Yarns,
    from: RelaxationState,
    /// The way of a control point after which linking is compared, mm.
    way: f64,
    linking: Linking,
}

impl<'a> Compared<'a> {
    fn new(piece: &'a Piece, start: &RelaxationState, way: f64) -> Self {
        let linking = Linking { largest: 0.0, passages: 0, worst: Vec::new(), compared: 0, left_out: 0 };
        Self { piece, last: piece.yarns.clone(), from: start.clone(), way, linking }
    }

    /// Whether no yarn has passed through another since the last state that was compared. Compares
    /// only once a point has moved far enough. `ask` says whether to go on.
    fn is_linked(
        &mut self,
        state: &RelaxationState,
        ask: &mut (dyn FnMut() -> ControlFlow<()> + Send),
    ) -> Result<bool, FinishError> {
        let back = self.back(state);
        let moved = self.from.points.iter().zip(&back.points).map(|(from, to)| from.distance(*to));
        if moved.fold(0.0, f64::max) <= self.way { Ok(true) } else { self.compare(back, ask) }
    }

    /// `state` as if its repeat had its first lengths.
    fn back(&self, state: &RelaxationState) -> RelaxationState {
        state.stretched(self.from.repeat / state.repeat)
    }

    /// Compares `back`, made by [`Compared::back`], with the last state that was compared.
    fn compare(
        &mut self,
        back: RelaxationState,
        ask: &mut (dyn FnMut() -> ControlFlow<()> + Send),
    ) -> Result<bool, FinishError> {
        let yarns = self.piece.moved(&points(&back, &self.piece.yarns)).map_err(FabricError::from)?;
        let linking = linking_with_progress(&self.last, &yarns, &self.piece.boundary, |_| ask())?;
        let linked = unchanged(&linking);
        (self.last, self.from, self.linking) = (yarns, back, linking);
        Ok(linked)
    }

    /// The piece in `state`, with its repeat.
    fn piece_of(&self, state: &RelaxationState) -> Result<Piece, FinishError> {
        let yarns = self.piece.moved(&points(state, &self.piece.yarns)).map_err(FabricError::from)?;
        let repeat = [state.repeat.x as f32, state.repeat.y as f32];
        let ends = self.piece.boundary.ends().to_vec();
        let boundary = Boundary::new(yarns.layout(), repeat, ends).map_err(FabricError::from)?;
        Ok(Piece { yarns, boundary, pinned: self.piece.pinned.clone() })
    }
}

/// Control points at the places of `state`, with the sections of `yarns`.
fn points(state: &RelaxationState, yarns: &Yarns) -> Vec<ControlPoint> {
    let placed = state.points.iter().zip(yarns.points());
    placed
        .map(|(at, point)| {
            let at = at.as_vec3();
            ControlPoint { x: at.x, y: at.y, z: at.z, ..*point }
        })
        .collect()
}
