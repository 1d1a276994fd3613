//! The structure of a fabric, whatever its kind.

use std::ops::ControlFlow;

use texere_core::{Backend, Section, Settings, YarnPlace, Yarns};

use crate::diagnosis::{ClothClearance, Cure, Diagnosis, Jams, Pieces, ThreadPlace};
use crate::measures::size_mm;
use crate::relaxation::strain_repeat;
use crate::warp::WarpKnitted;
use crate::weft::Knitted;
use crate::{
    Along, FabricError, FabricWarning, Finish, FinishError, Finished, Measures, Piece, Repeat, RestBy,
    StrainTest, Stretch, WovenDesign, settle,
};

/// How the yarns of a fabric interlace, for any kind of fabric.
///
/// ```
/// use texere_core::{Material, Section};
/// use texere_fabric::{Relief, Structure, Thread, Weave, Woven, WovenDesign};
/// let plain = Weave::parse("plain")?.drawdown(8, 6)?;
/// let (warp, weft) = (vec![Thread::new(1.0, 0.2); 8], vec![Thread::new(1.0, 0.2); 6]);
/// let cloth = Woven::new(plain, warp, weft, vec![Material::default()], vec![Section::Circle])?;
/// let structure = Structure::Woven(WovenDesign::new(cloth, None, Relief::Report)?);
/// assert_eq!(structure.size_mm(), [8.0, 6.0]);
/// assert_eq!(structure.yarns()?.layout().yarns().len(), 14);
/// # Ok::<(), texere_fabric::FabricError>(())
/// ```
#[derive(Debug, Clone)]
#[non_exhaustive]
#[allow(clippy::large_enum_variant, reason = "a design has one structure")]
pub enum Structure {
    /// Woven cloth.
    Woven(WovenDesign),
    /// A weft knit.
    Weft(Knitted),
    /// A warp knit.
    Warp(WarpKnitted),
    /// Yarns that no structure made, such as saved cloth or the curves of another program. They lie
    /// as they are, and settle by contact as a [`Piece`] does.
    Yarns(Piece),
}

impl Structure {
    /// The woven design, with what only weaving has, such as a draft. None for any other
    /// fabric.
    #[must_use]
    pub const fn woven(&self) -> Option<&WovenDesign> {
        match self {
            Self::Woven(design) => Some(design),
            Self::Weft(_) | Self::Warp(_) | Self::Yarns(_) => None,
        }
    }

    /// The weft knit, with what only weft knits have, such as stitches. None for any other fabric.
    #[must_use]
    pub const fn knitted(&self) -> Option<&Knitted> {
        match self {
            Self::Woven(_) | Self::Warp(_) | Self::Yarns(_) => None,
            Self::Weft(knit) => Some(knit),
        }
    }

    /// The warp knit, with what only warp knits have, such as guide bars. None for any other
    /// fabric.
    #[must_use]
    pub const fn warp_knitted(&self) -> Option<&WarpKnitted> {
        match self {
            Self::Warp(knit) => Some(knit),
            Self::Woven(_) | Self::Weft(_) | Self::Yarns(_) => None,
        }
    }

    /// The yarns of the fabric.
    ///
    /// **Errors**: the errors of [`Woven::yarns`](crate::Woven::yarns), [`Knitted::yarns`] or
    /// [`WarpKnitted::yarns`].
    pub fn yarns(&self) -> Result<Yarns, FabricError> {
        match self {
            Self::Woven(design) => design.cloth().yarns(),
            Self::Weft(knit) => knit.yarns(),
            Self::Warp(knit) => knit.yarns(),
            Self::Yarns(piece) => Ok(piece.yarns.clone()),
        }
    }

    /// The tension of the yarns' splines unless a caller asks for another. It is 0, except for
    /// yarns that no structure made, which keep the tension of their own layout.
    #[must_use]
    pub fn tension(&self) -> f32 {
        match self {
            Self::Woven(_) | Self::Weft(_) | Self::Warp(_) => 0.0,
            Self::Yarns(piece) => piece.yarns.tension(),
        }
    }

    /// The piece that settles by contact, and the number of its copies in the fabric. The piece of
    /// a knit is one repeat (see [`Knitted::repeat`] and [`WarpKnitted::repeat`]), or the whole
    /// fabric if it does not repeat. Woven cloth settles by its crossings instead. Its piece is the
    /// whole cloth, cut off at its edges and held there, for use with [`settle`].
    ///
    /// **Errors**: the errors of [`Structure::yarns`].
    pub fn repeat(&self) -> Result<Repeat, FabricError> {
        match self {
            Self::Woven(design) => Ok(Repeat { piece: Piece::cut(design.cloth().yarns()?), copies: [1, 1] }),
            Self::Weft(knit) => knit.repeat(),
            Self::Warp(knit) => knit.repeat(),
            Self::Yarns(piece) => Ok(Repeat { piece: piece.clone(), copies: [1, 1] }),
        }
    }

