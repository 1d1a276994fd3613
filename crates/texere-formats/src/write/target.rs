//! The file under way, by its bytes.

use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use super::unfinished::Unfinished;
use super::{Output, WriteError};

/// Bytes gathered before the system is called: calls cost nothing beside the copying from here on.
const BUFFER_BYTES: usize = 1 << 18;

/// A file that is written piece by piece, and takes its place only when it is whole.
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
        WriteError::io("write", &self.path, source)
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
        out.into_inner().map_err(|error| WriteError::io("write", &path, error.into_error()))
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

impl Target<Unfinished> {
    /// Starts the file that is to become `output`.
    pub(super) fn create(output: Output) -> Result<Self, WriteError> {
        let file = Unfinished::beside(output.place()?)?;
        let path = file.path().to_owned();
        Ok(Self::over(file, &path))
    }

    /// Puts the file in its place. Gives its length in bytes.
    pub(super) fn commit(self) -> Result<u64, WriteError> {
        self.into_inner()?.finish()
    }
}
