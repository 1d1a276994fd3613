//! Places on yarns in a designer's words.

use std::fmt;

use texere_fabric::ThreadPlace;

use super::program_place::ProgramPlace;

/// A place on a yarn in a designer's words. It is written as `end 3 at pick 4, cotton`. In a weft
/// knit the [place in the program](ProgramPlace) follows.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedPlace {
    /// The thread, and the crossing or the stitch.
    pub thread: ThreadPlace,
    /// The name of the yarn's material, perhaps empty.
    pub material: String,
    /// The place in a weft knit's program from which the yarn comes. None if there is no program,
    /// or if the place has no source.
    pub program: Option<ProgramPlace>,
}

impl fmt::Display for NamedPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.thread)?;
        if !self.material.is_empty() {
            write!(f, ", {}", self.material)?;
        }
        if let Some(ProgramPlace { place, instructions }) = &self.program {
            write!(f, ": {place}")?;
            if !instructions.is_empty() {
                write!(f, ": {}", instructions.join("; "))?;
            }
        }
        Ok(())
    }
}
