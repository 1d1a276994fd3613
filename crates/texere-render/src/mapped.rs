//! A mapped buffer, read by the host.

use texere_core::BackendError;
use texere_wgpu::WgpuBackend;

/// What `read` makes of `buffer`. The submission that asked for it to be mapped has to be done.
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
