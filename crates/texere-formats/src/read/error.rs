//! What can be wrong with a design.

use std::fmt;
use std::path::{Path, PathBuf};

use texere_core::{BoundaryError, OutOfMemory, SectionError, YarnError, counted};
use texere_fabric::warp::ChainError;
use texere_fabric::weft::ChartError;
use texere_fabric::{FabricError, WovenError, hyphen_look_alike};
use thiserror::Error;

/// A place in a design file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FilePlace {
    /// The file.
    pub file: PathBuf,
    /// The line, from 1.
    pub line: usize,
    /// Section and key, as the file's format writes them.
    pub field: String,
}

impl FilePlace {
    pub(super) fn new(file: &Path, line: usize, field: &str) -> Self {
        Self { file: file.into(), line, field: shown(field) }
    }
}

/// Characters of a text from a file that an error shows.
const SHOWN: usize = 60;

/// Characters of what a parser or decoder says that an error shows.
const SAID: usize = 160;

/// Characters of a path that an error shows.
const PATH_SHOWN: usize = 160;

/// A file's text as errors show it: on one line, without codes that would steer a terminal, cut
/// where it is long.
pub(super) fn shown(text: &str) -> String {
    cut(text, SHOWN)
}

/// The first `most` characters of a text, control characters written out.
fn cut(text: &str, most: usize) -> String {
    let end = text.char_indices().nth(most).map_or(text.len(), |(end, _)| end);
    let (text, rest) = text.split_at(end);
    plain(text) + if rest.is_empty() { "" } else { "…" }
}

/// What a parser or decoder says, as errors show it: on one line, cut where it is long.
pub(super) fn said(message: &str) -> String {
    let words = message.split_whitespace().collect::<Vec<_>>().join(" ");
    cut(&plain(&words), SAID)
}

/// A path as errors show it; of a long one the end, which says most.
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

/// What an error adds where a text has a sign that looks like a hyphen or a minus and is none.
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

/// A word in quotes; that there is none, where it is empty.
fn quoted(word: &str) -> String {
    if word.is_empty() { "the line ends".into() } else { format!("\"{word}\"") }
}

/// A number as a person writes it: with an exponent where it would have many zeros.
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

