//! Writing meshes to files.

use std::ffi::{c_char, c_void};
use std::io::{self, Seek, SeekFrom, Write};
use std::sync::Arc;

use texere::backend;
use texere::mesh::{Limits, Topology};
use texere::write::Format;

use crate::argument::{given, text};
use crate::callback::Answer;
use crate::error::guard;
use crate::failure::Failure;
use crate::handle::{get, get_any};
use crate::plan::{Planned, texere_plan};
use crate::run::{Run, texere_run};
use crate::status::texere_status;

/// glTF 2.0 in one binary file, `.glb`.
pub const TEXERE_FORMAT_GLB: u32 = 0;
/// Binary PLY, `.ply`.
pub const TEXERE_FORMAT_PLY: u32 = 1;

/// Takes `size` bytes of a file, whose place in the file begins at byte `offset`. The pieces come
/// in order, except that at the end earlier bytes may come again with values that are only known
/// then. The callback returns 0 to go on; any other value ends the call that was given it. `data`
/// is valid until the callback returns.
pub type texere_write_callback =
    Option<unsafe extern "C" fn(user: *mut c_void, offset: u64, data: *const u8, size: usize) -> i32>;

/// A file whose bytes go to the caller's callback.
struct CallbackFile<F> {
    take: F,
    position: u64,
    end: u64,
}

impl<F: FnMut(u64, &[u8]) -> i32> Write for CallbackFile<F> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        Answer::of((self.take)(self.position, bytes)).map_err(io::Error::other)?;
        self.position += bytes.len() as u64;
        self.end = self.end.max(self.position);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl<F> Seek for CallbackFile<F> {
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

/// Chunks of a file: 2 MiB of vertices at most. The file does not depend on them. A disk that takes
/// 100 MB a second takes a chunk and its triangles in 50 ms.
const LIMITS: Limits = Limits { binding_bytes: 2 << 20, ..Limits::NONE };

impl Planned {
    /// The run that a writer takes: with a pattern of indices for all draws, so that the device
    /// makes none.
    fn writing(&self, run: Option<Arc<Run>>) -> Result<backend::Run<'_>, Failure> {
        self.run_of(Arc::new(self.plan.with_topology(Topology::Shared)), LIMITS, run)
    }
}

/// Makes the mesh of a plan and writes it to a file, `.glb` or `.ply`, in bounded memory. `run` may
/// be null. An existing file of that name is replaced only once the new one is complete.
///
/// Fails with TEXERE_IO if the file can't be written, and with TEXERE_CANCELLED if `run` was
/// cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_plan_write(
    plan: *const texere_plan,
    run: *const texere_run,
    path: *const c_char,
    path_length: usize,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `path`.
        let path = unsafe { text("path", path, path_length) }?;
        let (plan, run) = (get(plan)?, get_any(run)?);
        texere::write::run(plan.writing(run)?, plan.yarns.materials(), path)?;
        Ok(())
    })
}

/// Makes the mesh of a plan and hands the bytes of a file to `callback`, in bounded memory: the
/// bytes that `texere_plan_write` writes. `format` is a constant whose name begins with
/// TEXERE_FORMAT. `run` may be null. The callback runs on the calling thread, with `user` as its
/// first argument.
///
/// Fails with TEXERE_CANCELLED if `run` was cancelled, or if the callback returned a number other
/// than 0. The bytes that came before then are not a complete file.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_plan_write_to(
    plan: *const texere_plan,
    run: *const texere_run,
    format: u32,
    callback: texere_write_callback,
    user: *mut c_void,
) -> texere_status {
    guard(|| {
        let callback = given(callback)?;
        let format = match format {
            TEXERE_FORMAT_GLB => Format::Glb,
            TEXERE_FORMAT_PLY => Format::Ply,
            other => return Err(Failure::argument(format!("format is {other}, expected 0 or 1"))),
        };
        let (plan, run) = (get(plan)?, get_any(run)?);
        let take = |offset, bytes: &[u8]| {
            // SAFETY: the caller vouches for the callback; the bytes are valid while it runs.
            unsafe { callback(user, offset, bytes.as_ptr(), bytes.len()) }
        };
        let file = CallbackFile { take, position: 0, end: 0 };
        texere::write::run_to(plan.writing(run)?, plan.yarns.materials(), format, file)?;
        Ok(())
    })
}
