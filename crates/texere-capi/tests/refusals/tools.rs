//! How a call with one wrong argument is written down.

use std::ptr::without_provenance_mut;

use texere_c::texere_status;

/// A call, and its name. Its status says that the argument is refused.
pub(crate) type Case = (&'static str, Box<dyn Fn() -> texere_status>);

/// A handle that was freed, and one that never was any.
pub(crate) fn strange<H>() -> [*mut H; 2] {
    [without_provenance_mut(usize::MAX & !15), without_provenance_mut(8)]
}

/// A call with one wrong argument; everything else about it is right.
macro_rules! case {
    ($cases:ident, $name:ident($($argument:expr),* $(,)?)) => {
        // SAFETY: what is wrong is what the library says that it refuses.
        $cases.push((stringify!($name), Box::new(move || unsafe { $name($($argument),*) })))
    };
}

/// A call with handles that are null, that are none, that are of another kind.
macro_rules! handles {
    ($cases:ident, $own:ident, $kind:ty, |$handle:ident| $name:ident($($argument:expr),* $(,)?)) => {
        let other = if stringify!($kind) == "texere_run" { $own.device.cast() } else { $own.run.cast() };
        let others: [*mut $kind; 4] = [std::ptr::null_mut(), strange()[0], strange()[1], other];
        for $handle in others {
            case!($cases, $name($($argument),*));
        }
    };
}

/// A call with structs of another size than the library's.
macro_rules! sizes {
    ($cases:ident, $kind:ty, |$given:ident| $name:ident($($argument:expr),* $(,)?)) => {
        for size in [0, 4, size_of::<$kind>() as u32 - 1, size_of::<$kind>() as u32 + 1, u32::MAX] {
            // SAFETY: what is wrong is what the library says that it refuses; zeros are a value of
            // each of these structs.
            $cases.push((stringify!($name), Box::new(move || unsafe {
                let mut $given: $kind = std::mem::zeroed();
                $given.struct_size = size;
                $name($($argument),*)
            })));
        }
    };
}

pub(crate) use {case, handles, sizes};
