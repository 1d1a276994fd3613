//! The files that readers read: regular files on a disk, or bytes that a program has in memory.
//! Each kind of file has a largest size.

use std::fs::{File, Metadata, OpenOptions};
use std::io::Read;
use std::path::Path;

use texere_core::OutOfMemory;

use super::ReadError;

/// A file of a design, to be read from its start.
#[derive(Debug)]
pub(super) enum Opened {
    /// A file on a disk.
    File(File),
    /// The bytes of a file that a program has in memory.
    Bytes(Vec<u8>),
}

/// Opens the file at a path. The number is the most bytes that the file may have. The first call is
/// for the design's own file, all others are for files that the design names.
pub(super) type Files<'a> = dyn Fn(&Path, u64) -> Result<Opened, ReadError> + 'a;

/// Opens a regular file of at most `limit` bytes. Other kinds of files are refused: a pipe that
/// nothing writes to would block for ever, and a device has no end.
pub(super) fn open(path: &Path, limit: u64) -> Result<Opened, ReadError> {
    let io = |source| ReadError::Io { file: path.into(), source };
    // The check comes before the open, because opening alone can act on a device. It comes again
    // after the open, because the name may stand for another file by then.
    regular(path, &std::fs::metadata(path).map_err(io)?, limit)?;
    let file = options().open(path).map_err(io)?;
    regular(path, &file.metadata().map_err(io)?, limit)?;
    Ok(Opened::File(file))
}

/// Holds the bytes of a file that a program has in memory. More than `limit` bytes are refused.
pub(super) fn held(path: &Path, bytes: Vec<u8>, limit: u64) -> Result<Opened, ReadError> {
    small(path, bytes.len() as u64, limit)?;
    Ok(Opened::Bytes(bytes))
}

/// All bytes of a file. A file of more than `limit` bytes is refused.
pub(super) fn bytes_of(files: &Files<'_>, path: &Path, limit: u64) -> Result<Vec<u8>, ReadError> {
    let file = match files(path, limit)? {
        Opened::Bytes(bytes) => return Ok(bytes),
        Opened::File(file) => file,
    };
    let mut bytes = Vec::new();
    // A byte beyond the limit shows that the file has grown since it was opened.
    let count = file.take(limit + 1).read_to_end(&mut bytes).map_err(|source| match source.kind() {
        std::io::ErrorKind::OutOfMemory => {
            ReadError::OutOfMemory(OutOfMemory { what: "a file that is read", bytes: bytes.len() as u64 })
        }
        _ => ReadError::Io { file: path.into(), source },
    })? as u64;
    small(path, count, limit)?;
    Ok(bytes)
}

fn regular(path: &Path, metadata: &Metadata, limit: u64) -> Result<(), ReadError> {
    if !metadata.is_file() {
        return Err(ReadError::NotAFile { file: path.into(), kind: kind(metadata) });
    }
    small(path, metadata.len(), limit)
}

/// Checks that a file of `bytes` has at most `limit`.
pub(super) fn small(path: &Path, bytes: u64, limit: u64) -> Result<(), ReadError> {
    if bytes > limit {
        return Err(ReadError::TooLarge { file: path.into(), bytes, limit });
    }
    Ok(())
}

#[cfg(unix)]
fn options() -> OpenOptions {
    use std::os::unix::fs::OpenOptionsExt;
    let mut options = File::options();
    // With this flag the open does not block even if a pipe has taken the file's place.
    options.read(true).custom_flags(rustix::fs::OFlags::NONBLOCK.bits().cast_signed());
    options
}

#[cfg(not(unix))]
fn options() -> OpenOptions {
    let mut options = File::options();
    options.read(true);
    options
}

/// The kind of a file that is not a regular one.
fn kind(metadata: &Metadata) -> &'static str {
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;
        let kind = metadata.file_type();
        if kind.is_fifo() {
            return "a pipe";
        } else if kind.is_socket() {
            return "a socket";
        } else if kind.is_char_device() || kind.is_block_device() {
            return "a device";
        }
    }
    if metadata.is_dir() { "a folder" } else { "something else" }
}

/// The name of a design that has no title.
pub(crate) fn file_name(path: &Path) -> String {
    path.file_stem().map_or_else(|| "design".into(), |stem| stem.to_string_lossy().into_owned())
}
