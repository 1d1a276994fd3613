//! Writers of designs: WIF drafts, knitout files, and texere's own design file.

#[cfg(feature = "wif")]
mod cloth;
#[cfg(any(feature = "knitout", feature = "toml"))]
mod finish;
mod format;
#[cfg(feature = "wif")]
mod interlacing;
mod kind;
#[cfg(feature = "knitout")]
mod knitout;
#[cfg(any(feature = "knitout", feature = "toml"))]
mod knitted;
mod text;
#[cfg(feature = "toml")]
mod toml;
#[cfg(feature = "toml")]
mod toml_knit;
#[cfg(feature = "toml")]
mod toml_text;
#[cfg(feature = "toml")]
mod toml_warp;
#[cfg(feature = "toml")]
mod toml_weft;
#[cfg(feature = "toml")]
mod toml_woven;
#[cfg(feature = "wif")]
mod wif;
#[cfg(feature = "wif")]
mod wif_threads;
#[cfg(feature = "wif")]
mod woven;
#[cfg(feature = "toml")]
mod yarns;

use std::io::Write;

#[cfg(feature = "knitout")]
use self::knitout::KnitoutFile;
#[cfg(feature = "toml")]
use self::toml::TomlFile;
#[cfg(feature = "wif")]
use self::wif::WifFile;
use super::target::Target;
use super::{Output, WriteError};
use crate::Design;

/// Writes a woven design as a WIF 1.1 draft. Returns the parts that the file leaves out, each by
/// its key in a design file or in words.
///
/// The draft is the design's own, if it weaves the cloth. If not, the draft has one shaft for each
/// kind of end, and a tie-up if at most a hundred shafts and a hundred treadles are needed, else a
/// lift plan. The spacings and thicknesses of each set are written in the unit that holds most of
/// them to the bit. Among such units the one with the fewest digits is taken. A length that the
/// unit does not hold to the bit is read again with a difference in the sixteenth digit. Colours
/// are read again exactly. Jammed threads that were relieved are written as relieved.
///
/// **Errors**: [`WriteError::NotEnding`] if `output` does not end in `.wif`, [`WriteError::Unheld`]
/// for a knit, [`WriteError::OutOfRange`] for lengths, shafts and treadles beyond the limits of the
/// reader, [`WriteError::TextTooLarge`] beyond 256 MiB, [`WriteError::Spared`], [`WriteError::Io`].
///
/// ```
/// use texere_formats::{read, write};
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("poplin.toml");
/// # std::fs::write(&path, "weave = { notation = \"plain\", ends = 6, picks = 6 }\nyarns.white.diameter_mm = 0.143\n\
/// #     warp = { yarns = [\"white\"], spacing_mm = 0.19 }\nweft = { yarns = [\"white\"], spacing_mm = 0.35 }\n")?;
/// let design = read(&path)?;
/// let left_out = write::wif(&design, folder.path().join("poplin.wif"))?;
/// assert!(left_out.iter().any(|what| what.contains("finish.settle")));
/// let draft = read(folder.path().join("poplin.wif"))?;
/// let [written, given] = [&draft, &design].map(|design| design.structure.woven().unwrap().cloth());
/// assert_eq!(written.drawdown(), given.drawdown());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[cfg(feature = "wif")]
pub fn wif(design: &Design, output: impl Into<Output>) -> Result<Vec<String>, WriteError> {
    let output = output.into().ending("wif")?;
    let file = WifFile::new(design)?;
    file.write(Target::create(output)?)?.commit()?;
    Ok(file.left_out)
}

/// Writes a woven design to `out` as a WIF 1.1 draft: the bytes that [`wif`](fn@wif) writes to a
/// file.
///
/// **Errors**: the errors of [`wif`](fn@wif), and [`WriteError::Writer`] if `out` refuses bytes.
#[cfg(feature = "wif")]
pub fn wif_to(design: &Design, out: impl Write) -> Result<Vec<String>, WriteError> {
    let file = WifFile::new(design)?;
    file.write(Target::straight(out))?.done()?;
    Ok(file.left_out)
}

