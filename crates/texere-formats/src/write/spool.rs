//! Bytes whose place in a file is not known yet.

use std::io::{self, Seek, Write};
use std::path::Path;

use tempfile::SpooledTempFile;

use super::WriteError;
use super::target::Target;

/// The most bytes that a spool keeps in memory. Further bytes go to a file without a name, which
/// the system removes even if the process is killed.
const MEMORY_BYTES: usize = 1 << 20;

/// Bytes of a file that wait until it is known how many bytes stand before them.
#[derive(Debug)]
pub(super) struct Spool {
    bytes: Target<SpooledTempFile>,
}

impl Spool {
    /// An empty spool for the file at `path`. If the spool needs a file of its own, that file lies
    /// in the folder of `path`, on a disk that has to hold the bytes anyway. Without a `path` it
    /// lies in the system's folder for temporary files.
    pub(super) fn beside(path: Option<&Path>) -> Self {
        let file = match path {
            Some(path) => {
                let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
                tempfile::spooled_tempfile_in(MEMORY_BYTES, folder.unwrap_or(Path::new(".")))
            }
            None => tempfile::spooled_tempfile(MEMORY_BYTES),
        };
        Self { bytes: Target::over(file, 0, path.map(Path::to_owned)) }
    }

    /// The number of bytes.
    pub(super) fn len(&self) -> u64 {
        self.bytes.position()
    }

    /// The error for a write that failed.
    pub(super) fn failed(&self, source: io::Error) -> WriteError {
        self.bytes.failed(source)
    }

    /// Writes all bytes to `target`.
    pub(super) fn write_to<W: Write>(self, target: &mut Target<W>) -> Result<(), WriteError> {
        let mut file = self.bytes.into_inner()?;
        let copied = file.rewind().and_then(|()| io::copy(&mut file, target));
        copied.map(drop).map_err(|source| target.failed(source))
    }
}

impl Write for Spool {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        Write::write(&mut self.bytes, bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.bytes.flush()
    }
}
