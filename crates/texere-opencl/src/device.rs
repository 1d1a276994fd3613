//! The devices of all platforms, and the limits of each.

use std::ffi::c_void;
use std::sync::Mutex;

use opencl3::device::{CL_DEVICE_TYPE_ALL, CL_DEVICE_TYPE_CPU, CL_DEVICE_TYPE_GPU, Device};
use opencl3::error_codes::{CL_DEVICE_NOT_FOUND, CL_PLATFORM_NOT_FOUND_KHR, ClError};
use opencl3::platform::{Platform, get_platforms};
use texere_core::{BackendError, DeviceInfo, DeviceKind, Limits};
use texere_gpu::{capabilities, device_name};

use crate::Schedule;
use crate::faults::failed;

/// A device of the list, with its information.
pub(crate) struct Listed {
    pub(crate) id: *mut c_void,
    pub(crate) info: DeviceInfo,
}

/// All devices of all platforms, platform by platform.
pub(crate) fn listed(schedule: Schedule) -> Result<Vec<Listed>, BackendError> {
    // The loader and the drivers initialise on the first call of each kind, and some fail if a
    // second thread calls meanwhile: ocl-icd answers that there is no platform, and PoCL reads a
    // half-initialised device.
    static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());
    let _alone = ONE_AT_A_TIME.lock();
    let mut devices = Vec::new();
    for platform in platforms().map_err(failed("opencl", "clGetPlatformIDs"))? {
        let ids = match platform.get_devices(CL_DEVICE_TYPE_ALL) {
            Ok(ids) => ids,
            Err(ClError(CL_DEVICE_NOT_FOUND)) => continue,
            Err(ClError(code)) => return Err(failed("opencl", "clGetDeviceIDs")(code)),
        };
        for id in ids {
            let name = device_name("opencl", Some(devices.len()), schedule);
            devices.push(Listed { id, info: info(&Device::new(id), &platform, name, schedule)? });
        }
    }
    Ok(devices)
}

/// All platforms. It is an error if there is none.
fn platforms() -> Result<Vec<Platform>, i32> {
    match get_platforms() {
        Ok(platforms) if platforms.is_empty() => Err(CL_PLATFORM_NOT_FOUND_KHR),
        Ok(platforms) => Ok(platforms),
        Err(ClError(code)) => Err(code),
    }
}

/// The information about `device`, whose name is `name`.
pub(crate) fn info(
    device: &Device,
    platform: &Platform,
    name: String,
    schedule: Schedule,
) -> Result<DeviceInfo, BackendError> {
    let ask = |call: &'static str| {
        let failed = failed(&name, call);
        move |ClError(code)| failed(code)
    };
    let shared = device.host_unified_memory().map_err(ask("clGetDeviceInfo"))?;
    let memory = device.global_mem_size().map_err(ask("clGetDeviceInfo"))?;
    // A device may be of several types at once, such as CPU and default.
    let types = device.dev_type().map_err(ask("clGetDeviceInfo"))?;
    let kind = if types & CL_DEVICE_TYPE_GPU != 0 {
        if shared { DeviceKind::IntegratedGpu } else { DeviceKind::DiscreteGpu }
    } else if types & CL_DEVICE_TYPE_CPU != 0 {
        DeviceKind::Cpu
    } else {
        DeviceKind::Other
    };
    Ok(DeviceInfo {
        device: device.name().map_err(ask("clGetDeviceInfo"))?,
        driver: format!(
            "{} {}, {}",
            platform.name().map_err(ask("clGetPlatformInfo"))?,
            device.driver_version().map_err(ask("clGetDeviceInfo"))?,
            device.version().map_err(ask("clGetDeviceInfo"))?.trim_end(),
        ),
        schedule,
        kind,
        memory_bytes: Some(memory),
        limits: Limits {
            binding_bytes: device.max_mem_alloc_size().map_err(ask("clGetDeviceInfo"))?,
            // The driver, other programs and small tables need some memory, too. If the memory is
            // the host's, the mesh that is read into it needs as much again.
            memory_bytes: if shared { memory / 2 } else { memory / 8 * 7 },
            ..Limits::NONE
        },
        can: capabilities(schedule, false),
        // The queues that this crate creates time their commands.
        timed_by_device: true,
        name,
    })
}
