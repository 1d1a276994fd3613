//! Reading a mapped buffer on the host.

use texere_core::BackendError;
use texere_wgpu::WgpuBackend;

/// The result of `read` for the contents of `buffer`. The device must have finished the submission
/// that the mapping of `buffer` waits for.
pub(crate) fn read_mapped<T>(
    device: &WgpuBackend,
    buffer: &wgpu::Buffer,
    read: impl FnOnce(&[u8]) -> T,
) -> Result<T, BackendError> {
    let call = "Buffer::get_mapped_range";
    device
        .scoped(call, || buffer.get_mapped_range(..).map(|view| read(&view)))?
        .map_err(|source| BackendError::Driver { call, source: source.into() })
}
