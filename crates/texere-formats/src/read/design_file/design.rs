//! The design of a design file.

use std::path::Path;

use texere_core::Section;
use texere_fabric::{Drawdown, Structure, Woven, WovenDesign};

use super::cloth::Cloth;
use super::schema::{self, DesignFile};
use super::source::Source;
use super::threads::YarnTable;
use super::{knit, limits, value, warp_knit, weave};
use crate::read::draft::DraftKind;
use crate::read::file::{Files, bytes_of, file_name};
use crate::read::threads::only_used;
use crate::read::{Design, ReadError};

/// Reads the design file in `path`.
pub(crate) fn read(path: &Path, files: &Files<'_>) -> Result<Design, ReadError> {
    let bytes = bytes_of(files, path, limits::FILE)?;
    let source = Source::new(path, &bytes, files)?;
    let keys = source.keys();
    let design = keys.placed(designed(&source))?;
    Ok(design.keyed(keys))
}

fn designed(source: &Source<'_>) -> Result<Design, ReadError> {
    let path = source.path;
    let file: DesignFile = value::parse(source)?;
    let (settle, finish) = file.finish.read(source, file.weave.is_some())?;
    let stretch = file.finish.stretch(source)?;
    let rests = settle != Some(false);
    let cloth = Cloth::new(source, &file.cloth, rests)?;
    let yarns = YarnTable::new(source, &file.yarns)?;
    let weave = match (&file.weave, &file.knit, &file.warp_knit) {
        (Some(weave), None, None) => weave,
        (None, Some(table), None) => {
            return Ok(knit::read(source, &file, table, &yarns)?.finished(settle, finish, stretch));
        }
        (None, None, Some(table)) => {
            return Ok(warp_knit::read(source, &file, table, &yarns)?.finished(settle, finish, stretch));
        }
        _ => {
            let keys = "[weave], [knit] and [warp_knit]";
            return Err(ReadError::ExactlyOne { file: path.into(), keys });
        }
    };
    let mut warnings = Vec::new();
    let drawdown = match (&weave.notation, &weave.drawdown, &weave.image, &weave.wif) {
        (Some(notation), None, None, None) => weave::from_notation(source, weave, notation)?,
        (None, Some(rows), None, None) => weave::from_rows(source, weave, rows)?,
        (None, None, Some(image), None) => weave::from_image(source, weave, image, &mut warnings)?,
        (None, None, None, Some(wif)) => {
            let design = from_wif(source, &file, weave, wif, &yarns, cloth)?;
            return Ok(design.remarking(unused(&file, rests)).finished(settle, finish, stretch));
        }
        _ => {
            let keys = "weave.notation, weave.drawdown, weave.image and weave.wif";
            return Err(ReadError::ExactlyOne { file: path.into(), keys });
        }
    };
    let mut woven = threaded(source, &file, &yarns, drawdown)?;
    cloth.apply(source, &mut woven)?;
    let name = file.name.clone().unwrap_or_else(|| file_name(path));
    let woven = WovenDesign::new(woven, None, cloth.relief).map_err(|error| source.fabric(error))?;
    let design = Design::new(name, Structure::Woven(woven), warnings);
    Ok(design.remarking(unused(&file, rests)).finished(settle, finish, stretch))
}

/// Remarks on keys of woven cloth that have no effect on cloth at rest.
fn unused(file: &DesignFile, rests: bool) -> Vec<String> {
    let keys =
        [("cloth.shape", file.cloth.shape.is_some()), ("cloth.warp_crimp", file.cloth.warp_crimp.is_some())];
    let given = keys.into_iter().filter(|(_, given)| *given && rests);
    let said = |key| format!("{key} counts for nothing in cloth at rest; with finish.settle = false it does");
    given.map(|(key, _)| said(key)).collect()
}

/// The cloth of a drawdown with the file's own threads.
fn threaded(
    source: &Source<'_>,
    file: &DesignFile,
    yarns: &YarnTable,
    drawdown: Drawdown,
) -> Result<Woven, ReadError> {
    let needed = |field: &str| ReadError::MissingKey {
        file: source.path.into(),
        field: field.into(),
        needed_for: "it says which yarns are woven, and how close",
    };
    let warp = file.warp.as_ref().ok_or_else(|| needed("warp"))?;
    let weft = file.weft.as_ref().ok_or_else(|| needed("weft"))?;
    let mut warp = yarns.threads(source, "warp", warp, drawdown.ends())?;
    let mut weft = yarns.threads(source, "weft", weft, drawdown.picks())?;
    let (materials, sections) = only_used([&mut warp, &mut weft], &yarns.materials, &yarns.sections);
    Woven::new(drawdown, warp, weft, materials, sections).map_err(|error| source.fabric(error))
}

fn from_wif(
    source: &Source<'_>,
    file: &DesignFile,
    weave: &schema::WeaveTable,
    wif: &toml::Spanned<String>,
    yarns: &YarnTable,
    cloth: Cloth,
) -> Result<Design, ReadError> {
    weave::without_image(source, weave)?;
    if weave.ends.is_some() || weave.picks.is_some() {
        return Err(ReadError::ExactlyOne {
            file: source.path.into(),
            keys: "weave.wif and weave.ends with weave.picks",
        });
    }
    let path = source.beside(wif);
    let kind = DraftKind::of(&path)
        .ok_or_else(|| source.bad("weave.wif", wif, &format!("the path of a {} file", DraftKind::ENDINGS)))?;
    let draft = kind.read(&path, source.files);
    let draft = draft.map_err(|error| error.named(source.place("weave.wif", wif.span())))?;
    let woven = &draft.woven;
    let drawdown = woven.drawdown().clone();
    // The draft's materials and sections come first, so that the numbers in the draft's threads
    // stay valid.
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
    let mut warp = set("warp", &file.warp, woven.warp(), drawdown.ends())?;
    let mut weft = set("weft", &file.weft, woven.weft(), drawdown.picks())?;
    let (materials, sections) = only_used([&mut warp, &mut weft], &materials, &sections);
    let fabric = |error| source.fabric(error);
    let mut woven = Woven::new(drawdown, warp, weft, materials, sections).map_err(fabric)?;
    cloth.apply(source, &mut woven)?;
    let name = file.name.clone().unwrap_or(draft.name);
    let woven = WovenDesign::new(woven, Some(draft.draft), cloth.relief).map_err(fabric)?;
    Ok(Design::new(name, Structure::Woven(woven), draft.warnings).keyed(draft.keys))
}
