//! Memory that nobody has touched yet: a fault for each small page costs ten times the work that
//! fills it.
#![cfg_attr(target_os = "linux", allow(unsafe_code, reason = "tells the system about a range of memory"))]

/// Asks the system for huge pages where `memory` has not been touched yet. What has been stays as
/// it is.
#[cfg(target_os = "linux")]
pub(crate) fn prefer_huge<T: bytemuck::Pod>(memory: &[T]) {
    use rustix::mm::{Advice, madvise};
    /// The size of every page that is not huge is a power of two up to this: the largest on any
    /// Linux system.
    const PAGE: usize = 64 << 10;
    let memory: &[u8] = bytemuck::cast_slice(memory);
    let start = memory.as_ptr().align_offset(PAGE);
    if let Some(whole) = memory.get(start..) {
        // SAFETY: the range is memory of ours, and the advice changes nothing of what it holds.
        // Where the system does not take it, pages stay small, which is why the answer does not
        // matter.
        let _ = unsafe {
            madvise(whole.as_ptr().cast_mut().cast(), whole.len() / PAGE * PAGE, Advice::LinuxHugepage)
        };
    }
}

/// Other systems choose their pages themselves.
#[cfg(not(target_os = "linux"))]
pub(crate) fn prefer_huge<T: bytemuck::Pod>(_memory: &[T]) {}
