//! What went wrong in a call: its status, its words, its place in a file.

use std::any::Any;
use std::cell::RefCell;
use std::error::Error;
use std::ffi::{CString, c_char};
use std::iter::successors;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::ptr::{null, write};

use texere::backend::{OutOfMemory, SessionError};
use texere::check::ContactError;
use texere::read::{FilePlace, Refusal};
use texere::rest::{CrossingsError, FinishError, SettlingError};
use texere::{BackendError, FabricError, PipelineError, ReadError, WriteError};

use crate::argument::check;
use crate::status::texere_status;
use crate::status::texere_status::*;

/// What a call that failed leaves behind.
#[derive(Debug)]
pub(crate) struct Failure {
    status: texere_status,
    message: String,
    place: Option<Place>,
}

#[derive(Debug)]
struct Place {
    file: CString,
    line: u64,
    column: u64,
}

/// What the last call that failed on a thread has left.
#[derive(Default)]
struct Last {
    message: CString,
    place: Option<Place>,
}

thread_local! {
    static LAST: RefCell<Last> = RefCell::default();
}

impl Failure {
    pub(crate) fn argument(message: impl Into<String>) -> Self {
        Self { status: TEXERE_ARGUMENT, message: message.into(), place: None }
    }

    pub(crate) fn into_message(self) -> String {
        self.message
    }

    fn panicked(panic: &(dyn Any + Send)) -> Self {
        let text = panic.downcast_ref::<&str>().copied();
        let text = text.or(panic.downcast_ref::<String>().map(String::as_str)).unwrap_or("no message");
        Self { status: TEXERE_PANIC, message: format!("a fault of texere: {text}"), place: None }
    }
}

