//! Huge pages for new memory. The page faults of small pages would take ten times as long as the
//! work that fills the memory.
#![cfg_attr(target_os = "linux", allow(unsafe_code, reason = "tells the system about a range of memory"))]

/// Asks the system for huge pages for `memory`. Pages that have been touched already stay as they
/// are. The function is for memory of some megabytes that is new, and about to be filled.
///
/// ```
/// let mut vertices = vec![0.0_f32; 1 << 22];
/// texere_cpu::prefer_huge(&vertices);
/// vertices.fill(1.0);
/// ```
///
/// The range is widened at both ends to whole ordinary pages of the largest size. If memory is
/// filled chunk by chunk, the ranges of all chunks then join to one. This matters because a huge
/// page has to lie within one range. Memory of less than 64 kB is left as it is.
#[cfg(target_os = "linux")]
pub fn prefer_huge<T: bytemuck::Pod>(memory: &[T]) {
    use rustix::mm::{Advice, madvise};
    /// The largest ordinary page of the Linux systems for x86-64 and arm64, bytes. The sizes of all
    /// their ordinary pages divide it.
    const PAGE: usize = 64 << 10;
    let bytes = size_of_val(memory);
    if bytes < PAGE {
        return;
    }
    let before = memory.as_ptr().addr() % PAGE;
    let start = memory.as_ptr().cast_mut().wrapping_byte_sub(before).cast();
    // SAFETY: the advice changes nothing of what any memory holds. If the system refuses it, pages
    // stay small, so the answer does not matter.
    let _ = unsafe { madvise(start, (before + bytes).next_multiple_of(PAGE), Advice::LinuxHugepage) };
}

/// Other systems choose their pages themselves.
#[cfg(not(target_os = "linux"))]
pub fn prefer_huge<T: bytemuck::Pod>(_memory: &[T]) {}
