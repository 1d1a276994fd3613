//! What is wrong with a cloth.

use std::fmt;
use std::ops::ControlFlow;

use texere_contact::WRUNG;
use texere_core::Settings;

use super::pieces::Pieces;
use super::places::{ClothClearance, ThreadBend, ThreadContact, ThreadCrowd, ThreadDrawn};
use crate::{FabricError, Pitch, Woven};

/// The most jammed threads that are listed one by one.
pub const JAMS_LISTED: usize = 100;

/// What was measured of a cloth, and what is wrong with it.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnosis {
    /// Contacts of a lower ratio than this pierce.
    pub touching: f64,
    /// How near threads come to one another, and how tightly they bend.
    pub clearance: ClothClearance,
    /// What is wrong.
    pub faults: Faults,
}

/// What is wrong with a cloth.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Faults {
    /// The worst place that is too crowded to be measured, if there is one.
    pub crowded: Option<ThreadCrowd>,
    /// Contacts that pierce, worst first, [`CONTACTS_LISTED`](texere_contact::CONTACTS_LISTED) at
    /// most.
    pub pierces: Vec<ThreadContact>,
    /// The tightest bend, where it is tighter than the tube is thick.
    pub folds: Option<ThreadBend>,
    /// Threads too close together, if there are any.
    pub jams: Option<Jams>,
    /// The pieces that the cloth falls into, if it does not hang together.
    pub apart: Option<Pieces>,
    /// Where a mesh is [wrung](WRUNG) between two rings.
    pub wrung: Option<ThreadDrawn>,
    /// Where triangles of a mesh face inwards.
    pub inside_out: Option<ThreadDrawn>,
}

/// A kind of fault. Its text says what the cloth does: "folds".
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ClothFault {
    /// Several times as much yarn as there is room for.
    Crowded,
    /// Threads pierce one another, or themselves.
    Pierces,
    /// A bend is tighter than the tube is thick.
    Folds,
    /// Threads lie closer together than those that cross them can pass.
    Jams,
    /// Nothing binds all threads into one cloth.
    FallsApart,
    /// A mesh with these settings is wrung between two rings.
    Wrung,
    /// Triangles of a mesh with these settings face inwards.
    InsideOut,
}

impl fmt::Display for ClothFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Crowded => "is crowded",
            Self::Pierces => "pierces itself",
            Self::Folds => "folds",
            Self::Jams => "jams",
            Self::FallsApart => "falls apart",
            Self::Wrung => "is wrung",
            Self::InsideOut => "is inside out",
        })
    }
}

/// Threads that lie closer to the one before than those that cross them can pass.
#[derive(Debug, Clone, PartialEq)]
pub struct Jams {
    /// How many ends do.
    pub ends: usize,
    /// How many picks do.
    pub picks: usize,
    /// The worst of them, [`JAMS_LISTED`] at most, worst first.
    pub threads: Vec<Pitch>,
}

impl Diagnosis {
    /// What is wrong with a cloth whose yarns have this clearance, and these jams, and that hangs
    /// together so. Contacts of a ratio below `touching` pierce.
    #[must_use]
    pub fn new(touching: f64, clearance: ClothClearance, jams: Option<Jams>, pieces: Pieces) -> Self {
        let faults = Faults {
            crowded: clearance.crowd,
            pierces: clearance.worst.iter().take_while(|contact| contact.ratio < touching).copied().collect(),
            folds: Some(clearance.bend).filter(|bend| bend.radii < 1.0),
            jams,
            apart: Some(pieces).filter(Pieces::falls_apart),
            wrung: Some(clearance.drawn).filter(|drawn| drawn.width < WRUNG),
            inside_out: Some(clearance.drawn).filter(|drawn| drawn.inwards > 0),
        };
        Self { touching, clearance, faults }
    }
}

impl Faults {
    /// What kinds there are; none of a clean cloth.
    ///
    /// ```
    /// use texere_fabric::Faults;
    /// assert!(Faults::default().kinds().is_empty());
    /// ```
    #[must_use]
    pub fn kinds(&self) -> Vec<ClothFault> {
        let kinds = [
            self.crowded.map(|_| ClothFault::Crowded),
            self.pierces.first().map(|_| ClothFault::Pierces),
            self.folds.map(|_| ClothFault::Folds),
            self.jams.as_ref().map(|_| ClothFault::Jams),
            self.apart.as_ref().map(|_| ClothFault::FallsApart),
            self.wrung.map(|_| ClothFault::Wrung),
            self.inside_out.map(|_| ClothFault::InsideOut),
        ];
        kinds.into_iter().flatten().collect()
    }
}

impl Woven {
    /// Looks for what is wrong with the cloth: measures its clearance at the default tension, and
    /// compares its pitches with those that its threads need. Contacts of a ratio below `touching`
    /// pierce; 0.985 is what splines through touching threads come to. `progress` gets the share
    /// that is done, as in [`clearance_with_progress`](texere_contact::clearance_with_progress).
    ///
    /// **Errors**: those of [`Woven::yarns`] and of [`Woven::clearance`].
    ///
    /// ```
    /// use std::ops::ControlFlow;
    /// use texere_core::{Material, Section};
    /// use texere_fabric::{ClothFault, Thread, Weave, Woven};
    /// // Ends 1.3 diameters apart: picks can't pass between them.
    /// let twill = Weave::parse("3/1")?.drawdown(20, 16)?;
    /// let (warp, weft) = (vec![Thread::new(0.4, 0.15); 20], vec![Thread::new(0.66, 0.15); 16]);
    /// let cloth = Woven::new(twill, warp, weft, vec![Material::default()], vec![Section::Circle])?;
    /// let diagnosis = cloth.diagnose(0.985, |_| ControlFlow::Continue(()))?;
    /// let kinds = [ClothFault::Pierces, ClothFault::Folds, ClothFault::Jams, ClothFault::InsideOut];
    /// assert_eq!(diagnosis.faults.kinds(), kinds); // where threads fold, their surface turns inside out
    /// # Ok::<(), texere_fabric::FabricError>(())
    /// ```
    pub fn diagnose(
        &self,
        touching: f64,
        progress: impl FnMut(f64) -> ControlFlow<()> + Send,
    ) -> Result<Diagnosis, FabricError> {
        let yarns = self.yarns()?;
        let clearance = self.clearance(&yarns, &Settings::of(&yarns), progress)?;
        Ok(Diagnosis::new(touching, clearance, self.jams(), self.pieces()))
    }

    /// Into how many layers the cloth falls, and which threads lie loose: see
    /// [`Drawdown::layers`](crate::Drawdown::layers).
    #[must_use]
    pub fn pieces(&self) -> Pieces {
        Pieces::of_woven(self.drawdown())
    }

    /// The jammed threads, if there are any.
    #[must_use]
    pub fn jams(&self) -> Option<Jams> {
        let [mut threads, picks] = self.pitches().map(|mut pitches| {
            pitches.retain(Pitch::is_jammed);
            pitches
        });
        let counts = [threads.len(), picks.len()];
        threads.extend(picks);
        let share = |pitch: &Pitch| pitch.pitch_mm / pitch.passing_mm;
        threads.sort_by(|a, b| share(a).total_cmp(&share(b)));
        threads.truncate(JAMS_LISTED);
        let [ends, picks] = counts;
        (!threads.is_empty()).then_some(Jams { ends, picks, threads })
    }
}
