//! Errors of reading designs, saved yarns and curves.

use std::fmt;
use std::path::{Path, PathBuf};

use texere_core::{BoundaryError, OutOfMemory, SectionError, YarnError, counted};
use texere_fabric::warp::ChainError;
use texere_fabric::weft::ChartError;
use texere_fabric::{FabricError, WovenError, hyphen_look_alike};
use thiserror::Error;

/// A place in the file of a design.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FilePlace {
    /// The file.
    pub file: PathBuf,
    /// The line, counted from 1.
    pub line: usize,
    /// Section and key, as the file's format writes them.
    pub field: String,
}

impl FilePlace {
    pub(super) fn new(file: &Path, line: usize, field: &str) -> Self {
        Self { file: file.into(), line, field: shown(field) }
    }
}

/// The most characters of a file's text that an error shows.
const SHOWN: usize = 60;

/// The most characters of a parser's or decoder's message that an error shows.
const SAID: usize = 160;

/// The most characters of a path that an error shows.
const PATH_SHOWN: usize = 160;

/// A file's text as errors show it: on one line, without codes that steer a terminal, and cut if it
/// is long.
pub(super) fn shown(text: &str) -> String {
    cut(text, SHOWN)
}

/// The first `most` characters of a text, control characters written out.
fn cut(text: &str, most: usize) -> String {
    let end = text.char_indices().nth(most).map_or(text.len(), |(end, _)| end);
    let (text, rest) = text.split_at(end);
    plain(text) + if rest.is_empty() { "" } else { "…" }
}

/// A parser's or decoder's message as errors show it: on one line, and cut if it is long.
pub(super) fn said(message: &str) -> String {
    let words = message.split_whitespace().collect::<Vec<_>>().join(" ");
    cut(&plain(&words), SAID)
}

/// A path as errors show it. A long path is cut at its start, because its end says most.
pub(super) fn named(path: &Path) -> String {
    let path = path.to_string_lossy();
    let start = path.char_indices().rev().nth(PATH_SHOWN).map_or(0, |(start, _)| start);
    let (rest, path) = path.split_at(start);
    if rest.is_empty() { plain(path) } else { format!("…{}", plain(path)) }
}

/// `text` with its control characters written out.
fn plain(text: &str) -> String {
    let mut plain = String::new();
    for character in text.chars() {
        if character.is_control() {
            plain.extend(character.escape_default());
        } else {
            plain.push(character);
        }
    }
    plain
}

/// A note for errors about a text with a character that looks like the hyphen of the keyboard
/// (U+002D) but is a different character, such as a dash. Empty for other texts.
pub(super) fn no_hyphen(text: &str) -> String {
    let sign = hyphen_look_alike(text);
    sign.map(|sign| format!(" (there is {sign}, not a hyphen)")).unwrap_or_default()
}

/// The first few names of a list that may be long, separated by commas.
pub(super) fn first_few(names: impl ExactSizeIterator<Item = String>) -> String {
    const FEW: usize = 5;
    let more = names.len().saturating_sub(FEW);
    let few = names.take(FEW).map(|name| shown(&name)).collect::<Vec<_>>().join(", ");
    if more > 0 { format!("{few} and {more} more") } else { few }
}

/// A word in quotes. For an empty word, a note that the line ends.
fn quoted(word: &str) -> String {
    if word.is_empty() { "the line ends".into() } else { format!("\"{word}\"") }
}

/// A number as people write it: with an exponent if it would have many zeros.
struct Short(f64);

impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(number) = self;
        if *number == 0.0 || !number.is_finite() || (1e-4..1e15).contains(&number.abs()) {
            write!(f, "{number}")
        } else {
            write!(f, "{number:e}")
        }
    }
}

impl fmt::Display for FilePlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, line {}: {}", named(&self.file), self.line, self.field)
    }
}

