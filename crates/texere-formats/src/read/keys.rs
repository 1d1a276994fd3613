//! Which key of a design file an error of its cloth comes from: structures and settlings know threads, bars and sizes, and the
//! design knows where it says them.

use std::path::{Path, PathBuf};

use texere_core::{BackendError, CrossingsError, Origin, SettlingError};
use texere_fabric::{FabricError, FinishError};

use super::Place;
#[cfg(feature = "toml")]
use super::ReadError;

/// What says how large a cloth is, and what it is made of, the first that a file has.
const SIZE: &[&str] = &[
    "weave.ends",
    "weave.picks",
    "weave.repeat",
    "weave.image",
    "weave.wif",
    "weave.drawdown",
    "weave.notation",
    "knit.repeat",
    "warp_knit.repeat",
    "warp_knit.wales",
];
const STITCHES: &[&str] = &[
    "knit.chart",
    "knit.image",
    "knit.knitout",
    "warp_knit.bars, bar 1: lapping",
    "weave.notation",
    "weave.drawdown",
    "weave.image",
    "weave.wif",
];
const WALES: &[&str] = &[
    "knit.wales_per_cm",
    "knit.needles_per_inch",
    "warp_knit.wales_per_cm",
    "warp_knit.needles_per_inch",
    "knit.loop_length_mm",
    "knit.knitout",
];
const COURSES: &[&str] =
    &["knit.courses_per_cm", "warp_knit.courses_per_cm", "knit.loop_length_mm", "knit.knitout"];
const LOOPS: &[&str] = &["knit.loop_length_mm", "knit.stitch_lengths_mm"];
/// The tables of structures themselves.
const TABLES: &[&str] = &["weave", "knit", "warp_knit"];
/// What of a yarn says how thick it is.
const THICKNESS: &[&str] = &["diameter_mm", "tex", "cotton_count"];

/// The keys of a design file in their order, as errors write them, and the line of each.
#[derive(Debug, Clone, Default)]
pub(super) struct Keys {
    pub(super) file: PathBuf,
    pub(super) lines: Vec<(String, usize)>,
}

impl Keys {
    /// The file, as far as anything is known of it.
    pub(super) fn file(&self) -> Option<&Path> {
        (!self.file.as_os_str().is_empty()).then_some(&*self.file)
    }

    /// Where the file says what an error is about; `yarn` names the yarn of a thread. None of what no key says.
    pub(super) fn place(
        &self,
        error: &FinishError,
        yarn: impl Fn(Origin) -> Option<String>,
    ) -> Option<Place> {
        let about = match error {
            FinishError::Fabric(error) => fabric(error),
            FinishError::Settling(error) | FinishError::Thread { source: error, .. } => settling(error),
            FinishError::Crossings(error) => crossings(error),
            FinishError::Woven { asked } => About::Keys(match *asked {
                "a length" => &["finish.length"],
                "a press" => &["finish.press"],
                _ => &[],
            }),
            FinishError::Stretch { along: "warp", .. } => About::Keys(&["finish.stretch_warp"]),
            FinishError::Stretch { .. } => About::Keys(&["finish.stretch_weft"]),
            FinishError::Backend(BackendError::Crowded { .. }) => About::Keys(STITCHES),
            _ => return None,
        };
        self.of(about, yarn)
    }

    /// Where the file says that.
    fn of(&self, about: About, yarn: impl Fn(Origin) -> Option<String>) -> Option<Place> {
        let found = match about {
            About::Nothing => return None,
            About::Keys(keys) => self.first(keys),
            About::Set(set) => {
                ["spacing_mm", "per_cm", "per_inch"].iter().find_map(|key| self.line(&format!("{set}.{key}")))
            }
            About::Bar(bar, key) => self.line(&format!("warp_knit.bars, bar {bar}: {key}")),
            About::Yarn(thread, keys) => self.yarn(thread, yarn(thread), keys),
        };
        let (field, line) = found.or_else(|| self.first(TABLES))?;
        Some(Place::new(&self.file, *line, field))
    }

    /// The refusal of a file whose cloth can't be made.
    #[cfg(feature = "toml")]
    pub(super) fn refused(&self, source: FabricError) -> ReadError {
        match self.of(fabric(&source), |_| None) {
            Some(place) => ReadError::Cloth { place, source },
            None => ReadError::fabric(&self.file, source),
        }
    }

