//! Faults of a knitting program.

/// A fault of a knitting program: a thing that a machine can't do, or that a knitter would not want
/// it to do.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MachineFault {
    /// The place in the program, and the fault.
    pub message: String,
    /// Whether a machine could not do it. If false, the program can be knitted, but the cloth may
    /// not be what was meant.
    pub is_error: bool,
}
