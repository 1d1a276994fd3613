//! The last failure of each thread.

use std::cell::RefCell;
use std::ffi::{CString, c_char};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::ptr::null;

use crate::argument::check;
use crate::failure::{Failure, Place};
use crate::lendable::lendable;
use crate::status::texere_status;
use crate::status::texere_status::TEXERE_OK;

/// What the last call that failed on a thread has left.
#[derive(Default)]
struct Last {
    message: CString,
    place: Option<Place>,
}

thread_local! {
    static LAST: RefCell<Last> = RefCell::default();
}

/// Does the work of a call, and keeps what went wrong. No panic gets out.
pub(crate) fn guard(call: impl FnOnce() -> Result<(), Failure>) -> texere_status {
    let done = catch_unwind(AssertUnwindSafe(call));
    let Err(failure) = done.unwrap_or_else(|panic| Err(Failure::panicked(&*panic))) else {
        return TEXERE_OK;
    };
    let Failure { status, message, place } = failure;
    let message = lendable(message);
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
    unsafe { place.write(found) };
    TEXERE_OK
}
