//! texere's own design file, in TOML.
//!
//! ```toml
//! name = "Denim"
//!
//! [weave]                         # a notation with a size, or else wif = "draft.wif"
//! notation = "3/1"
//! ends = 120
//! picks = 80
//!
//! [yarns.indigo]
//! tex = 60.0                      # or diameter_mm
//! color = "#26406e"
//! section = { shape = "ellipse", aspect = 1.4 }
//! twist_per_m = 550.0             # turns per metre; Z is positive, S negative
//!
//! [yarns.ecru]
//! diameter_mm = 0.3
//! plies = 2
//!
//! [warp]
//! yarns = ["3 indigo", "ecru"]    # repeated over all ends
//! per_cm = 12.0                   # or spacing_mm
//!
//! [weft]
//! yarns = ["ecru"]
//! spacing_mm = 1.0
//! ```
//!
//! With `wif` the draft is read from a WIF file beside the design; `[warp]` and `[weft]` are then optional and stand in
//! for the file's own threads.

mod schema;
mod threads;

use std::path::Path;

use texere_core::Section;
use texere_fabric::{Weave, Woven};

use super::{Design, ReadError, bytes_of, file_name, wif};
use schema::{DesignFile, Source};
use threads::YarnTable;

pub(super) fn read(path: &Path) -> Result<Design, ReadError> {
    let bytes = bytes_of(path)?;
    let source = Source::new(path, &bytes)?;
    let file: DesignFile = source.parse()?;
    let yarns = YarnTable::new(&source, &file.yarns)?;
    match (&file.weave.notation, &file.weave.wif) {
        (Some(notation), None) => from_notation(&source, &file, notation.as_ref(), &yarns),
        (None, Some(wif)) => from_wif(&source, &file, wif, &yarns),
        _ => Err(ReadError::ExactlyOne { file: path.into(), keys: "weave.notation and weave.wif" }),
    }
}

fn from_notation(
    source: &Source<'_>,
    file: &DesignFile,
    notation: &str,
    yarns: &YarnTable,
) -> Result<Design, ReadError> {
    let fabric = |error| source.fabric(error);
    let needed = |field: &str, needed_for| ReadError::MissingKey {
        file: source.path.into(),
        field: field.into(),
        needed_for,
    };
    let for_notation = "a notation needs a size";
    let ends = file.weave.ends.as_ref().ok_or_else(|| needed("weave.ends", for_notation))?;
    let picks = file.weave.picks.as_ref().ok_or_else(|| needed("weave.picks", for_notation))?;
    let (ends, picks) = (source.count("weave.ends", ends)?, source.count("weave.picks", picks)?);
    let drawdown = Weave::parse(notation).and_then(|weave| weave.drawdown(ends, picks)).map_err(fabric)?;

    let for_threads = "it says which yarns are woven, and how close";
    let warp = file.warp.as_ref().ok_or_else(|| needed("warp", for_threads))?;
    let weft = file.weft.as_ref().ok_or_else(|| needed("weft", for_threads))?;
    let warp = yarns.threads(source, "warp", warp, ends)?;
    let weft = yarns.threads(source, "weft", weft, picks)?;
    let woven =
        Woven::new(drawdown, warp, weft, yarns.materials.clone(), yarns.sections.clone()).map_err(fabric)?;
    let name = file.name.clone().unwrap_or_else(|| file_name(source.path));
    Ok(Design::woven(name, woven, Vec::new()))
}

fn from_wif(
    source: &Source<'_>,
    file: &DesignFile,
    wif: &toml::Spanned<String>,
    yarns: &YarnTable,
) -> Result<Design, ReadError> {
    if file.weave.ends.is_some() || file.weave.picks.is_some() {
        return Err(ReadError::ExactlyOne {
            file: source.path.into(),
            keys: "weave.wif and weave.ends with weave.picks",
        });
    }
    let draft = source.path.parent().unwrap_or(Path::new("")).join(wif.as_ref());
    if !draft.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("wif")) {
        let (place, value) = (source.place("weave.wif", wif.span()), wif.as_ref().clone());
        return Err(ReadError::BadValue { place, value, expected: "the path of a .wif file".into() });
    }
    let draft = wif::read(&draft)?;
    let woven = &draft.woven;
    let drawdown = woven.drawdown().clone();
    // The draft's own materials and sections come first, so that its threads keep their numbers.
    let materials: Vec<_> = woven.materials().iter().chain(&yarns.materials).cloned().collect();
    let sections: Vec<Section> = woven.sections().iter().chain(&yarns.sections).cloned().collect();
    let shift = (woven.materials().len() as u32, woven.sections().len() as u32);
    let set = |name, spec: &Option<schema::ThreadSet>, own: &[texere_fabric::Thread], count| match spec {
        None => Ok(own.to_vec()),
        Some(spec) => yarns.threads(source, name, spec, count).map(|mut threads| {
            for thread in &mut threads {
                thread.material += shift.0;
                thread.section += shift.1;
            }
            threads
        }),
    };
    let warp = set("warp", &file.warp, woven.warp(), drawdown.ends())?;
    let weft = set("weft", &file.weft, woven.weft(), drawdown.picks())?;
    let woven =
        Woven::new(drawdown, warp, weft, materials, sections).map_err(|error| source.fabric(error))?;
    Ok(Design::woven(file.name.clone().unwrap_or(draft.name), woven, draft.warnings))
}
