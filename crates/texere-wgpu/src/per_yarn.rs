//! The schedule per-yarn: what it does not do, and its table.

use texere_core::{BackendError, Block, Frame, Plan};

/// Refuses what the paper's algorithms don't do.
///
/// **Errors**: [`BackendError::Unsupported`], which names it.
pub(crate) fn check(plan: &Plan, schedule: &str) -> Result<(), BackendError> {
    let unsupported = |what: String| Err(BackendError::Unsupported { schedule: schedule.into(), what });
    if plan.settings().frame != Frame::Upright {
        return unsupported("rotation minimising frames".into());
    }
    if plan.settings().caps {
        return unsupported("caps".into());
    }
    for (number, yarn) in plan.layout().yarns().iter().enumerate() {
        if yarn.closed {
            return unsupported(format!("closed yarns, such as yarn {number}"));
        }
        if yarn.twist != 0.0 {
            return unsupported(format!("twist, such as that of yarn {number}"));
        }
    }
    Ok(())
}

/// One row a part: consecutive blocks of a yarn as a single one, of more rings than a block may have elsewhere.
pub(crate) fn part_rows(blocks: &[Block]) -> Vec<Block> {
    let mut parts: Vec<Block> = Vec::new();
    for block in blocks {
        match parts.last_mut() {
            Some(part) if part.yarn == block.yarn => {
                part.rings += block.rings;
                part.quads += block.quads;
            }
            _ => parts.push(*block),
        }
    }
    parts
}
