//! Faults of a knitting program.

/// A fault of a knitting program: a step that a machine can't do, or a step that may be a mistake.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MachineFault {
    /// The place in the program, and the fault.
    pub message: String,
    /// Whether the step can't be done by a machine. If false, the program can be knitted, but the
    /// cloth may not be what was meant.
    pub is_error: bool,
}