/// A design, or a file of saved yarns or of curves, that can't be read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ReadError {
    /// A kind of file that this build was made without.
    #[error("{file}: this build reads no {what}; texere's feature `{feature}` adds them", file = file.display())]
    Feature {
        /// The file.
        file: PathBuf,
        /// The kind of file.
        what: &'static str,
        /// The feature that reads it.
        feature: &'static str,
    },
    /// The file can't be opened or read.
    #[error("can't read {}", named(.file))]
    Io {
        /// The file.
        file: PathBuf,
        /// The reason.
        source: std::io::Error,
    },
    /// The path is no regular file, but for example a folder, a pipe or a device. Nothing was read
    /// from it.
    #[error("{} is {kind}, not a file", named(.file))]
    NotAFile {
        /// The path.
        file: PathBuf,
        /// The kind of file at the path.
        kind: &'static str,
    },
    /// There was too little memory.
    #[error(transparent)]
    OutOfMemory(#[from] OutOfMemory),
    /// The file is larger than a file of its kind may be.
    #[error("{} has {bytes}, more than {limit}", named(.file), bytes = counted(*.bytes, "byte"))]
    TooLarge {
        /// The file.
        file: PathBuf,
        /// The size of the file, bytes.
        bytes: u64,
        /// The most bytes that a file of its kind may have.
        limit: u64,
    },
    /// texere does not know the file's ending.
    #[error("{} is of no known kind; known endings: {known}", named(.file))]
    UnknownKind {
        /// The file.
        file: PathBuf,
        /// The endings that texere knows.
        known: &'static str,
    },
    /// A section that the design needs is missing or empty.
    #[error("{}: section [{section}] is missing or empty; {needed_for}", named(.file))]
    MissingSection {
        /// The file.
        file: PathBuf,
        /// The section.
        section: &'static str,
        /// Why the section is needed.
        needed_for: &'static str,
    },
    /// A key that the design needs is missing or empty.
    #[error("{}: {field} is missing or empty; {needed_for}", named(.file))]
    MissingKey {
        /// The file.
        file: PathBuf,
        /// Section and key.
        field: String,
        /// Why the key is needed.
        needed_for: &'static str,
    },
    /// A value that is not of the expected kind.
    #[error("{place} is \"{value}\", expected {expected}")]
    BadValue {
        /// The place in the file.
        place: FilePlace,
        /// The value.
        value: String,
        /// What the value should be.
        expected: String,
    },
    /// A number outside its limits.
    #[error("{place} is {}, outside {} to {}", Short(*.value), Short(*.low), Short(*.high))]
    OutOfRange {
        /// The place in the file.
        place: FilePlace,
        /// The value.
        value: f64,
        /// The least allowed value.
        low: f64,
        /// The greatest allowed value.
        high: f64,
    },
    /// A key that texere does not know.
    #[error("{place} is not known{}", .nearest.as_ref().map(|key| format!("; did you mean \"{key}\"?")).unwrap_or_default())]
    UnknownKey {
        /// The place in the file.
        place: FilePlace,
        /// The known key that is nearest to the unknown one in spelling, if any is near.
        nearest: Option<String>,
    },
    /// A design has to have exactly one of some keys, and has none of them or several.
    #[error("{}: give exactly one of {keys}", named(.file))]
    ExactlyOne {
        /// The file.
        file: PathBuf,
        /// The keys.
        keys: &'static str,
    },
    /// The file is not well-formed.
    #[error("{}, line {line}: {message}", named(.file))]
    Syntax {
        /// The file.
        file: PathBuf,
        /// The line, counted from 1.
        line: usize,
        /// The message of the parser.
        message: String,
    },
    /// A word that the file's format does not allow at its place in a line.
    #[error("{}, line {line}, column {column}: {}, expected {expected}", named(.file), quoted(.value))]
    Word {
        /// The file.
        file: PathBuf,
        /// The line, counted from 1.
        line: usize,
        /// The column at which the word begins, in letters counted from 1.
        column: usize,
        /// The word. It is empty if the line ends too early.
        value: String,
        /// What the format allows in place of the word.
        expected: String,
    },
    /// A table of the file lacks a key that it needs.
    #[error("{place}: {message}")]
    Value {
        /// The place of the table in the file.
        place: FilePlace,
        /// What is wrong: the name of the key that is missing.
        message: String,
    },
    /// A key that has no meaning without another one.
    #[error("{place} is given without {needs}, which it belongs to")]
    Without {
        /// The place in the file.
        place: FilePlace,
        /// The key that is missing.
        needs: &'static str,
    },
    /// A notation that stands for no weave.
    #[error("{place} is no weave")]
    Weave {
        /// The place in the file.
        place: FilePlace,
        /// The reason.
        source: WovenError,
    },
    /// A chart that can't be knitted.
    #[error("{place} is no chart")]
    Chart {
        /// The place in the file.
        place: FilePlace,
        /// The reason.
        source: ChartError,
    },
    /// An operation of a knitting program that can't be carried out.
    #[error("{place} can't be knitted")]
    Operation {
        /// The place: a line of a file, or a cell of a chart.
        place: String,
        /// The reason.
        source: FabricError,
    },
    /// A chain of a guide bar that can't be read.
    #[error("{place} is no chain")]
    Chain {
        /// The place in the file.
        place: FilePlace,
        /// The reason, with the column.
        source: ChainError,
    },
    /// A file that the design names is refused.
    #[error("{place} can't be taken")]
    Named {
        /// The key that names the file.
        place: FilePlace,
        /// The error of the file.
        source: Box<ReadError>,
    },
    /// A file that can't be decoded as an image.
    #[error("{} can't be read as a PNG, BMP or TIFF image", named(.file))]
    Image {
        /// The file.
        file: PathBuf,
        /// The reason.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
    /// An image with more pixels, or a longer side, than images may have. No memory was reserved
    /// for the image.
    #[error(
        "{} is {width} × {height} pixels; each side may have {side_limit} at most, and both together {limit}",
        named(.file)
    )]
    ImageTooLarge {
        /// The file.
        file: PathBuf,
        /// The width of the image, pixels.
        width: u32,
        /// The height of the image, pixels.
        height: u32,
        /// The most pixels of a side.
        side_limit: u32,
        /// The most pixels of an image.
        limit: u64,
    },
    /// A pixel of a colour without a meaning.
    #[error("{}, column {column}, row {row} from the top left: colour {color}, expected {expected}", named(.file))]
    Pixel {
        /// The image.
        file: PathBuf,
        /// The column of the first pixel of that colour, counted from 1 at the left.
        column: usize,
        /// The row of that pixel, counted from 1 at the top.
        row: usize,
        /// The pixel's colour: #rrggbb, and the opacity unless it is opaque.
        color: String,
        /// What the pixel should be.
        expected: String,
    },
    /// A corner of a polygon at which the outline faces nowhere. The corner's edges are too short
    /// to have a direction, or they point opposite ways.
    #[error("{place}: the outline faces nowhere at corner {corner}; it is too small or too sharp there")]
    Corner {
        /// The place of the polygon in the file.
        place: FilePlace,
        /// The corner, counted from 1.
        corner: usize,
    },
    /// A section with numbers out of range.
    #[error("{place} is no section")]
    Section {
        /// The place in the file.
        place: FilePlace,
        /// The reason.
        source: SectionError,
    },
    /// The cloth that a key of the design asks for can't be made.
    #[error("{place} can't be made into a fabric")]
    Cloth {
        /// The key.
        place: FilePlace,
        /// The reason.
        source: FabricError,
    },
    /// A file of saved yarns where a design is needed. [`read::yarns`](fn@crate::read::yarns) reads
    /// saved yarns.
    #[error("{} holds saved yarns alone, and this needs the design that they are of", named(.file))]
    WithoutDesign {
        /// The file.
        file: PathBuf,
    },
    /// A value that the format of a binary file does not allow at its place, or a file that should
    /// be text and is not.
    #[error("{}, byte {at}: {field} is {value}, expected {expected}", named(.file))]
    Bytes {
        /// The file.
        file: PathBuf,
        /// The byte at which the value begins, counted from 0.
        at: u64,
        /// The field of the format.
        field: &'static str,
        /// The value.
        value: String,
        /// What the value should be.
        expected: String,
    },
    /// Saved yarns or curves with values that yarns can't have.
    #[error("{} holds no valid yarns", named(.file))]
    Yarns {
        /// The file.
        file: PathBuf,
        /// The reason, with the yarn, the point, the value and its limits.
        source: YarnError,
    },
    /// Saved yarns with a boundary that yarns can't have.
    #[error("{} holds no valid boundary", named(.file))]
    Boundary {
        /// The file.
        file: PathBuf,
        /// The reason.
        source: BoundaryError,
    },
    /// The structure that the design describes can't be made.
    #[error("{} can't be made into a fabric", named(.file))]
    Fabric {
        /// The file.
        file: PathBuf,
        /// The reason.
        source: FabricError,
    },
}

