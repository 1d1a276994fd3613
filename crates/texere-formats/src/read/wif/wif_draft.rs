//! A WIF draft: threading, shedding and threads of a cloth.

use std::collections::BTreeSet;
use std::path::Path;

use texere_fabric::{LOOM_MAX, Shedding};

use super::colors::Palette;
use super::ini::Ini;
use super::numbers::{self, integer, lists};
use super::program::is_ours;
use super::threads;
use crate::read::ReadError;
use crate::read::draft::{LoomDraft, Plans, THREADS_MAX, decode};
use crate::read::file::file_name;
use crate::read::keys::Keys;

/// Reads the bytes of a WIF file.
pub(crate) fn draft(path: &Path, bytes: &[u8]) -> Result<LoomDraft, ReadError> {
    let text = decode(bytes);
    let ini = Ini::parse(path, &text);
    let keys = ini.keys();
    let draft = keys.placed(drafted(&ini))?;
    Ok(LoomDraft { keys, ..draft })
}

fn drafted(ini: &Ini<'_>) -> Result<LoomDraft, ReadError> {
    let path = ini.file;
    let mut warnings = Vec::new();

    let ends = thread_count(ini, "warp", "WARP")?;
    let picks = thread_count(ini, "weft", "WEFT")?;
    let (draft, drawdown) = plans(ini, ends, picks, &mut warnings)?.draft(path, &mut warnings)?;
    let palette = Palette::read(ini, &mut warnings)?;
    let threads = threads::read(ini, [ends, picks], palette, &mut warnings)?;
    let woven = threads.woven(path, drawdown, &mut warnings)?;
    let name = ini.get("text", "title").map_or_else(|| file_name(path), |entry| entry.value.into());
    Ok(LoomDraft { name, woven, draft, warnings, keys: Keys::default() })
}

fn thread_count(ini: &Ini<'_>, section: &str, name: &str) -> Result<u32, ReadError> {
    integer(ini, section, "threads", 1, THREADS_MAX)?.ok_or_else(|| ReadError::MissingKey {
        file: ini.file.into(),
        field: format!("[{name}] Threads"),
        needed_for: "it says how many threads there are",
    })
}

fn missing(ini: &Ini<'_>, section: &'static str, needed_for: &'static str) -> ReadError {
    ReadError::MissingSection { file: ini.file.into(), section, needed_for }
}

/// The plans of the file: a threading, and a tie-up with a treadling, or else a lift plan. If a
/// file has a lift plan beside the tie-up and the treadling, the lift plan is used only if
/// `[WEAVING]` says that the loom has no treadles.
fn plans(ini: &Ini<'_>, ends: u32, picks: u32, warnings: &mut Vec<String>) -> Result<Plans, ReadError> {
    if !ini.has("threading") {
        return Err(missing(ini, "THREADING", "it says which shaft each end is on"));
    }
    let threading = lists(ini, "threading", ends, LOOM_MAX, warnings)?;
    let highest = threading.iter().flatten().max().copied().unwrap_or(0);
    counted_from_1(ini, &threading, highest, warnings)?;
    let shafts = on_loom(ini, "Shafts", highest, "THREADING", warnings)?.unwrap_or(LOOM_MAX);
    let rising_shed = rising_shed(ini)?;
    let lift_plan =
        ini.has("liftplan").then(|| lists(ini, "liftplan", picks, shafts, warnings)).transpose()?;
    let treadled = if lift_plan.is_some() && has_no_treadles(ini, warnings)? {
        None
    } else {
        treadled(ini, picks, shafts, warnings)?
    };
    let (shedding, other) = match (treadled, lift_plan) {
        (Some(treadled), Some(lift_plan)) => (treadled, Some(Shedding::LiftPlan(lift_plan))),
        (Some(shedding), None) => (shedding, None),
        (None, Some(lift_plan)) => (Shedding::LiftPlan(lift_plan), None),
        (None, None) if ini.has("treadling") => {
            return Err(missing(ini, "TIEUP", "it says what each treadle of TREADLING lifts"));
        }
        (None, None) if ini.has("tieup") => {
            return Err(missing(ini, "TREADLING", "it says which treadles of TIEUP each pick uses"));
        }
        (None, None) => {
            return Err(missing(ini, "LIFTPLAN", "without TIEUP and TREADLING it says what each pick lifts"));
        }
    };
    Ok(Plans { threading, shedding, other, rising_shed })
}

