//! Finds the key of a design that an error of its cloth is about. Errors of structures, and of
//! yarns that come to rest, name threads, bars and sizes. In a file a key sets each of these, and
//! the key has a line.

use std::fmt::Display;
use std::path::{Path, PathBuf};

use texere_core::{Origin, Subject};
use texere_fabric::FinishError;

use super::{FilePlace, ReadError};

/// Keys that say how large a cloth is. From this list, and from each list below, an error names the
/// first key that the file has.
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
    "[WARP] threads",
    "@@Info %%ends",
];

/// Keys that say how threads interlace.
const STRUCTURE: &[&str] = &[
    "knit.chart",
    "knit.image",
    "knit.knitout",
    "weave.notation",
    "weave.drawdown",
    "weave.image",
    "weave.wif",
    "[TIEUP]",
    "[LIFTPLAN]",
    "@@Tieup",
    "@@Liftplan",
];

/// Keys that say how close wales lie.
const WALES: &[&str] = &[
    "knit.wales_per_cm",
    "knit.needles_per_inch",
    "warp_knit.wales_per_cm",
    "warp_knit.needles_per_inch",
    "knit.loop_length_mm",
    "knit.knitout",
    GAUGE,
];

/// Keys that say how close courses lie.
const COURSES: &[&str] =
    &["knit.courses_per_cm", "warp_knit.courses_per_cm", "knit.loop_length_mm", "knit.knitout", GAUGE];

/// Keys that say how long loops are.
const LOOPS: &[&str] = &[
    "knit.loop_length_mm",
    "knit.stitch_lengths_mm",
    "knit.wales_per_cm",
    "knit.needles_per_inch",
    "warp_knit.wales_per_cm",
    "warp_knit.needles_per_inch",
    "knit.knitout",
    GAUGE,
];

/// Keys of a yarn that say how thick it is.
const THICKNESS: &[&str] = &["diameter_mm", "tex", "cotton_count"];

/// The tables of a design file that describe a structure. If no key fits, an error names the first
/// of these tables that the file has.
const TABLES: &[&str] = &["weave", "knit", "warp_knit"];

/// The header of a knitout file that says how close needles lie.
pub(super) const GAUGE: &str = ";;Gauge";

/// The keys of a file in their order, as errors write them, and the line of each.
#[derive(Debug, Clone, Default)]
pub(super) struct Keys {
    pub(super) file: PathBuf,
    pub(super) lines: Vec<(String, usize)>,
    /// Sections of a WIF draft with a line for each thread, such as `WARP SPACING`: the numbers of
    /// threads, sorted, and their lines.
    pub(super) numbered: Vec<(String, Vec<(u32, usize)>)>,
    /// The first operation of each carrier in a knitout file, and its line.
    pub(super) carriers: Vec<(Origin, String, usize)>,
    /// The last operation of a knitout file that makes a loop, or the first with a carrier if none
    /// does, and its line. Errors about the size or the structure of the cloth name this operation.
    pub(super) last: Option<(String, usize)>,
    /// The keys of the draft that the design names.
    pub(super) named: Option<Box<Self>>,
}

impl Keys {
    /// The path of the file, or none if the keys are of no file.
    pub(super) fn file(&self) -> Option<&Path> {
        (!self.file.as_os_str().is_empty()).then_some(&*self.file)
    }

    /// The place that an error is about, in the file or in the draft that the file names. `yarn`
    /// gives the name of a thread's yarn. None if the error has no subject, or if the file has
    /// neither a key for the subject nor a table of a structure.
    pub(super) fn place(
        &self,
        error: &FinishError,
        yarn: impl Fn(Origin) -> Option<String>,
    ) -> Option<FilePlace> {
        let subject = error.subject()?;
        let thread = match (error, subject) {
            (FinishError::Thread { thread, .. }, _) => *thread,
            (_, Subject::Thickness(thread) | Subject::Twist(thread)) => thread,
            _ => Origin::Unknown,
        };
        if let Some((_, operation, line)) = self.carriers.iter().find(|(carrier, ..)| *carrier == thread) {
            return Some(FilePlace::new(&self.file, *line, operation));
        }
        let all = [Some(self), self.named.as_deref()].into_iter().flatten();
        let mut found = all.filter_map(|keys| keys.of(subject, &yarn));
        found.next().or_else(|| self.first(TABLES))
    }

