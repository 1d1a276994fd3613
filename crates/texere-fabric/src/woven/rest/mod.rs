//! Woven cloth at rest. Its crossings settle on a device, and its yarns follow from the crossings.

mod certificate;
mod ease;
mod held;
mod nesting;
mod path;
mod plies;
mod problem;
mod resting;
mod span;
mod stop;
mod stretch;
mod turn;

use std::ops::ControlFlow;
use std::sync::Arc;

use texere_core::backend::zeroed;
use texere_core::crossings::{self, CrossingState, Crossings, CrossingsPlan, CrossingsRest};
use texere_core::{Backend, Yarns, check_tension};

use self::certificate::certify;
use self::problem::Problem;
use self::resting::RestingRepeat;
pub use self::stretch::Stretch;
use crate::{BySet, FabricError, Finish, FinishError, Woven};

/// The share of the progress of settling and thinning at which crossings have settled. In the rest
/// of this progress, surfaces are measured and threads are made thinner.
const SETTLED: f64 = 0.5;
/// The share of all progress at which threads have been made thinner.
const CERTIFIED: f64 = 0.95;

/// Woven cloth that has come to rest.
#[derive(Debug, Clone)]
pub struct WovenRest {
    /// The yarns of the cloth, in the order of [`Woven::yarns`].
    pub yarns: Yarns,
    /// Numbers of ends and picks that have settled: the smallest repeat of threads and crossings,
    /// or the whole cloth if nothing repeats.
    pub repeat: BySet<usize>,
    /// The number of passes over the crossings, and the measures of the last pass.
    pub crossings: CrossingsRest,
    /// The least clearance of surfaces, before any thread was made thinner and afterwards. It is
    /// 0.99 at most, because wider contacts are not looked for.
    pub clearance: [f64; 2],
    /// The tightest bend: its radius of curvature over the distance by which the thread reaches
    /// into the bend. It is 1 at most, because wider bends are not looked for.
    pub bend: f64,
    /// Number of rounds in which threads were made thinner.
    pub rounds: u32,
    /// The share of their cross-section's area that threads of each set keep, as the mean over all
    /// crossings.
    pub area: BySet<f64>,
    /// The share of their cross-section's area that threads of each set keep at the set's worst
    /// crossing.
    pub area_least: BySet<f64>,
    /// The share of their cross-section's area that threads of each set lost when threads were made
    /// thinner, as the mean over all crossings.
    pub area_lost: BySet<f64>,
    /// Whether a thread is as dense at some crossing as its fibres allow
    /// ([`Thread::least_area`](crate::Thread::least_area)).
    pub solid: bool,
    /// The least distance of a valley between two plies from the thread's axis, as a share of the
    /// distance to which a ply reaches ([`Section::Lobed`](texere_core::Section::Lobed)). It grows
    /// when plies press into one another. With 1, plied threads are round. `None` if no thread has
    /// plies. Cloth of plied threads may come to rest several times, with plies that are pressed
    /// more each time. Cloth of mixed threads that is not clear then comes to rest once more, with
    /// its threads held in their places. All other fields are those of the time that counts.
    pub valley: Option<f32>,
}

/// Crossings at rest, with threads made thinner where surfaces lacked clearance.
struct Certified {
    resting: RestingRepeat,
    rest: CrossingsRest,
    /// The area that threads keep before any was made thinner.
    at_first: BySet<[f64; 2]>,
    clearance: [f64; 2],
    bend: f64,
    rounds: u32,
}

impl Woven {
    /// The problem of the cloth's crossings: the smallest repeat of the cloth, or the whole cloth
    /// if nothing repeats. In the problem the last threads lie beside the first ones, so that
    /// something holds every edge. Plies are as they are given; [`Woven::at_rest`] presses them
    /// first.
    #[must_use]
    pub fn crossings(&self) -> Crossings {
        Problem::new(self).crossings
    }