/// Refuses a draft that counts shafts from 0. Such a draft shows three signs. It has ends on shaft
/// 0 and on every further shaft, except the last one that `[WEAVING]` declares. Its lifts name
/// shaft 0. Its lifts do not name that last shaft. If ends and lifts name shaft 0, but another sign
/// is missing, there is a warning. Drafts that texere has written count from 1.
fn counted_from_1(
    ini: &Ini<'_>,
    threading: &[Vec<u32>],
    highest: u32,
    warnings: &mut Vec<String>,
) -> Result<(), ReadError> {
    let first = (1..).zip(threading).find_map(|(end, shafts)| {
        let (key, empty) = (u32::to_string(&end), shafts.is_empty());
        let entry = ini.get("threading", &key).filter(|_| empty)?;
        Some((key, entry))
    });
    let Some((key, entry)) = first else { return Ok(()) };
    let lifts = ["tieup", "liftplan"].into_iter().flat_map(|section| {
        ini.entries(section).flat_map(move |(key, entry)| numbers::list(ini, section, key, entry).flatten())
    });
    let lifts: BTreeSet<_> = lifts.collect();
    if highest == 0 || !lifts.contains(&0) || is_ours(ini) {
        return Ok(());
    }
    let declared = integer(ini, "weaving", "shafts", 0, LOOM_MAX)?;
    let used: BTreeSet<_> = threading.iter().flatten().collect();
    let is_last_lifted = lifts.last().is_some_and(|shaft| *shaft > i64::from(highest));
    if declared == Some(highest + 1) && used.len() == highest as usize && !is_last_lifted {
        let expected = "a shaft from 1: shafts are counted from 1 in WIF, in this file from 0";
        return Err(numbers::bad(ini, "threading", &key, entry, expected));
    }
    warnings.push(format!(
        "[THREADING] {key} is shaft 0, which some lifts name, too; 0 stands for no shaft, for WIF counts them from 1"
    ));
    Ok(())
}

/// Whether the file says that the loom has no treadles. TIEUP and TREADLING then have no effect.
fn has_no_treadles(ini: &Ini<'_>, warnings: &mut Vec<String>) -> Result<bool, ReadError> {
    let none = integer(ini, "weaving", "treadles", 0, LOOM_MAX)? == Some(0);
    if none && (ini.has("tieup") || ini.has("treadling")) {
        warnings.push("[WEAVING] Treadles is 0; the lift plan is taken, without TIEUP and TREADLING".into());
    }
    Ok(none)
}

/// Tie-up and treadling, or none if one of them is missing.
fn treadled(
    ini: &Ini<'_>,
    picks: u32,
    shafts: u32,
    warnings: &mut Vec<String>,
) -> Result<Option<Shedding>, ReadError> {
    if !ini.has("tieup") || !ini.has("treadling") {
        return Ok(None);
    }
    let rows = ini.entries("tieup").filter_map(|(key, _)| key.parse().ok());
    let highest = rows.filter(|row| *row <= LOOM_MAX).max().unwrap_or(0);
    let treadles = on_loom(ini, "Treadles", highest, "TIEUP", warnings)?;
    let tie_up = lists(ini, "tieup", treadles.unwrap_or(highest), shafts, warnings)?;
    let treadling = lists(ini, "treadling", picks, treadles.unwrap_or(LOOM_MAX), warnings)?;
    Ok(Some(Shedding::TieUp { tie_up, treadling }))
}

/// The number of the loom's shafts or treadles: the number under `key` in `[WEAVING]`, or
/// `highest`, the highest number in `section`, if that is greater. None if `[WEAVING]` has no
/// `key`.
fn on_loom(
    ini: &Ini<'_>,
    key: &str,
    highest: u32,
    section: &str,
    warnings: &mut Vec<String>,
) -> Result<Option<u32>, ReadError> {
    let Some(declared) = integer(ini, "weaving", &key.to_lowercase(), 0, LOOM_MAX)? else {
        return Ok(None);
    };
    if highest > declared {
        warnings.push(format!(
            "[WEAVING] {key} is {declared}, but [{section}] goes up to {highest}; so many are taken"
        ));
    }
    Ok(Some(declared.max(highest)))
}

fn rising_shed(ini: &Ini<'_>) -> Result<bool, ReadError> {
    let Some(entry) = ini.get("weaving", "rising shed") else { return Ok(true) };
    match entry.value.to_lowercase().as_str() {
        "true" | "yes" | "on" | "1" => Ok(true),
        "false" | "no" | "off" | "0" => Ok(false),
        _ => Err(numbers::bad(ini, "weaving", "rising shed", entry, "true or false")),
    }
}