impl ReadError {
    /// The refusal of the word `value`, whose first byte is number `at` of a text file's `bytes`.
    pub(super) fn word(file: &Path, bytes: &[u8], at: usize, value: &str, expected: String) -> Self {
        let before = &bytes[..at];
        let line_at = before.iter().rposition(|&byte| byte == b'\n').map_or(0, |end| end + 1);
        let line = before.iter().filter(|&&byte| byte == b'\n').count() + 1;
        // Columns count characters, not bytes.
        let column = String::from_utf8_lossy(&before[line_at..]).chars().count() + 1;
        Self::Word { file: file.into(), line, column, value: shown(value), expected }
    }

    /// The error at the root: the error of the file that a design names, or else this one.
    ///
    /// ```
    /// use texere_formats::{ReadError, read};
    /// let error = read("missing.wif").unwrap_err();
    /// assert!(matches!(error.innermost(), ReadError::Io { .. }));
    /// ```
    #[must_use]
    pub fn innermost(&self) -> &Self {
        match self {
            Self::Named { source, .. } => source.innermost(),
            _ => self,
        }
    }

    /// Turns an error of a structure into the refusal of the design in `file`. A lack of memory
    /// stays [`ReadError::OutOfMemory`], because the design is not at fault.
    pub(super) fn fabric(file: &Path, source: FabricError) -> Self {
        match source {
            FabricError::OutOfMemory(error) => Self::OutOfMemory(error),
            source => Self::Fabric { file: file.into(), source },
        }
    }

    /// Adds the `place` in the design that names the file of this error. A lack of memory stays
    /// [`ReadError::OutOfMemory`], because the file is not at fault.
    pub(super) fn named(self, place: FilePlace) -> Self {
        match self {
            Self::OutOfMemory(_) => self,
            _ => Self::Named { place, source: Box::new(self) },
        }
    }
}
