//! Where in a design's files an error lies, whatever its type.

use std::error::Error;
use std::iter::successors;
use std::path::Path;

use super::{FilePlace, ReadError, Refusal};

/// The place in a file that an error is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FaultPlace<'a> {
    /// The file.
    pub file: &'a Path,
    /// The line, counted from 1; 0 if the error is about the whole file.
    pub line: usize,
    /// The column, counted from 1; 0 if the error is about the whole line.
    pub column: usize,
}

/// The place in a design's files that `error` or one of its causes is about. The innermost cause
/// that has a place decides. None if no cause has one.
///
/// ```
/// use texere_formats::read::{fault_place, read};
/// # let folder = tempfile::tempdir()?;
/// # let file = folder.path().join("twill.toml");
/// std::fs::write(&file, "weave.notation = \"2/2\"\nyarns.wool.tex = -50\n")?;
/// let error = read(&file).unwrap_err();
/// let place = fault_place(&error).ok_or("no place")?;
/// assert_eq!((place.file, place.line), (&*file, 2));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn fault_place<'a>(error: &'a (dyn Error + 'static)) -> Option<FaultPlace<'a>> {
    successors(Some(error), |error: &&'a (dyn Error + 'static)| (*error).source())
        .filter_map(own_place)
        .last()
}

/// The place that an error itself is about.
fn own_place<'a>(error: &'a (dyn Error + 'static)) -> Option<FaultPlace<'a>> {
    let at = |file: &'a Path, line, column| Some(FaultPlace { file, line, column });
    if let Some(error) = error.downcast_ref::<Box<ReadError>>() {
        return own_place(&**error);
    }
    if let Some(refusal) = error.downcast_ref() {
        return match refusal {
            Refusal::Key { place: FilePlace { file, line, .. }, .. } => at(file, *line, 0),
            Refusal::File { file, .. } => at(file, 0, 0),
            Refusal::Other(_) => None,
        };
    }
    match error.downcast_ref()? {
        ReadError::Word { file, line, column, .. } => at(file, *line, *column),
        ReadError::Syntax { file, line, .. } => at(file, *line, 0),
        ReadError::BadValue { place, .. }
        | ReadError::OutOfRange { place, .. }
        | ReadError::UnknownKey { place, .. }
        | ReadError::Value { place, .. }
        | ReadError::Without { place, .. }
        | ReadError::Weave { place, .. }
        | ReadError::Chart { place, .. }
        | ReadError::Chain { place, .. }
        | ReadError::Named { place, .. }
        | ReadError::Corner { place, .. }
        | ReadError::Section { place, .. }
        | ReadError::Cloth { place, .. } => at(&place.file, place.line, 0),
        ReadError::Feature { file, .. }
        | ReadError::Io { file, .. }
        | ReadError::NotAFile { file, .. }
        | ReadError::TooLarge { file, .. }
        | ReadError::UnknownKind { file, .. }
        | ReadError::MissingSection { file, .. }
        | ReadError::MissingKey { file, .. }
        | ReadError::ExactlyOne { file, .. }
        | ReadError::Image { file, .. }
        | ReadError::ImageTooLarge { file, .. }
        | ReadError::Pixel { file, .. }
        | ReadError::WithoutDesign { file }
        | ReadError::Bytes { file, .. }
        | ReadError::Yarns { file, .. }
        | ReadError::Boundary { file, .. }
        | ReadError::Fabric { file, .. } => at(file, 0, 0),
        // The place of an operation is a text, which has the file and the line in it.
        ReadError::Operation { .. } | ReadError::OutOfMemory(_) => None,
    }
}
