//! How a call ended.

/// How a call ended.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum texere_status {
    /// The call did what it is for.
    TEXERE_OK = 0,
    /// An argument is refused: a null or misaligned pointer, a wrong size, a value out of its
    /// range, or a handle that was freed, is of another kind, is in use by another thread or is not
    /// ready for the call.
    TEXERE_ARGUMENT = 1,
    /// A file holds no design or no yarns, or the cloth of a design can't be made.
    TEXERE_DESIGN = 2,
    /// There is no such device, or it failed.
    TEXERE_DEVICE = 3,
    /// Memory did not suffice, on the host or on the device.
    TEXERE_MEMORY = 4,
    /// A file can't be read or written.
    TEXERE_IO = 5,
    /// The call ended early, because `texere_run_cancel` was called, or because a callback that
    /// takes pieces of a mesh or of a file returned a number other than 0.
    TEXERE_CANCELLED = 6,
    /// The library was built without what the call needs, or the device or the file format does not
    /// support it.
    TEXERE_UNSUPPORTED = 7,
    /// The library itself has a fault: its code panicked. The panic was caught, and the library can
    /// still be used.
    TEXERE_PANIC = 8,
}
