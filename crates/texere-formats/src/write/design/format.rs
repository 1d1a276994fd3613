//! The names of formats in errors.

/// texere's own design file.
#[cfg(feature = "toml")]
pub(super) const DESIGN_FILE: &str = "a design file";

/// A program of a knitting machine.
#[cfg(feature = "knitout")]
pub(super) const KNITOUT_FILE: &str = "a knitout file";

/// A WIF draft.
#[cfg(feature = "wif")]
pub(super) const WIF_DRAFT: &str = "a WIF draft";
