//! Faults of a knitting program.

/// A fault of a knitting program: a step that a machine can't do, or a step that may be a mistake.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MachineFault {
    /// The place in the program, and the fault.
    pub message: String,
    /// Whether a machine can't do the step. If false, a machine can do it, but the cloth may not be
    /// what was meant.
    pub is_error: bool,
}
