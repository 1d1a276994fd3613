//! The file under way: beside its target until it is whole.

use std::fs::{self, Metadata};
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use super::WriteError;

/// Bytes gathered before the system is called: calls cost nothing beside the copying from here on.
const BUFFER_BYTES: usize = 1 << 18;

/// A file that takes its place only when it is whole: until [`Target::commit`] it lies under another name in the same
/// folder, and goes with its owner.
#[derive(Debug)]
pub(super) struct Target<W: Write + Seek> {
    path: PathBuf,
    out: BufWriter<W>,
    position: u64,
}

impl<W: Write + Seek> Target<W> {
    /// A target that is written to `out`, which stands at its start.
    pub(super) fn over(out: W, path: &Path) -> Self {
        Self { path: path.to_owned(), out: BufWriter::with_capacity(BUFFER_BYTES, out), position: 0 }
    }

    /// What went wrong on the way to the file.
    pub(super) fn failed(&self, source: io::Error) -> WriteError {
        failed("write", &self.path, source)
    }

    /// Writes on from where the last call ended.
    pub(super) fn write(&mut self, bytes: &[u8]) -> Result<(), WriteError> {
        self.out.write_all(bytes).map_err(|source| self.failed(source))?;
        self.position += bytes.len() as u64;
        Ok(())
    }

    /// Writes words in little-endian order, whatever the machine's own.
    pub(super) fn write_words(&mut self, words: &[u32]) -> Result<(), WriteError> {
        for batch in words.chunks(BUFFER_BYTES / 4) {
            let little: Vec<u32> = batch.iter().map(|word| word.to_le()).collect();
            self.write(bytemuck::cast_slice(&little))?;
        }
        Ok(())
    }

    /// Goes to byte `position`, where the next call writes.
    pub(super) fn go_to(&mut self, position: u64) -> Result<(), WriteError> {
        if position != self.position {
            self.out.seek(SeekFrom::Start(position)).map_err(|source| self.failed(source))?;
            self.position = position;
        }
        Ok(())
    }

    /// Hands on what is still in the buffer and gives back what was written to.
    pub(super) fn into_inner(self) -> Result<W, WriteError> {
        let Self { path, out, .. } = self;
        out.into_inner().map_err(|error| failed("write", &path, error.into_error()))
    }
}

/// For encoders that write by themselves.
impl<W: Write + Seek> Write for Target<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.out.write(bytes)?;
        self.position += count as u64;
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

impl Target<NamedTempFile> {
    /// Starts a file that is to become `path`; where that is a symbolic link, what it points to.
    pub(super) fn create(path: &Path) -> Result<Self, WriteError> {
        let place = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        let old = fs::metadata(&place).ok();
        let file = old
            .as_ref()
            .map_or(Ok(()), replaceable)
            .and_then(|()| beside(&place, old.as_ref()))
            .map_err(|source| failed("create", path, source))?;
        Ok(Self { path: place, ..Self::over(file, path) })
    }

    /// Puts the file in its place, in one step that can't be seen half done. Gives its length in bytes.
    pub(super) fn commit(self) -> Result<u64, WriteError> {
        let path = self.path.clone();
        let file = self.into_inner()?;
        // A name must not reach the disk before the bytes that it stands for.
        let synced = file.as_file().sync_all().and_then(|()| file.as_file().metadata());
        let bytes = synced.map_err(|source| failed("write", &path, source))?.len();
        file.persist(&path).map_err(|error| failed("rename", &path, error.error))?;
        Ok(bytes)
    }
}

fn failed(action: &'static str, path: &Path, source: io::Error) -> WriteError {
    WriteError::Io { action, path: path.to_owned(), source }
}

/// Whether what lies at the target may be replaced: a rename would also take the place of a device or, on Unix, of a
/// file that its owner has write-protected.
fn replaceable(old: &Metadata) -> io::Result<()> {
    if old.is_dir() {
        Err(io::ErrorKind::IsADirectory.into())
    } else if !old.is_file() {
        Err(io::Error::new(io::ErrorKind::InvalidInput, "not a regular file"))
    } else if old.permissions().readonly() {
        Err(io::Error::new(io::ErrorKind::PermissionDenied, "read-only file"))
    } else {
        Ok(())
    }
}

/// A temporary file in the folder of `place`, since only within one file system a rename is a single step.
fn beside(place: &Path, old: Option<&Metadata>) -> io::Result<NamedTempFile> {
    let folder = place.parent().filter(|folder| !folder.as_os_str().is_empty());
    let mut builder = tempfile::Builder::new();
    builder.prefix(".texere-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // What any new file has, less the umask: the result is no secret, as temporary files are by default.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    let file = builder.tempfile_in(folder.unwrap_or(Path::new(".")))?;
    if let Some(old) = old {
        file.as_file().set_permissions(old.permissions())?;
    }
    Ok(file)
}