impl<E: Error + 'static> From<E> for Failure {
    fn from(error: E) -> Self {
        let error: &(dyn Error + 'static) = &error;
        let causes = || successors(Some(error), |error: &&(dyn Error + 'static)| (*error).source());
        let message = causes().map(ToString::to_string).collect::<Vec<_>>().join(": ");
        let status = causes().filter_map(status_of).last().unwrap_or(TEXERE_ARGUMENT);
        Self { status, message, place: causes().filter_map(place_of).last() }
    }
}

/// The status of an error by itself, where it decides one. A cause decides over what it led to:
/// memory that ran out while a design was read is no fault of the design.
fn status_of(error: &(dyn Error + 'static)) -> Option<texere_status> {
    if error.is::<OutOfMemory>() {
        return Some(TEXERE_MEMORY);
    }
    if let Some(error) = error.downcast_ref::<Box<ReadError>>() {
        return status_of(&**error);
    }
    if let Some(error) = error.downcast_ref() {
        return Some(match error {
            ReadError::Io { .. } | ReadError::NotAFile { .. } => TEXERE_IO,
            ReadError::OutOfMemory(_) => TEXERE_MEMORY,
            ReadError::Feature { .. } => TEXERE_UNSUPPORTED,
            _ => TEXERE_DESIGN,
        });
    }
    if let Some(error) = error.downcast_ref() {
        return Some(match error {
            FabricError::OutOfMemory(_) => TEXERE_MEMORY,
            FabricError::Cancelled | FabricError::Contact(ContactError::Cancelled) => TEXERE_CANCELLED,
            _ => TEXERE_DESIGN,
        });
    }
    if let Some(error) = error.downcast_ref::<FinishError>() {
        return match error {
            FinishError::Settling(SettlingError::OutOfMemory(_))
            | FinishError::Crossings(CrossingsError::OutOfMemory(_)) => Some(TEXERE_MEMORY),
            FinishError::Fabric(error) => status_of(error),
            FinishError::Backend(error) => status_of(error),
            _ => Some(TEXERE_DESIGN),
        };
    }
    if let Some(Refusal::Other(error)) = error.downcast_ref() {
        return status_of(error);
    }
    if let Some(error) = error.downcast_ref() {
        return Some(match error {
            BackendError::OutOfMemory(_) => TEXERE_MEMORY,
            BackendError::NoFeature { .. }
            | BackendError::NoSettling { .. }
            | BackendError::NoCrossings { .. }
            | BackendError::Unsupported { .. } => TEXERE_UNSUPPORTED,
            _ => TEXERE_DEVICE,
        });
    }
    if let Some(SessionError::Backend(error)) = error.downcast_ref() {
        return status_of(error);
    }
    if let Some(error) = error.downcast_ref::<PipelineError>() {
        return match error {
            PipelineError::Cancelled => Some(TEXERE_CANCELLED),
            PipelineError::Backend(error) => status_of(error),
            _ => None,
        };
    }
    if let Some(error) = error.downcast_ref::<WriteError>() {
        return match error {
            WriteError::Feature { .. } => Some(TEXERE_UNSUPPORTED),
            WriteError::Pipeline(error) => status_of(error),
            WriteError::Io { .. } => Some(TEXERE_IO),
            _ => None,
        };
    }
    None
}

/// Where in a design's file an error lies, where it says so.
fn place_of(error: &(dyn Error + 'static)) -> Option<Place> {
    let at = |file: &Path, line: usize, column: usize| {
        let file = CString::new(file.to_string_lossy().replace('\0', "\u{fffd}")).unwrap_or_default();
        Some(Place { file, line: line as u64, column: column as u64 })
    };
    if let Some(error) = error.downcast_ref::<Box<ReadError>>() {
        return place_of(&**error);
    }
    if let Some(Refusal::Key { place: FilePlace { file, line, .. }, .. }) = error.downcast_ref() {
        return at(file, *line, 0);
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
        ReadError::Io { file, .. } | ReadError::Fabric { file, .. } | ReadError::MissingKey { file, .. } => {
            at(file, 0, 0)
        }
        _ => None,
    }
}

/// Does the work of a call, and keeps what went wrong. No panic gets out.
pub(crate) fn guard(call: impl FnOnce() -> Result<(), Failure>) -> texere_status {
    let done = catch_unwind(AssertUnwindSafe(call));
    let Err(failure) = done.unwrap_or_else(|panic| Err(Failure::panicked(&*panic))) else {
        return TEXERE_OK;
    };
    let Failure { status, message, place } = failure;
    let message = CString::new(message.replace('\0', "\u{fffd}")).unwrap_or_default();
    LAST.with_borrow_mut(|last| *last = Last { message, place });
    status
}

/// What went wrong in the last call of this thread that failed, with all its causes, in one line of
/// UTF-8 that ends with a zero byte. It is empty where none has failed, and valid until the next
/// call of this thread fails.
#[unsafe(no_mangle)]
pub extern "C" fn texere_error_message() -> *const c_char {
    LAST.with_borrow(|last| last.message.as_ptr())
}

/// A place in a design's file.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_place {
    /// The file's name, UTF-8 that ends with a zero byte; null where the error has no place. It is
    /// valid until the next call of this thread fails.
    pub file: *const c_char,
    /// The line, from 1; 0 where it is not known.
    pub line: u64,
    /// The column, in letters from 1; 0 where it is not known.
    pub column: u64,
}

/// Where in a design's file the last call of this thread that failed has found the fault.
///
/// Fails with TEXERE_ARGUMENT for a null `place`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_error_place(place: *mut texere_place) -> texere_status {
    if let Err(failure) = check("place", place) {
        return guard(|| Err(failure));
    }
    let found = LAST.with_borrow(|last| match &last.place {
        Some(Place { file, line, column }) => {
            texere_place { file: file.as_ptr(), line: *line, column: *column }
        }
        None => texere_place { file: null(), line: 0, column: 0 },
    });
    // SAFETY: not null and aligned; the caller vouches for the rest.
    unsafe { write(place, found) };
    TEXERE_OK
}
