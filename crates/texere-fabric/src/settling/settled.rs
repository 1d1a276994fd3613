//! The settings of settling, and its result.

use texere_contact::{Clearance, Linking};
use texere_core::settling::{Length, Pass, Rest, SettlingSeen};
use texere_core::{Origin, YarnPlace, Yarns};

use crate::{Along, BySet, FabricWarning};

/// How yarns of a knit come to rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[non_exhaustive]
pub enum RestBy {
    /// Yarns move until none pierces another or folds. The gauge stays as it is.
    #[default]
    Contact,
    /// Yarns move until bending and contact have the least energy. The gauge follows: see
    /// [`RelaxedKnit`](crate::RelaxedKnit).
    Energy,
}

/// The settings of settling: lengths, a press and passes for knits; tautness and a calender for
/// woven cloth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Finish {
    /// How a knit that repeats comes to rest. It has no effect on woven cloth.
    pub by: RestBy,
    /// The way along which a knit that comes to rest by its energy keeps its gauge, as cloth that
    /// is pinned out to dry. Held along its courses, it keeps the distance of its wales. With
    /// `None` wales and courses follow from the energy.
    pub hold: Option<Along>,
    /// Whether yarns keep their lengths, get other lengths, or are free. With `None` a weft knit
    /// gets the loop lengths of its program or its gauge, and its lengths are free if neither gives
    /// a length for some loop. A warp knit gets the lengths of its run-ins, and keeps its lengths
    /// if a bar with yarns has no run-in. All other yarns keep their lengths.
    pub length: Option<Length>,
    /// Distance of the two plates that press the cloth while yarns settle, mm. A press does not
    /// move yarns that are at rest before settling begins.
    pub press_mm: Option<f32>,
    /// The most passes of each form of settling by contact: see
    /// [`texere_core::settling::Settling::passes`].
    pub passes: u32,
    /// Whether [`Settled::course`] is kept.
    pub record: bool,
    /// Tautness of woven cloth's threads, from 0 to 10; 1 in relaxed cloth. The tauter set
    /// straightens, and the other set takes its crimp.
    pub taut: BySet<f32>,
    /// How strongly woven cloth is pressed flat, from 0 to 10; 1 in relaxed cloth.
    pub calender: f32,
}

impl Finish {
    /// The rule for lengths. Without one, yarns keep their lengths.
    pub(crate) fn length(&self) -> Length {
        self.length.unwrap_or(Length::Held)
    }
}

impl Default for Finish {
    /// The structure's own lengths, no hold, no press, at most 250 passes of each form, no record,
    /// and relaxed woven cloth.
    fn default() -> Self {
        Self {
            by: RestBy::Contact,
            hold: None,
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

/// The share by which cloth may be thicker than asked without a warning. With half the value, and
/// with twice, no test is red.
const THICKER: f64 = 0.01;

impl Press {
    /// A warning if the cloth is thicker than asked by more than one per cent. Plates do not cut
    /// into yarns, and bent yarns stand up again when the plates are gone.
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
    /// The settled yarns: those of the piece, or of all copies of a knit's repeat. If some yarns
    /// have passed through one another, or could not all be compared, no yarn has been moved.
    pub yarns: Yarns,
    /// The rule by which lengths were settled.
    pub length: Length,
    /// The number of passes, and the measures at the start and at the end. If the yarns were left
    /// unmoved ([`Settled::yarns`]), the end equals the start, and [`Rest::at_rest`] is false.
    pub rest: Rest,
    /// Whether yarns have passed through one another, by comparison of the start with the end.
    pub linking: Linking,
    /// How near [`Settled::yarns`] come to one another and how tightly they bend, with the worst
    /// places. [`settle`](crate::settle()) measures a repeat as one piece, without its neighbours.
    /// [`Settled::rest`] counts the neighbours, too.
    pub clearance: Clearance,
    /// The distance between the plates of the press, and the thickness of the cloth. None without a
    /// press.
    pub press: Option<Press>,
    /// Every pass and its measures, in order. Empty unless [`Finish::record`] asks for them.
    pub course: Vec<(Pass, SettlingSeen)>,
}

impl Settled {
    /// The result with another [`Press::reached_mm`]: the thickness of the whole cloth, which
    /// `reached_mm` measures, mm. Without a press the result stays as it is.
    pub(crate) fn pressed(self, reached_mm: impl FnOnce(&Yarns) -> f64) -> Self {
        let press = self.press.map(|press| Press { reached_mm: reached_mm(&self.yarns), ..press });
        Self { press, ..self }
    }

    /// Whether no yarn has passed through another. False if some yarns could not be compared.
    #[must_use]
    pub const fn is_linked(&self) -> bool {
        unchanged(&self.linking)
    }

    /// The thread at a place of [`Settled::clearance`] or [`Settled::linking`].
    ///
    /// **Panics** for a place on a yarn past the last one. Places of `clearance` and `linking`
    /// never lie on such a yarn.
    #[must_use]
    pub fn origin(&self, place: &YarnPlace) -> Origin {
        self.yarns.layout().yarns()[place.yarn].origin
    }
}

/// Whether all yarns were compared and their linking is unchanged.
pub(crate) const fn unchanged(linking: &Linking) -> bool {
    linking.passages == 0 && linking.left_out == 0
}
