//! Checks of what C passes: pointers and texts.

use std::ffi::{CStr, c_char};

use crate::failure::Failure;

/// Makes sure that a pointer is neither null nor misaligned. `name` is the argument's name in the
/// error message.
pub(crate) fn check<T>(name: &str, pointer: *const T) -> Result<(), Failure> {
    if pointer.is_null() {
        return Err(Failure::argument(format!("{name} is null")));
    }
    if !pointer.is_aligned() {
        let align = align_of::<T>();
        return Err(Failure::argument(format!("{name} is not a multiple of {align} bytes")));
    }
    Ok(())
}

/// The `count` values that a pointer of the caller's points to. The pointer may be null if `count`
/// is 0.
///
/// # Safety
///
/// `pointer` is valid for reads of `count` values as long as the result lives.
pub(crate) unsafe fn slice<'a, T>(name: &str, pointer: *const T, count: usize) -> Result<&'a [T], Failure> {
    if count == 0 {
        return Ok(&[]);
    }
    check(name, pointer)?;
    fits::<T>(name, count)?;
    // SAFETY: the pointer is neither null nor misaligned, and `count` is not too large; the caller
    // vouches for the memory.
    Ok(unsafe { std::slice::from_raw_parts(pointer, count) })
}

/// The `count` values that a pointer of the caller's points to, to be written.
///
/// # Safety
///
/// `pointer` is valid for writes of `count` values. Nothing else uses the values as long as the
/// result lives.
pub(crate) unsafe fn slice_mut<'a, T>(
    name: &str,
    pointer: *mut T,
    count: usize,
) -> Result<&'a mut [T], Failure> {
    if count == 0 {
        return Ok(&mut []);
    }
    check(name, pointer)?;
    fits::<T>(name, count)?;
    // SAFETY: the pointer is neither null nor misaligned, and `count` is not too large; the caller
    // vouches for the memory.
    Ok(unsafe { std::slice::from_raw_parts_mut(pointer, count) })
}

/// Makes sure that `count` values are no more than a program's memory can hold.
fn fits<T>(name: &str, count: usize) -> Result<(), Failure> {
    match count.checked_mul(size_of::<T>()) {
        Some(bytes) if isize::try_from(bytes).is_ok() => Ok(()),
        _ => Err(Failure::argument(format!("{name} has {count} values, more than memory can hold"))),
    }
}

/// A truth value of the caller's: 0 or 1.
pub(crate) fn flag(name: &str, value: u32) -> Result<bool, Failure> {
    match value {
        0 => Ok(false),
        1 => Ok(true),
        other => Err(Failure::argument(format!("{name} is {other}, expected 0 or 1"))),
    }
}

/// A text of the caller's.
///
/// # Safety
///
/// `pointer` is valid for reads of `length` bytes as long as the result lives.
pub(crate) unsafe fn text<'a>(name: &str, pointer: *const c_char, length: usize) -> Result<&'a str, Failure> {
    // SAFETY: the caller vouches for it.
    let bytes = unsafe { slice(name, pointer.cast::<u8>(), length) }?;
    str::from_utf8(bytes).map_err(|error| Failure::argument(format!("{name} is not UTF-8: {error}")))
}

/// Makes sure that a callback is not null.
pub(crate) fn given<F>(callback: Option<F>) -> Result<F, Failure> {
    callback.ok_or_else(|| Failure::argument("callback is null"))
}

/// Lends a text: writes its address to `to`. `name` is the argument's name in the error message.
///
/// # Safety
///
/// `to` is valid for a write.
pub(crate) unsafe fn lend(name: &str, text: &CStr, to: *mut *const c_char) -> Result<(), Failure> {
    check(name, to)?;
    // SAFETY: the pointer is neither null nor misaligned; the caller vouches for the memory.
    unsafe { to.write(text.as_ptr()) };
    Ok(())
}

/// Element `number` of `all`, counted from 0. `name` is what the error message calls an element.
pub(crate) fn numbered<'a, T>(name: &str, all: &'a [T], number: u64) -> Result<&'a T, Failure> {
    let found = usize::try_from(number).ok().and_then(|number| all.get(number));
    found.ok_or_else(|| Failure::argument(format!("{name} {number}, but there are {}, from 0", all.len())))
}

/// Writes the length of `text`, without a zero byte, to `length`, and the text, followed by a zero
/// byte, to `words`, which has room for `size` bytes. If `size` is 0, only the length is written.
/// If `size` is too small, the length is written, too, and the call fails.
///
/// # Safety
///
/// `length` is valid for a write, and `words` for writes of `size` bytes.
pub(crate) unsafe fn write_text(
    text: &str,
    words: *mut c_char,
    size: usize,
    length: *mut usize,
) -> Result<(), Failure> {
    check("length", length)?;
    // SAFETY: the caller vouches for it.
    let room = unsafe { slice_mut("words", words.cast::<u8>(), size) }?;
    // SAFETY: the pointer is neither null nor misaligned; the caller vouches for the memory.
    unsafe { length.write(text.len()) };
    if size == 0 {
        return Ok(());
    }
    let needed = text.len() + 1;
    let Some((zero, letters)) = room.get_mut(..needed).and_then(<[u8]>::split_last_mut) else {
        return Err(Failure::argument(format!("size is {size}, and the text needs {needed} bytes")));
    };
    letters.copy_from_slice(text.as_bytes());
    *zero = 0;
    Ok(())
}
