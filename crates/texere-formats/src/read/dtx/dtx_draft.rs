//! A draft of Fiberworks PCW.

use std::path::Path;

use super::plans::plans;
use super::sections::Sections;
use super::threads::threads;
use crate::read::ReadError;
use crate::read::draft::{LoomDraft, THREADS_MAX, decode};
use crate::read::file::file_name;
use crate::read::keys::Keys;

/// Reads the bytes of a Fiberworks file.
pub(crate) fn draft(path: &Path, bytes: &[u8]) -> Result<LoomDraft, ReadError> {
    let text = decode(bytes);
    let dtx = Sections::parse(path, &text)?;
    let keys = keys(&dtx)?;
    let draft = keys.placed(drafted(&dtx))?;
    Ok(LoomDraft { keys, ..draft })
}

fn drafted(dtx: &Sections<'_>) -> Result<LoomDraft, ReadError> {
    let path = dtx.file;
    let mut warnings = Vec::new();
    let counts = [thread_count(dtx, "ends")?, thread_count(dtx, "picks")?];
    let (draft, drawdown) = plans(dtx, counts, &mut warnings)?.draft(path, &mut warnings)?;
    let woven = threads(dtx, counts)?.woven(path, drawdown, &mut warnings)?;
    let title = dtx.get("description").map(|section| section.rows[0].text.to_owned());
    let name = title.unwrap_or_else(|| file_name(path));
    Ok(LoomDraft { name, woven, draft, warnings, keys: Keys::default() })
}

fn thread_count(dtx: &Sections<'_>, key: &str) -> Result<u32, ReadError> {
    let count = dtx.info(key, THREADS_MAX)?.filter(|(count, _)| *count > 0);
    count.map(|(count, _)| count).ok_or_else(|| ReadError::MissingKey {
        file: dtx.file.into(),
        field: format!("@@Info %%{key}"),
        needed_for: "it says how many threads there are",
    })
}

/// The keys that errors of the cloth name, with their lines.
fn keys(dtx: &Sections<'_>) -> Result<Keys, ReadError> {
    let mut lines = Vec::new();
    for key in ["ends", "picks"] {
        let line = dtx.info(key, THREADS_MAX)?.map(|(_, line)| (format!("@@Info %%{key}"), line));
        lines.extend(line);
    }
    for (name, section) in [("@@Tieup", "tieup"), ("@@Liftplan", "liftplan")] {
        lines.extend(dtx.line(section).map(|line| (name.into(), line)));
    }
    Ok(Keys { file: dtx.file.into(), lines, ..Keys::default() })
}
