//! Files whose bytes go to a callback of the caller's.

use std::ffi::c_void;
use std::io::{self, Seek, SeekFrom, Write};

use crate::argument::given;
use crate::callback::Answer;
use crate::failure::Failure;

/// Takes a piece of a file: `size` bytes, which begin at byte `offset` of the file. The pieces come
/// in order, except that at the end earlier bytes may come again with values that are only known
/// then. The callback returns 0 to go on; any other value ends the call that was given this
/// callback. `data` is valid until the callback returns.
pub type texere_write_callback =
    Option<unsafe extern "C" fn(user: *mut c_void, offset: u64, data: *const u8, size: usize) -> i32>;

/// A file whose bytes go to the caller's callback.
pub(crate) struct CallbackFile {
    take: unsafe extern "C" fn(*mut c_void, u64, *const u8, usize) -> i32,
    user: *mut c_void,
    position: u64,
    end: u64,
}

impl CallbackFile {
    /// A file without bytes yet. Fails for a null callback.
    ///
    /// # Safety
    ///
    /// The callback may be called with `user` and any bytes.
    pub(crate) unsafe fn new(callback: texere_write_callback, user: *mut c_void) -> Result<Self, Failure> {
        Ok(Self { take: given(callback)?, user, position: 0, end: 0 })
    }
}

impl Write for CallbackFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        // SAFETY: `CallbackFile::new` asks for a valid callback. The bytes are valid while it runs.
        let answer = unsafe { (self.take)(self.user, self.position, bytes.as_ptr(), bytes.len()) };
        Answer::of(answer).map_err(io::Error::other)?;
        self.position += bytes.len() as u64;
        self.end = self.end.max(self.position);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Seek for CallbackFile {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let place = match to {
            SeekFrom::Start(place) => Some(place),
            SeekFrom::Current(by) => self.position.checked_add_signed(by),
            SeekFrom::End(by) => self.end.checked_add_signed(by),
        };
        self.position = place.ok_or_else(|| io::Error::from(io::ErrorKind::InvalidInput))?;
        Ok(self.position)
    }
}
