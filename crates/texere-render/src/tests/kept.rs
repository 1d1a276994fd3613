//! The memory that a renderer keeps on its device.

use texere_wgpu::{Schedule, WgpuBackend};
use wgpu::{Backends, InstanceDescriptor, InstanceFlags, PollType};

use super::{DEVICE, SETTINGS, SIZE, TWILL};
use crate::{Camera, Quality, Renderer};

/// wgpu's report of the resources that it holds shows whether anything of the scenes is left.
#[test]
fn scenes_that_come_and_go_leave_nothing_on_the_device() {
    let instance = wgpu::Instance::new(InstanceDescriptor {
        backends: Backends::VULKAN,
        flags: InstanceFlags::empty(),
        ..InstanceDescriptor::new_without_display_handle()
    });
    let adapters = pollster::block_on(instance.enumerate_adapters(Backends::VULKAN));
    let adapter = adapters.iter().find(|adapter| adapter.get_info().name.contains(DEVICE)).unwrap();
    let (device, queue) =
        pollster::block_on(adapter.request_device(&WgpuBackend::descriptor(adapter))).unwrap();
    let ours = WgpuBackend::from_device(device.clone(), queue, Schedule::PerRing).unwrap();
    let renderer = Renderer::new(ours).unwrap();
    let yarns = TWILL.yarns();
    let alive = || {
        device.poll(PollType::wait_indefinitely()).unwrap();
        let report = instance.generate_report().unwrap();
        let hub = report.hub_report();
        [
            ("buffers", &hub.buffers),
            ("textures", &hub.textures),
            ("views", &hub.texture_views),
            ("bind groups", &hub.bind_groups),
            ("pipelines", &hub.compute_pipelines),
            ("command buffers", &hub.command_buffers),
            ("encoders", &hub.command_encoders),
            ("devices", &hub.devices),
        ]
        .map(|(name, registry)| (name, registry.num_allocated))
    };
    // The pictures of a window: a small one when it opens, one of a moving view, and one at rest.
    let pictures = |turn: usize| {
        let mut scene = renderer.scene(&yarns, &SETTINGS).unwrap();
        for (size, supersampling) in [([8, 8], 1), (SIZE.map(|side| side / 2 + turn as u32), 1), (SIZE, 2)] {
            let camera = Camera::face(scene.extent(), size);
            scene.frame(&camera, Quality { supersampling, hairs: true }).unwrap();
        }
        scene.seen_at([120.0, 90.0]).unwrap();
    };
    pictures(0);
    let first = alive();
    (1..6).for_each(pictures);
    assert_eq!(first, alive());
}
