//! Views: values in the caller's memory, as far apart as the caller wants them.

use std::ffi::c_void;
use std::marker::PhantomData;

use crate::argument::check;
use crate::failure::Failure;

/// Values that lie in the caller's memory: in an array of their own, or as one member of each
/// struct of an array. `data` and `stride` are multiples of the alignment of the values.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_view {
    /// The first value.
    pub data: *mut c_void,
    /// How many bytes from `data` on belong to the view: at least up to the end of the last value.
    pub size: u64,
    /// Bytes from one value to the next: at least the size of a value.
    pub stride: u64,
}

/// A view whose memory has been checked to hold `count` values.
#[derive(Debug)]
pub(crate) struct Strided<'a, T> {
    first: *mut T,
    stride: usize,
    count: usize,
    memory: PhantomData<&'a mut [T]>,
}

/// A view whose memory has been checked to hold `count` rows of `bytes` bytes.
#[derive(Debug)]
pub(crate) struct Rows<'a> {
    first: *mut u8,
    stride: usize,
    count: usize,
    bytes: usize,
    memory: PhantomData<&'a mut [u8]>,
}

impl Rows<'_> {
    /// The bytes of a row.
    ///
    /// **Panics** past the last row.
    pub(crate) fn row(&self, number: usize) -> &[u8] {
        // SAFETY: the row lies within the `size` bytes of the view, as `rows` has checked; the
        // caller of `rows` vouches for these bytes.
        unsafe { std::slice::from_raw_parts(self.place(number), self.bytes) }
    }

    /// The bytes of a row, to be written.
    ///
    /// **Panics** past the last row.
    pub(crate) fn row_mut(&mut self, number: usize) -> &mut [u8] {
        // SAFETY: as for `row`.
        unsafe { std::slice::from_raw_parts_mut(self.place(number), self.bytes) }
    }

    fn place(&self, number: usize) -> *mut u8 {
        assert!(number < self.count, "row {number} of {}", self.count);
        self.first.wrapping_byte_add(number * self.stride)
    }
}

impl texere_view {
    /// Makes sure that the view holds `count` values. Gives `None` for a null view.
    ///
    /// # Safety
    ///
    /// The conditions of [`holds`](Self::holds) hold.
    pub(crate) unsafe fn holds_any<'a, T: Copy>(
        &self,
        name: &str,
        count: usize,
    ) -> Result<Option<Strided<'a, T>>, Failure> {
        // SAFETY: the caller vouches for it.
        if self.data.is_null() { Ok(None) } else { unsafe { self.holds(name, count) }.map(Some) }
    }

    /// Makes sure that the view holds `count` values. `name` is the argument's name in error
    /// messages. The view may be null if `count` is 0.
    ///
    /// # Safety
    ///
    /// The `size` bytes at `data` are valid for reads, and for the writes that the result is used
    /// for. Nothing else writes them as long as the result lives.
    pub(crate) unsafe fn holds<'a, T: Copy>(
        &self,
        name: &str,
        count: usize,
    ) -> Result<Strided<'a, T>, Failure> {
        let Self { data, stride, .. } = *self;
        let (first, memory) = (data.cast::<T>(), PhantomData);
        if count == 0 {
            return Ok(Strided { first, stride: size_of::<T>(), count, memory });
        }
        check(&format!("{name}.data"), first)?;
        self.check_room(name, count, size_of::<T>(), align_of::<T>(), "values")?;
        Ok(Strided { first, stride: stride as usize, count, memory })
    }

    /// Makes sure that the view holds `count` rows of `bytes` bytes each. Both numbers are 1 or
    /// more.
    ///
    /// # Safety
    ///
    /// The conditions of `holds` hold.
    pub(crate) unsafe fn rows<'a>(
        &self,
        name: &str,
        count: usize,
        bytes: usize,
    ) -> Result<Rows<'a>, Failure> {
        check(&format!("{name}.data"), self.data)?;
        self.check_room(name, count, bytes, 1, "rows")?;
        let (first, stride) = (self.data.cast(), self.stride as usize);
        Ok(Rows { first, stride, count, bytes, memory: PhantomData })
    }

    /// Makes sure that `count` items of `least` bytes lie within the view. `what` is what the error
    /// message calls the items.
    fn check_room(
        &self,
        name: &str,
        count: usize,
        least: usize,
        align: usize,
        what: &str,
    ) -> Result<(), Failure> {
        let (Self { size, stride, .. }, least) = (*self, least as u64);
        if stride < least || stride % align as u64 != 0 {
            return Err(Failure::argument(format!(
                "{name}.stride is {stride}, expected a multiple of {align} from {least} bytes"
            )));
        }
        let needed = (count as u64 - 1).checked_mul(stride).and_then(|bytes| bytes.checked_add(least));
        match needed.filter(|bytes| isize::try_from(*bytes).is_ok()) {
            Some(needed) if size >= needed => Ok(()),
            Some(needed) => Err(Failure::argument(format!(
                "{name}.size is {size} bytes, and {count} {what} need {needed}"
            ))),
            None => Err(Failure::argument(format!(
                "{name} has {count} {what} of {stride} bytes, more than memory can hold"
            ))),
        }
    }
}

