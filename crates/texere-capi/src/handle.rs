//! Handles: numbers in the shape of pointers, and what they stand for.
//!
//! A handle is never followed. It is looked up in a table, so one that was freed, that is of
//! another kind, or that is any number at all ends in an error.

use std::any::Any;
use std::collections::HashMap;
use std::ptr::{null_mut, without_provenance_mut};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, LazyLock, Mutex, PoisonError, RwLock, TryLockError};

use crate::argument::check;
use crate::failure::Failure;

/// A kind of handle.
pub(crate) trait Handle {
    /// What it stands for.
    type Value: Any + Send + Sync;
    /// What an error calls it.
    const NAME: &str;
}

type Table = HashMap<usize, Arc<dyn Any + Send + Sync>>;

static TABLE: LazyLock<RwLock<Table>> = LazyLock::new(RwLock::default);

/// Numbers go up and are never given twice, so that a handle that was freed stays unknown.
static NEXT: AtomicUsize = AtomicUsize::new(1);

/// Handles lie as far apart as pointers of any struct do.
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
    // SAFETY: neither null nor misaligned; the caller vouches for the rest.
    unsafe { out.write(without_provenance_mut(number)) };
    Ok(())
}

/// Makes sure that a handle can be written to `out`, and writes a null one, which stays where the
/// call fails.
///
/// # Safety
///
/// `out` is valid for a write.
pub(crate) unsafe fn clear<H>(out: *mut *mut H) -> Result<(), Failure> {
    check("out", out)?;
    // SAFETY: neither null nor misaligned; the caller vouches for the rest.
    unsafe { out.write(null_mut()) };
    Ok(())
}

/// What a handle stands for.
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

/// What a handle stands for, or none for a null one.
pub(crate) fn get_any<H: Handle>(handle: *const H) -> Result<Option<Arc<H::Value>>, Failure> {
    if handle.is_null() { Ok(None) } else { get(handle).map(Some) }
}

/// Does `work` with what a handle stands for. No other thread may be using it: there is no waiting,
/// since two threads that change one thing in turn are a fault of the program.
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
        // What it holds may be large: the table is open again while it is dropped. A fault in a
        // driver that it calls is not the caller's.
        let _ = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| drop(value)));
    }
}
