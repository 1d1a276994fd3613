//! What is asked of a settling, and what came of it.

use texere_contact::{Clearance, Linking};
use texere_core::settling::{Length, Pass, Rest, SettlingSeen};
use texere_core::{Origin, YarnPlace, Yarns};

use crate::{BySet, FabricWarning};

/// What is asked of yarns that settle: lengths, a press and passes of knits, tensions and a
/// calender of woven cloth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Finish {
    /// What becomes of lengths, and the tension that draws yarns in where these are free. Where
    /// none is said, a knit's loops reach the length that its gauge asks for, or are free; all
    /// other yarns are held.
    pub length: Option<Length>,
    /// The cloth is pressed between two plates so many mm apart while yarns settle. Those that are
    /// at rest from the start stay as they are.
    pub press_mm: Option<f32>,
    /// The most passes of either form, by contact: see [`texere_core::settling::Settling::passes`].
    pub passes: u32,
    /// Whether [`Settled::course`] is kept.
    pub record: bool,
    /// How taut woven cloth's warp and weft are, 1 where it is relaxed, 0 to 10: the tauter set
    /// straightens, and the other one takes its crimp.
    pub taut: BySet<f32>,
    /// How strongly woven cloth is pressed flat, 1 where it is relaxed, 0 to 10.
    pub calender: f32,
}

impl Finish {
    /// What becomes of lengths: they are held where nothing else is said.
    pub(super) fn length(&self) -> Length {
        self.length.unwrap_or(Length::Held)
    }
}

impl Default for Finish {
    /// Lengths as the structure has them, nothing presses, 250 passes of either form at most, no
    /// record; relaxed woven cloth.
    fn default() -> Self {
        Self {
            length: None,
            press_mm: None,
            passes: 250,
            record: false,
            taut: BySet { warp: 1.0, weft: 1.0 },
            calender: 1.0,
        }
    }
}

/// Cloth that was pressed between two plates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Press {
    /// The plates' distance, mm: [`Finish::press_mm`].
    pub asked_mm: f64,
    /// How thick the cloth is without them, mm.
    pub reached_mm: f64,
}

/// How much thicker than asked cloth may be.
const THICKER: f64 = 0.01;

impl Press {
    /// That the cloth is thicker than was asked, if it is by more than one per cent: no plate goes
    /// through yarns, and those that are bent stand up again.
    #[must_use]
    pub fn missed(&self) -> Option<FabricWarning> {
        let Self { asked_mm, reached_mm } = *self;
        (reached_mm > asked_mm * (1.0 + THICKER))
            .then_some(FabricWarning::PressMissed { asked_mm, reached_mm })
    }
}

/// Yarns that have settled, and how well.
#[derive(Debug, Clone)]
pub struct Settled {
    /// The yarns: layout, materials and sources of those that came in. Where any have passed
    /// through one another on their way, these are the very ones that came in.
    pub yarns: Yarns,
    /// What became of lengths.
    pub length: Length,
    /// Passes, and what was seen at the start and at the end. Where the yarns are those that came
    /// in, its end is its start and they are not at rest.
    pub rest: Rest,
    /// Whether yarns have passed through one another, by comparison of the start with where they
    /// came to rest.
    pub linking: Linking,
    /// How near [`Settled::yarns`] come to one another and how tightly they bend, with the worst
    /// places. Of a repeat it is the one piece, without its neighbours; [`Settled::rest`] counts
    /// these in.
    pub clearance: Clearance,
    /// How thick the cloth was to be pressed, and how thick it has become; none where nothing
    /// presses.
    pub press: Option<Press>,
    /// What every pass was and what it has seen, in their order; empty unless [`Finish::record`]
    /// asks for it.
    pub course: Vec<(Pass, SettlingSeen)>,
}

impl Settled {
    /// The same with the thickness of the whole cloth, mm.
    pub(crate) fn pressed(self, reached_mm: impl FnOnce(&Yarns) -> f64) -> Self {
        let press = self.press.map(|press| Press { reached_mm: reached_mm(&self.yarns), ..press });
        Self { press, ..self }
    }

    /// Whether no yarn has passed through another, and everything that may have was compared.
    #[must_use]
    pub const fn is_linked(&self) -> bool {
        unchanged(&self.linking)
    }

    /// The thread that a place of [`Settled::clearance`] or [`Settled::linking`] lies on.
    ///
    /// **Panics** past the last yarn, which no place of these is.
    #[must_use]
    pub fn origin(&self, place: &YarnPlace) -> Origin {
        self.yarns.layout().yarns()[place.yarn].origin
    }
}

/// Whether the linking of yarns is known to be what it was.
pub(super) const fn unchanged(linking: &Linking) -> bool {
    linking.passages == 0 && linking.left_out == 0
}
