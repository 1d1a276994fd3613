//! Readers. They turn a design file into a [`Design`], and a file of saved yarns into [the
//! yarns](fn@yarns).

mod bytes;
mod curve_scale;
mod curves;
mod design;
#[cfg(feature = "toml")]
mod design_file;
#[cfg(feature = "wif")]
mod draft;
#[cfg(feature = "wif")]
mod dtx;
mod error;
mod fault_place;
mod file;
#[cfg(feature = "toml")]
mod image_file;
mod keys;
mod knit;
#[cfg(feature = "knitout")]
mod knitout;
mod knitted_from;
mod machine_fault;
mod named_place;
#[cfg(feature = "toml")]
mod point_paper;
mod polylines;
mod program_place;
mod refusal;
mod spline;
#[cfg(feature = "texgen")]
mod texgen;
mod threads;
mod usd;
#[cfg(feature = "wif")]
mod wif;
#[cfg(feature = "wif")]
mod wpo;
mod yarns;

use std::cell::{Cell, RefCell};
use std::io;
use std::path::Path;

pub use curve_scale::CurveScale;
pub use curves::{curves, curves_from};
pub use design::Design;
pub use error::{FilePlace, ReadError};
pub use fault_place::{FaultPlace, fault_place};
use file::Files;
pub use machine_fault::MachineFault;
pub use named_place::NamedPlace;
pub use program_place::ProgramPlace;
pub use refusal::Refusal;
pub use texere_fabric::Structure;
pub use yarns::{SavedYarns, yarns, yarns_from};

use crate::yarns_file::ENDING;

#[cfg(feature = "toml")]
pub(crate) use design_file::{OUT as GUIDE_WITHOUT_YARN, limits};
#[cfg(feature = "wif")]
pub(crate) use draft::{FILE_MAX as WIF_BYTES_MAX, LENGTH_MM as WIF_LENGTH_MM};
#[cfg(feature = "knitout")]
pub(crate) use file::file_name;
#[cfg(feature = "knitout")]
pub(crate) use knitout::{
    FILE_MAX as KNITOUT_BYTES_MAX, GAUGE as KNITOUT_PER_INCH, gauge as knitout_gauge, is_swg,
    kept as knitout_text, of_carriers as knitout_yarns,
};
#[cfg(feature = "toml")]
pub(crate) use knitted_from::Legend;
#[cfg(any(feature = "knitout", feature = "toml"))]
pub(crate) use knitted_from::{Drawn, KnittedFrom};
#[cfg(feature = "knitout")]
pub(crate) use knitted_from::{ProgramHead, StitchSize};
#[cfg(feature = "wif")]
pub(crate) use wif::{PROGRAM as WIF_PROGRAM, UNITS_MM as WIF_UNITS_MM};

/// Reads the design in `path`: a draft of a weaving program (WIF, `.wif` or `.wifw`; Fiberworks
/// PCW, `.dtx`; WeavePoint, `.wpo`; feature `wif`), a program of a knitting machine (knitout, `.k`
/// or `.knitout`, feature `knitout`), or texere's own design file (`.toml`, feature `toml`).
///
/// **Errors**: [`ReadError`]. It names file, line, field, value and limit as far as they apply. A
/// kind of file that this build was made without is [`ReadError::Feature`].
pub fn read(path: impl AsRef<Path>) -> Result<Design, ReadError> {
    let opened = RefCell::new(Vec::new());
    let design = by_ending(path.as_ref(), &|path, limit| {
        let file = file::open(path, limit)?;
        opened.borrow_mut().push(path.to_owned());
        Ok(file)
    })?;
    Ok(design.read_from(&opened.into_inner()))
}

/// Reads a design that a program has in memory, such as a buffer of an editor or a row of a
/// database. The ending of `name` says what kind of design `bytes` are. Errors call the design by
/// `name`.
///
/// `files` gives the bytes of a file that the design names: a picture, a draft or a knitting
/// program. Its argument is the path of that file beside `name`. For example, if `looms/cloth.toml`
/// names `twill.wif`, the argument is `looms/twill.wif`. No file on a disk is opened.
///
/// **Errors**: the errors of [`read`]. A refusal by `files` is [`ReadError::Io`] with the path,
/// within [`ReadError::Named`]. Bytes beyond the limit for files of their kind are
/// [`ReadError::TooLarge`].
///
/// ```
/// use std::io::{Error, ErrorKind};
/// use std::path::Path;
/// let cloth = "weave.wif = \"twill.wif\"\nyarns.white.diameter_mm = 0.3\n";
/// let twill = "[WARP]\nThreads=4\n[WEFT]\nThreads=4\n[THREADING]\n1=1\n2=2\n3=3\n4=4\n\
///              [LIFTPLAN]\n1=1,2\n2=2,3\n3=3,4\n4=4,1\n";
/// let design = texere_formats::read_from("looms/cloth.toml", cloth, |path| match path {
///     path if path == Path::new("looms/twill.wif") => Ok(twill.into()),
///     _ => Err(Error::from(ErrorKind::NotFound)),
/// })?;
/// assert_eq!(design.yarns()?.layout().yarns().len(), 8);
/// // A design that names no other file.
/// let draft = texere_formats::read_from("twill.wif", twill, |_| Err(ErrorKind::NotFound.into()))?;
/// assert_eq!(draft.name, "twill");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn read_from(
    name: impl AsRef<Path>,
    bytes: impl Into<Vec<u8>>,
    files: impl FnMut(&Path) -> io::Result<Vec<u8>>,
) -> Result<Design, ReadError> {
    let (own, files) = (Cell::new(Some(bytes.into())), RefCell::new(files));
    by_ending(name.as_ref(), &|path, limit| {
        let refused = |source| ReadError::Io { file: path.into(), source };
        let bytes = own.take().map_or_else(|| (files.borrow_mut())(path).map_err(refused), Ok)?;
        file::held(path, bytes, limit)
    })
}

/// The design in `path`, which `files` opens. The path's ending decides which reader reads the
/// file.
fn by_ending(path: &Path, files: &Files<'_>) -> Result<Design, ReadError> {
    #[cfg(feature = "wif")]
    if let Some(kind) = draft::DraftKind::of(path) {
        return kind.design(path, files);
    }
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
    match ending.as_deref() {
        #[cfg(not(feature = "wif"))]
        Some("wif" | "wifw" | "dtx" | "wpo") => {
            Err(ReadError::Feature { file: path.into(), what: "drafts of looms", feature: "wif" })
        }
        #[cfg(feature = "toml")]
        Some("toml") => design_file::read(path, files),
        #[cfg(not(feature = "toml"))]
        Some("toml") => Err(ReadError::Feature { file: path.into(), what: "design files", feature: "toml" }),
        #[cfg(feature = "knitout")]
        Some("k" | "knitout") => knitout::design(path, files),
        #[cfg(not(feature = "knitout"))]
        Some("k" | "knitout") => {
            Err(ReadError::Feature { file: path.into(), what: "knitout files", feature: "knitout" })
        }
        Some(ENDING) => Err(ReadError::WithoutDesign { file: path.into() }),
        _ => {
            let known = ".dtx, .wpo, .wifw, .wif, .toml, .k, .knitout";
            Err(ReadError::UnknownKind { file: path.into(), known })
        }
    }
}
