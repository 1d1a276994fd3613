//! The one way from a design to its cloth. Yarns are placed where the structure puts them, then
//! come to rest as the finish asks.

use std::fmt;
use std::ops::ControlFlow;

use texere_core::{Backend, CrossingsError, Settings, Yarns};
use texere_fabric::{Along, ClothClearance, FinishError, Finished, StrainTest};

use crate::{Design, Refusal};

/// The share of the progress at which a stretch is done. Coming to rest takes the remaining share.
const STRETCHED: f64 = 0.5;

/// A design and its yarns, which are at rest or as placed: see [`RestReport`]. [`Design::rest`] and
/// [`Design::placed`] make a cloth.
#[derive(Debug)]
pub struct Cloth {
    design: Design,
    report: RestReport,
    /// Whether the design has stretched the cloth.
    pub(crate) stretched: bool,
}

/// The yarns of a [`Cloth`], and whether they came to rest.
#[derive(Debug)]
#[non_exhaustive]
#[allow(clippy::large_enum_variant, reason = "a cloth has one")]
pub enum RestReport {
    /// The yarns are where the structure places them. The design does not ask for rest, or
    /// [`Design::placed`] made the cloth.
    Placed(Yarns),
    /// The yarns came to rest, or as near to it as [`Finished::verdict`] says.
    Finished(Finished),
    /// The yarns are where the structure places them, because they can't come to rest.
    Refused {
        /// The yarns.
        yarns: Yarns,
        /// The reason, with the place in the design that asks for the cloth.
        reason: Refusal,
    },
}

impl fmt::Display for RestReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Placed(_) => write!(f, "placed as the structure says"),
            Self::Finished(finished) => finished.verdict().fmt(f),
            Self::Refused { reason, .. } => write!(f, "placed as the structure says: {}", reason.why()),
        }
    }
}

impl RestReport {
    /// One line for each thing that the finish asks for and the cloth did not reach.
    #[must_use]
    pub fn warnings(&self) -> Vec<String> {
        match self {
            Self::Placed(_) | Self::Refused { .. } => Vec::new(),
            Self::Finished(finished) => finished.warnings().iter().map(ToString::to_string).collect(),
        }
    }
}

impl Cloth {
    /// The design. After a stretch its structure is the stretched one, [`Design::stretch`] is none,
    /// and [`Design::finish`] has the tensions that hold the stretch. If a knit came to rest by its
    /// energy, its structure has the gauge at rest.
    #[must_use]
    pub const fn design(&self) -> &Design {
        &self.design
    }

    /// The yarns.
    #[must_use]
    pub const fn yarns(&self) -> &Yarns {
        match &self.report {
            RestReport::Placed(yarns) | RestReport::Refused { yarns, .. } => yarns,
            RestReport::Finished(finished) => finished.yarns(),
        }
    }

    /// The report on the yarns: whether they came to rest.
    #[must_use]
    pub const fn report(&self) -> &RestReport {
        &self.report
    }

    /// Measures how near the yarns come to one another and how tightly they bend, as they are drawn
    /// with `settings`. Places are named by thread, and by crossing or stitch. `progress` gets the
    /// share that is done, from 0 to 1. `Break` ends the work.
    ///
    /// **Errors**: a [`Refusal`] if the yarns can't be measured, and if `progress` asked to stop.
    pub fn clearance(
        &self,
        settings: &Settings,
        progress: impl FnMut(f64) -> ControlFlow<()> + Send,
    ) -> Result<ClothClearance, Refusal> {
        let measured = self.design.structure.clearance(self.yarns(), settings, progress);
        measured.map_err(|error| self.design.refused(error))
    }

    /// The design and its yarns, without the report.
    #[must_use]
    pub fn into_parts(self) -> (Design, Yarns) {
        let yarns = match self.report {
            RestReport::Placed(yarns) | RestReport::Refused { yarns, .. } => yarns,
            RestReport::Finished(finished) => finished.into_yarns(),
        };
        (self.design, yarns)
    }

    /// What a designer should know of the cloth: the reader's [remarks](Design::remarks), and what
    /// the finish asks for and the cloth did not reach. If the yarns are not at rest, the list also
    /// has the faults of the structure as placed.
    #[must_use]
    pub fn warnings(&self) -> Vec<String> {
        let before = match &self.report {
            RestReport::Finished(finished) if finished.is_at_rest() => self.design.remarks().to_vec(),
            _ => self.design.warnings(),
        };
        before.into_iter().chain(self.report.warnings()).collect()
    }
}

/// A design whose yarns are about to come to rest: see [`Design::rest`].
#[must_use = "yarns come to rest by `run`"]
pub struct Resting<'a> {
    design: Design,
    device: &'a dyn Backend,
    tension: f32,
    progress: Box<dyn FnMut(f64) -> ControlFlow<()> + Send + 'a>,
}

impl fmt::Debug for Resting<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { design, tension, .. } = self;
        f.debug_struct("Resting").field("design", design).field("tension", tension).finish_non_exhaustive()
    }
}

