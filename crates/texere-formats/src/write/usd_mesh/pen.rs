//! Writes text at one of several places of a file.

use std::io::{Seek, Write};

use crate::write::WriteError;
use crate::write::target::Target;

/// Bytes that a pen gathers. A pen that wrote each ring at once would make two calls of the system
/// for some hundred bytes.
const BYTES: usize = 1 << 17;

/// Text for a place of a file that is written in several places.
#[derive(Debug, Default)]
pub(super) struct Pen {
    /// The byte of the file at which the text begins.
    at: u64,
    text: String,
}

impl Pen {
    /// Lets `write` add text that begins at byte `at` of the file.
    pub(super) fn write<W: Write + Seek>(
        &mut self,
        target: &mut Target<W>,
        at: u64,
        write: impl FnOnce(&mut String),
    ) -> Result<(), WriteError> {
        if self.text.len() >= BYTES || at != self.at + self.text.len() as u64 {
            self.lift(target)?;
            self.at = at;
        }
        write(&mut self.text);
        Ok(())
    }

    /// Writes the text that has been gathered to the file.
    pub(super) fn lift<W: Write + Seek>(&mut self, target: &mut Target<W>) -> Result<(), WriteError> {
        if !self.text.is_empty() {
            target.go_to(self.at)?;
            target.write(self.text.as_bytes())?;
            self.text.clear();
        }
        Ok(())
    }
}
