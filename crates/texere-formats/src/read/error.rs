//! What can be wrong with a design.

use std::fmt;
use std::path::{Path, PathBuf};

use texere_core::SectionError;
use texere_fabric::FabricError;
use thiserror::Error;

/// A place in a design file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// The file.
    pub file: PathBuf,
    /// The line, from 1.
    pub line: usize,
    /// Section and key, as the file's format writes them.
    pub field: String,
}

impl Place {
    pub(super) fn new(file: &Path, line: usize, field: impl Into<String>) -> Self {
        Self { file: file.into(), line, field: field.into() }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, line {}: {}", self.file.display(), self.line, self.field)
    }
}

/// A design that can't be read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The file can't be opened or read.
    #[error("can't read {}", .file.display())]
    Io {
        /// The file.
        file: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The file is larger than any design of its kind.
    #[error("{} has {bytes} bytes, more than {limit}", .file.display())]
    TooLarge {
        /// The file.
        file: PathBuf,
        /// Its size.
        bytes: u64,
        /// Most bytes taken.
        limit: u64,
    },
    /// The file's ending is none that texere knows.
    #[error("{} is of no known kind; known endings: {known}", .file.display())]
    UnknownKind {
        /// The file.
        file: PathBuf,
        /// Endings that would do.
        known: &'static str,
    },
    /// A section that the design needs is missing or empty.
    #[error("{}: section [{section}] is missing or empty; {needed_for}", .file.display())]
    MissingSection {
        /// The file.
        file: PathBuf,
        /// The section.
        section: &'static str,
        /// Why it is needed.
        needed_for: &'static str,
    },
    /// A key that the design needs is missing or empty.
    #[error("{}: {field} is missing or empty; {needed_for}", .file.display())]
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
        place: Place,
        /// What it is.
        value: String,
        /// What it should be.
        expected: String,
    },
    /// A number outside its limits.
    #[error("{place} is {value}, outside {low} to {high}")]
    OutOfRange {
        /// Where.
        place: Place,
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
        place: Place,
        /// The known key nearest to it in spelling.
        nearest: Option<String>,
    },
    /// Two keys of which only one can be meant, or none of those of which one is needed.
    #[error("{}: give exactly one of {keys}", .file.display())]
    ExactlyOne {
        /// The file.
        file: PathBuf,
        /// The keys.
        keys: &'static str,
    },
    /// The file is not well-formed.
    #[error("{}, line {line}: {message}", .file.display())]
    Syntax {
        /// The file.
        file: PathBuf,
        /// The line, from 1.
        line: usize,
        /// What the parser says.
        message: String,
    },
    /// A key that says nothing without another one.
    #[error("{place} is given without {needs}, which it belongs to")]
    Without {
        /// Where.
        place: Place,
        /// The key that it belongs to.
        needs: &'static str,
    },
    /// A weave that is none.
    #[error("{place} is no weave")]
    Weave {
        /// Where.
        place: Place,
        /// Why.
        source: FabricError,
    },
    /// A file that can't be decoded as an image.
    #[error("{} can't be read as a PNG, BMP or TIFF image", .file.display())]
    Image {
        /// The file.
        file: PathBuf,
        /// Why.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
    /// An image larger than any cloth that is taken. No memory was taken for it.
    #[error(
        "{} is {width} × {height} pixels; each side may have {side_limit} at most, and both together {limit}",
        .file.display()
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
    #[error("{}, column {column}, row {row} from the top left: colour {color}, expected {expected}", .file.display())]
    Pixel {
        /// The image.
        file: PathBuf,
        /// The first such pixel's column, from 1 at the left.
        column: usize,
        /// Its row, from 1 at the top.
        row: usize,
        /// Its colour: #rrggbb, and two digits more where it is not opaque.
        color: String,
        /// What would do.
        expected: String,
    },
    /// A section whose numbers are not sound.
    #[error("{place} is no section")]
    Section {
        /// Where.
        place: Place,
        /// Why.
        source: SectionError,
    },
    /// The structure that the design describes can't be made.
    #[error("{} can't be made into a fabric", .file.display())]
    Fabric {
        /// The file.
        file: PathBuf,
        /// Why.
        source: FabricError,
    },
}
