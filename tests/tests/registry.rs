//! What the registry opens here.

use texere_conformance::REGISTRY;

/// Where nothing is timed by the device, the suite can't tell that the device did the work.
#[test]
fn every_gpu_backend_has_a_device_with_a_clock_and_both_schedules() {
    for name in ["opencl", "wgpu"] {
        let entry = REGISTRY.iter().find(|entry| entry.name == name).unwrap();
        // The suite itself says where a backend is missing.
        let Ok(devices) = (entry.open)() else { continue };
        assert!(devices.iter().any(|device| device.info().timed_by_device), "{devices:?}");
        for schedule in ["per-ring", "per-yarn"] {
            assert!(devices.iter().any(|device| device.info().schedule == schedule), "{devices:?}");
        }
    }
}
