//! What C passes: pointers, texts, structs that say their size.

use std::ffi::c_char;

use crate::failure::Failure;

/// Makes sure that a pointer is neither null nor misaligned. `name` is the argument's.
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

/// `count` values of the caller's. A null pointer is none, where `count` is 0.
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
    // SAFETY: neither null nor misaligned nor too long; the caller vouches for the rest.
    Ok(unsafe { std::slice::from_raw_parts(pointer, count) })
}

/// `count` values of the caller's that are written.
///
/// # Safety
///
/// `pointer` is valid for writes of `count` values, which nobody else uses as long as the result
/// lives.
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
    // SAFETY: neither null nor misaligned nor too long; the caller vouches for the rest.
    Ok(unsafe { std::slice::from_raw_parts_mut(pointer, count) })
}

/// Makes sure that `count` values are no more than a program's memory can hold.
fn fits<T>(name: &str, count: usize) -> Result<(), Failure> {
    match count.checked_mul(size_of::<T>()) {
        Some(bytes) if isize::try_from(bytes).is_ok() => Ok(()),
        _ => Err(Failure::argument(format!("{name} has {count} values, more than memory can hold"))),
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

/// Makes sure that a struct of the caller's says the size that it has.
///
/// # Safety
///
/// `pointer` is valid for reads of a `u32`.
pub(crate) unsafe fn check_sized<T>(name: &str, pointer: *const T) -> Result<(), Failure> {
    check(name, pointer)?;
    // SAFETY: neither null nor misaligned for `T`, which begins with a `u32`.
    let given = unsafe { pointer.cast::<u32>().read() };
    let size = size_of::<T>();
    if given as usize != size {
        return Err(Failure::argument(format!(
            "{name}.struct_size is {given}, and this library takes {size}"
        )));
    }
    Ok(())
}

/// A struct of the caller's that says its size.
///
/// # Safety
///
/// `pointer` is valid for reads of a `u32`, and of as many bytes as that says.
pub(crate) unsafe fn sized<T: Copy>(name: &str, pointer: *const T) -> Result<T, Failure> {
    // SAFETY: the caller vouches for it.
    unsafe { check_sized(name, pointer) }?;
    // SAFETY: it has the size of `T`, and is neither null nor misaligned.
    Ok(unsafe { pointer.read() })
}

/// Makes sure that there is a callback.
pub(crate) fn given<F>(callback: Option<F>) -> Result<F, Failure> {
    callback.ok_or_else(|| Failure::argument("callback is null"))
}
