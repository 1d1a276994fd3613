//! A buffered file that is being written.

use std::io::{self, Seek, SeekFrom, Write};
#[cfg(any(feature = "glb", feature = "obj"))]
use std::path::Path;
use std::path::PathBuf;

use super::unfinished::Unfinished;
use super::{Output, WriteError};

/// Bytes that are gathered before a call of the system. A larger buffer gains nothing: at this size
/// the fixed cost of a call is small beside that of copying the bytes.
const BUFFER_BYTES: usize = 1 << 18;

/// A file that is written piece by piece. It either takes the place of its output when it is
/// complete, or goes to a writer of the caller's.
#[derive(Debug)]
pub(super) struct Target<W: Write> {
    /// The path that was asked for. None if the writer is the caller's.
    path: Option<PathBuf>,
    out: W,
    /// The position of `out` at which the file began, bytes.
    start: u64,
    /// Bytes that are not yet in `out`. Without memory for this buffer, every write goes straight
    /// to `out`.
    waiting: Vec<u8>,
    /// The position of the next write, bytes from the file's start.
    position: u64,
    /// The furthest byte written so far, from the file's start.
    end: u64,
}

impl<W: Write> Target<W> {
    /// A target that is written to `out` from its current position on, which is byte `start`.
    pub(super) fn over(out: W, start: u64, path: Option<PathBuf>) -> Self {
        let mut waiting = Vec::new();
        let _ = waiting.try_reserve_exact(BUFFER_BYTES);
        Self { path, out, start, waiting, position: 0, end: 0 }
    }

    /// A target that is written from its first byte to its last, to the caller's `out`.
    pub(super) fn straight(out: W) -> Self {
        Self::over(out, 0, None)
    }

    /// The path that was asked for. None if the writer is the caller's.
    #[cfg(any(feature = "glb", feature = "obj"))]
    pub(super) fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// The error for a write that failed.
    pub(super) fn failed(&self, source: io::Error) -> WriteError {
        match &self.path {
            Some(path) => WriteError::io("write", path, source),
            None => WriteError::Writer { source },
        }
    }

    /// Writes at the current position.
    pub(super) fn write(&mut self, bytes: &[u8]) -> Result<(), WriteError> {
        self.write_all(bytes).map_err(|source| self.failed(source))
    }

    /// Writes words in little-endian order, whatever the machine's own order is.
    pub(super) fn write_words(&mut self, words: &[u32]) -> Result<(), WriteError> {
        let mut little = [0; 1024];
        for batch in words.chunks(little.len()) {
            for (place, word) in little.iter_mut().zip(batch) {
                *place = word.to_le();
            }
            self.write(bytemuck::cast_slice(&little[..batch.len()]))?;
        }
        Ok(())
    }

    /// Writes the bytes that are still in the buffer, and gives back the inner writer.
    pub(super) fn into_inner(mut self) -> Result<W, WriteError> {
        self.flush().map_err(|source| self.failed(source))?;
        Ok(self.out)
    }

    /// Writes the bytes that are still in the buffer to the caller's writer. Returns the file's
    /// length in bytes.
    pub(super) fn done(mut self) -> Result<u64, WriteError> {
        self.flush().and_then(|()| self.out.flush()).map_err(|source| self.failed(source))?;
        Ok(self.end)
    }
}

impl<W: Write + Seek> Target<W> {
    /// A target that is written to the caller's `out`, from the current position of `out` on.
    pub(super) fn within(mut out: W) -> Result<Self, WriteError> {
        let start = out.stream_position().map_err(|source| WriteError::Writer { source })?;
        Ok(Self::over(out, start, None))
    }

    /// The byte of the file at which the next call writes.
    pub(super) fn position(&self) -> u64 {
        self.position
    }

    /// Goes to byte `position` of the file, where the next call writes.
    pub(super) fn go_to(&mut self, position: u64) -> Result<(), WriteError> {
        if position != self.position {
            let moved = self.flush().and_then(|()| self.out.seek(SeekFrom::Start(self.start + position)));
            moved.map_err(|source| self.failed(source))?;
            self.position = position;
        }
        Ok(())
    }

    /// Writes the bytes that are still in the buffer to the caller's writer, and moves the writer
    /// behind the file's last byte. Returns the file's length in bytes.
    pub(super) fn close(mut self) -> Result<u64, WriteError> {
        self.go_to(self.end)?;
        self.done()
    }
}

impl<W: Write> Write for Target<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.write_all(bytes)?;
        Ok(bytes.len())
    }

    fn write_all(&mut self, bytes: &[u8]) -> io::Result<()> {
        let room = self.waiting.capacity() - self.waiting.len();
        if bytes.len() > room {
            self.flush()?;
        }
        if bytes.len() < self.waiting.capacity() {
            self.waiting.extend_from_slice(bytes);
        } else {
            self.out.write_all(bytes)?;
        }
        self.position += bytes.len() as u64;
        self.end = self.end.max(self.position);
        Ok(())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.write_all(&self.waiting)?;
        self.waiting.clear();
        Ok(())
    }
}

impl Target<Unfinished> {
    /// Starts the file that is to become `output`.
    pub(super) fn create(output: Output) -> Result<Self, WriteError> {
        let file = Unfinished::beside(output.place()?)?;
        let path = file.path().to_owned();
        Ok(Self::over(file, 0, Some(path)))
    }

    /// Brings all bytes to the disk, and looks whether the file may still take its place.
    pub(super) fn settle(&mut self) -> Result<(), WriteError> {
        self.flush().map_err(|source| self.failed(source))?;
        self.out.settle()
    }

    /// Puts the file in its place. Returns the file's length in bytes.
    pub(super) fn commit(self) -> Result<u64, WriteError> {
        self.into_inner()?.finish()
    }
}
