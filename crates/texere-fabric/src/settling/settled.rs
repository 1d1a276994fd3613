//! What is asked of a settling, and what comes of it.

use texere_contact::{Clearance, Linking};
use texere_core::settling::{Length, Pass, Rest, SettlingSeen};
use texere_core::{Origin, YarnPlace, Yarns};

use crate::{BySet, FabricWarning};

/// What is asked of yarns that settle: lengths, a press and passes for knits, tensions and a
/// calender for woven cloth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Finish {
    /// What becomes of lengths, and the tension that draws yarns in where lengths are free. With
    /// none, a knit's loops reach the length that its gauge asks for, or are free; all other yarns
    /// are held.
    pub length: Option<Length>,
    /// Distance of the two plates that press the cloth while yarns settle, mm. Yarns that are at
    /// rest from the start stay as they are.
    pub press_mm: Option<f32>,
    /// The most passes of either form, by contact: see [`texere_core::settling::Settling::passes`].
    pub passes: u32,
    /// Whether [`Settled::course`] is kept.
    pub record: bool,
    /// Tautness of woven cloth's threads, 0 to 10, 1 in relaxed cloth. The tauter set straightens,
    /// and the other one takes its crimp.
    pub taut: BySet<f32>,
    /// How strongly woven cloth is pressed flat, 0 to 10, 1 in relaxed cloth.
    pub calender: f32,
}

impl Finish {
    /// What becomes of lengths, which are held by default.
    pub(super) fn length(&self) -> Length {
        self.length.unwrap_or(Length::Held)
    }
}

impl Default for Finish {
    /// The structure's own lengths, no press, at most 250 passes of either form, no record; relaxed
    /// woven cloth.
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
    /// Thickness of the cloth without the plates, mm.
    pub reached_mm: f64,
}

/// The share by which cloth may be thicker than asked.
const THICKER: f64 = 0.01;

impl Press {
    /// A warning where the cloth is thicker than asked by more than one per cent. No plate goes
    /// through yarns, and bent yarns stand up again.
    #[must_use]
    pub fn missed(&self) -> Option<FabricWarning> {
        let Self { asked_mm, reached_mm } = *self;
        (reached_mm > asked_mm * (1.0 + THICKER))
            .then_some(FabricWarning::PressMissed { asked_mm, reached_mm })
    }
}

/// Settled yarns, and how well they settled.
#[derive(Debug, Clone)]
pub struct Settled {
    /// The settled yarns, with the layout, materials and sources of the piece. They are the piece's
    /// own yarns, unmoved, where any have passed through one another on their way.
    pub yarns: Yarns,
    /// What became of lengths.
    pub length: Length,
    /// Passes, and what was seen at the start and at the end. Where the yarns are unmoved the end
    /// is the start, and they are not at rest.
    pub rest: Rest,
    /// Whether yarns have passed through one another, by comparison of the start with the end.
    pub linking: Linking,
    /// How near [`Settled::yarns`] come to one another and how tightly they bend, with the worst
    /// places. A repeat is measured as one piece, without its neighbours; [`Settled::rest`] counts
    /// these.
    pub clearance: Clearance,
    /// Thickness that was asked of a press, and thickness reached. None without a press.
    pub press: Option<Press>,
    /// Every pass and what it has seen, in order. Empty unless [`Finish::record`] asks for it.
    pub course: Vec<(Pass, SettlingSeen)>,
}

impl Settled {
    /// The result with the thickness of the whole cloth, mm.
    pub(crate) fn pressed(self, reached_mm: impl FnOnce(&Yarns) -> f64) -> Self {
        let press = self.press.map(|press| Press { reached_mm: reached_mm(&self.yarns), ..press });
        Self { press, ..self }
    }

    /// Whether no yarn has passed through another, with nothing left uncompared.
    #[must_use]
    pub const fn is_linked(&self) -> bool {
        unchanged(&self.linking)
    }

    /// The thread at a place of [`Settled::clearance`] or [`Settled::linking`].
    ///
    /// **Panics** past the last yarn, which no place of these is.
    #[must_use]
    pub fn origin(&self, place: &YarnPlace) -> Origin {
        self.yarns.layout().yarns()[place.yarn].origin
    }
}

/// Whether the linking of yarns is known to be unchanged.
pub(super) const fn unchanged(linking: &Linking) -> bool {
    linking.passages == 0 && linking.left_out == 0
}
