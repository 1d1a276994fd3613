//! Places in a knitting program.

/// The place in a knitting program that a piece of yarn comes from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ProgramPlace {
    /// The line of a knitout file, or the cell of a chart.
    pub place: String,
    /// The instructions in that line or cell, as knitout writes them, with their carriers.
    pub instructions: Vec<String>,
}
