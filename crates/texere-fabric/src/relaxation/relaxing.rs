//! A piece of knit that relaxes: the search for rest, and whether its yarns are linked as before.

use std::ops::ControlFlow;
use std::sync::Arc;

use texere_contact::{Linking, linking_with_progress};
use texere_core::relaxation::{
    Relaxation, RelaxationPlan, RelaxationState, Relaxed, Relaxer, relax, relax_grown,
};
use texere_core::settling::Length;
use texere_core::{Backend, Boundary, ControlPoint, Yarns};

use super::elastic;
use crate::settling::unchanged;
use crate::{FabricError, FinishError, Piece};

/// The most steps in which yarns that have grown come to rest.
pub(super) const STEPS: u32 = 3000;

/// The longest way of a control point, in radii of the thinnest yarn, after which linking is
/// compared. Over longer ways more pairs of yarns have to be compared, and short stretches of yarn
/// that have bent much look as if they had passed through one another. With half the value, and
/// with twice, no test is red.
const COMPARED: f64 = 0.5;

/// Asks whether to go on after a number of steps.
pub(super) type Ask<'a> = &'a mut (dyn FnMut(u32) -> ControlFlow<()> + Send);

/// A piece that relaxes on a device.
pub(super) struct Relaxing<'a> {
    plan: Arc<RelaxationPlan>,
    relaxer: Box<dyn Relaxer>,
    pub(super) compared: Compared<'a>,
}

impl<'a> Relaxing<'a> {
    /// `length` is the rule for the lengths of the yarns. If it leaves them free, the yarns keep
    /// their lengths. At rest the repeat keeps its length along the axes that `held` names.
    pub(super) fn new(
        piece: &'a Piece,
        length: Length,
        held: [bool; 2],
        backend: &dyn Backend,
    ) -> Result<Self, FinishError> {
        let elastic = elastic::of_yarns(&piece.yarns);
        let factor = if let Length::Given(factor) = length { f64::from(factor) } else { 1.0 };
        let problem = Relaxation::new(&piece.yarns, &elastic)
            .boundary(piece.boundary.clone())
            .pinned(piece.pinned.clone())
            .length(factor)
            .press(elastic::press_of(&elastic))
            .held(held)
            .steps(STEPS);
        let plan = Arc::new(RelaxationPlan::new(&problem)?);
        let relaxer = backend.relaxer(Arc::clone(&plan))?;
        let thinnest = elastic.iter().map(|elastic| elastic.core).fold(f64::INFINITY, f64::min);
        // Linking is first compared with the points as they are placed. The start of the plan is
        // another state: the plan spreads the points of yarns that go round.
        let points = piece.yarns.points().iter().map(|point| point.position().as_dvec3()).collect();
        let placed = RelaxationState { points, repeat: plan.start().repeat };
        let compared = Compared::new(piece, placed, COMPARED * thinnest);
        Ok(Self { plan, relaxer, compared })
    }

    /// The yarns at rest, or none if some have passed through one another.
    pub(super) fn rest(&mut self, ask: Ask<'_>) -> Result<Option<Relaxed>, FinishError> {
        self.watched(ask, |plan, relaxer, watch| relax(plan, relaxer, watch))
    }

    /// Yarns that are at rest or nearly, in a repeat that keeps its length along the axes that
    /// `held` names. None if some have passed through one another.
    pub(super) fn strained(
        &mut self,
        state: RelaxationState,
        held: [bool; 2],
        ask: Ask<'_>,
    ) -> Result<Option<Relaxed>, FinishError> {
        self.watched(ask, |plan, relaxer, watch| relax_grown(plan, relaxer, state, held, watch))
    }

    /// Runs `search`, and compares the linking of its states on the way. None if some yarns have
    /// passed through one another.
    fn watched(
        &mut self,
        ask: Ask<'_>,
        search: impl FnOnce(
            &RelaxationPlan,
            &mut dyn Relaxer,
            &mut dyn FnMut(Option<&RelaxationState>) -> ControlFlow<()>,
        ) -> Result<ControlFlow<(), Relaxed>, texere_core::BackendError>,
    ) -> Result<Option<Relaxed>, FinishError> {
        let Self { plan, relaxer, compared } = self;
        let (mut made, mut failed, mut cancelled) = (0_u32, None, false);
        let relaxed = search(plan, relaxer.as_mut(), &mut |state| {
            match state.map(|state| compared.is_linked(state, &mut || ask(made))) {
                Some(Ok(false)) => return ControlFlow::Break(()),
                Some(Err(error)) => {
                    failed = Some(error);
                    return ControlFlow::Break(());
                }
                Some(Ok(true)) | None => {}
            }
            let answer = ask(made);
            made += u32::from(state.is_some());
            cancelled = answer.is_break();
            answer
        })?;
        if let Some(error) = failed {
            return Err(error);
        }
        if cancelled {
            return Err(FabricError::Cancelled.into());
        }
        let ControlFlow::Continue(relaxed) = relaxed else { return Ok(None) };
        let linked = compared.compare(&relaxed.state, &mut || ask(made))?;
        Ok(linked.then_some(relaxed))
    }
}

/// A piece, and the state that was compared last. The last state is compared as if its repeat had
/// the lengths of the next state: stretching a repeat passes no yarn through another.
pub(super) struct Compared<'a> {
    piece: &'a Piece,
    last: RelaxationState,
    /// The way of a control point after which linking is compared, mm.
    way: f64,
    pub(super) linking: Linking,
}

impl<'a> Compared<'a> {
    fn new(piece: &'a Piece, placed: RelaxationState, way: f64) -> Self {
        let linking = Linking { largest: 0.0, passages: 0, worst: Vec::new(), compared: 0, left_out: 0 };
        Self { piece, last: placed, way, linking }
    }

    /// Goes back to a state that was compared before.
    pub(super) fn go_back(&mut self, state: &RelaxationState) {
        self.last = state.clone();
    }

    /// Whether no yarn has passed through another since the last state that was compared. Compares
    /// only once a point has moved far enough. `ask` says whether to go on.
    fn is_linked(
        &mut self,
        state: &RelaxationState,
        ask: &mut (dyn FnMut() -> ControlFlow<()> + Send),
    ) -> Result<bool, FinishError> {
        let last = self.last_in(state);
        let moved = last.points.iter().zip(&state.points).map(|(last, now)| last.distance(*now));
        if moved.fold(0.0, f64::max) <= self.way { Ok(true) } else { self.compare(state, ask) }
    }

    /// The last state as if its repeat had the lengths of `state`.
    fn last_in(&self, state: &RelaxationState) -> RelaxationState {
        self.last.stretched(state.repeat / self.last.repeat)
    }

    /// Compares `state` with the last state that was compared.
    fn compare(
        &mut self,
        state: &RelaxationState,
        ask: &mut (dyn FnMut() -> ControlFlow<()> + Send),
    ) -> Result<bool, FinishError> {
        let last = self.piece_of(&self.last_in(state))?;
        let now = self.piece_of(state)?;
        let linking = linking_with_progress(&last.yarns, &now.yarns, &now.boundary, |_| ask())?;
        let linked = unchanged(&linking);
        (self.last, self.linking) = (state.clone(), linking);
        Ok(linked)
    }

    /// The piece in `state`, with its repeat.
    pub(super) fn piece_of(&self, state: &RelaxationState) -> Result<Piece, FinishError> {
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
