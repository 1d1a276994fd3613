//! Helpers of several tests: the message of the last error, and structs with their size set.

use std::ffi::CStr;

use texere_c::texere_error_message;

/// The error message of the last call of this thread that failed.
pub(crate) fn message() -> String {
    // SAFETY: the library ends it with a zero byte.
    unsafe { CStr::from_ptr(texere_error_message()) }.to_str().unwrap().to_owned()
}

/// A struct of zeros with its size set.
pub(crate) fn sized<T>() -> T {
    // SAFETY: zeros are a value of each of these structs, all of which begin with a `u32`.
    unsafe {
        let mut value: T = std::mem::zeroed();
        (&raw mut value).cast::<u32>().write(size_of::<T>() as u32);
        value
    }
}