    fn line(&self, key: &str) -> Option<&(String, usize)> {
        self.lines.iter().find(|(own, _)| own == key)
    }

    fn first(&self, keys: &[&str]) -> Option<&(String, usize)> {
        keys.iter().find_map(|key| self.line(key))
    }

    /// The first of `keys` of the yarn that a thread has, or else what threads it.
    fn yarn(&self, thread: Origin, name: Option<String>, keys: &[&str]) -> Option<&(String, usize)> {
        let only = || {
            let own =
                |key: &str| key.strip_prefix("yarns.").filter(|name| !name.contains('.')).map(str::to_owned);
            let mut names = self.lines.iter().filter_map(|(key, _)| own(key));
            names.next().filter(|_| names.next().is_none())
        };
        let own = name.or_else(only).and_then(|name| {
            let of = |key: &&str| self.line(&format!("yarns.{name}.{key}"));
            keys.iter().find_map(of).or_else(|| self.line(&format!("yarns.{name}")))
        });
        own.or_else(|| match thread {
            Origin::End(_) => self.line("warp.yarns"),
            Origin::Pick(_) => self.line("weft.yarns"),
            Origin::Guide { bar, .. } => self.line(&format!("warp_knit.bars, bar {bar}: threading")),
            Origin::Course(_) | Origin::Carrier(_) => self.line("knit.yarns"),
            _ => None,
        })
    }
}

/// What an error is about.
enum About {
    /// Nothing that a design says.
    Nothing,
    /// One of these keys, the first that there is.
    Keys(&'static [&'static str]),
    /// How close the threads of `warp` or `weft` lie.
    Set(&'static str),
    /// A key of the guide bar of that number, from 1.
    Bar(usize, &'static str),
    /// One of these keys of the yarn that a thread has.
    Yarn(Origin, &'static [&'static str]),
}

fn fabric(error: &FabricError) -> About {
    use FabricError as E;
    match *error {
        E::OutOfMemory { .. } | E::Cancelled | E::Settings(_) => About::Nothing,
        E::KnitSize { .. }
        | E::KnitRuns { .. }
        | E::KnitNeedle { .. }
        | E::KnitCarriers { .. }
        | E::Stitches { .. }
        | E::NoLoops
        | E::Notation { .. }
        | E::SatinMove { .. }
        | E::NoSatin { .. }
        | E::TwillMove { .. }
        | E::TieUp { .. } => About::Keys(STITCHES),
        E::Laps { .. } | E::WarpRepeat { what: "wales", .. } => About::Keys(&["warp_knit.wales"]),
        E::WarpRepeat { .. } => About::Keys(&["warp_knit.courses"]),
        E::Copies { .. } => About::Keys(&["knit.repeat", "warp_knit.repeat", "warp_knit.wales"]),
        E::Spacing { thread: Origin::Pick(_), .. } | E::Extent { set: "picks", .. } => About::Set("weft"),
        E::Spacing { .. } | E::Extent { .. } => About::Set("warp"),
        E::Radius { thread, .. } => About::Yarn(thread, THICKNESS),
        E::Stiffness { thread, .. } => About::Yarn(thread, &["stiffness"]),
        E::Flatness { thread, .. } => About::Yarn(thread, &["flatness"]),
        E::Half { thread, .. } => About::Yarn(thread, &["flatness", "diameter_mm", "tex", "cotton_count"]),
        E::Twist { thread, .. } => About::Yarn(thread, &["twist_per_m"]),
        E::UnknownMaterial { thread, .. } => About::Yarn(thread, &["color"]),
        E::UnknownSection { thread, .. } => About::Yarn(thread, &["section"]),
        E::Section { .. } => About::Yarn(Origin::Unknown, &["section"]),
        E::Crimp { .. } => About::Keys(&["cloth.warp_crimp"]),
        E::Gauge { what: "wales", .. } => About::Keys(WALES),
        E::Gauge { what: "courses", .. } => About::Keys(COURSES),
        E::Gauge { .. } => About::Keys(LOOPS),
        E::Carrier { .. } => About::Keys(&["knit.yarns"]),
        E::Bars { .. } => About::Keys(&["warp_knit.bars"]),
        E::GuideYarn { bar, .. } => About::Bar(bar, "threading"),
        E::BarOffset { bar, .. } => About::Bar(bar, "offset"),
        E::RunIn { bar, .. } => About::Bar(bar, "run_in_mm"),
        E::JacquardCourses { bar, .. } | E::JacquardLap { bar, .. } => About::Bar(bar, "colors"),
        // Sizes, counts, and what follows from them.
        _ => About::Keys(SIZE),
    }
}

