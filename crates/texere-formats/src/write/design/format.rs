//! The names of formats in errors.

/// texere's own design file.
#[cfg(feature = "toml")]
pub(super) const DESIGN_FILE: &str = "a design file";

/// A WIF draft.
pub(super) const WIF_DRAFT: &str = "a WIF draft";
