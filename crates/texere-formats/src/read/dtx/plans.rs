//! Threading, tie-up, treadling and lift plan of a Fiberworks file.

use texere_core::counted;
use texere_fabric::{LOOM_MAX, Shedding};

use super::sections::Sections;
use crate::read::ReadError;
use crate::read::draft::Plans;

/// The plans of a file: a threading, and a tie-up with a treadling, or else a lift plan.
pub(super) fn plans(
    dtx: &Sections<'_>,
    [ends, picks]: [u32; 2],
    warnings: &mut Vec<String>,
) -> Result<Plans, ReadError> {
    if dtx.get("threading").is_none() {
        return Err(missing(dtx, "@@Threading", "it says which shaft each end is on"));
    }
    let threading = dtx.numbers("threading", LOOM_MAX, "a shaft")?;
    let highest = threading.iter().max().copied().unwrap_or(0);
    let threading = threading.into_iter().map(|shaft| Vec::from_iter((shaft > 0).then_some(shaft)));
    let threading = fitted("@@Threading", threading.collect(), ends, warnings);
    // Rows of a tie-up and digits of a lift plan may stand for shafts that no end is on.
    let lift_plan = lift_plan(dtx)?.map(|lifts| fitted("@@Liftplan", lifts, picks, warnings));
    let treadled = match (tie_up(dtx)?, dtx.get("treadling")) {
        (Some(tie_up), Some(_)) => {
            let declared = dtx.info("treadles", LOOM_MAX)?.map_or(0, |(treadles, _)| treadles);
            let treadling = treadling(dtx, declared.max(tie_up.len() as u32))?;
            let treadling = fitted("@@Treadling", treadling, picks, warnings);
            Some(Shedding::TieUp { tie_up, treadling })
        }
        _ => None,
    };
    if let Some((declared, _)) = dtx.info("shafts", LOOM_MAX)?.filter(|(declared, _)| *declared < highest) {
        warnings.push(format!(
            "@@Info %%shafts is {declared}, but @@Threading goes up to {highest}; so many are taken"
        ));
    }
    let (shedding, other) = match (treadled, lift_plan) {
        (Some(treadled), lift_plan) => (treadled, lift_plan.map(Shedding::LiftPlan)),
        (None, Some(lift_plan)) => (Shedding::LiftPlan(lift_plan), None),
        (None, None) if dtx.get("treadling").is_some() => {
            return Err(missing(dtx, "@@Tieup", "it says what each treadle of @@Treadling lifts"));
        }
        (None, None) if dtx.get("tieup").is_some() => {
            return Err(missing(dtx, "@@Treadling", "it says which treadles of @@Tieup each pick uses"));
        }
        (None, None) => {
            let needed_for = "without @@Tieup and @@Treadling it says what each pick lifts";
            return Err(missing(dtx, "@@Liftplan", needed_for));
        }
    };
    let rising_shed = !(dtx.is_sinking("tieup") || dtx.is_sinking("liftplan"));
    Ok(Plans { threading, shedding, other, rising_shed })
}

fn missing(dtx: &Sections<'_>, field: &str, needed_for: &'static str) -> ReadError {
    ReadError::MissingKey { file: dtx.file.into(), field: field.into(), needed_for }
}

/// The list of a section with an entry for each of `count` threads. Entries beyond are left out
/// with a warning. Threads without an entry have an empty one.
fn fitted(section: &str, mut list: Vec<Vec<u32>>, count: u32, warnings: &mut Vec<String>) -> Vec<Vec<u32>> {
    let beyond = list.len().saturating_sub(count as usize);
    if beyond > 0 {
        let (values, they) = (counted(beyond, "value"), if beyond == 1 { "it is" } else { "they are" });
        let threads = counted(count, "thread");
        warnings.push(format!("{section} has {values} beyond the {threads} of @@Info; {they} left out"));
    }
    list.resize(count as usize, Vec::new());
    list
}

/// The shafts that each pick lifts.
fn lift_plan(dtx: &Sections<'_>) -> Result<Option<Vec<Vec<u32>>>, ReadError> {
    let Some(section) = dtx.get("liftplan") else { return Ok(None) };
    let mut lifts = Vec::new();
    for row in &section.rows {
        if row.text.len() > LOOM_MAX as usize {
            return Err(row.refused(dtx.file, &format!("a digit for each of {LOOM_MAX} shafts at most")));
        }
        let mut lifted = Vec::new();
        for (shaft, digit) in (1..).zip(row.digits(dtx.file)) {
            if digit? {
                lifted.push(shaft);
            }
        }
        lifts.push(lifted);
    }
    Ok(Some(lifts))
}

/// The shafts that are tied to each treadle.
fn tie_up(dtx: &Sections<'_>) -> Result<Option<Vec<Vec<u32>>>, ReadError> {
    let Some(section) = dtx.get("tieup") else { return Ok(None) };
    let treadles = section.rows[0].text.len().min(LOOM_MAX as usize);
    let mut tie_up = vec![Vec::new(); treadles];
    for (shaft, row) in (1..).zip(section.rows.iter().rev()) {
        if row.text.len() != treadles || shaft > LOOM_MAX {
            let expected = format!(
                "{LOOM_MAX} rows at most, each of {treadles} digits as the first, {LOOM_MAX} at most"
            );
            return Err(row.refused(dtx.file, &expected));
        }
        for (tied, digit) in tie_up.iter_mut().zip(row.digits(dtx.file)) {
            if digit? {
                tied.push(shaft);
            }
        }
    }
    Ok(Some(tie_up))
}

/// The treadles that each pick presses, each once. Words are picks, and the treadles of one pick
/// have commas between them, with space or without.
fn treadling(dtx: &Sections<'_>, treadles: u32) -> Result<Vec<Vec<u32>>, ReadError> {
    let mut treadling: Vec<Vec<u32>> = Vec::new();
    let mut goes_on = false;
    let rows = dtx.get("treadling").into_iter().flat_map(|section| &section.rows);
    for word in rows.flat_map(|row| row.words()) {
        if !(goes_on || word.text.starts_with(',')) || treadling.is_empty() {
            dtx.room_for_one(treadling.len(), word)?;
            treadling.push(Vec::new());
        }
        goes_on = word.text.ends_with(',');
        for part in word.parts() {
            let treadle = part.number(dtx.file, treadles, "a treadle")?;
            if let Some(pressed) = treadling.last_mut().filter(|_| treadle > 0) {
                pressed.push(treadle);
            }
        }
    }
    for pressed in &mut treadling {
        pressed.sort_unstable();
        pressed.dedup();
    }
    Ok(treadling)
}