impl<T: Copy> Strided<'_, T> {
    /// The values as a slice, or `None` if there is memory between them.
    pub(crate) fn dense(&mut self) -> Option<&mut [T]> {
        if self.count == 0 {
            return Some(&mut []);
        }
        // SAFETY: `holds` has checked pointer and size; its caller vouches for the memory.
        (self.stride == size_of::<T>())
            .then(|| unsafe { std::slice::from_raw_parts_mut(self.first, self.count) })
    }

    /// Writes `values` to the view, the first of them to place number `first`.
    ///
    /// **Panics** past the last value.
    pub(crate) fn write(&mut self, first: usize, values: impl IntoIterator<Item = T>) {
        for (number, value) in values.into_iter().enumerate() {
            // SAFETY: the place lies within the memory that `holds` has checked; the caller of
            // `holds` vouches for it.
            unsafe { self.place(first + number).write(value) };
        }
    }

    /// The place of value `number`, within the memory that `holds` has checked.
    fn place(&self, number: usize) -> *mut T {
        assert!(number < self.count, "value {number} of {}", self.count);
        self.first.wrapping_byte_add(number * self.stride)
    }
}

#[cfg(test)]
mod tests {
    use std::ptr::null_mut;

    use super::*;

    fn refusal(view: texere_view, count: usize) -> String {
        // SAFETY: a view that is refused is not read or written.
        unsafe { view.holds::<[f32; 3]>("view", count) }.map(|_| ()).unwrap_err().message
    }

    #[test]
    fn what_can_not_hold_the_values_is_refused_by_name_value_and_limit() {
        let mut memory = [0.0_f32; 12];
        let data: *mut c_void = memory.as_mut_ptr().cast();
        let odd = data.wrapping_byte_add(2);
        let view = |data, size, stride| texere_view { data, size, stride };
        assert_eq!(refusal(view(null_mut(), 48, 12), 4), "view.data is null");
        assert_eq!(refusal(view(odd, 46, 12), 3), "view.data is not a multiple of 4 bytes");
        assert_eq!(refusal(view(data, 48, 8), 4), "view.stride is 8, expected a multiple of 4 from 12 bytes");
        assert_eq!(
            refusal(view(data, 48, 14), 2),
            "view.stride is 14, expected a multiple of 4 from 12 bytes"
        );
        assert_eq!(refusal(view(data, 47, 12), 4), "view.size is 47 bytes, and 4 values need 48");
        assert_eq!(refusal(view(data, 43, 16), 3), "view.size is 43 bytes, and 3 values need 44");
        let endless = view(data, u64::MAX, 12);
        assert!(refusal(endless, usize::MAX / 12).ends_with("more than memory can hold"));
        assert!(refusal(view(data, u64::MAX, 1 << 63), 3).ends_with("more than memory can hold"));
    }

    #[test]
    fn values_are_written_as_far_apart_as_the_view_says() {
        let mut memory = [9.0_f32; 11];
        let view = texere_view { data: memory.as_mut_ptr().cast(), size: 44, stride: 16 };
        // SAFETY: the view is that of `memory`.
        let mut places = unsafe { view.holds::<[f32; 3]>("view", 3) }.unwrap();
        assert!(places.dense().is_none());
        places.write(1, [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
        assert_eq!(memory, [9.0, 9.0, 9.0, 9.0, 1.0, 2.0, 3.0, 9.0, 4.0, 5.0, 6.0]);
    }
}
