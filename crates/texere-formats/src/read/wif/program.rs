//! Recognises drafts that texere has written.

use super::ini::Ini;

/// The program that texere's own drafts name as their source. The thicknesses in these drafts are
/// diameters of yarns, however close threads lie.
pub(crate) const PROGRAM: &str = "texere";

/// Whether texere has written the draft.
pub(super) fn is_ours(ini: &Ini<'_>) -> bool {
    ini.get("wif", "source program").is_some_and(|program| program.value == PROGRAM)
}