/// A design that can't be read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ReadError {
    /// A kind of file that this build was made without.
    #[error("{file}: this build reads no {what}; texere's feature `{feature}` adds them", file = file.display())]
    Feature {
        /// The file.
        file: PathBuf,
        /// What the file is.
        what: &'static str,
        /// The feature that reads it.
        feature: &'static str,
    },
    /// The file can't be opened or read.
    #[error("can't read {}", named(.file))]
    Io {
        /// The file.
        file: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// It is no regular file, but a folder, a pipe or a device. Nothing was read from it.
    #[error("{} is {kind}, not a file", named(.file))]
    NotAFile {
        /// The path.
        file: PathBuf,
        /// What it is.
        kind: &'static str,
    },
    /// Memory could not be had.
    #[error(transparent)]
    OutOfMemory(#[from] OutOfMemory),
    /// The file is larger than any design of its kind.
    #[error("{} has {bytes}, more than {limit}", named(.file), bytes = counted(*.bytes, "byte"))]
    TooLarge {
        /// The file.
        file: PathBuf,
        /// Its size.
        bytes: u64,
        /// Most bytes taken.
        limit: u64,
    },
    /// The file's ending is none that texere knows.
    #[error("{} is of no known kind; known endings: {known}", named(.file))]
    UnknownKind {
        /// The file.
        file: PathBuf,
        /// Endings that would do.
        known: &'static str,
    },
    /// A section that the design needs is missing or empty.
    #[error("{}: section [{section}] is missing or empty; {needed_for}", named(.file))]
    MissingSection {
        /// The file.
        file: PathBuf,
        /// The section.
        section: &'static str,
        /// Why it is needed.
        needed_for: &'static str,
    },
    /// A key that the design needs is missing or empty.
    #[error("{}: {field} is missing or empty; {needed_for}", named(.file))]
    MissingKey {
        /// The file.
        file: PathBuf,
        /// Section and key.
        field: String,
        /// Why it is needed.
        needed_for: &'static str,
    },
    /// A value that is not of the kind expected.
    #[error("{place} is \"{value}\", expected {expected}")]
    BadValue {
        /// Where.
        place: FilePlace,
        /// What it is.
        value: String,
        /// What it should be.
        expected: String,
    },
    /// A number outside its limits.
    #[error("{place} is {}, outside {} to {}", Short(*.value), Short(*.low), Short(*.high))]
    OutOfRange {
        /// Where.
        place: FilePlace,
        /// What it is.
        value: f64,
        /// Least allowed.
        low: f64,
        /// Most allowed.
        high: f64,
    },
    /// A key that texere does not know.
    #[error("{place} is not known{}", .nearest.as_ref().map(|key| format!("; did you mean \"{key}\"?")).unwrap_or_default())]
    UnknownKey {
        /// Where.
        place: FilePlace,
        /// The known key nearest to it in spelling.
        nearest: Option<String>,
    },
    /// Two keys of which only one can be meant, or none of those of which one is needed.
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
        /// The line, from 1.
        line: usize,
        /// What the parser says.
        message: String,
    },
    /// A word of a line that the file's format does not allow there.
    #[error("{}, line {line}, column {column}: {}, expected {expected}", named(.file), quoted(.value))]
    Word {
        /// The file.
        file: PathBuf,
        /// The line, from 1.
        line: usize,
        /// The column at which the word begins, in letters from 1.
        column: usize,
        /// The word; empty where the line ends too early.
        value: String,
        /// What should stand there.
        expected: String,
    },
    /// A value that the file's format does not allow there.
    #[error("{place}: {message}")]
    Value {
        /// Where.
        place: FilePlace,
        /// What the parser says.
        message: String,
    },
    /// A key that says nothing without another one.
    #[error("{place} is given without {needs}, which it belongs to")]
    Without {
        /// Where.
        place: FilePlace,
        /// The key that it belongs to.
        needs: &'static str,
    },
    /// A weave that is none.
    #[error("{place} is no weave")]
    Weave {
        /// Where.
        place: FilePlace,
        /// Why.
        source: WovenError,
    },
    /// A chart that can't be knitted.
    #[error("{place} is no chart")]
    Chart {
        /// Where.
        place: FilePlace,
        /// Why.
        source: ChartError,
    },
    /// An operation of a knitting program that no machine takes.
    #[error("{place} can't be knitted")]
    Operation {
        /// Where: a line of a file, or a cell of a chart.
        place: String,
        /// Why.
        source: FabricError,
    },
    /// A chain of a guide bar that can't be read.
    #[error("{place} is no chain")]
    Chain {
        /// Where.
        place: FilePlace,
        /// Why, with the column.
        source: ChainError,
    },
    /// A file that the design names can't be taken.
    #[error("{place} can't be taken")]
    Named {
        /// Where it is named.
        place: FilePlace,
        /// What is wrong with it.
        source: Box<ReadError>,
    },
    /// A file that can't be decoded as an image.
    #[error("{} can't be read as a PNG, BMP or TIFF image", named(.file))]
    Image {
        /// The file.
        file: PathBuf,
        /// Why.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
    /// An image larger than any cloth that is taken. No memory was taken for it.
    #[error(
        "{} is {width} × {height} pixels; each side may have {side_limit} at most, and both together {limit}",
        named(.file)
    )]
    ImageTooLarge {
        /// The file.
        file: PathBuf,
        /// Its width, pixels.
        width: u32,
        /// Its height, pixels.
        height: u32,
        /// Most pixels of a side.
        side_limit: u32,
        /// Most pixels of the image.
        limit: u64,
    },
    /// A pixel of a colour that stands for nothing.
    #[error("{}, column {column}, row {row} from the top left: colour {color}, expected {expected}", named(.file))]
    Pixel {
        /// The image.
        file: PathBuf,
        /// The first such pixel's column, from 1 at the left.
        column: usize,
        /// Its row, from 1 at the top.
        row: usize,
        /// Its colour: #rrggbb, and how far it is transparent where it is not opaque.
        color: String,
        /// What would do.
        expected: String,
    },
    /// A corner of a polygon at which its outline faces nowhere: it is too small for its edges to
    /// have a direction, or its two edges point opposite ways.
    #[error("{place}: the outline faces nowhere at corner {corner}; it is too small or too sharp there")]
    Corner {
        /// Where the polygon stands.
        place: FilePlace,
        /// The corner, from 1.
        corner: usize,
    },
    /// A section whose numbers are not sound.
    #[error("{place} is no section")]
    Section {
        /// Where.
        place: FilePlace,
        /// Why.
        source: SectionError,
    },
    /// The cloth that a key of the design asks for can't be made.
    #[error("{place} can't be made into a fabric")]
    Cloth {
        /// The key.
        place: FilePlace,
        /// Why.
        source: FabricError,
    },
    /// Yarns that were saved without the design that they are of, where a design is needed.
    /// [`read::yarns`](fn@crate::read::yarns) reads them.
    #[error("{} holds saved yarns alone, and this needs the design that they are of", named(.file))]
    WithoutDesign {
        /// The file.
        file: PathBuf,
    },
    /// A value of a binary file that its format does not have there.
    #[error("{}, byte {at}: {field} is {value}, expected {expected}", named(.file))]
    Bytes {
        /// The file.
        file: PathBuf,
        /// The byte at which the value begins, from 0.
        at: u64,
        /// What stands there.
        field: &'static str,
        /// What it is.
        value: String,
        /// What it should be.
        expected: String,
    },
    /// Saved yarns that no yarns can be.
    #[error("{} holds no sound yarns", named(.file))]
    Yarns {
        /// The file.
        file: PathBuf,
        /// Why, with the yarn, the point, the value and its limits.
        source: YarnError,
    },
    /// Saved yarns that go on as no yarns can.
    #[error("{} holds no sound boundary", named(.file))]
    Boundary {
        /// The file.
        file: PathBuf,
        /// Why.
        source: BoundaryError,
    },
    /// The structure that the design describes can't be made.
    #[error("{} can't be made into a fabric", named(.file))]
    Fabric {
        /// The file.
        file: PathBuf,
        /// Why.
        source: FabricError,
    },
}

impl ReadError {
    /// What is wrong at the bottom of it: the error of the file that a design names, or else this
    /// one.
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

    /// What a fabric refused of the design in `file`. Memory that is short has nothing to do with
    /// the design.
    pub(super) fn fabric(file: &Path, source: FabricError) -> Self {
        match source {
            FabricError::OutOfMemory(error) => Self::OutOfMemory(error),
            source => Self::Fabric { file: file.into(), source },
        }
    }

    /// This error of a file that the design names at `place`. Memory that is short has nothing to
    /// do with the file.
    pub(super) fn named(self, place: FilePlace) -> Self {
        match self {
            Self::OutOfMemory(_) => self,
            _ => Self::Named { place, source: Box::new(self) },
        }
    }
}
