//! The settings of a knit's finish that differ from the defaults.

use texere_core::settling::Length;
use texere_fabric::{Finish, RestBy};

use crate::Design;

/// The value of a key of `[finish]`.
pub(super) enum Setting {
    /// A word.
    Word(&'static str),
    /// A number.
    Number(f32),
}

/// The settings of a knit's finish that differ from the defaults. Settings of woven cloth, and
/// settings that only callers of the library can make, have no keys in a knit.
pub(super) struct KnitFinish {
    /// Keys of knits, each with its value. `settle` is not among them.
    pub(super) keys: Vec<(&'static str, Setting)>,
    /// Settings that the file of this knit can't have, in words.
    pub(super) unsaid: Vec<String>,
}

impl KnitFinish {
    pub(super) fn new(design: &Design) -> Self {
        let Finish { by, hold, length, press_mm, passes, record, taut, calender } = design.finish;
        let usual = Finish::default();
        // Beside `rest = "energy"`, a reader refuses `press` and `length = "free"`. Without it, a
        // reader refuses `hold`.
        let by_energy = by == RestBy::Energy;
        let is_free = matches!(length, Some(Length::Free { .. }));
        let mut keys = match length {
            Some(Length::Free { .. }) if by_energy => Vec::new(),
            None => Vec::new(),
            Some(Length::Held) => vec![("length", Setting::Word("held"))],
            Some(Length::Given(times)) => vec![("length", Setting::Number(times))],
            Some(Length::Free { tension }) => {
                let tension = (tension != 0.0).then_some(("tension", Setting::Number(tension)));
                [("length", Setting::Word("free"))].into_iter().chain(tension).collect()
            }
        };
        if by_energy {
            keys.push(("rest", Setting::Word("energy")));
            keys.extend(hold.map(|along| ("hold", Setting::Word(along.name()))));
        }
        keys.extend(press_mm.filter(|_| !by_energy).map(|mm| ("press", Setting::Number(mm))));
        let unsaid = [
            (taut.warp != usual.taut.warp, "finish.warp_tension, which only woven cloth has"),
            (taut.weft != usual.taut.weft, "finish.weft_tension, which only woven cloth has"),
            (calender != usual.calender, "finish.calender, which only woven cloth has"),
            (
                design.stretch.is_some(),
                "finish.stretch_warp or finish.stretch_weft, which only woven cloth has",
            ),
            (by_energy && is_free, "finish.length = \"free\", which rest by energy does not know"),
            (by_energy && press_mm.is_some(), "finish.press, which rest by energy does not know"),
            (!by_energy && hold.is_some(), "finish.hold, which only rest by energy knows"),
            (passes != usual.passes, "the most passes of settling"),
            (record != usual.record, "whether a record of settling is kept"),
        ];
        Self { keys, unsaid: super::text::named(&unsaid) }
    }
}
