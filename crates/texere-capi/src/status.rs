//! How a call ended.

/// How a call ended.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum texere_status {
    /// The call did what it is for.
    TEXERE_OK = 0,
    /// A null or misaligned pointer, a wrong size, a handle that was freed or is of another kind,
    /// or a value out of its range.
    TEXERE_ARGUMENT = 1,
    /// The design can't be read, or its cloth can't be made.
    TEXERE_DESIGN = 2,
    /// There is no such device, or it failed.
    TEXERE_DEVICE = 3,
    /// Memory did not suffice, on the host or on the device.
    TEXERE_MEMORY = 4,
    /// A file can't be read or written.
    TEXERE_IO = 5,
    /// The call ended early since `texere_run_cancel` was called.
    TEXERE_CANCELLED = 6,
    /// The library was built without what the call needs, or the device can't do it.
    TEXERE_UNSUPPORTED = 7,
    /// A fault of the library. It was caught, and the library can still be used.
    TEXERE_PANIC = 8,
}
