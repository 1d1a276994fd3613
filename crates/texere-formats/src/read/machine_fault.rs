//! Faults of a knitting program.

/// What a knitting machine could not do, or a knitter would not want it to do.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MachineFault {
    /// The place in the program, and the fault.
    pub message: String,
    /// Whether a machine could not do it. A fault that is no error can be knitted, but the cloth
    /// may not be what was meant.
    pub is_error: bool,
}
