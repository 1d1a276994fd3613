//! The device that draws the window.

use std::sync::Arc;

use eframe::egui_wgpu::{WgpuConfiguration, WgpuSetup, WgpuSetupCreateNew};
use texere::DeviceInfo;
use texere::gpu::WgpuBackend;
use texere::gpu::wgpu::{Adapter, Backends, InstanceFlags, Surface};

/// How the window opens the device called `name`: as [`WgpuBackend::open`] does, with the ability
/// to draw into the window.
pub(crate) fn configuration(name: String) -> WgpuConfiguration {
    let mut setup = WgpuSetupCreateNew::without_display_handle();
    setup.instance_descriptor.backends = Backends::VULKAN | Backends::METAL | Backends::DX12;
    setup.instance_descriptor.flags = InstanceFlags::empty().with_env();
    setup.native_adapter_selector = Some(Arc::new(move |adapters, surface| chosen(&name, adapters, surface)));
    setup.device_descriptor = Arc::new(WgpuBackend::descriptor);
    WgpuConfiguration { wgpu_setup: WgpuSetup::CreateNew(setup), ..Default::default() }
}

fn chosen(name: &str, adapters: &[Adapter], surface: Option<&Surface<'_>>) -> Result<Adapter, String> {
    let shows = |adapter: &Adapter| surface.is_none_or(|surface| adapter.is_surface_supported(surface));
    let mut known: Vec<_> = WgpuBackend::describe(adapters).into_iter().zip(adapters).collect();
    if name == "auto" {
        known.retain(|(_, adapter)| shows(adapter));
    }
    let (list, adapters): (Vec<DeviceInfo>, Vec<&Adapter>) = known.into_iter().unzip();
    let number = texere::picture::picture_device(name, &list).map_err(|error| error.to_string())?;
    if shows(adapters[number]) {
        Ok(adapters[number].clone())
    } else {
        Err(format!("{} ({}) can't draw into windows here", list[number].name, list[number].device))
    }
}
