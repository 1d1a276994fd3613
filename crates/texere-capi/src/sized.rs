//! Structs that say their size and may grow at their end.
//!
//! A program that was built with an earlier header passes a shorter struct, one that was built with
//! a later header a longer one. The library reads and writes no more than the struct has. A member
//! that the program or the library does not know counts as 0. In a member that is added later, 0
//! therefore means what the library did before the member existed.

use std::mem::MaybeUninit;
use std::ptr;

use crate::argument::check;
use crate::failure::Failure;

/// A struct that begins with its size, a `u32`, and may grow at its end.
///
/// # Safety
///
/// The struct is `repr(C)`, begins with its size, and holds only numbers and raw pointers, so that
/// any bytes are a value of the struct.
pub(crate) unsafe trait Growing: Copy {
    /// The struct's size in its first release, bytes.
    const FIRST: usize;
}

/// The size of the member that `_of` gives, bytes.
pub(crate) const fn size_of_member<T, M>(_of: fn(&T) -> &M) -> usize {
    size_of::<M>()
}

/// Implements [`Growing`]. `$last` is the struct's last member in its first release. Members that
/// are added later change nothing here.
macro_rules! grows_after {
    ($kind:ident, $last:ident) => {
        // SAFETY: the struct is `repr(C)` and holds only numbers and raw pointers.
        unsafe impl $crate::sized::Growing for $kind {
            const FIRST: usize = std::mem::offset_of!($kind, $last)
                + $crate::sized::size_of_member(|value: &$kind| &value.$last);
        }

        // There is no padding behind `$last`. An earlier program does not set padding, and a member
        // that is added there later would be read from it.
        const _: () = assert!(
            std::mem::offset_of!($kind, struct_size) == 0
                && <$kind as $crate::sized::Growing>::FIRST % align_of::<$kind>() == 0
        );
    };
}

pub(crate) use grows_after;

/// The most bytes of a struct. A larger size is taken for memory that was never filled in, and is
/// refused.
const MOST: usize = 4096;

/// How many bytes a struct of the caller's says that it has.
///
/// # Safety
///
/// `pointer` is valid for reads of a `u32`.
unsafe fn size<T: Growing>(name: &str, pointer: *const T) -> Result<usize, Failure> {
    check(name, pointer)?;
    // SAFETY: neither null nor misaligned for `T`, which begins with a `u32`.
    let given = unsafe { pointer.cast::<u32>().read() } as usize;
    let (first, align) = (T::FIRST, align_of::<T>());
    if !(first..=MOST).contains(&given) || !given.is_multiple_of(align) {
        return Err(Failure::argument(format!(
            "{name}.struct_size is {given}, expected a multiple of {align} from {first} to {MOST}"
        )));
    }
    Ok(given)
}

/// Makes sure that a struct of the caller's says a size that it may have.
///
/// # Safety
///
/// `pointer` is valid for reads of a `u32`.
pub(crate) unsafe fn check_sized<T: Growing>(name: &str, pointer: *const T) -> Result<(), Failure> {
    // SAFETY: the caller vouches for it.
    unsafe { size(name, pointer) }.map(|_| ())
}

/// A struct of the caller's that says its size. Members that it is too short for are 0. The struct
/// is refused if a member that this library does not have is not 0.
///
/// # Safety
///
/// `pointer` is valid for reads of a `u32`, and of as many bytes as that says.
pub(crate) unsafe fn sized<T: Growing>(name: &str, pointer: *const T) -> Result<T, Failure> {
    let (own, mut value) = (size_of::<T>(), MaybeUninit::<T>::zeroed());
    // SAFETY: the caller vouches for the bytes that the struct says; no more than `T` has are
    // written. Any bytes are a value of `T`.
    unsafe {
        let given = size(name, pointer)?;
        let later = std::slice::from_raw_parts(pointer.cast::<u8>(), given).get(own..).unwrap_or_default();
        if let Some(place) = later.iter().position(|byte| *byte != 0) {
            return Err(Failure::unsupported(format!(
                "{name} has a member at byte {} that this library does not know; {name}.struct_size is \
                 {given}, and this library knows {own} bytes",
                own + place
            )));
        }
        ptr::copy_nonoverlapping(pointer.cast::<u8>(), value.as_mut_ptr().cast(), given.min(own));
        Ok(value.assume_init())
    }
}