fn settling(error: &SettlingError) -> About {
    use SettlingError as E;
    match *error {
        E::OutOfMemory { .. } => About::Nothing,
        E::ShortRepeat { axis: 'x', .. } => About::Keys(WALES),
        E::ShortRepeat { .. } => About::Keys(COURSES),
        E::LongYarns { .. } => About::Keys(&[
            "knit.loop_length_mm",
            "knit.wales_per_cm",
            "knit.needles_per_inch",
            "warp_knit.wales_per_cm",
            "warp_knit.needles_per_inch",
            "knit.knitout",
        ]),
        E::LongInterval { .. } => About::Keys(WALES),
        E::Setting { setting: "the length", .. } => About::Keys(&["finish.length"]),
        E::Setting { setting: "the tension", .. } => About::Keys(&["finish.tension"]),
        E::Setting { setting: "the gap between the plates", .. } => About::Keys(&["finish.press"]),
        E::Setting { .. } => About::Nothing,
        _ => About::Keys(SIZE),
    }
}

fn crossings(error: &CrossingsError) -> About {
    use CrossingsError as E;
    match *error {
        E::OutOfMemory { .. } => About::Nothing,
        E::Thread { set, setting: "pitch", .. } => About::Set(set),
        E::Thread { setting: "level", .. } => About::Keys(STITCHES),
        E::Thread { set, thread, setting, .. } => {
            let number = thread as u32 + 1;
            let thread = if set == "warp" { Origin::End(number) } else { Origin::Pick(number) };
            About::Yarn(thread, if setting == "stiffness" { &["stiffness"] } else { THICKNESS })
        }
        E::Setting { setting, .. } => About::Keys(if setting.contains("weft") {
            &["finish.weft_tension"]
        } else if setting.contains("warp") {
            &["finish.warp_tension"]
        } else {
            &["finish.calender"]
        }),
        _ => About::Keys(SIZE),
    }
}

#[cfg(test)]
mod tests {
    use texere_core::{SectionError, YarnError};
    use texere_fabric::warp::Lap;

    use super::*;

    /// All keys that structures are made from, each in a line of its own.
    fn keys() -> Keys {
        let all = "weave weave.notation weave.ends knit knit.chart knit.repeat knit.yarns knit.wales_per_cm \
                   knit.courses_per_cm knit.loop_length_mm warp_knit warp_knit.wales warp_knit.courses warp_knit.bars \
                   warp.yarns warp.spacing_mm weft.yarns weft.per_cm finish.length finish.tension finish.press \
                   finish.stretch_warp finish.stretch_weft finish.warp_tension finish.weft_tension finish.calender \
                   cloth.warp_crimp yarns.a yarns.a.tex yarns.a.flatness yarns.a.stiffness yarns.a.twist_per_m \
                   yarns.a.section yarns.a.color";
        let bars = ["threading", "offset", "run_in_mm", "colors"];
        let bars = bars.map(|key| format!("warp_knit.bars, bar 2: {key}"));
        let all = all.split_whitespace().map(str::to_owned).chain(bars);
        Keys { file: "cloth.toml".into(), lines: all.zip(1..).collect() }
    }

