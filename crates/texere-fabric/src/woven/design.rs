//! A woven design: a cloth, its draft, and the relief of its jammed threads.

use texere_core::Section;

use super::{Draft, JamReport, Relief, Woven};
use crate::{FabricError, WovenError};

/// A woven cloth as a designer describes it.
///
/// ```
/// use texere_core::{Material, Section};
/// use texere_fabric::{Relief, Thread, Weave, Woven, WovenDesign};
/// // Denim: ends 1.3 diameters apart.
/// let twill = Weave::parse("3/1")?.drawdown(20, 20)?;
/// let (warp, weft) = (vec![Thread::new(0.39, 0.15); 20], vec![Thread::new(0.66, 0.15); 20]);
/// let cloth = Woven::new(twill, warp, weft, vec![Material::default()], vec![Section::Circle])?;
/// let design = WovenDesign::new(cloth, None, Relief::Flatten)?;
/// assert_eq!(design.jam_report().before.warp.jammed, 19);
/// assert_eq!(design.jam_report().after.warp.jammed, 0);
/// assert!(design.cloth().warp_share() > 0.5);
/// # Ok::<(), texere_fabric::FabricError>(())
/// ```
#[derive(Debug, Clone)]
pub struct WovenDesign {
    cloth: Woven,
    draft: Option<Draft>,
    relief: Relief,
    jam_report: JamReport,
    /// The cloth as it was given, if relief has changed it.
    given: Option<Woven>,
}

impl WovenDesign {
    /// Relieves the jammed threads of `cloth` as `relief` says. `draft` is the shaft draft that
    /// weaves the cloth, if there is one. The draft's drawdown has to equal the cloth's. This is
    /// not checked.
    ///
    /// **Errors**: the errors of [`Woven::relieve`].
    pub fn new(mut cloth: Woven, draft: Option<Draft>, relief: Relief) -> Result<Self, FabricError> {
        let (jam_report, given) = relieve(&mut cloth, relief)?;
        Ok(Self { cloth, draft, relief, jam_report, given })
    }

    /// The cloth, after the relief of its jammed threads.
    #[must_use]
    pub const fn cloth(&self) -> &Woven {
        &self.cloth
    }

    /// The shaft draft that weaves the cloth, if the design has one.
    #[must_use]
    pub const fn draft(&self) -> Option<&Draft> {
        self.draft.as_ref()
    }

    /// How tight the threads were before relief and after, and what was changed.
    #[must_use]
    pub const fn jam_report(&self) -> &JamReport {
        &self.jam_report
    }

    /// What is done about jammed threads.
    #[must_use]
    pub const fn relief(&self) -> Relief {
        self.relief
    }

    /// The cloth as it was given, before its jammed threads were relieved.
    #[must_use]
    pub fn as_given(&self) -> &Woven {
        self.given.as_ref().unwrap_or(&self.cloth)
    }

    /// Whether relief has changed the cloth that was given.
    #[must_use]
    pub const fn is_relieved(&self) -> bool {
        self.given.is_some()
    }

    /// A design of `cloth` with this design's draft. Its jammed threads are only reported.
    pub(crate) fn of(&self, cloth: Woven) -> Result<Self, FabricError> {
        Self::new(cloth, self.draft.clone(), Relief::Report)
    }

    /// Puts the warp up or down at a crossing; `end` and `pick` are counted from 0. The jammed
    /// threads of the changed cloth are relieved again. The design's shaft draft no longer weaves
    /// the cloth, and is dropped.
    ///
    /// ```
    /// use texere_core::{Material, Section};
    /// use texere_fabric::{Relief, Thread, Weave, Woven, WovenDesign};
    /// let plain = Weave::parse("plain")?.drawdown(4, 4)?;
    /// let (warp, weft) = (vec![Thread::new(1.0, 0.2); 4], vec![Thread::new(1.0, 0.2); 4]);
    /// let cloth = Woven::new(plain, warp, weft, vec![Material::default()], vec![Section::Circle])?;
    /// let mut design = WovenDesign::new(cloth, None, Relief::Report)?;
    /// let up = design.cloth().drawdown().up(2, 1);
    /// design.set_lift(2, 1, !up)?;
    /// assert_eq!(design.cloth().drawdown().up(2, 1), !up);
    /// # Ok::<(), texere_fabric::FabricError>(())
    /// ```
    ///
    /// **Errors**: [`WovenError::NoCrossing`] for a crossing outside the cloth, and the errors of
    /// [`Woven::relieve`]. After an error the design is unchanged.
    pub fn set_lift(&mut self, end: usize, pick: usize, up: bool) -> Result<(), FabricError> {
        let mut changed = self.as_given().clone();
        changed.drawdown_mut().set(end, pick, up)?;
        (self.jam_report, self.given) = relieve(&mut changed, self.relief)?;
        (self.cloth, self.draft) = (changed, None);
        Ok(())
    }

    /// Gives the material with number `material`, counted from 0, the sRGB colour `srgb`.
    ///
    /// **Errors**: [`WovenError::NoMaterial`] past the last material.
    pub fn set_color(&mut self, material: usize, srgb: [u8; 3]) -> Result<(), WovenError> {
        for cloth in self.given.iter_mut().chain([&mut self.cloth]) {
            cloth.set_color(material, srgb)?;
        }
        Ok(())
    }

    /// Gives all threads the section `section` in the cloth before relief, and relieves that cloth
    /// again.
    ///
    /// **Errors**: [`ThreadError::Section`](crate::ThreadError::Section) for a section whose
    /// numbers are not valid, and the errors of [`Woven::relieve`]. After an error the design is
    /// unchanged.
    pub fn set_section(&mut self, section: Section) -> Result<(), FabricError> {
        let mut changed = self.given.as_ref().unwrap_or(&self.cloth).clone();
        changed.set_section(section)?;
        (self.jam_report, self.given) = relieve(&mut changed, self.relief)?;
        self.cloth = changed;
        Ok(())
    }
}

/// Relieves jammed threads. Returns the report and, if the cloth was changed, a copy of it before
/// the change.
fn relieve(cloth: &mut Woven, relief: Relief) -> Result<(JamReport, Option<Woven>), FabricError> {
    if relief == Relief::Report {
        return Ok((cloth.relieve(relief)?, None));
    }
    let given = cloth.clone();
    let report = cloth.relieve(relief)?;
    let changed = given != *cloth;
    Ok((report, changed.then_some(given)))
}