    /// Lets the cloth come to rest on `backend` as `finish` asks. Threads flatten, shift and share
    /// the crimp so that the energy of their crossings is least ([`texere_core::crossings`]), and
    /// are drawn along arcs round one another. Threads are made thinner where surfaces lack
    /// clearance. The plies of threads press into one another ([`WovenRest::valley`]). If threads
    /// of a set differ and the cloth is not clear, it comes to rest once more with all threads held
    /// in their places, and the clearer of both counts. `tension` is the tension of the yarns'
    /// splines, from 0 to below 1. A thread with a larger [flatness](crate::Thread::flatness) comes
    /// to rest flatter. [`Woven::crimp`] and [`Woven::shape`] do not count. `progress` gets the
    /// share of the work done. `Break` ends the call with [`FabricError::Cancelled`].
    ///
    /// **Errors**: [`FinishError::Woven`] if `finish` asks for a length, a press or a course,
    /// [`FinishError::Crossings`] for threads that can't be settled, [`FinishError::Backend`] for a
    /// backend that settles no crossings or a device that fails, and [`FinishError::Fabric`] with
    /// [`FabricError::Cancelled`], with [`FabricError::Yarns`] for a tension outside \[0, 1), or
    /// with the errors of [`Woven::yarns`] and [`clearance()`](texere_contact::clearance()).
    ///
    /// ```
    /// use std::ops::ControlFlow;
    /// use texere_core::{Material, Section};
    /// use texere_cpu::SerialBackend;
    /// use texere_fabric::{BySet, Finish, Thread, Weave, Woven};
    /// // Plain weave at 1.8 diameters, where round threads would pierce one another.
    /// let plain = Weave::parse("plain")?.drawdown(6, 6)?;
    /// let threads = vec![Thread::new(0.36, 0.1); 6];
    /// let cloth = Woven::new(plain, threads.clone(), threads, vec![Material::default()], vec![Section::Circle])?;
    /// let rest = cloth.at_rest(&Finish::default(), 0.0, &SerialBackend::new(), |_| ControlFlow::Continue(()))?;
    /// assert_eq!(rest.repeat, BySet { warp: 2, weft: 2 });
    /// assert!(rest.crossings.at_rest && rest.clearance[1] > 0.98);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn at_rest(
        &self,
        finish: &Finish,
        tension: f32,
        backend: &dyn Backend,
        mut progress: impl FnMut(f64) -> ControlFlow<()> + Send,
    ) -> Result<WovenRest, FinishError> {
        let asked = [
            ("a length", finish.length.is_some()),
            ("a press", finish.press_mm.is_some()),
            ("a course", finish.record),
        ];
        if let Some((asked, _)) = asked.into_iter().find(|(_, is_asked)| *is_asked) {
            return Err(FinishError::Woven { asked });
        }
        let (cloth, valley, certified) =
            self.pressed(finish, tension, backend, |done| progress(CERTIFIED * done))?;
        let Certified { resting, rest, at_first, clearance, bend, rounds } = certified;
        let placed = &mut |done| progress(CERTIFIED + (1.0 - CERTIFIED) * done);
        let (area, yarns) = (resting.area(&cloth), resting.yarns_with_progress(&cloth, placed)?);
        if progress(1.0).is_break() {
            return Err(FabricError::Cancelled.into());
        }
        Ok(WovenRest {
            yarns,
            repeat: BySet::of(resting.repeat()),
            crossings: rest,
            clearance,
            bend,
            rounds,
            area: area.map(|[mean, _]| mean),
            area_least: area.map(|[_, least]| least),
            solid: resting.is_solid(),
            area_lost: BySet { warp: at_first.warp[0] - area.warp[0], weft: at_first.weft[0] - area.weft[0] },
            valley,
        })
    }

    /// The crossings at rest, with threads made thinner where surfaces lacked clearance.
    fn certified(
        &self,
        mut resting: RestingRepeat,
        rest: CrossingsRest,
        progress: impl FnMut(f64) -> ControlFlow<()> + Send,
    ) -> Result<Certified, FabricError> {
        let at_first = resting.area(self);
        let (clearance, bend, rounds) = certify(self, &mut resting, progress)?;
        Ok(Certified { resting, rest, at_first, clearance, bend, rounds })
    }

    /// The cloth's crossings at rest, before surfaces are measured, and the report on how they came
    /// to rest. If `held`, no thread shifts sideways.
    fn resting(
        &self,
        finish: &Finish,
        tension: f32,
        backend: &dyn Backend,
        held: bool,
        mut progress: impl FnMut(f64) -> ControlFlow<()>,
    ) -> Result<(RestingRepeat, CrossingsRest), FinishError> {
        check_tension(tension).map_err(FabricError::from)?;
        let mut problem = Problem::new(self);
        let BySet { warp, weft } = finish.taut;
        problem.crossings = problem.crossings.tension(warp, weft).press(finish.calender);
        if held {
            problem.crossings = problem.crossings.held();
        }
        let plan = Arc::new(CrossingsPlan::new(&problem.crossings)?);
        let mut settler = backend.crossings_settler(Arc::clone(&plan))?;
        let (mut made, mut stopped) = (0.0, false);
        let rest = crossings::settle(&plan, settler.as_mut(), |_, seen| {
            made += if seen.is_some() { 1.0 } else { 0.0 };
            let answer = progress(made / f64::from(plan.passes()));
            stopped = answer.is_break();
            answer
        })?;
        if stopped {
            return Err(FabricError::Cancelled.into());
        }
        let mut all: Vec<CrossingState> = zeroed("crossings", plan.crossings() as u64)?;
        settler.read(&mut all)?;
        Ok((RestingRepeat::new(problem, &plan, all, tension), rest))
    }
}