    /// Adds the place in the file to an error of the cloth.
    pub(super) fn placed<T>(&self, read: Result<T, ReadError>) -> Result<T, ReadError> {
        read.map_err(|error| match error {
            ReadError::Fabric { file, source } if file == self.file => {
                match self.place(&source.clone().into(), |_| None) {
                    Some(place) => ReadError::Cloth { place, source },
                    None => ReadError::Fabric { file, source },
                }
            }
            error => error,
        })
    }

    /// The place in this file of the key that sets `subject`.
    fn of(&self, subject: Subject, yarn: &impl Fn(Origin) -> Option<String>) -> Option<FilePlace> {
        let yarn = |thread, keys| self.yarn(thread, yarn(thread), keys);
        match subject {
            Subject::Size => self.first(SIZE).or_else(|| self.last()),
            Subject::Width => self.line("warp_knit.wales"),
            Subject::Height => self.line("warp_knit.courses"),
            Subject::Copies => self.first(&["knit.repeat", "warp_knit.repeat", "warp_knit.wales"]),
            Subject::Structure => self.first(STRUCTURE).or_else(|| self.lappings()).or_else(|| self.last()),
            Subject::Wales => self.first(WALES),
            Subject::Courses => self.first(COURSES),
            Subject::Loops => self.first(LOOPS),
            Subject::Ends => self.spacings("warp"),
            Subject::Picks => self.spacings("weft"),
            Subject::Spacing(thread) => self.spacing(thread),
            Subject::Thickness(thread) => self.thickness(thread).or_else(|| yarn(thread, THICKNESS)),
            Subject::Flatness(thread) => {
                yarn(thread, &[&["flatness"], THICKNESS].concat()).or_else(|| self.thickness(thread))
            }
            Subject::Stiffness(thread) => yarn(thread, &["stiffness"]),
            Subject::Firmness(thread) => yarn(thread, &["firmness", "twist_per_m"]),
            Subject::LeastArea(thread) => yarn(thread, &["least_area", "packing", "fibre"]),
            Subject::Twist(thread) => yarn(thread, &["twist_per_m"]),
            Subject::Color(thread) => yarn(thread, &["color"]),
            Subject::Section(thread) => yarn(thread, &["section"]),
            Subject::Crimp => self.line("cloth.warp_crimp"),
            Subject::Carriers => self.line("knit.yarns"),
            Subject::Bars => self.line("warp_knit.bars"),
            Subject::Threading(number) => self.bar(number, "threading"),
            Subject::Offset(number) => self.bar(number, "offset"),
            Subject::RunIn(number) => self.bar(number, "run_in_mm"),
            Subject::Jacquard(number) => self.bar(number, "colors"),
            Subject::Rest => self.line("finish.rest"),
            Subject::Length => self.line("finish.length"),
            Subject::Tension => self.line("finish.tension"),
            Subject::Press => self.line("finish.press"),
            Subject::WarpStretch => self.line("finish.stretch_warp"),
            Subject::WeftStretch => self.line("finish.stretch_weft"),
            Subject::WarpTension => self.line("finish.warp_tension"),
            Subject::WeftTension => self.line("finish.weft_tension"),
            Subject::Calender => self.line("finish.calender"),
        }
    }

    fn line(&self, key: &str) -> Option<FilePlace> {
        let (_, line) = self.lines.iter().find(|(own, _)| own == key)?;
        Some(FilePlace::new(&self.file, *line, key))
    }

    /// The place of the lapping of a warp knit's only bar, or of all bars if there are several.
    fn lappings(&self) -> Option<FilePlace> {
        if self.bar(2, "lapping").is_some() { self.line("warp_knit.bars") } else { self.bar(1, "lapping") }
    }

