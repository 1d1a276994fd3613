//! Handles: numbers with the type of pointers, and the table of the values that they stand for.
//!
//! A handle is never dereferenced but looked up in the table. A handle that was freed, a handle of
//! another kind and a number that never was a handle are therefore refused with an error.

use std::any::Any;
use std::collections::HashMap;
use std::ptr::{null_mut, without_provenance_mut};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, LazyLock, Mutex, PoisonError, RwLock, TryLockError};

use crate::argument::check;
use crate::failure::Failure;

/// A kind of handle.
pub(crate) trait Handle {
    /// The type of the value that the handle stands for.
    type Value: Any + Send + Sync;
    /// What error messages call a handle of this kind.
    const NAME: &str;
}

type Table = HashMap<usize, Arc<dyn Any + Send + Sync>>;

static TABLE: LazyLock<RwLock<Table>> = LazyLock::new(RwLock::default);

/// Numbers go up and are never given twice, so that a handle that was freed stays unknown.
static NEXT: AtomicUsize = AtomicUsize::new(1);

/// Handles are multiples of this number, as pointers to structs are multiples of an alignment.
const APART: usize = 16;

/// Keeps `value`, and writes its handle to `out`.
///
/// # Safety
///
/// `out` is valid for a write.
pub(crate) unsafe fn give<H: Handle>(out: *mut *mut H, value: H::Value) -> Result<(), Failure> {
    check("out", out)?;
    let number = NEXT.fetch_add(1, Ordering::Relaxed) * APART;
    TABLE.write().unwrap_or_else(PoisonError::into_inner).insert(number, Arc::new(value));
    // SAFETY: the pointer is neither null nor misaligned; the caller vouches for the memory.
    unsafe { out.write(without_provenance_mut(number)) };
    Ok(())
}

/// Makes sure that a handle can be written to `out`, and writes a null handle there. If the call
/// fails later, the null handle stays.
///
/// # Safety
///
/// `out` is valid for a write.
pub(crate) unsafe fn clear<H>(out: *mut *mut H) -> Result<(), Failure> {
    check("out", out)?;
    // SAFETY: the pointer is neither null nor misaligned; the caller vouches for the memory.
    unsafe { out.write(null_mut()) };
    Ok(())
}

/// The value that a handle stands for.
pub(crate) fn get<H: Handle>(handle: *const H) -> Result<Arc<H::Value>, Failure> {
    if handle.is_null() {
        return Err(Failure::argument(format!("the {} is null", H::NAME)));
    }
    let table = TABLE.read().unwrap_or_else(PoisonError::into_inner);
    let value = table.get(&handle.addr()).cloned();
    drop(table);
    value
        .and_then(|value| value.downcast().ok())
        .ok_or_else(|| Failure::argument(format!("the {} was freed already, or is no {}", H::NAME, H::NAME)))
}

/// The value that a handle stands for, or `None` for a null handle.
pub(crate) fn get_any<H: Handle>(handle: *const H) -> Result<Option<Arc<H::Value>>, Failure> {
    if handle.is_null() { Ok(None) } else { get(handle).map(Some) }
}

/// Does `work` with the value that a handle stands for. Fails if a call of another thread is using
/// that value. It does not wait for that call, because a program that uses one such handle on two
/// threads at a time is at fault.
pub(crate) fn alone<H, T, R>(
    handle: *const H,
    work: impl FnOnce(&mut T) -> Result<R, Failure>,
) -> Result<R, Failure>
where
    H: Handle<Value = Mutex<T>>,
{
    let value = get(handle)?;
    let mut held = match value.try_lock() {
        Ok(held) => held,
        Err(TryLockError::Poisoned(held)) => held.into_inner(),
        Err(TryLockError::WouldBlock) => {
            return Err(Failure::argument(format!("the {} is in use by another thread", H::NAME)));
        }
    };
    work(&mut held)
}

/// Forgets a handle. One that is null, was freed already or is of another kind is left alone.
pub(crate) fn free<H: Handle>(handle: *mut H) {
    let mut table = TABLE.write().unwrap_or_else(PoisonError::into_inner);
    if table.get(&handle.addr()).is_some_and(|value| value.is::<H::Value>()) {
        let value = table.remove(&handle.addr());
        drop(table);
        // To drop a large value takes a while, so the table is unlocked first. If dropping panics,
        // in a driver for example, the panic ends here.
        let _ = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| drop(value)));
    }
}