    /// The fabric's yarns, made of copies of the yarns of its `repeat`. `yarns` are the repeat's
    /// yarns, settled or not. The copies lie side by side and are cut off as [`Structure::settle`]
    /// cuts them.
    ///
    /// **Errors**: the errors of [`Repeat::placed`].
    pub fn placed(&self, repeat: &Repeat, yarns: &Yarns) -> Result<Yarns, FabricError> {
        match self {
            Self::Woven(_) | Self::Yarns(_) => repeat.placed(yarns),
            Self::Weft(knit) => knit.placed(repeat, yarns, &mut || Ok(())),
            Self::Warp(knit) => knit.placed(repeat, yarns, &mut || Ok(())),
        }
    }

    /// `finish` with a rule for the lengths of a knit's repeat, if `finish` has none: see
    /// [`Knitted::finish_of`] and [`WarpKnitted::finish_of`]. For any other
    /// fabric `finish` is returned as it is.
    #[must_use]
    pub fn finish_of(&self, repeat: &Repeat, finish: &Finish) -> Finish {
        match self {
            Self::Woven(_) | Self::Yarns(_) => *finish,
            Self::Weft(knit) => knit.finish_of(repeat, finish),
            Self::Warp(knit) => knit.finish_of(repeat, finish),
        }
    }

