//! Macros that list calls with wrong arguments.

use std::ptr::without_provenance_mut;

use texere_c::texere_status;

/// A call and its name. The call has to fail with TEXERE_ARGUMENT.
pub(crate) type Case = (&'static str, Box<dyn Fn() -> texere_status>);

/// Two numbers that are no handles: one so high that the library never gives it, and one that is
/// not a multiple of 16.
pub(crate) fn strange<H>() -> [*mut H; 2] {
    [without_provenance_mut(usize::MAX & !15), without_provenance_mut(8)]
}

/// Adds a call with at least one wrong argument.
macro_rules! case {
    ($cases:ident, $name:ident($($argument:expr),* $(,)?)) => {
        // SAFETY: the wrong argument is one that the library refuses without using it.
        $cases.push((stringify!($name), Box::new(move || unsafe { $name($($argument),*) })))
    };
}

/// Adds a call with a handle that is none. The call has to say so, whatever its other arguments
/// are.
macro_rules! no_handle {
    ($cases:ident, $name:ident($($argument:expr),* $(,)?)) => {
        $cases.push((stringify!($name), Box::new(move || {
            // SAFETY: the library looks handles up before it uses them.
            let status = unsafe { $name($($argument),*) };
            let said = crate::common::message();
            assert!(
                said.ends_with(" is null") || said.contains(" was freed already, or is no "),
                "{}: {said}",
                stringify!($name)
            );
            status
        })))
    };
}

/// Adds a call four times: with a null handle, with two numbers that are no handles, and with a
/// handle of another kind.
macro_rules! handles {
    ($cases:ident, $own:ident, $kind:ty, |$handle:ident| $name:ident($($argument:expr),* $(,)?)) => {
        let other = if stringify!($kind) == "texere_run" { $own.device.cast() } else { $own.run.cast() };
        let others: [*mut $kind; 4] = [std::ptr::null_mut(), strange()[0], strange()[1], other];
        for $handle in others {
            no_handle!($cases, $name($($argument),*));
        }
    };
}

/// Adds a call with several values of `struct_size` that are not the size of the struct.
macro_rules! sizes {
    ($cases:ident, $kind:ty, |$given:ident| $name:ident($($argument:expr),* $(,)?)) => {
        for size in [0, 4, size_of::<$kind>() as u32 - 1, size_of::<$kind>() as u32 + 1, u32::MAX] {
            // SAFETY: the library refuses a wrong size without using the rest; zeros are a valid
            // value of each of these structs.
            $cases.push((stringify!($name), Box::new(move || unsafe {
                let mut $given: $kind = std::mem::zeroed();
                $given.struct_size = size;
                $name($($argument),*)
            })));
        }
    };
}

pub(crate) use {case, handles, no_handle, sizes};
