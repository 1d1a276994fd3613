//! Huge pages for new memory. The page faults of small pages would take ten times as long as the
//! work that fills the memory.
#![cfg_attr(target_os = "linux", allow(unsafe_code, reason = "tells the system about a range of memory"))]

/// Asks the system for huge pages for `memory`. Pages that have been touched already stay as they
/// are.
#[cfg(target_os = "linux")]
pub(crate) fn prefer_huge<T: bytemuck::Pod>(memory: &[T]) {
    use rustix::mm::{Advice, madvise};
    /// The largest ordinary page of any Linux system, bytes. Every ordinary page's size divides it.
    const PAGE: usize = 64 << 10;
    let memory: &[u8] = bytemuck::cast_slice(memory);
    let start = memory.as_ptr().align_offset(PAGE);
    if let Some(whole) = memory.get(start..) {
        // SAFETY: the range lies within `memory`, and the advice changes no value in it. If the
        // system refuses the advice, pages stay small, so the answer does not matter.
        let _ = unsafe {
            madvise(whole.as_ptr().cast_mut().cast(), whole.len() / PAGE * PAGE, Advice::LinuxHugepage)
        };
    }
}

/// Other systems choose their pages themselves.
#[cfg(not(target_os = "linux"))]
pub(crate) fn prefer_huge<T: bytemuck::Pod>(_memory: &[T]) {}
