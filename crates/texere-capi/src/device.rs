//! Devices: opening and describing them.

use std::ffi::{CString, c_char};
use std::sync::Arc;

use texere::Backend;

use crate::argument::text;
use crate::error::guard;
use crate::handle::{Handle, clear, free, get, give};
use crate::lendable::lendable;
use crate::sized::{check_sized, grows_after, write_sized};
use crate::status::texere_status;

/// An open device: a GPU, or the CPU.
#[derive(Debug)]
pub struct texere_device;

#[derive(Debug)]
pub(crate) struct Device {
    pub(crate) backend: Arc<dyn Backend>,
    /// The name that opens the device, the maker's name of it, and its driver.
    names: [CString; 3],
}

impl Handle for texere_device {
    type Value = Device;
    const NAME: &str = "device";
}

/// A description of a device. Its strings end with a zero byte and are valid until the device is
/// freed.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_device_info {
    /// Size of this struct, bytes. The caller sets it.
    pub struct_size: u32,
    /// 1 if yarns of all structures can come to rest on the device, else 0.
    pub settles: u32,
    /// The name that opens the device, such as "cpu" or "opencl:0".
    pub name: *const c_char,
    /// The maker's name of the device.
    pub device: *const c_char,
    /// The driver of the device, with the version.
    pub driver: *const c_char,
    /// How much memory the device has, bytes; 0 if it is not known.
    pub memory_bytes: u64,
}

grows_after!(texere_device_info, memory_bytes);

/// Opens a device by its name: "auto" for the best one, "cpu", "cpu-serial", "opencl", "opencl:1",
/// "wgpu" and so on. A `name_length` of 0 is "auto".
///
/// Fails with TEXERE_DEVICE if there is no device of that name, and with TEXERE_UNSUPPORTED if the
/// library was built without the API that the device needs.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_device_open(
    name: *const c_char,
    name_length: usize,
    out: *mut *mut texere_device,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `out` and `name`.
        let name = unsafe {
            clear(out)?;
            text("name", name, name_length)?
        };
        let backend: Arc<dyn Backend> = texere::open(if name.is_empty() { "auto" } else { name })?.into();
        let info = backend.info();
        let names = [&info.name, &info.device, &info.driver].map(lendable);
        // SAFETY: as above.
        unsafe { give(out, Device { backend, names }) }
    })
}

/// Writes a description of a device. The caller sets `info->struct_size` before the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_device_describe(
    device: *const texere_device,
    info: *mut texere_device_info,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `info`.
        unsafe { check_sized("info", info) }?;
        let device = get(device)?;
        let is = device.backend.info();
        let [name, maker, driver] = device.names.each_ref().map(|name| name.as_ptr());
        let found = texere_device_info {
            struct_size: size_of::<texere_device_info>() as u32,
            settles: u32::from(is.can.settle && is.can.settle_crossings),
            name,
            device: maker,
            driver,
            memory_bytes: is.memory_bytes.unwrap_or(0),
        };
        // SAFETY: `check_sized` has accepted the size; the caller vouches for the memory.
        unsafe { write_sized(info, found) };
        Ok(())
    })
}

/// Frees a device. A null handle is allowed. Handles that were made with the device stay valid.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_device_free(device: *mut texere_device) {
    free(device);
}
