//! The faults of a cloth.

use std::fmt;
use std::ops::ControlFlow;

use texere_contact::WRUNG;
use texere_core::Settings;

use super::pieces::Pieces;
use super::places::{ClothClearance, ThreadBend, ThreadContact, ThreadCrowd, ThreadDrawn};
use crate::{FabricError, Pitch, Woven};

/// The most jammed threads that are listed one by one.
const JAMS_LISTED: usize = 100;

/// The diagnosis of a cloth: its measured clearance, and its faults.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnosis {
    /// The ratio of contact below which two threads count as piercing one another.
    pub touching: f64,
    /// How near threads come to one another, and how tightly they bend, with places.
    pub clearance: ClothClearance,
    /// The faults.
    pub faults: Faults,
}

/// The faults of a cloth.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Faults {
    /// The worst place that is too crowded for contacts to be measured.
    pub crowded: Option<ThreadCrowd>,
    /// Contacts that pierce, worst first, at most
    /// [`CONTACTS_LISTED`](texere_contact::CONTACTS_LISTED).
    pub pierces: Vec<ThreadContact>,
    /// The tightest bend, if its radius is less than the distance by which the section reaches into
    /// the bend.
    pub folds: Option<ThreadBend>,
    /// Threads that lie too close together.
    pub jams: Option<Jams>,
    /// The pieces of the cloth, if it does not hang together.
    pub apart: Option<Pieces>,
    /// The mesh's narrowest place, if the mesh is [wrung](WRUNG) there: narrowed because two
    /// neighbouring rings are turned against one another.
    pub wrung: Option<ThreadDrawn>,
    /// The triangles of the mesh that face inwards, if there are any.
    pub inside_out: Option<ThreadDrawn>,
}

/// A kind of fault. It displays as a verb phrase with the cloth as its subject, such as "folds".
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ClothFault {
    /// A place holds too much yarn, or too many parts of yarns, for contacts to be measured there:
    /// see [`Crowd::fill`](texere_contact::Crowd::fill).
    Crowded,
    /// Threads pierce one another, or themselves.
    Pierces,
    /// A bend is so tight that the tube folds into itself.
    Folds,
    /// Threads lie so close together that crossing threads can't pass between them.
    Jams,
    /// The cloth consists of several pieces, or has loose yarns.
    FallsApart,
    /// A mesh with the settings of the diagnosis is wrung: narrowed because two neighbouring rings
    /// are turned against one another.
    Wrung,
    /// Triangles of a mesh with the settings of the diagnosis face inwards.
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

/// Jammed threads: each lies so close to the thread before it that crossing threads can't pass
/// between the two.
#[derive(Debug, Clone, PartialEq)]
pub struct Jams {
    /// Number of jammed ends.
    pub ends: usize,
    /// Number of jammed picks.
    pub picks: usize,
    /// The worst jammed threads, worst first, at most 100.
    pub threads: Vec<Pitch>,
}

impl Diagnosis {
    /// The diagnosis of a cloth with this clearance, these jams and these pieces. Contacts with a
    /// ratio below `touching` pierce.
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
    /// The kinds of these faults. The list is empty for a clean cloth.
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
    /// Diagnoses the cloth: measures its clearance at the default tension, compares the pitches of
    /// threads with the pitches that they need, and looks for pieces that nothing joins.
    ///
    /// Contacts with a ratio below `touching` count as piercing. Between points at which threads
    /// just touch, splines come as near as a ratio of 0.987, which
    /// [`CLEAR`](texere_contact::CLEAR) allows. `progress` gets the share that is done, as in
    /// [`clearance_with_progress`](texere_contact::clearance_with_progress).
    ///
    /// **Errors**: the errors of [`Woven::yarns`] and of [`Woven::clearance`].
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

    /// The layers into which the cloth falls, and its loose threads: see
    /// [`Drawdown::layers`](crate::Drawdown::layers).
    #[must_use]
    pub fn pieces(&self) -> Pieces {
        Pieces::of_woven(self.drawdown())
    }

    /// The jammed threads; `None` if there are none.
    #[must_use]
    pub fn jams(&self) -> Option<Jams> {
        let [mut threads, picks] = self.pitches().into_array().map(|mut pitches| {
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
