//! What tests of the library share: the last error's words, and structs that say their size.

use std::ffi::CStr;

use texere_c::texere_error_message;

/// The words of the last call of this thread that failed.
pub(crate) fn message() -> String {
    // SAFETY: the library ends it with a zero byte.
    unsafe { CStr::from_ptr(texere_error_message()) }.to_str().unwrap().to_owned()
}

/// A struct of zeros that says its size.
pub(crate) fn sized<T>() -> T {
    // SAFETY: zeros are a value of each of these structs, all of which begin with a `u32`.
    unsafe {
        let mut value: T = std::mem::zeroed();
        (&raw mut value).cast::<u32>().write(size_of::<T>() as u32);
        value
    }
}