    /// Lets the fabric come to rest: woven cloth by its crossings
    /// ([`Woven::at_rest`](crate::Woven::at_rest)), knits by contact ([`Knitted::settle`],
    /// [`WarpKnitted::settle`]) or by their energy ([`Knitted::relax`], [`WarpKnitted::relax`]),
    /// and other yarns by contact ([`settle`]). `tension` is the tension of all yarns' splines,
    /// from 0 to below 1.
    ///
    /// **Errors**: the errors of the method that is called, such as [`FinishError::Woven`] for
    /// woven cloth if `finish` asks for a length, a press or a course. Yarns that no structure made
    /// give [`FinishError::NoEnergy`] if `finish` asks for [`RestBy::Energy`].
    ///
    /// ```
    /// use std::ops::ControlFlow;
    /// use texere_core::{Material, Section};
    /// use texere_cpu::SerialBackend;
    /// use texere_fabric::{Finish, Relief, Structure, Thread, Weave, Woven, WovenDesign};
    /// // Threads so dense that they flatten.
    /// let plain = Weave::parse("plain")?.drawdown(4, 4)?;
    /// let (warp, weft) = (vec![Thread::new(0.7, 0.2); 4], vec![Thread::new(0.7, 0.2); 4]);
    /// let cloth = Woven::new(plain, warp, weft, vec![Material::default()], vec![Section::Circle])?;
    /// let structure = Structure::Woven(WovenDesign::new(cloth, None, Relief::Report)?);
    /// let device = SerialBackend::new();
    /// let finished = structure.settle(&Finish::default(), 0.0, &device, |_| ControlFlow::Continue(()))?;
    /// assert!(finished.is_at_rest());
    /// assert!(structure.clearance(finished.yarns(), &Default::default(), |_| ControlFlow::Continue(()))?.min > 0.98);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn settle(
        &self,
        finish: &Finish,
        tension: f32,
        backend: &dyn Backend,
        progress: impl FnMut(f64) -> ControlFlow<()> + Send,
    ) -> Result<Finished, FinishError> {
        match self {
            Self::Woven(design) => {
                design.cloth().at_rest(finish, tension, backend, progress).map(Finished::Woven)
            }
            Self::Weft(knit) if finish.by == RestBy::Energy => {
                knit.relax(finish, tension, backend, progress).map(Finished::Relaxed)
            }
            Self::Warp(knit) if finish.by == RestBy::Energy => {
                knit.relax(finish, tension, backend, progress).map(Finished::Relaxed)
            }
            Self::Yarns(_) if finish.by == RestBy::Energy => {
                Err(FinishError::NoEnergy { cloth: "these are yarns of no structure" })
            }
            Self::Weft(knit) => knit.settle(finish, tension, backend, progress).map(Finished::Knit),
            Self::Warp(knit) => knit.settle(finish, tension, backend, progress).map(Finished::Knit),
            Self::Yarns(piece) => {
                let yarns = piece.yarns.clone().with_tension(tension).map_err(FabricError::from)?;
                settle(&Piece { yarns, ..piece.clone() }, finish, backend, progress).map(Finished::Knit)
            }
        }
    }

    /// The fabric with the gauge that its yarns have at rest, and with the lengths of its loops or
    /// its run-ins. Only knits that came to rest by their energy have another gauge than before.
    #[must_use]
    pub fn at_rest_as(self, finished: &Finished) -> Self {
        match (self, finished) {
            (Self::Weft(knit), Finished::Relaxed(relaxed)) => Self::Weft(knit.with_gauge(relaxed.gauge)),
            (Self::Warp(knit), Finished::Relaxed(relaxed)) => {
                Self::Warp(knit.at_rest(relaxed.gauge, &relaxed.yarns))
            }
            (fabric, _) => fabric,
        }
    }

    /// Relaxes one repeat of a knit, then holds it at each of `strains`, which rise, along the
    /// courses, the wales or both. Measures how it pulls, how it gets narrower and how thick it is.
    /// Yarns get the lengths that [`Knitted::relax`] and [`WarpKnitted::relax`] give them. At rest
    /// nothing holds the knit, whatever [`Finish::hold`] says.
    /// `tension` is the tension of all yarns' splines, from 0 to below 1.
    ///
    /// **Errors**: [`FinishError::NoEnergy`] for a fabric that is no knit, [`FinishError::Strains`]
    /// for strains that don't rise, or are out of range, [`FinishError::Passed`] if yarns have
    /// passed through one another, and the errors of [`Knitted::relax`] and [`WarpKnitted::relax`].
    ///
    /// ```
    /// use std::ops::ControlFlow;
    /// use texere_core::{Material, Section};
    /// use texere_cpu::SerialBackend;
    /// use texere_fabric::weft::{Beds, Chart, Gauge, KnitYarn, Knitted, Machine};
    /// use texere_fabric::{Along, Finish, Structure};
    /// let program = Chart::parse("k", Beds::One)?.program()?;
    /// let stitches = Machine::default().knit(&program)?.stitches;
    /// let gauge = Gauge { loop_length_mm: Some(3.6), ..Gauge::new(0.95, 0.7) };
    /// let (materials, sections) = (vec![Material::default()], vec![Section::Circle]);
    /// let jersey = Knitted::new(stitches, gauge, vec![KnitYarn::new(0.1)], materials, sections, [1, 1])?;
    /// let test = Structure::Weft(jersey).strain_test(
    ///     &Finish::default(),
    ///     0.0,
    ///     (Along::Courses, &[0.05, 0.1]),
    ///     &SerialBackend::new(),
    ///     |_| ControlFlow::Continue(()),
    /// )?;
    /// assert_eq!(test.states.len(), 3); // The first one is at rest.
    /// assert!(test.states[2].force[0] > test.states[1].force[0]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn strain_test(
        &self,
        finish: &Finish,
        tension: f32,
        strains: (Along, &[f64]),
        backend: &dyn Backend,
        progress: impl FnMut(f64) -> ControlFlow<()> + Send,
    ) -> Result<StrainTest, FinishError> {
        let (repeat, gauge) = match self {
            Self::Weft(knit) => (knit.repeat_of_energy(tension)?, knit.gauge()),
            Self::Warp(knit) => (knit.repeat_of_energy(tension)?, knit.gauge()),
            Self::Woven(_) => return Err(FinishError::NoEnergy { cloth: "this one is woven" }),
            Self::Yarns(_) => {
                return Err(FinishError::NoEnergy { cloth: "these are yarns of no structure" });
            }
        };
        let length = self.finish_of(&repeat, finish).length();
        strain_repeat(&repeat, gauge, length, strains, backend, progress)
    }

    /// Stretches woven cloth along one set of its threads: see
    /// [`Woven::stretched`](crate::Woven::stretched). All threads keep their lengths. Returns
    /// `finish` with the tensions of the stretched cloth, for [`Structure::settle`]. Any other
    /// fabric is not changed.
    ///
    /// **Errors**: the errors of [`Woven::stretched`](crate::Woven::stretched). After an error the
    /// cloth is unchanged.
    pub fn stretch(
        &mut self,
        finish: &Finish,
        stretch: Stretch,
        tension: f32,
        backend: &dyn Backend,
        progress: impl FnMut(f64) -> ControlFlow<()> + Send,
    ) -> Result<Finish, FinishError> {
        let Self::Woven(design) = self else { return Ok(*finish) };
        let (cloth, finish) = design.cloth().stretched(finish, stretch, tension, backend, progress)?;
        *design = design.of(cloth)?;
        Ok(finish)
    }

    /// A place on one of the structure's yarns in a designer's terms: by thread and crossing, or by
    /// wale and course. `yarns` are the structure's own, settled or not. For a weft knit the call
    /// takes time in proportion to the stitches of its repeat.
    ///
    /// ```
    /// use texere_core::{Material, Section};
    /// use texere_contact::yarns_under;
    /// use texere_core::YarnPlace;
    /// use texere_fabric::{Relief, Structure, Thread, Weave, Woven, WovenDesign};
    /// let plain = Weave::parse("plain")?.drawdown(8, 6)?;
    /// let (warp, weft) = (vec![Thread::new(1.0, 0.2); 8], vec![Thread::new(1.0, 0.2); 6]);
    /// let cloth = Woven::new(plain, warp, weft, vec![Material::default()], vec![Section::Circle])?;
    /// let structure = Structure::Woven(WovenDesign::new(cloth, None, Relief::Report)?);
    /// let yarns = structure.yarns()?;
    /// // End 3 lies from x = 2 to 3 mm, and pick 4 from y = 3 to 4 mm. Both lie under the point.
    /// // Which of the two is on top depends on the weave, so their names are sorted.
    /// let places = yarns_under(&yarns, [2.5, 3.5]).iter().map(|place| structure.place(&yarns, place)).collect::<Vec<_>>();
    /// let mut said = places.iter().map(ToString::to_string).collect::<Vec<_>>();
    /// said.sort();
    /// assert_eq!(said, ["end 3 at pick 4", "pick 4 at end 3"]);
    /// # Ok::<(), texere_fabric::FabricError>(())
    /// ```
    ///
    /// **Panics** for a place on a yarn past the last one.
    #[must_use]
    pub fn place(&self, yarns: &Yarns, place: &YarnPlace) -> ThreadPlace {
        match self {
            Self::Woven(design) => design.cloth().place(yarns, place),
            Self::Weft(knit) => {
                ThreadPlace { stitch: knit.stitch_at(yarns, place), ..ThreadPlace::on(yarns, place) }
            }
            Self::Warp(knit) => {
                ThreadPlace { stitch: knit.stitch_at(place), ..ThreadPlace::on(yarns, place) }
            }
            Self::Yarns(_) => ThreadPlace::on(yarns, place),
        }
    }

    /// Width and height of the fabric, mm. Yarns that no structure made have the size of the box
    /// round their control points and half widths.
    #[must_use]
    pub fn size_mm(&self) -> [f64; 2] {
        match self {
            Self::Woven(design) => design.cloth().size_mm(),
            Self::Weft(knit) => knit.size_mm(),
            Self::Warp(knit) => knit.size_mm(),
            Self::Yarns(piece) => size_mm(&piece.yarns),
        }
    }

    /// The sections of the yarns as they are placed.
    #[must_use]
    pub fn sections(&self) -> &[Section] {
        match self {
            Self::Woven(design) => design.cloth().sections(),
            Self::Weft(knit) => knit.sections(),
            Self::Warp(knit) => knit.sections(),
            Self::Yarns(piece) => piece.yarns.layout().sections(),
        }
    }

    /// Gives every yarn the same section. A woven design relieves its jammed threads again.
    ///
    /// **Errors**: [`FabricError`] if the section's numbers are not valid, or if relief would make
    /// threads too thin or too wide. After an error the structure is unchanged.
    pub fn set_section(&mut self, section: Section) -> Result<(), FabricError> {
        match self {
            Self::Woven(design) => design.set_section(section),
            Self::Weft(knit) => Ok(knit.set_section(section)?),
            Self::Warp(knit) => Ok(knit.set_section(section)?),
            Self::Yarns(piece) => {
                piece.yarns = piece.yarns.clone().with_section(section)?;
                Ok(())
            }
        }
    }

    /// Warnings about the fabric before its yarns settle. [`Finished::warnings`] has those that
    /// show only when the yarns are at rest.
    #[must_use]
    pub fn warnings(&self) -> Vec<FabricWarning> {
        match self {
            Self::Woven(design) => design.cloth().warnings(),
            Self::Weft(_) | Self::Warp(_) | Self::Yarns(_) => Vec::new(),
        }
    }

    /// Yarn consumption, weight and thickness, the crimp and cover of woven cloth, and the loops of
    /// a knit. `yarns` are the structure's own.
    ///
    /// **Errors**: the errors of [`Measures::new`] for woven cloth, and none for any other fabric.
    pub fn measures(&self, yarns: &Yarns) -> Result<Measures, FabricError> {
        match self {
            Self::Woven(design) => Measures::new(design.cloth(), yarns),
            Self::Weft(knit) => knit.measures(yarns),
            Self::Warp(knit) => Ok(knit.measures(yarns)),
            Self::Yarns(_) => Ok(Measures::of_yarns(yarns)),
        }
    }

    /// How near yarns come to one another and how tightly they bend. Places are named by thread, in
    /// woven cloth also by crossing: see [`Woven::clearance`](crate::Woven::clearance).
    ///
    /// **Errors**: the errors of
    /// [`clearance_with_progress`](texere_contact::clearance_with_progress) and of
    /// [`drawn`](texere_contact::drawn()).
    pub fn clearance(
        &self,
        yarns: &Yarns,
        settings: &Settings,
        progress: impl FnMut(f64) -> ControlFlow<()> + Send,
    ) -> Result<ClothClearance, FabricError> {
        match self {
            Self::Woven(design) => design.cloth().clearance(yarns, settings, progress),
            Self::Weft(_) | Self::Warp(_) | Self::Yarns(_) => ClothClearance::of(yarns, settings, progress),
        }
    }

    /// Threads of woven cloth that lie too close together as they are woven. None if all threads
    /// have room, and none for any other fabric.
    #[must_use]
    pub fn jams(&self) -> Option<Jams> {
        match self {
            Self::Woven(design) => design.cloth().jams(),
            Self::Weft(_) | Self::Warp(_) | Self::Yarns(_) => None,
        }
    }

    /// The pieces that the fabric falls into, the yarns that nothing holds, and the needles of a
    /// knit that never have a loop. Woven cloth may fall into layers
    /// ([`Drawdown::layers`](crate::Drawdown::layers)), knits into yarns whose loops are not drawn
    /// through one another. Nothing is known of yarns that no structure made: they count as no
    /// piece.
    #[must_use]
    pub fn pieces(&self) -> Pieces {
        match self {
            Self::Woven(design) => design.cloth().pieces(),
            Self::Weft(knit) => knit.pieces(),
            Self::Warp(knit) => knit.pieces(),
            Self::Yarns(_) => Pieces::default(),
        }
    }

    /// Faults of the fabric before it settles: see [`Woven::diagnose`](crate::Woven::diagnose).
    /// Contacts with a ratio below `touching` count as piercing.
    ///
    /// **Errors**: the errors of [`Structure::yarns`] and of [`Structure::clearance`].
    pub fn diagnose(
        &self,
        touching: f64,
        progress: impl FnMut(f64) -> ControlFlow<()> + Send,
    ) -> Result<Diagnosis, FabricError> {
        match self {
            Self::Woven(design) => design.cloth().diagnose(touching, progress),
            Self::Weft(_) | Self::Warp(_) | Self::Yarns(_) => {
                let yarns = self.yarns()?;
                let clearance = self.clearance(&yarns, &Settings::of(&yarns), progress)?;
                Ok(Diagnosis::new(touching, clearance, None, self.pieces()))
            }
        }
    }

    /// Faults of the fabric once it has settled to `finished`. Jams are not looked for, because
    /// threads that lack room already show it in their clearance. Contacts with a ratio below
    /// `touching` count as piercing. [`Finished::verdict`] uses the ratio
    /// [`CLEAR`](texere_contact::CLEAR).
    ///
    /// **Errors**: the errors of [`Structure::clearance`].
    pub fn diagnose_finished(
        &self,
        finished: &Finished,
        touching: f64,
        progress: impl FnMut(f64) -> ControlFlow<()> + Send,
    ) -> Result<Diagnosis, FabricError> {
        let yarns = finished.yarns();
        let settings = Settings::default().following(yarns);
        let clearance = self.clearance(yarns, &settings, progress)?;
        Ok(Diagnosis::new(touching, clearance, None, self.pieces()))
    }

    /// Single changes of a woven design that help against the faults of `diagnosis`. Each change
    /// has been tried: see [`WovenDesign::cures`]. For any other fabric the list is empty.
    pub fn cures(&self, diagnosis: &Diagnosis, progress: impl FnMut(f64) -> ControlFlow<()>) -> Vec<Cure> {
        match self {
            Self::Woven(design) => design.cures(diagnosis, progress),
            Self::Weft(_) | Self::Warp(_) | Self::Yarns(_) => Vec::new(),
        }
    }
}
