//! The kinds of structures.

use texere_fabric::Structure;

/// The kind of a structure, as errors name what a format can't hold.
pub(super) fn kind(structure: &Structure) -> &'static str {
    match structure {
        Structure::Woven(_) => "woven cloth",
        Structure::Weft(_) => "a weft knit",
        Structure::Warp(_) => "a warp knit",
        Structure::Yarns(_) => "yarns that no structure made",
        _ => "a structure of this kind",
    }
}
