//! What went wrong in a call: the status, the message, and the place in a design's file.

use std::any::Any;
use std::error::Error;
use std::ffi::CString;
use std::io;
use std::iter::successors;

use texere::backend::{OutOfMemory, SessionError};
use texere::check::ContactError;
use texere::mesh::{LiveError, PickError};
#[cfg(feature = "render")]
use texere::picture::RenderError;
use texere::read::{FaultPlace, Refusal, fault_place};
use texere::rest::{CrossingsError, FinishError, SettlingError};
use texere::woven::WovenError;
use texere::{BackendError, FabricError, PipelineError, ReadError, WriteError};

use crate::callback::Answer;
use crate::lendable::lendable;
use crate::status::texere_status;
use crate::status::texere_status::*;

/// What a call that failed leaves behind.
#[derive(Debug)]
pub(crate) struct Failure {
    pub(crate) status: texere_status,
    pub(crate) message: String,
    pub(crate) place: Option<Place>,
}

#[derive(Debug)]
pub(crate) struct Place {
    pub(crate) file: CString,
    pub(crate) line: u64,
    pub(crate) column: u64,
}

impl Failure {
    pub(crate) fn argument(message: impl Into<String>) -> Self {
        Self { status: TEXERE_ARGUMENT, message: message.into(), place: None }
    }

    pub(crate) fn unsupported(message: impl Into<String>) -> Self {
        Self { status: TEXERE_UNSUPPORTED, message: message.into(), place: None }
    }

    pub(crate) fn panicked(panic: &(dyn Any + Send)) -> Self {
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
        let place = fault_place(error).map(|FaultPlace { file, line, column }| Place {
            file: lendable(file.to_string_lossy()),
            line: line as u64,
            column: column as u64,
        });
        Self { status, message, place }
    }
}

/// The status that an error has by itself, without its causes, or `None` if it has none. A
/// `Failure` takes the status of the deepest cause that has one: if memory runs out while a design
/// is read, the status is TEXERE_MEMORY and not TEXERE_DESIGN.
fn status_of(error: &(dyn Error + 'static)) -> Option<texere_status> {
    if error.is::<OutOfMemory>() {
        return Some(TEXERE_MEMORY);
    }
    if error.is::<Answer>() {
        return Some(TEXERE_CANCELLED);
    }
    // `source` of an `io::Error` passes over the error that it wraps, so that error is asked here.
    if let Some(held) = error.downcast_ref().and_then(io::Error::get_ref) {
        return status_of(held);
    }
    of_cloth(error).or_else(|| of_mesh(error))
}

/// The status of an error of a design or of its cloth, if it has one.
fn of_cloth(error: &(dyn Error + 'static)) -> Option<texere_status> {
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
    None
}

/// The status of an error of a device, or of making, editing, drawing or writing a mesh, if it has
/// one.
fn of_mesh(error: &(dyn Error + 'static)) -> Option<texere_status> {
    if let Some(error) = error.downcast_ref() {
        return Some(match error {
            BackendError::OutOfMemory(_) => TEXERE_MEMORY,
            BackendError::NoFeature { .. }
            | BackendError::NoSettling { .. }
            | BackendError::NoCrossings { .. }
            | BackendError::NoRelaxation { .. }
            | BackendError::NoAttributes
            | BackendError::NoPacking
            | BackendError::NoEditing
            | BackendError::Unsupported { .. } => TEXERE_UNSUPPORTED,
            _ => TEXERE_DEVICE,
        });
    }
    if let Some(SessionError::Backend(error)) = error.downcast_ref() {
        return status_of(error);
    }
    if let Some(PickError::OutOfMemory(_)) = error.downcast_ref() {
        return Some(TEXERE_MEMORY);
    }
    if let Some(error) = error.downcast_ref::<LiveError>() {
        return match error {
            LiveError::Fabric(FabricError::Woven(WovenError::NoCrossing { .. })) => None,
            LiveError::Fabric(error) => status_of(error),
            LiveError::Pick(error) => status_of(error),
            LiveError::Session(error) => status_of(error),
            _ => None,
        };
    }
    if let Some(error) = error.downcast_ref::<PipelineError>() {
        return match error {
            PipelineError::Cancelled => Some(TEXERE_CANCELLED),
            PipelineError::Backend(error) => status_of(error),
            _ => None,
        };
    }
    #[cfg(feature = "render")]
    if let Some(error) = error.downcast_ref() {
        return match error {
            RenderError::Cancelled => Some(TEXERE_CANCELLED),
            RenderError::Backend(error) => status_of(error),
            RenderError::Session(_) => Some(TEXERE_DEVICE),
            _ => None,
        };
    }
    if let Some(error) = error.downcast_ref::<WriteError>() {
        return match error {
            WriteError::Feature { .. }
            | WriteError::Unheld { .. }
            | WriteError::GlbTooLarge { .. }
            | WriteError::TooLongToPack { .. }
            | WriteError::TooFewRepeats { .. }
            | WriteError::TooManyVertices { .. }
            | WriteError::TooManyFacets { .. } => Some(TEXERE_UNSUPPORTED),
            WriteError::Pipeline(error) => status_of(error),
            WriteError::Io { .. } | WriteError::Writer { .. } => Some(TEXERE_IO),
            _ => None,
        };
    }
    None
}
