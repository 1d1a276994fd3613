//! Memory that may be refused.

use bytemuck::Zeroable;

use crate::FabricError;

/// `count` zeroed values, from pages that are not touched yet.
pub(crate) fn zeroed<T: Zeroable>(what: &'static str, count: u64) -> Result<Vec<T>, FabricError> {
    let out_of_memory =
        || FabricError::OutOfMemory { what, bytes: count.saturating_mul(size_of::<T>() as u64) };
    let length = usize::try_from(count).map_err(|_| out_of_memory())?;
    bytemuck::allocation::try_zeroed_vec(length).map_err(|()| out_of_memory())
}

/// `count` times `value`.
pub(crate) fn filled<T: Clone>(what: &'static str, count: usize, value: T) -> Result<Vec<T>, FabricError> {
    let mut list = Vec::new();
    room_for(&mut list, count, what)?;
    list.resize(count, value);
    Ok(list)
}

/// Makes sure that `list` can take `count` more.
pub(crate) fn room_for<T>(list: &mut Vec<T>, count: usize, what: &'static str) -> Result<(), FabricError> {
    let bytes = (count as u64).saturating_mul(size_of::<T>() as u64);
    list.try_reserve(count).map_err(|_| FabricError::OutOfMemory { what, bytes })
}
