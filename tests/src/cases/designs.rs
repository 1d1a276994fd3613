//! The designs of `designs/`, each cut to a few threads.

use std::path::{Path, PathBuf};

use texere_core::{Settings, Yarns};
use texere_fabric::{Drawdown, Thread, Woven};
use texere_formats::{Design, read};

use super::{Case, USUAL};

/// The most ends, and the most picks, of a cut cloth, and the most yarns of a cut knit.
const THREADS: usize = 20;

/// The most control points of a yarn in a cut knit.
const POINTS: usize = 240;

/// `designs/` of this workspace. A suite that runs on another machine than the one that built it
/// uses `designs/` in the working folder.
fn folder() -> PathBuf {
    let ours = Path::new(env!("CARGO_MANIFEST_DIR")).join("../designs");
    if ours.is_dir() { ours } else { PathBuf::from("designs") }
}

/// The design in `path` within `designs/`.
///
/// # Panics
///
/// If it can't be read.
#[must_use]
pub fn design(path: impl AsRef<Path>) -> Design {
    read(folder().join(path)).unwrap()
}

/// The yarns of every design, cut to a few threads, each with the design's name.
pub fn small_designs() -> impl Iterator<Item = (String, Yarns)> {
    paths().into_iter().map(|path| (name_of(&path), small(&design(path))))
}

/// All designs, by their paths in `designs/`.
fn paths() -> Vec<PathBuf> {
    let mut paths = Vec::new();
    gather(&folder(), Path::new(""), &mut paths);
    paths.sort();
    // If no design is found, the suite has to fail. A case with a missing design fails.
    if paths.is_empty() { vec!["missing.toml".into()] } else { paths }
}

fn name_of(path: &Path) -> String {
    path.with_extension("").to_string_lossy().replace(['/', '\\'], "-")
}

/// Every design with caps in both frames, and as in the paper: upright and without caps.
pub(super) fn each_design() -> Vec<Case> {
    paths()
        .into_iter()
        .flat_map(|path: PathBuf| {
            let name = name_of(&path);
            let (capped, bare) = (path.clone(), path);
            let mut cases =
                Case::framed(format!("design-{name}"), USUAL, move || small(&design(&capped))).to_vec();
            let build = move || small(&design(&bare));
            cases.push(Case::new(format!("design-{name}-bare::upright"), Settings::default(), build));
            cases
        })
        .collect()
}

/// Collects all designs in `within` and the folders in it, by their paths in `root`.
fn gather(root: &Path, within: &Path, paths: &mut Vec<PathBuf>) {
    let entries = std::fs::read_dir(root.join(within)).into_iter().flatten().flatten();
    for path in entries.map(|entry| within.join(entry.file_name())) {
        if root.join(&path).is_dir() {
            gather(root, &path, paths);
        } else if path.extension().is_some_and(|ending| ending == "toml" || ending == "wif") {
            paths.push(path);
        }
    }
}

/// The yarns of a design, cut to a few threads.
fn small(design: &Design) -> Yarns {
    match design.structure.woven() {
        Some(woven) => middle(woven.cloth()).yarns().unwrap(),
        None => few(&design.yarns().unwrap()),
    }
}

/// The beginnings of yarns from the middle of a knit.
fn few(yarns: &Yarns) -> Yarns {
    let layout = yarns.layout();
    let count = layout.yarns().len().min(THREADS);
    let first = (layout.yarns().len() - count) / 2;
    let mut few = Yarns::builder();
    for material in yarns.materials().iter() {
        few.material(material.clone());
    }
    for section in layout.sections() {
        few.section(section.clone());
    }
    for (number, yarn) in layout.yarns().iter().enumerate().skip(first).take(count) {
        let points = yarns.yarn_points(number).unwrap();
        few.yarn(*yarn, &points[..points.len().min(POINTS)]);
    }
    few.build().unwrap()
}

/// A piece from the middle of a cloth, where a figured cloth has its figure.
fn middle(cloth: &Woven) -> Woven {
    let whole = cloth.drawdown();
    let (ends, picks) = (whole.ends().min(THREADS), whole.picks().min(THREADS));
    let (first_end, first_pick) = ((whole.ends() - ends) / 2, (whole.picks() - picks) / 2);
    let drawdown =
        Drawdown::from_fn(ends, picks, |end, pick| whole.up(first_end + end, first_pick + pick)).unwrap();
    let cut = |threads: &[Thread], first: usize, count: usize| threads[first..first + count].to_vec();
    let (warp, weft) = (cut(cloth.warp(), first_end, ends), cut(cloth.weft(), first_pick, picks));
    let mut piece =
        Woven::new(drawdown, warp, weft, cloth.materials().to_vec(), cloth.sections().to_vec()).unwrap();
    piece.set_shape(cloth.shape());
    piece.set_crimp(cloth.crimp()).unwrap();
    piece.set_selvedge(cloth.selvedge());
    piece
}