    #[test]
    fn every_error_of_cloth_has_its_key() {
        let (end, pick) = (Origin::End(2), Origin::Pick(3));
        let (low, high) = (0.0, 1.0);
        let wale = || FabricError::Gauge { what: "wales", mm: 0.0, low: 0.0, high: 1.0 };
        let thread = |set, setting| CrossingsError::Thread { set, thread: 1, setting, value: 9.0, low, high };
        let ask = |setting| SettlingError::Setting { setting, value: 9.0, low, high };
        let pull = |setting| CrossingsError::Setting { setting, value: 99.0, low, high };
        let stitches = || FabricError::Stitches { what: "none" };
        let cases: Vec<(FinishError, &str)> = vec![
            (FabricError::Size { ends: 0, picks: 0, limit: 1 }.into(), "weave.ends"),
            (FabricError::Crossings { ends: 9, picks: 9, crossings: 81, limit: 1 }.into(), "weave.ends"),
            (FabricError::Points { ends: 9, picks: 9, points: 81, limit: 1 }.into(), "weave.ends"),
            (FabricError::Repeat { ends: 9, picks: 9, limit: 1 }.into(), "weave.ends"),
            (FabricError::ThreadCount { set: "ends", threads: 1, planned: 2 }.into(), "weave.ends"),
            (FabricError::TieUp { treadles: 1, ends: 2, limit: 1 }.into(), "knit.chart"),
            (FabricError::KnitRuns { passed: 9, loops: 1, limit: 1 }.into(), "knit.chart"),
            (FabricError::KnitSize { what: "loops", count: 9, limit: 1, operation: 0 }.into(), "knit.chart"),
            (FabricError::KnitCarriers { operation: 1 }.into(), "knit.chart"),
            (stitches().into(), "knit.chart"),
            (FabricError::NoLoops.into(), "knit.chart"),
            (
                FabricError::Spacing { thread: end, spacing_mm: 0.0, low: 0.0, high: 1.0 }.into(),
                "warp.spacing_mm",
            ),
            (
                FabricError::Spacing { thread: pick, spacing_mm: 0.0, low: 0.0, high: 1.0 }.into(),
                "weft.per_cm",
            ),
            (FabricError::Extent { set: "ends", extent_mm: 9.0, limit: 1.0 }.into(), "warp.spacing_mm"),
            (FabricError::Extent { set: "picks", extent_mm: 9.0, limit: 1.0 }.into(), "weft.per_cm"),
            (FabricError::Radius { thread: end, radius_mm: 0.0, low, high }.into(), "yarns.a.tex"),
            (FabricError::Stiffness { thread: end, stiffness: 0.0, low, high }.into(), "yarns.a.stiffness"),
            (FabricError::Flatness { thread: end, flatness: 0.0, low, high }.into(), "yarns.a.flatness"),
            (
                FabricError::Half { thread: pick, side: "width", half_mm: 0.0, low, high }.into(),
                "yarns.a.flatness",
            ),
            (FabricError::Twist { thread: pick, twist: 9.0, limit: 1.0 }.into(), "yarns.a.twist_per_m"),
            (FabricError::UnknownMaterial { thread: end, material: 9, materials: 1 }.into(), "yarns.a.color"),
            (FabricError::UnknownSection { thread: end, section: 9, sections: 1 }.into(), "yarns.a.section"),
            (FabricError::Section { section: 0, source: SectionError::Clockwise }.into(), "yarns.a.section"),
            (FabricError::Crimp { share: 9.0, low, high }.into(), "cloth.warp_crimp"),
            (wale().into(), "knit.wales_per_cm"),
            (
                FabricError::Gauge { what: "courses", mm: 0.0, low: 0.0, high: 1.0 }.into(),
                "knit.courses_per_cm",
            ),
            (
                FabricError::Gauge { what: "loops", mm: 0.0, low: 0.0, high: 1.0 }.into(),
                "knit.loop_length_mm",
            ),
            (FabricError::Carrier { carrier: 1, yarns: 0 }.into(), "knit.yarns"),
            (FabricError::KnitPoints { points: 9, limit: 1 }.into(), "weave.ends"),
            (FabricError::ClearancePoints { points: 9, limit: 1 }.into(), "weave.ends"),
            (FabricError::LinkingSize { intervals: 9, limit: 1 }.into(), "weave.ends"),
            (FabricError::Copies { loops: 9, limit: 1 }.into(), "knit.repeat"),
            (FabricError::Laps { laps: 9, limit: 1 }.into(), "warp_knit.wales"),
            (FabricError::Bars { bars: 0, limit: 1 }.into(), "warp_knit.bars"),
            (FabricError::GuideYarn { bar: 2, yarn: 1, yarns: 0 }.into(), "warp_knit.bars, bar 2: threading"),
            (FabricError::BarOffset { bar: 2, offset: 9, limit: 1 }.into(), "warp_knit.bars, bar 2: offset"),
            (
                FabricError::RunIn { bar: 2, mm: 0.0, low: 1.0, high: 2.0 }.into(),
                "warp_knit.bars, bar 2: run_in_mm",
            ),
            (
                FabricError::JacquardCourses { bar: 2, courses: 1, chain: 2 }.into(),
                "warp_knit.bars, bar 2: colors",
            ),
            (
                FabricError::JacquardLap { bar: 2, course: 1, lap: Lap { from: 3, to: 0 }, limit: 2 }.into(),
                "warp_knit.bars, bar 2: colors",
            ),
            (FabricError::WarpRepeat { what: "wales", size: 3, multiple: 2 }.into(), "warp_knit.wales"),
            (FabricError::WarpRepeat { what: "courses", size: 3, multiple: 2 }.into(), "warp_knit.courses"),
            (FabricError::Yarns(YarnError::NoYarns).into(), "weave.ends"),
            (
                SettlingError::ShortRepeat { axis: 'x', repeat: 1.0, diameter: 1.0, least: 2.0 }.into(),
                "knit.wales_per_cm",
            ),
            (
                SettlingError::ShortRepeat { axis: 'y', repeat: 1.0, diameter: 1.0, least: 2.0 }.into(),
                "knit.courses_per_cm",
            ),
            (SettlingError::LongInterval { yarn: 0, chords: 9, limit: 1 }.into(), "knit.wales_per_cm"),
            (SettlingError::LongYarns { points: 1, chords: 9, limit: 1 }.into(), "knit.loop_length_mm"),
            (SettlingError::TooLarge { extent: 9.0, diameter: 1.0 }.into(), "weave.ends"),
            (SettlingError::TooMany { what: "chords", count: 9, limit: 1 }.into(), "weave.ends"),
            (ask("the length").into(), "finish.length"),
            (ask("the tension").into(), "finish.tension"),
            (ask("the gap between the plates").into(), "finish.press"),
            (
                FinishError::Thread {
                    thread: Origin::Course(1),
                    source: SettlingError::LongInterval { yarn: 0, chords: 9, limit: 1 },
                },
                "knit.wales_per_cm",
            ),
            (FinishError::Woven { asked: "a length" }, "finish.length"),
            (FinishError::Woven { asked: "a press" }, "finish.press"),
            (FinishError::Stretch { along: "warp", by: 9.0, most: 1.0 }, "finish.stretch_warp"),
            (FinishError::Stretch { along: "weft", by: 9.0, most: 1.0 }, "finish.stretch_weft"),
            (thread("warp", "pitch").into(), "warp.spacing_mm"),
            (thread("weft", "pitch").into(), "weft.per_cm"),
            (thread("weft", "level").into(), "knit.chart"),
            (thread("warp", "diameter").into(), "yarns.a.tex"),
            (thread("weft", "stiffness").into(), "yarns.a.stiffness"),
            (pull("tension of the warp").into(), "finish.warp_tension"),
            (pull("tension of the weft").into(), "finish.weft_tension"),
            (pull("press").into(), "finish.calender"),
            (CrossingsError::TooFew { what: "ends", count: 0, least: 1 }.into(), "weave.ends"),
            (CrossingsError::TooMany { what: "crossings", count: 9, limit: 1 }.into(), "weave.ends"),
            (BackendError::Crowded { chords: 9, limit: 1 }.into(), "knit.chart"),
        ];
        let keys = keys();
        for (error, key) in cases {
            let line = keys.lines.iter().find(|(own, _)| own == key).map(|(_, line)| *line).unwrap_or(0);
            let place = keys.place(&error, |_| Some("a".into()));
            assert_eq!(place, Some(Place::new(&keys.file, line, key)), "{error}");
        }
        for error in [FabricError::Cancelled, FabricError::OutOfMemory { what: "loops", bytes: 1 }] {
            assert_eq!(keys.place(&error.into(), |_| None), None);
        }
    }

    #[test]
    fn a_thread_whose_yarn_is_not_known_has_what_threads_it() {
        let mut keys = keys();
        keys.lines.push(("yarns.b".into(), 99));
        let place = |thread| {
            let error = FabricError::Radius { thread, radius_mm: 0.0, low: 0.0, high: 1.0 };
            keys.place(&error.into(), |_| None).map(|place| place.field)
        };
        let said = [Origin::End(1), Origin::Pick(1), Origin::Carrier(1), Origin::Guide { bar: 2, guide: 1 }];
        let said = said.map(|thread| place(thread).unwrap_or_default());
        assert_eq!(said, ["warp.yarns", "weft.yarns", "knit.yarns", "warp_knit.bars, bar 2: threading"]);
    }
}