    /// The place of a key of a guide bar, counted from 1.
    fn bar(&self, number: impl Display, key: &str) -> Option<FilePlace> {
        self.line(&format!("warp_knit.bars, bar {number}: {key}"))
    }

    fn first(&self, keys: &[&str]) -> Option<FilePlace> {
        keys.iter().find_map(|key| self.line(key))
    }

    fn last(&self) -> Option<FilePlace> {
        self.last.as_ref().map(|(operation, line)| FilePlace::new(&self.file, *line, operation))
    }

    /// The place of the key that spaces the threads of `set`, which is `warp` or `weft`. In a draft
    /// without a spacing, and in any of Fiberworks, it is the place of the number of threads.
    fn spacings(&self, set: &str) -> Option<FilePlace> {
        let own = ["spacing_mm", "per_cm", "per_inch"];
        let own = own.iter().find_map(|key| self.line(&format!("{set}.{key}")));
        let section = set.to_uppercase();
        own.or_else(|| self.line(&format!("[{section}] spacing")))
            .or_else(|| self.line(&format!("[{section}] threads")))
            .or_else(|| self.line(if set == "warp" { "@@Info %%ends" } else { "@@Info %%picks" }))
    }

    fn spacing(&self, thread: Origin) -> Option<FilePlace> {
        let set = if matches!(thread, Origin::Pick(_)) { "weft" } else { "warp" };
        self.numbered("SPACING", thread).or_else(|| self.spacings(set))
    }

    /// The place of a thread's thickness in a WIF draft. In a draft without thickness it is the
    /// place of the spacing, from which the thickness is worked out.
    fn thickness(&self, thread: Origin) -> Option<FilePlace> {
        let set = if matches!(thread, Origin::Pick(_)) { "WEFT" } else { "WARP" };
        self.numbered("THICKNESS", thread)
            .or_else(|| self.line(&format!("[{set}] thickness")))
            .or_else(|| self.spacing(thread).filter(|_| self.line("[WARP] threads").is_some()))
    }

    /// The line of a WIF draft that gives a thread's `what`, its spacing or its thickness.
    fn numbered(&self, what: &str, thread: Origin) -> Option<FilePlace> {
        let (set, number) = match thread {
            Origin::End(number) => ("WARP", number),
            Origin::Pick(number) => ("WEFT", number),
            _ => return None,
        };
        let section = format!("{set} {what}");
        let (_, threads) = self.numbered.iter().find(|(own, _)| *own == section)?;
        let found = threads.binary_search_by_key(&number, |(own, _)| *own).ok()?;
        Some(FilePlace::new(&self.file, threads[found].1, &format!("[{section}] {number}")))
    }

    /// The place of the first of `keys` that the thread's yarn has, or else of the yarn's table.
    /// The yarn is the one called `name`, or else the file's only yarn. If no yarn is found, the
    /// place is that of the key that says which yarns are threaded.
    fn yarn(&self, thread: Origin, name: Option<String>, keys: &[&str]) -> Option<FilePlace> {
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
            Origin::Guide { bar, .. } => self.bar(bar, "threading"),
            Origin::Course(_) | Origin::Carrier(_) => self.line("knit.yarns"),
            _ => None,
        })
    }
}

#[cfg(test)]
mod tests {
    use texere_contact::ContactError;
    use texere_core::{
        BackendError, CrossingsError, OutOfMemory, RelaxationError, SectionError, SettlingError, YarnError,
    };
    use texere_fabric::warp::{Lap, WarpError};
    use texere_fabric::weft::WeftError;
    use texere_fabric::{FabricError, ThreadError, WovenError};

    use super::*;

