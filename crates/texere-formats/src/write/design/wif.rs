//! A woven design as WIF 1.1, the Weaving Information File.
//!
//! An empty list is written as 0, because readers treat a section of empty values as missing.

use std::borrow::Cow;
use std::io::Write;

use texere_fabric::{Draft, LOOM_MAX, Shedding};

use super::super::WriteError;
use super::super::target::Target;
use super::cloth::beyond_wif;
use super::format::WIF_DRAFT as FORMAT;
use super::interlacing::Interlacing;
use super::text::{Text, within};
use super::wif_threads::{Colors, Set};
use super::woven::woven;
use crate::Design;
use crate::read::{WIF_BYTES_MAX, WIF_PROGRAM};

/// The contents of a WIF file, checked.
pub(super) struct WifFile<'a> {
    title: String,
    draft: Cow<'a, Draft>,
    shafts: u32,
    treadles: u32,
    colors: Colors,
    warp: Set,
    weft: Set,
    /// The parts of the design that the file does not hold.
    pub(super) left_out: Vec<String>,
}

impl<'a> WifFile<'a> {
    pub(super) fn new(design: &'a Design) -> Result<Self, WriteError> {
        let woven = woven(FORMAT, design)?;
        let cloth = woven.cloth();
        let mut left_out = Vec::new();
        let draft = match woven.draft() {
            Some(draft) if draft.drawdown().is_ok_and(|drawdown| drawdown == *cloth.drawdown()) => {
                Cow::Borrowed(draft)
            }
            own => {
                left_out.extend(own.map(|_| "the design's own draft, which weaves another cloth".into()));
                Cow::Owned(Interlacing::new(cloth.drawdown()).draft(FORMAT, WIF_BYTES_MAX)?)
            }
        };
        let (shafts, treadles) = loom(&draft);
        for (field, count) in [("[WEAVING] Shafts", shafts), ("[WEAVING] Treadles", treadles)] {
            within(FORMAT, || field.into(), count.into(), [0.0, LOOM_MAX.into()])?;
        }
        let title = title(&design.name);
        if title != design.name || title.is_empty() {
            left_out.push("name: a title is one line, not empty, without space around it".into());
        }
        let colors = Colors::new(cloth);
        left_out.extend(colors.unnamed(cloth));
        left_out.extend(beyond_wif(design, woven));
        let warp = Set::new("WARP", cloth.warp(), &colors)?;
        let weft = Set::new("WEFT", cloth.weft(), &colors)?;
        Ok(Self { title, draft, shafts, treadles, colors, warp, weft, left_out })
    }

    pub(super) fn write<W: Write>(&self, target: Target<W>) -> Result<Target<W>, WriteError> {
        let mut text = Text::new(target, FORMAT, WIF_BYTES_MAX);
        self.head(&mut text)?;
        self.warp.common(&mut text)?;
        self.weft.common(&mut text)?;
        self.colors.write(&mut text)?;
        lists(&mut text, "THREADING", &self.draft.threading)?;
        match &self.draft.shedding {
            Shedding::TieUp { tie_up, treadling } => {
                if tie_up.is_empty() {
                    // Nothing is tied to any treadle, but the section must have a line.
                    lists(&mut text, "TIEUP", &[Vec::new()])?;
                } else {
                    lists(&mut text, "TIEUP", tie_up)?;
                }
                lists(&mut text, "TREADLING", treadling)?;
            }
            Shedding::LiftPlan(lifts) => lists(&mut text, "LIFTPLAN", lifts)?,
        }
        self.warp.each(&mut text)?;
        self.weft.each(&mut text)?;
        Ok(text.end())
    }

    fn head<W: Write>(&self, text: &mut Text<W>) -> Result<(), WriteError> {
        text.line("[WIF]")?;
        text.line("Version=1.1")?;
        text.line("Date=April 20, 1997")?;
        text.line("Developers=wif@mhsoft.com")?;
        text.line(&format!("Source Program={WIF_PROGRAM}"))?;
        text.line(concat!("Source Version=", env!("CARGO_PKG_VERSION")))?;
        let is_treadled = matches!(self.draft.shedding, Shedding::TieUp { .. });
        let sections = [
            ("TEXT", !self.title.is_empty()),
            ("WEAVING", true),
            ("WARP", true),
            ("WEFT", true),
            ("COLOR PALETTE", !self.colors.table.is_empty()),
            ("COLOR TABLE", !self.colors.table.is_empty()),
            ("THREADING", true),
            ("TIEUP", is_treadled),
            ("TREADLING", is_treadled),
            ("LIFTPLAN", !is_treadled),
        ];
        text.line("\n[CONTENTS]")?;
        for (section, _) in sections.into_iter().filter(|(_, there)| *there) {
            text.line(&format!("{section}=true"))?;
        }
        for section in self.warp.sections().chain(self.weft.sections()) {
            text.line(&format!("{section}=true"))?;
        }
        if !self.title.is_empty() {
            text.line(&format!("\n[TEXT]\nTitle={}", self.title))?;
        }
        text.line("\n[WEAVING]")?;
        text.line(&format!("Shafts={}", self.shafts.max(1)))?;
        text.line(&format!("Treadles={}", if is_treadled { self.treadles.max(1) } else { 0 }))?;
        text.line(&format!("Rising Shed={}", self.draft.rising_shed))
    }
}

/// The highest shaft and the highest treadle of a draft.
fn loom(draft: &Draft) -> (u32, u32) {
    let highest = |lists: &[Vec<u32>]| lists.iter().flatten().max().copied().unwrap_or(0);
    let (shafts, treadles) = match &draft.shedding {
        Shedding::LiftPlan(lifts) => (highest(lifts), 0),
        Shedding::TieUp { tie_up, treadling } => {
            let tied = u32::try_from(tie_up.len()).unwrap_or(u32::MAX);
            (highest(tie_up), tied.max(highest(treadling)))
        }
    };
    (shafts.max(highest(&draft.threading)), treadles)
}

/// Writes a section with a list for each thread or treadle.
fn lists<W: Write>(text: &mut Text<W>, section: &str, lists: &[Vec<u32>]) -> Result<(), WriteError> {
    text.line(&format!("\n[{section}]"))?;
    for (number, list) in (1..).zip(lists) {
        text.put(&format!("{number}={}", list.first().copied().unwrap_or(0)))?;
        for other in list.iter().skip(1) {
            text.put(&format!(",{other}"))?;
        }
        text.put("\n")?;
    }
    Ok(())
}

/// A name as a title, which is one line without space around it.
fn title(name: &str) -> String {
    let plain: String = name.chars().map(|letter| if letter.is_control() { ' ' } else { letter }).collect();
    plain.trim().into()
}
