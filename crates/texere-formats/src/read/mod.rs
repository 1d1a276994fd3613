//! Readers: from a design file to a [`Design`].

mod design_file;
mod error;
mod file;
mod point_paper;
mod wif;

use std::collections::HashMap;
use std::path::{self, Path, PathBuf};

use texere_core::{Material, Section, Yarns};
use texere_fabric::{Draft, FabricError, Jam, JamReport, Thread, Woven};

pub use error::{Place, ReadError};

/// The structure that a design describes.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub enum Structure {
    /// Woven cloth.
    Woven(Woven),
}

/// A design, read and checked.
///
/// ```no_run
/// let design = texere_formats::read("designs/herringbone.wif")?;
/// println!("{}: {} yarns", design.name, design.yarns()?.layout().yarns().len());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Design {
    /// Its title, or else the name of its file.
    pub name: String,
    /// What it describes.
    pub structure: Structure,
    /// The shaft draft that the cloth is woven by, where the design has one: its drawdown is the structure's.
    pub draft: Option<Draft>,
    /// What was found of jammed threads, and what was done about them: the structure is what came of it.
    pub jam: JamReport,
    /// What the reader had to assume or leave out.
    remarks: Vec<String>,
    files: Vec<PathBuf>,
    relief: Jam,
    /// The cloth as it was designed, where relief has changed it.
    designed: Option<Woven>,
}

impl Design {
    /// A woven design, its jammed threads relieved as `relief` says.
    fn woven(
        name: String,
        mut woven: Woven,
        draft: Option<Draft>,
        relief: Jam,
        remarks: Vec<String>,
    ) -> Result<Self, FabricError> {
        let (jam, designed) = relieve(&mut woven, relief)?;
        Ok(Self {
            name,
            structure: Structure::Woven(woven),
            draft,
            jam,
            remarks,
            files: Vec::new(),
            relief,
            designed,
        })
    }

    /// Notes a file that it was read from.
    fn noting(mut self, file: &Path) -> Self {
        // A program may change its folder; what can't be told of a path then is left as it is.
        self.files.push(path::absolute(file).unwrap_or_else(|_| file.into()));
        self
    }

    /// The files that it was read from: the design's own, and the image or WIF draft that it names.
    /// [`Output::sparing`](crate::write::Output::sparing) keeps a writer from replacing them.
    #[must_use]
    pub fn files(&self) -> &[PathBuf] {
        &self.files
    }

    /// What a person should know: what the reader had to assume or leave out, and what the cloth lacks.
    #[must_use]
    pub fn warnings(&self) -> Vec<String> {
        let Structure::Woven(woven) = &self.structure;
        self.remarks.iter().cloned().chain(woven.warnings().iter().map(ToString::to_string)).collect()
    }

    /// The yarns of the fabric.
    ///
    /// **Errors**: [`FabricError`] where the structure can't be made.
    pub fn yarns(&self) -> Result<Yarns, FabricError> {
        match &self.structure {
            Structure::Woven(woven) => woven.yarns(),
        }
    }

    /// Gives every yarn the same section. Where the design says what to do about jammed threads, that is done anew.
    ///
    /// **Errors**: [`FabricError`] where the section is not sound, or threads can't be thinned so far; the design is then
    /// as it was.
    pub fn set_section(&mut self, section: Section) -> Result<(), FabricError> {
        let Structure::Woven(woven) = &self.structure;
        let mut changed = self.designed.as_ref().unwrap_or(woven).clone();
        changed.set_section(section)?;
        (self.jam, self.designed) = relieve(&mut changed, self.relief)?;
        self.structure = Structure::Woven(changed);
        Ok(())
    }
}

/// Relieves jammed threads: what was found and done, and the cloth as it was before, where it was changed.
fn relieve(woven: &mut Woven, relief: Jam) -> Result<(JamReport, Option<Woven>), FabricError> {
    if relief == Jam::Report {
        return Ok((woven.relieve(relief)?, None));
    }
    let designed = woven.clone();
    let report = woven.relieve(relief)?;
    let changed = designed != *woven;
    Ok((report, changed.then_some(designed)))
}

/// Reads the design in `path`: a WIF draft (`.wif`) or texere's own design file (`.toml`).
///
/// **Errors**: [`ReadError`], which names file, line, field, value and limit as far as they apply.
pub fn read(path: impl AsRef<Path>) -> Result<Design, ReadError> {
    let path = path.as_ref();
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
    match ending.as_deref() {
        Some("wif") => {
            let wif = wif::read(path)?;
            Design::woven(wif.name, wif.woven, Some(wif.draft), Jam::Report, wif.warnings)
                .map_err(|source| ReadError::fabric(path, source))
        }
        Some("toml") => design_file::read(path),
        _ => Err(ReadError::UnknownKind { file: path.into(), known: ".wif, .toml" }),
    }
    .map(|design| design.noting(path))
}

/// The materials and sections that `threads` have, in their order and each section once, and the threads with their
/// numbers. What nobody wears costs a cloth nothing.
fn only_used(
    threads: [&mut [Thread]; 2],
    materials: &[Material],
    sections: &[Section],
) -> (Vec<Material>, Vec<Section>) {
    let [mut worn, mut shaped] = [materials.len(), sections.len()].map(|count| vec![false; count]);
    for thread in threads.iter().flat_map(|set| set.iter()) {
        worn[thread.material as usize] = true;
        shaped[thread.section as usize] = true;
    }
    let (mut kept, mut material) = (Vec::new(), vec![0; materials.len()]);
    for (number, _) in worn.iter().enumerate().filter(|(_, worn)| **worn) {
        material[number] = kept.len() as u32;
        kept.push(materials[number].clone());
    }
    let (mut unlike, mut section) = (Vec::new(), vec![0; sections.len()]);
    let mut numbers = HashMap::new();
    for (number, _) in shaped.iter().enumerate().filter(|(_, shaped)| **shaped) {
        section[number] = *numbers.entry(format!("{:?}", sections[number])).or_insert_with(|| {
            unlike.push(sections[number].clone());
            unlike.len() as u32 - 1
        });
    }
    for thread in threads.into_iter().flatten() {
        thread.material = material[thread.material as usize];
        thread.section = section[thread.section as usize];
    }
    (kept, unlike)
}

/// `count` values, each `value`, where there is memory for them.
fn filled<T: Clone>(what: &'static str, count: usize, value: T) -> Result<Vec<T>, ReadError> {
    let mut values = room(what, count)?;
    values.resize(count, value);
    Ok(values)
}

/// Room for `count` values, where there is memory for them.
fn room<T>(what: &'static str, count: usize) -> Result<Vec<T>, ReadError> {
    let mut values = Vec::new();
    let bytes = (count as u64).saturating_mul(size_of::<T>() as u64);
    values.try_reserve_exact(count).map_err(|_| ReadError::OutOfMemory { what, bytes })?;
    Ok(values)
}

/// The name of a design that has no title.
fn file_name(path: &Path) -> String {
    path.file_stem().map_or_else(|| "design".into(), |stem| stem.to_string_lossy().into_owned())
}