    /// Keys of woven cloth, weft knits and warp knits, each on a line of its own.
    fn keys() -> Keys {
        let all = "weave weave.notation weave.ends knit knit.chart knit.repeat knit.yarns knit.wales_per_cm \
                   knit.courses_per_cm knit.loop_length_mm warp_knit warp_knit.wales warp_knit.courses warp_knit.bars \
                   warp.yarns warp.spacing_mm weft.yarns weft.per_cm finish.rest finish.length finish.tension finish.press \
                   finish.stretch_warp finish.stretch_weft finish.warp_tension finish.weft_tension finish.calender \
                   cloth.warp_crimp yarns.a yarns.a.tex yarns.a.flatness yarns.a.stiffness yarns.a.twist_per_m \
                   yarns.a.section yarns.a.color";
        let bars = ["threading", "offset", "run_in_mm", "colors"];
        let bars = bars.map(|key| format!("warp_knit.bars, bar 2: {key}"));
        let all = all.split_whitespace().map(str::to_owned).chain(bars);
        Keys { file: "cloth.toml".into(), lines: all.zip(1..).collect(), ..Keys::default() }
    }

    #[test]
    fn every_error_of_cloth_has_its_key() {
        let (end, pick) = (Origin::End(2), Origin::Pick(3));
        let (low, high) = (0.0, 1.0);
        let wale = || FabricError::Weft(WeftError::Gauge { what: "wales", mm: 0.0, low: 0.0, high: 1.0 });
        let thread = |set, setting| CrossingsError::Thread { set, thread: 1, setting, value: 9.0, low, high };
        let ask = |setting| SettlingError::Setting { setting, value: 9.0, low, high };
        let relax = |setting| RelaxationError::Setting { setting, value: 9.0, low: 0.5, high: 2.0 };
        let pull = |setting| CrossingsError::Setting { setting, value: 99.0, low, high };
        let stitches = || FabricError::Weft(WeftError::Stitches { what: "none" });
        let cases: Vec<(FinishError, &str)> = vec![
            (FabricError::Woven(WovenError::Size { ends: 0, picks: 0, limit: 1 }).into(), "weave.ends"),
            (
                FabricError::Woven(WovenError::Crossings { ends: 9, picks: 9, crossings: 81, limit: 1 })
                    .into(),
                "weave.ends",
            ),
            (
                FabricError::Woven(WovenError::Points { ends: 9, picks: 9, points: 81, limit: 1 }).into(),
                "weave.ends",
            ),
            (FabricError::Woven(WovenError::Repeat { ends: 9, picks: 9, limit: 1 }).into(), "weave.ends"),
            (
                FabricError::Woven(WovenError::ThreadCount { set: "end", threads: 1, planned: 2 }).into(),
                "weave.ends",
            ),
            (FabricError::Woven(WovenError::TieUp { treadles: 1, ends: 2, limit: 1 }).into(), "knit.chart"),
            (
                FabricError::Weft(WeftError::KnitRuns { passed: 9, loops: 1, limit: 1, operation: None })
                    .into(),
                "knit.chart",
            ),
            (
                FabricError::Weft(WeftError::KnitSize { what: "loops", count: 9, limit: 1, operation: 0 })
                    .into(),
                "knit.chart",
            ),
            (FabricError::Weft(WeftError::KnitCarriers { operation: 1 }).into(), "knit.chart"),
            (stitches().into(), "knit.chart"),
            (FabricError::Warp(WarpError::NoLoops).into(), "knit.chart"),
            (
                FabricError::Woven(WovenError::Spacing { thread: end, spacing_mm: 0.0, low: 0.0, high: 1.0 })
                    .into(),
                "warp.spacing_mm",
            ),
            (
                FabricError::Woven(WovenError::Spacing {
                    thread: pick,
                    spacing_mm: 0.0,
                    low: 0.0,
                    high: 1.0,
                })
                .into(),
                "weft.per_cm",
            ),
            (
                FabricError::Woven(WovenError::Extent { set: "ends", extent_mm: 9.0, limit: 1.0 }).into(),
                "warp.spacing_mm",
            ),
            (
                FabricError::Woven(WovenError::Extent { set: "picks", extent_mm: 9.0, limit: 1.0 }).into(),
                "weft.per_cm",
            ),
            (
                FabricError::Thread(ThreadError::Radius { thread: end, radius_mm: 0.0, low, high }).into(),
                "yarns.a.tex",
            ),
            (
                FabricError::Woven(WovenError::Stiffness { thread: end, stiffness: 0.0, low, high }).into(),
                "yarns.a.stiffness",
            ),
            (
                FabricError::Woven(WovenError::Flatness { thread: end, flatness: 0.0, low, high }).into(),
                "yarns.a.flatness",
            ),
            (
                FabricError::Woven(WovenError::Half { thread: pick, side: "width", half_mm: 0.0, low, high })
                    .into(),
                "yarns.a.flatness",
            ),
            (
                FabricError::Thread(ThreadError::Twist { thread: pick, twist: 9.0, limit: 1.0 }).into(),
                "yarns.a.twist_per_m",
            ),
            (
                FabricError::Thread(ThreadError::UnknownMaterial { thread: end, material: 9, materials: 1 })
                    .into(),
                "yarns.a.color",
            ),
            (
                FabricError::Thread(ThreadError::UnknownSection { thread: end, section: 9, sections: 1 })
                    .into(),
                "yarns.a.section",
            ),
            (
                FabricError::Thread(ThreadError::Section { section: 0, source: SectionError::Clockwise })
                    .into(),
                "yarns.a.section",
            ),
            (FabricError::Woven(WovenError::Crimp { share: 9.0, low, high }).into(), "cloth.warp_crimp"),
            (wale().into(), "knit.wales_per_cm"),
            (
                FabricError::Weft(WeftError::Gauge { what: "courses", mm: 0.0, low: 0.0, high: 1.0 }).into(),
                "knit.courses_per_cm",
            ),
            (
                FabricError::Weft(WeftError::Gauge { what: "loops", mm: 0.0, low: 0.0, high: 1.0 }).into(),
                "knit.loop_length_mm",
            ),
            (FabricError::Weft(WeftError::Carrier { carrier: 1, yarns: 0 }).into(), "knit.yarns"),
            (FabricError::Weft(WeftError::KnitPoints { points: 9, limit: 1 }).into(), "weave.ends"),
            (FabricError::Weft(WeftError::KnitRepeat { points: 9, limit: 1 }).into(), "knit.chart"),
            (
                FabricError::Contact(ContactError::ClearancePoints { points: 9, limit: 1 }).into(),
                "weave.ends",
            ),
            (FabricError::Contact(ContactError::LinkingSize { intervals: 9, limit: 1 }).into(), "weave.ends"),
            (FabricError::Weft(WeftError::Copies { loops: 9, limit: 1 }).into(), "knit.repeat"),
            (FabricError::Warp(WarpError::Laps { laps: 9, limit: 1 }).into(), "warp_knit.wales"),
            (FabricError::Warp(WarpError::Bars { bars: 0, limit: 1 }).into(), "warp_knit.bars"),
            (
                FabricError::Warp(WarpError::GuideYarn { bar: 2, yarn: 1, yarns: 0 }).into(),
                "warp_knit.bars, bar 2: threading",
            ),
            (
                FabricError::Warp(WarpError::BarOffset { bar: 2, offset: 9, limit: 1 }).into(),
                "warp_knit.bars, bar 2: offset",
            ),
            (
                FabricError::Warp(WarpError::RunIn { bar: 2, mm: 0.0, low: 1.0, high: 2.0 }).into(),
                "warp_knit.bars, bar 2: run_in_mm",
            ),
            (
                FabricError::Warp(WarpError::JacquardCourses { bar: 2, courses: 1, chain: 2 }).into(),
                "warp_knit.bars, bar 2: colors",
            ),
            (
                FabricError::Warp(WarpError::JacquardLap {
                    bar: 2,
                    course: 1,
                    lap: Lap { from: 3, to: 0 },
                    limit: 2,
                })
                .into(),
                "warp_knit.bars, bar 2: colors",
            ),
            (
                FabricError::Warp(WarpError::WarpRepeat { what: "wale", size: 3, multiple: 2 }).into(),
                "warp_knit.wales",
            ),
            (
                FabricError::Warp(WarpError::WarpRepeat { what: "course", size: 3, multiple: 2 }).into(),
                "warp_knit.courses",
            ),
            (FabricError::Yarns(YarnError::NoYarns).into(), "weave.ends"),
            (
                FabricError::Woven(WovenError::NoWeave { text: "x".into(), position: 1, near: None }).into(),
                "knit.chart",
            ),
            (
                FabricError::Woven(WovenError::Hyphen { text: "x".into(), position: 1, sign: "a dash" })
                    .into(),
                "knit.chart",
            ),
            (
                SettlingError::ShortRepeat { axis: 'x', repeat: 1.0, diameter: 1.0, least: 2.0 }.into(),
                "knit.wales_per_cm",
            ),
            (
                SettlingError::ShortRepeat { axis: 'y', repeat: 1.0, diameter: 1.0, least: 2.0 }.into(),
                "knit.courses_per_cm",
            ),
            (
                SettlingError::LongInterval { yarn: 0, axis: 'x', chords: 9, limit: 1 }.into(),
                "knit.wales_per_cm",
            ),
            (
                SettlingError::LongInterval { yarn: 0, axis: 'y', chords: 9, limit: 1 }.into(),
                "knit.courses_per_cm",
            ),
            (SettlingError::LongYarns { points: 1, chords: 9, limit: 1 }.into(), "knit.loop_length_mm"),
            (SettlingError::TooLarge { extent: 9.0, diameter: 1.0 }.into(), "weave.ends"),
            (SettlingError::TooMany { what: "chords", count: 9, limit: 1 }.into(), "weave.ends"),
            (ask("the length").into(), "finish.length"),
            (ask("the tension").into(), "finish.tension"),
            (ask("the gap between the plates").into(), "finish.press"),
            (
                FinishError::Thread {
                    thread: Origin::Course(1),
                    source: SettlingError::LongInterval { yarn: 0, axis: 'x', chords: 9, limit: 1 },
                },
                "knit.wales_per_cm",
            ),
            (FinishError::NoEnergy { cloth: "woven" }, "finish.rest"),
            (relax("the length").into(), "finish.length"),
            (
                RelaxationError::Interval { yarn: 0, point: 1, length: 9.0, core: 0.1, most: 5.0 }.into(),
                "knit.loop_length_mm",
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
            (CrossingsError::TooFew { what: "end", count: 0, least: 1 }.into(), "weave.ends"),
            (CrossingsError::TooMany { what: "crossings", count: 9, limit: 1 }.into(), "weave.ends"),
            (BackendError::Crowded { chords: 9, limit: 1 }.into(), "knit.chart"),
        ];
        let keys = keys();
        for (error, key) in cases {
            let line = keys.lines.iter().find(|(own, _)| own == key).map(|(_, line)| *line).unwrap_or(0);
            let place = keys.place(&error, |_| Some("a".into()));
            assert_eq!(place, Some(FilePlace::new(&keys.file, line, key)), "{error}");
        }
        // A request to stop, a lack of memory, and a call that does not fit the cloth are no faults
        // of a design.
        for error in [
            FabricError::Cancelled,
            FabricError::OutOfMemory(OutOfMemory { what: "loops", bytes: 1 }),
            FabricError::Woven(WovenError::OtherCloth { yarn: 1 }),
            FabricError::Woven(WovenError::NoCrossing { end: 9, pick: 9, ends: 1, picks: 1 }),
        ] {
            assert_eq!(keys.place(&error.into(), |_| None), None);
        }
    }

    #[test]
    fn a_thread_whose_yarn_is_not_known_has_what_threads_it() {
        let mut keys = keys();
        keys.lines.push(("yarns.b".into(), 99));
        let place = |thread| {
            let error =
                FabricError::Thread(ThreadError::Radius { thread, radius_mm: 0.0, low: 0.0, high: 1.0 });
            keys.place(&error.into(), |_| None).map(|place| place.field)
        };
        let said = [Origin::End(1), Origin::Pick(1), Origin::Carrier(1), Origin::Guide { bar: 2, guide: 1 }];
        let said = said.map(|thread| place(thread).unwrap_or_default());
        assert_eq!(said, ["warp.yarns", "weft.yarns", "knit.yarns", "warp_knit.bars, bar 2: threading"]);
    }
}