impl Design {
    /// The first step from the design to its cloth. [`Resting::run`] makes the cloth on `device`:
    /// it places the yarns, stretches the cloth and lets it come to rest, as the design's `settle`,
    /// `stretch` and `finish` say. A WIF draft read by itself has no finish, so its yarns stay as
    /// placed unless [`Design::settle`] is set to true.
    ///
    /// ```
    /// use texere_core::{Material, Section};
    /// use texere_cpu::SerialBackend;
    /// use texere_fabric::{Relief, Structure, Thread, Weave, Woven, WovenDesign};
    /// use texere_formats::Design;
    /// // Threads so dense that they flatten.
    /// let plain = Weave::parse("plain")?.drawdown(4, 4)?;
    /// let (warp, weft) = (vec![Thread::new(0.7, 0.2); 4], vec![Thread::new(0.7, 0.2); 4]);
    /// let cloth = Woven::new(plain, warp, weft, vec![Material::default()], vec![Section::Circle])?;
    /// let design = Design::of("Sheeting", Structure::Woven(WovenDesign::new(cloth, None, Relief::Report)?));
    /// let cloth = design.rest(&SerialBackend::new()).run()?;
    /// assert_eq!(cloth.report().to_string(), "at rest");
    /// assert_eq!(cloth.yarns().layout().yarns().len(), 8);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn rest(self, device: &dyn Backend) -> Resting<'_> {
        let progress = Box::new(|_| ControlFlow::Continue(()));
        let tension = self.structure.tension();
        Resting { design: self, device, tension, progress }
    }

    /// The cloth of the design with its yarns where the structure places them, even if the design
    /// asks for cloth at rest. No device is needed. `tension` is the tension of the yarns' splines,
    /// from 0 to below 1. [`Structure::tension`](texere_fabric::Structure::tension) is usual.
    ///
    /// **Errors**: a [`Refusal`] with the errors of [`Design::yarns`], or for a tension out of
    /// range.
    pub fn placed(self, tension: f32) -> Result<Cloth, Refusal> {
        let yarns = self.placed_yarns(tension)?;
        Ok(Cloth { design: self, report: RestReport::Placed(yarns), stretched: false })
    }

    /// Lets a knit come to rest by its energy, then strains it along the courses, the wales or
    /// both, as `along` says. Measures how the knit pulls at each of `strains`, which rise. The
    /// loops have the lengths that the design asks for. At rest nothing holds the knit, whatever
    /// [`Finish::hold`](texere_fabric::Finish::hold) says. `progress` gets the share of the work
    /// that is done, from 0 to 1. `Break` ends the work.
    ///
    /// **Errors**: a [`Refusal`] for a design that is no knit that repeats, for strains that don't
    /// rise or are out of range, for a device that can't relax yarns, and if yarns pass through one
    /// another.
    ///
    /// ```no_run
    /// use std::ops::ControlFlow;
    /// use texere_cpu::ParallelBackend;
    /// use texere_fabric::Along;
    /// let rib = texere_formats::read("designs/rib.toml")?;
    /// let device = ParallelBackend::open()?;
    /// let test =
    ///     rib.strain_test(Along::Courses, &[0.05, 0.1, 0.2], &device, |_| ControlFlow::Continue(()))?;
    /// println!("Poisson's ratio: {:?}", test.poisson_at(0.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn strain_test(
        &self,
        along: Along,
        strains: &[f64],
        device: &dyn Backend,
        progress: impl FnMut(f64) -> ControlFlow<()> + Send,
    ) -> Result<StrainTest, Refusal> {
        let Self { structure, finish, .. } = self;
        let tested = structure.strain_test(finish, structure.tension(), (along, strains), device, progress);
        tested.map_err(|error| self.refused(error))
    }

    fn placed_yarns(&self, tension: f32) -> Result<Yarns, Refusal> {
        let yarns = self.yarns().and_then(|yarns| Ok(yarns.with_tension(tension)?));
        yarns.map_err(|error| self.refused(error))
    }
}

impl<'a> Resting<'a> {
    /// The tension of the yarns' splines, from 0 to below 1. If not given, it is
    /// [`Structure::tension`](texere_fabric::Structure::tension).
    pub fn tension(self, tension: f32) -> Self {
        Self { tension, ..self }
    }

    /// Calls `progress` with the share of the work that is done, from 0 to 1. `Break` ends the
    /// work: on the CPU within 50 ms, on any other device after the pass that it makes.
    pub fn progress(self, progress: impl FnMut(f64) -> ControlFlow<()> + Send + 'a) -> Self {
        Self { progress: Box::new(progress), ..self }
    }

    /// Makes the cloth. The result is `Ok` even if the yarns don't come to rest: [`Cloth::report`]
    /// then says so. If the crossings of woven cloth can't settle at all, the threads stay where
    /// the structure places them, and the report says why.
    ///
    /// **Errors**: a [`Refusal`] if the cloth or its stretch can't be made, if a knit can't settle,
    /// if the structure can't have the finish that the design asks for, if memory is short, if the
    /// device fails or can't settle yarns, if `progress` asked to stop, and if the
    /// [tension](Resting::tension) is out of range.
    pub fn run(self) -> Result<Cloth, Refusal> {
        let Self { mut design, device, tension, mut progress } = self;
        if !design.settle {
            return design.placed(tension);
        }
        let (mut done, stretched) = (0.0, design.stretch.is_some());
        if let Some(stretch) = design.stretch.take() {
            let on = |share| progress(STRETCHED * share);
            match design.structure.stretch(&design.finish, stretch, tension, device, on) {
                Ok(finish) => design.finish = finish,
                Err(error) => return Err(design.refused(error)),
            }
            done = STRETCHED;
        }
        let on = |share| progress(done + (1.0 - done) * share);
        let report = match design.structure.settle(&design.finish, tension, device, on) {
            Ok(finished) => {
                design.structure = design.structure.at_rest_as(&finished);
                if let Finished::Relaxed(_) = finished {
                    // The structure now says how long its loops are.
                    design.finish.length = None;
                }
                RestReport::Finished(finished)
            }
            Err(FinishError::Crossings(error)) if !matches!(error, CrossingsError::OutOfMemory(_)) => {
                RestReport::Refused { yarns: design.placed_yarns(tension)?, reason: design.refused(error) }
            }
            Err(error) => return Err(design.refused(error)),
        };
        Ok(Cloth { design, report, stretched })
    }
}
