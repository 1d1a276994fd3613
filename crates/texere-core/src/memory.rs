//! Allocations that return an error if the system refuses them.

use bytemuck::Zeroable;
use thiserror::Error;

use crate::counted;

/// A refused allocation.
///
/// ```
/// use texere_core::OutOfMemory;
/// let refused = OutOfMemory { what: "control points", bytes: 1 << 40 };
/// assert_eq!(refused.to_string(), "out of memory: 1099511627776 bytes for control points");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error("out of memory: {bytes} for {what}", bytes = counted(*.bytes, "byte"))]
pub struct OutOfMemory {
    /// What the memory was for.
    pub what: &'static str,
    /// Number of bytes that were asked for.
    pub bytes: u64,
}

impl OutOfMemory {
    /// The error for `count` values.
    fn of<T>(what: &'static str, count: u64) -> Self {
        Self { what, bytes: count.saturating_mul(size_of::<T>() as u64) }
    }
}

/// A list of `count` zeroed values. Large lists lie in new pages that the system maps only when
/// they are first used.
///
/// **Errors**: [`OutOfMemory`], naming `what`.
///
/// ```
/// let zeros: Vec<u32> = texere_core::backend::zeroed("lifts", 3)?;
/// assert_eq!(zeros, [0; 3]);
/// let refused = texere_core::backend::zeroed::<u32>("lifts", u64::MAX).unwrap_err();
/// assert_eq!((refused.what, refused.bytes), ("lifts", u64::MAX));
/// # Ok::<(), texere_core::OutOfMemory>(())
/// ```
pub fn zeroed<T: Zeroable>(what: &'static str, count: u64) -> Result<Vec<T>, OutOfMemory> {
    let refused = || OutOfMemory::of::<T>(what, count);
    let length = usize::try_from(count).map_err(|_| refused())?;
    bytemuck::allocation::try_zeroed_vec(length).map_err(|()| refused())
}

/// A list of `count` copies of `value`.
///
/// **Errors**: [`OutOfMemory`], naming `what`.
///
/// ```
/// assert_eq!(texere_core::backend::filled("ranks", 3, -1_i32)?, [-1; 3]);
/// # Ok::<(), texere_core::OutOfMemory>(())
/// ```
pub fn filled<T: Clone>(what: &'static str, count: usize, value: T) -> Result<Vec<T>, OutOfMemory> {
    let mut list = room(what, count)?;
    list.resize(count, value);
    Ok(list)
}

/// An empty list with room for `count` values.
///
/// **Errors**: [`OutOfMemory`], naming `what`.
///
/// ```
/// let picks: Vec<u8> = texere_core::backend::room("picks", 9)?;
/// assert!(picks.is_empty() && picks.capacity() >= 9);
/// # Ok::<(), texere_core::OutOfMemory>(())
/// ```
pub fn room<T>(what: &'static str, count: usize) -> Result<Vec<T>, OutOfMemory> {
    let mut list = Vec::new();
    room_for(&mut list, count, what)?;
    Ok(list)
}

/// Makes room in `list` for `count` more values.
///
/// **Errors**: [`OutOfMemory`], naming `what` and the bytes of the whole list. The list then stays
/// as it was.
///
/// ```
/// let mut picks = vec![1_u8];
/// texere_core::backend::room_for(&mut picks, 9, "picks")?;
/// assert!(picks.capacity() >= 10);
/// assert_eq!(texere_core::backend::room_for(&mut picks, usize::MAX, "picks").unwrap_err().what, "picks");
/// # Ok::<(), texere_core::OutOfMemory>(())
/// ```
pub fn room_for<T>(list: &mut Vec<T>, count: usize, what: &'static str) -> Result<(), OutOfMemory> {
    let whole = (list.len() as u64).saturating_add(count as u64);
    list.try_reserve(count).map_err(|_| OutOfMemory::of::<T>(what, whole))
}
