//! Memory that may be refused.

use super::ReadError;

/// `count` values, each `value`, where there is memory for them.
pub(super) fn filled<T: Clone>(what: &'static str, count: usize, value: T) -> Result<Vec<T>, ReadError> {
    let mut values = room(what, count)?;
    values.resize(count, value);
    Ok(values)
}

/// Room for `count` values, where there is memory for them.
pub(super) fn room<T>(what: &'static str, count: usize) -> Result<Vec<T>, ReadError> {
    let mut values = Vec::new();
    let bytes = (count as u64).saturating_mul(size_of::<T>() as u64);
    values.try_reserve_exact(count).map_err(|_| ReadError::OutOfMemory { what, bytes })?;
    Ok(values)
}