/// Copies `value`, without its size, into the caller's struct, up to that struct's end. Members
/// that this library does not have become 0.
///
/// # Safety
///
/// `check_sized` has taken `pointer`, which is valid for writes of as many bytes as it says.
pub(crate) unsafe fn write_sized<T: Growing>(pointer: *mut T, value: T) {
    let (own, start) = (size_of::<T>(), size_of::<u32>());
    // SAFETY: the caller vouches for the bytes that the struct says; no more than `T` has are read.
    unsafe {
        let given = pointer.cast::<u32>().read() as usize;
        let (to, from) = (pointer.cast::<u8>(), (&raw const value).cast::<u8>());
        ptr::copy_nonoverlapping(from.add(start), to.add(start), given.min(own) - start);
        ptr::write_bytes(to.add(given.min(own)), 0, given - given.min(own));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::status::texere_status;

    /// A struct that has grown: it had two members once.
    #[repr(C)]
    #[derive(Debug, Clone, Copy, PartialEq)]
    struct Grown {
        struct_size: u32,
        old: u32,
        later: u64,
        last: [u32; 2],
    }

    grows_after!(Grown, old);

    /// Memory of a caller's, whose struct has this size, filled up with sevens.
    fn caller(size: u32) -> [u64; 6] {
        let mut memory = [0x0707_0707_0707_0707; 6];
        memory[0] = u64::from(size) | 5 << 32;
        memory
    }

    fn read(memory: &[u64; 6]) -> Result<Grown, Failure> {
        // SAFETY: the memory has more bytes than are accepted here.
        unsafe { sized("grown", memory.as_ptr().cast::<Grown>()) }
    }

    #[test]
    #[cfg(target_endian = "little")]
    fn an_earlier_programs_struct_has_zeros_where_it_ends() {
        const SEVENS: u64 = 0x0707_0707_0707_0707;
        let grown = |struct_size, later, last| Grown { struct_size, old: 5, later, last };
        assert_eq!(read(&caller(8)).unwrap(), grown(8, 0, [0; 2]));
        assert_eq!(read(&caller(16)).unwrap(), grown(16, SEVENS, [0; 2]));
        assert_eq!(read(&caller(24)).unwrap(), grown(24, SEVENS, [0x0707_0707; 2]));
        for size in [0, 4, 7, 9, 20, 4104, u32::MAX] {
            let refused = read(&caller(size)).unwrap_err();
            let words = format!("grown.struct_size is {size}, expected a multiple of 8 from 8 to 4096");
            assert_eq!((refused.status, refused.message), (texere_status::TEXERE_ARGUMENT, words));
        }
    }

    #[test]
    #[cfg(target_endian = "little")]
    fn a_later_programs_struct_is_refused_where_it_says_something_unknown() {
        let mut memory = caller(40);
        (memory[3], memory[4]) = (0, 0);
        assert!(read(&memory).is_ok());
        memory[4] = 1 << 56;
        let refused = read(&memory).unwrap_err();
        assert_eq!(refused.status, texere_status::TEXERE_UNSUPPORTED);
        assert!(refused.message.starts_with("grown has a member at byte 39 that"), "{}", refused.message);
        memory[0] = 32 | 5 << 32;
        assert!(read(&memory).is_ok(), "what lies behind the struct is none of its members");
    }

    #[test]
    #[cfg(target_endian = "little")]
    fn as_much_is_written_as_the_callers_struct_has() {
        let found = Grown { struct_size: 24, old: 1, later: 2, last: [3, 4] };
        let last = 3 | 4 << 32;
        for (size, written) in [(8, &[][..]), (16, &[2]), (24, &[2, last]), (40, &[2, last, 0, 0])] {
            let (mut memory, mut expected) = (caller(size), caller(size));
            expected[0] = u64::from(size) | 1 << 32;
            expected[1..=written.len()].copy_from_slice(written);
            // SAFETY: the memory has more bytes than the size says.
            unsafe { write_sized(memory.as_mut_ptr().cast(), found) };
            assert_eq!(memory, expected, "{size}");
        }
    }
}
