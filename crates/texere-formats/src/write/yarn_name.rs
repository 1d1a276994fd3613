//! The names of yarns in files.

use texere_core::Origin;

/// The name of a yarn by its origin. Names need not be unique. A yarn of unknown origin is named
/// after its number, counted from 1.
pub(super) fn yarn_name(number: usize, origin: Origin) -> String {
    match origin {
        Origin::Unknown => format!("yarn {}", number + 1),
        known => known.to_string(),
    }
}
