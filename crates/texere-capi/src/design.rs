//! Designs: reading them from a file or from memory, and writing them to a file.

use std::ffi::{c_char, c_void};
use std::io;
use std::path::Path;

use texere::{Design, WriteError, write};

use crate::argument::{slice, text};
use crate::callback_file::{CallbackFile, texere_write_callback};
use crate::error::guard;
use crate::failure::Failure;
use crate::handle::{Handle, clear, free, get, give};
use crate::status::texere_status;
use crate::structure::choice;

/// A design: read from a WIF draft, a design file or a program of a knitting machine, or made from
/// the caller's arrays.
#[derive(Debug)]
pub struct texere_design;

impl Handle for texere_design {
    type Value = Design;
    const NAME: &str = "design";
}

/// Gives the library the bytes of a file that a design names, such as a picture: sets `*data` and
/// `*size`, and returns 0. Any other return value says that there is no such file. The bytes have
/// to stay valid until the function that was given this callback returns. `path` is UTF-8 of
/// `path_length` bytes.
pub type texere_file_callback = Option<
    unsafe extern "C" fn(
        user: *mut c_void,
        path: *const c_char,
        path_length: usize,
        data: *mut *const u8,
        size: *mut usize,
    ) -> i32,
>;

/// Reads a design from a file: a draft of WIF (`.wif`), Fiberworks (`.dtx`) or WeavePoint (`.wpo`),
/// a design file (`.toml`) or a program of a knitting machine (`.k`).
///
/// Fails with TEXERE_IO if the file can't be read, and with TEXERE_DESIGN if it holds no valid
/// design; `texere_error_place` then says where the file is at fault.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_design_read(
    path: *const c_char,
    path_length: usize,
    out: *mut *mut texere_design,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `out` and `path`.
        unsafe {
            clear(out)?;
            give(out, texere::read(text("path", path, path_length)?)?)
        }
    })
}

/// Reads a design that the caller has in memory. `name` stands for the file's name: its ending says
/// what kind of design it is, and errors show it. `files` is called for each file that the design
/// names, with `user` as its first argument. `files` may be null if the design names no files.
///
/// Fails as `texere_design_read` does.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_design_read_memory(
    name: *const c_char,
    name_length: usize,
    data: *const u8,
    size: usize,
    files: texere_file_callback,
    user: *mut c_void,
    out: *mut *mut texere_design,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for all of them.
        let (name, bytes) = unsafe {
            clear(out)?;
            (text("name", name, name_length)?, slice("data", data, size)?)
        };
        let file = |path: &Path| {
            let missing = || io::Error::from(io::ErrorKind::NotFound);
            let files = files.ok_or_else(missing)?;
            let path = path.to_string_lossy();
            let (mut data, mut size) = (std::ptr::null(), 0);
            // SAFETY: the caller vouches for the callback.
            let answer = unsafe { files(user, path.as_ptr().cast(), path.len(), &mut data, &mut size) };
            if answer != 0 {
                return Err(missing());
            }
            // SAFETY: the callback vouches for the bytes.
            let bytes = unsafe { slice("the callback's data", data, size) };
            bytes.map(<[u8]>::to_vec).map_err(|failure| io::Error::other(failure.message))
        };
        // SAFETY: as above.
        unsafe { give(out, texere::read_from(name, bytes, file)?) }
    })
}

/// Writes a design to a file that `texere_design_read` reads. The ending of `path` says which:
/// `.toml` for texere's own design file, which holds woven cloth, weft knits that were read from a
/// chart or a picture, and warp knits without a Jacquard bar; `.wif` for a WIF 1.1 draft, which
/// holds woven cloth, and leaves out what drafts don't have; `.k` or `.knitout` for a knitout file,
/// which holds weft knits that were read from one. An existing file of that name is replaced only
/// once the new one is complete.
///
/// Fails with TEXERE_ARGUMENT for another ending, with TEXERE_UNSUPPORTED for a design that the
/// file can't hold, and with TEXERE_IO if the file can't be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_design_write(
    design: *const texere_design,
    path: *const c_char,
    path_length: usize,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `path`.
        let path = unsafe { text("path", path, path_length) }?;
        let design = get(design)?;
        let ending = Path::new(path).extension().map(|ending| ending.to_ascii_lowercase());
        match ending.as_deref().and_then(|ending| ending.to_str()) {
            Some("toml") => write::toml(&design, path)?,
            Some("wif") => write::wif(&design, path)?,
            Some("k" | "knitout") => write::knitout(&design, path)?,
            _ => {
                let said = format!("path is {path:?}, expected one that ends in .toml, .wif, .k or .knitout");
                return Err(Failure::argument(said));
            }
        };
        Ok(())
    })
}

/// The form of texere's own design file, `.toml`.
pub const TEXERE_DESIGN_FORMAT_TOML: u32 = 0;
/// The form of a WIF 1.1 draft, `.wif`.
pub const TEXERE_DESIGN_FORMAT_WIF: u32 = 1;
/// The form of a knitout file, `.k`.
pub const TEXERE_DESIGN_FORMAT_KNITOUT: u32 = 2;

/// Writes a design to a callback. Returns what the file leaves out.
type DesignWriter = fn(&Design, CallbackFile) -> Result<Vec<String>, WriteError>;

/// Writes a design, not to a file but to `callback`, which gets the bytes that
/// `texere_design_write` would write. `format` is a constant whose name begins with
/// TEXERE_DESIGN_FORMAT. The callback runs on the calling thread, with `user` as its first
/// argument.
///
/// Fails with TEXERE_UNSUPPORTED for a design that the format can't hold, and with TEXERE_CANCELLED
/// if the callback returned a number other than 0. The bytes that the callback had been given by
/// then are not a complete file.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_design_write_to(
    design: *const texere_design,
    format: u32,
    callback: texere_write_callback,
    user: *mut c_void,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for the callback.
        let file = unsafe { CallbackFile::new(callback, user) }?;
        let writers: [DesignWriter; 3] = [write::toml_to, write::wif_to, write::knitout_to];
        let write = choice("format", format, &writers)?;
        let design = get(design)?;
        write(&design, file)?;
        Ok(())
    })
}

/// Frees a design. A null handle is allowed. Cloths that were made of the design stay valid.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_design_free(design: *mut texere_design) {
    free(design);
}