/// Writes a design as texere's own design file, which needs no other file beside it. Returns the
/// parts that the file leaves out, each by its key or its name.
///
/// Reading the file gives an equal design, apart from the parts that are left out. For woven cloth,
/// the file holds the drawdown, the threads with sizes, spacings, colours, sections and twist, the
/// shape of the cloth, and its finish. The weaver's draft is left out; WIF files hold it. A weft
/// knit that came from a chart or a picture is written with a chart, which has letters for yarns if
/// the picture is a Jacquard. A warp knit is written with its guide bars. The yarns of a knit are
/// as thick as the key `compression` has made them. If yarns share a name, a number follows the
/// name of each but the first.
///
/// **Errors**: [`WriteError::NotEnding`] if `output` does not end in `.toml`,
/// [`WriteError::Unheld`] for a weft knit that came from neither a chart nor a picture, for a
/// Jacquard bar, and for a section that design files can't hold, [`WriteError::OutOfRange`] for a
/// value that no design file may have, [`WriteError::TextTooLarge`] beyond 16 MiB,
/// [`WriteError::Spared`], [`WriteError::Io`]. Each crossing of the drawdown's repeat, or each cell
/// of the chart, takes a byte of the 16 MiB.
///
/// ```
/// use texere_core::{Material, Section};
/// use texere_fabric::{Relief, Structure, Thread, Weave, Woven, WovenDesign};
/// use texere_formats::{Design, read, write};
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("denim.toml");
/// let twill = Weave::parse("3/1")?.drawdown(24, 16)?;
/// let (warp, weft) = (vec![Thread::new(0.4, 0.15); 24], vec![Thread::new(0.6, 0.15); 16]);
/// let cloth = Woven::new(twill, warp, weft, vec![Material::default()], vec![Section::Circle])?;
/// let design = Design::of("Denim", Structure::Woven(WovenDesign::new(cloth.clone(), None, Relief::Report)?));
/// assert!(write::toml(&design, &path)?.is_empty());
/// assert_eq!(read(&path)?.structure.woven().unwrap().cloth(), &cloth);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[cfg(feature = "toml")]
pub fn toml(design: &Design, output: impl Into<Output>) -> Result<Vec<String>, WriteError> {
    let output = output.into().ending("toml")?;
    let file = TomlFile::new(design)?;
    file.write(Target::create(output)?)?.commit()?;
    Ok(file.left_out)
}

/// Writes a design to `out` as texere's own design file: the bytes that [`toml`](fn@toml)
/// writes to a file.
///
/// **Errors**: the errors of [`toml`](fn@toml), and [`WriteError::Writer`] if `out` refuses bytes.
#[cfg(feature = "toml")]
pub fn toml_to(design: &Design, out: impl Write) -> Result<Vec<String>, WriteError> {
    let file = TomlFile::new(design)?;
    file.write(Target::straight(out))?.done()?;
    Ok(file.left_out)
}

/// Writes a weft knit as a program of a knitting machine, knitout 2. Returns the parts that the
/// file leaves out, each by its key in a design file or in words.
///
/// The knit must have come from a knitout file. Reading the written file gives the same operations
/// on the same needles, with the same racks, carriers and stitch sizes, and so the same stitches.
/// The number of needles to the inch and the names of yarns are in its header. Lines of the file
/// have other numbers than those of the file that the knit came from, because comments and
/// operations that do nothing are not kept.
///
/// **Errors**: [`WriteError::NotEnding`] if `output` ends in neither `.k` nor `.knitout`,
/// [`WriteError::Unheld`] for woven cloth, for a warp knit, and for a weft knit that came from a
/// chart or a picture: it is a repeat that goes on beyond its edges, and no machine can begin it.
/// [`WriteError::TextTooLarge`] beyond 256 MiB, [`WriteError::Spared`], [`WriteError::Io`].
///
/// ```
/// use std::io::ErrorKind;
/// use texere_formats::{read_from, write};
/// let jersey = ";!knitout-2\n;;Carriers: 1 2\n;;Gauge: 12\n;;Yarn-2: red wool\nin 2\ntuck - f2 2\ntuck - f1 2\n\
///               x-stitch-number 60\nknit + f1 2\nknit + f2 2\nout 2\ndrop f1\ndrop f2\n";
/// let none = |_: &std::path::Path| Err(ErrorKind::NotFound.into());
/// let mut written = Vec::new();
/// let left_out = write::knitout_to(&read_from("jersey.k", jersey, none)?, &mut written)?;
/// assert!(left_out.is_empty());
/// let again = read_from("jersey.k", written, none)?;
/// assert_eq!(again.structure.knitted().unwrap().stitches().loops.len(), 4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[cfg(feature = "knitout")]
pub fn knitout(design: &Design, output: impl Into<Output>) -> Result<Vec<String>, WriteError> {
    let output = output.into();
    let output = output.clone().ending("knitout").or_else(|_| output.ending("k"))?;
    let file = KnitoutFile::new(design)?;
    file.write(Target::create(output)?)?.commit()?;
    Ok(file.left_out)
}

/// Writes a weft knit to `out` as a program of a knitting machine: the bytes that
/// [`knitout`](fn@knitout) writes to a file.
///
/// **Errors**: the errors of [`knitout`](fn@knitout), and [`WriteError::Writer`] if `out` refuses
/// bytes.
#[cfg(feature = "knitout")]
pub fn knitout_to(design: &Design, out: impl Write) -> Result<Vec<String>, WriteError> {
    let file = KnitoutFile::new(design)?;
    file.write(Target::straight(out))?.done()?;
    Ok(file.left_out)
}
