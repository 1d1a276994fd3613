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

/// What a thread keeps of the last of its calls that failed.
#[derive(Default)]
struct Last {
    message: CString,
    place: Option<Place>,
}

thread_local! {
    static LAST: RefCell<Last> = RefCell::default();
}

/// Runs `call`, the work of a function of the header. An error or a panic becomes the last failure
/// of this thread. No panic leaves the library.
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

/// What went wrong in the last call of this thread that failed, with all causes: UTF-8 that ends
/// with a zero byte. The text is empty if no call of this thread has failed. It is valid until the
/// next call of this thread fails.
#[unsafe(no_mangle)]
pub extern "C" fn texere_error_message() -> *const c_char {
    LAST.with_borrow(|last| last.message.as_ptr())
}

/// A place in a design's file.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_place {
    /// The file's name, UTF-8 that ends with a zero byte; null if the error has no place. The name
    /// is valid until the next call of this thread fails.
    pub file: *const c_char,
    /// The line, counted from 1; 0 if it is not known.
    pub line: u64,
    /// The column, in letters counted from 1; 0 if it is not known.
    pub column: u64,
}

/// Writes where the last failure of this thread lies: its place in a design's file.
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
    // SAFETY: not null and aligned; the caller vouches for the memory.
    unsafe { place.write(found) };
    TEXERE_OK
}
